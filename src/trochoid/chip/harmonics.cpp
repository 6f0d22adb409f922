#include <trochoid/chip/harmonics.h>

#include <trochoid/base/index.h>
#include <trochoid/base/units.h>

#include <array>
#include <cmath>

namespace trochoid::chip {

namespace {

using base::index;
using numerics::TrigPolynomial;

constexpr int most = TrigPolynomial::most;
using Powers = std::array<double, most + 1>;

/// c^n = sum over k of of_power[n][k] cos(k theta).
constexpr auto of_power = [] {
  std::array<Powers, most + 2> table{};
  table[0][0] = 1.0;
  for (std::size_t n = 1; n < table.size(); ++n) {
    // cos(theta) cos(k theta) = (cos((k + 1) theta) + cos((k - 1) theta))/2
    for (std::size_t k = 0; k < n; ++k) {
      const double half = k == 0 ? table[n - 1][0] : 0.5 * table[n - 1][k];
      if (k + 1 <= most) {
        table[n][k + 1] += half;
      }
      if (k > 0) {
        table[n][k - 1] += half;
      }
    }
  }
  return table;
}();

/// The coefficients of C-9 and how many of them matter.
struct MarkSeries {
  Powers y{};  ///< of theta_p + delta
  Powers C{};  ///< of cos(delta)
  int highest = 0;
  bool converged = false;
};

MarkSeries mark_series(double a, double theta_p, double R, double tolerance) noexcept {
  MarkSeries out;
  Powers S{};
  Powers d{};
  out.y[0] = theta_p;
  out.C[0] = 1.0;
  for (int n = 1; n <= most; ++n) {
    const std::size_t i = index(n);
    S[i] = -a * out.y[i - 1];
    double squares = 0.0;
    double turned = 0.0;
    for (std::size_t k = 1; k < i; ++k) {
      squares += out.C[k] * out.C[i - k] + S[k] * S[i - k];
      turned += static_cast<double>(k) * d[k] * out.C[i - k];
    }
    out.C[i] = -0.5 * squares;
    d[i] = S[i] - turned / n;  // C-9
    out.y[i] = d[i];
    if (R * (std::abs(out.C[i]) + std::abs(a * out.y[i - 1])) < tolerance) {
      out.converged = true;
      return out;
    }
    out.highest = n;
  }
  return out;
}

TrigPolynomial first_harmonic(double mean, double sine, double cosine) noexcept {
  TrigPolynomial p;
  p.highest = 1;
  p.a[0] = mean;
  p.b[0] = 0.0;
  p.a[1] = cosine;
  p.b[1] = sine;
  return p;
}

TrigPolynomial exact(const MarkSeries& series, double spread, double R,
                     double feed) noexcept {
  TrigPolynomial p;
  p.highest = series.highest;
  for (int k = 0; k <= series.highest; ++k) {
    p.a[index(k)] = 0.0;
    p.b[index(k)] = 0.0;
  }
  p.a[0] = spread;
  for (int n = 0; n < series.highest; ++n) {
    // sin(theta) c^n is -1/(n + 1) of the derivative of c^(n + 1).
    const double y = feed * series.y[index(n)] / (n + 1);
    for (int k = n + 1; k > 0; k -= 2) {
      p.b[index(k)] += y * k * of_power[index(n + 1)][index(k)];
    }
  }
  for (int n = 2; n <= series.highest; ++n) {
    const double C = R * series.C[index(n)];
    for (int k = n; k >= 0; k -= 2) {
      p.a[index(k)] -= C * of_power[index(n)][index(k)];
    }
  }
  return p;
}

}  // namespace

std::optional<TrigPolynomial> harmonics_over_mark(const Passage& passage,
                                                  const Slice& slice, int tooth,
                                                  int mark, double tolerance) noexcept {
  const int teeth = passage.teeth;
  const auto& own = slice.teeth[index(tooth)];
  const auto& other = slice.teeth[index((tooth - mark + teeth) % teeth)];
  const double back = passage.back[index(tooth * teeth + mark - 1)];
  const double f_m = passage.feed * back;
  // Simple models mean the nominal theta = effective theta - epsilon.
  const double c = std::cos(own.epsilon);
  const double s = std::sin(own.epsilon);
  switch (passage.model.model) {
    case Model::none:
      return first_harmonic(0.0, f_m * c, -f_m * s);
    case Model::feed: {
      const double size = f_m + own.R - other.R;
      return first_harmonic(0.0, size * c, -size * s);
    }
    case Model::radial:
      return first_harmonic(own.R - other.R, f_m * c, -f_m * s);
    case Model::trochoidal:
      break;
  }
  double theta_p = back;
  if (mark != teeth) {  // a tooth's own mark is one whole turn old
    theta_p += other.epsilon - own.epsilon;
    theta_p += theta_p <= 0 ? unit::turn : (theta_p > unit::turn ? -unit::turn : 0.0);
  }
  if (!(other.R > 0)) {
    return std::nullopt;
  }
  const MarkSeries series =
      mark_series(passage.feed / other.R, theta_p, other.R, tolerance);
  if (!series.converged) {
    return std::nullopt;
  }
  return exact(series, own.R - other.R, other.R, passage.feed);  // C-10
}

}  // namespace trochoid::chip
