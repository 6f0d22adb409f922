#include <trochoid/force/forces.h>

#include <trochoid/base/overloaded.h>
#include <trochoid/base/units.h>
#include <trochoid/force/any_edges.h>
#include <trochoid/force/arc_turn.h>
#include <trochoid/force/axial.h>
#include <trochoid/force/cumulative.h>
#include <trochoid/force/node_force.h>
#include <trochoid/force/turn_kernel.h>
#include <trochoid/force/turn_numbers.h>
#include <trochoid/force/turn_polynomial.h>
#include <trochoid/numerics/parallel.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <optional>
#include <span>
#include <stdexcept>
#include <unordered_map>
#include <variant>
#include <vector>

namespace trochoid::force {
namespace {

/// Angles of a record, of which each turn has the same.
struct DifferentAngles {
  std::vector<double> phi;         ///< [rad]
  std::vector<std::size_t> place;  ///< which of them the i-th of the record is
};

/// @brief The different angles of a turn; turns repeat to the last digit.
DifferentAngles different_angles(std::span<const double> phi);

/// @brief Evaluate once for every angle of a turn, a few angles at a time, on several
/// threads.
/// @param evaluate     takes angles and the place of their values
/// @param[out] values  shape (phi)
template <class Value, class Evaluate>
void over_turns(std::span<const double> phi, std::span<Value> values,
                const Evaluate& evaluate) {
  constexpr std::size_t fewest = 8;
  constexpr std::size_t parts = 360;  // of a turn whose angles are close together
  const DifferentAngles different = different_angles(phi);
  const std::span<const double> angles = different.phi;
  const std::size_t few = std::max(fewest, angles.size() / parts);
  std::vector<Value> once(angles.size());
  numerics::for_each_index((angles.size() + few - 1) / few, [&](std::size_t k) {
    const std::size_t from = k * few;
    const auto some = angles.subspan(from, std::min(few, angles.size() - from));
    evaluate(some, std::span(once).subspan(from, some.size()));
  });
  std::ranges::transform(different.place, values.begin(),
                         [&](std::size_t i) { return once[i]; });
}

DifferentAngles different_angles(std::span<const double> phi) {
  constexpr double same = 1e-11;  // angles closer than this are one angle [rad]
  DifferentAngles out;
  out.place.reserve(phi.size());
  const auto [lo, hi] = std::ranges::minmax_element(phi);
  if (phi.empty() || *hi - *lo < unit::turn) {
    out.phi.assign(phi.begin(), phi.end());
    out.place.resize(phi.size());
    std::iota(out.place.begin(), out.place.end(), std::size_t{0});
    return out;
  }
  std::unordered_map<long long, std::size_t> seen;
  for (const double angle : phi) {
    const double u = angle - unit::turn * std::floor(angle / unit::turn);
    const auto [at, is_new] = seen.try_emplace(std::llround(u / same), out.phi.size());
    if (is_new) {
      out.phi.push_back(u);
    }
    out.place.push_back(at->second);
  }
  return out;
}

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

/// @brief Three columns of [C] at one angle, t, r and a.
/// @param m  integrals of sin, cos, 1 times the chip, or times the edge
void moments_to_columns(const double* m, double weight, std::size_t stride,
                        double* C) noexcept {
  const double sine = weight * m[0];
  const double cosine = weight * m[1];
  C[0] = -cosine;
  C[1] = sine;
  C[2] = 0.0;
  C += stride;
  C[0] = -sine;
  C[1] = -cosine;
  C[2] = 0.0;
  C += stride;
  C[0] = 0.0;
  C[1] = 0.0;
  C[2] = -weight * m[2];
}

/// Error of the chips behind a TurnPolynomial, of the largest chip: one harmonic more
/// costs little.
constexpr double turn_tolerance = 1e-8;
/// The same where differences of matrices are taken.
constexpr double smooth_turn_tolerance = 1e-11;

/// A jump that counts, of the largest value at the ends of segments.
constexpr double smallest_jump = 1e-3;

/// Largest values at the ends of the segments.
std::array<double, 3> largest(const TurnPolynomial& turn) {
  std::vector<double> values(3 * turn.ends.size());
  evaluate(turn, turn.ends, values);
  std::array<double, 3> out{};
  for (std::size_t i = 0; i < values.size(); ++i) {
    out[i % 3] = std::max(out[i % 3], std::abs(values[i]));
  }
  return out;
}

/// @brief How the teeth cut, where forces are linear in the chip and the chips have few
/// harmonics.
std::optional<TurnTeeth> linear_turn(const Setup& setup, const Law& law,
                                     double tolerance) {
  return form(law).power ? std::nullopt : turn_teeth(setup, tolerance);
}

/// The six different entries of [C].
struct TurnMatrix {
  TurnPolynomial chip;    ///< integrals of h sin, h cos, h
  TurnPolynomial edge;    ///< of e sin, e cos, e
  bool straight = false;  ///< edges without lag

