#include <trochoid/surface/moment_kernel.h>

#include <algorithm>

// Highway compiles this file once for each kind of vectors, and picks one when it runs.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "trochoid/surface/moment_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace trochoid::surface {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using Tag = hn::CappedTag<double, 8>;
using Vector = hn::Vec<Tag>;
constexpr Tag tag;

/// Gauss' points and weights on [-1, 1]: exact to degree 21, of which the basis has 15.
constexpr std::size_t gauss_points = 11;
constexpr std::array<double, gauss_points> gauss_t = {
    -0.9782286581460570, -0.8870625997680953, -0.7301520055740494,
    -0.5190961292068118, -0.2695431559523450, 0.0,
    0.2695431559523450,  0.5190961292068118,  0.7301520055740494,
    0.8870625997680953,  0.9782286581460570};
constexpr std::array<double, gauss_points> gauss_w = {
    0.0556685671161737, 0.1255803694649046, 0.1862902109277343, 0.2331937645919905,
    0.2628045445102467, 0.2729250867779006, 0.2628045445102467, 0.2331937645919905,
    0.1862902109277343, 0.1255803694649046, 0.0556685671161737};

/// Weight over distance: infinite nowhere, so that a point may lie on a node.
HWY_INLINE Vector share(double x, const double* at, const double* weight) noexcept {
  const Vector d = hn::Sub(hn::Set(tag, x), hn::Load(tag, at));
  const Vector least = hn::Set(tag, 1e-15);
  const Vector safe = hn::IfThenElse(hn::Lt(hn::Abs(d), least), least, d);
  return hn::Div(hn::Load(tag, weight), safe);
}

/// A tooth at one place of a panel.
struct Here {
  double h;
  double sine;
  double cosine;
};

/// C-7: what the stock leaves of a chip.
HWY_INLINE double cut_short(const std::array<double, 2>& stock, double R, double shift,
                            const Here& here) noexcept {
  double inner = R - here.h;
  double outer = R;
  for (const double side : {1.0, -1.0}) {  // y >= the first, and then -y >= -the last
    const double edge = side > 0 ? stock[0] - shift : shift - stock[1];
    const double c = side * here.cosine;
    if (edge > 0) {
      inner = c > 0 ? std::max(inner, edge / c) : R;
    } else if (c < 0) {
      outer = std::min(outer, edge / c);
    }
  }
  return std::max(0.0, outer - inner);
}

HWY_INLINE Here at_place(const MomentRule& rule, const ToothRows& tooth,
                         const EdgeStretch& stretch, double t) noexcept {
  Vector whole = hn::Zero(tag);
  Vector h = whole;
  Vector s = whole;
  Vector c = whole;
  Vector R = whole;
  Vector shift = whole;
  for (std::size_t i = 0; i < force::node_room; i += hn::Lanes(tag)) {
    const Vector w = share(t, &rule.node[i], &rule.node_weight[i]);
    whole = hn::Add(whole, w);
    h = hn::MulAdd(w, hn::LoadU(tag, stretch.over + i), h);
    s = hn::MulAdd(w, hn::LoadU(tag, tooth.sine + i), s);
    c = hn::MulAdd(w, hn::LoadU(tag, tooth.cosine + i), c);
    if (stretch.by_stock) {
      R = hn::MulAdd(w, hn::LoadU(tag, tooth.radius + i), R);
      shift = hn::MulAdd(w, hn::LoadU(tag, tooth.shift + i), shift);
    }
  }
  const auto sum = [](Vector v) { return hn::GetLane(hn::SumOfLanes(tag, v)); };
  const double per = 1 / sum(whole);
  Here here{per * sum(h), per * sum(s), per * sum(c)};
  if (stretch.by_stock) {
    here.h = cut_short(tooth.stock, per * sum(R), per * sum(shift), here);
  }
  return here;
}

// Highway's table takes no noexcept functions.
void stretch_at_points(const MomentRule& rule, const ToothRows& tooth,
                       const EdgeStretch& stretch, MomentSums& sums) {
  const double half = 0.5 * (stretch.to - stretch.from);
  for (std::size_t k = 0; k < gauss_points; ++k) {
    const double t = stretch.from + half * (1 + gauss_t[k]);
    const Here here = at_place(rule, tooth, stretch, t);
    const double dz = half * gauss_w[k] * tooth.height;
    const double chip = dz * here.h;
    const double edge = dz * tooth.edge;
    const std::array<double, 4> y = {chip * here.sine, -chip * here.cosine,
                                     edge * here.sine, -edge * here.cosine};  // E-2
    sums.along[0] -= chip * here.cosine;
    sums.along[1] -= chip * here.sine;
    sums.along[2] -= edge * here.cosine;
    sums.along[3] -= edge * here.sine;
    const double x = tooth.middle + tooth.half * t;
    alignas(64) PointRow shares;
    Vector whole = hn::Zero(tag);
    for (std::size_t q = 0; q < point_room; q += hn::Lanes(tag)) {
      const Vector w = share(x, &rule.point[q], &rule.point_weight[q]);
      whole = hn::Add(whole, w);
      hn::Store(w, tag, &shares[q]);
    }
    const double per = 1 / hn::GetLane(hn::SumOfLanes(tag, whole));
    for (std::size_t column = 0; column < y.size(); ++column) {
      const Vector f = hn::Set(tag, per * y[column]);
      double* row = sums.across[column].data();
      for (std::size_t q = 0; q < point_room; q += hn::Lanes(tag)) {
        hn::Store(hn::MulAdd(f, hn::Load(tag, &shares[q]), hn::Load(tag, row + q)), tag,
                  row + q);  // E-3
      }
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace trochoid::surface
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace trochoid::surface {

namespace {

HWY_EXPORT(stretch_at_points);

}  // namespace

void add_stretch(const MomentRule& rule, const ToothRows& tooth,
                 const EdgeStretch& stretch, MomentSums& sums) noexcept {
  HWY_DYNAMIC_DISPATCH(stretch_at_points)(rule, tooth, stretch, sums);
}

}  // namespace trochoid::surface
#endif
