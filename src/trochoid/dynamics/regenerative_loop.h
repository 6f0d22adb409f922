#pragma once

#include <trochoid/dynamics/force_harmonics.h>
#include <trochoid/dynamics/point_response.h>

#include <complex>
#include <cstddef>
#include <vector>

namespace trochoid::dynamics {

/// Its largest entry.
double largest(const ComplexMatrix2& G) noexcept;

/// @brief What a vibration becomes by the forces that it makes: the matrix of D-22 at
/// one speed, for one frequency after another.
///
/// @eq  D-33 with process damping A_0^(k-l) + i (omega_l / Omega) D^(k-l) in D-22
/// @src derived: D-30 of a vibration, whose dq/dphi is i omega_l / Omega times q_l
class RegenerativeLoop {
 public:
  /// @param h  harmonics kept on each side; 0: the mean force
  /// @note Forces and point must outlive it.
  RegenerativeLoop(const ForceHarmonics& forces, const PointResponse& point,
                   double Omega, int h);

  /// @brief Eigenvalues at omega [rad/s].
  /// @return empty where none can reach `least`, and where another harmonic of the same
  ///         vibration is much softer
  [[nodiscard]] std::vector<std::complex<double>> eigenvalues(double omega,
                                                              double least) const;

 private:
  /// The response at the harmonics that are kept.
  struct Kept {
    std::vector<int> k;             ///< ascending
    std::vector<ComplexMatrix2> G;  ///< of each
    double softest = 0.0;           ///< largest entry of any
  };
  [[nodiscard]] Kept kept_at(double omega) const;
  void add_column(double omega, const Kept& kept, std::size_t l,
                  std::vector<std::complex<double>>& M) const;

  const ForceHarmonics& forces_;
  const PointResponse& point_;
  double Omega_;
  double step_;  ///< from a harmonic to the next [rad/s]
  int h_;
  std::vector<std::size_t> axes_;  ///< that move
  double force_size_ = 0.0;        ///< no column of forces sums up to more [N/m]
  double damping_size_ = 0.0;      ///< the same of what acts on dq/dphi [N]
};

}  // namespace trochoid::dynamics
