#include <trochoid/dynamics/chatter.h>

#include <trochoid/base/units.h>
#include <trochoid/numerics/dominant_eigenvalue.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace trochoid::dynamics {

namespace {

using Complex = std::complex<double>;

/// Amplitudes of one Fourier coefficient of q after another.
class LineCoefficients {
 public:
  /// @param rate  of the first [1/s]
  /// @param step  from one to the next [rad/s]
  LineCoefficients(const std::vector<PeriodMap::Node>& nodes, Complex rate, double step)
      : nodes_(nodes) {
    for (const PeriodMap::Node& node : nodes) {
      factor_.push_back(node.weight * std::exp(-rate * node.t));
      turn_.push_back(std::polar(1.0, -step * node.t));
    }
  }

  /// Of all components together, and on to the next.
  double next(const std::vector<Complex>& disturbance, std::size_t components) {
    std::array<Complex, 2> sum{};
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      for (std::size_t c = 0; c < components; ++c) {
        sum[c] += times(factor_[i], disturbance[nodes_[i].first + c * nodes_[i].step]);
      }
      factor_[i] = times(factor_[i], turn_[i]);
    }
    return std::sqrt(std::norm(sum[0]) + std::norm(sum[1]));
  }

 private:
  /// Without the care for infinite numbers of the language's own.
  static Complex times(Complex a, Complex b) {
    return {a.real() * b.real() - a.imag() * b.imag(),
            a.real() * b.imag() + a.imag() * b.real()};
  }

  const std::vector<PeriodMap::Node>& nodes_;
  std::vector<Complex> factor_;
  std::vector<Complex> turn_;
};

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
  PeriodMap map(directional, system, Omega, {.factor = factor, .whole_period = true});
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
  LineCoefficients coefficients(
      nodes, (std::log(found.value) - Complex(0, unit::turn * most)) / P,
      unit::turn / P);
  for (int k = -most; k <= most; ++k) {
    const Complex rate = (std::log(found.value) + Complex(0, unit::turn * k)) / P;
    add_line(lines, std::abs(rate.imag()) / unit::turn,  // D-12
             coefficients.next(found.vector, map.components()));
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
