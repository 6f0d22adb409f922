#include <trochoid/chip/volume.h>

#include <trochoid/base/units.h>
#include <trochoid/chip/intervals.h>
#include <trochoid/numerics/gauss_kronrod.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace trochoid::chip {

Removal removal(const Passage& passage, const Slice& slice) {
  using std::numbers::pi;
  const double feed = passage.feed;
  double widest = 0.0;
  for (const geometry::EdgePosition& p : slice.teeth) {
    widest = std::max(widest, p.R);
  }
  const double low = std::max(passage.stock.y_lo, -widest);
  const double high = std::min(passage.stock.y_hi, widest);
  double width = std::max(0.0, high - low);
  if (passage.by_arcs) {
    width = 0.0;
    for (const geometry::EngagedArc& engaged : slice.arcs) {
      width += widest * (std::cos(std::clamp(engaged.arc.from, 0.0, pi)) -
                         std::cos(std::clamp(engaged.arc.to, 0.0, pi)));
    }
  }
  Removal result{.available = unit::turn * feed * width};
  std::array<double, 1> sum{};
  const std::array<double, 1> allowed{1e-9 * result.available};
  for (int j = 0; j < passage.teeth; ++j) {
    const double epsilon = slice.teeth[static_cast<std::size_t>(j)].epsilon;
    const auto area = [&](double theta, double weight, std::array<double, 1>& out) {
      const Chip c = chip_at(passage, slice, j, theta);
      const double turn = feed * std::cos(theta + epsilon);
      out[0] += weight * c.h * (c.outer - 0.5 * c.h + turn);  // C-8
    };
    for (const ChipPiece& piece : engaged_pieces(passage, slice, j, -pi / 2)) {
      numerics::add_integral(piece.from, piece.to, area, allowed, 1e-9, sum);
    }
  }
  result.removed = sum[0];
  return result;
}

}  // namespace trochoid::chip
