#include <trochoid/numerics/dense.h>
#include <trochoid/signal/harmonic_fit.h>

#include <algorithm>
#include <cmath>

namespace trochoid::signal {

namespace {

using Complex = std::complex<double>;
constexpr Complex i{0.0, 1.0};

/// Product of finite numbers; the operator of std::complex looks for NaN every time.
Complex times(Complex a, Complex b) {
  return {a.real() * b.real() - a.imag() * b.imag(),
          a.real() * b.imag() + a.imag() * b.real()};
}

/// e^(i m Omega t) for m = 0..most, by repeated multiplication.
void powers(double angle, std::span<Complex> out) {
  const Complex turn = std::polar(1.0, angle);
  out[0] = 1.0;
  for (std::size_t m = 1; m < out.size(); ++m) out[m] = times(out[m - 1], turn);
}

/// Everything that the normal equations need, from one pass over the samples.
struct FitSums {
  /// sum t^p e^(i m Omega t), p = 0, 1, 2, m = 0 .. twice the highest order
  std::array<std::vector<Complex>, 3> S;
  /// sum t^p y e^(-i k Omega t), p = 0, 1, of each channel, k of the two-sided orders
  std::array<std::array<std::vector<Complex>, 2>, 3> Y;
  std::array<double, 3> yy{};
};

FitSums sums(const TimedSamples& samples, std::span<const int> orders, double Omega) {
  const auto K = static_cast<std::size_t>(orders.back());
  FitSums s;
  for (auto& row : s.S) row.assign(2 * K + 1, Complex{});
  for (auto& channel : s.Y) {
    for (auto& row : channel) row.assign(orders.size(), Complex{});
  }
  std::vector<Complex> e(2 * K + 1);
  const std::size_t zero = orders.size() / 2;
  for (std::size_t n = 0; n < samples.t.size(); ++n) {
    const double t = samples.t[n];
    powers(Omega * t, e);
    for (std::size_t m = 0; m < e.size(); ++m) {
      s.S[0][m] += e[m];
      s.S[1][m] += t * e[m];
      s.S[2][m] += t * t * e[m];
    }
    for (std::size_t c = 0; c < 3; ++c) {
      const double y = samples.channel[c][n];
      s.yy[c] += y * y;
      for (std::size_t k = zero; k < orders.size(); ++k) {
        const Complex term = y * std::conj(e[static_cast<std::size_t>(orders[k])]);
        s.Y[c][0][k] += term;
        s.Y[c][1][k] += t * term;
      }
    }
  }
  for (auto& channel : s.Y) {
    for (auto& row : channel) {
      for (std::size_t k = 0; k < zero; ++k) {
        row[k] = std::conj(row[orders.size() - 1 - k]);
      }
    }
  }
  return s;
}

/// S^(p) at a difference of orders, which may be negative.
Complex at(const std::vector<Complex>& S, int difference) {
  const auto value = S[static_cast<std::size_t>(std::abs(difference))];
  return difference < 0 ? std::conj(value) : value;
}

/// Derivative to Omega of one channel: i k t c_k, against the basis and against itself.
struct Derivative {
  std::vector<Complex> on_basis;
  double squared = 0.0;
  double with_residual = 0.0;
};

Derivative derivative(const FitSums& s, std::size_t channel,
                      std::span<const int> orders, const std::vector<Complex>& c) {
  const std::size_t size = orders.size();
  Derivative d{std::vector<Complex>(size), 0.0, 0.0};
  for (std::size_t k = 0; k < size; ++k) {
    Complex model{};
    Complex twice{};
    for (std::size_t h = 0; h < size; ++h) {
      const double weight = orders[h];
      d.on_basis[k] += i * weight * c[h] * at(s.S[1], orders[h] - orders[k]);
      model += c[h] * at(s.S[1], orders[h] - orders[k]);
      twice += weight * c[h] * at(s.S[2], orders[h] - orders[k]);
    }
    const Complex mine = static_cast<double>(orders[k]) * std::conj(c[k]);
    d.squared += (mine * twice).real();
    const auto measured = s.Y[channel][1][k];
    d.with_residual += (-i * mine * (measured - model)).real();
  }
  return d;
}

/// Real part of sum conj(a) b.
double product(const std::vector<Complex>& a, const std::vector<Complex>& b) {
  double sum = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += times(std::conj(a[k]), b[k]).real();
  return sum;
}

/// The normal equations of the amplitudes, as real ones of their real and imaginary
/// parts: [Re G, -Im G; Im G, Re G].
class NormalEquations {
 public:
  NormalEquations(const std::vector<Complex>& S, std::span<const int> orders)
      : size_(orders.size()) {
    numerics::Matrix G = numerics::zeros(2 * size_, 2 * size_);
    for (std::size_t k = 0; k < size_; ++k) {
      for (std::size_t h = 0; h < size_; ++h) {
        const Complex g = at(S, orders[h] - orders[k]);
        G(k, h) = G(size_ + k, size_ + h) = g.real();
        G(size_ + k, h) = g.imag();
        G(k, size_ + h) = -g.imag();
      }
    }
    lu_ = numerics::lu(G);
    determined_ = numerics::reciprocal_condition(G, lu_) > 1e-8;
  }

