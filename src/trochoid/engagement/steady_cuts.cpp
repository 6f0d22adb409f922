#include <trochoid/base/units.h>
#include <trochoid/engagement/look.h>
#include <trochoid/engagement/record_fit.h>
#include <trochoid/engagement/turn.h>
#include <trochoid/identification/identify.h>
#include <trochoid/signal/spindle_speed.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace trochoid::engagement {

namespace {

/// Parts that are used at most, and turns of each.
constexpr std::size_t most_cuts = 8;
constexpr double least_turns = 5.0;
constexpr double turns_of_a_cut = 16.0;
/// Samples that a tooth needs to show its force.
constexpr double samples_a_tooth = 8.0;
/// Turns whose forces differ by no more than this part are alike.
constexpr double same_force = 0.005;

/// Rows of steps from one to another.
struct SteadyRows {
  std::size_t from = 0;
  std::size_t to = 0;  ///< behind the last

  [[nodiscard]] std::size_t count() const noexcept { return to - from; }
  [[nodiscard]] std::size_t middle() const noexcept { return (from + to) / 2; }
};

/// Rows like a step that take so many turns.
std::size_t rows_of(const Step& step, double turns) noexcept {
  return std::max<std::size_t>(
      1, static_cast<std::size_t>(std::ceil(turns / step.turns - 1e-6)));
}

bool can_be_used(const Step& step, std::size_t tool) noexcept {
  const bool bottom = step.cause == Cause::plunge || step.cause == Cause::ramp;
  const std::size_t own = step.tool < 0 ? 0 : static_cast<std::size_t>(step.tool);
  return own == tool && step.a_p > 0 && step.turns > 0 && step.count == 1 && !bottom &&
         step.flags == 0 && step.curvature == 0;
}

bool same_cut(const Step& a, const Step& b) noexcept {
  if (a.line != b.line || a.direction != b.direction || a.spindle != b.spindle ||
      std::abs(a.feed - b.feed) > same_force * a.feed) {
    return false;
  }
  double difference = std::abs(a.forces.peak_xy - b.forces.peak_xy);
  for (std::size_t c = 0; c < 3; ++c) {
    difference = std::max(difference, std::abs(a.forces.mean[c] - b.forces.mean[c]));
  }
  return difference <= same_force * a.forces.peak_xy;
}

/// All stretches of turns alike, without what the time may be off at their ends.
/// @param margin  of the time [s]
std::vector<SteadyRows> stretches(std::span<const Step> steps, std::size_t tool,
                                  double margin) {
  std::vector<SteadyRows> out;
  for (std::size_t i = 0; i < steps.size();) {
    std::size_t k = i + 1;
    if (can_be_used(steps[i], tool)) {
      while (k < steps.size() && can_be_used(steps[k], tool) &&
             same_cut(steps[i], steps[k])) {
        ++k;
      }
      const auto less =
          1 + static_cast<std::size_t>(std::ceil(margin / steps[i].duration));
      if (k - i >= rows_of(steps[i], least_turns) + 2 * less) {
        out.push_back({i + less, k - less});
      }
    }
    i = k;
  }
  return out;
}

/// What makes a cut differ from another, each from 0 to about 1.
std::array<double, 4> signature(const Step& step, double f_z, double a_p) noexcept {
  return {step.entry / unit::turn, step.exit / unit::turn, step.f_z / f_z,
          step.a_p / a_p};
}

/// The longest one, then each time the one that is least like those chosen.
std::vector<SteadyRows> different_ones(std::span<const Step> steps,
                                       std::vector<SteadyRows> all) {
  double f_z = 0.0;
  double a_p = 0.0;
  for (const SteadyRows& one : all) {
    f_z = std::max(f_z, steps[one.middle()].f_z);
    a_p = std::max(a_p, steps[one.middle()].a_p);
  }
  std::vector<double> distance(all.size(), std::numeric_limits<double>::infinity());
  std::vector<SteadyRows> out;
  while (out.size() < std::min(most_cuts, all.size())) {
    std::size_t best = 0;
    for (std::size_t i = 1; i < all.size(); ++i) {
      if (std::pair(distance[i], all[i].count()) >
          std::pair(distance[best], all[best].count())) {
        best = i;
      }
    }
    out.push_back(all[best]);
    const auto chosen = signature(steps[all[best].middle()], f_z, a_p);
    for (std::size_t i = 0; i < all.size(); ++i) {
      const auto other = signature(steps[all[i].middle()], f_z, a_p);
      double sum = 0.0;
      for (std::size_t k = 0; k < other.size(); ++k) {
        sum += (other[k] - chosen[k]) * (other[k] - chosen[k]);
      }
      distance[i] = i == best ? -1.0 : std::min(distance[i], std::sqrt(sum));
    }
  }
  std::ranges::sort(out, {}, &SteadyRows::from);
  return out;
}

/// Samples of a part of the program, at times of the record.
struct Samples {
  signal::Record record;
  double stretch = 1.0;  ///< seconds of the record for a second of the program
};

Samples samples_of(const LaidOver& over, const Idle& idle, const Step& first,
                   const Step& last) {
  const Alignment& at = over.alignment;
  const auto& time = over.record.time;
  const auto index = [&](double t) {
    return static_cast<std::size_t>(
        std::lower_bound(time.begin(), time.end(), at.start + at.stretch * t) -
        time.begin());
  };
  const std::size_t from = index(first.time - 0.5 * first.duration);
  const std::size_t to = index(last.time + 0.5 * last.duration);
  const auto& clock = over.record.clock.empty() ? time : over.record.clock;
  const std::array<double, 3> offset = idle.at(first.spindle);
  const double c = std::cos(first.direction);
  const double s = std::sin(first.direction);
  Samples out{.record = {}, .stretch = over.stretch(from, to)};
  for (std::size_t i = from; i < to; ++i) {
    std::array<double, 3> F = over.record.value[i];
    for (std::size_t q = 0; q < 3; ++q) F[q] -= offset[q];
    out.record.time.push_back(clock[i]);
    out.record.channel[0].push_back(c * F[0] + s * F[1]);
    out.record.channel[1].push_back(c * F[1] - s * F[0]);
    out.record.channel[2].push_back(F[2]);
  }
  return out;
}

/// @param found  the middle turn, as looked at
std::optional<SteadyCut> cut_of(const Samples& samples, const Found& found,
                                const Tool& tool) {
  const Step& step = found.step;
  const signal::Record& record = samples.record;
  const std::size_t n = record.size();
  const int teeth = tool.cutter.teeth();
  const double span = n > 1 ? record.time.back() - record.time.front() : 0.0;
  const double turns = span * step.spindle / unit::turn;
  if (turns < 0.9 * least_turns ||
      static_cast<double>(n) < samples_a_tooth * teeth * turns) {
    return std::nullopt;
  }
  const auto speed = signal::spindle_speed(
      record, {.Omega = step.spindle, .range = 0.03, .teeth = teeth});
  SteadyCut out{.line = step.line, .turns = turns, .run = {}};
  identification::Run& run = out.run;
  run.cut = setup_of(found.turn, tool).cut;
  run.cut.Omega = speed.ok ? speed.Omega : step.spindle;
  run.cut.f_z *= step.spindle / run.cut.Omega / samples.stretch;
  run.Omega_se = speed.ok ? speed.se : 0.0;
  run.angle = signal::angle_from_time(record.time, run.cut.Omega);
  for (std::size_t i = 0; i < n; ++i) {
    run.force.push_back(
        {record.channel[0][i], record.channel[1][i], record.channel[2][i]});
  }
  return out;
}

}  // namespace

