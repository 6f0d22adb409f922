#include <trochoid/dynamics/period_map.h>

#include <trochoid/base/units.h>
#include <trochoid/dynamics/nodes.h>
#include <trochoid/dynamics/oscillator.h>
#include <trochoid/numerics/dense.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>

namespace trochoid::dynamics {

namespace {

using numerics::Matrix;

/// What an element of a length and degree does, whatever cuts in it.
struct Response {
  int degree = 0;
  double duration = 0.0;  ///< [s]
  Matrix free;            ///< q at the nodes from the states at the start
  Matrix over;            ///< the states at the end from those at the start
  Matrix ends;            ///< the states at the end from the forces at the nodes
  /// Blocks of G of D-11 from one component to another; empty: zero.
  std::array<Matrix, 4> compliance;
};

struct Solved {
  std::size_t response = 0;
  numerics::Lu lu;  ///< of I - G A_0, where that is not I
};

/// @param eta  row-major, shape (n, n)
void add_compliance(double factor, std::span<const double> eta, std::size_t n,
                    Matrix& block) {
  if (block.values.empty()) {
    if (factor == 0) return;
    block = numerics::zeros(n, n);
  }
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t k = 0; k < n; ++k) block(i, k) += factor * eta[i * n + k];
  }
}

void add_mode(Response& response, const DrivenMotion& motion, std::size_t r,
              const std::array<double, 2>& direction, std::size_t count) {
  const std::size_t n = motion.end_velocity.size();
  const std::span<const double> at_end = std::span(motion.eta).last(n);
  for (std::size_t c = 0; c < count; ++c) {
    const double along = direction[c];
    for (std::size_t i = 0; i < n; ++i) {
      response.free(c * n + i, 2 * r) = along * motion.free[i][0];
      response.free(c * n + i, 2 * r + 1) = along * motion.free[i][1];
      response.ends(2 * r, c * n + i) = along * at_end[i];
      response.ends(2 * r + 1, c * n + i) = along * motion.end_velocity[i];
    }
    for (std::size_t b = 0; b < count; ++b) {
      add_compliance(along * direction[b], motion.eta, n,
                     response.compliance[2 * c + b]);
    }
  }
}

Response response_of(const std::vector<ChipMode>& modes, const Components& components,
                     int degree, double duration) {
  const std::size_t values = components.count * (static_cast<std::size_t>(degree) + 1);
  const std::size_t states = 2 * modes.size();
  Response response{degree,
                    duration,
                    numerics::zeros(values, states),
                    numerics::zeros(states, states),
                    numerics::zeros(states, values),
                    {}};
  std::optional<DrivenMotion> motion;
  for (std::size_t r = 0; r < modes.size(); ++r) {
    const bool alike = r > 0 && modes[r].mass == modes[r - 1].mass &&
                       modes[r].damping == modes[r - 1].damping &&
                       modes[r].stiffness == modes[r - 1].stiffness;
    if (!alike) {
      motion = driven_motion(modes[r], degree, duration);
    }
    add_mode(response, *motion, r, components.modes[r], components.count);
    const auto over = free_motion(modes[r], duration);
    for (std::size_t i = 0; i < 4; ++i) {
      response.over(2 * r + i / 2, 2 * r + i % 2) = over[i];
    }
  }
  return response;
}

/// What one pass through the period works with.
struct Work {
  std::vector<double> state;
  std::vector<double> before;  ///< the state at the start of the element
  std::vector<double> force;   ///< of an element
  std::vector<double> values;  ///< q of an element
};

}  // namespace

struct PeriodMap::Parts {
  Components components;
  std::vector<ChipMode> modes;
  double Omega = 0.0;
  double speed = 1.0;  ///< scale of eta' in a disturbance [rad/s]
  PeriodElements elements;
  std::vector<Response> responses;
  std::vector<Solved> solved;

