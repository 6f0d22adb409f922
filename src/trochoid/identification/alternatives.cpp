#include <trochoid/identification/alternatives.h>

#include <trochoid/identification/identify.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <variant>
#include <vector>

namespace trochoid::identification {

namespace {

/// Another cut is worth a word where it leaves so much less (rms).
constexpr double least_of_other_cut = 0.5;
/// Harmonics of the spindle: three of the teeth of most cutters.
constexpr int harmonics_compared = 18;
constexpr std::array tooth_counts{1, 2, 3, 4, 5, 6, 8};
/// Offsets of more teeth take long to find, and are not worth it here.
constexpr int few_teeth = 4;

/// The records, and how the stated cut would be fitted to them.
struct StatedCut {
  force::Setup setup;  ///< without runout
  force::Law law;
  std::span<const Run> runs;
  Options options;

  [[nodiscard]] double left(const force::Setup& with, std::span<const Run> others,
                            RunoutUnknowns runout) const {
    const Options quick{.chip_model = options.chip_model,
                        .runout = runout,
                        .phase = options.phase,
                        .band_harmonics = harmonics_compared,
                        .errors = Errors::white};
    const Fit fit = identify(with, law, others, quick);
    return fit.ok ? fit.rms : std::numeric_limits<double>::infinity();
  }
};

/// The runs with another number of teeth, which feed the same in a turn.
double left_by_teeth(const StatedCut& stated, int teeth) {
  force::Setup setup = stated.setup;
  setup.cutter.pitch = geometry::equal_pitch(teeth);
  std::vector<Run> others(stated.runs.begin(), stated.runs.end());
  for (Run& run : others) run.cut.f_z *= double(stated.setup.cutter.teeth()) / teeth;
  return stated.left(setup, others, RunoutUnknowns::none);
}

/// The same engagement milled the other way round; none: there is no such.
bool reverse(geometry::Engagement& engagement) {
  if (const auto* up = std::get_if<geometry::UpMilling>(&engagement)) {
    engagement = geometry::DownMilling{up->a_e};
    return true;
  }
  if (const auto* down = std::get_if<geometry::DownMilling>(&engagement)) {
    engagement = geometry::UpMilling{down->a_e};
    return true;
  }
  return false;
}

/// The runs with x and y turned back, so many times as far as the spindle turned.
std::vector<Run> turned_back(std::span<const Run> runs, int times) {
  std::vector<Run> out(runs.begin(), runs.end());
  for (Run& run : out) {
    for (std::size_t i = 0; i < run.angle.size(); ++i) {
      const double c = std::cos(times * run.angle[i]);
      const double s = std::sin(times * run.angle[i]);
      auto& F = run.force[i];
      F = {c * F[0] + s * F[1], -s * F[0] + c * F[1], F[2]};
    }
  }
  return out;
}

/// Where its axes stood is not known: on a cylinder that mixes tangential and radial
/// coefficients and changes nothing of what is left.
std::optional<BetterCut> turning_dynamometer(const StatedCut& stated) {
  const double now = stated.left(stated.setup, stated.runs, RunoutUnknowns::none);
  double least = least_of_other_cut * now;
  std::optional<BetterCut> found;
  for (const int times : {1, -1}) {
    const double other = stated.left(stated.setup, turned_back(stated.runs, times),
                                     RunoutUnknowns::none);
    if (!(other < least)) continue;
    least = other;
    found = BetterCut{
        .teeth = {}, .turns_with_spindle = times, .rms = other, .stated_rms = now};
  }
  return found;
}

/// Offsets would let a cutter of too many teeth explain everything: some never cut.
std::optional<BetterCut> better_count(const StatedCut& stated) {
  const double now = stated.left(stated.setup, stated.runs, RunoutUnknowns::none);
  double least = least_of_other_cut * now;
  std::optional<BetterCut> found;
  for (const int teeth : tooth_counts) {
    if (teeth == stated.setup.cutter.teeth()) continue;
    const double other = left_by_teeth(stated, teeth);
    if (!(other < least)) continue;
    least = other;
    found = BetterCut{.teeth = teeth, .rms = other, .stated_rms = now};
  }
  return found;
}

std::optional<BetterCut> better_direction(const StatedCut& stated) {
  std::vector<Run> reversed(stated.runs.begin(), stated.runs.end());
  for (Run& run : reversed) {
    if (!reverse(run.cut.engagement)) return std::nullopt;
  }
  const RunoutUnknowns runout = stated.setup.cutter.teeth() <= few_teeth
                                    ? RunoutUnknowns::offsets
                                    : RunoutUnknowns::none;
  const double now = stated.left(stated.setup, stated.runs, runout);
  const double other = stated.left(stated.setup, reversed, runout);
  if (!(other < least_of_other_cut * now)) return std::nullopt;
  const geometry::Engagement& engagement = reversed.front().cut.engagement;
  return BetterCut{.teeth = {},
                   .up = std::holds_alternative<geometry::UpMilling>(engagement),
                   .rms = other,
                   .stated_rms = now};
}

}  // namespace

std::optional<BetterAxes> better_axes(const AxesProblem& problem,
                                      std::span<const ChannelRun> runs,
                                      const signal::Matrix3& M, double least,
                                      const std::function<void(double)>& told) {
  for (const ChannelRun& run : runs) {  // what no search can find is no cause
    if (!std::ranges::all_of(run.measured, std::identity())) return std::nullopt;
  }
  const AxesChoice other = find_axes(problem, runs, told);
  const double now = reading_rms(problem, runs, M);
  if (!other.ok || !(other.rms < least * now)) return std::nullopt;
  return BetterAxes{other.matrix, other.rms, now};
}

bool fits_better(const AxesProblem& problem, std::span<const ChannelRun> runs,
                 const signal::Matrix3& M, const signal::Matrix3& other, double least) {
  const auto left = [&](const signal::Matrix3& reading) {
    const Fit fit =
        identify(problem.setup, problem.law, on_tool(runs, reading), problem.options);
    return fit.ok ? fit.rms : std::numeric_limits<double>::infinity();
  };
  return left(other) < least * left(M);
}

std::optional<BetterCut> better_cut(const force::Setup& setup, const force::Law& law,
                                    std::span<const Run> runs, const Options& options) {
  StatedCut stated{setup, law, runs, options};
  stated.setup.runout = {};
  const auto direction = better_direction(stated);
  if (direction) return direction;
  const auto count = better_count(stated);
  const auto turning = turning_dynamometer(stated);
  return turning && (!count || turning->rms < count->rms) ? turning : count;
}

}  // namespace trochoid::identification
