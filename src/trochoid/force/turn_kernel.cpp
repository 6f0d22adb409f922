#include <trochoid/force/turn_kernel.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <numbers>
#include <span>

// Highway compiles this file once for each kind of vectors, and picks one when it runs.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "trochoid/force/turn_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
// After them, and once for each kind.
#include <hwy/contrib/math/math-inl.h>

HWY_BEFORE_NAMESPACE();
namespace trochoid::force {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using Tag = hn::ScalableTag<double>;
using Vector = hn::Vec<Tag>;

constexpr std::size_t chunk = 512;
constexpr std::size_t room = 16;  // beyond a chunk: blocks overrun
constexpr Tag tag;

/// Angles in [0, 2 pi) with their cosines and sines.
struct Angles {
  HWY_ALIGN std::array<double, chunk + room> phi;
  HWY_ALIGN std::array<double, chunk + room> cosine;
  HWY_ALIGN std::array<double, chunk + room> sine;
};

/// A block of the three functions.
struct Block {
  Vector x;
  Vector y;
  Vector z;
};

void prepare(std::span<const double> phi, Angles& angles) noexcept {
  constexpr double turn = 2 * std::numbers::pi;
  std::copy(phi.begin(), phi.end(), angles.phi.begin());
  std::fill_n(angles.phi.begin() + static_cast<std::ptrdiff_t>(phi.size()), room, 0.0);
  for (std::size_t i = 0; i < phi.size(); i += hn::Lanes(tag)) {
    const Vector given = hn::LoadU(tag, &angles.phi[i]);
    const Vector turns = hn::Floor(hn::Mul(given, hn::Set(tag, 1 / turn)));
    const Vector u = hn::Sub(given, hn::Mul(turns, hn::Set(tag, turn)));
    hn::StoreU(u, tag, &angles.phi[i]);
    hn::StoreU(hn::Cos(tag, u), tag, &angles.cosine[i]);
    hn::StoreU(hn::Sin(tag, u), tag, &angles.sine[i]);
  }
}

/// sum += factors value
HWY_INLINE void add(const Triple& factors, Vector value, Block& sum) noexcept {
  sum.x = hn::MulAdd(hn::Set(tag, factors[0]), value, sum.x);
  sum.y = hn::MulAdd(hn::Set(tag, factors[1]), value, sum.y);
  sum.z = hn::MulAdd(hn::Set(tag, factors[2]), value, sum.z);
}

HWY_INLINE Block block_of(const Triple* terms, int highest, const Angles& angles,
                          std::size_t i) noexcept {
  Vector cosine = hn::LoadU(tag, &angles.cosine[i]);
  Vector sine = hn::LoadU(tag, &angles.sine[i]);
  Block sum{hn::Set(tag, terms[0][0]), hn::Set(tag, terms[0][1]),
            hn::Set(tag, terms[0][2])};
  add(terms[1], hn::LoadU(tag, &angles.phi[i]), sum);
  add(terms[2], cosine, sum);
  add(terms[3], sine, sum);
  // cos((k + 1) x) = 2 cos(x) cos(k x) - cos((k - 1) x); the same for sines
  const Vector twice = hn::Add(cosine, cosine);
  Vector cosine_before = hn::Set(tag, 1.0);
  Vector sine_before = hn::Zero(tag);
  for (int k = 2; k <= highest; ++k) {
    const Vector next_cosine = hn::MulSub(twice, cosine, cosine_before);
    const Vector next_sine = hn::MulSub(twice, sine, sine_before);
    cosine_before = cosine;
    sine_before = sine;
    cosine = next_cosine;
    sine = next_sine;
    add(terms[2 * k], cosine, sum);
    add(terms[2 * k + 1], sine, sum);
  }
  return sum;
}

HWY_INLINE void add_panel(const TurnPanel& panel, const Angles& angles, std::size_t i,
                          Block& sum) noexcept {
  const Vector phi = hn::LoadU(tag, &angles.phi[i]);
  const Vector one = hn::Set(tag, 1.0);
  const Vector past = hn::Sub(phi, hn::Set(tag, panel.from));
  const Vector unbound = hn::MulSub(past, hn::Set(tag, panel.per_half), one);
  const Vector t = hn::Min(hn::Max(unbound, hn::Neg(one)), one);
  Block value{hn::Zero(tag), hn::Zero(tag), hn::Zero(tag)};
  for (std::size_t k = panel.powers.size(); k-- > 0;) {
    value.x = hn::MulAdd(value.x, t, hn::Set(tag, panel.powers[k][0]));
    value.y = hn::MulAdd(value.y, t, hn::Set(tag, panel.powers[k][1]));
    value.z = hn::MulAdd(value.z, t, hn::Set(tag, panel.powers[k][2]));
  }
  sum.x = hn::Add(sum.x, value.x);
  sum.y = hn::Add(sum.y, value.y);
  sum.z = hn::Add(sum.z, value.z);
}

HWY_INLINE void store(const Block& block, std::span<double> out) noexcept {
  const std::size_t count = 3 * hn::Lanes(tag);
  if (out.size() >= count) {
    hn::StoreInterleaved3(block.x, block.y, block.z, tag, out.data());
    return;
  }
  HWY_ALIGN std::array<double, 3 * room> all;
  hn::StoreInterleaved3(block.x, block.y, block.z, tag, all.data());
  std::copy_n(all.begin(), out.size(), out.begin());
}

/// Angles from .. to, all in one segment. What is written beyond is wrong, and written
/// again with the segment after.
void evaluate_segment(const TurnPolynomial& turn, std::size_t segment,
                      const Angles& angles, std::array<std::size_t, 2> range,
                      std::span<double> out) noexcept {
  const Triple* const terms = &turn.terms[segment * turn.terms_of_segment()];
  const auto panels =
      std::span(turn.panel_places)
          .first(static_cast<std::size_t>(turn.first_panel[segment + 1]))
          .subspan(static_cast<std::size_t>(turn.first_panel[segment]));
  for (std::size_t i = range[0]; i < range[1]; i += hn::Lanes(tag)) {
    Block block = block_of(terms, turn.highest, angles, i);
    for (const int place : panels) {
      add_panel(turn.panels[static_cast<std::size_t>(place)], angles, i, block);
    }
    store(block, out.subspan(3 * i));
  }
}

// Highway's table takes no noexcept functions.
void evaluate_all(const TurnPolynomial& turn, std::span<const double> phi,
                  std::span<double> out) {
  Angles angles;
  std::size_t segment = 0;
  while (!phi.empty()) {
    const std::size_t count = std::min(phi.size(), chunk);
    prepare(phi.first(count), angles);
    for (std::size_t i = 0; i < count;) {
      const double u = angles.phi[i];
      if (!(u < turn.ends[segment]) || (segment > 0 && u < turn.ends[segment - 1])) {
        const auto at = std::upper_bound(turn.ends.begin(), turn.ends.end() - 1, u);
        segment = static_cast<std::size_t>(at - turn.ends.begin());
      }
      const double from = segment == 0 ? 0.0 : turn.ends[segment - 1];
      const double to = turn.ends[segment];
      std::size_t end = i + 1;
      while (end < count && angles.phi[end] >= from && angles.phi[end] < to) {
        ++end;
      }
      evaluate_segment(turn, segment, angles, {i, end}, out);
      i = end;
    }
    phi = phi.subspan(count);
    out = out.subspan(3 * count);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace trochoid::force
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace trochoid::force {

HWY_EXPORT(evaluate_all);

void evaluate(const TurnPolynomial& turn, std::span<const double> phi,
              std::span<double> out) noexcept {
  HWY_DYNAMIC_DISPATCH(evaluate_all)(turn, phi, out);
}

}  // namespace trochoid::force
#endif
