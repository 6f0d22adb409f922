#include <trochoid/dynamics/edge_force.h>

#include <trochoid/chip/chip.h>

#include <cstddef>
#include <cstdint>

// Highway compiles this file once for each kind of vectors, and picks one when it runs.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "trochoid/dynamics/edge_force.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace trochoid::dynamics {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// c_0 + c_1 x + c_2 x^2 + c_3 x^3
template <class D, class V = hn::Vec<D>>
HWY_INLINE V cubic(D d, V x, V x_2, const double (&c)[4]) {
  const V low = hn::MulAdd(x, hn::Set(d, c[1]), hn::Set(d, c[0]));
  const V high = hn::MulAdd(x, hn::Set(d, c[3]), hn::Set(d, c[2]));
  return hn::MulAdd(x_2, high, low);
}

/// log2(u) of normal u > 0, as in power_of.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V binary_logarithm(D d, V u) {
  const hn::RebindToUnsigned<D> whole;
  constexpr std::uint64_t fraction = 0x000fffffffffffffULL;
  constexpr std::uint64_t half_root = 0x0009'5f61'9980'c433ULL;  // of 1.5858...
  constexpr std::uint64_t one = 0x0010'0000'0000'0000ULL;        // of the exponent
  constexpr double two_52 = 4503599627370496.0;
  const auto shifted = hn::Add(hn::BitCast(whole, u), hn::Set(whole, one - half_root));
  const V high = hn::BitCast(
      d, hn::Or(hn::ShiftRight<52>(shifted), hn::BitCast(whole, hn::Set(d, two_52))));
  const V e = hn::Sub(high, hn::Set(d, two_52 + 1023.0));
  const V s =
      hn::BitCast(d, hn::Add(hn::And(shifted, hn::Set(whole, fraction)),
                             hn::Set(whole, half_root + 0x3fe0'0000'0000'0000)));
  const V t = hn::Div(hn::Sub(s, hn::Set(d, 1.0)), hn::Add(s, hn::Set(d, 1.0)));
  const V t_2 = hn::Mul(t, t);
  const V t_4 = hn::Mul(t_2, t_2);
  const V t_8 = hn::Mul(t_4, t_4);
  constexpr double c_0[4] = {1.0, 1.0 / 3, 1.0 / 5, 1.0 / 7};
  constexpr double c_4[4] = {1.0 / 9, 1.0 / 11, 1.0 / 13, 1.0 / 15};
  const V last = hn::MulAdd(t_2, hn::Set(d, 1.0 / 19), hn::Set(d, 1.0 / 17));
  const V high_series = hn::MulAdd(t_8, last, cubic(d, t_2, t_4, c_4));
  const V series = hn::MulAdd(t_8, high_series, cubic(d, t_2, t_4, c_0));
  constexpr double two_over_ln_2 = 2.8853900817779268;
  return hn::MulAdd(hn::Mul(hn::Set(d, two_over_ln_2), t), series, e);
}

/// 2^y for |y| < 1000, as in power_of.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V power_of_two(D d, V y) {
  const hn::RebindToUnsigned<D> whole;
  constexpr double to_whole = 6755399441055744.0;  // 1.5 2^52
  const V rounded = hn::Add(y, hn::Set(d, to_whole));
  const V n = hn::Sub(rounded, hn::Set(d, to_whole));
  const V x = hn::Mul(hn::Sub(y, n), hn::Set(d, 0.6931471805599453));
  const V x_2 = hn::Mul(x, x);
  const V x_4 = hn::Mul(x_2, x_2);
  const V x_8 = hn::Mul(x_4, x_4);
  constexpr double c_0[4] = {1.0, 1.0, 1.0 / 2, 1.0 / 6};
  constexpr double c_4[4] = {1.0 / 24, 1.0 / 120, 1.0 / 720, 1.0 / 5040};
  constexpr double c_8[4] = {1.0 / 40320, 1.0 / 362880, 1.0 / 3628800, 1.0 / 39916800};
  const V last = hn::MulAdd(x_4, hn::Set(d, 1.0 / 479001600), cubic(d, x, x_2, c_8));
  const V low = hn::MulAdd(x_4, cubic(d, x, x_2, c_4), cubic(d, x, x_2, c_0));
  const V exponential = hn::MulAdd(x_8, last, low);
  const auto exponent = hn::ShiftLeft<52>(
      hn::Add(hn::BitCast(whole, rounded), hn::Set(whole, std::uint64_t{1023})));
  return hn::Mul(exponential, hn::BitCast(d, exponent));
}

/// What makes a force.
struct Cutting {
  const PointsInCut& points;
  const double* constant;
  const Displaced& q;
  const force::Terms& law;
};

/// What a chip is the least of.
struct Surfaces {
  const PointsInCut& points;
  const double* above;
  std::span<const Displaced> marks;
};

/// Three directions of a law, t, r, a, at the points of one vector.
template <class V>
struct Directions {
  V force[3];
  V slope[3];
};

template <std::size_t directions, class D, class V = hn::Vec<D>>
HWY_INLINE Directions<V> of_law(D d, const force::Terms& law, V h, V width, V edge) {
  const auto& m = law.form.m;
  V logarithm = hn::Zero(d);
  if (law.form.power) {
    logarithm = binary_logarithm(d, hn::Mul(h, hn::Set(d, 1 / force::h_0)));
  }
  Directions<V> out;
  V g = hn::Set(d, 1.0);  // (h/h_0)^-m
  double taken = 0.0;
  for (std::size_t e = 0; e < directions; ++e) {
    if (law.form.power && m[e] != taken && law.K[e] != 0) {
      taken = m[e];
      g = power_of_two(d, hn::Mul(logarithm, hn::Set(d, -taken)));
    }
    const V K = hn::Mul(hn::Mul(hn::Set(d, law.K[e]), width), g);
    out.force[e] = hn::MulAdd(K, h, hn::Mul(hn::Set(d, law.K_e[e]), edge));
    out.slope[e] = hn::Mul(hn::Set(d, law.form.power ? 1 - m[e] : 1.0), K);
  }
  return out;
}

/// As many points as fill vectors of D.
/// @param directions  2: without forces along the axis
/// @return the first point that is left
template <std::size_t directions, class D>
HWY_INLINE std::size_t add_points(D d, std::size_t i, const Cutting& cut,
                                  ForceSums& total) {
  const auto& [points, constant, q, law] = cut;
  using V = hn::Vec<D>;
  const std::size_t lanes = hn::Lanes(d);
  if (i + lanes > points.count) {
    return i;
  }
  V sum[9];
  for (V& s : sum) s = hn::Zero(d);
  for (; i + lanes <= points.count; i += lanes) {
    const V s = hn::LoadU(d, points.sine + i);
    const V c = hn::LoadU(d, points.cosine + i);
    const V chip = hn::MulAdd(
        hn::Set(d, q.y), c, hn::MulAdd(hn::Set(d, q.x), s, hn::LoadU(d, constant + i)));
    const auto cuts = hn::Gt(chip, hn::Set(d, chip::h_threshold));
    const V h = hn::Max(chip, hn::Set(d, chip::h_threshold));
    const V width = hn::IfThenElseZero(cuts, hn::LoadU(d, points.width + i));
    const V edge = hn::IfThenElseZero(cuts, hn::LoadU(d, points.edge + i));
    const auto [f, slope] = of_law<directions>(d, law, h, width, edge);
    sum[0] = hn::NegMulAdd(f[0], c, hn::NegMulAdd(f[1], s, sum[0]));
    sum[1] = hn::MulAdd(f[0], s, hn::NegMulAdd(f[1], c, sum[1]));
    const V x = hn::Neg(hn::MulAdd(slope[0], c, hn::Mul(slope[1], s)));
    const V y = hn::NegMulAdd(slope[1], c, hn::Mul(slope[0], s));
    sum[3] = hn::MulAdd(x, s, sum[3]);
    sum[4] = hn::MulAdd(x, c, sum[4]);
    sum[5] = hn::MulAdd(y, s, sum[5]);
    sum[6] = hn::MulAdd(y, c, sum[6]);
    if (directions == 3) {
      sum[2] = hn::Sub(sum[2], f[2]);
      sum[7] = hn::NegMulAdd(slope[2], s, sum[7]);
      sum[8] = hn::NegMulAdd(slope[2], c, sum[8]);
    }
  }
  for (std::size_t k = 0; k < 9; ++k) {
    const bool axial = k == 2 || k > 6;
    if (directions == 3 || !axial) total[k] += hn::GetLane(hn::SumOfLanes(d, sum[k]));
  }
  return i;
}

template <std::size_t directions>
HWY_INLINE void add_all(const Cutting& cut, ForceSums& total) {
  std::size_t i = add_points<directions>(hn::CappedTag<double, 8>(), 0, cut, total);
  i = add_points<directions>(hn::CappedTag<double, 4>(), i, cut, total);
  add_points<directions>(hn::CappedTag<double, 1>(), i, cut, total);
}

// Highway's table takes no noexcept functions.
void force_sums(const PointsInCut& points, const double* constant, const Displaced& q,
                const force::Terms& law, ForceSums& total) {
  const Cutting cut{points, constant, q, law};
  if (law.K[2] != 0 || law.K_e[2] != 0) {
    add_all<3>(cut, total);
  } else {
    add_all<2>(cut, total);
  }
}

template <class D>
HWY_INLINE std::size_t least_chips(D d, std::size_t i, const Surfaces& surfaces,
                                   double* least) {
  const auto& [points, above, marks] = surfaces;
  using V = hn::Vec<D>;
  const std::size_t lanes = hn::Lanes(d);
  for (; i + lanes <= points.count; i += lanes) {
    const V s = hn::LoadU(d, points.sine + i);
    const V c = hn::LoadU(d, points.cosine + i);
    V lowest = hn::LoadU(d, above + i);  // the stock
    const double* of_mark = above + i;
    for (const Displaced& mark : marks) {
      of_mark += points.count;
      const V h =
          hn::NegMulAdd(hn::Set(d, mark.y), c,
                        hn::NegMulAdd(hn::Set(d, mark.x), s, hn::LoadU(d, of_mark)));
      lowest = hn::Min(lowest, h);  // T-1
    }
    hn::StoreU(lowest, d, least + i);
  }
  return i;
}

void all_least_chips(const PointsInCut& points, const double* above,
                     std::span<const Displaced> marks, double* least) {
  const Surfaces surfaces{points, above, marks};
  std::size_t i = least_chips(hn::CappedTag<double, 8>(), 0, surfaces, least);
  i = least_chips(hn::CappedTag<double, 4>(), i, surfaces, least);
  least_chips(hn::CappedTag<double, 1>(), i, surfaces, least);
}

}  // namespace HWY_NAMESPACE
}  // namespace trochoid::dynamics
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace trochoid::dynamics {

HWY_EXPORT(force_sums);
HWY_EXPORT(all_least_chips);

void chips_over_marks(const PointsInCut& points, const double* above,
                      std::span<const Displaced> marks, double* least) noexcept {
  HWY_DYNAMIC_DISPATCH(all_least_chips)(points, above, marks, least);
}

ForceSums force_of_points(const PointsInCut& points, const double* constant,
                          const Displaced& q, const force::Terms& law) noexcept {
  ForceSums sums{};
  HWY_DYNAMIC_DISPATCH(force_sums)(points, constant, q, law, sums);
  return sums;
}

}  // namespace trochoid::dynamics
#endif
