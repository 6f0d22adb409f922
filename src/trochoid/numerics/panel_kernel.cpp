#include <trochoid/numerics/panels.h>

#include <algorithm>

// Highway compiles this file once for each kind of vectors, and picks one when it runs.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "trochoid/numerics/panel_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace trochoid::numerics {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using Tag = hn::CappedTag<double, 8>;
using Vector = hn::Vec<Tag>;

constexpr Tag tag;

/// Two at once: one chain of products would wait for itself.
struct Two {
  Vector a;
  Vector b;
};

/// @param other  column of the second, counted from the first
HWY_INLINE Two values_of_two(const Polynomials& of, std::size_t q, std::size_t other,
                             Vector t) {
  const double* const first = of.coefficients.data() + q;
  const double* c = first + (of.coefficients.size() - of.stride);
  Two out{hn::Set(tag, c[0]), hn::Set(tag, c[other])};
  while (c != first) {
    c -= of.stride;
    out.a = hn::MulAdd(out.a, t, hn::Set(tag, c[0]));
    out.b = hn::MulAdd(out.b, t, hn::Set(tag, c[other]));
  }
  return out;
}

void add_values(const Polynomials& of, std::span<const double> x, double factor,
                const PlacesOut& out) {
  const std::size_t rows = (out.values.size() + out.pitch - 1) / out.pitch;
  const std::size_t lanes = hn::Lanes(tag);
  const Vector by = hn::Set(tag, factor);
  for (std::size_t i = 0; i < x.size(); i += lanes) {
    const auto there = hn::FirstN(tag, std::min(lanes, x.size() - i));
    const Vector t =
        hn::Mul(hn::Sub(hn::MaskedLoad(there, tag, &x[i]), hn::Set(tag, of.middle)),
                hn::Set(tag, of.per_half));
    const auto add = [&](Vector value, double* at) HWY_ATTR {
      const Vector sum = hn::MulAdd(by, value, hn::MaskedLoad(there, tag, at));
      hn::BlendedStore(sum, there, tag, at);
    };
    for (std::size_t q = 0; q < rows; q += 2) {
      const std::size_t other = q + 1 < rows ? 1 : 0;
      const Two values = values_of_two(of, q, other, t);
      add(values.a, &out.values[q * out.pitch + i]);
      if (other == 1) add(values.b, &out.values[(q + 1) * out.pitch + i]);
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace trochoid::numerics
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace trochoid::numerics {

HWY_EXPORT(add_values);

void add_polynomials(const Polynomials& of, std::span<const double> x, double factor,
                     const PlacesOut& out) noexcept {
  HWY_DYNAMIC_DISPATCH(add_values)(of, x, factor, out);
}

}  // namespace trochoid::numerics
#endif
