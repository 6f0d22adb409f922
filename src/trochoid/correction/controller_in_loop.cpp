#include <trochoid/correction/controller_in_loop.h>

#include <trochoid/base/units.h>
#include <trochoid/correction/estimator_model.h>
#include <trochoid/correction/online.h>
#include <trochoid/dynamics/steady_state.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <stdexcept>

namespace trochoid::correction {

namespace {

constexpr double force_rate = 10e3;  ///< samples of the force for learning [Hz]
constexpr int table_points = TROCHOID_TABLE_POINTS;
/// Speeds around that of the case at which the controller runs.
constexpr double slowest_force = 0.5;
constexpr double fastest = 1.5;
constexpr double at_rest = 1e-9;  ///< from mid-stroke [m]

TrochoidControllerConfig config_of(const Setting& s, const Plan& plan,
                                   const LoopOptions& options) {
  TrochoidControllerConfig config;
  trochoid_controller_defaults(&config);
  config.points = table_points;
  config.lower_m = s.limits.stroke_low;
  config.upper_m = s.limits.stroke_high;
  const double middle = (config.lower_m + config.upper_m) / 2;
  config.start_m = middle;
  for (int i = 0; i < table_points; ++i) {
    config.table_m[i] = plan.limits.offset - middle +
                        place_at(plan.command.wave, unit::turn * i / table_points);
  }
  config.period_s = 1 / options.rate;
  config.max_step_s = 5 * config.period_s;
  config.slew_m_per_s = s.limits.slew.value_or(config.slew_m_per_s);
  config.fade_s = options.fade;
  config.ramp_s = options.ramp;
  const double rps = s.cut.setup.cut.Omega / unit::turn;
  config.min_speed_rps = slowest_force * rps;
  config.max_speed_rps = fastest * rps;
  return config;
}

/// Spindle, encoder, controller and estimator, called from the simulation.
class Loop {
 public:
  Loop(const Setting& s, const Plan& plan, const LoopOptions& options)
      : options_(options),
        omega_(s.cut.setup.cut.Omega),
        middle_((s.limits.stroke_low + s.limits.stroke_high) / 2),
        random_(1),
        rigid_(s.cut.setup, s.cut.law, 1),
        config_(config_of(s, plan, options)) {
    refused_ = trochoid_controller_init(&controller_, &config_);
    begin_learning(s, plan);
    out_.turns.resize(static_cast<std::size_t>(options.turns));
    for (LoopTurn& each : out_.turns) {
      each.peaks.assign(rigid_.psi().size(), 0.0);
    }
    out_.lowest = out_.highest = middle_;
  }

  [[nodiscard]] std::string refusal() const {
    if (refused_ != TROCHOID_ACCEPTED) {
      return trochoid_refusal_reason(refused_);
    }
    if (refused_estimator_ != TROCHOID_ESTIMATOR_ACCEPTED) {
      return trochoid_estimator_refusal_reason(refused_estimator_);
    }
    return refused_online_ != TROCHOID_ONLINE_ACCEPTED
               ? trochoid_online_refusal_reason(refused_online_)
               : std::string();
  }

  /// What the actuator is told at a time of the simulation, from mid-stroke [m].
  double command(double t) {
    const double now = real_time(omega_ * t);
    while (next_ <= now) {
      step(next_);
      const double period = 1 / options_.rate;
      const double late =
          std::clamp(options_.jitter * normal_(random_), -0.45 * period, 0.45 * period);
      ++ticks_;
      next_ = ticks_ * period + late;
    }
    return result_.command_m - middle_;
  }

  void observe(double t, const std::array<double, 3>& F, double table) {
    const double phi = omega_ * t;
    table_ = table;
    const auto n = std::min(static_cast<std::size_t>(phi / unit::turn + 1e-9),
                            out_.turns.size() - 1);
    LoopTurn& now = out_.turns[n];
    double& peak = now.peaks[rigid_.turn_of(phi)];
    peak = std::max(peak, std::abs(F[1]));
    now.gain = result_.gain;
    now.wave = largest_wave();
    now.state = result_.state;
    if (options_.adapt && t >= next_force_) {
      next_force_ += 1 / force_rate;
      learn(phi, F[1], now);
    }
  }

