#include <trochoid/dynamics/period_map.h>

#include <trochoid/base/units.h>
#include <trochoid/dynamics/element_response.h>
#include <trochoid/dynamics/nodes.h>
#include <trochoid/numerics/dense.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace trochoid::dynamics {

namespace {

using numerics::Matrix;

struct Solved {
  std::size_t response = 0;
  numerics::Lu lu;  ///< of I - G A_0, where that is not I
};

/// Sum of products, in four chains: one would wait for itself.
double dot(std::span<const double> a, const double* b) noexcept {
  std::array<double, 4> sum{};
  const std::size_t n = a.size();
  std::size_t i = 0;
  for (; i + 4 <= n; i += 4) {
    for (std::size_t k = 0; k < 4; ++k) sum[k] += a[i + k] * b[i + k];
  }
  for (; i < n; ++i) sum[0] += a[i] * b[i];
  return (sum[0] + sum[1]) + (sum[2] + sum[3]);
}

/// What one pass through the period works with.
struct Work {
  std::vector<double> state;
  std::vector<double> before;  ///< the state at the start of the element
  std::vector<double> force;   ///< of an element
  std::vector<double> values;  ///< q of an element
  std::vector<double> q;       ///< of the period
};

/// The largest value of an element's and the largest last coefficient.
struct Tail {
  double most = 0.0;
  double last = 0.0;

  void add(std::span<const double> values) noexcept {
    for (const double value : values) most = std::max(most, std::abs(value));
    last = std::max(last, chebyshev_tail(values));
  }
  [[nodiscard]] double share() const noexcept { return most > 0 ? last / most : 0.0; }
};

}  // namespace

struct PeriodMap::Parts {
  Components components;
  std::vector<ChipMode> modes;
  double Omega = 0.0;
  double speed = 1.0;  ///< scale of eta' in a disturbance [rad/s]
  PeriodElements elements;
  std::vector<ElementResponse> responses;
  std::vector<Solved> solved;
  double force = 1.0;  ///< times the matrices of the elements
  bool smooth = false;
  Work work;

  std::size_t response_at(const PeriodElement& element);
  void factorize(std::size_t k);
  void delayed_force(const PeriodElement& element, std::span<const double> before,
                     std::span<const double> now, std::vector<double>& out) const;
  void step(std::size_t k);
  void start(std::span<const double> in);
  void advance(std::size_t k, std::span<const double> in);
};

/// Elements of one length share one.
std::size_t PeriodMap::Parts::response_at(const PeriodElement& element) {
  const double duration = (element.to - element.from) / Omega;
  const int degree = element.wanted ? element.degree : 0;
  for (std::size_t i = 0; i < responses.size(); ++i) {
    if (responses[i].degree == degree &&
        std::abs(responses[i].duration - duration) < 1e-13 * duration) {
      return i;
    }
  }
  responses.push_back(element_response(modes, components, degree, duration));
  return responses.size() - 1;
}

void PeriodMap::Parts::factorize(std::size_t k) {
  const PeriodElement& e = elements.all[k];
  if (e.own.at_nodes.empty()) {
    return;
  }
  const ElementResponse& response = responses[solved[k].response];
  const std::size_t n = e.nodes();
  const std::size_t count = components.count;
  Matrix& system = solved[k].lu.factors;
  system.rows = system.columns = count * n;
  system.values.assign(count * n * count * n, 0.0);
  for (std::size_t i = 0; i < system.rows; ++i) system(i, i) = 1.0;
  for (std::size_t a = 0; a < count; ++a) {
    for (std::size_t c = 0; c < count; ++c) {
      const Matrix& G = response.compliance[2 * c + a];
      for (std::size_t b = 0; b < count && !G.values.empty(); ++b) {
        for (std::size_t j = 0; j < n; ++j) {
          const double A = force * e.own.at_nodes[j][2 * a + b];
          double* const column = &system(c * n, b * n + j);
          for (std::size_t i = 0; i < n; ++i) {
            column[i] -= G(i, j) * A;
          }
        }
      }
    }
  }
  numerics::factorize(solved[k].lu);  // D-11
}

