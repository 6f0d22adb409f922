#include <trochoid/surface/written_profile.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

namespace trochoid::surface {
namespace {

constexpr int first_looks = 1024;
/// CandidatePasses that stay farther above all others than this part of the height of the profile
/// are not looked at again.
constexpr int looks_to_choose = 64;
/// Changes are found to this part of the period.
constexpr double resolution_of_period = 1e-14;

/// Who is lowest at a place.
struct LowestPass {
  std::size_t pass = 0;
  int part = 0;
  double height = std::numeric_limits<double>::infinity();

  [[nodiscard]] bool same(const LowestPass& other) const noexcept {
    return pass == other.pass && part == other.part;
  }
};

/// All passes of a profile.
struct CandidatePasses {
  double period = 0.0;
  std::vector<ProfilePass> all;
  std::function<PassPoint(const ProfilePass&, double)> at;

  [[nodiscard]] LowestPass lowest(double x) const {
    LowestPass best;
    for (std::size_t i = 0; i < all.size(); ++i) {
      const PassPoint point = at(all[i], x);
      if (point.height < best.height) best = {i, point.part, point.height};
    }
    return best;
  }

  /// Keep those that may be lowest somewhere.
  void choose() {
    std::vector<std::vector<double>> heights(all.size());
    double highest = -std::numeric_limits<double>::infinity();
    for (int i = 0; i <= looks_to_choose; ++i) {
      const double x = period * i / looks_to_choose;
      double least = std::numeric_limits<double>::infinity();
      for (std::size_t k = 0; k < all.size(); ++k) {
        heights[k].push_back(at(all[k], x).height);
        least = std::min(least, heights[k].back());
      }
      highest = std::max(highest, least);
    }
    // Between two looks a pass falls by no more than it does beside them.
    std::vector<ProfilePass> kept;
    for (std::size_t k = 0; k < all.size(); ++k) {
      const std::vector<double>& z = heights[k];
      bool near = false;
      for (std::size_t i = 0; i + 1 < z.size() && !near; ++i) {
        const double fall =
            std::isfinite(z[i] + z[i + 1]) ? std::abs(z[i] - z[i + 1]) : 0.0;
        near = std::min(z[i], z[i + 1]) - fall <= highest;
      }
      if (near) kept.push_back(all[k]);
    }
    all = std::move(kept);
  }
};

class Halving {
 public:
  explicit Halving(const CandidatePasses& passes) : passes_(passes) {}

  void between(double from, const LowestPass& a, double to, const LowestPass& b) {
    if (a.same(b)) return;
    const double middle = 0.5 * (from + to);
    if (to - from <= resolution_of_period * passes_.period || middle <= from ||
        middle >= to) {
      add(middle, b);
      return;
    }
    const LowestPass between_them = passes_.lowest(middle);
    between(from, a, middle, between_them);
    between(middle, between_them, to, b);
  }
  void add(double x, const LowestPass& from_here) {
    breaks.push_back(x);
    who.push_back(from_here);
  }

  std::vector<double> breaks = {};
  std::vector<LowestPass> who = {};

 private:
  const CandidatePasses& passes_;
};

}  // namespace

PeriodicProfile written_profile(
    double period, std::vector<ProfilePass> given,
    const std::function<PassPoint(const ProfilePass&, double x)>& at) {
  auto passes =
      std::make_shared<CandidatePasses>(CandidatePasses{period, std::move(given), at});
  passes->choose();
  Halving halving(*passes);
  LowestPass before = passes->lowest(0.0);
  halving.add(0.0, before);
  double from = 0.0;
  for (int i = 1; i <= first_looks; ++i) {
    const double x = i == first_looks ? period : period * i / first_looks;
    const LowestPass here = passes->lowest(x);
    halving.between(from, before, x, here);
    from = x;
    before = here;
  }
  PeriodicProfile out{
      .period = period, .breaks = halving.breaks, .tooth = {}, .height = {}};
  out.breaks.push_back(period);
  for (const LowestPass& one : halving.who) {
    out.tooth.push_back(passes->all[one.pass].tooth);
  }
  out.height = [passes, who = halving.who](std::size_t piece, double x) {
    const double height = passes->at(passes->all[who[piece].pass], x).height;
    // At the end of a piece its pass may be missing by rounding.
    return std::isfinite(height) ? height : passes->lowest(x).height;
  };
  return out;
}

}  // namespace trochoid::surface
