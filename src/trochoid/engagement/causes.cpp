#include <trochoid/engagement/causes.h>

#include <trochoid/base/units.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace trochoid::engagement {

namespace {

constexpr double sharp = 15 * unit::deg;
constexpr double nearly_half = 0.05;  ///< short of pi [rad]
constexpr double above_median = 1.15;
constexpr double plunge_steepness = 10.0;
constexpr double near_peak = 0.99;

bool feeds_sideways(const stock::Piece& piece) noexcept {
  return piece.feed > 0 && !piece.upright();
}

double median_engaged(std::span<const Step> steps, std::span<const StepTraits> traits) {
  std::vector<double> engaged;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    if (traits[i].stock && steps[i].a_p > 0) engaged.push_back(steps[i].engaged);
  }
  if (engaged.empty()) return 0.0;
  std::ranges::sort(engaged);
  const std::size_t n = engaged.size();
  return 0.5 * (engaged[(n - 1) / 2] + engaged[n / 2]);
}

/// Path from a place to the nearest kink [m].
double to_kink(std::span<const Kink> kinks, double at) noexcept {
  const auto next = std::ranges::lower_bound(kinks, at, {}, &Kink::at);
  double nearest = std::numeric_limits<double>::infinity();
  if (next != kinks.end()) nearest = next->at - at;
  if (next != kinks.begin()) nearest = std::min(nearest, at - std::prev(next)->at);
  return nearest;
}

struct Around {
  const stock::Path& path;
  std::span<const Kink> kinks;
  double median;
  bool before;  ///< stock in the step before
  bool after;
};

Cause cause_of(const Step& step, const StepTraits& t, const Around& around) {
  const stock::Piece& piece = around.path.pieces[t.piece];
  if (!t.stock) return Cause::air;
  if (t.bottom) {
    return t.f_a > plunge_steepness * t.f_h ? Cause::plunge : Cause::ramp;
  }
  if (step.engaged > unit::turn / 2 - nearly_half) return Cause::slot;
  if (piece.arc() && piece.radius < 2 * t.R && std::abs(piece.turn) > sharp) {
    return Cause::corner;
  }
  if (step.engaged > above_median * around.median &&
      to_kink(around.kinks, t.at) <= 2 * t.R) {
    return Cause::corner;
  }
  if (!around.before) return Cause::entry;
  return around.after ? Cause::side : Cause::exit;
}

}  // namespace

std::vector<double> feed_lengths(const stock::Path& path) {
  std::vector<double> out;
  out.reserve(path.pieces.size());
  double sum = 0.0;
  for (const stock::Piece& piece : path.pieces) {
    out.push_back(sum);
    if (piece.feed > 0) sum += piece.length;
  }
  return out;
}

std::vector<Kink> kinks(const stock::Path& path) {
  std::vector<Kink> out;
  double at = 0.0;
  for (std::size_t i = 0; i < path.pieces.size(); ++i) {
    const stock::Piece& piece = path.pieces[i];
    if (i > 0 && feeds_sideways(piece) && feeds_sideways(path.pieces[i - 1]) &&
        path.pieces[i - 1].tool == piece.tool) {
      const double before = stock::point_at(path.pieces[i - 1], 1.0).direction;
      const double after = stock::point_at(piece, 0.0).direction;
      if (std::abs(std::remainder(after - before, unit::turn)) > sharp) {
        out.push_back({at, piece.turns_from});
      }
    }
    if (piece.feed > 0) at += piece.length;
  }
  return out;
}

void find_causes(const stock::Path& path, std::span<const Kink> kinks,
                 std::span<const StepTraits> traits, std::span<Step> steps) {
  const double median = median_engaged(steps, traits);
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const bool before = i == 0 || traits[i - 1].stock;
    const bool after = i + 1 == steps.size() || traits[i + 1].stock;
    const Around around{path, kinks, median, before, after};
    steps[i].cause = cause_of(steps[i], traits[i], around);
    const auto next = std::ranges::upper_bound(kinks, traits[i].at, {}, &Kink::at);
    if (next == kinks.begin() || !traits[i].stock) continue;
    const stock::Piece& piece = path.pieces[traits[i].piece];
    const double behind = traits[i].at - std::prev(next)->at;
    if (piece.turns_to > piece.turns_from && behind < piece.feed_per_turn()) {
      steps[i].flags |= straight_after_corner;
    }
  }
}

Cause cause_of_line(std::span<const Step> steps) {
  double peak = 0.0;
  for (const Step& step : steps) peak = std::max(peak, step.forces.peak_xy);
  std::array<std::int64_t, 8> votes{};
  for (const Step& step : steps) {
    if (step.cause != Cause::air && step.forces.peak_xy >= near_peak * peak) {
      votes[static_cast<std::size_t>(step.cause)] += step.count;
    }
  }
  return static_cast<Cause>(std::ranges::max_element(votes) - votes.begin());
}

}  // namespace trochoid::engagement
