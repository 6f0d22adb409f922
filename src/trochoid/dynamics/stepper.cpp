#include <trochoid/dynamics/stepper.h>

#include <trochoid/dynamics/propagator.h>
#include <trochoid/numerics/dense.h>

#include <algorithm>
#include <cmath>

namespace trochoid::dynamics {

namespace {

Propagator of_mode(const ChipMode& m, double dt) {
  const std::array<double, 4> A = {0, 1, -m.stiffness / m.mass, -m.damping / m.mass};
  const std::array<double, 2> B = {0, 1 / m.mass};
  return propagator(A, B, 2, dt);
}

/// States: table, its speed, actuator, its speed; inputs: force and command.
Propagator of_table(const ChipMode& m, const Drive& d, double dt) {
  const std::array<double, 4> table = {-m.stiffness / m.mass, -m.damping / m.mass,
                                       d.k_s / m.mass, d.c_s / m.mass};
  std::array<double, 16> A{};
  A[1] = 1;
  std::copy(table.begin(), table.end(), A.begin() + 4);
  A[11] = 1;
  A[14] = -d.a_0 / d.a_2;
  A[15] = -d.a_1 / d.a_2;  // T-2
  const std::array<double, 8> B = {0, 0, 1 / m.mass, 0, 0, 0, 0, 1 / d.a_2};
  return propagator(A, B, 4, dt);
}

/// T-7
template <std::size_t n>
void solve_repeat(const std::vector<double>& Phi, std::array<double, n>& z) {
  numerics::Matrix left = numerics::zeros(n, n);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t k = 0; k < n; ++k) {
      left(i, k) = (i == k ? 1.0 : 0.0) - Phi[i * n + k];
    }
  }
  const std::array<double, n> end = z;
  numerics::solve(numerics::lu(left), end, z);
}

}  // namespace

Stepper::Length Stepper::length_of(double dt) const {
  Length length{.dt = dt};
  const auto add = [&](double x, double y, double place, double speed) {
    const std::array<double, 3> along = {x * x, x * y, y * y};
    for (std::size_t a = 0; a < along.size(); ++a) {
      length.per_F[a] += along[a] * place;
      length.speed_per_F[a] += along[a] * speed;
    }
  };
  for (const std::size_t r : mode_of_) {
    const ChipMode& m = system_.modes[r];
    const Propagator p = of_mode(m, dt);
    OscillatorStep step;
    step.Phi_0 = {p.Phi[0], p.Phi[2]};
    step.Phi_1 = {p.Phi[1], p.Phi[3]};
    std::copy(p.G_0.begin(), p.G_0.end(), step.G_0.begin());
    std::copy(p.G_1.begin(), p.G_1.end(), step.G_1.begin());
    length.oscillators.push_back(step);
    add(m.x, m.y, step.G_1[0], step.G_1[1]);
  }
  if (drive_) {
    const ChipMode& m = system_.modes[drive_->mode];
    const Propagator p = of_table(m, *drive_, dt);
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t k = 0; k < 4; ++k) {
        length.table.Phi[k][i] = p.Phi[4 * i + k];
      }
      length.table.G_0[i] = p.G_0[2 * i];
      length.table.G_1[i] = p.G_1[2 * i];
      length.table.command[i] = p.G_0[2 * i + 1] + p.G_1[2 * i + 1];
    }
    add(m.x, m.y, length.table.G_1[0], length.table.G_1[1]);
  }
  return length;
}

Stepper::Stepper(const MotionProblem& problem, std::span<const double> steps)
    : system_(problem.system), drive_(problem.drive) {
  for (std::size_t r = 0; r < system_.modes.size(); ++r) {
    const ChipMode& m = system_.modes[r];
    if (drive_ && r == drive_->mode) {
      table_x_ = m.x;
      table_y_ = m.y;
    } else {
      oscillators_.push_back({m.x, m.y});
      mode_of_.push_back(r);
    }
  }
  std::vector<Length> plain;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const double dt = steps[i];
    const double before = i > 0 ? steps[i - 1] : steps.back();
    const auto same = [](double a, double b) { return std::abs(a - b) <= 1e-12 * a; };
    const auto of_length = [&](double length) -> const Length& {
      const auto known = std::find_if(plain.begin(), plain.end(), [&](const auto& l) {
        return same(l.dt, length);
      });
      return known != plain.end() ? *known : plain.emplace_back(length_of(length));
    };
    const auto known =
        std::find_if(lengths_.begin(), lengths_.end(), [&](const Length& length) {
          return same(length.dt, dt) && same(length.before, before);
        });
    length_of_step_.push_back(static_cast<std::size_t>(known - lengths_.begin()));
    if (known == lengths_.end()) {
      Length length = of_length(dt);
      length.before = before;
      carry(of_length(before), length);
      lengths_.push_back(length);
    }
  }
  now_ = lengths_.data();
}

