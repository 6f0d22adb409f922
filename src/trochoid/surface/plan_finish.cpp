#include <trochoid/surface/plan_finish.h>

#include <trochoid/base/overloaded.h>
#include <trochoid/numerics/parallel.h>
#include <trochoid/surface/flat_trace.h>
#include <trochoid/surface/tooth_profiles.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

namespace trochoid::surface {
namespace {

constexpr std::size_t sets_drawn = 200;  // W-9
constexpr std::size_t sets_within = 190;

/// Offsets of other sets of inserts, in parts of the tolerance, shape (sets, teeth).
std::vector<std::vector<double>> drawn_sets(std::size_t teeth) {
  constexpr double bits = 1.0 / 9007199254740992.0;  // 2^-53
  std::mt19937_64 random(1);
  std::vector<std::vector<double>> out(sets_drawn, std::vector<double>(teeth));
  for (auto& set : out) {
    for (double& offset : set) offset = static_cast<double>(random() >> 11U) * bits;
  }
  return out;
}

double Ra_as_is(const force::Setup& setup, const TraceLine& line,
                std::optional<double> cutoff) {
  const PeriodicProfile profile = std::visit(
      base::Overloaded{
          [&](const FloorTrace& f) { return floor_profile(setup, f.bottom, f.y); },
          [&](const WallTrace& w) { return wall_profile(setup, w.height); }},
      line);
  return cutoff ? filtered_roughness(profile, *cutoff).Ra : roughness(profile).Ra;
}

/// Ra on all lines of sets of teeth, at one feed.
class Finish {
 public:
  Finish(const force::Setup& setup, const FinishPlan& plan, double f_z)
      : setup_(setup), plan_(plan) {
    setup_.cut.f_z = f_z;
  }

  [[nodiscard]] std::optional<double> as_is() const {
    double most = 0.0;
    for (const TraceLine& line : plan_.lines) {
      const double Ra = Ra_as_is(setup_, line, plan_.cutoff);
      if (!std::isfinite(Ra)) return std::nullopt;
      most = std::max(most, Ra);
    }
    return most;
  }
  [[nodiscard]] std::optional<double> alike() const {
    return largest_of({std::vector<double>(setup_.cutter.pitch.size(), 0.0)}, 0);
  }
  [[nodiscard]] std::optional<double> within(
      const std::vector<std::vector<double>>& parts) const {
    return largest_of(parts, sets_within - 1);
  }

 private:
  /// The Ra that so many of the sets stay below, on the worst of the lines.
  [[nodiscard]] std::optional<double> largest_of(
      const std::vector<std::vector<double>>& parts, std::size_t below) const {
    double most = 0.0;
    for (const TraceLine& line : plan_.lines) {
      const ToothProfiles profiles(teeth_alone(setup_, line), plan_.cutoff);
      if (!profiles.reach_everywhere()) return std::nullopt;
      std::vector<double> Ra;
      for (std::vector<double> depth : parts) {
        for (double& d : depth) d *= plan_.within;
        Ra.push_back(average_roughness(profiles.written(depth, false).height));
      }
      std::ranges::nth_element(Ra, Ra.begin() + static_cast<std::ptrdiff_t>(below));
      most = std::max(most, Ra[below]);
    }
    return most;
  }

  force::Setup setup_;
  const FinishPlan& plan_;
};

using RaOfFeed = std::function<std::optional<double>(double f_z)>;

/// @brief The largest feed up to which Ra keeps the limit.
/// @param known  Ra at the feeds of the plan
std::optional<double> largest_feed(const FinishPlan& plan,
                                   const std::vector<std::optional<double>>& known,
                                   const RaOfFeed& Ra_at) {
  const auto keeps = [&](std::optional<double> Ra) { return Ra && *Ra <= *plan.limit; };
  const auto broken = std::ranges::find_if_not(known, keeps);
  if (broken == known.begin()) return std::nullopt;
  if (broken == known.end()) return plan.feeds.back();
  const auto at = static_cast<std::size_t>(broken - known.begin());
  double low = plan.feeds[at - 1];
  double high = plan.feeds[at];
  for (int i = 0; i < 12; ++i) {
    const double middle = 0.5 * (low + high);
    (keeps(Ra_at(middle)) ? low : high) = middle;
  }
  return low;
}

}  // namespace

PlannedFinish plan_finish(const force::Setup& setup, const FinishPlan& plan) {
  const auto parts = drawn_sets(setup.cutter.pitch.size());
  const RaOfFeed as_is = [&](double f_z) { return Finish(setup, plan, f_z).as_is(); };
  const RaOfFeed alike = [&](double f_z) { return Finish(setup, plan, f_z).alike(); };
  const RaOfFeed within = [&](double f_z) {
    return Finish(setup, plan, f_z).within(parts);
  };
  PlannedFinish out{.feeds = std::vector<FinishOfFeed>(plan.feeds.size()),
                    .largest = {}};
  numerics::for_each_index(plan.feeds.size(), [&](std::size_t i) {
    const double f_z = plan.feeds[i];
    out.feeds[i] = {f_z, {as_is(f_z), within(f_z), alike(f_z)}};
  });
  if (!plan.limit) return out;
  const auto largest = [&](std::optional<double> OfSets::*which,
                           const RaOfFeed& Ra_at) {
    std::vector<std::optional<double>> known;
    for (const FinishOfFeed& feed : out.feeds) known.push_back(feed.Ra.*which);
    return largest_feed(plan, known, Ra_at);
  };
  out.largest = {largest(&OfSets::as_is, as_is), largest(&OfSets::within, within),
                 largest(&OfSets::alike, alike)};
  return out;
}

}  // namespace trochoid::surface
