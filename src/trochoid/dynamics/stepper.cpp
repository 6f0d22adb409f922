#include <trochoid/dynamics/stepper.h>

#include <trochoid/dynamics/propagator.h>

#include <algorithm>
#include <cmath>

namespace trochoid::dynamics {

Stepper::Length Stepper::length_of(const MotionProblem& problem, double dt) const {
  Length length{.dt = dt};
  const auto add = [&](double x, double y, double g) {
    length.per_F[0] += x * x * g;
    length.per_F[1] += x * y * g;
    length.per_F[2] += y * y * g;
  };
  for (std::size_t i = 0; i < oscillators_.size(); ++i) {
    const ChipMode& m = problem.system.modes[mode_of_[i]];
    const std::array<double, 4> A = {0, 1, -m.stiffness / m.mass, -m.damping / m.mass};
    const std::array<double, 2> B = {0, 1 / m.mass};
    const Propagator p = propagator(A, B, 2, dt);
    OscillatorStep step;
    std::copy(p.Phi.begin(), p.Phi.end(), step.Phi.begin());
    std::copy(p.G_0.begin(), p.G_0.end(), step.G_0.begin());
    std::copy(p.G_1.begin(), p.G_1.end(), step.G_1.begin());
    length.oscillators.push_back(step);
    add(m.x, m.y, step.G_1[0]);
  }
  if (driven_) {
    const ChipMode& m = problem.system.modes[driven_mode_];
    const Drive& d = *problem.drive;
    const std::array<double, 16> A = {0,
                                      1,
                                      0,
                                      0,  //
                                      -m.stiffness / m.mass,
                                      -m.damping / m.mass,
                                      d.k_s / m.mass,
                                      d.c_s / m.mass,  //
                                      0,
                                      0,
                                      0,
                                      1,  //
                                      0,
                                      0,
                                      -d.a_0 / d.a_2,
                                      -d.a_1 / d.a_2};  // T-2
    const std::array<double, 8> B = {0, 0, 1 / m.mass, 0, 0, 0, 0, 1 / d.a_2};
    const Propagator p = propagator(A, B, 4, dt);
    std::copy(p.Phi.begin(), p.Phi.end(), length.table.Phi.begin());
    std::copy(p.G_0.begin(), p.G_0.end(), length.table.G_0.begin());
    std::copy(p.G_1.begin(), p.G_1.end(), length.table.G_1.begin());
    add(m.x, m.y, length.table.G_1[0]);
  }
  return length;
}

Stepper::Stepper(const MotionProblem& problem, std::span<const double> steps)
    : driven_(problem.drive.has_value()) {
  driven_mode_ = driven_ ? problem.drive->mode : problem.system.modes.size();
  for (std::size_t r = 0; r < problem.system.modes.size(); ++r) {
    const ChipMode& m = problem.system.modes[r];
    if (r == driven_mode_) {
      table_x_ = m.x;
      table_y_ = m.y;
    } else {
      oscillators_.push_back({m.x, m.y});
      mode_of_.push_back(r);
    }
  }
  for (const double dt : steps) {
    const auto known = std::find_if(
        lengths_.begin(), lengths_.end(),
        [&](const Length& length) { return std::abs(length.dt - dt) <= 1e-12 * dt; });
    length_of_step_.push_back(static_cast<std::size_t>(known - lengths_.begin()));
    if (known == lengths_.end()) {
      lengths_.push_back(length_of(problem, dt));
    }
  }
}

void Stepper::begin(std::size_t step, const Force& F, double command) noexcept {
  now_ = &lengths_[length_of_step_[step]];
  per_F_ = now_->per_F;
  base_q_ = {};
  for (std::size_t i = 0; i < oscillators_.size(); ++i) {
    Oscillator& o = oscillators_[i];
    const OscillatorStep& s = now_->oscillators[i];
    const double f = o.x * F[0] + o.y * F[1];
    o.base = {s.Phi[0] * o.z[0] + s.Phi[1] * o.z[1] + s.G_0[0] * f,
              s.Phi[2] * o.z[0] + s.Phi[3] * o.z[1] + s.G_0[1] * f};
    base_q_[0] += o.x * o.base[0];
    base_q_[1] += o.y * o.base[0];
  }
  if (driven_) {
    const TableStep& s = now_->table;
    const double f = table_x_ * F[0] + table_y_ * F[1];
    for (std::size_t i = 0; i < 4; ++i) {
      double sum = s.G_0[2 * i] * f + (s.G_0[2 * i + 1] + s.G_1[2 * i + 1]) * command;
      for (std::size_t k = 0; k < 4; ++k) {
        sum += s.Phi[4 * i + k] * table_.z[k];
      }
      table_.base[i] = sum;
    }
    base_q_[0] += table_x_ * table_.base[0];
    base_q_[1] += table_y_ * table_.base[0];
  }
}

void Stepper::accept(const Force& F) noexcept {
  for (std::size_t i = 0; i < oscillators_.size(); ++i) {
    Oscillator& o = oscillators_[i];
    const OscillatorStep& s = now_->oscillators[i];
    const double f = o.x * F[0] + o.y * F[1];
    o.z = {o.base[0] + s.G_1[0] * f, o.base[1] + s.G_1[1] * f};
  }
  if (driven_) {
    const double f = table_x_ * F[0] + table_y_ * F[1];
    for (std::size_t i = 0; i < 4; ++i) {
      table_.z[i] = table_.base[i] + now_->table.G_1[2 * i] * f;
    }
  }
}

Snapshot Stepper::snapshot() const {
  Snapshot all(oscillators_.size() + (driven_ ? 2 : 0));
  for (std::size_t i = 0; i < oscillators_.size(); ++i) {
    all[mode_of_[i]] = oscillators_[i].z;
  }
  if (driven_) {
    all[driven_mode_] = {table_.z[0], table_.z[1]};
    all.back() = {table_.z[2], table_.z[3]};
  }
  return all;
}

}  // namespace trochoid::dynamics
