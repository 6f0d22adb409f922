#include <trochoid/dynamics/steady_state.h>

#include <trochoid/base/units.h>
#include <trochoid/dynamics/growth.h>
#include <trochoid/dynamics/vibration.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace trochoid::dynamics {

namespace {

/// Late over earlier changes from turn to turn within which a large vibration stays what
/// it is, and a small one.
constexpr std::array<double, 2> steady_large = {0.7, 1.3};
constexpr std::array<double, 2> steady_small = {0.95, 1.05};
/// How far from 1 the persistence of a period may be that is there to stay.
constexpr double persistent = 0.02;
/// How often the number of turns is doubled until the motion tells.
constexpr int most_doublings = 3;
/// A period of its own is there to stay where it has lost no more of its size than this
/// after twice the turns.
constexpr double lost_size = 0.05;
/// Changes from turn to turn, as fractions of the feed per tooth. Below the first no tooth
/// leaves the cut, and nothing limits a vibration that grows; above the second teeth do.
constexpr double small_turn_change = 0.2;
constexpr double large_change = 2.0;
/// And below this they are rounding.
constexpr double no_change = 1e-6;

bool grows(const Motion& m) {
  return m.growth.value_or(0.0) > chatter_growth;
}

Periodic periodic_of(const MotionProblem& problem, const Motion& m) {
  const bool alike = !problem.command && force::teeth_alike(problem.setup);
  return {.passes = *m.passes,
          .passes_of_cut = alike ? 1 : static_cast<int>(m.flutes.size())};
}

/// What the changes from turn to turn say of a motion.
enum class Trend { fades, grows, stays };

Trend trend_of(const MotionProblem& problem, const Motion& m) {
  const auto late = late_change(m.once);
  if (!late) {
    return Trend::fades;  // too few turns to say more
  }
  const double f_z = std::abs(problem.setup.cut.f_z);
  const double size = late_size(m.once);
  const auto& [least, most] =
      size < small_turn_change * f_z ? steady_small : steady_large;
  if (*late < least) {
    return Trend::fades;
  }
  return *late > most && size < large_change * f_z ? Trend::grows : Trend::stays;
}

/// Whether what repeats within the tolerance is there to stay. A small vibration may still
/// grow; and a transient that goes to and fro, or round in nearly so many turns, repeats
/// as well while it fades.
bool has_settled(const MotionProblem& problem, const Motion& m) {
  if (periodic_of(problem, m).several_periods()) {
    return std::abs(m.persistence - 1) <= persistent;
  }
  return !(grows(m) && trend_of(problem, m) == Trend::grows &&
           late_size(m.once) > no_change * std::abs(problem.setup.cut.f_z));
}

/// Growth in a turn: of the small vibration, or of the changes where that is not seen.
std::optional<double> growth_of(const Motion& m) {
  if (grows(m)) {
    return m.growth;
  }
  const auto late = late_change(m.once);
  const double turns = static_cast<double>(m.once.size() - 1) / 4;
  return late && *late > 1 && m.finite ? std::optional(std::pow(*late, 1 / turns))
                                       : std::nullopt;
}

std::array<double, 2> half_range(const System& system, const Motion& m) {
  std::array<double, 2> low{};
  std::array<double, 2> high{};
  for (std::size_t i = 0; i < m.time.size(); ++i) {
    std::array<double, 2> q{};
    for (std::size_t r = 0; r < system.modes.size(); ++r) {
      q[0] += system.modes[r].x * m.mode[r][i];
      q[1] += system.modes[r].y * m.mode[r][i];
    }
    for (std::size_t c = 0; c < 2; ++c) {
      low[c] = i > 0 ? std::min(low[c], q[c]) : q[c];
      high[c] = i > 0 ? std::max(high[c], q[c]) : q[c];
    }
  }
  return {0.5 * (high[0] - low[0]), 0.5 * (high[1] - low[1])};
}

/// The same motion again, looked at over many turns.
Bounded vibration_of(MotionProblem problem, Motion& m) {
  const SpectrumSamples samples = spectrum_samples(problem, m.turns_done);
  problem.revolutions = m.turns_done;
  problem.kept = samples.turns;
  problem.watched = samples.turns;
  problem.samples_per_rev = samples.per_turn;
  const Motion again = motion(problem);
  m.flutes = again.flutes;
  m.peak = again.peak;
  const double spindle = problem.setup.cut.Omega / unit::turn;
  Spectrum spectrum = spectrum_of(problem.system, again);
  return {.fades = false,
          .amplitude = half_range(problem.system, again),
          .turns = samples.turns,
          .lines = lines_of(spectrum, spindle),
          .spectrum_step = spectrum.step,
          .spectrum = std::move(spectrum.amplitude)};
}

/// Of a motion that does not repeat and is followed no further.
Verdict verdict_after(const MotionProblem& problem, Motion& m, Trend trend) {
  switch (trend) {
    case Trend::grows:
      return Growing{growth_of(m)};
    case Trend::fades:
      return Bounded{.fades = true};
    case Trend::stays:
      if (m.passes && m.persistence > 1 - persistent) {
        return periodic_of(problem, m);
      }
      return vibration_of(problem, m);
  }
  return {};
}

double difference_of(const Motion& m, double FluteMotion::*value) {
  std::vector<double> values;
  for (const FluteMotion& flute : m.flutes) {
    values.push_back(flute.*value);
  }
  return relative_difference(values);
}

/// How large what a vibration with a period of its own adds to that of the cut is [m]: to
/// and fro from turn to turn, or from tooth to tooth within the turn.
double own_size(const Motion& m) {
  const auto [least, most] = std::ranges::minmax(m.flutes, {}, &FluteMotion::peak_chip);
  return std::max(late_size(m.once), most.peak_chip - least.peak_chip);
}

/// Whether a period of its own was no larger in a shorter run. A transient that goes round
/// in nearly so many teeth repeats within the tolerance while it fades.
class PeriodOfItsOwn {
 public:
  bool confirmed(const MotionProblem& problem, const Motion& m) {
    const double size = own_size(m);
    const bool stays = passes_ == *m.passes && size >= (1 - lost_size) * size_;
    passes_ = *m.passes;
    size_ = size;
    return stays || size < no_change * std::abs(problem.setup.cut.f_z);
  }

