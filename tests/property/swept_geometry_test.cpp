// The trochoidal chip against swept geometry: the tips of all teeth are stepped along
// their true paths over the turns before, and what they leave on a ray is found by
// looking. No root equation, no formula for the mark, no code of the library.
#include <trochoid/chip/chip.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>
#include <random>
#include <variant>
#include <vector>

namespace {

using Real = long double;
constexpr Real pi = std::numbers::pi_v<Real>;
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double tolerance = 1e-15;  // [m]: 1e-12 mm

struct Point {
  Real x = 0;
  Real y = 0;
};

/// All teeth at one height, as the eye sees them.
struct Teeth {
  Real per_angle = 0;        ///< feed per radian
  std::vector<Real> radius;  ///< from the axis
  std::vector<Real> behind;  ///< angle of the tooth behind the spindle angle
};

Point axis(const Teeth& t, Real tau) {
  return {t.per_angle * tau, 0};
}

Point tip(const Teeth& t, std::size_t k, Real tau) {
  const Real angle = tau - t.behind[k];
  return {t.per_angle * tau + t.radius[k] * std::sin(angle),
          t.radius[k] * std::cos(angle)};
}

/// A ray from where the axis stands at tau.
struct Ray {
  Point origin;
  Point along;
  [[nodiscard]] Real beside(Point p) const {
    return (p.x - origin.x) * along.y - (p.y - origin.y) * along.x;
  }
  [[nodiscard]] Real ahead(Point p) const {
    return (p.x - origin.x) * along.x + (p.y - origin.y) * along.y;
  }
};

Ray ray_of(const Teeth& t, std::size_t j, Real tau) {
  const Real angle = tau - t.behind[j];
  return {axis(t, tau), {std::sin(angle), std::cos(angle)}};
}

/// Farthest place where the path of tooth k crossed the ray between two angles; 0:
/// none.
Real farthest_crossing(const Teeth& t, const Ray& ray, std::size_t k, Real from,
                       Real to) {
  const int steps = static_cast<int>(std::ceil((to - from) * 100));
  const Real step = (to - from) / steps;
  Real farthest = 0;
  Real before = ray.beside(tip(t, k, from));
  for (int i = 1; i <= steps; ++i) {
    const Real now = ray.beside(tip(t, k, from + step * i));
    if ((before < 0) != (now < 0)) {
      Real a = from + step * (i - 1);
      Real b = from + step * i;
      for (int halving = 0; halving < 60; ++halving) {
        const Real middle = (a + b) / 2;
        ((ray.beside(tip(t, k, middle)) < 0) == (before < 0) ? a : b) = middle;
      }
      farthest = std::max(farthest, ray.ahead(tip(t, k, (a + b) / 2)));
    }
    before = now;
  }
  return farthest;
}

/// Where the material on the ray of tooth j begins, after that many turns.
Real material_from(const Teeth& t, std::size_t j, Real tau, int turns) {
  const Ray ray = ray_of(t, j, tau);
  Real farthest = 0;
  for (std::size_t k = 0; k < t.radius.size(); ++k) {
    const Real until = k == j ? tau - Real(0.3) : tau;  // not the tooth itself, now
    farthest =
        std::max(farthest, farthest_crossing(t, ray, k, tau - 2 * pi * turns, until));
  }
  return farthest;
}

/// Has any tooth passed over this point? Compares directions from the moving axis.
bool gone(const Teeth& t, std::size_t j, Real tau, Point p, int turns) {
  for (std::size_t k = 0; k < t.radius.size(); ++k) {
    const Real until = k == j ? tau - Real(0.3) : tau;
    Real before = 0;
    constexpr Real step = 0.0005;
    const Real start = tau - 2 * pi * turns;
    const int steps = static_cast<int>((until - start) / step);
    for (int i = 0; i <= steps; ++i) {
      const Real now = start + step * i;
      const Point c = axis(t, now);
      const Real angle = now - t.behind[k];
      const Real dx = p.x - c.x;
      const Real dy = p.y - c.y;
      const Real beside = dx * std::cos(angle) - dy * std::sin(angle);
      const bool facing = dx * std::sin(angle) + dy * std::cos(angle) > 0;
      if (facing && before > 0 && beside <= 0 && std::hypot(dx, dy) <= t.radius[k]) {
        return true;
      }
      before = facing ? beside : 0;
    }
  }
  return false;
}

struct Example {
  trochoid::geometry::Cutter cutter;
  trochoid::geometry::Cut cut;
  std::vector<trochoid::geometry::EdgePosition> positions;
  double r = 0.0;
  Teeth teeth;
  std::vector<double> psi;
};

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double between(double a, double b) {
    return a + (b - a) * static_cast<double>(engine_() >> 11) * 0x1p-53;
  }

 private:
  std::mt19937_64 engine_;
};

trochoid::geometry::Engagement random_engagement(Random& random, double D) {
  const double a_e = random.between(0.2, 0.95) * D;
  switch (static_cast<int>(random.between(0, 4))) {
    case 0:
      return trochoid::geometry::Slot{};
    case 1:
      return trochoid::geometry::UpMilling{a_e};
    case 2:
      return trochoid::geometry::DownMilling{a_e};
    default:
      return trochoid::geometry::Band{-random.between(0.1, 0.45) * D,
                                      random.between(0.1, 0.45) * D};
  }
}