  std::size_t response_at(const PeriodElement& element);
  void solve(const PeriodElement& element);
  void delayed_force(const PeriodElement& element, std::span<const double> before,
                     std::span<const double> now, std::vector<double>& force) const;
  void step(std::size_t k, Work& work, std::span<double> q) const;
};

/// Elements of one length share one.
std::size_t PeriodMap::Parts::response_at(const PeriodElement& element) {
  const double duration = (element.to - element.from) / Omega;
  for (std::size_t i = 0; i < responses.size(); ++i) {
    if (responses[i].degree == element.degree &&
        std::abs(responses[i].duration - duration) < 1e-13 * duration) {
      return i;
    }
  }
  responses.push_back(response_of(modes, components, element.degree, duration));
  return responses.size() - 1;
}

void PeriodMap::Parts::solve(const PeriodElement& e) {
  solved.push_back({response_at(e), {}});
  if (e.own.at_nodes.empty()) {
    return;
  }
  const Response& response = responses[solved.back().response];
  const std::size_t n = e.nodes();
  const std::size_t count = components.count;
  Matrix system = numerics::zeros(count * n, count * n);
  for (std::size_t i = 0; i < system.rows; ++i) system(i, i) = 1.0;
  for (std::size_t a = 0; a < count; ++a) {
    for (std::size_t c = 0; c < count; ++c) {
      const Matrix& G = response.compliance[2 * c + a];
      for (std::size_t b = 0; b < count && !G.values.empty(); ++b) {
        for (std::size_t k = 0; k < n; ++k) {
          const double A = e.own.at_nodes[k][2 * a + b];
          for (std::size_t i = 0; i < n; ++i) {
            system(c * n + i, b * n + k) -= G(i, k) * A;
          }
        }
      }
    }
  }
  solved.back().lu = numerics::lu(system);  // D-11
}

void PeriodMap::Parts::delayed_force(const PeriodElement& e,
                                     std::span<const double> before,
                                     std::span<const double> now,
                                     std::vector<double>& force) const {
  const std::size_t n = e.nodes();
  const std::size_t count = components.count;
  force.assign(count * n, 0.0);
  for (const Channel& channel : e.delayed) {
    for (std::size_t i = 0; i < channel.sources.size(); ++i) {
      const Source& source = channel.sources[i];
      const PeriodElement& from = elements.all[source.element];
      const double* q = source.previous ? &before[from.first] : &now[from.place];
      std::array<double, 2> value{};
      for (std::size_t b = 0; b < count; ++b) {
        const double* values = q + b * from.nodes();
        value[b] =
            source.row.empty()
                ? values[i]
                : std::inner_product(source.row.begin(), source.row.end(), values, 0.0);
      }
      const Matrix2& A = channel.at_nodes[i];
      for (std::size_t c = 0; c < count; ++c) {
        force[c * n + i] -= A[2 * c] * value[0] + A[2 * c + 1] * value[1];
      }
    }
  }
}

/// From the start of an element to its end.
/// @param[in,out] work  force: of the delayed motion; then with that of the motion now
void PeriodMap::Parts::step(std::size_t k, Work& work, std::span<double> q) const {
  const PeriodElement& e = elements.all[k];
  const Response& response = responses[solved[k].response];
  const std::size_t count = components.count;
  const std::size_t n = e.nodes();
  work.before.swap(work.state);
  work.state.assign(work.before.size(), 0.0);
  numerics::add_product(1.0, response.over.values, work.before, work.state);
  if (!e.wanted) {
    return;
  }
  work.values.assign(count * n, 0.0);
  const std::span<double> values(work.values);
  const std::span<double> force(work.force);
  const std::span<double> here = q.subspan(e.place, count * n);
  numerics::add_product(1.0, response.free.values, work.before, values);
  for (std::size_t c = 0; c < count && e.forced; ++c) {
    for (std::size_t b = 0; b < count; ++b) {
      const Matrix& G = response.compliance[2 * c + b];
      if (!G.values.empty()) {
        numerics::add_product(1.0, G.values, force.subspan(b * n, n),
                              values.subspan(c * n, n));
      }
    }
  }
  if (e.own.at_nodes.empty()) {
    std::copy(values.begin(), values.end(), here.begin());
  } else {
    numerics::solve(solved[k].lu, values, here);
  }
  for (std::size_t i = 0; i < e.own.at_nodes.size(); ++i) {
    const Matrix2& A = e.own.at_nodes[i];
    for (std::size_t c = 0; c < count; ++c) {
      for (std::size_t b = 0; b < count; ++b) {
        force[c * n + i] += A[2 * c + b] * here[b * n + i];
      }
    }
  }
  if (e.forced) {
    numerics::add_product(1.0, response.ends.values, force, work.state);
  }
}

