#include <trochoid/dynamics/regenerative_loop.h>

#include <trochoid/base/units.h>
#include <trochoid/numerics/complex_eigenvalues.h>

#include <algorithm>
#include <cmath>

namespace trochoid::dynamics {

namespace {

using Complex = std::complex<double>;

/// A vibration belongs to the frequency among its harmonics at which the tool point is
/// soft; one with less than this share of the softest is left to that one.
constexpr double share_of_softest = 0.5;
}  // namespace

double largest(const ComplexMatrix2& G) noexcept {
  double most = 0.0;
  for (const Complex& g : G) {
    most = std::max(most, std::abs(g));
  }
  return most;
}

RegenerativeLoop::RegenerativeLoop(const ForceHarmonics& forces,
                                   const PointResponse& point, double Omega, int h)
    : forces_(forces),
      point_(point),
      Omega_(Omega),
      step_(unit::turn * Omega / forces.period),
      h_(h) {
  for (std::size_t axis = 0; axis < 2; ++axis) {
    const bool moves = std::any_of(
        point.parts.begin(), point.parts.end(),
        [&](const MeasuredReceptance& part) { return part.motion == axis; });
    if (moves) {
      axes_.push_back(axis);
    }
  }
  for (const auto& of_delay : forces.coefficients) {
    for (const ComplexMatrix2& coefficient : of_delay) {
      force_size_ += 2 * largest(coefficient);
    }
  }
  for (const ComplexMatrix2& coefficient : forces.damping) {
    damping_size_ += 2 * largest(coefficient);
  }
}

std::vector<Complex> RegenerativeLoop::eigenvalues(double omega, double least) const {
  const Kept kept = kept_at(omega);
  const auto fastest =
      static_cast<double>(std::max(std::abs(kept.k.front()), std::abs(kept.k.back())));
  const double force_size =
      force_size_ + damping_size_ * (omega + step_ * fastest) / Omega_;
  if (largest(receptance(point_, omega)) < share_of_softest * kept.softest ||
      2 * kept.softest * force_size < least) {
    return {};
  }
  const std::size_t n = axes_.size() * kept.k.size();
  std::vector<Complex> M(n * n);
  for (std::size_t l = 0; l < kept.k.size(); ++l) {
    add_column(omega, kept, l, M);
  }
  return least > 0 && numerics::eigenvalue_bound(M, n) < least
             ? std::vector<Complex>{}
             : numerics::complex_eigenvalues(M, n);
}

RegenerativeLoop::Kept RegenerativeLoop::kept_at(double omega) const {
  Kept kept;
  const int mirror = -static_cast<int>(std::lround(2 * omega / step_));
  if (h_ > 0 && 2 * h_ - mirror <= forces_.most) {
    for (int k = mirror - h_; k <= mirror + h_ && k < -h_; ++k) {
      kept.k.push_back(k);
    }
  }
  for (int k = -h_; k <= h_; ++k) {
    kept.k.push_back(k);
  }
  for (const int k : kept.k) {
    kept.G.push_back(receptance(point_, omega + step_ * k));
    kept.softest = std::max(kept.softest, largest(kept.G.back()));
  }
  return kept;
}

void RegenerativeLoop::add_column(double omega, const Kept& kept, std::size_t l,
                                  std::vector<Complex>& M) const {
  const std::size_t n = axes_.size() * kept.k.size();
  const Complex slope(0.0, (omega + step_ * kept.k[l]) / Omega_);
  std::vector<Complex> turned;
  for (const double delay : forces_.delays) {
    turned.push_back(std::polar(1.0, -(omega + step_ * kept.k[l]) * delay / Omega_));
  }
  for (std::size_t k = 0; k < kept.k.size(); ++k) {
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
    for (std::size_t i = 0; i < axes_.size(); ++i) {
      for (std::size_t j = 0; j < axes_.size(); ++j) {
        const std::size_t row = 2 * axes_[i];
        M[(l * axes_.size() + j) * n + k * axes_.size() + i] =
            kept.G[k][row] * W[axes_[j]] +
            kept.G[k][row + 1] * W[2 + axes_[j]];  // D-22
      }
    }
  }
}

}  // namespace trochoid::dynamics