  [[nodiscard]] bool determined() const noexcept { return determined_; }

  [[nodiscard]] std::vector<Complex> solve(const std::vector<Complex>& right) const {
    std::vector<double> b(2 * size_);
    for (std::size_t k = 0; k < size_; ++k) {
      b[k] = right[k].real();
      b[size_ + k] = right[k].imag();
    }
    std::vector<double> x(2 * size_);
    numerics::solve(lu_, b, x);
    std::vector<Complex> out(size_);
    for (std::size_t k = 0; k < size_; ++k) out[k] = {x[k], x[size_ + k]};
    return out;
  }

 private:
  std::size_t size_;
  numerics::Lu lu_;
  bool determined_ = false;
};

}  // namespace

std::vector<int> two_sided(std::span<const int> orders) {
  std::vector<int> all{0};
  for (const int k : orders) {
    all.push_back(k);
    all.push_back(-k);
  }
  std::sort(all.begin(), all.end());
  return all;
}

HarmonicFit fit_harmonics(const TimedSamples& samples, std::span<const int> two_sided,
                          double Omega) {
  const FitSums s = sums(samples, two_sided, Omega);
  const NormalEquations equations(s.S[0], two_sided);
  HarmonicFit fit;
  fit.Omega = Omega;
  fit.ok = equations.determined();
  if (!fit.ok) return fit;
  double slope = 0.0;
  for (std::size_t ch = 0; ch < 3; ++ch) {
    const std::vector<Complex>& y = s.Y[ch][0];
    fit.c[ch] = equations.solve(y);
    const auto d = derivative(s, ch, two_sided, fit.c[ch]);
    fit.w[ch] = equations.solve(d.on_basis);
    fit.curvature += d.squared - product(d.on_basis, fit.w[ch]);
    slope += d.with_residual;
    fit.rss += std::max(0.0, s.yy[ch] - product(y, fit.c[ch]));
  }
  fit.step = fit.curvature > 0.0 ? slope / fit.curvature : 0.0;
  return fit;
}

std::vector<double> scores(const TimedSamples& samples, std::span<const int> two_sided,
                           const HarmonicFit& fit, int parts) {
  std::vector<double> out(static_cast<std::size_t>(parts), 0.0);
  const std::size_t zero = two_sided.size() / 2;
  std::vector<Complex> e(static_cast<std::size_t>(two_sided.back()) + 1);
  const std::size_t n = samples.t.size();
  for (std::size_t j = 0; j < n; ++j) {
    const double t = samples.t[j];
    powers(fit.Omega * t, e);
    double product = 0.0;
    for (std::size_t ch = 0; ch < 3; ++ch) {
      double model = fit.c[ch][zero].real();
      double slope = -fit.w[ch][zero].real();
      for (std::size_t k = zero + 1; k < two_sided.size(); ++k) {
        const double order = two_sided[k];
        const Complex turn = e[static_cast<std::size_t>(two_sided[k])];
        model += 2.0 * times(fit.c[ch][k], turn).real();
        const Complex c = fit.c[ch][k];
        const Complex along = order * t * Complex(-c.imag(), c.real());
        slope += 2.0 * times(along - fit.w[ch][k], turn).real();
      }
      product += (samples.channel[ch][j] - model) * slope;
    }
    out[j * out.size() / n] += product;
  }
  return out;
}

}  // namespace trochoid::signal
