#include <trochoid/dynamics/motion.h>

#include <trochoid/dynamics/cut_force.h>
#include <trochoid/dynamics/stepper.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace trochoid::dynamics {

namespace {

constexpr double turn = 2 * std::numbers::pi;
/// Iterations for the force at the end of a step, and when they may end [N, relative].
constexpr int most_iterations = 20;
constexpr double settled = 1e-6;
/// A displacement that no cut has [m]: the motion has run away.
constexpr double run_away = 0.1;

double size_of(const Force& F) {
  return std::abs(F[0]) + std::abs(F[1]) + std::abs(F[2]);
}

double distance(const Force& a, const Force& b) {
  return std::abs(a[0] - b[0]) + std::abs(a[1] - b[1]) + std::abs(a[2] - b[2]);
}

/// Cubic between the ends of a step, from places and speeds.
double between(const std::array<double, 2>& a, const std::array<double, 2>& b,
               double dt, double t) {
  const double u = 1 - t;
  return u * u * (1 + 2 * t) * a[0] + t * t * (3 - 2 * t) * b[0] +
         t * u * dt * (u * a[1] - t * b[1]);
}

std::vector<double> times_of(const EngagedGrid& grid, double omega) {
  std::vector<double> times;
  for (const double step : grid.step) {
    times.push_back(step / omega);
  }
  return times;
}

/// One step that was taken.
struct Interval {
  double from = 0.0;  ///< spindle angle [rad]
  double to = 0.0;
  Force F_0{};
  Force F_1{};
};

class Run {
 public:
  explicit Run(const MotionProblem& problem)
      : problem_(problem),
        grid_(engaged_grid(problem.setup, problem.grid)),
        cut_(problem.law, grid_),
        omega_(problem.setup.cut.Omega),
        dt_(times_of(grid_, omega_)),
        stepper_(problem, dt_),
        index_(grid_.lookback * grid_.nodes) {
    const std::size_t total =
        index_ + grid_.angle.size() * static_cast<std::size_t>(problem.revolutions) + 1;
    q_x_.assign(total, 0.0);
    q_y_.assign(total, 0.0);
    motion_.flutes.resize(static_cast<std::size_t>(problem.setup.cutter.teeth()));
    motion_.mode.resize(problem.system.modes.size());
    last_turn_.resize(grid_.angle.size());
  }

  Motion go() {
    Force F = cut_.at(grid_.after[0], past(index_), 0.0, 0.0);
    before_ = F;
    for (int n = 0; n < problem_.revolutions && motion_.finite; ++n) {
      motion_.once.push_back({q_x_[index_], q_y_[index_]});
      motion_.last_change = 0.0;
      for (std::size_t i = 0; i < grid_.angle.size() && motion_.finite; ++i) {
        motion_.last_change = std::max(motion_.last_change, distance(F, last_turn_[i]));
        last_turn_[i] = F;
        F = step_once(n, i, F);
      }
      ++motion_.turns_done;
    }
    motion_.growth = growth();
    add_command();
    return std::move(motion_);
  }

 private:
  [[nodiscard]] History past(std::size_t at) const {
    return {q_x_.data() + at, q_y_.data() + at};
  }

  /// @return the force at the start of the next step
  Force step_once(int n, std::size_t i, const Force& F) {
    const std::size_t node = i % grid_.nodes;
    const std::size_t next = i + 1 < grid_.angle.size() ? i + 1 : 0;
    const double phi = turn * n + grid_.angle[i];
    const bool kept = n >= problem_.revolutions - problem_.kept;
    if (n + 1 == problem_.revolutions) {
      watch_flutes(i, F);
    }
    if (problem_.observe) {
      problem_.observe(phi / omega_, F, stepper_.table());
    }
    const double middle = phi / omega_ + 0.5 * dt_[node];
    const double command = problem_.command ? problem_.command(middle) : 0.0;
    if (kept) {
      start_ = stepper_.snapshot();
      commands_.push_back({middle, command});
    }
    stepper_.begin(node, F, command);
    cut_.prepare(grid_.before[next], past(index_ + 1));
    const Force end = force_at_end(F);
    stepper_.accept(end);
    if (kept) {
      keep({phi, phi + grid_.step[node], F, end});
    }
    const auto q = stepper_.end(end);
    ++index_;
    q_x_[index_] = q[0];
    q_y_[index_] = q[1];
    motion_.finite = std::abs(q[0]) + std::abs(q[1]) < run_away;
    if (!grid_.jump[next]) {
      before_ = F;
      return end;
    }
    before_ = cut_.at(grid_.after[next], past(index_), q[0], q[1]);
    return before_;
  }

