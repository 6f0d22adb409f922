#include <trochoid/dynamics/period_map.h>

#include <trochoid/dynamics/nodes.h>
#include <trochoid/dynamics/oscillator.h>

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace trochoid::dynamics {

namespace {

constexpr double pi = std::numbers::pi;
/// No element holds more cycles of the fastest mode.
constexpr double most_cycles = 7.0;

/// Where a delayed node was, and how to interpolate there.
struct Source {
  std::size_t element = 0;
  bool previous = false;    ///< in the period before
  std::vector<double> row;  ///< empty: the node itself, a period before
};

/// Matrices of one channel at the nodes of an element, in the components of q.
struct Channel {
  std::vector<Matrix2> at_nodes;
  std::vector<Source> sources;  ///< of a delay; shape (nodes)
};

struct Element {
  double from = 0.0;  ///< spindle angle [rad]
  double to = 0.0;    ///< [rad]
  int degree = 0;
  bool forced = false;  ///< something cuts
  bool kept = false;    ///< its q is part of a disturbance
  std::size_t first = 0;
  Channel own;
  std::vector<Channel> delayed;
  std::vector<DrivenMotion> modes;
  Eigen::MatrixXd compliance;  ///< G of D-11
  Eigen::PartialPivLU<Eigen::MatrixXd> lu;
  std::vector<std::array<double, 4>> over;  ///< of each mode

  [[nodiscard]] std::size_t nodes() const noexcept {
    return static_cast<std::size_t>(degree) + 1;
  }
};

/// Directions of the modes in the components of q.
struct Components {
  std::size_t count = 2;
  double x = 1.0;  ///< of the only component
  double y = 0.0;
  std::vector<std::array<double, 2>> modes;

  [[nodiscard]] Matrix2 of(const Matrix2& A) const noexcept {
    if (count == 2) {
      return A;
    }
    return {x * (A[0] * x + A[1] * y) + y * (A[2] * x + A[3] * y), 0, 0, 0};
  }
};

Components components_of(const System& system) {
  Components c;
  const ChipMode& first = system.modes.front();
  const bool one_line =
      std::all_of(system.modes.begin(), system.modes.end(), [&](const ChipMode& mode) {
        return std::abs(mode.x * first.y - mode.y * first.x) < 1e-14;
      });
  if (one_line) {
    c.count = 1;
    c.x = first.x;
    c.y = first.y;
  }
  for (const ChipMode& mode : system.modes) {
    c.modes.push_back(one_line ? std::array{mode.x * c.x + mode.y * c.y, 0.0}
                               : std::array{mode.x, mode.y});
  }
  return c;
}

double fastest_frequency(const System& system) {
  double fastest = 0.0;
  for (const ChipMode& mode : system.modes) {
    fastest = std::max(fastest, std::sqrt(mode.stiffness / mode.mass) / (2 * pi));
  }
  return fastest;
}

std::size_t place_of(const std::vector<Element>& elements, double phi) {
  const auto after = std::lower_bound(
      elements.begin(), elements.end(), phi,
      [](const Element& element, double angle) { return element.to < angle; });
  return std::min(static_cast<std::size_t>(after - elements.begin()),
                  elements.size() - 1);
}

Source source_of(const std::vector<Element>& elements, double phi, double delay,
                 double period) {
  constexpr double slack = 1e-11;  // rounding of angles [rad]
  Source source;
  double at = phi - delay;
  if (at < elements.front().from - slack) {
    source.previous = true;
    at += period;
  }
  source.element = place_of(elements, at - slack);
  const Element& e = elements[source.element];
  const double t = (2 * at - e.from - e.to) / (e.to - e.from);
  source.row.resize(e.nodes());
  lagrange_row(element_nodes(e.degree), std::clamp(t, -1.0, 1.0), source.row);
  return source;
}

}  // namespace

struct PeriodMap::Parts {
  Components components;
  std::vector<ChipMode> modes;
  double Omega = 0.0;
  double period = 0.0;  ///< [rad]
  double speed = 1.0;   ///< scale of eta' in a disturbance [rad/s]
  std::vector<Element> elements;
  std::size_t size = 0;
  std::size_t states = 0;  ///< place of the states in a disturbance
  std::size_t nodes = 0;

  void cut_up(const Directional& directional, const Resolution& resolution,
              double fastest);
  void place(const Directional& directional, bool whole_period);
  void add_sources(const Directional& directional);
  void solve(Element& element) const;
  void delayed_force(const Element& element, std::span<const double> before,
                     std::span<const std::vector<double>> now,
                     Eigen::VectorXd& force) const;
  void step(const Element& element, const Eigen::VectorXd& delayed,
            std::vector<double>& states, std::vector<double>& q) const;
};

namespace {

/// Values at the nodes of a part of a directional element.
std::vector<Matrix2> sampled(const std::vector<Matrix2>& given,
                             const DirectionalElement& whole, const Element& part,
                             const Components& components) {
  const ElementNodes& coarse = element_nodes(directional_degree);
  const ElementNodes& fine = element_nodes(part.degree);
  std::vector<double> row(coarse.t.size());
  std::vector<Matrix2> out;
  for (const double t : fine.t) {
    const double phi = 0.5 * (part.from + part.to) + 0.5 * (part.to - part.from) * t;
    const double u = (2 * phi - whole.from - whole.to) / (whole.to - whole.from);
    lagrange_row(coarse, std::clamp(u, -1.0, 1.0), row);
    Matrix2 value{};
    for (std::size_t i = 0; i < row.size(); ++i) {
      for (std::size_t q = 0; q < value.size(); ++q) {
        value[q] += row[i] * given[i][q];
      }
    }
    out.push_back(components.of(value));
  }
  return out;
}

}  // namespace

void PeriodMap::Parts::cut_up(const Directional& directional,
                              const Resolution& resolution, double fastest) {
  const double shortest_delay =
      directional.delays.empty() ? directional.period : directional.delays.front();
  for (const DirectionalElement& whole : directional.elements) {
    const double length = whole.to - whole.from;
    const double cycles = fastest * length / Omega;
    const int parts =
        std::max({1, static_cast<int>(std::ceil(cycles / most_cycles)),
                  static_cast<int>(std::ceil(length / shortest_delay - 1e-9))});
    for (int k = 0; k < parts; ++k) {
      Element e;
      e.from = whole.from + length * k / parts;
      e.to = k + 1 == parts ? whole.to : whole.from + length * (k + 1) / parts;
      const double n = 10 + 10 * (e.to - e.from) / pi + 3.5 * cycles / parts;
      const int even = 2 * static_cast<int>(std::ceil(0.5 * n * resolution.factor));
      e.degree = std::clamp(even, 4, largest_degree);
      if (!whole.matrices[0].empty()) {
        e.own.at_nodes = sampled(whole.matrices[0], whole, e, components);
      }
      for (std::size_t d = 1; d < whole.matrices.size(); ++d) {
        e.delayed.emplace_back();
        if (!whole.matrices[d].empty()) {
          e.delayed.back().at_nodes = sampled(whole.matrices[d], whole, e, components);
        }
        e.forced = e.forced || !whole.matrices[d].empty();
      }
      e.forced = e.forced || !whole.matrices[0].empty();
      elements.push_back(std::move(e));
    }
  }
}

void PeriodMap::Parts::place(const Directional& directional, bool whole_period) {
  const bool one_delay =
      directional.delays.size() == 1 && std::abs(directional.delays[0] - period) < 1e-9;
  for (Element& e : elements) {
    e.kept = e.forced || whole_period || !one_delay;
    e.first = size;
    size += e.kept ? components.count * e.nodes() : 0;
    nodes += e.kept ? e.nodes() : 0;
  }
  states = size;
  size += 2 * modes.size();
}

void PeriodMap::Parts::add_sources(const Directional& directional) {
  for (Element& e : elements) {
    for (std::size_t d = 0; d < e.delayed.size(); ++d) {
      Channel& channel = e.delayed[d];
      if (channel.at_nodes.empty()) {
        continue;
      }
      const double delay = directional.delays[d];
      const bool same = std::abs(delay - period) < 1e-9;
      for (const double t : element_nodes(e.degree).t) {
        const double phi = 0.5 * (e.from + e.to) + 0.5 * (e.to - e.from) * t;
        channel.sources.push_back(
            same ? Source{static_cast<std::size_t>(&e - elements.data()), true, {}}
                 : source_of(elements, phi, delay, period));
      }
    }
  }
}

void PeriodMap::Parts::solve(Element& e) const {
  const double duration = (e.to - e.from) / Omega;
  for (const ChipMode& mode : modes) {
    e.over.push_back(free_motion(mode, duration));
    if (e.forced || e.kept) {
      e.modes.push_back(driven_motion(mode, e.degree, duration));
    }
  }
  if (!e.forced) {
    return;
  }
  const auto n = static_cast<Eigen::Index>(e.nodes());
  const auto count = static_cast<Eigen::Index>(components.count);
  e.compliance = Eigen::MatrixXd::Zero(count * n, count * n);
  using RowMajor =
      Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  for (std::size_t r = 0; r < modes.size(); ++r) {
    const Eigen::Map<const RowMajor> eta(e.modes[r].eta.data(), n, n);
    const auto& direction = components.modes[r];
    for (Eigen::Index c = 0; c < count; ++c) {
      for (Eigen::Index b = 0; b < count; ++b) {
        const double factor = direction[static_cast<std::size_t>(c)] *
                              direction[static_cast<std::size_t>(b)];
        if (factor != 0) {
          e.compliance.block(c * n, b * n, n, n) += factor * eta;
        }
      }
    }
  }
  Eigen::MatrixXd system = Eigen::MatrixXd::Identity(count * n, count * n);
  for (Eigen::Index j = 0; j < n && !e.own.at_nodes.empty(); ++j) {
    const Matrix2& A = e.own.at_nodes[static_cast<std::size_t>(j)];
    for (Eigen::Index c = 0; c < count; ++c) {
      for (Eigen::Index b = 0; b < count; ++b) {
        system.col(c * n + j) -=
            A[static_cast<std::size_t>(2 * b + c)] * e.compliance.col(b * n + j);
      }
    }
  }
  e.lu.compute(system);  // D-11
}

void PeriodMap::Parts::delayed_force(const Element& e, std::span<const double> before,
                                     std::span<const std::vector<double>> now,
                                     Eigen::VectorXd& force) const {
  const std::size_t n = e.nodes();
  const std::size_t count = components.count;
  force.setZero(static_cast<Eigen::Index>(count * n));
  for (const Channel& channel : e.delayed) {
    for (std::size_t i = 0; i < channel.sources.size(); ++i) {
      const Source& source = channel.sources[i];
      const Element& from = elements[source.element];
      const double* q =
          source.previous ? &before[from.first] : now[source.element].data();
      std::array<double, 2> value{};
      for (std::size_t b = 0; b < count; ++b) {
        const double* values = q + b * from.nodes();
        if (source.row.empty()) {
          value[b] = values[i];
          continue;
        }
        for (std::size_t k = 0; k < source.row.size(); ++k) {
          value[b] += source.row[k] * values[k];
        }
      }
      const Matrix2& A = channel.at_nodes[i];
      for (std::size_t c = 0; c < count; ++c) {
        force[static_cast<Eigen::Index>(c * n + i)] -=
            A[2 * c] * value[0] + A[2 * c + 1] * value[1];
      }
    }
  }
}

/// From the start of an element to its end.
void PeriodMap::Parts::step(const Element& e, const Eigen::VectorXd& delayed,
                            std::vector<double>& state, std::vector<double>& q) const {
  const std::size_t n = e.nodes();
  const std::size_t count = components.count;
  Eigen::VectorXd values;
  if (e.kept) {
    values.setZero(static_cast<Eigen::Index>(count * n));
    for (std::size_t r = 0; r < modes.size(); ++r) {
      for (std::size_t i = 0; i < n; ++i) {
        const auto& free = e.modes[r].free[i];
        const double eta = free[0] * state[2 * r] + free[1] * state[2 * r + 1];
        for (std::size_t c = 0; c < count; ++c) {
          values[static_cast<Eigen::Index>(c * n + i)] += components.modes[r][c] * eta;
        }
      }
    }
  }
  Eigen::VectorXd force;
  if (e.forced) {
    values.noalias() += e.compliance * delayed;
    values = e.lu.solve(values).eval();
    force = delayed;
    for (std::size_t i = 0; i < n && !e.own.at_nodes.empty(); ++i) {
      const Matrix2& A = e.own.at_nodes[i];
      for (std::size_t c = 0; c < count; ++c) {
        for (std::size_t b = 0; b < count; ++b) {
          force[static_cast<Eigen::Index>(c * n + i)] +=
              A[2 * c + b] * values[static_cast<Eigen::Index>(b * n + i)];
        }
      }
    }
  }
  for (std::size_t r = 0; r < modes.size(); ++r) {
    const auto& over = e.over[r];
    double eta = over[0] * state[2 * r] + over[1] * state[2 * r + 1];
    double velocity = over[2] * state[2 * r] + over[3] * state[2 * r + 1];
    for (std::size_t c = 0; e.forced && c < count; ++c) {
      const double direction = components.modes[r][c];
      const double* last = &e.modes[r].eta[(n - 1) * n];
      for (std::size_t i = 0; i < n; ++i) {
        const double f = direction * force[static_cast<Eigen::Index>(c * n + i)];
        eta += last[i] * f;
        velocity += e.modes[r].end_velocity[i] * f;
      }
    }
    state[2 * r] = eta;
    state[2 * r + 1] = velocity;
  }
  q.assign(values.data(), values.data() + values.size());
}

PeriodMap::PeriodMap(const Directional& directional, const System& system, double Omega,
                     const Resolution& resolution) {
  auto parts = std::make_unique<Parts>();
  parts->components = components_of(system);
  parts->modes = system.modes;
  parts->Omega = Omega;
  parts->period = directional.period;
  const double fastest = fastest_frequency(system);
  parts->speed = 2 * pi * fastest;
  parts->cut_up(directional, resolution, fastest);
  parts->place(directional, resolution.whole_period);
  parts->add_sources(directional);
  for (Element& element : parts->elements) {
    parts->solve(element);
  }
  parts_ = std::move(parts);
}

PeriodMap::~PeriodMap() = default;
PeriodMap::PeriodMap(PeriodMap&&) noexcept = default;
PeriodMap& PeriodMap::operator=(PeriodMap&&) noexcept = default;

std::size_t PeriodMap::size() const noexcept {
  return parts_->size;
}

std::size_t PeriodMap::nodes() const noexcept {
  return parts_->nodes;
}

std::size_t PeriodMap::components() const noexcept {
  return parts_->components.count;
}

void PeriodMap::apply(std::span<const double> in, std::span<double> out) const {
  const Parts& p = *parts_;
  std::vector<double> state(in.begin() + static_cast<std::ptrdiff_t>(p.states),
                            in.end());
  for (std::size_t i = 1; i < state.size(); i += 2) {
    state[i] *= p.speed;
  }
  std::vector<std::vector<double>> q(p.elements.size());
  Eigen::VectorXd delayed;
  for (std::size_t k = 0; k < p.elements.size(); ++k) {
    const Element& e = p.elements[k];
    if (e.forced) {
      p.delayed_force(e, in, q, delayed);
    }
    p.step(e, delayed, state, q[k]);
    std::copy(q[k].begin(), q[k].end(),
              out.begin() + static_cast<std::ptrdiff_t>(e.first));
  }
  for (std::size_t i = 0; i < state.size(); ++i) {
    out[p.states + i] = i % 2 == 0 ? state[i] : state[i] / p.speed;
  }
}

std::vector<PeriodMap::Node> PeriodMap::disturbance_nodes() const {
  std::vector<Node> out;
  const Parts& p = *parts_;
  for (const Element& e : p.elements) {
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
    const double start = (e.from - p.elements.front().from) / p.Omega;
    for (std::size_t i = 0; i < e.nodes(); ++i) {
      out.push_back(
          {start + half * (nodes.t[i] + 1), half * weights[i], e.first + i, e.nodes()});
    }
  }
  return out;
}

}  // namespace trochoid::dynamics
