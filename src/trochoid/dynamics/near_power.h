#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace trochoid::dynamics {

/// (h/h_0)^-m of a tooth without helix, from a chip not long ago.
///
/// The chip changes little from step to step: a series about the last power taken is
/// faster than a power.
class NearPower {
 public:
  explicit NearPower(double m = 0.0, std::size_t teeth = 0);

  /// @param h  positive [m]
  double operator()(std::size_t tooth, double h) noexcept {
    Anchor& anchor = anchors_[tooth];
    const double x = h * anchor.per_h - 1;
    if (!(std::abs(x) < near)) {
      return renew(anchor, h);
    }
    const auto& c = series_;
    const double x_2 = x * x;
    const double x_4 = x_2 * x_2;
    const double x_8 = x_4 * x_4;
    const double low = ((1 + c[1] * x) + x_2 * (c[2] + c[3] * x)) +
                       x_4 * ((c[4] + c[5] * x) + x_2 * (c[6] + c[7] * x));
    const double high = ((c[8] + c[9] * x) + x_2 * (c[10] + c[11] * x)) +
                        x_4 * ((c[12] + c[13] * x) + x_2 * (c[14] + c[15] * x));
    return anchor.value * (low + x_8 * high);
  }

 private:
  struct Anchor {
    double per_h = 0.0;
    double value = 0.0;
  };
  double renew(Anchor& anchor, double h) const noexcept;

  /// Sixteen terms leave 4e-13 then.
  static constexpr double near = 1.0 / 6;
  double m_;
  std::array<double, 16> series_{};
  std::vector<Anchor> anchors_;  ///< of each tooth
};

}  // namespace trochoid::dynamics