  ControllerInLoop finish(bool finite) {
    for (LoopTurn& each : out_.turns) {
      each.difference = dynamics::relative_difference(each.peaks);
    }
    out_.finite = finite;
    out_.ok = true;
    const auto most = std::ranges::max_element(held_);
    out_.held_by = static_cast<int>(most - held_.begin());
    out_.held_part = waited_ > 0 ? *most / waited_ : 0.0;
    out_.coarse_speed = options_.rate / options_.counts / (omega_ / unit::turn);
    return std::move(out_);
  }

 private:
  /// The ripple makes the spindle early or late: d phi/dt = Omega (1 + r sin phi).
  [[nodiscard]] double real_time(double phi) const {
    return (phi + options_.speed_ripple * (std::cos(phi) - 1)) / omega_;
  }
  [[nodiscard]] double angle_at(double time) const {
    double phi = omega_ * time;
    for (int k = 0; k < 60; ++k) {
      phi = omega_ * time - options_.speed_ripple * (std::cos(phi) - 1);
    }
    return phi;
  }

  void step(double time) {
    const double phi = angle_at(time);
    const double counts = options_.counts;
    const double position = std::floor(phi / unit::turn * counts) / counts;
    const bool pulse = std::floor(phi / unit::turn) > std::floor(angle_ / unit::turn);
    const bool lost =
        options_.index_lost_at > 0 && phi >= unit::turn * options_.index_lost_at;
    TrochoidControllerInput in{};
    in.position_rev = position;
    in.index_position_rev = std::floor(phi / unit::turn);
    in.dt_s = time - time_;
    in.speed_rps = in.dt_s > 0 ? (position - position_) / in.dt_s : 0.0;
    in.gain = gain_;
    if (options_.adapt) {
      std::ranges::copy(estimator_.result.cosine_m, in.cosine_m);
      std::ranges::copy(estimator_.result.sine_m, in.sine_m);
    }
    in.index = pulse && !lost ? 1 : 0;
    in.enable = phi >= unit::turn * enabling_turn ? 1 : 0;
    result_ = trochoid_controller_step(&controller_, &in);
    angle_ = phi;
    time_ = time;
    position_ = position;
    keep(time);
  }

  void keep(double time) {
    out_.samples.push_back(
        {time, result_.command_m, table_, result_.gain, result_.state});
    if (result_.state == TROCHOID_WAITING) {
      ++waited_;
      if (result_.problem != TROCHOID_NO_PROBLEM) {
        ++held_[static_cast<std::size_t>(result_.problem)];
      }
    }
    out_.lowest = std::min(out_.lowest, result_.command_m);
    out_.highest = std::max(out_.highest, result_.command_m);
    if (result_.state != TROCHOID_FAULT) {
      return;
    }
    if (out_.fault == TROCHOID_NO_PROBLEM) {
      out_.fault = result_.fault;
      out_.fault_time = time;
    }
    if (!out_.time_to_safe && std::abs(result_.command_m - middle_) < at_rest) {
      out_.time_to_safe = time - out_.fault_time;
    }
  }

  void begin_learning(const Setting& s, const Plan& plan) {
    if (!options_.adapt) {
      return;
    }
    if (rigid_.teeth() > 2) {  // from nothing: the waves take the place of the table
      const auto config = estimator_for(s, plan.motion);
      refused_estimator_ = config ? trochoid_estimator_init(&estimator_, &*config)
                                  : TROCHOID_ESTIMATOR_REFUSED_TEETH;
      gain_ = 0.0;
      return;
    }
    TrochoidOnlineConfig config;
    trochoid_online_defaults(&config);
    const double at = rigid_.psi()[0] + (rigid_.arc().from + rigid_.arc().to) / 2;
    config.teeth = static_cast<int32_t>(rigid_.psi().size());
    config.window_start_rev = (at - unit::turn / 4) / unit::turn;
    config.feed_per_tooth_m = s.cut.setup.cut.f_z;
    config.difference_m =
        place_at(plan.motion, at) - place_at(plan.motion, at - unit::turn / 2);
    config.exponent = force::form(s.cut.law).m[0];
    config.gain_high = trochoid_controller_gain_limit(&controller_);
    gain_ = config.gain;
    refused_online_ = trochoid_online_init(&online_, &config);
  }

