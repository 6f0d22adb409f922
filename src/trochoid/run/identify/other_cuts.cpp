#include <trochoid/run/identify/other_cuts.h>

#include <fmt/core.h>

#include <array>
#include <limits>
#include <variant>
#include <vector>

namespace trochoid::run {

namespace {

using identification::Run;
using identification::RunoutUnknowns;

/// Another cut is worth a word where it leaves so much less (rms).
constexpr double much_better = 0.5;
/// Harmonics of the spindle: three of the teeth of most cutters.
constexpr int harmonics = 18;
constexpr std::array counts{1, 2, 3, 4, 5, 6, 8};
/// Offsets of more teeth take long to find, and are not worth it here.
constexpr int few_teeth = 4;

double left(const inputs::Case& given, const force::Setup& setup,
            std::span<const Run> runs, RunoutUnknowns runout) {
  const identification::Options options{.chip_model = given.identify.chip_models.back(),
                                        .runout = runout,
                                        .phase = given.identify.phase,
                                        .band_harmonics = harmonics,
                                        .errors = identification::Errors::white};
  const auto fit = identification::identify(setup, given.law, runs, options);
  return fit.ok ? fit.rms : std::numeric_limits<double>::infinity();
}

/// The runs with another number of teeth, which feed the same in a turn.
double left_by_teeth(const inputs::Case& given, std::span<const Run> runs, int teeth) {
  force::Setup setup = given.setup;
  setup.cutter.pitch = geometry::equal_pitch(teeth);
  setup.runout = {};
  std::vector<Run> others(runs.begin(), runs.end());
  for (Run& run : others) run.cut.f_z *= double(given.setup.cutter.teeth()) / teeth;
  return left(given, setup, others, RunoutUnknowns::none);
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

/// `2.4 times`, or `far` where one explains all and the other nothing.
std::string how_much(double now, double other) {
  constexpr double far = 100.0;
  return now < far * other ? fmt::format("{:.1f} times", now / other)
                           : std::string("far");
}

/// Offsets would let a cutter of too many teeth explain everything: some never cut.
std::string better_count(const inputs::Case& given, std::span<const Run> runs) {
  force::Setup setup = given.setup;
  setup.runout = {};
  const double now = left(given, setup, runs, RunoutUnknowns::none);
  double least = much_better * now;
  std::string found;
  for (const int teeth : counts) {
    if (teeth == given.setup.cutter.teeth()) continue;
    const double other = left_by_teeth(given, runs, teeth);
    if (!(other < least)) continue;
    least = other;
    found = fmt::format(
        "The number of teeth: with teeth = {} (and the same feed in a turn) the fit "
        "leaves {} less than with {}.",
        teeth, how_much(now, other), given.setup.cutter.teeth());
  }
  return found;
}

std::string better_direction(const inputs::Case& given, std::span<const Run> runs) {
  std::vector<Run> reversed(runs.begin(), runs.end());
  for (Run& run : reversed) {
    if (!reverse(run.cut.engagement)) return "";
  }
  force::Setup setup = given.setup;
  setup.runout = {};
  const RunoutUnknowns runout = setup.cutter.teeth() <= few_teeth
                                    ? RunoutUnknowns::offsets
                                    : RunoutUnknowns::none;
  const double now = left(given, setup, runs, runout);
  const double other = left(given, setup, reversed, runout);
  if (!(other < much_better * now)) return "";
  const bool up =
      std::holds_alternative<geometry::UpMilling>(reversed.front().cut.engagement);
  return fmt::format("Up for down: with engagement = \"{}\" the fit leaves {} less.",
                     up ? "up" : "down", how_much(now, other));
}

}  // namespace

std::string better_cut(const inputs::Case& given, std::span<const Run> runs) {
  const std::string direction = better_direction(given, runs);
  return direction.empty() ? better_count(given, runs) : direction;
}

}  // namespace trochoid::run
