#include <trochoid/dynamics/directional.h>

#include <trochoid/base/units.h>
#include <trochoid/dynamics/engaged.h>
#include <trochoid/dynamics/layers.h>
#include <trochoid/dynamics/nodes.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>
#include <variant>

namespace trochoid::dynamics {

namespace {

/// Break points closer than this are one [rad].
constexpr double same_angle = 1e-10;
/// Layers leave ripples of this part of the matrices, those of waves more.
constexpr double layers_tolerance = 1e-5;
constexpr double waves_tolerance = 1e-4;

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
  Reach reach;
  Layers layers;  ///< of other cutters, up to the deepest

  [[nodiscard]] Directional sampled(double a_p) const;
  [[nodiscard]] Directional of_cylinder(double a_p) const;
  [[nodiscard]] Directional in_layers(double a_p) const;
};

namespace {

bool has_closed_form(const force::Setup& setup) {
  return force::keeps_radius(setup) &&
         !std::holds_alternative<geometry::Arcs>(setup.cut.engagement);
}

}  // namespace

DirectionalModel::DirectionalModel(const force::Setup& setup, const force::Law& law,
                                   double h_floor, double tolerance,
                                   const Reach& reach) {
  auto parts = std::make_shared<Parts>(Parts{setup,
                                             force::terms(law),
                                             h_floor,
                                             tolerance,
                                             {},
                                             has_closed_form(setup),
                                             {},
                                             reach,
                                             {}});
  parts->reach.deepest = std::max(reach.deepest, setup.cut.a_p);
  if (parts->keeps_radius) {
    parts->cylinder = cylinder_arcs(setup, parts->law, h_floor, tolerance);
    if (parts->cylinder.lag_per_height == 0) {
      parts->unit = parts->sampled(1.0);
    }
  } else {
    parts->layers =
        layers_of(setup, parts->law, h_floor, parts->reach.deepest, reach.cycle);
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

namespace {

/// @param evaluate  matrices at an angle
/// @param start     period and delays of the cut, and nothing yet
Directional cut_up(Directional start, std::vector<double> breaks,
                   const Evaluate& evaluate, const Largest& allowed) {
  const std::vector<double> ends = ordered_breaks(std::move(breaks), start.period);
  Sampler sampler(start, evaluate,
                  {std::max(allowed.cutting, 1e-300), allowed.damping});
  for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
    sampler.add(ends[i], ends[i + 1], 0);
  }
  return start;
}

}  // namespace

Directional DirectionalModel::Parts::sampled(double a_p) const {
  return keeps_radius ? of_cylinder(a_p) : in_layers(a_p);
}

Directional DirectionalModel::Parts::of_cylinder(double a_p) const {
  const CylinderArcs& arcs = cylinder;
  const double lag = arcs.lag_per_height * a_p < 1e-8 ? 0.0 : arcs.lag_per_height * a_p;
  const auto evaluate = [&](double phi, double middle, Sample& sample) {
    evaluate_cylinder(arcs, lag, phi, middle, sample);
    for (Matrix2& m : sample) {
      for (double& value : m) {
        value *= a_p;
      }
    }
  };
  return cut_up(
      {arcs.passes.period, arcs.passes.delays, {}}, arcs.breaks(lag), evaluate,
      {tolerance * arcs.largest.cutting * a_p, tolerance * arcs.largest.damping * a_p});
}

Directional DirectionalModel::Parts::in_layers(double a_p) const {
  if (a_p > reach.deepest * (1 + 1e-9)) {
    throw std::invalid_argument("deeper than the reach of the model");
  }
  const auto evaluate = [&](double phi, double middle, Sample& sample) {
    layers.add(a_p, phi, middle, sample);
  };
  const double ripples = setup.cutter.serration ? waves_tolerance : layers_tolerance;
  const double part = std::max(tolerance, ripples);
  const Largest largest = layers.largest(a_p);
  return cut_up({layers.period, layers.delays.delays(), {}}, layers.breaks(a_p),
                evaluate, {part * largest.cutting, part * largest.damping});
}

}  // namespace trochoid::dynamics
