#include <trochoid/run/correction_plan.h>

#include <trochoid/base/units.h>
#include <trochoid/correction/shapes.h>

#include <algorithm>
#include <cmath>

namespace trochoid::run {

namespace {

using correction::Method;
using correction::PeriodicMotion;
using correction::RigidCut;
using correction::Shape;

force::Setup with_runout(force::Setup setup, const std::vector<double>& rho) {
  setup.runout = {};
  setup.runout.radial_offsets = rho;
  return setup;
}

/// A command, and the part of the motion wanted that it can make.
struct Made {
  PeriodicMotion motion;
  correction::Command command;
  std::optional<correction::Learned> learned;
};

void learn(const CorrectionSetting& s, const inputs::Correction& wanted, Made& made) {
  const auto* start = std::get_if<correction::Harmonics>(&made.command.wave);
  if (!made.command.ok || start == nullptr) {
    return;
  }
  const correction::MeasuredTable measured = [&s](const correction::Harmonics& u) {
    return correction::moving_flutes(s.cut, u).table;
  };
  made.learned =
      correction::learn(made.motion, *start, s.cut.plant, s.cut.setup.cut.Omega,
                        measured, {.gain = wanted.learning_gain});
  made.command.wave = made.learned->command;
}

/// Inverse commands hold as many harmonics as the limits leave.
Made make(const CorrectionSetting& s, const RigidCut& rigid,
          const inputs::Correction& wanted, const PeriodicMotion& motion) {
  const double Omega = s.cut.setup.cut.Omega;
  const Method method = wanted.strategy;
  correction::CommandOptions options{.n_max = wanted.harmonics};
  if (wanted.sample_rate > 0) {
    options.sample_time = 1 / wanted.sample_rate;
  }
  Made made{.motion = motion};
  if (method == Method::inverse || method == Method::learning) {
    const correction::Followed part =
        correction::followed(rigid, motion, s.cut.plant, Omega, s.limits);
    options.n_max = std::min(options.n_max, part.n_max);
    made.motion = part.motion;
  }
  made.command =
      correction::command_for(made.motion, method, s.cut.plant, Omega, options);
  if (method == Method::learning) {
    learn(s, wanted, made);
  }
  return made;
}

/// A motion through the levels, as large as the target asks; none with the reason.
std::optional<PeriodicMotion> sized(const CorrectionSetting& s, const RigidCut& rigid,
                                    const inputs::Correction& wanted,
                                    const PeriodicMotion& through,
                                    std::string& reason) {
  if (wanted.peak_to_peak) {
    return correction::scaled(
        through, *wanted.peak_to_peak / correction::range_of(through).peak_to_peak());
  }
  correction::FlutesOf flutes;
  if (wanted.estimate == inputs::RunoutEstimate::known) {
    flutes = [&](const PeriodicMotion& motion) {
      return correction::moving_flutes(s.cut,
                                       make(s, rigid, wanted, motion).command.wave)
          .flutes;
    };
  }
  const correction::Amplitude found = correction::equal_flutes(
      wanted.target, rigid, wanted.shape,
      {.transition = wanted.transition, .harmonics = wanted.harmonics}, flutes);
  reason = found.reason;
  return found.ok ? std::optional(found.motion) : std::nullopt;
}

/// Does the actuator follow every harmonic of a motion?
bool whole(const CorrectionSetting& s, const RigidCut& rigid,
           const PeriodicMotion& motion, int harmonics) {
  const correction::Followed part =
      correction::followed(rigid, motion, s.cut.plant, s.cut.setup.cut.Omega, s.limits);
  return part.n_max >= harmonics;
}

}  // namespace

CorrectionPlan correction_plan(const CorrectionSetting& s,
                               const inputs::Correction& given) {
  CorrectionPlan plan;
  const RigidCut rigid(with_runout(s.cut.setup, s.designed_for), s.cut.law,
                       s.cut.slices);
  inputs::Correction wanted = given;
  const auto through = [&] {
    return correction::table_motion(
        rigid, wanted.shape,
        {.transition = wanted.transition, .harmonics = wanted.harmonics});
  };
  if (!(correction::range_of(through()).peak_to_peak() > 0)) {
    plan.reason = "the teeth stand out alike: there is nothing to correct";
    return plan;
  }
  // The best motion of few harmonics is not the beginning of the best one of many.
  while (wanted.shape == Shape::harmonics && wanted.harmonics > 1 &&
         !whole(s, rigid, through(), wanted.harmonics)) {
    --wanted.harmonics;
  }
  const auto motion = sized(s, rigid, wanted, through(), plan.reason);
  if (!motion) {
    return plan;
  }
  Made made = make(s, rigid, wanted, *motion);
  plan.motion = made.motion;
  plan.command = made.command;
  plan.learned = std::move(made.learned);
  if (!plan.command.ok) {
    plan.reason = plan.command.reason;
    return plan;
  }
  plan.limits = correction::check_limits(plan.command, s.cut.plant,
                                         s.cut.setup.cut.Omega, s.limits, rigid);
  plan.ok = true;
  return plan;
}

BeforeAfter before_after(const CorrectionSetting& setting,
                         const correction::Command& command) {
  const auto run = [&](const PeriodicMotion& wave) {
    dynamics::MotionProblem p = correction::problem_of(setting.cut, wave);
    p.kept = 1;
    return dynamics::motion(p);
  };
  return {run(correction::Harmonics{}), run(command.wave)};
}

SpeedMap speed_map(const CorrectionSetting& s, const CorrectionPlan& plan,
                   const inputs::Correction& wanted) {
  const RigidCut rigid(with_runout(s.cut.setup, s.designed_for), s.cut.law,
                       s.cut.slices);
  const auto alike = [&](Shape shape) {
    const correction::ShapeOptions options{.transition = wanted.transition,
                                           .harmonics = wanted.harmonics};
    const auto found =
        correction::equal_flutes(correction::Target::peak_force, rigid, shape, options);
    return found.ok ? found.motion : correction::table_motion(rigid, shape, options);
  };
  const PeriodicMotion sine = alike(Shape::sine);
  const PeriodicMotion square = alike(Shape::square);
  SpeedMap map;
  map.strategies = {{"sine_plain", {sine, Method::plain}},
                    {"sine_lead", {sine, Method::lead}},
                    {"sine_inverse", {sine, Method::inverse}},
                    {"square_lead", {square, Method::lead}},
                    {"this_case", {plan.motion, wanted.strategy}}};
  map.Omega = base::values(*wanted.spindle_speed);
  correction::MapSetting setting{.model = s.cut.plant,
                                 .real = s.cut.plant,
                                 .limits = s.limits,
                                 .command = {.n_max = wanted.harmonics}};
  if (wanted.sample_rate > 0) {
    setting.command.sample_time = 1 / wanted.sample_rate;
  }
  std::vector<correction::Strategy> strategies;
  for (const NamedStrategy& named : map.strategies) {
    strategies.push_back(named.strategy);
  }
  map.points = correction::residual_map(rigid, strategies, setting, map.Omega);
  const double ends[] = {wanted.spindle_speed->first, wanted.spindle_speed->last};
  for (const correction::Strategy& strategy : strategies) {
    map.highest.push_back(correction::residual_speed(rigid, strategy, setting,
                                                     wanted.allowed_difference, ends));
  }
  return map;
}

}  // namespace trochoid::run
