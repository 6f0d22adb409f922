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
  Powers y;  ///< of theta_p + delta
  Powers C;  ///< of cos(delta)
  int highest = 0;
  bool converged = false;
};

MarkSeries mark_series(double a, double theta_p, double R, double tolerance) noexcept {
  MarkSeries out;
  Powers S;
  Powers d;
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

TrigPolynomial exact(const MarkSeries& series, double spread, double R, double feed,
                     double tolerance) noexcept {
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
  // c^n is mostly low harmonics: the highest ones may go.
  double dropped = 0.0;
  while (p.highest > 1) {
    const std::size_t k = index(p.highest);
    dropped += std::abs(p.a[k]) + std::abs(p.b[k]);
    if (dropped > tolerance) {
      break;
    }
    --p.highest;
  }
  return p;
}

/// A tooth before, as the tooth in cut sees it.
struct Mark {
  const geometry::EdgePosition& own;
  const geometry::EdgePosition& other;
  double back;     ///< how far it is ahead, without epsilon [rad]
  double theta_p;  ///< and with it, in (0, 2 pi] [rad]
};

Mark mark_at(const Passage& passage, const Slice& slice, int tooth, int mark) noexcept {
  const int teeth = passage.teeth;
  const auto& own = slice.teeth[index(tooth)];
  const auto& other = slice.teeth[index((tooth - mark + teeth) % teeth)];
  const double back = passage.back[index(tooth * teeth + mark - 1)];
  double theta_p = back;
  if (mark != teeth) {  // a tooth's own mark is one whole turn old
    theta_p += other.epsilon - own.epsilon;
    theta_p += theta_p <= 0 ? unit::turn : (theta_p > unit::turn ? -unit::turn : 0.0);
  }
  return {own, other, back, theta_p};
}

}  // namespace

MarkEstimate estimate_over_mark(const Passage& passage, const Slice& slice, int tooth,
                                int mark) noexcept {
  const Mark m = mark_at(passage, slice, tooth, mark);
  const double f_m = passage.feed * m.back;
  const double spread = m.own.R - m.other.R;
  switch (passage.model.model) {
    case Model::none:
      return {.sine = f_m};
    case Model::feed:
      return {.sine = f_m + spread};
    case Model::radial:
      return {.mean = spread, .sine = f_m};
    case Model::trochoidal:
      break;
  }
  // delta = -x c + a x c^2 + ... in C-6, with x = a theta_p, c = cos(theta).
  const double R = m.other.R;
  const double a = passage.feed / R;
  const double x = a * m.theta_p;
  return {.mean = spread,
          .sine = passage.feed * m.theta_p,
          .square = 0.5 * R * x * x,
          .skew = R * a * x,
          .rest = R * x * (1.5 * a * (a + x) + 0.2 * x * x * x)};
}

std::optional<TrigPolynomial> harmonics_over_mark(const Passage& passage,
                                                  const Slice& slice, int tooth,
                                                  int mark, double tolerance) noexcept {
  if (passage.model.model != Model::trochoidal) {
    const MarkEstimate line = estimate_over_mark(passage, slice, tooth, mark);
    // They mean the nominal theta = effective theta - epsilon.
    const double epsilon = slice.teeth[index(tooth)].epsilon;
    return first_harmonic(line.mean, line.sine * std::cos(epsilon),
                          -line.sine * std::sin(epsilon));
  }
  const Mark m = mark_at(passage, slice, tooth, mark);
  if (!(m.other.R > 0) || passage.feed > largest_feed * m.other.R) {
    return std::nullopt;
  }
  const MarkSeries series =
      mark_series(passage.feed / m.other.R, m.theta_p, m.other.R, 0.5 * tolerance);
  if (!series.converged) {
    return std::nullopt;
  }
  return exact(series, m.own.R - m.other.R, m.other.R, passage.feed,
               0.5 * tolerance);  // C-10
}

}  // namespace trochoid::chip
