#include <trochoid/dynamics/period_map.h>

#include <trochoid/base/units.h>
#include <trochoid/dynamics/nodes.h>
#include <trochoid/dynamics/oscillator.h>

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace trochoid::dynamics {

namespace {

constexpr double pi = std::numbers::pi;

using Index = Eigen::Index;
using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

Index index(std::size_t i) {
  return static_cast<Index>(i);
}

/// What an element of a length and degree does, whatever cuts in it.
struct Response {
  int degree = 0;
  double duration = 0.0;  ///< [s]
  Eigen::MatrixXd free;   ///< q at the nodes from the states at the start
  Eigen::MatrixXd over;   ///< the states at the end from those at the start
  Eigen::MatrixXd ends;   ///< the states at the end from the forces at the nodes
  /// Blocks of G of D-11 from one component to another; empty: zero.
  std::array<Eigen::MatrixXd, 4> compliance;
};

struct Solved {
  std::size_t response = 0;
  Eigen::PartialPivLU<Eigen::MatrixXd> lu;  ///< of I - G A_0
};

void add_mode(Response& response, const DrivenMotion& motion, std::size_t r,
              const std::array<double, 2>& direction, std::size_t count) {
  const Index n = index(motion.end_velocity.size());
  const Eigen::Map<const RowMajor> eta(motion.eta.data(), n, n);
  const Eigen::Map<const Eigen::RowVectorXd> velocity(motion.end_velocity.data(), n);
  for (std::size_t c = 0; c < count; ++c) {
    const double along = direction[c];
    for (Index i = 0; i < n; ++i) {
      const auto& free = motion.free[static_cast<std::size_t>(i)];
      response.free(index(c) * n + i, index(2 * r)) = along * free[0];
      response.free(index(c) * n + i, index(2 * r) + 1) = along * free[1];
    }
    response.ends.block(index(2 * r), index(c) * n, 1, n) = along * eta.row(n - 1);
    response.ends.block(index(2 * r) + 1, index(c) * n, 1, n) = along * velocity;
    for (std::size_t b = 0; b < count; ++b) {
      Eigen::MatrixXd& block = response.compliance[2 * c + b];
      if (block.size() == 0 && along * direction[b] != 0) {
        block.setZero(n, n);
      }
      if (block.size() > 0) {
        block += along * direction[b] * eta;
      }
    }
  }
}

Response response_of(const std::vector<ChipMode>& modes, const Components& components,
                     int degree, double duration) {
  Response response{degree, duration, {}, {}, {}, {}};
  const Index values = index(components.count) * (degree + 1);
  const Index states = index(2 * modes.size());
  response.free.resize(values, states);
  response.ends.resize(states, values);
  response.over.setZero(states, states);
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
    response.over.block<2, 2>(index(2 * r), index(2 * r)) =
        Eigen::Map<const Eigen::Matrix<double, 2, 2, Eigen::RowMajor>>(over.data());
  }
  return response;
}

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
                     std::span<const double> now, Eigen::VectorXd& force) const;
  void step(std::size_t k, Eigen::VectorXd& force, Eigen::VectorXd& state,
            std::span<double> q) const;
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
  const Index n = index(e.nodes());
  const std::size_t count = components.count;
  const Index size = index(count) * n;
  Eigen::MatrixXd system = Eigen::MatrixXd::Identity(size, size);
  Eigen::VectorXd A(n);
  for (std::size_t a = 0; a < count; ++a) {
    for (std::size_t b = 0; b < count; ++b) {
      for (Index i = 0; i < n; ++i) {
        A[i] = e.own.at_nodes[static_cast<std::size_t>(i)][2 * a + b];
      }
      for (std::size_t c = 0; c < count; ++c) {
        const Eigen::MatrixXd& G = response.compliance[2 * c + a];
        if (G.size() > 0) {
          system.block(index(c) * n, index(b) * n, n, n) -= G * A.asDiagonal();
        }
      }
    }
  }
  solved.back().lu.compute(system);  // D-11
}

