#pragma once

#include <trochoid/surface/roughness.h>

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace trochoid::surface {

/// @brief What all teeth leave of a turn at some depths, at even places u from 0 to 1.
struct WrittenTurn {
  std::vector<double> height;  ///< [m]
  std::vector<double> slope;   ///< dz/du [m]; empty unless asked for
  /// How much of the height each tooth has, shape (teeth): 1 on its marks, 0 beside them,
  /// filtered as the height is. Empty unless asked for.
  std::vector<std::vector<double>> of_tooth;
  std::vector<double> share;  ///< that each tooth wrote, sum 1

  /// One of them between the places.
  [[nodiscard]] static double at(std::span<const double> values, double u) noexcept;
};

/// @brief The profile that each tooth would leave alone, of one turn.
class ToothProfiles {
 public:
  /// @param alone   of each tooth
  /// @param cutoff  of a Gaussian filter that the heights have passed [m]
  ToothProfiles(std::span<const PeriodicProfile> alone, std::optional<double> cutoff);

  [[nodiscard]] std::size_t teeth() const noexcept { return heights_.size(); }
  /// Where a tooth reaches deepest.
  struct Lowest {
    double u = 0.0;
    double height = 0.0;  ///< [m]
  };
  [[nodiscard]] const Lowest& lowest(std::size_t tooth) const noexcept {
    return lowest_[tooth];
  }
  /// @brief S of W-7.
  /// @param depth  of each tooth [m]
  /// @param parts  whether slopes and the parts of teeth are asked for
  [[nodiscard]] WrittenTurn written(std::span<const double> depth, bool parts) const;
  /// How much deeper a tooth must reach to leave a mark between the others [m].
  [[nodiscard]] double missing(std::span<const double> depth, std::size_t tooth) const;
  [[nodiscard]] bool reach_everywhere() const noexcept { return everywhere_; }

 private:
  void filter(std::vector<double>& values) const;

  std::vector<std::vector<double>> heights_;  ///< shape (teeth, places)
  std::vector<Lowest> lowest_;
  std::vector<double> removed_;  ///< of the harmonics from 0 on, by the filter
  bool everywhere_ = true;
};

}  // namespace trochoid::surface
