#include <trochoid/run/controlled.h>

#include <trochoid/base/units.h>
#include <trochoid/correction/online.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace trochoid::run {

namespace {

constexpr double force_rate = 10e3;  ///< samples of the force for learning [Hz]
constexpr int table_points = 720;
/// Speeds around that of the case at which the controller runs.
constexpr double slowest = 0.5;
constexpr double fastest = 1.5;
constexpr double at_rest = 1e-9;  ///< from mid-stroke [m]

TrochoidControllerConfig config_of(const CorrectionSetting& s,
                                   const CorrectionPlan& plan,
                                   const inputs::Controller& wanted) {
  TrochoidControllerConfig config;
  trochoid_controller_defaults(&config);
  config.points = table_points;
  config.lower_m = s.limits.stroke_low;
  config.upper_m = s.limits.stroke_high;
  const double middle = (config.lower_m + config.upper_m) / 2;
  config.start_m = middle;
  for (int i = 0; i < table_points; ++i) {
    config.table_m[i] =
        plan.limits.offset - middle +
        correction::place_at(plan.command.wave, unit::turn * i / table_points);
  }
  config.period_s = 1 / wanted.rate;
  config.max_step_s = 5 * config.period_s;
  config.slew_m_per_s = s.limits.slew.value_or(config.slew_m_per_s);
  config.fade_s = wanted.fade;
  config.ramp_s = wanted.ramp;
  const double rps = s.cut.setup.cut.Omega / unit::turn;
  config.min_speed_rps = slowest * rps;
  config.max_speed_rps = fastest * rps;
  return config;
}

/// Spindle, encoder, controller and estimator, called from the simulation.
class Loop {
 public:
  Loop(const CorrectionSetting& s, const CorrectionPlan& plan,
       const inputs::Controller& wanted)
      : wanted_(wanted),
        omega_(s.cut.setup.cut.Omega),
        middle_((s.limits.stroke_low + s.limits.stroke_high) / 2),
        random_(1),
        rigid_(s.cut.setup, s.cut.law, 1),
        config_(config_of(s, plan, wanted)) {
    arc_middle_ = (rigid_.arc().from + rigid_.arc().to) / 2;
    refused_ = trochoid_controller_init(&controller_, &config_);
    begin_learning(s, plan);
    out_.turns.resize(static_cast<std::size_t>(wanted.turns));
    for (ControlledTurn& each : out_.turns) {
      each.peaks.assign(rigid_.psi().size(), 0.0);
    }
    out_.lowest = out_.highest = middle_;
  }