PeriodMap::PeriodMap(const Directional& directional, const System& system, double Omega,
                     const Resolution& resolution) {
  auto parts = std::make_unique<Parts>();
  parts->components = components_of(system);
  parts->modes = system.modes;
  parts->Omega = Omega;
  const double fastest = fastest_frequency(system);
  parts->speed = unit::turn * fastest;
  parts->elements =
      period_elements(directional, parts->components, Omega, fastest, resolution);
  for (const PeriodElement& element : parts->elements.all) {
    parts->solve(element);
  }
  parts_ = std::move(parts);
}

PeriodMap::~PeriodMap() = default;
PeriodMap::PeriodMap(PeriodMap&&) noexcept = default;
PeriodMap& PeriodMap::operator=(PeriodMap&&) noexcept = default;

std::size_t PeriodMap::size() const noexcept {
  return parts_->elements.kept_values + 2 * parts_->modes.size();
}

std::size_t PeriodMap::components() const noexcept {
  return parts_->components.count;
}

void PeriodMap::apply(std::span<const double> in, std::span<double> out) const {
  const Parts& p = *parts_;
  const std::size_t states = p.elements.kept_values;
  Work work;
  work.state.resize(2 * p.modes.size());
  for (std::size_t i = 0; i < work.state.size(); ++i) {
    work.state[i] = in[states + i] * (i % 2 == 0 ? 1 : p.speed);
  }
  std::vector<double> q(p.elements.wanted_values);
  for (std::size_t k = 0; k < p.elements.all.size(); ++k) {
    const PeriodElement& e = p.elements.all[k];
    if (e.forced) {
      p.delayed_force(e, in, q, work.force);
    }
    p.step(k, work, q);
    if (e.kept) {
      std::copy_n(q.begin() + static_cast<std::ptrdiff_t>(e.place),
                  p.components.count * e.nodes(),
                  out.begin() + static_cast<std::ptrdiff_t>(e.first));
    }
  }
  for (std::size_t i = 0; i < work.state.size(); ++i) {
    out[states + i] = i % 2 == 0 ? work.state[i] : work.state[i] / p.speed;
  }
}

std::vector<PeriodMap::Node> PeriodMap::disturbance_nodes() const {
  std::vector<Node> out;
  const Parts& p = *parts_;
  for (const PeriodElement& e : p.elements.all) {
    if (!e.kept) {
      continue;
    }
    const ElementNodes& nodes = element_nodes(e.degree);
    std::vector<double> weights(e.nodes());  // of the interpolated polynomial
    for (std::size_t g = 0; g < nodes.gauss_t.size(); ++g) {
      for (std::size_t i = 0; i < e.nodes(); ++i) {
        weights[i] += nodes.gauss_w[g] * nodes.at_gauss[g * e.nodes() + i];
      }
    }
    const double half = 0.5 * (e.to - e.from) / p.Omega;
    const double start = (e.from - p.elements.all.front().from) / p.Omega;
    for (std::size_t i = 0; i < e.nodes(); ++i) {
      out.push_back(
          {start + half * (nodes.t[i] + 1), half * weights[i], e.first + i, e.nodes()});
    }
  }
  return out;
}

}  // namespace trochoid::dynamics