void PeriodMap::Parts::delayed_force(const PeriodElement& e,
                                     std::span<const double> before,
                                     std::span<const double> now,
                                     std::vector<double>& out) const {
  const std::size_t n = e.nodes();
  const std::size_t count = components.count;
  out.assign(count * n, 0.0);
  for (const Channel& channel : e.delayed) {
    const std::size_t many = channel.sources.size() > 1 ? 1 : 0;
    for (std::size_t i = 0; i < channel.at_nodes.size(); ++i) {
      const Source& source = channel.sources[many * i];
      const PeriodElement& from = elements.all[source.element];
      const double* q = source.previous ? &before[from.first] : &now[from.place];
      std::array<double, 2> value{};
      for (std::size_t b = 0; b < count; ++b) {
        const double* values = q + b * from.nodes();
        value[b] = source.row.empty() ? values[i] : dot(source.row, values);
      }
      const Matrix2& A = channel.at_nodes[i];
      for (std::size_t c = 0; c < count; ++c) {
        out[c * n + i] -= force * (A[2 * c] * value[0] + A[2 * c + 1] * value[1]);
      }
    }
  }
}

/// From the start of an element to its end.
/// The force at work is that of the delayed motion; then with that of the motion now.
void PeriodMap::Parts::step(std::size_t k) {
  const PeriodElement& e = elements.all[k];
  const ElementResponse& response = responses[solved[k].response];
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
  const std::span<double> forces(work.force);
  const std::span<double> here = std::span(work.q).subspan(e.place, count * n);
  numerics::add_product(1.0, response.free.values, work.before, values);
  for (std::size_t c = 0; c < count && e.forced; ++c) {
    for (std::size_t b = 0; b < count; ++b) {
      const Matrix& G = response.compliance[2 * c + b];
      if (!G.values.empty()) {
        numerics::add_product(1.0, G.values, forces.subspan(b * n, n),
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
        forces[c * n + i] += force * A[2 * c + b] * here[b * n + i];
      }
    }
  }
  if (e.forced) {
    numerics::add_product(1.0, response.ends.values, forces, work.state);
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
  parts->smooth = parts->elements.pitches > 0;
  for (std::size_t k = 0; k < parts->elements.all.size(); ++k) {
    parts->solved.push_back({parts->response_at(parts->elements.all[k]), {}});
    parts->factorize(k);
  }
  parts_ = std::move(parts);
}

void PeriodMap::scale_forces(double factor) {
  if (parts_->force == factor) {
    return;
  }
  parts_->force = factor;
  for (std::size_t k = 0; k < parts_->elements.all.size(); ++k) {
    parts_->factorize(k);
  }
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

void PeriodMap::Parts::start(std::span<const double> in) {
  work.state.resize(2 * modes.size());
  for (std::size_t i = 0; i < work.state.size(); ++i) {
    work.state[i] = in[elements.kept_values + i] * (i % 2 == 0 ? 1 : speed);
  }
  work.q.resize(elements.wanted_values);
}

void PeriodMap::Parts::advance(std::size_t k, std::span<const double> in) {
  const PeriodElement& e = elements.all[k];
  if (e.forced) {
    delayed_force(e, in, work.q, work.force);
  }
  step(k);
}

void PeriodMap::apply(std::span<const double> in, std::span<double> out) {
  Parts& p = *parts_;
  p.start(in);
  for (std::size_t k = 0; k < p.elements.all.size(); ++k) {
    const PeriodElement& e = p.elements.all[k];
    p.advance(k, in);
    if (e.kept) {
      std::copy_n(p.work.q.begin() + static_cast<std::ptrdiff_t>(e.place),
                  p.components.count * e.nodes(),
                  out.begin() + static_cast<std::ptrdiff_t>(e.first));
    }
  }
  const std::vector<double>& state = p.work.state;
  for (std::size_t i = 0; i < state.size(); ++i) {
    out[p.elements.kept_values + i] = i % 2 == 0 ? state[i] : state[i] / p.speed;
  }
}

bool PeriodMap::smooth() const noexcept {
  return parts_->smooth;
}

double PeriodMap::unresolved(std::span<const double> in) {
  Parts& p = *parts_;
  p.start(in);
  Tail motion;
  Tail force;
  for (std::size_t k = 0; k < p.elements.all.size(); ++k) {
    const PeriodElement& e = p.elements.all[k];
    p.advance(k, in);
    const std::size_t n = e.nodes();
    for (std::size_t c = 0; c < p.components.count; ++c) {
      if (e.forced) {
        force.add(std::span(p.work.force).subspan(c * n, n));
      }
      if (e.wanted) {
        motion.add(std::span(p.work.q).subspan(e.place + c * n, n));
      }
    }
  }
  return std::max(motion.share(), force.share());  // D-14
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
