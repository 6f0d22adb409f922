#include <trochoid/dynamics/make_grid.h>
#include <trochoid/dynamics/motion_record.h>

#include <trochoid/base/units.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace trochoid::dynamics {

namespace {

constexpr double not_there = std::numeric_limits<double>::quiet_NaN();
/// Turns that are compared: periods of up to four turns show; and two of many nodes.
constexpr std::size_t turns_compared = 8;
constexpr std::size_t many_nodes = 200000;
/// So many turns before, what is there to stay was there.
constexpr std::size_t turns_before = 4;
/// More than any change.
constexpr double all = std::numeric_limits<double>::infinity();

/// Place and speed between the ends of a step: the cubic through both.
std::array<double, 2> between(const std::array<double, 2>& a,
                              const std::array<double, 2>& b, double dt, double t) {
  const double u = 1 - t;
  return {
      u * u * (1 + 2 * t) * a[0] + t * t * (3 - 2 * t) * b[0] +
          t * u * dt * (u * a[1] - t * b[1]),
      6 * t * u * (b[0] - a[0]) / dt + u * (1 - 3 * t) * a[1] + t * (3 * t - 2) * b[1]};
}

std::vector<double> sample_angles(int count) {
  std::vector<double> angles;
  angles.reserve(static_cast<std::size_t>(count));
  for (int k = 0; k < count; ++k) {
    angles.push_back(unit::turn * k / count);
  }
  return angles;
}

/// The tips alone: the same cut without helix.
force::Setup tips_of(force::Setup setup) {
  setup.cutter.helix = 0.0;
  return setup;
}

}  // namespace

MotionSamples::MotionSamples(const MotionProblem& problem, const EngagedGrid& grid)
    : problem_(problem),
      samples_(between_nodes(problem.setup, problem.grid, grid,
                             sample_angles(problem.samples_per_rev))),
      cut_(problem.law, samples_.grid, flank_terms(problem.setup)) {}

void MotionSamples::add(const TakenStep& step, Motion& motion) {
  const Snapshot& from = step.from;
  const Snapshot& to = step.to;
  for (; next_ < samples_.node.size() && samples_.node[next_] == step.node + 1;
       ++next_) {
    const double t = samples_.part[next_];
    motion.angle.push_back(unit::turn * step.turn + samples_.grid.angle[next_]);
    motion.time.push_back(motion.angle.back() / problem_.setup.cut.Omega);
    std::array<double, 2> q{};
    std::array<double, 2> v{};
    for (std::size_t r = 0; r < motion.mode.size(); ++r) {
      const auto [place, speed] = between(from[r], to[r], step.dt, t);
      motion.mode[r].push_back(place);
      motion.speed[r].push_back(speed);
      q[0] += problem_.system.modes[r].x * place;
      q[1] += problem_.system.modes[r].y * place;
      v[0] += problem_.system.modes[r].x * speed;
      v[1] += problem_.system.modes[r].y * speed;
    }
    cut_.prepare(next_, samples_.grid.after[next_], step.past);
    motion.force.push_back(cut_.response(q, v).F);
    motion.actuator.push_back(
        problem_.drive ? between(from.back(), to.back(), step.dt, t)[0] : 0.0);
  }
}

void MotionSamples::finish(Motion& motion) const {
  if (commands_.size() < 2) {  // it ran away as soon as it was kept
    motion.command.assign(motion.time.size(), 0.0);
    return;
  }
  std::size_t i = 1;
  for (const double t : motion.time) {
    while (i + 1 < commands_.size() && commands_[i].first < t) {
      ++i;
    }
    const auto& [t_0, c_0] = commands_[i - 1];
    const auto& [t_1, c_1] = commands_[i];
    motion.command.push_back(c_0 + (c_1 - c_0) * (t - t_0) / (t_1 - t_0));
  }
}

FluteWatch::FluteWatch(const MotionProblem& problem, const EngagedGrid& grid)
    : grid_(grid),
      helix_(problem.setup.cutter.helix != 0),
      tips_(helix_
                ? between_nodes(tips_of(problem.setup), problem.grid, grid, grid.angle)
                : BetweenNodes{}),
      cut_(problem.law, helix_ ? tips_.grid : grid),
      before_(grid.teeth, not_there),
      now_(grid.teeth, not_there) {
  const std::vector<double> psi = geometry::tooth_angles(problem.setup.cutter);
  for (const double angle : grid.angle) {
    const auto next = std::upper_bound(psi.begin(), psi.end(), angle + 1e-9);
    flute_.push_back(static_cast<std::size_t>(next - psi.begin()) - 1);
  }
}