Example random_example(Random& random) {
  Example e;
  const int N = 1 + static_cast<int>(random.between(0, 6));
  const double D = random.between(4e-3, 20e-3);
  e.r = D / 2;
  e.cutter.profile.D = D;
  e.cutter.profile.Rr = D / 2;
  e.cutter.lag_diameter = D;
  double sum = 0.0;
  for (int k = 0; k < N; ++k) {
    e.cutter.pitch.push_back(random.between(0.7, 1.3));
    sum += e.cutter.pitch.back();
  }
  double psi = 0.0;
  for (double& pitch : e.cutter.pitch) {
    pitch *= 2 * std::numbers::pi / sum;
    e.psi.push_back(psi);
    psi += pitch;
  }
  e.cut.engagement = random_engagement(random, D);
  e.cut.a_p = 1e-3;
  e.cut.f_z = random.between(0.005, 0.06) * e.r;
  const double runout = random.between(0.0, 1.0) * e.cut.f_z;
  const double rho = random.between(0.0, 1.0) * runout;
  const double lambda = random.between(0.0, 6.28);
  e.teeth.per_angle = Real(e.cut.f_z) * N / (2 * pi);
  for (const double psi_k : e.psi) {
    const double r_k = e.r + random.between(-0.5, 0.5) * runout;
    // The tooth and the eccentricity as vectors, angles counted against the rotation.
    const Point from_axis{r_k * std::cos(psi_k) + rho * std::cos(lambda),
                          r_k * std::sin(psi_k) + rho * std::sin(lambda)};
    const double R = static_cast<double>(std::hypot(from_axis.x, from_axis.y));
    const double at = static_cast<double>(std::atan2(from_axis.y, from_axis.x));
    const double epsilon = std::remainder(psi_k - at, 2 * std::numbers::pi);
    e.positions.push_back({R, epsilon});
    e.teeth.radius.push_back(R);
    e.teeth.behind.push_back(Real(psi_k) - epsilon);
  }
  return e;
}

/// Length of [from, to] on the ray whose y lies in the stock.
Real in_stock(const Ray& ray, Real from, Real to,
              const trochoid::geometry::Engagement& engagement, double D) {
  double lo = -infinity;
  double hi = infinity;
  if (const auto* up = std::get_if<trochoid::geometry::UpMilling>(&engagement)) {
    lo = D / 2 - up->a_e;
  } else if (const auto* down =
                 std::get_if<trochoid::geometry::DownMilling>(&engagement)) {
    hi = -(D / 2 - down->a_e);
  } else if (const auto* band = std::get_if<trochoid::geometry::Band>(&engagement)) {
    lo = band->y_lo;
    hi = band->y_hi;
  }
  const Real c = ray.along.y;
  const Real a = c > 0 ? lo / c : hi / c;
  const Real b = c > 0 ? hi / c : lo / c;
  return std::max(Real(0), std::min(to, b) - std::max(from, a));
}

TEST(SweptGeometry, TheChipIsWhatTheTeethBeforeHaveLeft) {  // [C-5] [C-6] [C-7]
  Random random(20090145);
  Real worst = 0;
  int in_cut = 0;
  for (int i = 0; i < 400; ++i) {
    const Example e = random_example(random);
    const auto passage = trochoid::chip::passage(e.cutter, e.cut, {});
    const trochoid::chip::Slice slice{e.r, e.positions};
    for (int sample = 0; sample < 6; ++sample) {
      const auto j = static_cast<std::size_t>(
          random.between(0, static_cast<double>(e.psi.size())));
      // Every other sample near entry or exit, where the mark changes hands.
      const double edge = sample % 4 == 0 ? 0.0 : std::numbers::pi;
      const double theta = sample % 2 == 0 ? edge + random.between(-0.2, 0.2)
                                           : random.between(-0.2, 3.4);
      const Real tau = Real(theta) + e.psi[j];
      const Ray ray = ray_of(e.teeth, j, tau);
      const Real inner = material_from(e.teeth, j, tau, 3);
      const Real h = in_stock(ray, inner, e.teeth.radius[j], e.cut.engagement, 2 * e.r);
      const auto chip =
          trochoid::chip::chip_at(passage, slice, static_cast<int>(j), theta);
      worst = std::max(worst, std::abs(Real(chip.h) - h));
      in_cut += h > 0 ? 1 : 0;
      ASSERT_NEAR(chip.h, static_cast<double>(h), tolerance)
          << "example " << i << ", " << e.psi.size() << " teeth, tooth " << j + 1
          << ", theta " << theta << " rad";
    }
  }
  EXPECT_GT(in_cut, 600);  // air would agree with anything
  std::printf("worst difference %.2e mm over 2400 rays, %d of them in cut\n",
              static_cast<double>(worst * 1000), in_cut);
}

TEST(SweptGeometry, PointsInsideTheMarkAreGoneAndPointsOutsideAreLeft) {  // [C-7]
  Random random(7);
  for (int i = 0; i < 12; ++i) {
    Example e = random_example(random);
    e.cut.engagement = trochoid::geometry::Slot{};
    const auto passage = trochoid::chip::passage(e.cutter, e.cut, {});
    const trochoid::chip::Slice slice{e.r, e.positions};
    const double theta = random.between(0.3, 2.8);
    const Real tau = Real(theta);
    const Ray ray = ray_of(e.teeth, 0, tau);
    const auto chip = trochoid::chip::chip_at(passage, slice, 0, theta);
    const double L = e.positions[0].R - chip.h;
    for (const double l : {0.3 * e.r, 0.8 * e.r, L - 5e-7, L + 5e-7}) {
      if (l > e.positions[0].R) {
        continue;  // an idle tooth has no material to leave
      }
      const Point p{ray.origin.x + l * ray.along.x, ray.origin.y + l * ray.along.y};
      EXPECT_EQ(gone(e.teeth, 0, tau, p, 3), l < L) << "example " << i << ", l " << l;
    }
  }
}

}  // namespace
