#include <trochoid/force/forces.h>

#include <trochoid/base/units.h>
#include <trochoid/force/axial.h>
#include <trochoid/force/cumulative.h>
#include <trochoid/force/turn_kernel.h>
#include <trochoid/force/turn_polynomial.h>
#include <trochoid/numerics/parallel.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <unordered_map>
#include <variant>

#include "node_force.h"

namespace trochoid::force {

namespace {

MomentWeights moment_weights(const Law& law) {
  std::vector<double> K = coefficients(law);
  K.resize(6);  // no edge forces: zeros
  return {{{0, -K[0], -K[1], 0, 0, -K[4], -K[3], 0},
           {K[0], 0, 0, -K[1], 0, K[3], -K[4], 0},
           {0, 0, 0, 0, -K[2], 0, 0, -K[5]}}};
}

/// @param columns  3, or 6 with edge forces
void moments_to_matrix(const EdgeMoments& m, std::size_t columns, double* C) noexcept {
  const std::array<std::array<double, 6>, 3> rows = {
      {{-m[1], -m[2], 0, -m[6], -m[5], 0},
       {m[0], -m[3], 0, m[5], -m[6], 0},
       {0, 0, -m[4], 0, 0, -m[7]}}};
  for (const auto& row : rows) {
    C = std::copy_n(row.begin(), columns, C);
  }
}

/// Error of the chips behind a TurnPolynomial, of the largest chip: one harmonic more
/// costs little.
constexpr double turn_tolerance = 1e-8;
/// The same where differences of matrices are taken.
constexpr double smooth_turn_tolerance = 1e-11;
/// Chips at nodes are followed at least so closely: it costs next to nothing.
constexpr double node_tolerance = 1e-6;

/// @brief How the teeth cut, where forces are linear in the chip and the chips have few
/// harmonics.
std::optional<TurnTeeth> linear_turn(const Setup& setup, const Law& law,
                                     double tolerance) {
  return form(law).power ? std::nullopt : turn_teeth(setup, tolerance);
}

/// The six different entries of [C].
struct TurnMatrix {
  TurnPolynomial chip;  ///< integrals of h sin, h cos, h
  TurnPolynomial edge;  ///< of e sin, e cos, e

