#include <trochoid/dynamics/steady_state.h>

#include <trochoid/dynamics/growth.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace trochoid::dynamics {

namespace {

/// Late over earlier changes from turn to turn above which a vibration does not die out.
constexpr double chatter_persistence = 0.7;
/// How often the number of turns is doubled until the motion repeats.
constexpr int most_doublings = 3;
/// Difference of the peaks above which teeth that are alike do not cut alike.
constexpr double unequal_peaks = 0.02;

bool grows(const Motion& m) {
  return m.growth.value_or(0.0) > chatter_growth;
}

Verdict verdict_of(const MotionProblem& problem, const Motion& m) {
  if (!m.finite) {
    return Verdict::chatter;
  }
  if (m.periodic) {
    // What one tooth does, all do, unless a command or chatter tells them apart.
    const bool several_teeth = !problem.command && force::teeth_alike(problem.setup) &&
                               peak_difference(m) > unequal_peaks;
    return several_teeth ? Verdict::chatter : Verdict::periodic;
  }
  const bool stays = late_change(m.once).value_or(0.0) > chatter_persistence;
  return grows(m) || stays ? Verdict::chatter : Verdict::not_periodic;
}

double difference_of(const Motion& m, double FluteMotion::*value) {
  std::vector<double> values;
  for (const FluteMotion& flute : m.flutes) {
    values.push_back(flute.*value);
  }
  return relative_difference(values);
}

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

Verdict verdict_so_far(const Motion& m) {
  if (!m.finite || !m.solved) {
    return Verdict::chatter;
  }
  if (m.periodic) {
    return Verdict::periodic;
  }
  const bool shakes = m.last_change > chatter_change * largest_component(m);
  return grows(m) || shakes ? Verdict::chatter : Verdict::not_periodic;
}

SteadyState steady_state(MotionProblem problem, const TurnsProgress& progress) {
  SteadyState all;
  for (int doubled = 0; doubled <= most_doublings; ++doubled) {
    if (progress) {
      progress(problem.revolutions);
    }
    all.motion = motion(problem);
    all.verdict = verdict_of(problem, all.motion);
    if (all.verdict == Verdict::periodic || !all.motion.finite || !all.motion.solved ||
        grows(all.motion)) {
      break;
    }
    problem.revolutions *= 2;
  }
  return all;
}

}  // namespace trochoid::dynamics
