#include <trochoid/chip/harmonic_pieces.h>

#include <trochoid/base/index.h>
#include <trochoid/base/units.h>
#include <trochoid/chip/harmonics.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace trochoid::chip {

namespace {

using base::index;
using numerics::evaluate;
using numerics::TrigPolynomial;
using numerics::ValueAndSlope;

constexpr double pi = std::numbers::pi;
constexpr double start = -pi / 2;
/// Stretches shorter than this are none [rad].
constexpr double shortest = 1e-13;

double highest_harmonics(const TrigPolynomial& p) noexcept {
  double sum = std::abs(p.a[1]);
  for (int k = 2; k <= p.highest; ++k) {
    sum += std::abs(p.a[index(k)]) + std::abs(p.b[index(k)]);
  }
  return sum;
}

TrigPolynomial difference(const TrigPolynomial& p, const TrigPolynomial& q) noexcept {
  TrigPolynomial out;
  out.highest = std::max(p.highest, q.highest);
  for (int k = 0; k <= out.highest; ++k) {
    const std::size_t i = index(k);
    out.a[i] = (k <= p.highest ? p.a[i] : 0.0) - (k <= q.highest ? q.a[i] : 0.0);
    out.b[i] = (k <= p.highest ? p.b[i] : 0.0) - (k <= q.highest ? q.b[i] : 0.0);
  }
  return out;
}

ValueAndSlope at(const TrigPolynomial& p, double theta) noexcept {
  return evaluate(p, std::sin(theta), std::cos(theta));
}

/// Root of a function that rises or falls from lo to hi, by Newton's steps in a bracket.
template <class Function>
double bracketed_root(const Function& f, double lo, double hi, double x) noexcept {
  const bool rises = f(lo).value < 0;
  for (int i = 0; i < 60; ++i) {
    const auto [value, slope] = f(x);
    ((value < 0) == rises ? lo : hi) = x;
    const double next = x - value / slope;
    const bool good = next > lo && next < hi;
    const double moved = (good ? next : 0.5 * (lo + hi)) - x;
    x += moved;
    if (std::abs(moved) < 4e-15 || !(hi - lo > shortest)) {
      break;
    }
  }
  return x;
}

/// Where a polynomial that is mostly its first harmonic has its extremum near x.
double extremum(const TrigPolynomial& p, double x) noexcept {
  for (int i = 0; i < 3; ++i) {
    double slope = 0.0;
    double bend = 0.0;
    for (int k = 1; k <= p.highest; ++k) {
      const std::size_t n = index(k);
      const double c = std::cos(k * x);
      const double s = std::sin(k * x);
      slope += k * (p.b[n] * c - p.a[n] * s);
      bend -= k * k * (p.a[n] * c + p.b[n] * s);
    }
    const double step = slope / bend;
    if (!(std::abs(step) < 0.5)) {
      return x;
    }
    x -= step;
  }
  return x;
}

/// @brief Add the roots of a polynomial that is mostly d + e sin: at most two in a turn.
void add_roots(const TrigPolynomial& p, std::vector<double>& roots) {
  const double e = p.b[1];
  const double d = p.a[0];
  const double rest = highest_harmonics(p);
  if (!(std::abs(e) > 0) || std::abs(d) > std::abs(e) + rest) {
    return;
  }
  const double sine = std::clamp(-d / e, -1.0, 1.0);
  const auto f = [&](double theta) { return at(p, theta); };
  const double guess = std::asin(sine);
  if (std::abs(sine) < 0.98 && rest < 0.01 * std::abs(e)) {
    for (double x : {guess, pi - guess}) {
      for (int i = 0; i < 8; ++i) {
        const auto [value, slope] = f(x);
        const double step = value / slope;
        x -= step;
        if (std::abs(step) < 1e-9) {  // the next one would be its square
          break;
        }
      }
      roots.push_back(x);
    }
    return;
  }
  // Near the extrema the two roots run together, or there are none.
  const double top = extremum(p, pi / 2);
  const double bottom = extremum(p, -pi / 2);
  if ((f(top).value < 0) == (f(bottom).value < 0)) {
    return;
  }
  roots.push_back(bracketed_root(f, bottom, top, std::clamp(guess, bottom, top)));
  roots.push_back(bracketed_root(f, top, bottom + 2 * pi,
                                 std::clamp(pi - guess, top, bottom + 2 * pi)));
}

/// @brief Marks that can be the nearest one anywhere in front of the tool.
///
/// d + e u with u = sin(theta) is a line; one that lies above another at both ends of
/// the range of u lies above it everywhere.
std::vector<int> marks_that_matter(const ToothHarmonics& tooth) {
  const int count = static_cast<int>(tooth.over_mark.size());
  const auto line = [&](int m, double u) {
    const TrigPolynomial& p = *tooth.over_mark[index(m)];
    return p.a[0] + p.b[1] * u;
  };
  double lowest_u = -1.0;
  for (int m = 0; m < count; ++m) {
    const TrigPolynomial& p = *tooth.over_mark[index(m)];
    if (p.b[1] > 0) {  // h > 0 needs d + e u > -rest
      lowest_u = std::max(lowest_u, (-p.a[0] - highest_harmonics(p)) / p.b[1]);
    }
  }
  lowest_u = std::min(lowest_u, 1.0);
  std::vector<int> kept;
  for (int m = 0; m < count; ++m) {
    const bool beaten = [&] {
      for (int other = 0; other < count; ++other) {
        const double slack = highest_harmonics(*tooth.over_mark[index(m)]) +
                             highest_harmonics(*tooth.over_mark[index(other)]);
        if (other != m && line(m, lowest_u) > line(other, lowest_u) + slack &&
            line(m, 1.0) > line(other, 1.0) + slack) {
          return true;
        }
      }
      return false;
    }();
    if (!beaten) {
      kept.push_back(m);
    }
  }
  return kept;
}

/// In [start, start + 2 pi).
double in_turn(double theta) noexcept {
  const double u = theta - start;
  return start + (u - unit::turn * std::floor(u / unit::turn));
}

void sort_breaks(std::vector<double>& breaks) {
  for (double& x : breaks) {
    x = in_turn(x);
  }
  breaks.push_back(start);
  breaks.push_back(start + unit::turn);
  std::sort(breaks.begin(), breaks.end());
}

/// Breaks of the window in which simple models cut: in front, within the stock.
void add_window(const Passage& passage, const Slice& slice, double epsilon,
                std::vector<double>& breaks) {
  breaks.push_back(epsilon);
  breaks.push_back(pi + epsilon);
  for (const double y :
       {passage.stock.y_lo - slice.shift, passage.stock.y_hi - slice.shift}) {
    if (std::abs(y) < slice.r) {
      breaks.push_back(std::acos(y / slice.r) + epsilon);
    }
  }
}

/// @brief Breaks of the exact chip at an edge of the stock: where the tooth passes it,
/// and where the mark does.
void add_stock_edge(double y, double R, const ToothHarmonics& tooth,
                    const std::vector<int>& marks, std::vector<double>& breaks) {
  if (!std::isfinite(y)) {
    return;
  }
  // (R - h) cos(theta) = y; h = 0 for the tooth itself.
  const auto add = [&](const TrigPolynomial* h) {
    const auto f = [&](double theta) {
      const double s = std::sin(theta);
      const double c = std::cos(theta);
      const ValueAndSlope chip = h == nullptr ? ValueAndSlope{} : evaluate(*h, s, c);
      const double l = R - chip.value;
      return ValueAndSlope{l * c - y, -l * s - chip.slope * c};
    };
    // Falls from about 0 to about pi, rises behind.
    double top = 0.0;
    double bottom = pi;
    for (double* x : {&top, &bottom}) {
      for (int i = 0; h != nullptr && i < 4; ++i) {
        const double step = 1e-4;
        const double slope = f(*x).slope;
        *x -= slope * 2 * step / (f(*x + step).slope - f(*x - step).slope);
      }
    }
    if ((f(top).value < 0) == (f(bottom).value < 0)) {
      return;
    }
    const double guess = std::acos(std::clamp(y / R, -1.0, 1.0));
    breaks.push_back(bracketed_root(f, top, bottom, std::clamp(guess, top, bottom)));
    breaks.push_back(bracketed_root(f, bottom, top + 2 * pi,
                                    std::clamp(2 * pi - guess, bottom, top + 2 * pi)));
  };
  add(nullptr);
  for (const int m : marks) {
    add(&*tooth.over_mark[index(m)]);
  }
}

/// What bounds the chip of a tooth at an angle.
struct Winner {
  int mark = 0;  ///< 0: not in cut
  bool at_stock_edge = false;
};

struct Search {
  const Passage& passage;
  const Slice& slice;
  const ToothHarmonics& tooth;
  std::vector<int> marks;
  double R = 0.0;
  double epsilon = 0.0;

