#include <trochoid/dynamics/period_map.h>

#include <trochoid/base/units.h>
#include <trochoid/dynamics/element_response.h>
#include <trochoid/dynamics/nodes.h>
#include <trochoid/numerics/padded.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace trochoid::dynamics {

namespace {

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

/// F += factor A q at the nodes of an element, component by component.
void add_force(const Channel& channel, double factor, std::span<const double> q,
               std::span<double> F, std::size_t n) noexcept {
  const std::size_t count = F.size() / n;
  for (std::size_t c = 0; c < count; ++c) {
    for (std::size_t b = 0; b < count; ++b) {
      const double* const A = &channel.matrices[(c * count + b) * n];
      const double* const from = &q[b * n];
      double* const to = &F[c * n];
      for (std::size_t i = 0; i < n; ++i) to[i] += factor * A[i] * from[i];
    }
  }
}

}  // namespace

struct PeriodMap::Parts {
  /// How an element answers while it cuts.
  struct Solved {
    std::size_t response = 0;
    /// (I - G A_0)^-1 times the motion of the response; empty where A_0 = 0.
    numerics::PaddedMatrix motion;
    /// A_0 + D d/dphi; empty without process damping.
    numerics::PaddedMatrix whole;
  };

  /// What one pass through the period works with.
  struct Work {
    std::vector<double> state;   ///< at the start of the element
    std::vector<double> input;   ///< forces of an element, then the state
    std::vector<double> output;  ///< padded
    std::vector<double> q;       ///< of the period
    std::vector<double> force;   ///< of an element with process damping, padded
    Elimination elimination;
  };

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

  std::size_t response_at(std::size_t k);
  void solve(std::size_t k);
  void delayed_force(const PeriodElement& element, std::span<const double> before,
                     std::span<const double> now, std::span<double> out) const;
  void step(std::size_t k);
  void start(std::span<const double> in);
  void advance(std::size_t k, std::span<const double> in);
};

/// Elements of one length share one, unless they follow normals of their own.
std::size_t PeriodMap::Parts::response_at(std::size_t k) {
  const PeriodElement& e = elements.all[k];
  const bool along = e.wanted && !e.normal.empty();
  const double duration = (e.to - e.from) / Omega;
  const int degree = e.wanted ? e.degree : 0;
  const std::size_t rows = e.wanted ? components.count * e.nodes() : 0;
  const auto known = std::find_if(
      responses.begin(), responses.end(), [&](const ElementResponse& response) {
        return response.degree == degree && response.motion.rows == rows &&
               std::abs(response.duration - duration) < 1e-13 * duration;
      });
  const auto i = static_cast<std::size_t>(known - responses.begin());
  if (known == responses.end()) {
    responses.push_back(element_response(modes, components, degree, duration));
  }
  if (!along) {
    return i;
  }
  responses.push_back(response_along_normals(responses[i], e));
  return responses.size() - 1;
}

void PeriodMap::Parts::solve(std::size_t k) {
  const Channel& own = elements.all[k].own;
  const ElementResponse& response = responses[solved[k].response];
  if (solved[k].whole.rows > 0) {
    answer_damped_cut(response.motion, solved[k].whole, force, work.elimination,
                      solved[k].motion);
  } else if (!own.matrices.empty()) {
    answer_cut(response.motion, own.matrices, force, work.elimination,
               solved[k].motion);
  }
}

void PeriodMap::Parts::delayed_force(const PeriodElement& e,
                                     std::span<const double> before,
                                     std::span<const double> now,
                                     std::span<double> out) const {
  const std::size_t n = e.nodes();
  const std::size_t count = elements.components;
  std::array<double, std::size_t{2} * (largest_degree + 1)> between;
  std::fill(out.begin(), out.end(), 0.0);
  for (const Channel& channel : e.delayed) {
    if (channel.matrices.empty()) {
      continue;
    }
    const auto values_at = [&](const Source& source) {
      const PeriodElement& from = elements.all[source.element];
      return source.previous ? &before[from.first] : &now[from.place];
    };
    const Source& first = channel.sources.front();
    if (first.row.empty()) {
      add_force(channel, -force, {values_at(first), count * n}, out, n);
      continue;
    }
    for (std::size_t i = 0; i < n; ++i) {
      const Source& source = channel.sources[i];
      const double* const values = values_at(source);
      for (std::size_t b = 0; b < count; ++b) {
        between[b * n + i] = dot(source.row, values + b * source.row.size());
      }
    }
    add_force(channel, -force, {between.data(), count * n}, out, n);
  }
}