 private:
  int passes_ = 0;
  double size_ = 0.0;
};

}  // namespace

double relative_difference(std::span<const double> values) noexcept {
  if (values.empty()) {
    return 0.0;
  }
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  return *high > 0 ? (*high - *low) / *high : 0.0;
}

double peak_difference(const Motion& motion) {
  return difference_of(motion, &FluteMotion::peak_y);
}

double area_difference(const Motion& motion) {
  return difference_of(motion, &FluteMotion::chip_area);
}

double largest_component(const Motion& motion) {
  double largest = 0.0;
  for (const FluteMotion& flute : motion.flutes) {
    largest = std::max({largest, flute.peak_x, flute.peak_y});
  }
  return largest;
}

Verdict verdict_so_far(const MotionProblem& problem, const Motion& m) {
  if (!m.finite || !m.solved) {
    return Growing{growth_of(m)};
  }
  if (m.passes && has_settled(problem, m)) {
    return periodic_of(problem, m);
  }
  const bool shakes = m.last_change > chatter_change * largest_component(m);
  return Bounded{.fades = !grows(m) && !shakes};
}

bool walls_repeat(const SteadyState& steady) {
  const auto* bounded = std::get_if<Bounded>(&steady.verdict);
  return bounded != nullptr ? bounded->fades : repeats_every_turn(steady.motion);
}

SteadyState steady_state(MotionProblem problem, const TurnsProgress& progress) {
  problem.revolutions = std::max(problem.revolutions, fewest_turns);
  PeriodOfItsOwn own;
  for (int doubled = 0;; ++doubled) {
    if (progress) {
      progress(problem.revolutions);
    }
    Motion m = motion(problem);
    if (!m.finite || !m.solved) {
      const auto growth = growth_of(m);
      return {std::move(m), Growing{growth}};
    }
    const bool repeats = m.passes && has_settled(problem, m);
    if (repeats) {
      const Periodic verdict = periodic_of(problem, m);
      if (!verdict.several_periods() || own.confirmed(problem, m)) {
        return {std::move(m), verdict};
      }
    }
    const Trend trend = trend_of(problem, m);
    const bool saturated = trend == Trend::stays && grows(m);
    if ((saturated && !repeats) || doubled == most_doublings) {
      Verdict verdict = verdict_after(problem, m, trend);
      return {std::move(m), std::move(verdict)};
    }
    problem.revolutions *= 2;
  }
}

}  // namespace trochoid::dynamics
