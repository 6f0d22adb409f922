#include <trochoid/force/forces.h>

#include <trochoid/base/units.h>
#include <trochoid/force/axial.h>
#include <trochoid/force/cumulative.h>
#include <trochoid/numerics/parallel.h>

#include <cmath>
#include <stdexcept>
#include <unordered_map>
#include <variant>

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

/// @brief Evaluate once for every angle of a turn; turns repeat to the last digit.
template <class Value, class Evaluate>
std::vector<Value> over_turns(std::span<const double> phi, const Evaluate& evaluate) {
  constexpr double same = 1e-11;  // angles closer than this are one angle [rad]
  std::unordered_map<long long, std::size_t> seen;
  std::vector<double> angles;      // different ones
  std::vector<std::size_t> place;  // which of them is the i-th
  place.reserve(phi.size());
  for (const double angle : phi) {
    const double u = angle - unit::turn * std::floor(angle / unit::turn);
    const auto [at, is_new] = seen.try_emplace(std::llround(u / same), angles.size());
    if (is_new) {
      angles.push_back(u);
    }
    place.push_back(at->second);
  }
  std::vector<Value> different(angles.size());
  numerics::for_each_index(angles.size(),
                           [&](std::size_t i) { different[i] = evaluate(angles[i]); });
  std::vector<Value> values;
  values.reserve(phi.size());
  for (const std::size_t i : place) {
    values.push_back(different[i]);
  }
  return values;
}

}  // namespace

struct ForceMatrix::Parts {
  std::size_t columns;
  std::variant<CumulativeForce, AxialForce> method;
};

ForceMatrix::ForceMatrix(const Setup& setup, const Law& law, double tolerance)
    : parts_(std::make_shared<const Parts>(
          keeps_radius(setup)
              ? Parts{form(law).columns(), CumulativeForce(setup, law, tolerance)}
              : Parts{form(law).columns(), AxialForce(setup, law, tolerance)})) {}

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
  if (const auto* cumulative = std::get_if<CumulativeForce>(&parts_->method)) {
    for (std::size_t i = 0; i < phi.size(); ++i) {
      moments_to_matrix(cumulative->moments(phi[i]), columns, &C[i * 3 * columns]);
    }
    return;
  }
  const auto& axial = std::get<AxialForce>(parts_->method);
  using Matrix = std::array<double, 18>;
  const auto matrices = over_turns<Matrix>(phi, [&](double angle) {
    Matrix m{};
    axial.matrix(angle, std::span(m).first(3 * columns));
    return m;
  });
  for (std::size_t i = 0; i < phi.size(); ++i) {
    std::copy_n(matrices[i].begin(), 3 * columns, &C[i * 3 * columns]);
  }
}

std::vector<Vector3> forces(const Setup& setup, const Law& law,
                            std::span<const double> phi, double tolerance) {
  if (keeps_radius(setup)) {
    std::vector<Vector3> out(phi.size());
    CumulativeForce(setup, law, tolerance).forces(moment_weights(law), phi, out);
    return out;
  }
  const AxialForce axial(setup, law, tolerance);
  return over_turns<Vector3>(phi, [&](double angle) {
    const auto v = axial.loads(angle, 0.0);
    return Vector3{v[0], v[1], v[2]};
  });
}

std::vector<Loads> loads(const Setup& setup, const Law& law,
                         std::span<const double> phi, double gauge_length,
                         double tolerance) {
  const AxialForce axial(setup, law, tolerance);
  auto loads = over_turns<Loads>(phi, [&](double angle) {
    const auto v = axial.loads(angle, gauge_length);
    return Loads{{v[0], v[1], v[2]}, v[3], std::hypot(v[4], v[5])};
  });
  if (keeps_radius(setup)) {  // good to more digits, and costs nothing
    const auto exact = forces(setup, law, phi, tolerance);
    for (std::size_t i = 0; i < loads.size(); ++i) {
      loads[i].force = exact[i];
    }
  }
  return loads;
}

}  // namespace trochoid::force
