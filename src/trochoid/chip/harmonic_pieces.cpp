#include <trochoid/chip/harmonic_pieces.h>

#include <trochoid/base/index.h>
#include <trochoid/base/units.h>
#include <trochoid/chip/harmonics.h>
#include <trochoid/chip/near_marks.h>
#include <trochoid/numerics/trig_roots.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory_resource>
#include <numbers>

namespace trochoid::chip {

namespace {

using base::index;
using numerics::add_roots;
using numerics::bracketed_root;
using numerics::evaluate;
using numerics::TrigPolynomial;
using numerics::value;
using numerics::ValueAndSlope;

using Breaks = std::pmr::vector<double>;
using Marks = std::pmr::vector<int>;

using std::numbers::pi;
constexpr double start = -pi / 2;  // of a turn: behind the tool
/// Stretches shorter than this are none [rad].
constexpr double shortest = 1e-13;

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

/// In [start, start + 2 pi).
double in_turn(double theta) noexcept {
  while (theta < start) {
    theta += unit::turn;
  }
  while (theta >= start + unit::turn) {
    theta -= unit::turn;
  }
  return theta;
}

void sort_breaks(Breaks& breaks) {
  for (double& x : breaks) {
    x = in_turn(x);
  }
  breaks.push_back(start);
  breaks.push_back(start + unit::turn);
  std::sort(breaks.begin(), breaks.end());
}

/// Breaks of the window in which simple models cut: in front, within the stock.
void add_window(const Passage& passage, const Slice& slice, double epsilon,
                Breaks& breaks) {
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
void add_stock_edge(double y, double R, const ToothHarmonics& tooth, const Marks& marks,
                    Breaks& breaks) {
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
    add(&*tooth.over_mark[index(m - 1)]);
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
  Marks marks;
  double R = 0.0;
  double epsilon = 0.0;

  [[nodiscard]] Winner at(double theta) const noexcept {
    const double s = std::sin(theta);
    const double c = std::cos(theta);
    double least = std::numeric_limits<double>::infinity();
    Winner winner;
    for (const int m : marks) {
      const double h = value(*tooth.over_mark[index(m - 1)], s, c);
      if (h < least) {
        least = h;
        winner.mark = m;
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

std::optional<ToothHarmonics> tooth_harmonics(const Passage& passage,
                                              const Slice& slice, int tooth,
                                              double tolerance) {
  ToothHarmonics out;
  const geometry::EdgePosition& own = slice.teeth[index(tooth)];
  if (!(own.R > 0) || passage.feed <= 0) {
    return out;
  }
  std::array<std::byte, 2048> space;  // most often enough
  std::pmr::monotonic_buffer_resource memory(space.data(), space.size());
  const Search search{passage, slice,
                      out,     near_marks(passage, slice, tooth, memory),
                      own.R,   own.epsilon};
  out.over_mark.resize(index(passage.marks));
  for (const int m : search.marks) {
    out.over_mark[index(m - 1)] =
        harmonics_over_mark(passage, slice, tooth, m, tolerance);
    if (!out.over_mark[index(m - 1)]) {
      return std::nullopt;
    }
  }
  Breaks breaks(&memory);
  breaks.reserve(32);
  out.pieces.reserve(8);
  for (std::size_t i = 0; i < search.marks.size(); ++i) {
    const TrigPolynomial& p = *out.over_mark[index(search.marks[i] - 1)];
    add_roots(p, h_threshold, breaks);
    for (std::size_t k = i + 1; k < search.marks.size(); ++k) {
      add_roots(difference(p, *out.over_mark[index(search.marks[k] - 1)]), 0.0, breaks);
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