/// From the start of an element to its end.
/// The force at work is that of the delayed motion; then with that of the motion now.
void PeriodMap::Parts::step(std::size_t k) {
  const PeriodElement& e = elements.all[k];
  const ElementResponse& response = responses[solved[k].response];
  const std::size_t values = response.motion.rows;
  const auto begin = work.input.begin() + static_cast<std::ptrdiff_t>(values);
  std::copy(work.state.begin(), work.state.end(), begin);
  // Without forces nothing but the columns of the states counts.
  const std::size_t first = e.forced ? 0 : values;
  const std::span<const double> input =
      std::span(work.input).subspan(first, values + work.state.size() - first);
  if (e.wanted) {
    const numerics::PaddedMatrix& whole = solved[k].whole;
    const bool cuts = !e.own.matrices.empty() || whole.rows > 0;
    const numerics::PaddedMatrix& motion = cuts ? solved[k].motion : response.motion;
    const std::span<double> here =
        std::span(work.output).first(numerics::padded(values));
    numerics::padded_product(motion.from(first), input, here);
    std::copy_n(here.begin(), values,
                work.q.begin() + static_cast<std::ptrdiff_t>(e.place));
    if (whole.rows > 0) {
      std::span<double> F = std::span(work.force).first(numerics::padded(values));
      numerics::padded_product(whole.from(0), here.first(values), F);
      for (std::size_t i = 0; i < values; ++i) work.input[i] += force * F[i];
    } else if (cuts) {
      add_force(e.own, force, here.first(values), std::span(work.input).first(values),
                e.nodes());
    }
  }
  const std::span<double> end =
      std::span(work.output).first(numerics::padded(work.state.size()));
  numerics::padded_product(response.end.from(first), input, end);
  std::copy_n(end.begin(), work.state.size(), work.state.begin());
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
    parts->solved.push_back(
        {parts->response_at(k), {}, force_on_nodes(parts->elements.all[k])});
    parts->solve(k);
  }
  parts_ = std::move(parts);
}

void PeriodMap::scale_forces(double factor) {
  if (parts_->force == factor) {
    return;
  }
  parts_->force = factor;
  for (std::size_t k = 0; k < parts_->elements.all.size(); ++k) {
    parts_->solve(k);
  }
}

PeriodMap::~PeriodMap() = default;
PeriodMap::PeriodMap(PeriodMap&&) noexcept = default;
PeriodMap& PeriodMap::operator=(PeriodMap&&) noexcept = default;

std::size_t PeriodMap::size() const noexcept {
  return parts_->elements.kept_values + 2 * parts_->modes.size();
}

std::size_t PeriodMap::components() const noexcept {
  return parts_->elements.components;
}

void PeriodMap::Parts::start(std::span<const double> in) {
  work.state.resize(2 * modes.size());
  for (std::size_t i = 0; i < work.state.size(); ++i) {
    work.state[i] = in[elements.kept_values + i] * (i % 2 == 0 ? 1 : speed);
  }
  work.q.resize(elements.wanted_values);
  std::size_t most = work.state.size();
  for (const ElementResponse& response : responses) {
    most = std::max(most, response.motion.rows);
  }
  work.input.resize(most + work.state.size());
  work.output.resize(numerics::padded(most));
  work.force.resize(numerics::padded(most));
}

void PeriodMap::Parts::advance(std::size_t k, std::span<const double> in) {
  const PeriodElement& e = elements.all[k];
  if (e.forced) {
    delayed_force(e, in, work.q,
                  std::span(work.input).first(elements.components * e.nodes()));
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
                  p.elements.components * e.nodes(),
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
    for (std::size_t c = 0; c < p.elements.components; ++c) {
      if (e.forced) {
        force.add(std::span(p.work.input).subspan(c * n, n));
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