void Stepper::carry(const Length& before, Length& length) const {
  for (std::size_t i = 0; i < oscillators_.size(); ++i) {
    OscillatorStep& s = length.oscillators[i];
    const auto& G = before.oscillators[i].G_1;
    for (std::size_t a = 0; a < 2; ++a) {
      s.carried[a] = s.Phi_0[a] * G[0] + s.Phi_1[a] * G[1];
      s.both[a] = s.carried[a] + s.G_0[a];
    }
  }
  TableStep& s = length.table;
  for (std::size_t i = 0; i < 4; ++i) {
    s.carried[i] = 0.0;
    for (std::size_t k = 0; k < 4; ++k) {
      s.carried[i] += s.Phi[k][i] * before.table.G_1[k];
    }
    s.both[i] = s.carried[i] + s.G_0[i];
  }
}

void Stepper::add(const Force& F) noexcept {
  base_q_ = {};
  for (std::size_t i = 0; i < oscillators_.size(); ++i) {
    Oscillator& o = oscillators_[i];
    const OscillatorStep& s = now_->oscillators[i];
    const double f = o.x * F[0] + o.y * F[1];
    o.base[0] += (s.G_0[0] + s.G_1[0]) * f;
    o.base[1] += (s.G_0[1] + s.G_1[1]) * f;
    base_q_[0] += o.x * o.base[0];
    base_q_[1] += o.y * o.base[0];
  }
  if (drive_) {
    const double f = table_x_ * F[0] + table_y_ * F[1];
    for (std::size_t i = 0; i < 4; ++i) {
      table_[i] += (now_->table.G_0[i] + now_->table.G_1[i]) * f;
    }
    base_q_[0] += table_x_ * table_[0];
    base_q_[1] += table_y_ * table_[0];
  }
}

/// The force at the last node was not the one that this step begins with.
void Stepper::add_jump(const Force& F) noexcept {
  for (std::size_t i = 0; i < oscillators_.size(); ++i) {
    Oscillator& o = oscillators_[i];
    const OscillatorStep& s = now_->oscillators[i];
    const double f = o.x * F[0] + o.y * F[1];
    o.base[0] += s.carried[0] * f;
    o.base[1] += s.carried[1] * f;
    base_q_[0] += o.x * s.carried[0] * f;
    base_q_[1] += o.y * s.carried[0] * f;
  }
  if (drive_) {
    const auto& carried = now_->table.carried;
    const double f = table_x_ * F[0] + table_y_ * F[1];
    for (std::size_t i = 0; i < 4; ++i) {
      table_[i] += carried[i] * f;
    }
    base_q_[0] += table_x_ * carried[0] * f;
    base_q_[1] += table_y_ * carried[0] * f;
  }
}

std::array<double, 2> Stepper::z(std::size_t oscillator,
                                 const Force& F) const noexcept {
  const Oscillator& o = oscillators_[oscillator];
  const auto& G = now_->oscillators[oscillator].G_1;
  const double f = o.x * F[0] + o.y * F[1];
  return {o.base[0] + G[0] * f, o.base[1] + G[1] * f};
}

std::array<double, 4> Stepper::table_z(const Force& F) const noexcept {
  const auto& G = now_->table.G_1;
  const double f = table_x_ * F[0] + table_y_ * F[1];
  return {table_[0] + G[0] * f, table_[1] + G[1] * f, table_[2] + G[2] * f,
          table_[3] + G[3] * f};
}

std::array<double, 2> Stepper::sum(std::size_t state, const Force& F) const noexcept {
  std::array<double, 2> q{};
  if (drive_) {
    const double table = table_z(F)[state];
    q = {table_x_ * table, table_y_ * table};
  }
  for (std::size_t i = 0; i < oscillators_.size(); ++i) {
    const double own = z(i, F)[state];
    q[0] += oscillators_[i].x * own;
    q[1] += oscillators_[i].y * own;
  }
  return q;
}

void Stepper::repeat(double time) {
  for (std::size_t i = 0; i < oscillators_.size(); ++i) {
    oscillators_[i].base = z(i, end_);
    solve_repeat<2>(of_mode(system_.modes[mode_of_[i]], time).Phi,
                    oscillators_[i].base);
  }
  if (drive_) {
    table_ = table_z(end_);
    solve_repeat<4>(of_table(system_.modes[drive_->mode], *drive_, time).Phi, table_);
  }
  end_ = {};
}

Snapshot Stepper::snapshot() const {
  Snapshot all(oscillators_.size() + (drive_ ? 2 : 0));
  for (std::size_t i = 0; i < oscillators_.size(); ++i) {
    all[mode_of_[i]] = z(i, end_);
  }
  if (drive_) {
    const auto table = table_z(end_);
    all[drive_->mode] = {table[0], table[1]};
    all.back() = {table[2], table[3]};
  }
  return all;
}

}  // namespace trochoid::dynamics