  [[nodiscard]] std::string refusal() const {
    if (refused_ != TROCHOID_ACCEPTED) {
      return trochoid_refusal_reason(refused_);
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
      const double period = 1 / wanted_.rate;
      const double late =
          std::clamp(wanted_.jitter * normal_(random_), -0.45 * period, 0.45 * period);
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
    ControlledTurn& now = out_.turns[n];
    double& peak = now.peaks[flute_at(phi)];
    peak = std::max(peak, std::abs(F[1]));
    now.gain = result_.gain;
    now.state = result_.state;
    if (wanted_.adapt && t >= next_force_) {
      next_force_ += 1 / force_rate;
      learn(phi, F[1]);
    }
  }

  ControlledCut finish(bool finite) {
    for (ControlledTurn& each : out_.turns) {
      const auto [low, high] =
          std::minmax_element(each.peaks.begin(), each.peaks.end());
      each.difference = *high > 0 ? 1 - *low / *high : 0.0;
    }
    out_.finite = finite;
    out_.ok = true;
    return std::move(out_);
  }

 private:
  /// The ripple makes the spindle early or late: d phi/dt = Omega (1 + r sin phi).
  [[nodiscard]] double real_time(double phi) const {
    return (phi + wanted_.speed_ripple * (std::cos(phi) - 1)) / omega_;
  }
  [[nodiscard]] double angle_at(double time) const {
    double phi = omega_ * time;
    for (int k = 0; k < 60; ++k) {
      phi = omega_ * time - wanted_.speed_ripple * (std::cos(phi) - 1);
    }
    return phi;
  }

  [[nodiscard]] std::size_t flute_at(double phi) const {
    std::size_t nearest = 0;
    double least = unit::turn;
    for (std::size_t j = 0; j < rigid_.psi().size(); ++j) {
      const double off =
          std::abs(std::remainder(phi - rigid_.psi()[j] - arc_middle_, unit::turn));
      if (off < least) {
        least = off;
        nearest = j;
      }
    }
    return nearest;
  }

  void step(double time) {
    const double phi = angle_at(time);
    const double counts = wanted_.counts;
    const double position = std::floor(phi / unit::turn * counts) / counts;
    const bool pulse = std::floor(phi / unit::turn) > std::floor(angle_ / unit::turn);
    const bool lost =
        wanted_.index_lost_at > 0 && phi >= unit::turn * wanted_.index_lost_at;
    TrochoidControllerInput in{};
    in.position_rev = position;
    in.index_position_rev = std::floor(phi / unit::turn);
    in.dt_s = time - time_;
    in.speed_rps = in.dt_s > 0 ? (position - position_) / in.dt_s : 0.0;
    in.gain = gain_;
    in.index = pulse && !lost ? 1 : 0;
    in.enable = phi >= unit::turn * enabled_from ? 1 : 0;
    result_ = trochoid_controller_step(&controller_, &in);
    angle_ = phi;
    time_ = time;
    position_ = position;
    keep(time);
  }

  void keep(double time) {
    out_.samples.push_back(
        {time, result_.command_m, table_, result_.gain, result_.state});
    out_.lowest = std::min(out_.lowest, result_.command_m);
    out_.highest = std::max(out_.highest, result_.command_m);
    if (result_.state != TROCHOID_FAULT) {
      return;
    }
    if (out_.fault == TROCHOID_NO_PROBLEM) {
      out_.fault = result_.fault;
      out_.fault_time = time;
    }
    if (out_.time_to_safe < 0 && std::abs(result_.command_m - middle_) < at_rest) {
      out_.time_to_safe = time - out_.fault_time;
    }
  }

  void begin_learning(const CorrectionSetting& s, const CorrectionPlan& plan) {
    if (!wanted_.adapt) {
      return;
    }
    TrochoidOnlineConfig config;
    trochoid_online_defaults(&config);
    const double at = rigid_.psi()[0] + arc_middle_;
    config.teeth = static_cast<int32_t>(rigid_.psi().size());
    config.window_start_rev = (at - unit::turn / 4) / unit::turn;
    config.feed_per_tooth_m = s.cut.setup.cut.f_z;
    config.difference_m = correction::place_at(plan.motion, at) -
                          correction::place_at(plan.motion, at - unit::turn / 2);
    config.exponent = force::form(s.cut.law).m[0];
    config.gain_high = trochoid_controller_gain_limit(&controller_);
    gain_ = config.gain;
    refused_online_ = trochoid_online_init(&online_, &config);
  }

  void learn(double phi, double force) {
    const bool active = result_.state == TROCHOID_RUNNING;
    gain_ =
        trochoid_online_sample(&online_, phi / unit::turn, force, active ? 1 : 0).gain;
  }

  inputs::Controller wanted_;
  double omega_;
  double middle_;
  std::mt19937_64 random_;
  std::normal_distribution<double> normal_{0.0, 1.0};
  correction::RigidCut rigid_;
  TrochoidControllerConfig config_;
  TrochoidController controller_{};
  TrochoidControllerResult result_{};
  TrochoidOnline online_{};
  int32_t refused_ = TROCHOID_ACCEPTED;
  int32_t refused_online_ = TROCHOID_ONLINE_ACCEPTED;
  double arc_middle_ = 0.0;
  double gain_ = 1.0;
  double next_ = 0.0;
  double next_force_ = 0.0;
  double ticks_ = 0.0;
  double time_ = 0.0;
  double angle_ = 0.0;
  double position_ = 0.0;
  double table_ = 0.0;
  ControlledCut out_;
};

}  // namespace

ControlledCut controlled_cut(const CorrectionSetting& s, const CorrectionPlan& plan,
                             const inputs::Controller& wanted) {
  Loop loop(s, plan, wanted);
  if (const std::string why = loop.refusal(); !why.empty()) {
    return {.reason = "the controller refuses its configuration: " + why};
  }
  dynamics::MotionProblem p = correction::problem_of(s.cut, correction::Harmonics{});
  p.command = [&loop](double t) { return loop.command(t); };
  p.observe = [&loop](double t, const std::array<double, 3>& F, double table) {
    loop.observe(t, F, table);
  };
  p.revolutions = wanted.turns;
  p.kept = 1;
  return loop.finish(dynamics::motion(p).finite);
}

}  // namespace trochoid::run
