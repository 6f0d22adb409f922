#include <trochoid/signal/harmonic_fit.h>

#include <Eigen/Cholesky>
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
struct Sums {
  /// sum t^p e^(i m Omega t), p = 0, 1, 2, m = 0 .. twice the highest order
  std::array<std::vector<Complex>, 3> S;
  /// sum t^p y e^(-i k Omega t), p = 0, 1, of each channel, k of the two-sided orders
  std::array<std::array<std::vector<Complex>, 2>, 3> Y;
  std::array<double, 3> yy{};
};

Sums sums(const TimedSamples& samples, std::span<const int> orders, double Omega) {
  const auto K = static_cast<std::size_t>(orders.back());
  Sums s;
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
  Eigen::VectorXcd on_basis;
  double squared = 0.0;
  double with_residual = 0.0;
};

Derivative derivative(const Sums& s, std::size_t channel, std::span<const int> orders,
                      const Eigen::VectorXcd& c) {
  const auto size = static_cast<Eigen::Index>(orders.size());
  Derivative d{Eigen::VectorXcd::Zero(size), 0.0, 0.0};
  for (Eigen::Index k = 0; k < size; ++k) {
    const int order_k = orders[static_cast<std::size_t>(k)];
    Complex model{};
    Complex twice{};
    for (Eigen::Index h = 0; h < size; ++h) {
      const int order_h = orders[static_cast<std::size_t>(h)];
      const double weight = order_h;
      d.on_basis(k) += i * weight * c(h) * at(s.S[1], order_h - order_k);
      model += c(h) * at(s.S[1], order_h - order_k);
      twice += weight * c(h) * at(s.S[2], order_h - order_k);
    }
    const Complex mine = static_cast<double>(order_k) * std::conj(c(k));
    d.squared += (mine * twice).real();
    const auto measured = s.Y[channel][1][static_cast<std::size_t>(k)];
    d.with_residual += (-i * mine * (measured - model)).real();
  }
  return d;
}

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
  const Sums s = sums(samples, two_sided, Omega);
  const auto size = static_cast<Eigen::Index>(two_sided.size());
  Eigen::MatrixXcd G(size, size);
  for (Eigen::Index k = 0; k < size; ++k) {
    for (Eigen::Index h = 0; h < size; ++h) {
      G(k, h) = at(s.S[0], two_sided[static_cast<std::size_t>(h)] -
                               two_sided[static_cast<std::size_t>(k)]);
    }
  }
  const Eigen::LLT<Eigen::MatrixXcd> solver(G);
  HarmonicFit fit;
  fit.Omega = Omega;
  fit.ok = solver.info() == Eigen::Success && solver.rcond() > 1e-8;
  if (!fit.ok) return fit;
  double slope = 0.0;
  for (std::size_t ch = 0; ch < 3; ++ch) {
    const Eigen::Map<const Eigen::VectorXcd> y(s.Y[ch][0].data(), size);
    const Eigen::VectorXcd c = solver.solve(y);
    const auto d = derivative(s, ch, two_sided, c);
    const Eigen::VectorXcd w = solver.solve(d.on_basis);
    fit.curvature += d.squared - d.on_basis.dot(w).real();
    slope += d.with_residual;
    fit.rss += std::max(0.0, s.yy[ch] - y.dot(c).real());
    fit.c[ch].assign(c.data(), c.data() + size);
    fit.w[ch].assign(w.data(), w.data() + size);
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
