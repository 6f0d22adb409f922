#include <trochoid/dynamics/regenerative_loop.h>

#include <trochoid/base/units.h>
#include <trochoid/numerics/complex_eigenvalues.h>

#include <algorithm>
#include <cmath>

namespace trochoid::dynamics {

using Complex = std::complex<double>;

double largest(const ComplexMatrix2& G) noexcept {
  double most = 0.0;
  for (const Complex& g : G) {
    most = std::max(most, std::norm(g));
  }
  return std::sqrt(most);
}

namespace {

/// A vibration belongs to the frequency among its harmonics at which the tool point is
/// soft; one with less than this share of the softest is left to that one.
constexpr double share_of_softest = 0.5;
/// Steps of the scan while the longest delay turns once.
constexpr double steps_per_wave = 48.0;
/// Steps of the scan within a peak of the response.
constexpr double steps_per_peak = 5.0;
/// No step is shorter than this fraction of the distance of two lines.
constexpr double steps_per_line = 3.0;

double longest_delay(const ForceHarmonics& forces) {
  return forces.delays.empty() ? forces.period : forces.delays.back();
}

/// @brief Frequencies from the begin of the band to its end: closer at every peak of the
/// response, and everywhere close for the delay.
/// @param longest  step [rad/s]
std::vector<double> scan_frequencies(const PointResponse& point, double longest) {
  const Band band = band_of(point);
  std::vector<Peak> all;
  for (const MeasuredReceptance& part : point.parts) {
    const std::vector<Peak> of_part = peaks(part);
    all.insert(all.end(), of_part.begin(), of_part.end());
  }
  const double shortest = line_distance(point) / steps_per_line;
  std::vector<double> out;
  for (double omega = band.from; omega < band.to;) {
    out.push_back(omega);
    double step = longest;
    for (const Peak& peak : all) {
      const double away = std::max(peak.width, std::abs(omega - peak.omega));
      step = std::min(step, std::max(shortest, away / steps_per_peak));
    }
    omega += step;
  }
  out.push_back(band.to);
  return out;
}

}  // namespace

ResponseAtSpeed::ResponseAtSpeed(const ForceHarmonics& forces,
                                 const PointResponse& point, double Omega, int h)
    : point_(point),
      Omega_(Omega),
      step_(unit::turn * Omega / forces.period),
      h_(h),
      most_(forces.most),
      longest_(longest_delay(forces)) {
  for (std::size_t axis = 0; axis < 2; ++axis) {
    const bool moves = std::any_of(
        point.parts.begin(), point.parts.end(),
        [&](const MeasuredReceptance& part) { return part.motion == axis; });
    if (moves) {
      axes_.push_back(axis);
    }
  }
  for (const double omega :
       scan_frequencies(point, unit::turn * Omega / longest_ / steps_per_wave)) {
    scan_.push_back(at(omega));
  }
}

bool ResponseAtSpeed::serves(const ForceHarmonics& forces) const noexcept {
  return forces.most == most_ && longest_delay(forces) == longest_;
}

KeptResponse ResponseAtSpeed::at(double omega) const {
  KeptResponse kept{.omega = omega};
  const int mirror = -static_cast<int>(std::lround(2 * omega / step_));
  if (h_ > 0 && 2 * h_ - mirror <= most_) {
    for (int k = mirror - h_; k <= mirror + h_ && k < -h_; ++k) {
      kept.k.push_back(k);
    }
  }
  for (int k = -h_; k <= h_; ++k) {
    kept.k.push_back(k);
  }
  double own = 0.0;
  std::erase_if(kept.k, [&](int k) {
    const ComplexMatrix2 G = receptance(point_, omega + step_ * k);
    const double size = largest(G);
    if (size > 0) {  // else it is rigid: a row of zeros
      kept.G.push_back(G);
      kept.size.push_back(size);
    }
    kept.softest = std::max(kept.softest, size);
    own = k == 0 ? size : own;
    return !(size > 0);
  });
  if (own < share_of_softest * kept.softest) {
    kept.k.clear();
  }
  return kept;
}

RegenerativeLoop::RegenerativeLoop(const ForceHarmonics& forces,
                                   const ResponseAtSpeed& response)
    : forces_(forces), response_(response) {
  for (const auto& of_delay : forces.coefficients) {
    for (const ComplexMatrix2& coefficient : of_delay) {
      force_size_ += 2 * largest(coefficient);
    }
  }
  for (const ComplexMatrix2& coefficient : forces.damping) {
    damping_size_ += 2 * largest(coefficient);
  }
}

std::vector<Complex> RegenerativeLoop::eigenvalues(const KeptResponse& kept,
                                                   double least) const {
  if (kept.k.empty()) {
    return {};
  }
  const auto fastest =
      static_cast<double>(std::max(std::abs(kept.k.front()), std::abs(kept.k.back())));
  const double force_size =
      force_size_ +
      damping_size_ * (kept.omega + response_.step() * fastest) / response_.Omega();
  if (2 * kept.softest * force_size < least) {
    return {};
  }
  const std::size_t n = response_.axes().size() * kept.k.size();
  std::vector<Complex> M(n * n);
  for (std::size_t l = 0; l < kept.k.size(); ++l) {
    add_column(kept, l, M);
  }
  return least > 0 && numerics::eigenvalue_bound(M, n) < least
             ? std::vector<Complex>{}
             : numerics::complex_eigenvalues(M, n);
}

void RegenerativeLoop::add_column(const KeptResponse& kept, std::size_t l,
                                  std::vector<Complex>& M) const {
  const std::vector<std::size_t>& axes = response_.axes();
  const double faster = kept.omega + response_.step() * kept.k[l];
  const std::size_t n = axes.size() * kept.k.size();
  const Complex slope(0.0, faster / response_.Omega());
  std::vector<Complex> turned;
  for (const double delay : forces_.delays) {
    turned.push_back(std::polar(1.0, -faster * delay / response_.Omega()));
  }
  for (std::size_t k = 0; k < kept.k.size(); ++k) {
    const double balance = std::sqrt(kept.size[l] / kept.size[k]);
    const auto wave = static_cast<std::size_t>(forces_.most + kept.k[k] - kept.k[l]);
    ComplexMatrix2 W = forces_.coefficients[0][wave];
    for (std::size_t q = 0; q < W.size() && !forces_.damping.empty(); ++q) {
      W[q] += slope * forces_.damping[wave][q];  // D-33
    }
    for (std::size_t d = 0; d < forces_.delays.size(); ++d) {
      for (std::size_t q = 0; q < W.size(); ++q) {
        W[q] -= turned[d] * forces_.coefficients[d + 1][wave][q];
      }
    }
    for (std::size_t i = 0; i < axes.size(); ++i) {
      for (std::size_t j = 0; j < axes.size(); ++j) {
        const std::size_t row = 2 * axes[i];
        M[(l * axes.size() + j) * n + k * axes.size() + i] =
            balance * (kept.G[k][row] * W[axes[j]] +
                       kept.G[k][row + 1] * W[2 + axes[j]]);  // D-22
      }
    }
  }
}

}  // namespace trochoid::dynamics
