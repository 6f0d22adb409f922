#include <trochoid/numerics/correlation.h>

#include <cstddef>

// Highway compiles this file once for each kind of vectors, and picks one when it runs.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "trochoid/numerics/correlation.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace trochoid::numerics {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using Tag = hn::CappedTag<double, 8>;
using Vector = hn::Vec<Tag>;

constexpr Tag tag;

double at_shift(std::span<const double> a, const double* b) noexcept {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    sum += a[i] * b[i];
  }
  return sum;
}

/// Four vectors of shifts at once: their sums stay in registers.
HWY_INLINE void at_shifts(std::span<const double> a, const double* b,
                          double* out) noexcept {
  const std::size_t lanes = hn::Lanes(tag);
  Vector s0 = hn::Zero(tag);
  Vector s1 = s0;
  Vector s2 = s0;
  Vector s3 = s0;
  for (const double value : a) {
    const Vector factor = hn::Set(tag, value);
    s0 = hn::MulAdd(factor, hn::LoadU(tag, b), s0);
    s1 = hn::MulAdd(factor, hn::LoadU(tag, b + lanes), s1);
    s2 = hn::MulAdd(factor, hn::LoadU(tag, b + 2 * lanes), s2);
    s3 = hn::MulAdd(factor, hn::LoadU(tag, b + 3 * lanes), s3);
    ++b;
  }
  hn::StoreU(s0, tag, out);
  hn::StoreU(s1, tag, out + lanes);
  hn::StoreU(s2, tag, out + 2 * lanes);
  hn::StoreU(s3, tag, out + 3 * lanes);
}

// Highway's table takes no noexcept functions.
void correlate_all(std::span<const double> a, std::span<const double> twice,
                   std::span<double> out) {
  const std::size_t block = 4 * hn::Lanes(tag);
  std::size_t s = 0;
  for (; s + block <= out.size(); s += block) {
    at_shifts(a, &twice[s], &out[s]);
  }
  if (s < out.size() && out.size() >= block) {
    s = out.size() - block;  // some are found once more, and are the same
    at_shifts(a, &twice[s], &out[s]);
    return;
  }
  for (; s < out.size(); ++s) {
    out[s] = at_shift(a, &twice[s]);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace trochoid::numerics
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace trochoid::numerics {

HWY_EXPORT(correlate_all);

void correlate(std::span<const double> a, std::span<const double> twice,
               std::span<double> out) noexcept {
  HWY_DYNAMIC_DISPATCH(correlate_all)(a, twice, out);
}

}  // namespace trochoid::numerics
#endif