  [[nodiscard]] double largest_wave() const {
    double most = 0.0;
    for (int n = 0; n < TROCHOID_WAVE_HARMONICS; ++n) {
      most = std::max(most, std::hypot(controller_.cosine_m[n], controller_.sine_m[n]));
    }
    return most;
  }

  void learn(double phi, double force, LoopTurn& now) {
    const bool active = result_.state == TROCHOID_RUNNING;
    if (rigid_.teeth() > 2) {
      const TrochoidEstimatorResult learnt = trochoid_estimator_sample(
          &estimator_, phi / unit::turn, force, active ? 1 : 0);
      now.event = learnt.turn != TROCHOID_TURN_OPEN ? learnt.event : now.event;
      return;
    }
    gain_ =
        trochoid_online_sample(&online_, phi / unit::turn, force, active ? 1 : 0).gain;
  }

  LoopOptions options_;
  double omega_;
  double middle_;
  std::mt19937_64 random_;
  std::normal_distribution<double> normal_{0.0, 1.0};
  RigidCut rigid_;
  TrochoidControllerConfig config_;
  TrochoidController controller_{};
  TrochoidControllerResult result_{};
  TrochoidOnline online_{};
  TrochoidEstimator estimator_{};
  int32_t refused_estimator_ = TROCHOID_ESTIMATOR_ACCEPTED;
  int32_t refused_ = TROCHOID_ACCEPTED;
  int32_t refused_online_ = TROCHOID_ONLINE_ACCEPTED;
  double gain_ = 1.0;
  double next_ = 0.0;
  double next_force_ = 0.0;
  double ticks_ = 0.0;
  double time_ = 0.0;
  double angle_ = 0.0;
  double position_ = 0.0;
  double table_ = 0.0;
  std::array<double, TROCHOID_BAD_MEMORY + 1>
      held_{};  ///< steps of waiting, by problem
  double waited_ = 0.0;
  ControllerInLoop out_;
};

}  // namespace

ControllerInLoop controller_in_loop(const Setting& s, const Plan& plan,
                                    const LoopOptions& options) {
  if (options.turns <= enabling_turn) {
    throw std::invalid_argument("the controller is enabled after the last turn");
  }
  Loop loop(s, plan, options);
  if (const std::string why = loop.refusal(); !why.empty()) {
    return {.reason = "the controller refuses its configuration: " + why};
  }
  dynamics::MotionProblem p = problem_of(s.cut, Harmonics{});
  p.command = [&loop](double t) { return loop.command(t); };
  p.observe = [&loop](double t, const std::array<double, 3>& F, double table) {
    loop.observe(t, F, table);
  };
  p.revolutions = options.turns;
  p.kept = 1;
  return loop.finish(dynamics::motion(p).finite);
}

const LoopTurn* last_running(const ControllerInLoop& run) noexcept {
  const LoopTurn* last = nullptr;
  for (const LoopTurn& turn : run.turns) {
    if (turn.state == TROCHOID_RUNNING) {
      last = &turn;
    }
  }
  return last;
}

std::optional<int> turns_to_equal(const ControllerInLoop& run,
                                  double difference) noexcept {
  std::optional<int> first;
  int running = 0;
  for (const LoopTurn& turn : run.turns) {
    if (turn.state != TROCHOID_RUNNING) {
      continue;
    }
    ++running;
    if (turn.difference >= difference) {
      first.reset();
    } else if (!first) {
      first = running;
    }
  }
  return first;
}

}  // namespace trochoid::correction
