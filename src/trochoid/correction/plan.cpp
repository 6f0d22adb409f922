#include <trochoid/correction/plan.h>

#include <trochoid/correction/equal_flutes.h>
#include <trochoid/correction/shapes.h>
#include <trochoid/correction/transition.h>

#include <algorithm>

namespace trochoid::correction {

namespace {

/// Harmonics to which the quick model follows the table.
constexpr int quick_harmonics = 20;

/// A command, and the fraction of the motion wanted that it can make.
struct Made {
  PeriodicMotion motion;
  Command command;
  std::optional<Learned> learned;
};

/// A setting and the rigid cut that it is designed on.
struct Design {
  const Setting& setting;
  RigidCut rigid = designed_cut(setting);
  double Omega = setting.cut.setup.cut.Omega;
};

ShapeOptions shape_options(const CorrectionOptions& options) {
  ShapeOptions shape{.harmonics = options.harmonics};
  shape.transition = options.transition.value_or(shape.transition);
  return shape;
}

/// Width and harmonics by the speed, where none is given.
void choose_transition(const Design& design, CorrectionOptions& options) {
  const bool by_harmonics =
      options.strategy == Method::inverse || options.strategy == Method::learning;
  if (options.transition ||
      (options.shape != Shape::trapezoid && options.shape != Shape::quintic)) {
    return;
  }
  const Setting& s = design.setting;
  const auto candidates = transition_candidates(
      design.rigid,
      {options.shape, options.strategy, options.target, options.harmonics});
  const TransitionCandidate& best =
      chosen_transition(design.rigid, candidates, options.strategy,
                        {.model = s.cut.plant,
                         .real = s.cut.plant,
                         .limits = s.limits,
                         .command = command_options(options)},
                        design.Omega);
  options.transition = best.width;
  options.harmonics = by_harmonics ? best.harmonics : options.harmonics;
}

/// The motion of a shape through the levels of the teeth, of its own size.
PeriodicMotion through_levels(const Design& design, const CorrectionOptions& options) {
  return table_motion(design.rigid, options.shape, shape_options(options));
}

void learn_command(const Setting& s, const CorrectionOptions& options, Made& made) {
  const auto* start = std::get_if<Harmonics>(&made.command.wave);
  if (!made.command.ok || start == nullptr) {
    return;
  }
  const MeasuredTable measured = [&s](const Harmonics& u) {
    return moving_flutes(s.cut, u).table;
  };
  made.learned = learn(made.motion, *start, s.cut.plant, s.cut.setup.cut.Omega,
                       measured, {.gain = options.learning_gain});
  made.command.wave = made.learned->command;
}

/// Inverse commands hold as many harmonics as the limits leave.
Made make(const Design& design, const CorrectionOptions& options,
          const PeriodicMotion& motion) {
  const Setting& s = design.setting;
  CommandOptions allowed = command_options(options);
  Made made{.motion = motion};
  if (options.strategy == Method::inverse || options.strategy == Method::learning) {
    ActuatorLimits limits = s.limits;  // the motion has no more than the command
    limits.most_harmonics = std::min(limits.most_harmonics, allowed.n_max);
    const Followed part =
        followed(design.rigid, motion, s.cut.plant, design.Omega, limits);
    allowed.n_max = part.n_max;
    made.motion = part.motion;
  }
  made.command =
      command_for(made.motion, options.strategy, s.cut.plant, design.Omega, allowed);
  if (options.strategy == Method::learning) {
    learn_command(s, options, made);
  }
  return made;
}

/// A motion through the levels of which the actuator makes the size asked for. It may
/// follow other harmonics of a larger one, so that is looked at again.
PeriodicMotion as_large(const Design& design, const CorrectionOptions& options,
                        const PeriodicMotion& through) {
  constexpr int looks = 3;
  PeriodicMotion motion = through;
  for (int i = 0; i < looks; ++i) {
    const double made = range_of(make(design, options, motion).motion).peak_to_peak();
    motion = scaled(motion, *options.peak_to_peak / made);
  }
  return motion;
}

/// A motion through the levels, as large as the target asks; none with the reason.
std::optional<PeriodicMotion> sized(const Design& design,
                                    const CorrectionOptions& options,
                                    const PeriodicMotion& through, Plan& plan) {
  if (options.peak_to_peak) {
    return as_large(design, options, through);
  }
  FluteModels models;
  CorrectionOptions straight = options;  // what learning would learn, the inverse has
  straight.strategy =
      options.strategy == Method::learning ? Method::inverse : options.strategy;
  const Setting& s = design.setting;
  if (options.estimate == RunoutEstimate::known) {
    models.exact = [&](const PeriodicMotion& motion) {
      return moving_flutes(s.cut, make(design, options, motion).command.wave).flutes;
    };
    models.quick = [&](const PeriodicMotion& motion) {
      const Harmonics X =
          table_response(s.cut.plant, make(design, straight, motion).command.wave,
                         design.Omega, quick_harmonics);
      return options.target == Target::chip_area ? design.rigid.flutes(X)
                                                 : design.rigid.peaks(X);
    };
  }
  const Amplitude found = equal_flutes(options.target, design.rigid, options.shape,
                                       shape_options(options), models);
  plan.reason = found.reason;
  plan.optimum = found.optimum;
  return found.ok ? std::optional(found.motion) : std::nullopt;
}

/// Does the actuator follow every harmonic of a motion?
bool whole(const Design& design, const PeriodicMotion& motion, int harmonics) {
  const Setting& s = design.setting;
  return followed(design.rigid, motion, s.cut.plant, design.Omega, s.limits).n_max >=
         harmonics;
}

std::vector<double> over_turn(const PeriodicMotion& motion, double offset, int points) {
  std::vector<double> values;
  values.reserve(static_cast<std::size_t>(points));
  for (int i = 0; i < points; ++i) {
    values.push_back(offset + place_at(motion, unit::turn * i / points));
  }
  return values;
}

}  // namespace

bool nothing_to_correct(const Setting& setting, const CorrectionOptions& options) {
  return !(range_of(through_levels(Design{setting}, options)).peak_to_peak() > 0);
}

Plan plan_correction(const Setting& setting, const CorrectionOptions& options) {
  Plan plan;
  const Design design{setting};
  CorrectionOptions fewer = options;
  const auto through = [&] { return through_levels(design, fewer); };
  if (nothing_to_correct(setting, options)) {
    plan.reason = "the teeth stand out alike: there is nothing to correct";
    return plan;
  }
  choose_transition(design, fewer);
  if (fewer.shape == Shape::trapezoid || fewer.shape == Shape::quintic) {
    plan.transition = shape_options(fewer).transition;
  }
  // The best motion of few harmonics is not the beginning of the best one of many.
  while (fewer.shape == Shape::harmonics && fewer.harmonics > 1 &&
         !whole(design, through(), fewer.harmonics)) {
    --fewer.harmonics;
  }
  const auto motion = sized(design, fewer, through(), plan);
  if (!motion) {
    return plan;
  }
  Made made = make(design, fewer, *motion);
  plan.motion = made.motion;
  plan.command = made.command;
  plan.learned = std::move(made.learned);
  if (!plan.command.ok) {
    plan.reason = plan.command.reason;
    return plan;
  }
  plan.limits = check_limits(plan.command, setting.cut.plant, design.Omega,
                             setting.limits, design.rigid);
  if (plan.command.n_max > 0) {
    const Limit speed = speed_limit(plan.command, plan.motion, setting.cut.plant,
                                    design.Omega, setting.limits);
    plan.limits.limits.push_back(speed);
    plan.limits.ok = plan.limits.ok && speed.ok;
  }
  plan.ok = true;
  return plan;
}

CommandOptions command_options(const CorrectionOptions& options) {
  CommandOptions out{.n_max = options.harmonics};
  if (options.sample_rate > 0) {
    out.sample_time = 1 / options.sample_rate;
  }
  return out;
}

std::vector<double> command_over_turn(const Plan& plan, int points) {
  return over_turn(plan.command.wave, plan.limits.offset, points);
}

std::vector<double> motion_over_turn(const Plan& plan, int points) {
  return over_turn(plan.motion, plan.limits.offset, points);
}

}  // namespace trochoid::correction