  [[nodiscard]] Winner at(double theta) const noexcept {
    const double s = std::sin(theta);
    const double c = std::cos(theta);
    double least = std::numeric_limits<double>::infinity();
    Winner winner;
    for (const int m : marks) {
      const double h = evaluate(*tooth.over_mark[index(m)], s, c).value;
      if (h < least) {
        least = h;
        winner.mark = m + 1;
      }
    }
    const double y_lo = passage.stock.y_lo - slice.shift;
    const double y_hi = passage.stock.y_hi - slice.shift;
    if (passage.model.model != Model::trochoidal) {
      const double nominal = theta - epsilon;
      const double y = slice.r * std::cos(nominal);
      const bool inside = std::sin(nominal) > 0 && y >= y_lo && y <= y_hi;
      return inside && least > h_threshold ? winner : Winner{};
    }
    // The material lies between these distances from the axis.
    double inner = R - least;
    double outer = R;
    for (const double y : {y_lo, y_hi}) {
      const bool low = y == y_lo;
      if (!std::isfinite(y)) {
        continue;
      }
      if (low == (c > 0)) {  // the ray comes into the stock at y
        if (y * c > 0 && y / c > inner) {
          inner = y / c;
          winner.at_stock_edge = true;
        }
      } else if (const double end = y * c > 0 ? y / c : 0.0; end < outer) {
        outer = end;
        winner.at_stock_edge = true;
      }
    }
    return outer - inner > h_threshold ? winner : Winner{};
  }
};

}  // namespace

