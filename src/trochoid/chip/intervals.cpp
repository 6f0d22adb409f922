#include <trochoid/chip/intervals.h>

#include <trochoid/base/units.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace trochoid::chip {

namespace {

using std::numbers::pi;
constexpr double resolution = 1e-13;  // [rad]

struct AroundTooth {
  const Passage& passage;
  const Slice& slice;
  int tooth;

  [[nodiscard]] ChipState state(double theta) const {
    return {chip_at(passage, slice, tooth, theta)};
  }
  [[nodiscard]] double boundary(double theta, const ChipState& a,
                                const ChipState& b) const {
    return chip::boundary(passage, slice, tooth, theta, a.chip, b.chip);
  }
};

/// Even steps, and the angles near which a short cut can hide: the front of the tool
/// and the edges of the stock, on either side.
std::vector<double> grid(const Passage& passage, const Slice& slice, int tooth,
                         double start) {
  constexpr int steps = 48;
  std::vector<double> x;
  for (int i = 0; i <= steps; ++i) {
    x.push_back(start + unit::turn * i / steps);
  }
  const geometry::EdgePosition& own = slice.teeth[static_cast<std::size_t>(tooth)];
  const auto add = [&](double theta) {
    const double u = theta - own.epsilon - start;
    x.push_back(start + u - unit::turn * std::floor(u / unit::turn));
  };
  add(pi / 2);
  for (const double y : {passage.stock.y_lo, passage.stock.y_hi}) {
    for (const double R : {slice.r, own.R}) {
      if (std::abs(y) < R) {
        const double edge = std::acos(y / R);
        for (const double side : {-1e-3, -1e-6, 0.0, 1e-6, 1e-3}) {
          add(edge + side);
        }
        add(edge / 2);
        add((pi + edge) / 2);
      }
    }
  }
  for (const geometry::EngagedArc& engaged : slice.arcs) {
    for (const double edge : {engaged.arc.from, engaged.arc.to}) {
      for (const double side : {-1e-3, -1e-6, 0.0, 1e-6, 1e-3}) {
        add(edge + side);
      }
    }
    add(0.5 * (engaged.arc.from + engaged.arc.to));
  }
  std::sort(x.begin(), x.end());
  return x;
}

}  // namespace

std::vector<ChipPiece> engaged_pieces(const Passage& passage, const Slice& slice,
                                      int tooth, double start) {
  const AroundTooth curve{passage, slice, tooth};
  numerics::PieceFinder<AroundTooth> finder(curve, resolution);
  std::vector<ChipPiece> pieces;
  finder.find(grid(passage, slice, tooth, start), pieces);
  return pieces;
}

Arc tooth_arc(const geometry::Engagement& engagement, double D, double R_j) {
  const geometry::Band stock = geometry::stock_band(engagement, D);
  return {std::acos(std::clamp(stock.y_hi / R_j, -1.0, 1.0)),
          std::acos(std::clamp(stock.y_lo / R_j, -1.0, 1.0))};
}

std::vector<Arc> engaged_arcs(const Passage& passage, const Slice& slice, int tooth) {
  // Start the turn opposite to the front, where nothing but a tip is ever in cut.
  std::vector<Arc> arcs;
  for (const ChipPiece& piece : engaged_pieces(passage, slice, tooth, -pi / 2)) {
    if (!arcs.empty() && piece.from - arcs.back().to <= 2 * resolution) {
      arcs.back().to = piece.to;
    } else {
      arcs.push_back({piece.from, piece.to});
    }
  }
  return arcs;
}

}  // namespace trochoid::chip
