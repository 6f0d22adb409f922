#include <trochoid/structure/coupled_modes.h>

#include <trochoid/numerics/least_squares.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>

namespace trochoid::structure {

namespace {

/// A second direction with less of 1/m than this fraction of the first is noise.
constexpr double least_second = 0.05;

/// Modes of one frequency: found along x, along y, or along both.
struct Pair {
  double omega = 0.0;
  double zeta = 0.0;
  double a_xx = 0.0;  ///< 1/m along x [1/kg]
  double a_yy = 0.0;
  double a_xy = 0.0;
};

/// Frequencies closer than half of the half-power width are one.
bool belong_together(const FittedMode& a, const FittedMode& b) {
  return std::abs(a.omega.value - b.omega.value) <
         0.5 * (a.zeta.value * a.omega.value + b.zeta.value * b.omega.value);
}

std::vector<Pair> paired(std::span<const FittedMode> x, std::span<const FittedMode> y) {
  std::vector<Pair> pairs;
  std::vector<bool> taken(y.size());
  for (const FittedMode& m : x) {
    Pair pair{m.omega.value, m.zeta.value, 1 / m.mass.value, 0.0, 0.0};
    for (std::size_t k = 0; k < y.size(); ++k) {
      if (!taken[k] && belong_together(m, y[k])) {
        taken[k] = true;
        pair.a_yy = 1 / y[k].mass.value;
        const double share = pair.a_yy / (pair.a_xx + pair.a_yy);
        pair.omega += share * (y[k].omega.value - m.omega.value);
        pair.zeta += share * (y[k].zeta.value - m.zeta.value);
        break;
      }
    }
    pairs.push_back(pair);
  }
  for (std::size_t k = 0; k < y.size(); ++k) {
    if (!taken[k]) {
      pairs.push_back(
          {y[k].omega.value, y[k].zeta.value, 0.0, 1 / y[k].mass.value, 0.0});
    }
  }
  std::sort(pairs.begin(), pairs.end(),
            [](const Pair& a, const Pair& b) { return a.omega < b.omega; });
  return pairs;
}

/// The residues of the cross response at the frequencies that are known (D-25), as
/// accelerance: an accelerometer's noise is white there.
void fit_cross(const FrequencyResponse& cross, std::vector<Pair>& pairs) {
  const std::size_t n = pairs.size() + 1;
  std::vector<double> A;
  std::vector<double> b;
  const auto add = [&](double (*part)(const std::complex<double>&), double omega,
                       std::complex<double> H) {
    for (const Pair& pair : pairs) {
      const std::complex<double> term =
          -omega * omega /
          std::complex<double>(pair.omega * pair.omega - omega * omega,
                               2 * pair.zeta * pair.omega * omega);
      A.push_back(part(term));
    }
    A.push_back(part(-omega * omega));
    b.push_back(part(-omega * omega * H));
  };
  for (std::size_t i = 0; i < cross.omega.size(); ++i) {
    const double omega = cross.omega[i];
    if (omega > 0) {
      const std::complex<double> H = cross.H[i] / factor(cross.kind, omega);
      add([](const std::complex<double>& z) { return z.real(); }, omega, H);
      add([](const std::complex<double>& z) { return z.imag(); }, omega, H);
    }
  }
  constexpr double rank_tolerance = 1e-9;
  const auto fit = numerics::least_squares(A, static_cast<int>(n), b, rank_tolerance);
  for (std::size_t r = 0; r < pairs.size(); ++r) {
    pairs[r].a_xy = fit.x[r];
  }
}

PlaneMode plane_mode(const Pair& pair, double a, double x, double y) {
  const double mass = 1 / a;
  return {
      {mass, mass * pair.omega * pair.omega, 2 * pair.zeta * pair.omega * mass}, x, y};
}

/// The directions of one pair: eigenvectors of its matrix.
void add_directions(const Pair& pair, std::vector<PlaneMode>& out) {
  if (pair.a_xx == 0 || pair.a_yy == 0) {  // found along one axis: so it lies
    const bool is_x = pair.a_yy == 0;
    out.push_back(plane_mode(pair, pair.a_xx + pair.a_yy, is_x ? 1 : 0, is_x ? 0 : 1));
    return;
  }
  const double angle = 0.5 * std::atan2(2 * pair.a_xy, pair.a_xx - pair.a_yy);
  const double half_sum = 0.5 * (pair.a_xx + pair.a_yy);
  const double half = std::hypot(0.5 * (pair.a_xx - pair.a_yy), pair.a_xy);
  out.push_back(plane_mode(pair, half_sum + half, std::cos(angle), std::sin(angle)));
  if (half_sum - half > least_second * (half_sum + half)) {
    out.push_back(plane_mode(pair, half_sum - half, -std::sin(angle), std::cos(angle)));
  }
}

}  // namespace

std::vector<PlaneMode> coupled_modes(std::span<const FittedMode> x,
                                     std::span<const FittedMode> y,
                                     const FrequencyResponse& cross) {
  std::vector<Pair> pairs = paired(x, y);
  fit_cross(cross, pairs);
  std::vector<PlaneMode> modes;
  for (const Pair& pair : pairs) {
    add_directions(pair, modes);
  }
  return modes;
}

}  // namespace trochoid::structure