double harmonic_start() noexcept {
  return start;
}

std::optional<ToothHarmonics> tooth_harmonics(const Passage& passage,
                                              const Slice& slice, int tooth,
                                              double tolerance) {
  ToothHarmonics out;
  for (int m = 1; m <= passage.marks; ++m) {
    out.over_mark.push_back(harmonics_over_mark(passage, slice, tooth, m, tolerance));
    if (!out.over_mark.back()) {
      return std::nullopt;
    }
  }
  const geometry::EdgePosition& own = slice.teeth[index(tooth)];
  if (!(own.R > 0) || passage.feed <= 0) {
    return out;
  }
  const Search search{passage, slice, out, marks_that_matter(out), own.R, own.epsilon};
  std::vector<double> breaks;
  for (std::size_t i = 0; i < search.marks.size(); ++i) {
    const TrigPolynomial& p = *out.over_mark[index(search.marks[i])];
    TrigPolynomial in_cut = p;
    in_cut.a[0] -= h_threshold;
    add_roots(in_cut, breaks);
    for (std::size_t k = i + 1; k < search.marks.size(); ++k) {
      add_roots(difference(p, *out.over_mark[index(search.marks[k])]), breaks);
    }
  }
  if (passage.model.model == Model::trochoidal) {
    add_stock_edge(passage.stock.y_lo - slice.shift, own.R, out, search.marks, breaks);
    add_stock_edge(passage.stock.y_hi - slice.shift, own.R, out, search.marks, breaks);
  } else {
    add_window(passage, slice, own.epsilon, breaks);
  }
  sort_breaks(breaks);
  for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
    if (!(breaks[i + 1] - breaks[i] > shortest)) {
      continue;
    }
    const Winner winner = search.at(0.5 * (breaks[i] + breaks[i + 1]));
    if (winner.mark == 0) {
      continue;
    }
    HarmonicPiece* last = out.pieces.empty() ? nullptr : &out.pieces.back();
    if (last != nullptr && last->to == breaks[i] && last->mark == winner.mark &&
        !last->at_stock_edge && !winner.at_stock_edge) {
      last->to = breaks[i + 1];
    } else {
      out.pieces.push_back(
          {breaks[i], breaks[i + 1], winner.mark, winner.at_stock_edge});
    }
  }
  return out;
}

}  // namespace trochoid::chip
