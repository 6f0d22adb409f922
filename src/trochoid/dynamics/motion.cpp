#include <trochoid/dynamics/make_grid.h>
#include <trochoid/dynamics/motion.h>

#include <trochoid/base/units.h>
#include <trochoid/dynamics/cut_force.h>
#include <trochoid/dynamics/force_balance.h>
#include <trochoid/dynamics/growth.h>
#include <trochoid/dynamics/motion_record.h>
#include <trochoid/dynamics/newton_step.h>
#include <trochoid/dynamics/past.h>
#include <trochoid/dynamics/stepper.h>

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace trochoid::dynamics {

namespace {

/// Rounds for the force at the end of a step; more would go round in a circle where a
/// tooth only just touches.
constexpr int most_rounds = 5;
/// A displacement that is nothing, and one that is too much for a force that agrees, as
/// parts of the feed per tooth.
constexpr double no_motion = 1e-9;
constexpr double too_much = 1e-6;
/// Changes from turn to turn up to this fraction of the feed per tooth are small.
constexpr double small_change = 0.2;
double size_of(const Force& F) {
  return std::abs(F[0]) + std::abs(F[1]);
}

std::vector<double> times_of(const EngagedGrid& grid, double omega) {
  std::vector<double> times;
  for (const double step : grid.step) {
    times.push_back(step / omega);
  }
  return times;
}

int steps_of(const MotionProblem& problem) {
  const int asked = problem.grid.steps_per_tooth;
  const int steps = asked > 0 ? asked : steps_needed(problem);
  if (steps > most_steps) {
    throw std::invalid_argument(
        fmt::format("{} steps in a tooth period, more than {}", steps, most_steps));
  }
  return steps;
}

class Run {
 public:
  explicit Run(const MotionProblem& problem)
      : problem_(problem),
        grid_(engaged_grid(problem.setup, problem.grid, steps_of(problem))),
        cut_(problem.law, grid_, flank_terms(problem.setup)),
        omega_(problem.setup.cut.Omega),
        dt_(times_of(grid_, omega_)),
        stepper_(problem, dt_),
        past_(grid_),
        samples_(problem, grid_),
        flutes_(problem, grid_),
        comparison_(grid_),
        kept_(std::max(1, problem.kept)) {
    const auto turns = static_cast<int>(grid_.memory() / grid_.angle.size());
    with_slope_ =
        grid_.delays.empty() ? kept_ + turns + 1 : std::numeric_limits<int>::max();
    for (std::size_t i = 0; i < dt_.size(); ++i) {
      ratio_.push_back(dt_[i] / (i > 0 ? dt_[i - 1] : dt_.back()));
    }
    motion_.flutes.resize(grid_.teeth);
    motion_.mode.resize(problem.system.modes.size());
    motion_.speed.resize(problem.system.modes.size());
  }

  Motion go() {
    if (problem_.start == Start::periodic) {
      start_periodic();
    }
    const auto q = past_.q();
    cut_.prepare(0, grid_.after[0], past_.last());
    cut_.watch(q[0], q[1]);
    Force F = cut_.response(q, stepper_.speed()).F;
    before_ = F;
    for (int n = 0; n < problem_.revolutions && going(); ++n) {
      motion_.once.push_back(past_.q());
      for (std::size_t i = 0; i < grid_.angle.size() && going(); ++i) {
        F = step_once(n, i, F);
      }
      past_.finish_turn();
      ++motion_.turns_done;
      if (problem_.turned) {
        problem_.turned(motion_.turns_done);
      }
    }
    motion_.growth =
        growth_per_turn(motion_.once, small_change * problem_.setup.cut.f_z);
    samples_.finish(motion_);
    for (FluteMotion& flute : motion_.flutes) {
      flute.chip_area /= std::max(1, problem_.watched);
    }
    comparison_.finish(motion_);
    return std::move(motion_);
  }

 private:
  [[nodiscard]] bool going() const { return motion_.finite && motion_.solved; }

  [[nodiscard]] std::array<double, 2> slope() const noexcept {
    const auto v = stepper_.speed();
    return {v[0] / omega_, v[1] / omega_};
  }

  /// The motion that a turn of forces without vibration keeps up, and a past like it.
  void start_periodic() {
    const Past nothing_moved(grid_);
    const History still = nothing_moved.last();
    for (const bool first : {true, false}) {
      past_.set(stepper_.place(), slope());
      for (std::size_t i = 0; i < grid_.angle.size(); ++i) {
        const std::size_t next = i + 1 < grid_.angle.size() ? i + 1 : 0;
        cut_.prepare(i, grid_.after[i], still);
        stepper_.begin(i, cut_.response(0, 0).F, 0.0);
        cut_.prepare(next, grid_.before[next], still);
        const Force F = cut_.response(0, 0).F;
        stepper_.accept(F);
        past_.add(stepper_.end(F), slope());
      }
      if (first) {
        stepper_.repeat(unit::turn / omega_);
        past_ = Past(grid_);
      }
    }
    past_.repeat_turn();
  }

  /// One step. The force at its end and the motion there depend on each other, so the step
  /// is implicit; the marks of earlier teeth lie in the past, and are met once before the
  /// force is looked for. Where a tip enters or leaves at the end, the force has two values:
  /// the one just before ends this step, the one just after begins the next.
  /// @return the force at the start of the next step
  Force step_once(int n, std::size_t i, const Force& F) {
    const std::size_t next = i + 1 < grid_.angle.size() ? i + 1 : 0;
    const int left = problem_.revolutions - n;
    const double t = (unit::turn * n + grid_.angle[i]) / omega_;
    if (problem_.observe) {
      problem_.observe(t, F, stepper_.table());
    }
    const double middle = t + 0.5 * dt_[i];
    const double command = problem_.command ? problem_.command(middle) : 0.0;
    step_.node = i;
    const bool sampled = left <= problem_.kept && samples_.wants(i);
    if (left <= problem_.kept) {
      samples_.add_command(middle, command);
    }
    if (sampled) {
      step_ = {n, i, dt_[i], stepper_.snapshot(), {}, {}};
    }
    stepper_.begin(i, F, command);
    cut_.prepare(next, grid_.before[next], past_.next());
    const Force end = force_at_end(i, F);
    auto q = stepper_.end(end);
    const bool jumped = add_crossings(q, end);
    if (jumped) {
      q = stepper_.end(end);
    }
    stepper_.accept(end);
    past_.add(q, left <= with_slope_ ? slope() : std::array<double, 2>{});
    motion_.finite = std::abs(q[0]) + std::abs(q[1]) < run_away;
    step_.past = past_.last();
    if (sampled) {
      step_.to = stepper_.snapshot();
      samples_.add(step_, motion_);
    }
    record(left, n, F, jumped);
    if (!grid_.jump[next]) {
      cut_.watch(q[0], q[1]);
      before_ = F;
      return end;
    }
    cut_.prepare(next, grid_.after[next], past_.last());
    cut_.watch(q[0], q[1]);
    before_ = cut_.response(q, stepper_.speed()).F;
    return before_;
  }

  /// What the last turns tell, so many turns before the end.
  void record(int left, int n, const Force& F, bool jumped) {
    if (left <= problem_.watched) {
      flutes_.add(step_, F, motion_);
    }
    if (left <= comparison_.turns()) {
      comparison_.add(n, step_.node, F);
      if (jumped) {
        comparison_.forget(n, step_.node);
      }
    }
  }

  /// The force that agrees with the motion it makes, by Newton's method from an
  /// extrapolation; the first round has the slope of the step before, so that little
  /// has to wait for it.
  Force force_at_end(std::size_t i, const Force& F) {
    const double ratio = ratio_[i];
    const auto& P = stepper_.per_force();
    std::array<double, 2> guess = {F[0] + ratio * (F[0] - before_[0]),
                                   F[1] + ratio * (F[1] - before_[1])};
    for (int round = 0; round < most_rounds; ++round) {
      const Response r = response_to({guess[0], guess[1], 0.0});
      const NewtonStep fresh = newton_step(r);
      const NewtonStep& use = round == 0 ? newton_ : fresh;
      const std::array<double, 2> off = {r.F[0] - guess[0], r.F[1] - guess[1]};
      const std::array<double, 2> change = {use.xx * off[0] + use.xy * off[1],
                                            use.yx * off[0] + use.yy * off[1]};
      guess[0] += change[0];  // T-6
      guess[1] += change[1];
      const double moved = std::abs(change[0]) + std::abs(change[1]);
      const double size = size_of(r.F);
      const bool stiff =
          round == 0 && std::max(newton_.strength, fresh.strength) > NewtonStep::mild;
      newton_ = fresh;
      largest_ = std::max(largest_, size);
      if ((!stiff && moved <= near * size) || moved <= settled * largest_) {
        const double dx = P[0] * change[0] + P[1] * change[1];
        const double dy = P[1] * change[0] + P[2] * change[1];
        return {guess[0], guess[1], r.F[2] + r.per_q[4] * dx + r.per_q[5] * dy};
      }
    }
    return bracketed_force({guess[0], guess[1], 0.0});
  }

  /// The force of the cut at the end of the step if the force there is F.
  Response response_to(const Force& F) noexcept {
    const auto q = stepper_.end(F);
    return cut_.damps() ? cut_.response(q, stepper_.end_speed(F))
                        : cut_.response(q[0], q[1]);
  }

  [[nodiscard]] NewtonStep newton_step(const Response& r) const noexcept {
    const auto& P = stepper_.per_force();
    return cut_.damps() ? NewtonStep(feedback(r, {P, stepper_.speed_per_force()}))
                        : NewtonStep(r, P);
  }

  /// The same where the force has a corner, a jump or an infinite slope in between.
  Force bracketed_force(const Force& guess) {
    const double f_z = problem_.setup.cut.f_z;
    const auto response_of = [this](const Force& F) { return response_to(F); };
    const StepCompliance compliance{stepper_.per_force(), stepper_.speed_per_force()};
    const ForceBalance found =
        balanced_force(response_of, compliance, guess, no_motion * f_z);
    // A tooth that touches with an edge force, but not without it, has no force that
    // agrees: one of both is as good as the other.
    const auto& P = compliance.P;
    const auto v = stepper_.end_speed(found.F);
    const double of_jump =
        std::hypot(P[0], P[1], P[2]) * cut_.largest_jump(std::hypot(v[0], v[1]));
    motion_.solved = found.motion_error <= std::max(too_much * f_z, of_jump);
    return found.F;
  }

  /// An edge force that came or went in the step acted over a part of it, not as the
  /// straight line between its ends has it.
  bool add_crossings(const std::array<double, 2>& q, const Force& end) {
    const auto v = cut_.damps() ? stepper_.end_speed(end) : std::array<double, 2>{};
    const auto& crossings = cut_.crossings(q, v);
    for (const Crossing& crossing : crossings) {
      Force mean;
      for (std::size_t a = 0; a < 3; ++a) {
        mean[a] = (0.5 - crossing.part) * crossing.jump[a];  // T-5
      }
      stepper_.add(mean);
    }
    return !crossings.empty();
  }

  /// A round that changes the force by this part of it leaves its square.
  static constexpr double near = 1e-3;
  /// Part of the largest force so far that is nothing.
  static constexpr double settled = 1e-7;

  const MotionProblem& problem_;
  EngagedGrid grid_;
  CutForce cut_;
  double omega_;
  std::vector<double> dt_;
  Stepper stepper_;
  Past past_;
  MotionSamples samples_;
  FluteWatch flutes_;
  TurnComparison comparison_;
  int kept_;        ///< turns of which steps are looked at
  int with_slope_;  ///< turns at the end in which slopes of the past are asked for
  std::vector<double> ratio_;  ///< of each step to the one before
  TakenStep step_;
  NewtonStep newton_;
  Force before_{};  ///< force one step earlier
  double largest_ = 0.0;
  Motion motion_;
};

}  // namespace

int steps_needed(const MotionProblem& problem) {
  constexpr int least = 1000;
  constexpr double of_fastest = 20;
  constexpr double moves = 1e-5;
  const force::Setup& setup = problem.setup;
  const force::Terms law = force::terms(problem.law);
  const double thin = law.form.power ? 10 : 1;  // a power law, for chips of some um
  const double per_chip = thin * std::hypot(law.K[0], law.K[1]);
  double fastest = 0.0;
  for (const ChipMode& mode : problem.system.modes) {
    if (per_chip * setup.cut.a_p > moves * mode.stiffness) {
      fastest = std::max(fastest, std::sqrt(mode.stiffness / mode.mass) / unit::turn);
    }
  }
  const double tooth_period = unit::turn / (setup.cut.Omega * setup.cutter.teeth());
  const double needed = std::ceil(of_fastest * fastest * tooth_period);
  return static_cast<int>(std::clamp(needed, double{least}, 1e9));
}

Motion motion(const MotionProblem& problem) {
  return Run(problem).go();
}

}  // namespace trochoid::dynamics