void PeriodMap::Parts::delayed_force(const PeriodElement& e,
                                     std::span<const double> before,
                                     std::span<const double> now,
                                     Eigen::VectorXd& force) const {
  const std::size_t n = e.nodes();
  const std::size_t count = components.count;
  force.setZero(index(count * n));
  for (const Channel& channel : e.delayed) {
    for (std::size_t i = 0; i < channel.sources.size(); ++i) {
      const Source& source = channel.sources[i];
      const PeriodElement& from = elements.all[source.element];
      const double* q = source.previous ? &before[from.first] : &now[from.place];
      const Index width = index(from.nodes());
      std::array<double, 2> value{};
      for (std::size_t b = 0; b < count; ++b) {
        const double* values = q + b * from.nodes();
        value[b] = source.row.empty()
                       ? values[i]
                       : Eigen::Map<const Eigen::VectorXd>(source.row.data(), width)
                             .dot(Eigen::Map<const Eigen::VectorXd>(values, width));
      }
      const Matrix2& A = channel.at_nodes[i];
      for (std::size_t c = 0; c < count; ++c) {
        force[index(c * n + i)] -= A[2 * c] * value[0] + A[2 * c + 1] * value[1];
      }
    }
  }
}

/// From the start of an element to its end.
/// @param[in,out] force  of the delayed motion; then with that of the motion now
void PeriodMap::Parts::step(std::size_t k, Eigen::VectorXd& force,
                            Eigen::VectorXd& state, std::span<double> q) const {
  const PeriodElement& e = elements.all[k];
  const Response& response = responses[solved[k].response];
  const std::size_t count = components.count;
  const Index n = index(e.nodes());
  Eigen::VectorXd values;
  if (e.wanted) {
    values.noalias() = response.free * state;
  }
  state = response.over * state;
  if (e.forced) {
    for (std::size_t c = 0; c < count; ++c) {
      for (std::size_t b = 0; b < count; ++b) {
        const Eigen::MatrixXd& G = response.compliance[2 * c + b];
        if (G.size() > 0) {
          values.segment(index(c) * n, n) += G * force.segment(index(b) * n, n);
        }
      }
    }
    if (!e.own.at_nodes.empty()) {
      values = solved[k].lu.solve(values).eval();
    }
    for (std::size_t i = 0; i < e.own.at_nodes.size(); ++i) {
      const Matrix2& A = e.own.at_nodes[i];
      for (std::size_t c = 0; c < count; ++c) {
        for (std::size_t b = 0; b < count; ++b) {
          force[index(c) * n + index(i)] +=
              A[2 * c + b] * values[index(b) * n + index(i)];
        }
      }
    }
    state.noalias() += response.ends * force;
  }
  std::copy_n(values.data(), values.size(),
              q.begin() + static_cast<std::ptrdiff_t>(e.place));
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
  Eigen::VectorXd state(index(2 * p.modes.size()));
  for (Index i = 0; i < state.size(); ++i) {
    state[i] = in[states + static_cast<std::size_t>(i)] * (i % 2 == 0 ? 1 : p.speed);
  }
  std::vector<double> q(p.elements.wanted_values);
  Eigen::VectorXd force;
  for (std::size_t k = 0; k < p.elements.all.size(); ++k) {
    const PeriodElement& e = p.elements.all[k];
    if (e.forced) {
      p.delayed_force(e, in, q, force);
    }
    p.step(k, force, state, q);
    if (e.kept) {
      std::copy_n(q.begin() + static_cast<std::ptrdiff_t>(e.place),
                  p.components.count * e.nodes(),
                  out.begin() + static_cast<std::ptrdiff_t>(e.first));
    }
  }
  for (Index i = 0; i < state.size(); ++i) {
    out[states + static_cast<std::size_t>(i)] =
        i % 2 == 0 ? state[i] : state[i] / p.speed;
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