  void evaluate(std::span<const double> phi, std::size_t columns,
                std::span<double> C) const noexcept {
    constexpr std::size_t chunk = 256;
    std::array<double, 3 * chunk> h;
    std::array<double, 3 * chunk> e;
    for (std::size_t first = 0; first < phi.size(); first += chunk) {
      const auto some = phi.subspan(first, std::min(chunk, phi.size() - first));
      force::evaluate(chip, some, std::span(h).first(3 * some.size()));
      force::evaluate(edge, some, std::span(e).first(3 * some.size()));
      for (std::size_t i = 0; i < 3 * some.size(); i += 3) {
        moments_to_matrix(
            {h[i], h[i + 1], h[i], h[i + 1], h[i + 2], e[i], e[i + 1], e[i + 2]},
            columns, &C[columns * (3 * first + i)]);
      }
    }
  }
};

/// Angles of which each turn of a record has the same.
struct Different {
  std::vector<double> angles;
  std::vector<std::size_t> place;  ///< which of them is the i-th; empty: i
};

/// @brief The different angles of a turn; turns repeat to the last digit.
Different different_angles(std::span<const double> phi) {
  constexpr double same = 1e-11;  // angles closer than this are one angle [rad]
  Different out;
  const auto [lo, hi] = std::minmax_element(phi.begin(), phi.end());
  if (phi.empty() || *hi - *lo < unit::turn) {
    out.angles.assign(phi.begin(), phi.end());
    return out;
  }
  std::unordered_map<long long, std::size_t> seen;
  out.place.reserve(phi.size());
  for (const double angle : phi) {
    const double u = angle - unit::turn * std::floor(angle / unit::turn);
    const auto [at, is_new] =
        seen.try_emplace(std::llround(u / same), out.angles.size());
    if (is_new) {
      out.angles.push_back(u);
    }
    out.place.push_back(at->second);
  }
  return out;
}

/// Values of the different angles, given to all of them.
template <class Value>
std::vector<Value> to_all(const Different& different, std::vector<Value> values) {
  if (different.place.empty()) {
    return values;
  }
  std::vector<Value> out;
  out.reserve(different.place.size());
  for (const std::size_t i : different.place) {
    out.push_back(values[i]);
  }
  return out;
}

/// @brief Evaluate once for every angle of a turn, some at a time:
/// evaluate(angles, values).
template <class Value, class Evaluate>
std::vector<Value> over_turns(std::span<const double> phi, const Evaluate& evaluate) {
  constexpr std::size_t at_a_time = 32;
  const Different different = different_angles(phi);
  const std::span<const double> angles = different.angles;
  std::vector<Value> values(angles.size());
  numerics::for_each_index(
      (angles.size() + at_a_time - 1) / at_a_time, [&](std::size_t k) {
        const std::size_t from = k * at_a_time;
        const auto some =
            angles.subspan(from, std::min(at_a_time, angles.size() - from));
        evaluate(some, std::span(values).subspan(from, some.size()));
      });
  return to_all(different, std::move(values));
}

using Matrix = std::array<double, 18>;

/// Force, torque and bending of any cutter.
std::vector<SixLoads> loads_of_any(const Setup& setup, const Law& law,
                                   std::span<const double> phi, double gauge_length,
                                   double tolerance) {
  const auto nodes = NodeForce::make(setup, law, std::min(tolerance, node_tolerance));
  if (nodes) {
    return over_turns<SixLoads>(
        phi, [&](std::span<const double> some, std::span<SixLoads> out) {
          nodes->loads(some, gauge_length, out);
        });
  }
  const AxialForce axial(setup, law, tolerance);
  return over_turns<SixLoads>(
      phi, [&](std::span<const double> some, std::span<SixLoads> out) {
        for (std::size_t i = 0; i < some.size(); ++i) {
          out[i] = axial.loads(some[i], gauge_length);
        }
      });
}

}  // namespace

struct ForceMatrix::Parts {
  std::size_t columns;
  std::variant<TurnMatrix, CumulativeForce, NodeForce, AxialForce> method;
};

ForceMatrix::ForceMatrix(const Setup& setup, const Law& law, double tolerance) {
  const std::size_t columns = form(law).columns();
  const auto parts = [&] {
    const double allowed = std::min(tolerance, smooth_turn_tolerance);
    if (const auto teeth = linear_turn(setup, law, allowed)) {
      return Parts{columns, TurnMatrix{turn_polynomial(*teeth, chip_weights()),
                                       turn_polynomial(*teeth, edge_weights())}};
    }
    if (keeps_radius(setup)) {
      return Parts{columns, CumulativeForce(setup, law, tolerance)};
    }
    if (auto nodes = NodeForce::make(setup, law, std::min(tolerance, node_tolerance))) {
      return Parts{columns, std::move(*nodes)};
    }
    return Parts{columns, AxialForce(setup, law, tolerance)};
  };
  parts_ = std::make_shared<const Parts>(parts());
}

int ForceMatrix::columns() const noexcept {
  return static_cast<int>(parts_->columns);
}

void ForceMatrix::evaluate(std::span<const double> phi, std::span<double> C) const {
  const auto columns = static_cast<std::size_t>(this->columns());
  if (C.size() != phi.size() * 3 * columns) {
    throw std::invalid_argument("force matrix: " + std::to_string(C.size()) +
                                " numbers for " + std::to_string(phi.size()) +
                                " angles of 3 x " + std::to_string(columns));
  }
  if (const auto* turn = std::get_if<TurnMatrix>(&parts_->method)) {
    turn->evaluate(phi, columns, C);
    return;
  }
  if (const auto* cumulative = std::get_if<CumulativeForce>(&parts_->method)) {
    for (std::size_t i = 0; i < phi.size(); ++i) {
      moments_to_matrix(cumulative->moments(phi[i]), columns, &C[i * 3 * columns]);
    }
    return;
  }
  const auto matrices =
      over_turns<Matrix>(phi, [&](std::span<const double> some, std::span<Matrix> out) {
        if (const auto* nodes = std::get_if<NodeForce>(&parts_->method)) {
          nodes->matrices(some, out);
          return;
        }
        const auto& axial = std::get<AxialForce>(parts_->method);
        for (std::size_t i = 0; i < some.size(); ++i) {
          axial.matrix(some[i], std::span(out[i]).first(3 * columns));
        }
      });
  for (std::size_t i = 0; i < matrices.size(); ++i) {
    std::copy_n(matrices[i].begin(), 3 * columns, &C[i * 3 * columns]);
  }
}

std::vector<Vector3> forces(const Setup& setup, const Law& law,
                            std::span<const double> phi, double tolerance) {
  if (phi.empty()) {
    return {};
  }
  if (const auto teeth = linear_turn(setup, law, std::min(tolerance, turn_tolerance))) {
    std::vector<Vector3> out(phi.size());
    evaluate(turn_polynomial(*teeth, force_weights(terms(law))), phi,
             std::span(out.front().data(), 3 * out.size()));
    return out;
  }
  if (keeps_radius(setup)) {
    std::vector<Vector3> out(phi.size());
    CumulativeForce(setup, law, tolerance).forces(moment_weights(law), phi, out);
    return out;
  }
  if (const auto nodes =
          NodeForce::make(setup, law, std::min(tolerance, node_tolerance))) {
    return over_turns<Vector3>(
        phi, [&](std::span<const double> some, std::span<Vector3> out) {
          nodes->forces(some, out);
        });
  }
  const AxialForce axial(setup, law, tolerance);
  return over_turns<Vector3>(phi,
                             [&](std::span<const double> some, std::span<Vector3> out) {
                               for (std::size_t i = 0; i < some.size(); ++i) {
                                 const SixLoads all = axial.loads(some[i], 0.0);
                                 out[i] = {all[0], all[1], all[2]};
                               }
                             });
}

std::vector<Loads> loads(const Setup& setup, const Law& law,
                         std::span<const double> phi, double gauge_length,
                         double tolerance) {
  std::vector<Loads> loads;
  loads.reserve(phi.size());
  for (const SixLoads& v : loads_of_any(setup, law, phi, gauge_length, tolerance)) {
    loads.push_back({{v[0], v[1], v[2]}, v[3], std::hypot(v[4], v[5])});
  }
  if (keeps_radius(setup)) {  // good to more digits, and costs nothing
    const auto exact = forces(setup, law, phi, tolerance);
    for (std::size_t i = 0; i < loads.size(); ++i) {
      loads[i].force = exact[i];
    }
  }
  return loads;
}

}  // namespace trochoid::force
