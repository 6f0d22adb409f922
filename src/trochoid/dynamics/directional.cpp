#include <trochoid/dynamics/directional.h>

#include <trochoid/dynamics/engaged.h>
#include <trochoid/dynamics/nodes.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace trochoid::dynamics {

namespace {

/// Break points closer than this are one [rad].
constexpr double same_angle = 1e-10;

/// Matrices of all channels at one angle.
using Sample = std::vector<Matrix2>;
/// @param middle  of the element: tells on which side of a switch an end lies
using Evaluate = std::function<void(double phi, double middle, Sample& out)>;

/// Angles of one period where something switches,
/// ascending, first and last a period apart.
std::vector<double> ordered_breaks(std::vector<double> breaks, double period) {
  if (breaks.empty()) {
    breaks.push_back(0.0);
  }
  for (double& b : breaks) {
    b -= period * std::floor(b / period);
  }
  std::sort(breaks.begin(), breaks.end());
  std::vector<double> out = {breaks.front()};
  const double end = breaks.front() + period;
  for (const double b : breaks) {
    if (b - out.back() > same_angle && end - b > same_angle) {
      out.push_back(b);
    }
  }
  out.push_back(end);
  return out;
}

class Sampler {
 public:
  /// @param allowed  errors, of the matrices on q and on dq/dphi
  Sampler(Directional& out, const Evaluate& evaluate, const Largest& allowed)
      : out_(out), evaluate_(evaluate), allowed_(allowed) {}

  void add(double from, double to, int depth) {
    const ElementNodes& nodes = element_nodes(directional_degree);
    const std::size_t damped = allowed_.damping > 0 ? 1 : 0;
    const std::size_t channels = out_.delays.size() + 1 + damped;
    DirectionalElement element{from, to, {}, {}};
    element.matrices.assign(channels, std::vector<Matrix2>(nodes.t.size()));
    Sample sample;
    const double middle = 0.5 * (from + to);
    for (std::size_t i = 0; i < nodes.t.size(); ++i) {
      sample.assign(channels, Matrix2{});
      evaluate_(middle + 0.5 * (to - from) * nodes.t[i], middle, sample);
      for (std::size_t d = 0; d < channels; ++d) {
        element.matrices[d][i] = sample[d];
      }
    }
    if (depth < 12 && !resolved(element)) {
      add(from, middle, depth + 1);
      add(middle, to, depth + 1);
      return;
    }
    for (std::size_t d = 0; d < channels; ++d) {
      auto& channel = element.matrices[d];
      const bool zero = std::all_of(
          channel.begin(), channel.end(),
          [&](const Matrix2& m) { return largest_entry(m) <= 1e-3 * allowed(d); });
      if (zero) {
        channel.clear();
      }
    }
    if (damped > 0) {
      element.damping = std::move(element.matrices.back());
      element.matrices.pop_back();
    }
    out_.elements.push_back(std::move(element));
  }

 private:
  [[nodiscard]] bool resolved(const DirectionalElement& element) const {
    std::vector<double> values;
    for (std::size_t d = 0; d < element.matrices.size(); ++d) {
      const auto& channel = element.matrices[d];
      for (std::size_t q = 0; q < 4; ++q) {
        values.clear();
        for (const Matrix2& m : channel) {
          values.push_back(m[q]);
        }
        if (chebyshev_tail(values) > allowed(d)) {
          return false;
        }
      }
    }
    return true;
  }

  [[nodiscard]] double allowed(std::size_t channel) const noexcept {
    return channel > out_.delays.size() ? allowed_.damping : allowed_.cutting;
  }

  Directional& out_;
  const Evaluate& evaluate_;
  Largest allowed_;
};

/// Cylinder of constant lead: theta and height are one variable.
void evaluate_cylinder(const CylinderArcs& arcs, double lag, double phi, double middle,
                       Sample& out) {
  for (std::size_t j = 0; j < arcs.passes.psi.size(); ++j) {
    if (lag > 0) {
      arcs.add_edge(j, phi - arcs.passes.psi[j], lag, out);
    } else {
      arcs.add_point(j, phi - arcs.passes.psi[j], middle - arcs.passes.psi[j], out);
    }
  }
  for (Matrix2& m : out) {
    for (double& value : m) {
      value *= lag > 0 ? 1 / lag : 1.0;  // times a_p later
    }
  }
}

}  // namespace

struct DirectionalModel::Parts {
  force::Setup setup;
  force::Terms law;
  double h_floor;
  double tolerance;
  CylinderArcs cylinder;  ///< empty where the cutter is another one
  bool keeps_radius;
  Directional unit;  ///< of straight edges one metre deep; empty for others

  [[nodiscard]] Directional sampled(double a_p) const;
};

DirectionalModel::DirectionalModel(const force::Setup& setup, const force::Law& law,
                                   double h_floor, double tolerance) {
  auto parts = std::make_shared<Parts>(Parts{setup,
                                             force::terms(law),
                                             h_floor,
                                             tolerance,
                                             {},
                                             force::keeps_radius(setup),
                                             {}});
  if (parts->keeps_radius) {
    parts->cylinder = cylinder_arcs(setup, parts->law, h_floor, tolerance);
    if (parts->cylinder.lag_per_height == 0) {
      parts->unit = parts->sampled(1.0);
    }
  }
  parts_ = std::move(parts);
}

bool DirectionalModel::proportional() const noexcept {
  return !parts_->unit.elements.empty();
}

Directional DirectionalModel::at_depth(double a_p) const {
  if (!proportional()) {
    return parts_->sampled(a_p);
  }
  Directional out = parts_->unit;
  const auto scale = [a_p](std::vector<Matrix2>& channel) {
    for (Matrix2& matrix : channel) {
      for (double& value : matrix) value *= a_p;
    }
  };
  for (DirectionalElement& element : out.elements) {
    std::for_each(element.matrices.begin(), element.matrices.end(), scale);
    scale(element.damping);
  }
  return out;
}

Directional DirectionalModel::Parts::sampled(double a_p) const {
  Directional out;
  std::vector<double> breaks;
  Evaluate evaluate;
  Largest largest;
  AxialArcs axial;
  if (keeps_radius) {
    const CylinderArcs& arcs = cylinder;
    const double lag =
        arcs.lag_per_height * a_p < 1e-8 ? 0.0 : arcs.lag_per_height * a_p;
    out.period = arcs.passes.period;
    out.delays = arcs.passes.delays;
    breaks = arcs.breaks(lag);
    largest = {arcs.largest.cutting * a_p, arcs.largest.damping * a_p};
    evaluate = [&arcs, lag, a_p](double phi, double middle, Sample& sample) {
      evaluate_cylinder(arcs, lag, phi, middle, sample);
      for (Matrix2& m : sample) {
        for (double& value : m) {
          value *= a_p;
        }
      }
    };
  } else {
    axial = axial_arcs(setup, law, h_floor, a_p, tolerance);
    out.period = axial.passes.period;
    out.delays = axial.passes.delays;
    breaks = axial.breaks;
    largest = axial.largest;
    evaluate = [&axial](double phi, double, Sample& sample) { axial.add(phi, sample); };
  }
  const std::vector<double> ends = ordered_breaks(std::move(breaks), out.period);
  const Largest allowed{std::max(tolerance * largest.cutting, 1e-300),
                        tolerance * largest.damping};
  Sampler sampler(out, evaluate, allowed);
  for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
    sampler.add(ends[i], ends[i + 1], 0);
  }
  return out;
}

}  // namespace trochoid::dynamics
