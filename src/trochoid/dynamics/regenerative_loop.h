#pragma once

#include <trochoid/dynamics/force_harmonics.h>
#include <trochoid/dynamics/point_response.h>

#include <complex>
#include <cstddef>
#include <vector>

/// What a vibration becomes by the forces that it makes, from a measured response.
namespace trochoid::dynamics {

/// Its largest entry.
double largest(const ComplexMatrix2& G) noexcept;

/// The response at the harmonics of a vibration that are kept.
struct KeptResponse {
  double omega = 0.0;             ///< of the vibration [rad/s]
  std::vector<int> k;             ///< ascending; empty: none can be looked for here
  std::vector<ComplexMatrix2> G;  ///< of each
  std::vector<double> size;       ///< largest entry of each, above 0
  double softest = 0.0;           ///< largest entry of any
};

/// @brief The response at one speed, at the frequencies of the scan and between them:
/// one for all depths with the same delays.
class ResponseAtSpeed {
 public:
  /// @param forces  of the cut at some depth
  /// @param h       harmonics kept on each side; 0: the mean force
  /// @note point must outlive it.
  ResponseAtSpeed(const ForceHarmonics& forces, const PointResponse& point,
                  double Omega, int h);

  /// Is it that of these forces too, of the same cut at some other depth?
  [[nodiscard]] bool serves(const ForceHarmonics& forces) const noexcept;

  /// Ascending; closer at every peak of the response, and everywhere close for the delay.
  [[nodiscard]] const std::vector<KeptResponse>& scan() const noexcept { return scan_; }
  /// @return no harmonics where another one of the same vibration is much softer
  [[nodiscard]] KeptResponse at(double omega) const;

  [[nodiscard]] double Omega() const noexcept { return Omega_; }
  /// From a harmonic to the next [rad/s].
  [[nodiscard]] double step() const noexcept { return step_; }
  /// That move.
  [[nodiscard]] const std::vector<std::size_t>& axes() const noexcept { return axes_; }

 private:
  const PointResponse& point_;
  double Omega_;
  double step_;
  int h_;
  int most_;
  double longest_;  ///< delay [rad]
  std::vector<std::size_t> axes_;
  std::vector<KeptResponse> scan_;
};

/// @brief The matrix of D-22 of one cut at one speed, for one frequency after another.
///
/// @eq  D-33 with process damping A_0^(k-l) + i (omega_l / Omega) D^(k-l) in D-22
/// @src derived: D-30 of a vibration, whose dq/dphi is i omega_l / Omega times q_l
class RegenerativeLoop {
 public:
  /// @note Forces and response must outlive it.
  RegenerativeLoop(const ForceHarmonics& forces, const ResponseAtSpeed& response);

  /// @brief Its eigenvalues.
  /// @return empty where none can reach `least`, and where nothing can be looked for
  [[nodiscard]] std::vector<std::complex<double>> eigenvalues(const KeptResponse& kept,
                                                              double least) const;
  [[nodiscard]] std::vector<std::complex<double>> eigenvalues(double omega,
                                                              double least) const {
    return eigenvalues(response_.at(omega), least);
  }

 private:
  /// In units of each harmonic in which the matrix is balanced: its eigenvalues stay, and
  /// its powers are nearer to them in size.
  void add_column(const KeptResponse& kept, std::size_t l,
                  std::vector<std::complex<double>>& M) const;

  const ForceHarmonics& forces_;
  const ResponseAtSpeed& response_;
  double force_size_ = 0.0;    ///< no column of forces sums up to more [N/m]
  double damping_size_ = 0.0;  ///< the same of what acts on dq/dphi [N]
};

}  // namespace trochoid::dynamics