void FluteWatch::add(const TakenStep& step, const Force& F, Motion& motion) {
  const std::size_t i = step.node;
  FluteMotion& flute = motion.flutes[flute_[i]];
  flute.peak_x = std::max(flute.peak_x, std::abs(F[0]));
  flute.peak_y = std::max(flute.peak_y, std::abs(F[1]));
  motion.peak = std::max(motion.peak, std::hypot(F[0], F[1]));

  const History& past = step.past;
  const std::array<double, 2> q = {past.x[-1], past.y[-1]};
  std::swap(before_, now_);
  std::fill(now_.begin(), now_.end(), not_there);
  if (helix_) {  // its delays are counted from the end of the step
    cut_.prepare(i, tips_.grid.after[i], past);
  } else {
    cut_.prepare(i, grid_.after[i], {past.x - 1, past.y - 1, past.dx - 1, past.dy - 1});
  }
  for (const auto& [tooth, h] : cut_.chips(q[0], q[1])) {
    now_[tooth] = std::max(0.0, h);
    motion.flutes[tooth].peak_chip = std::max(motion.flutes[tooth].peak_chip, h);
  }
  for (std::size_t j = 0; j < now_.size(); ++j) {
    if (i > 0 && before_[j] >= 0) {
      const double end = now_[j] >= 0 ? now_[j] : before_[j];
      motion.flutes[j].chip_area += 0.5 * (before_[j] + end) * grid_.step[i - 1];
    }
    if (i + 1 == grid_.angle.size() && now_[j] >= 0) {
      motion.flutes[j].chip_area += now_[j] * grid_.step[i];
    }
  }
}

TurnComparison::TurnComparison(const EngagedGrid& grid)
    : nodes_(grid.angle.size()),
      teeth_(grid.teeth),
      pitch_(grid.pitch),
      turns_(nodes_ < many_nodes ? turns_compared : 2),
      force_(turns_ * nodes_),
      forgotten_(force_.size()) {}

void TurnComparison::add(int turn, std::size_t node, const Force& F) {
  const auto n = static_cast<std::size_t>(turn);
  if (done_ == 0) {
    first_ = n * nodes_ + node;
  }
  done_ = n * nodes_ + node + 1;
  force_[place(n, node)] = F;
  forgotten_[place(n, node)] = 0;
}

void TurnComparison::forget(int turn, std::size_t node) {
  const auto n = static_cast<std::size_t>(turn);
  forgotten_[place(n, node)] = 1;
  forgotten_[place(n, node + 1 < nodes_ ? node + 1 : 0)] = 1;
}

/// Largest change of a component over nodes from that so many nodes before; the first one
/// that is more than enough will do.
double TurnComparison::change(std::size_t shift, Window window, double enough) const {
  double largest = 0.0;
  for (std::size_t i = window.from; i < window.to && largest <= enough; ++i) {
    const std::size_t a = i % force_.size();
    const std::size_t b = (i - shift) % force_.size();
    for (std::size_t c = 0; c < 3 && !forgotten_[a] && !forgotten_[b]; ++c) {
      largest = std::max(largest, std::abs(force_[a][c] - force_[b][c]));
    }
  }
  return largest;
}

double TurnComparison::persistence(std::size_t shift) const {
  const std::size_t back = turns_before * nodes_;
  if (back + nodes_ + shift > done_ - first_) {
    return 0.0;
  }
  const double early = change(shift, {done_ - back - nodes_, done_ - back}, all);
  return early > 0 ? change(shift, {done_ - nodes_, done_}, all) / early : 0.0;
}

void TurnComparison::finish(Motion& motion) const {
  const std::size_t seen = done_ - first_;
  if (!motion.finite || !motion.solved || seen < nodes_) {
    motion.last_change = motion.peak;
    return;
  }
  motion.last_change =
      seen < 2 * nodes_ ? motion.peak : change(nodes_, {done_ - nodes_, done_}, all);
  const double same = periodic_tolerance * motion.peak;
  const std::size_t unit = pitch_ > 0 ? pitch_ : nodes_;
  const std::size_t passes = pitch_ > 0 ? 1 : teeth_;
  for (std::size_t k = 1; !motion.passes; ++k) {
    const std::size_t shift = k * unit;
    const std::size_t window = std::max(nodes_, shift);
    if (window + shift > seen) {
      return;
    }
    if (change(shift, {done_ - window, done_}, same) <= same) {
      motion.passes = static_cast<int>(k * passes);  // T-15
      motion.persistence = persistence(shift > nodes_ ? nodes_ : unit);
    }
  }
}

}  // namespace trochoid::dynamics
