#include <trochoid/force/turn_kernel.h>

#include <algorithm>
#include <array>
#include <cmath>
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
using Tag = hn::CappedTag<double, 8>;
using Vector = hn::Vec<Tag>;

constexpr std::size_t chunk = 512;
constexpr std::size_t room = 16;  // beyond a chunk: blocks overrun
constexpr Tag tag;

/// Angles in [0, 2 pi) with their cosines and sines.
struct Angles {
  std::size_t count = 0;
  double step = 0.0;  ///< from one to the next, where it is always the same; else 0
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

/// The step of angles that are equally spaced to rounding; 0 where they are not.
double even_step(std::span<const double> phi) noexcept {
  if (phi.size() < 3) {
    return 0.0;
  }
  const double step = (phi.back() - phi.front()) / static_cast<double>(phi.size() - 1);
  const double rounding = 1e-15 * std::max(std::abs(phi.front()), std::abs(phi.back()));
  const std::size_t lanes = hn::Lanes(tag);
  const Vector steps = hn::Set(tag, step);
  Vector place = hn::Iota(tag, 0);
  Vector worst = hn::Zero(tag);
  std::size_t i = 0;
  for (; i + lanes <= phi.size(); i += lanes) {
    const Vector even = hn::MulAdd(place, steps, hn::Set(tag, phi.front()));
    worst = hn::Max(worst, hn::Abs(hn::Sub(hn::LoadU(tag, &phi[i]), even)));
    place = hn::Add(place, hn::Set(tag, static_cast<double>(lanes)));
  }
  double largest = hn::GetLane(hn::MaxOfLanes(tag, worst));
  for (; i < phi.size(); ++i) {
    const double even = phi.front() + static_cast<double>(i) * step;
    largest = std::max(largest, std::abs(phi[i] - even));
  }
  return largest <= rounding ? step : 0.0;
}

void find_waves(Angles& angles) noexcept {
  const std::size_t lanes = hn::Lanes(tag);
  for (std::size_t i = 0; i < angles.count; i += lanes) {
    const Vector u = hn::LoadU(tag, &angles.phi[i]);
    hn::StoreU(hn::Cos(tag, u), tag, &angles.cosine[i]);
    hn::StoreU(hn::Sin(tag, u), tag, &angles.sine[i]);
  }
}

/// From the first block on, by turning.
void find_even_waves(Angles& angles) noexcept {
  const std::size_t lanes = hn::Lanes(tag);
  const Vector u = hn::LoadU(tag, angles.phi.data());
  Vector c = hn::Cos(tag, u);
  Vector s = hn::Sin(tag, u);
  const double turned = angles.step * static_cast<double>(lanes);
  const Vector cosine = hn::Set(tag, std::cos(turned));
  const Vector sine = hn::Set(tag, std::sin(turned));
  for (std::size_t i = 0; i < angles.count; i += lanes) {
    hn::StoreU(c, tag, &angles.cosine[i]);
    hn::StoreU(s, tag, &angles.sine[i]);
    const Vector next = hn::NegMulAdd(s, sine, hn::Mul(c, cosine));
    s = hn::MulAdd(s, cosine, hn::Mul(c, sine));
    c = next;
  }
}

void prepare(std::span<const double> phi, Angles& angles) noexcept {
  constexpr double turn = 2 * std::numbers::pi;
  angles.count = phi.size();
  angles.step = even_step(phi);
  std::copy(phi.begin(), phi.end(), angles.phi.begin());
  std::fill_n(angles.phi.begin() + static_cast<std::ptrdiff_t>(phi.size()), room, 0.0);
  for (std::size_t i = 0; i < phi.size(); i += hn::Lanes(tag)) {
    const Vector given = hn::LoadU(tag, &angles.phi[i]);
    const Vector turns = hn::Floor(hn::Mul(given, hn::Set(tag, 1 / turn)));
    hn::StoreU(hn::NegMulAdd(turns, hn::Set(tag, turn), given), tag, &angles.phi[i]);
  }
  if (angles.step != 0 && phi.size() >= hn::Lanes(tag)) {
    find_even_waves(angles);
  } else {
    find_waves(angles);
  }
}

/// sum += factors value
HWY_INLINE void add(const Triple& factors, Vector value, Block& sum) noexcept {
  sum.x = hn::MulAdd(hn::Set(tag, factors[0]), value, sum.x);
  sum.y = hn::MulAdd(hn::Set(tag, factors[1]), value, sum.y);
  sum.z = hn::MulAdd(hn::Set(tag, factors[2]), value, sum.z);
}

/// cos((k + 1) x) = 2 cos(x) cos(k x) - cos((k - 1) x); the same for sines.
HWY_INLINE Vector after(Vector now, Vector before, Vector twice) noexcept {
  return hn::MulSub(twice, now, before);
}

HWY_INLINE Block block_of(const Triple* terms, int highest, const Angles& angles,
                          std::size_t i) noexcept {
  Vector cosine_odd = hn::LoadU(tag, &angles.cosine[i]);
  Vector sine_odd = hn::LoadU(tag, &angles.sine[i]);
  Vector cosine_even = hn::Set(tag, 1.0);
  Vector sine_even = hn::Zero(tag);
  const Vector twice = hn::Add(cosine_odd, cosine_odd);
  Block sum{hn::Set(tag, terms[0][0]), hn::Set(tag, terms[0][1]),
            hn::Set(tag, terms[0][2])};
  add(terms[1], hn::LoadU(tag, &angles.phi[i]), sum);
  add(terms[2], cosine_odd, sum);
  add(terms[3], sine_odd, sum);
  // Two harmonics at a time: the new ones take the place of the ones before.
  const Triple* term = terms + 4;
  for (int k = 2; k <= highest; k += 2, term += 4) {
    cosine_even = after(cosine_odd, cosine_even, twice);
    sine_even = after(sine_odd, sine_even, twice);
    add(term[0], cosine_even, sum);
    add(term[1], sine_even, sum);
    if (k == highest) {
      break;
    }
    cosine_odd = after(cosine_even, cosine_odd, twice);
    sine_odd = after(sine_even, sine_odd, twice);
    add(term[2], cosine_odd, sum);
    add(term[3], sine_odd, sum);
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

/// The segment of an angle; the one of the angle before is a good guess.
std::size_t segment_of(const TurnPolynomial& turn, double phi,
                       std::size_t guess) noexcept {
  for (const std::size_t i : {guess, guess + 1}) {
    if (i < turn.ends.size() && phi < turn.ends[i] &&
        (i == 0 || phi >= turn.ends[i - 1])) {
      return i;
    }
  }
  const auto at = std::upper_bound(turn.ends.begin(), turn.ends.end() - 1, phi);
  return static_cast<std::size_t>(at - turn.ends.begin());
}

/// The first angle after i that is not between these.
std::size_t end_of_stretch(const Angles& angles, std::size_t i, double from,
                           double to) noexcept {
  const auto inside = [&](std::size_t k) {
    return angles.phi[k] >= from && angles.phi[k] < to;
  };
  std::size_t end = i + 1;
  const double left = (to - angles.phi[i]) / angles.step;
  if (angles.step > 0 && left > 1) {
    const double most = static_cast<double>(angles.count - i);
    end = i + static_cast<std::size_t>(std::min(left, most));
    while (end > i + 1 && !inside(end - 1)) {
      --end;
    }
  }
  while (end < angles.count && inside(end)) {
    ++end;
  }
  return end;
}

// Highway's table takes no noexcept functions.
void evaluate_all(const TurnPolynomial& turn, std::span<const double> phi,
                  std::span<double> out) {
  Angles angles;
  std::size_t segment = 0;
  while (!phi.empty()) {
    prepare(phi.first(std::min(phi.size(), chunk)), angles);
    for (std::size_t i = 0; i < angles.count;) {
      segment = segment_of(turn, angles.phi[i], segment);
      const double from = segment == 0 ? 0.0 : turn.ends[segment - 1];
      const std::size_t end = end_of_stretch(angles, i, from, turn.ends[segment]);
      evaluate_segment(turn, segment, angles, {i, end}, out);
      i = end;
    }
    phi = phi.subspan(angles.count);
    out = out.subspan(3 * angles.count);
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
