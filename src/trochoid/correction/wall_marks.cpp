#include <trochoid/correction/wall_marks.h>

#include <trochoid/base/units.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace trochoid::correction {

namespace {

/// Over a feed per turn, and which of them are returned.
constexpr int wall_samples = 8000;
constexpr int every = 20;
/// Just inside of the cut, where a square has not changed yet or has changed already.
constexpr double beside_mark = 1e-6;

/// A circle left by a tooth.
struct Mark {
  std::size_t tooth = 0;
  double x = 0.0;
  double depth = 0.0;
};

/// The tooth that reaches deepest at x, and how deep.
Mark deepest_at(const std::vector<Mark>& marks, double x, double radius) {
  Mark deepest{0, x, -std::numeric_limits<double>::infinity()};
  for (const Mark& m : marks) {
    const double depth = m.depth - (x - m.x) * (x - m.x) / (2 * radius);
    if (depth > deepest.depth) {
      deepest = {m.tooth, x, depth};
    }
  }
  return deepest;
}

}  // namespace

WallMarks wall_marks(const RigidCut& cut, const PeriodicMotion& X, bool exit) {
  const std::vector<double> rho = cut.offsets();
  const double f = cut.feed();
  const double at = exit ? unit::turn / 2 - beside_mark : beside_mark;
  std::vector<Mark> marks;
  for (int k = -2; k <= 2; ++k) {
    for (std::size_t j = 0; j < rho.size(); ++j) {
      const double phi = cut.psi()[j] + at;
      marks.push_back({j, f * (k + phi / unit::turn) - place_at(X, phi), rho[j]});
    }
  }
  WallMarks out;
  out.share.assign(rho.size(), 0.0);
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (int i = 0; i < wall_samples; ++i) {
    const double x = f * i / wall_samples;
    const Mark deepest = deepest_at(marks, x, cut.radius());
    low = std::min(low, deepest.depth);
    high = std::max(high, deepest.depth);
    out.share[deepest.tooth] += 1.0 / wall_samples;
    if (i % every == 0) {
      out.x.push_back(x);
      out.depth.push_back(deepest.depth);
    }
  }
  out.peak_to_valley = high - low;
  return out;
}

}  // namespace trochoid::correction
