#pragma once

#include <span>
#include <vector>

namespace trochoid::signal {

/// @brief The mean and the spindle harmonics 1..n over given angles.
///
/// @eq  S-5  a_0 + sum_m (a_m cos(m phi) + b_m sin(m phi)), by least squares
///
/// The same projection serves data and model. Its coordinates in an orthonormal basis
/// are fewer numbers than the samples: they, not the samples, are what a fit within the
/// band has to count.
class Band {
 public:
  /// @param angle      [rad], shape (n), any spacing; more than one turn or less
  /// @param harmonics  n, at least 0
  /// @throws std::invalid_argument without angles or with harmonics < 0
  Band(std::span<const double> angle, int harmonics);

  /// Independent functions; below 2 n + 1 where the angles cannot tell some apart.
  [[nodiscard]] int size() const noexcept { return size_; }
  /// @brief Coordinates of samples in the orthonormal basis, shape (size).
  [[nodiscard]] std::vector<double> coordinates(std::span<const double> samples) const;
  /// @brief The part of samples within the band, shape (n).
  [[nodiscard]] std::vector<double> project(std::span<const double> samples) const;

 private:
  int size_ = 0;
  std::size_t samples_ = 0;
  std::vector<double> basis_;  ///< orthonormal columns, row-major, shape (n, size)
};

}  // namespace trochoid::signal
