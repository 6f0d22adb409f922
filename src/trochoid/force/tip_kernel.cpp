#include <trochoid/force/tip_kernel.h>

#include <numbers>

// Highway compiles this file once for each kind of vectors, and picks one when it runs.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "trochoid/force/tip_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

// After the others: it is compiled once for each kind of vectors too.
#include <hwy/contrib/math/math-inl.h>

HWY_BEFORE_NAMESPACE();
namespace trochoid::force {
namespace HWY_NAMESPACE {

namespace tip {

namespace hn = hwy::HWY_NAMESPACE;
using Tag = hn::CappedTag<double, 8>;
using Vector = hn::Vec<Tag>;
constexpr Tag tag;

HWY_INLINE Vector constant(double x) noexcept {
  return hn::Set(tag, x);
}

/// sin(x) with u = x^2, to 1e-13 for |x| <= pi/2.
HWY_INLINE Vector sine_of(Vector x, Vector u) noexcept {
  Vector p = constant(1.0 / 355687428096000.0);
  p = hn::MulAdd(u, p, constant(-1.0 / 1307674368000.0));
  p = hn::MulAdd(u, p, constant(1.0 / 6227020800.0));
  p = hn::MulAdd(u, p, constant(-1.0 / 39916800.0));
  p = hn::MulAdd(u, p, constant(1.0 / 362880.0));
  p = hn::MulAdd(u, p, constant(-1.0 / 5040.0));
  p = hn::MulAdd(u, p, constant(1.0 / 120.0));
  p = hn::MulAdd(u, p, constant(-1.0 / 6.0));
  return hn::MulAdd(hn::Mul(x, u), p, x);
}

/// 1 - cos(x), to 1e-12 for |x| <= pi/2.
HWY_INLINE Vector fall_of(Vector u) noexcept {
  Vector p = constant(-1.0 / 20922789888000.0);
  p = hn::MulAdd(u, p, constant(1.0 / 87178291200.0));
  p = hn::MulAdd(u, p, constant(-1.0 / 479001600.0));
  p = hn::MulAdd(u, p, constant(1.0 / 3628800.0));
  p = hn::MulAdd(u, p, constant(-1.0 / 40320.0));
  p = hn::MulAdd(u, p, constant(1.0 / 720.0));
  p = hn::MulAdd(u, p, constant(-1.0 / 24.0));
  return hn::Mul(u, hn::MulAdd(u, p, constant(0.5)));
}

/// Not below zero where C-5 has a root in [-pi/2, 0], or with A < 0 in [0, acos(-A)].
HWY_INLINE Vector root_is_there(Vector A, Vector back) noexcept {
  const Vector one = constant(1.0);
  const Vector ahead =
      hn::NegMulAdd(A, hn::Sub(back, constant(std::numbers::pi / 2)), one);
  const Vector minus = hn::Min(hn::Max(hn::Neg(A), hn::Zero(tag)), one);
  const Vector top = hn::Acos(tag, minus);
  const Vector sine = hn::Sqrt(hn::NegMulAdd(minus, minus, one));
  const Vector behind = hn::NegMulAdd(minus, hn::Add(back, top), sine);
  return hn::IfThenElse(hn::Ge(A, hn::Zero(tag)), ahead, behind);
}

/// The rows of a mark, at one block.
struct Mark {
  Vector apart;
  Vector back;
  Vector R;
};

/// C-5 and C-6. The function rises up to where its slope is zero, and bends away from the
/// side of the start: steps of Newton stay on that side.
template <class Mask>
HWY_INLINE Vector over_path(const Mark& mark, Vector A, Vector advance,
                            Mask has_none) noexcept {
  constexpr int most_steps = 16;
  constexpr double enough = 1e-9;
  const Vector one = constant(1.0);
  const Vector turn = hn::Mul(A, mark.back);
  const Vector half = constant(std::numbers::pi / 2);
  Vector x = hn::Div(hn::Neg(turn), hn::Max(hn::Add(one, A), constant(1e-3)));
  x = hn::Min(hn::Max(x, hn::Neg(half)), half);
  for (int i = 0; i < most_steps; ++i) {
    const Vector u = hn::Mul(x, x);
    const Vector g = hn::Add(sine_of(x, u), hn::MulAdd(A, x, turn));
    const Vector slope = hn::Max(hn::Sub(hn::Add(one, A), fall_of(u)), constant(1e-6));
    const Vector next =
        hn::Min(hn::Max(hn::Sub(x, hn::Div(g, slope)), hn::Neg(half)), half);
    const Vector step = hn::Abs(hn::Sub(next, x));
    x = next;
    if (hn::AllTrue(tag, hn::Or(has_none, hn::Lt(step, constant(enough))))) {
      break;
    }
  }
  const Vector along = hn::Mul(hn::Add(mark.back, x), advance);
  return hn::Add(hn::MulAdd(mark.R, fall_of(hn::Mul(x, x)), mark.apart), along);
}

}  // namespace tip

// Highway's table takes no noexcept functions.
void chips_near_axis(const NodePanels& all, const NodeTooth& tooth,
                     const double* sine_cosine, TipChips& all_out) {
  using namespace tip;
  NodeChips& out = all_out.chips;
  const std::size_t width = all.rule->width;
  const double* const rows = tooth.rows.data();
  const Vector tip_sine = constant(sine_cosine[0]);
  const Vector tip_cosine = constant(sine_cosine[1]);
  const Vector feed = constant(all.passage.feed);
  for (std::size_t i = 0; i < width; i += hn::Lanes(tag)) {
    const Vector c = hn::LoadU(tag, rows + NodeTooth::cosine * width + i);
    const Vector s = hn::LoadU(tag, rows + NodeTooth::sine * width + i);
    const Vector sine = hn::MulAdd(tip_sine, c, hn::Mul(tip_cosine, s));
    const Vector cosine = hn::MulSub(tip_cosine, c, hn::Mul(tip_sine, s));
    const Vector own = hn::LoadU(tag, rows + NodeTooth::radius * width + i);
    hn::StoreU(sine, tag, &out.sine[i]);
    hn::StoreU(cosine, tag, &out.cosine[i]);
    hn::StoreU(own, tag, &out.radius[i]);
    const double* row = rows + NodeTooth::first_mark * width + i;
    Vector least = own;  // up to the axis, where nobody left a mark
    for (std::size_t m = 0; m < static_cast<std::size_t>(all.passage.marks); ++m) {
      const Vector apart = hn::LoadU(tag, row);
      const Vector back = hn::LoadU(tag, row + width);
      const Vector R = hn::LoadU(tag, row + 2 * width);
      const Vector A = hn::Div(hn::Mul(feed, cosine), R);
      row += NodeTooth::rows_of_mark * width;
      const Vector there = hn::IfThenElse(hn::Gt(R, hn::Zero(tag)),
                                          root_is_there(A, back), constant(-no_mark));
      const auto has_none = hn::Not(hn::Ge(there, hn::Zero(tag)));
      Vector h = constant(no_mark);
      if (!hn::AllTrue(tag, has_none)) {
        h = hn::IfThenElse(
            has_none, h, over_path({apart, back, R}, A, hn::Mul(feed, sine), has_none));
      }
      hn::StoreU(there, tag, &all_out.there[m * width + i]);
      hn::StoreU(h, tag, &out.over[m * width + i]);
      least = hn::Min(least, h);
    }
    hn::StoreU(hn::IfThenElse(hn::Gt(own, hn::Zero(tag)), least, own), tag,
               &out.least[i]);
  }
}

void polynomials_near_axis(const NodeRow* powers, std::size_t rows, const double* t,
                           double* out) {
  using namespace tip;
  constexpr std::size_t nodes = 8;
  for (std::size_t i = 0; i < nodes; i += hn::Lanes(tag)) {
    const Vector at = hn::LoadU(tag, t + i);
    for (std::size_t r = 0; r < rows; ++r) {
      Vector value = constant(powers[r][nodes - 1]);
      for (std::size_t k = nodes - 1; k-- > 0;) {
        value = hn::MulAdd(value, at, constant(powers[r][k]));
      }
      hn::StoreU(value, tag, out + r * nodes + i);
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace trochoid::force
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace trochoid::force {

namespace {

HWY_EXPORT(chips_near_axis);
HWY_EXPORT(polynomials_near_axis);

}  // namespace

void tip_chips(const NodePanels& all, const NodeTooth& tooth,
               std::array<double, 2> sine_cosine, TipChips& out) noexcept {
  HWY_DYNAMIC_DISPATCH(chips_near_axis)(all, tooth, sine_cosine.data(), out);
}

void tip_polynomials(std::span<const NodeRow> powers, const double* t,
                     double* out) noexcept {
  HWY_DYNAMIC_DISPATCH(polynomials_near_axis)(powers.data(), powers.size(), t, out);
}

}  // namespace trochoid::force
#endif
