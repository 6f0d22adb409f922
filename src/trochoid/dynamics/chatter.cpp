#include <trochoid/dynamics/chatter.h>

#include <trochoid/base/units.h>
#include <trochoid/numerics/dominant_eigenvalue.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace trochoid::dynamics {

namespace {

using Complex = std::complex<double>;

/// Largest amplitude over the components of q of one Fourier coefficient.
double amplitude(const std::vector<Complex>& disturbance,
                 const std::vector<PeriodMap::Node>& nodes, std::size_t components,
                 Complex rate) {
  double square = 0.0;
  for (std::size_t c = 0; c < components; ++c) {
    Complex sum = 0.0;
    for (const PeriodMap::Node& node : nodes) {
      sum += node.weight * disturbance[node.first + c * node.step] *
             std::exp(-rate * node.t);
    }
    square += std::norm(sum);
  }
  return std::sqrt(square);
}

/// A flip has each frequency twice: as itself and as its mirror image.
void add_line(std::vector<ChatterLine>& lines, double frequency, double share) {
  for (ChatterLine& line : lines) {
    if (std::abs(line.frequency - frequency) < 1e-6 * (frequency + 1)) {
      line.share = std::hypot(line.share, share);
      return;
    }
  }
  lines.push_back({frequency, share});
}

}  // namespace

Bifurcation bifurcation_of(std::complex<double> multiplier) noexcept {
  constexpr double real = 1e-7;  // [rad]
  const double angle = std::abs(std::arg(multiplier));
  return angle < real                      ? Bifurcation::period_one
         : std::numbers::pi - angle < real ? Bifurcation::period_doubling
                                           : Bifurcation::hopf;
}

std::vector<ChatterLine> chatter_lines(const Directional& directional,
                                       const System& system, double Omega,
                                       double factor, double least) {
  const PeriodMap map(directional, system, Omega,
                      {.factor = factor, .whole_period = true});
  const auto found = numerics::dominant_eigenvalue(
      [&](std::span<const double> in, std::span<double> out) { map.apply(in, out); },
      map.size(), 1e-9);
  if (std::abs(found.value) == 0) {
    return {};
  }
  const double P = directional.period / Omega;
  double fastest = 0.0;
  for (const ChipMode& mode : system.modes) {
    fastest = std::max(fastest, std::sqrt(mode.stiffness / mode.mass) / unit::turn);
  }
  const int most = static_cast<int>(std::ceil(1.5 * fastest * P)) + 3;
  const auto nodes = map.disturbance_nodes();
  std::vector<ChatterLine> lines;
  for (int k = -most; k <= most; ++k) {
    const Complex rate = (std::log(found.value) + Complex(0, unit::turn * k)) / P;
    add_line(lines, std::abs(rate.imag()) / unit::turn,  // D-12
             amplitude(found.vector, nodes, map.components(), rate));
  }
  std::sort(lines.begin(), lines.end(), [](const ChatterLine& a, const ChatterLine& b) {
    return a.share > b.share;
  });
  const double strongest = lines.front().share;
  for (ChatterLine& line : lines) {
    line.share /= strongest;
  }
  std::erase_if(lines, [&](const ChatterLine& line) { return line.share < least; });
  return lines;
}

}  // namespace trochoid::dynamics
