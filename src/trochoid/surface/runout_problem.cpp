#include <trochoid/surface/runout_problem.h>

#include <cmath>

namespace trochoid::surface::runout {

std::vector<double> Problem::pack(const State& s, const Unknowns& u) const {
  std::vector<double> p = {s.runout.c / um, s.runout.s / um};
  if (u.start) {
    p.push_back(s.start / f_z);
  }
  if (u.all) {
    p.push_back(s.K[0] / MN_m2);
    p.push_back(s.K[1] / MN_m2);
    for (const double d : s.datum) {
      p.push_back(d / um);
    }
  }
  return p;
}

State Problem::unpack(std::span<const double> p, const Unknowns& u, State s) const {
  std::size_t i = 0;
  s.runout = {p[0] * um, p[1] * um};
  i = 2;
  if (u.start) {
    s.start = p[i++] * f_z;
  }
  if (u.all) {
    s.K[0] = p[i++] * MN_m2;
    s.K[1] = p[i++] * MN_m2;
    for (double& d : s.datum) {
      d = p[i++] * um;
    }
  }
  return s;
}

std::vector<double> Problem::errors(const State& s,
                                    const ToothModel::Forces& forces) const {
  std::vector<double> e = model.predict(forces, s.K, s.runout, s.start);
  const std::size_t n = columns_of_datum.count;
  for (std::size_t i = 0; i < e.size(); ++i) {
    for (std::size_t k = 0; k < n; ++k) {
      e[i] += columns_of_datum.values[i * n + k] * s.datum[k];
    }
  }
  return e;
}

void Problem::residuals(const State& s, const ToothModel::Forces& forces,
                        std::span<double> r) const {
  const std::vector<double> e = errors(s, forces);
  for (std::size_t i = 0; i < e.size(); ++i) {
    r[i] = std::sqrt(count[i]) * (readings[i].error - e[i]) / um;
  }
}

numerics::Residuals residuals_of(const Problem& problem, const Unknowns& u,
                                 const State& about, const ToothModel::Forces* frozen) {
  return [=, &problem](std::span<const double> p, std::span<double> r,
                       std::span<double> jacobian) {
    constexpr double step = 1e-3;
    const auto forces_at = [&](const State& s) {
      return frozen != nullptr ? *frozen : problem.model.forces(s.runout);
    };
    const State here = problem.unpack(p, u, about);
    const ToothModel::Forces forces = forces_at(here);
    problem.residuals(here, forces, r);
    std::vector<double> q(p.begin(), p.end());
    std::vector<double> moved(r.size());
    for (std::size_t k = 0; !jacobian.empty() && k < q.size(); ++k) {
      q[k] = p[k] + step;
      const State s = problem.unpack(q, u, about);
      problem.residuals(s, k < 2 ? forces_at(s) : forces, moved);
      q[k] = p[k];
      for (std::size_t i = 0; i < r.size(); ++i) {
        jacobian[k * r.size() + i] = (moved[i] - r[i]) / step;
      }
    }
    return true;
  };
}

}  // namespace trochoid::surface::runout