  void evaluate(std::span<const double> phi, std::size_t columns,
                std::span<double> C) const noexcept {
    for_each_angle(phi, [&](std::size_t i, const double* h, const double* e) {
      moments_to_matrix({h[0], h[1], h[0], h[1], h[2], e[0], e[1], e[2]}, columns,
                        &C[columns * 3 * i]);
    });
  }

  void evaluate_columns(std::span<const double> phi, std::span<const double> weight,
                        std::span<double> C, std::size_t stride) const noexcept {
    for_each_angle(phi, [&](std::size_t i, const double* h, const double* e) {
      moments_to_columns(h, weight[i], stride, &C[3 * i]);
      if (C.size() > 3 * stride) {
        moments_to_columns(e, weight[i], stride, &C[3 * stride + 3 * i]);
      }
    });
  }

 private:
  /// f(i, h, e) with the integrals at the i-th angle.
  template <class Function>
  void for_each_angle(std::span<const double> phi, const Function& f) const noexcept {
    constexpr std::size_t chunk = 256;
    std::array<double, 3 * chunk> h;
    std::array<double, 3 * chunk> e;
    for (std::size_t first = 0; first < phi.size(); first += chunk) {
      const auto some = phi.subspan(first, std::min(chunk, phi.size() - first));
      force::evaluate(chip, some, std::span(h).first(3 * some.size()));
      force::evaluate(edge, some, std::span(e).first(3 * some.size()));
      for (std::size_t i = 0; i < some.size(); ++i) f(first + i, &h[3 * i], &e[3 * i]);
    }
  }
};

/// Turns of a cylinder whose stock is given as arcs, one for each coefficient that is 1.
using ArcMatrix = std::vector<ArcTurn>;

bool by_arcs(const Setup& setup) noexcept {
  return std::holds_alternative<geometry::Arcs>(setup.cut.engagement);
}

/// Arcs of any theta: what they say is all there is.
constexpr geometry::Arc everywhere{-2 * unit::turn, 3 * unit::turn};

/// Nothing unless the stock is given as arcs on a cylinder of constant lead.
std::optional<ArcTurn> arc_turn(const Setup& setup, const Law& law, bool heights) {
  const geometry::Profile& p = setup.cutter.profile;
  const bool cylinder = p.R == 0 && p.alpha == 0 && p.beta == 0;
  if (!by_arcs(setup) || !cylinder || !(setup.cut.f_z > 0) ||
      (setup.cutter.lag_law != geometry::LagLaw::constant_lead &&
       setup.cutter.lag_diameter != p.D)) {
    return std::nullopt;
  }
  return ArcTurn(setup, law, {.within = everywhere, .heights = heights});
}

ToothLoads all_teeth(const ArcTurn& turn, double phi) noexcept {
  ToothLoads sum;
  for (std::size_t j = 0; j < turn.teeth(); ++j) {
    sum += turn.at(j, phi);
  }
  return sum;
}

ArcMatrix arc_matrix(const Setup& setup, const Law& law) {
  std::vector<double> one(form(law).columns(), 0.0);
  ArcMatrix turns;
  for (double& K : one) {
    K = 1.0;
    if (auto turn = arc_turn(setup, with_coefficients(law, one), false)) {
      turns.push_back(std::move(*turn));
    }
    K = 0.0;
  }
  return turns;
}

void evaluate_arcs(const ArcMatrix& turns, std::span<const double> phi,
                   std::span<double> C) {
  const std::size_t columns = turns.size();
  for (std::size_t i = 0; i < phi.size(); ++i) {
    for (std::size_t c = 0; c < columns; ++c) {
      const ToothLoads F = all_teeth(turns[c], phi[i]);
      double* const at = &C[3 * columns * i + c];
      at[0] = F.x;
      at[columns] = F.y;
      at[2 * columns] = F.z;
    }
  }
}

using Matrix = std::array<double, 18>;

/// Chips at nodes, where marks are smooth.
std::optional<NodeForce> node_force(const Setup& setup, const Law& law,
                                    double tolerance) {
  if (by_arcs(setup)) return std::nullopt;
  return edges_alike(setup) ? NodeForce::make(setup, law, tolerance)
                            : NodeForce::make(AnyEdges(setup), law, tolerance);
}

/// Force, torque and bending of any cutter.
std::vector<SixLoads> loads_of_any(const Setup& setup, const Law& law,
                                   std::span<const double> phi, double gauge_length,
                                   double tolerance) {
  std::vector<SixLoads> out(phi.size());
  const auto at_angles = [&](const auto& force) {
    over_turns(phi, std::span(out),
               [&](std::span<const double> some, std::span<SixLoads> all) {
                 force.loads(some, gauge_length, all);
               });
    return out;
  };
  if (const auto nodes = node_force(setup, law, tolerance)) return at_angles(*nodes);
  if (!edges_alike(setup)) return at_angles(AnyForce(setup, law, tolerance));
  if (const auto turn = arc_turn(setup, law, true)) {
    for (std::size_t i = 0; i < phi.size(); ++i) {
      const ToothLoads F = all_teeth(*turn, phi[i]);
      out[i] = {F.x,
                F.y,
                F.z,
                F.torque,
                F.axial_y - F.moment_y[0] + gauge_length * F.y,  // F-7
                F.moment_x[0] - gauge_length * F.x - F.axial_x};
    }
    return out;
  }
  return at_angles(AxialForce(setup, law, tolerance));
}

std::vector<SixLoads> without_bending(const TurnTeeth& teeth, const Terms& terms,
                                      std::span<const double> phi) {
  std::vector<SixLoads> out(phi.size());
  std::vector<double> three(3 * phi.size());
  evaluate(turn_polynomial(teeth, force_weights(terms)), phi, three);
  for (std::size_t i = 0; i < phi.size(); ++i) {
    std::copy_n(&three[3 * i], 3, out[i].begin());
  }
  evaluate(turn_polynomial(teeth, torque_weights(terms)), phi, three);
  for (std::size_t i = 0; i < phi.size(); ++i) out[i][3] = three[3 * i + 2];
  return out;
}

void forces_of_one(const Setup& setup, const Law& law, std::span<const double> phi,
                   double tolerance, std::span<Vector3> out) {
  if (phi.empty()) {
    return;
  }
  if (const auto teeth = linear_turn(setup, law, std::min(tolerance, turn_tolerance))) {
    evaluate(turn_polynomial(*teeth, force_weights(terms(law))), phi,
             std::span(out.front().data(), 3 * out.size()));
    return;
  }
  if (keeps_radius(setup) && !by_arcs(setup)) {
    CumulativeForce(setup, law, tolerance).forces(moment_weights(law), phi, out);
    return;
  }
  if (const auto nodes = node_force(setup, law, tolerance)) {
    over_turns(phi, out, [&](std::span<const double> some, std::span<Vector3> F) {
      nodes->forces(some, F);
    });
    return;
  }
  const auto all = loads_of_any(setup, law, phi, 0.0, tolerance);
  std::ranges::transform(all, out.begin(), [](const SixLoads& one) {
    return Vector3{one[0], one[1], one[2]};
  });
}

}  // namespace

struct ForceMatrix::Parts {
  std::size_t columns;
  std::size_t teeth;
  std::variant<TurnMatrix, CumulativeForce, NodeForce, AxialForce, ArcMatrix, AnyForce>
      method;
};

ForceMatrix::ForceMatrix(const Setup& setup, const Law& law, double tolerance) {
  const std::size_t columns = form(law).columns();
  const std::size_t count = setup.cutter.pitch.size();
  const auto parts = [&] {
    const double allowed = std::min(tolerance, smooth_turn_tolerance);
    if (const auto teeth = linear_turn(setup, law, allowed)) {
      return Parts{
          columns, count,
          TurnMatrix{turn_polynomial(*teeth, chip_weights()),
                     turn_polynomial(*teeth, edge_weights()), teeth->lag == 0.0}};
    }
    if (by_arcs(setup)) {
      ArcMatrix turns = arc_matrix(setup, law);
      if (!turns.empty()) return Parts{columns, count, std::move(turns)};
      return Parts{columns, count, AxialForce(setup, law, tolerance)};
    }
    if (keeps_radius(setup)) {
      return Parts{columns, count, CumulativeForce(setup, law, tolerance)};
    }
    if (auto nodes = node_force(setup, law, tolerance)) {
      return Parts{columns, count, std::move(*nodes)};
    }
    if (!edges_alike(setup)) {
      return Parts{columns, count, AnyForce(setup, law, tolerance)};
    }
    return Parts{columns, count, AxialForce(setup, law, tolerance)};
  };
  parts_ = std::make_shared<const Parts>(parts());
}

int ForceMatrix::columns() const noexcept {
  return static_cast<int>(parts_->columns);
}

double ForceMatrix::work(std::size_t angles) const noexcept {
  // Seen on a machine of 2023 against single chips: a turn of one tooth, and an angle.
  const auto [once, each] = std::visit(
      base::Overloaded{[](const TurnMatrix&) { return std::pair(40.0, 0.1); },
                       [](const CumulativeForce&) { return std::pair(2000.0, 0.3); },
                       [](const NodeForce& force) {
                         return std::pair(200.0,
                                          4.0 * static_cast<double>(force.panels()));
                       },
                       [](const AxialForce&) { return std::pair(0.0, 100.0); },
                       [](const ArcMatrix&) { return std::pair(1000.0, 2.0); },
                       [](const AnyForce&) { return std::pair(0.0, 1000.0); }},
      parts_->method);
  return static_cast<double>(parts_->teeth) *
         (once + each * static_cast<double>(angles));
}

std::optional<std::vector<double>> ForceMatrix::jumps() const {
  const auto* const turn = std::get_if<TurnMatrix>(&parts_->method);
  if (turn == nullptr || !turn->straight) return std::nullopt;
  std::vector<double> out;
  for (const TurnPolynomial* const part : {&turn->chip, &turn->edge}) {
    const std::array<double, 3> size = largest(*part);
    const double least = smallest_jump * *std::max_element(size.begin(), size.end());
    const std::vector<double> found = force::jumps(*part, least);
    out.insert(out.end(), found.begin(), found.end());
  }
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
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
  if (const auto* arcs = std::get_if<ArcMatrix>(&parts_->method)) {
    evaluate_arcs(*arcs, phi, C);
    return;
  }
  std::vector<Matrix> matrices(phi.size());
  over_turns(phi, std::span(matrices),
             [&](std::span<const double> some, std::span<Matrix> out) {
               if (const auto* nodes = std::get_if<NodeForce>(&parts_->method)) {
                 nodes->matrices(some, out);
                 return;
               }
               if (const auto* any = std::get_if<AnyForce>(&parts_->method)) {
                 any->matrices(some, out);
                 return;
               }
               std::get<AxialForce>(parts_->method).matrices(some, out);
             });
  for (std::size_t i = 0; i < matrices.size(); ++i) {
    std::copy_n(matrices[i].begin(), 3 * columns, &C[i * 3 * columns]);
  }
}

void ForceMatrix::evaluate_columns(std::span<const double> phi,
                                   std::span<const double> weight, std::span<double> C,
                                   std::size_t stride) const {
  const auto columns = static_cast<std::size_t>(this->columns());
  if (weight.size() != phi.size() || stride < 3 * phi.size() ||
      C.size() < (columns - 1) * stride + 3 * phi.size()) {
    throw std::invalid_argument("force matrix: " + std::to_string(C.size()) +
                                " numbers by columns " + std::to_string(stride) +
                                " apart for " + std::to_string(phi.size()) + " angles");
  }
  if (const auto* turn = std::get_if<TurnMatrix>(&parts_->method)) {
    turn->evaluate_columns(phi, weight, C, stride);
    return;
  }
  std::vector<double> rows(phi.size() * 3 * columns);
  evaluate(phi, rows);
  for (std::size_t i = 0; i < 3 * phi.size(); ++i) {
    for (std::size_t c = 0; c < columns; ++c) {
      C[c * stride + i] = weight[i / 3] * rows[i * columns + c];
    }
  }
}

std::optional<Vector3> mean_force(const Setup& setup, const Law& law,
                                  double tolerance) {
  if (const auto turn = arc_turn(setup, law, false)) {
    const ToothLoads mean = turn->mean();
    return Vector3{mean.x, mean.y, mean.z};
  }
  const auto teeth = linear_turn(setup, law, std::min(tolerance, turn_tolerance));
  if (!teeth) return std::nullopt;
  return mean(turn_polynomial(*teeth, force_weights(terms(law))));
}

MeanLoads exact_mean(const Setup& setup, const Law& law, double tolerance) {
  if (const auto turn = arc_turn(setup, law, false)) {
    const ToothLoads mean = turn->mean();
    return {{mean.x, mean.y, mean.z}, mean.torque};
  }
  if (const auto teeth = linear_turn(setup, law, std::min(tolerance, turn_tolerance))) {
    return {mean(turn_polynomial(*teeth, force_weights(terms(law)))),
            mean(turn_polynomial(*teeth, torque_weights(terms(law))))[2]};
  }
  const SixLoads v = AnyForce(setup, law, tolerance).mean(0.0).fixed;
  return {{v[0], v[1], v[2]}, v[3]};
}

std::vector<Vector3> forces(const Setup& setup, const Law& law,
                            std::span<const double> phi, double tolerance) {
  std::vector<Vector3> out(phi.size());
  forces_of_one(setup, law, phi, tolerance, out);
  return out;
}

void forces_of_many(std::span<const Setup> setups, const Law& law,
                    std::span<const double> phi, double tolerance,
                    std::span<Vector3> F) {
  numerics::for_each_index(setups.size(), [&](std::size_t i) {
    forces_of_one(setups[i], law, phi, tolerance,
                  F.subspan(i * phi.size(), phi.size()));
  });
}

TurnMeans turn_means(const Setup& setup, const Law& law, double gauge_length,
                     double tolerance) {
  return AnyForce(setup, law, tolerance).mean(gauge_length);
}

std::vector<SixLoads> six_loads(const Setup& setup, const Law& law,
                                std::span<const double> phi,
                                std::optional<double> gauge_length, double tolerance) {
  if (!gauge_length) {
    if (const auto teeth =
            linear_turn(setup, law, std::min(tolerance, turn_tolerance))) {
      return without_bending(*teeth, terms(law), phi);
    }
  }
  std::vector<SixLoads> out =
      loads_of_any(setup, law, phi, gauge_length.value_or(0.0), tolerance);
  if (keeps_radius(setup)) {  // good to more digits, and costs nothing
    const auto exact = forces(setup, law, phi, tolerance);
    for (std::size_t i = 0; i < out.size(); ++i) {
      std::ranges::copy(exact[i], out[i].begin());
    }
  }
  return out;
}

std::vector<Loads> loads(const Setup& setup, const Law& law,
                         std::span<const double> phi,
                         std::optional<double> gauge_length, double tolerance) {
  std::vector<Loads> loads;
  loads.reserve(phi.size());
  for (const SixLoads& v : six_loads(setup, law, phi, gauge_length, tolerance)) {
    loads.push_back(
        {{v[0], v[1], v[2]}, v[3], gauge_length ? std::hypot(v[4], v[5]) : 0.0});
  }
  return loads;
}

}  // namespace trochoid::force