std::vector<SteadyCut> steady_cuts(const Job& job, std::span<const Step> steps,
                                   const LaidOver& over, const Idle& idle,
                                   std::size_t tool) {
  if (over.record.reads != Reads::forces) return {};
  const auto chosen =
      different_ones(steps, stretches(steps, tool, over.alignment.scatter));
  Look look(job);
  StepFinder finder(look.path(), job.options.step_turns);
  std::vector<SteadyCut> out;
  for (const SteadyRows& one : chosen) {
    const std::size_t middle = one.middle();
    const std::size_t rows =
        std::min(one.count(), rows_of(steps[middle], turns_of_a_cut));
    const Step& first = steps[middle - rows / 2];
    const Step& last = steps[middle - rows / 2 + rows - 1];
    const Ask ask = finder.find(steps[middle].step);
    look.sweep_to(look.turns_of(ask) - 1);
    const Samples samples = samples_of(over, idle, first, last);
    if (auto cut = cut_of(samples, look.at(ask), job.tools[tool])) {
      out.push_back(*std::move(cut));
    }
  }
  return out;
}

identification::Fit fit_forces(std::span<const SteadyCut> cuts, const Tool& tool,
                               identification::RunoutUnknowns unknowns,
                               const Idle& idle, const base::Stop& stop) {
  std::vector<identification::Run> runs;
  for (const SteadyCut& one : cuts) runs.push_back(one.run);
  const force::Setup setup{.cutter = tool.cutter,
                           .runout = tool.runout,
                           .cut = runs.front().cut,
                           .chip = tool.chip,
                           .edge_length = tool.edge_length,
                           .process_damping = {}};
  identification::Options options{.chip_model = tool.chip.model, .runout = unknowns};
  options.fit_channel_offsets = !idle.found;
  options.stop = stop;
  return identification::identify(setup, tool.law, runs, options);
}

}  // namespace trochoid::engagement
