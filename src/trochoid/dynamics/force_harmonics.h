#pragma once

#include <trochoid/dynamics/directional.h>
#include <trochoid/dynamics/point_response.h>

#include <memory>
#include <span>
#include <vector>

namespace trochoid::dynamics {

/// @brief Fourier coefficients of the directional matrices.
///
/// @eq  D-21 A_d(phi) = sum over n of A_d^n e^(i n 2 pi phi / P),
///           A_d^n = (1/P) integral over the period P of A_d e^(-i n 2 pi phi / P)
/// @src definition; the mean n = 0 is that of [altintas1995]
struct ForceHarmonics {
  double period = 0.0;         ///< P [rad]
  std::vector<double> delays;  ///< [rad], as of the Directional
  int most = 0;                ///< n from -most to most
  /// Shape (1 + delays, 2 most + 1) [N/m]: first what acts on q(phi).
  std::vector<std::vector<ComplexMatrix2>> coefficients;
  /// The same of what acts on dq/dphi, shape (2 most + 1) [N]; empty: nothing.
  std::vector<ComplexMatrix2> damping;
};

/// @param most  largest n, at least 0
ForceHarmonics force_harmonics(const Directional& directional, int most);

/// The mirror image of a chatter frequency counts where no more tooth passing
/// frequencies lie between: what couples them falls with the square of that number.
inline constexpr int most_mirrored = 24;

/// @brief The harmonics of a force at the depths of a diagram, each made once for all
/// speeds, and between them.
class DepthHarmonics {
 public:
  /// @param depth      [m], ascending, positive, at least one; its values must outlive
  ///                   this
  /// @param harmonics  of the tooth passing frequency, as of FrequencyOptions
  DepthHarmonics(const DirectionalModel& model, std::span<const double> depth,
                 int harmonics);
  ~DepthHarmonics();
  DepthHarmonics(const DepthHarmonics&) = delete;
  DepthHarmonics& operator=(const DepthHarmonics&) = delete;

  /// @brief Between two of the depths, linear per depth; exact where forces are
  /// proportional to it.
  /// @param depth  [m], at most the deepest
  [[nodiscard]] ForceHarmonics at(double depth) const;

  [[nodiscard]] std::span<const double> depths() const noexcept { return depth_; }
  [[nodiscard]] bool proportional() const noexcept { return model_.proportional(); }
  /// Harmonics of the period kept on each side.
  [[nodiscard]] int kept() const noexcept { return kept_; }
  [[nodiscard]] double period() const noexcept { return period_; }

 private:
  struct Made;
  [[nodiscard]] const ForceHarmonics& made(std::size_t k) const;

  const DirectionalModel& model_;
  std::span<const double> depth_;
  int kept_ = 0;
  int waves_ = 0;
  double period_ = 0.0;
  std::unique_ptr<Made> made_;
};

}  // namespace trochoid::dynamics