  /// The force that agrees with the motion it makes. It starts from the last two; as it
  /// moves q by little, each round is far better than the one before, by a factor that
  /// is learnt.
  Force force_at_end(const Force& F) {
    Force guess;
    for (std::size_t a = 0; a < 3; ++a) {
      guess[a] = 2 * F[a] - before_[a];
    }
    double last = 0.0;
    for (int k = 0; k < most_iterations; ++k) {
      const auto q = stepper_.end(guess);
      const Force better = cut_.force(q[0], q[1]);
      const double off = distance(better, guess);
      guess = better;
      if (last > 0 && off > 0) {
        contraction_ = std::max(0.9 * contraction_, 2 * off / last);
      }
      last = off;
      if (std::min(1.0, contraction_) * off <= settled * (1e-3 + size_of(better))) {
        break;
      }
    }
    return guess;
  }

  /// The samples that fall into a step.
  void keep(const Interval& step) {
    const double spacing = turn / problem_.samples_per_rev;
    const double slack = 1e-9 * spacing;
    const Snapshot end = stepper_.snapshot();
    const double dt = (step.to - step.from) / omega_;
    for (double k = std::ceil((step.from - slack) / spacing);
         k * spacing < step.to - slack; k += 1) {
      const double t = (k * spacing - step.from) / (step.to - step.from);
      motion_.angle.push_back(k * spacing);
      motion_.time.push_back(k * spacing / omega_);
      Force F;
      for (std::size_t a = 0; a < 3; ++a) {
        F[a] = (1 - t) * step.F_0[a] + t * step.F_1[a];
      }
      motion_.force.push_back(F);
      for (std::size_t r = 0; r < motion_.mode.size(); ++r) {
        motion_.mode[r].push_back(between(start_[r], end[r], dt, t));
      }
      motion_.actuator.push_back(
          problem_.drive ? between(start_.back(), end.back(), dt, t) : 0.0);
    }
  }

  /// The command at the samples, from what it was in the middle of the steps.
  void add_command() {
    if (commands_.size() < 2) {  // it ran away as soon as it was kept
      motion_.command.assign(motion_.time.size(), 0.0);
      return;
    }
    std::size_t i = 1;
    for (const double t : motion_.time) {
      while (i + 1 < commands_.size() && commands_[i].first < t) {
        ++i;
      }
      const auto& [t_0, c_0] = commands_[i - 1];
      const auto& [t_1, c_1] = commands_[i];
      motion_.command.push_back(c_0 + (c_1 - c_0) * (t - t_0) / (t_1 - t_0));
    }
  }

  /// Peaks belong to the tooth whose turn it is; chips to their own tooth.
  void watch_flutes(std::size_t i, const Force& F) {
    cut_.prepare(grid_.after[i], past(index_));
    const double step = grid_.step[i % grid_.nodes];
    for (const auto& [tooth, h] : cut_.chips(q_x_[index_], q_y_[index_])) {
      FluteMotion& flute = motion_.flutes[tooth];
      flute.chip_area += h * step;
      flute.peak_chip = std::max(flute.peak_chip, h);
    }
    FluteMotion& now = motion_.flutes[i / grid_.nodes];
    now.peak_x = std::max(now.peak_x, std::abs(F[0]));
    now.peak_y = std::max(now.peak_y, std::abs(F[1]));
  }

  /// Of the change of q from turn to turn, over the second half.
  [[nodiscard]] double growth() const {
    const auto& once = motion_.once;
    if (once.size() < 6) {
      return 1.0;
    }
    const auto change = [&](std::size_t i) {
      return std::hypot(once[i][0] - once[i - 1][0], once[i][1] - once[i - 1][1]);
    };
    const std::size_t last = once.size() - 1;
    const std::size_t first = last / 2;
    const double a = change(first);
    const double b = change(last);
    return a > 0 && b > 0 ? std::pow(b / a, 1.0 / static_cast<double>(last - first))
                          : 0.0;
  }

  const MotionProblem& problem_;
  EngagedGrid grid_;
  CutForce cut_;
  double omega_;
  std::vector<double> dt_;
  Stepper stepper_;
  std::size_t index_;
  std::vector<double> q_x_;
  std::vector<double> q_y_;
  std::vector<Force> last_turn_;
  Force before_{};                                   ///< force one step earlier
  std::vector<std::pair<double, double>> commands_;  ///< kept: time and value
  double contraction_ = 1.0;
  Snapshot start_;
  Motion motion_;
};

}  // namespace

Motion motion(const MotionProblem& problem) {
  return Run(problem).go();
}

}  // namespace trochoid::dynamics
