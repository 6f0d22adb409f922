#include <trochoid/chip/chip.h>

#include <trochoid/base/units.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <variant>

namespace trochoid::chip {
namespace {

/// @brief Distance from the axis to the surface that an earlier tooth left on a ray.
///
/// @eq C-5 R_k sin(delta) + b (theta_p + delta) = 0, b = f cos(theta) / 2 pi
/// @eq C-6 L_k = R_k cos(delta) - f (theta_p + delta) sin(theta) / 2 pi
/// @src [riviere2009] eq. 10 with X = theta_p + delta, and eq. 13
/// @param R_k      radius of that tooth [m], positive
/// @param theta_p  how far that tooth is ahead [rad], in (0, 2 pi]
/// @param feed     f / 2 pi [m/rad]
/// @return L_k [m]; minus infinity where that tooth left no mark on the ray
double surface_left(double R_k, double theta_p, double feed, double sin_theta,
                    double cos_theta) noexcept;

constexpr double nothing = -std::numeric_limits<double>::infinity();

/// sin(x) to rounding for |x| <= 0.2, where libm's range reduction would cost the most.
double small_sine(double x) noexcept {
  const double u = x * x;
  return x * (1 - u / 6 * (1 - u / 20 * (1 - u / 42 * (1 - u / 72 * (1 - u / 110)))));
}

/// cos(x) as well.
double small_cosine(double x) noexcept {
  const double u = x * x;
  return 1 - u / 2 * (1 - u / 12 * (1 - u / 30 * (1 - u / 56 * (1 - u / 90))));
}

/// @param half_sine  sin(delta / 2)
double length_on_ray(double R_k, double turned, double feed, double sin_theta,
                     double half_sine) noexcept {
  return R_k - 2 * R_k * half_sine * half_sine - feed * turned * sin_theta;  // C-6
}

/// Root of sin(x) + A (theta_p + x) in [lo, hi], where the function rises.
double bracketed_root(double A, double theta_p, double lo, double hi) noexcept {
  // Where the root is nearly double, no better x exists than one with g at rounding.
  const double rounding = 2e-16 * (1 + std::abs(A) * theta_p);
  const double x0 = -A * theta_p / (1 + A);
  double x = -(A * theta_p - x0 * x0 * x0 / 6) / (1 + A);
  if (!(x > lo && x < hi)) {
    x = 0.5 * (lo + hi);
  }
  for (int i = 0; i < 64; ++i) {
    const double g = std::sin(x) + A * (theta_p + x);
    (g < 0 ? lo : hi) = x;
    if (std::abs(g) <= rounding) {
      break;
    }
    const double slope = std::cos(x) + A;
    const double next = x - g / slope;
    if (!(next > lo && next < hi)) {
      x = 0.5 * (lo + hi);
      continue;
    }
    const double step = next - x;
    x = next;
    if (step * step <= 1e-17 * slope) {  // what is left is its square
      break;
    }
  }
  return x;
}

double surface_left(double R_k, double theta_p, double feed, double sin_theta,
                    double cos_theta) noexcept {
  const double A = feed * cos_theta / R_k;
  if (std::abs(A) < 0.02) {
    // Third-order start, good to x^5/12; every Newton step gains s^4/8 on it.
    const double x0 = -A * theta_p / (1 + A);
    double x = -(A * theta_p - x0 * x0 * x0 / 6) / (1 + A);
    const int steps = std::abs(x) < 0.02 ? 1 : 2;
    for (int i = 0; i < steps; ++i) {
      const double s = small_sine(x);
      x -= (s + A * (theta_p + x)) / (1 - 0.5 * s * s + A);
    }
    return length_on_ray(R_k, theta_p + x, feed, sin_theta, small_sine(0.5 * x));
  }
  constexpr double right = std::numbers::pi / 2;
  if (A >= 0) {
    if (A * (theta_p - right) >= 1) {
      return nothing;
    }
    const double delta = bracketed_root(A, theta_p, -right, 0.0);
    return length_on_ray(R_k, theta_p + delta, feed, sin_theta, std::sin(0.5 * delta));
  }
  if (A <= -1) {
    return nothing;
  }
  const double top = std::acos(-A);
  if (std::sin(top) < -A * (theta_p + top)) {
    return nothing;
  }
  const double delta = bracketed_root(A, theta_p, 0.0, top);
  return length_on_ray(R_k, theta_p + delta, feed, sin_theta, std::sin(0.5 * delta));
}

/// The path over which a mark is as old as it is.
struct TightPath {
  double R_k;        ///< of the tooth that left it [m]
  double theta_p;    ///< how far it is ahead [rad]
  double feed;       ///< f / 2 pi [m/rad]
  double curvature;  ///< [1/m]
};

/// @brief As surface_left, on a circular path, without the chord that N-4 takes for its arc.
///
/// @eq N-29 R_k sin(delta) + sin(kappa s) cos(theta)/kappa + (1 - cos(kappa s)) sin(theta)/kappa
///          = 0, s = f (theta_p + delta)/2 pi;
///          L_k = R_k cos(delta) - sin(kappa s) sin(theta)/kappa
///          + (1 - cos(kappa s)) cos(theta)/kappa
/// @src derived
double surface_left_on_circle(const TightPath& path, double sin_theta,
                              double cos_theta) noexcept {
  constexpr double right = std::numbers::pi / 2;
  constexpr int most_steps = 40;
  double delta = 0.0;
  for (int i = 0; i < most_steps; ++i) {
    const double turned = path.curvature * path.feed * (path.theta_p + delta);
    const double s = std::sin(turned);
    const double c = std::cos(turned);
    const double along = s / path.curvature;
    const double aside = (1 - c) / path.curvature;
    const double g = path.R_k * std::sin(delta) + along * cos_theta + aside * sin_theta;
    const double slope =
        path.R_k * std::cos(delta) + path.feed * (c * cos_theta + s * sin_theta);
    const double step = g / slope;
    if (!(slope > 0) || !(std::abs(delta - step) < right)) return nothing;
    delta -= step;
    if (step * step <= 1e-17) {
      const double end = path.curvature * path.feed * (path.theta_p + delta);
      return path.R_k * std::cos(delta) - std::sin(end) / path.curvature * sin_theta +
             (1 - std::cos(end)) / path.curvature * cos_theta;
    }
  }
  return nothing;
}

/// Whether N-4 errs by more than a few thousandths of the feed.
bool is_tight(double curvature, double feed, double R) noexcept {
  constexpr double large_feed = 0.05;  // of a turn, in parts of R
  return std::abs(curvature) * R > 1 && unit::turn * feed > large_feed * R;
}

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Bounds of the material on a ray. Marks are numbered by how many teeth before.
struct Bounds {
  enum Outer { edge, low_outside, high_outside, window, arc_end };
  enum Inner { axis = 0, first_mark = 1, low_inside = 100, high_inside = 101 };
  int outer = edge;
  int inner = axis;

  [[nodiscard]] int code() const noexcept { return outer * 1000 + inner; }
  static Bounds of(int code) noexcept { return {code / 1000, code % 1000}; }
};

/// One tooth on its ray.
struct Ray {
  const Passage& p;
  const Slice& slice;
  int j;
  double sine;  ///< of theta, effective for the trochoidal model
  double cosine;
  double angle;  ///< that theta
};

Ray ray_at(const Passage& p, const Slice& slice, int j, double theta) noexcept {
  const bool exact = p.model.model == Model::trochoidal;
  const auto index = static_cast<std::size_t>(j);
  const double angle = theta + (exact ? slice.teeth[index].epsilon : 0.0);
  return {p, slice, j, std::sin(angle), std::cos(angle), angle};
}

const geometry::EdgePosition& position(const Ray& ray, int m) noexcept {
  const int k = (ray.j - m + ray.p.teeth) % ray.p.teeth;
  return ray.slice.teeth[static_cast<std::size_t>(k)];
}

/// The stock as the deflected cutter sees it.
geometry::Band stock(const Ray& ray) noexcept {
  return {ray.p.stock.y_lo - ray.slice.shift, ray.p.stock.y_hi - ray.slice.shift};
}

double back_angle(const Ray& ray, int m) noexcept {
  return ray.p.back[static_cast<std::size_t>(ray.j * ray.p.teeth + m - 1)];
}

/// R_j - L of undeflected paths.
double above_rigid_mark(const Ray& ray, int m) noexcept {
  const geometry::EdgePosition& own = position(ray, 0);
  const geometry::EdgePosition& other = position(ray, m);
  const double back = back_angle(ray, m);
  if (ray.p.model.model == Model::none) {
    return ray.p.feed * back * ray.sine;  // C-2
  }
  if (other.R <= 0) {
    return infinity;
  }
  switch (ray.p.model.model) {
    case Model::feed:
      return (ray.p.feed * back + own.R - other.R) * ray.sine;  // C-3
    case Model::radial:
      return ray.p.feed * back * ray.sine + own.R - other.R;  // C-4
    default: {
      // A tooth's own mark is one whole turn old; rounding must not make it new.
      double theta_p = back;
      if (m != ray.p.teeth) {
        theta_p += other.epsilon - own.epsilon;
        theta_p +=
            theta_p <= 0 ? unit::turn : (theta_p > unit::turn ? -unit::turn : 0.0);
      }
      if (is_tight(ray.p.curvature, ray.p.feed, own.R)) {
        return own.R -
               surface_left_on_circle({other.R, theta_p, ray.p.feed, ray.p.curvature},
                                      ray.sine, ray.cosine);
      }
      if (ray.p.curvature != 0) {  // N-4
        const double turned = 0.5 * ray.p.curvature * ray.p.feed * theta_p;
        const bool small = std::abs(turned) < 0.2;
        const double s = small ? small_sine(turned) : std::sin(turned);
        const double c = small ? small_cosine(turned) : std::cos(turned);
        return own.R - surface_left(other.R, theta_p, ray.p.feed,
                                    ray.sine * c - ray.cosine * s,
                                    ray.cosine * c + ray.sine * s);
      }
      return own.R - surface_left(other.R, theta_p, ray.p.feed, ray.sine, ray.cosine);
    }
  }
}

/// R_j - L for the mark of the m-th tooth before; infinite where it left none.
double above_mark(const Ray& ray, int m) noexcept {
  const double above = above_rigid_mark(ray, m);
  return ray.slice.advance.empty()
             ? above
             : above + ray.slice.advance[static_cast<std::size_t>(m - 1)];
}

double inner_radius(const Ray& ray, int inner) noexcept {
  switch (inner) {
    case Bounds::axis:
      return 0.0;
    case Bounds::low_inside:
      return stock(ray).y_lo / ray.cosine;
    case Bounds::high_inside:
      return stock(ray).y_hi / ray.cosine;
    default:
      return position(ray, 0).R - above_mark(ray, inner);
  }
}

double outer_radius(const Ray& ray, int outer) noexcept {
  switch (outer) {
    case Bounds::low_outside:
      return stock(ray).y_lo / ray.cosine;
    case Bounds::high_outside:
      return stock(ray).y_hi / ray.cosine;
    default:
      return position(ray, 0).R;
  }
}

/// How far the ray lies within one of the arcs, along the edge; negative: in none.
double inside_arcs(const Ray& ray) noexcept {
  double inside = -infinity;
  for (const geometry::EngagedArc& engaged : ray.slice.arcs) {
    const double middle = 0.5 * (engaged.arc.from + engaged.arc.to);
    const double half = 0.5 * (engaged.arc.to - engaged.arc.from);
    const double whole = half >= std::numbers::pi ? unit::turn : half;
    inside = std::max(inside,
                      whole - std::abs(std::remainder(ray.angle - middle, unit::turn)));
  }
  return inside * position(ray, 0).R;
}

/// How far the edge point lies inside the window of the simple models: the nominal one,
/// but where deflection decides the entry, that of the tooth as it is.
double inside_window(const Ray& ray) noexcept {
  const bool own = ray.slice.bent && ray.p.model.model == Model::radial;
  const double R = own ? position(ray, 0).R : ray.slice.r;
  const double y = R * ray.cosine;
  if (ray.p.by_arcs) {
    return std::min(R * ray.sine, inside_arcs(ray));
  }
  const geometry::Band band = stock(ray);
  return std::min(R * ray.sine, std::min(y - band.y_lo, band.y_hi - y));
}

struct Closest {
  double above = infinity;
  int mark = Bounds::axis;
};

/// @brief R_j - L of the tooth's own mark of a turn ago, and a little more: a mark that lies
/// deeper bounds no chip. Infinite where that mark is not looked at, or not so simple.
///
/// C-6 with theta_p = 2 pi: at most f sin(theta) for the feed, and less than R_j delta^2 for
/// the angle that it turns back.
double deepest_mark(const Ray& ray) noexcept {
  const double own = position(ray, 0).R;
  const double f = ray.p.feed * unit::turn;
  const bool plain = ray.p.model.model == Model::trochoidal && ray.p.curvature == 0 &&
                     ray.slice.advance.empty() && ray.p.marks == ray.p.teeth &&
                     ray.sine >= 0 && f < 0.1 * own;
  if (!plain) return infinity;
  const double back = f * ray.cosine / own;
  return 1.03 * f * ray.sine + own * back * back + 1e-9 * own;
}

Closest closest_mark(const Ray& ray) noexcept {
  Closest best;
  const double own = position(ray, 0).R;
  const double deepest = deepest_mark(ray);
  const auto look = [&](int m) {
    if (own - position(ray, m).R > deepest) return;  // L_k <= R_k
    const double above = above_mark(ray, m);
    if (above < best.above) {
      best = {above, m};
    }
  };
  if (!ray.slice.near.empty()) {
    std::ranges::for_each(ray.slice.near[static_cast<std::size_t>(ray.j)], look);
    return best;
  }
  for (int m = 1; m <= ray.p.marks; ++m) {
    look(m);
  }
  return best;
}

Chip simple_chip(const Ray& ray) noexcept {
  const double inside = inside_window(ray);
  if (inside <= 0) {
    return {0.0, 0.0, inside, Bounds{Bounds::window, Bounds::axis}.code(), false};
  }
  Closest best = closest_mark(ray);
  if (best.above == infinity) {  // nobody left a mark: material up to the axis
    best.above = position(ray, 0).R;
  }
  const bool in_cut = best.above > h_threshold;
  return {in_cut ? best.above : 0.0, position(ray, 0).R, best.above,
          Bounds{Bounds::edge, best.mark}.code(), in_cut};
}

Chip exact_chip(const Ray& ray) noexcept {
  const double own = position(ray, 0).R;
  if (ray.p.by_arcs) {
    const double inside = inside_arcs(ray);
    if (!(inside > 0)) {
      return {0.0, 0.0, inside, Bounds{Bounds::arc_end, Bounds::axis}.code(), false};
    }
  }
  const Closest best = closest_mark(ray);
  Bounds bounds{Bounds::edge, best.mark};
  double above = best.above;  // own minus the inner bound
  if (!(above < own)) {
    bounds.inner = Bounds::axis;
    above = own;
  }
  double below = 0.0;  // own minus the outer bound
  const double c = ray.cosine;
  const auto clip_inner = [&](double y, int which) {
    if (y * c > 0 && own - y / c < above) {
      above = own - y / c;
      bounds.inner = which;
    }
  };
  const auto clip_outer = [&](double y, int which) {
    const double outer = y * c > 0 ? y / c : 0.0;
    if (own - outer > below) {
      below = own - outer;
      bounds.outer = which;
    }
  };
  const geometry::Band band = stock(ray);
  if (std::isfinite(band.y_lo)) {
    if (c > 0) {
      clip_inner(band.y_lo, Bounds::low_inside);
    } else {
      clip_outer(band.y_lo, Bounds::low_outside);
    }
  }
  if (std::isfinite(band.y_hi)) {
    if (c < 0) {
      clip_inner(band.y_hi, Bounds::high_inside);
    } else {
      clip_outer(band.y_hi, Bounds::high_outside);
    }
  }
  const double margin = above - below;  // C-7
  const bool in_cut = margin > h_threshold;
  return {in_cut ? margin : 0.0, own - below, margin, bounds.code(), in_cut};
}

/// Sign of "there is material between these bounds", smooth through cos(theta) = 0.
double opening(const Ray& ray, const Bounds& bounds) noexcept {
  const double own = position(ray, 0).R;
  const geometry::Band band = stock(ray);
  if (bounds.outer == Bounds::window) {
    return inside_window(ray);
  }
  if (bounds.outer == Bounds::arc_end) {
    return inside_arcs(ray);
  }
  if (bounds.outer == Bounds::low_outside && band.y_lo >= 0) {
    return ray.cosine * own - band.y_lo;
  }
  if (bounds.outer == Bounds::high_outside && band.y_hi <= 0) {
    return band.y_hi - ray.cosine * own;
  }
  if (bounds.outer == Bounds::edge && bounds.inner == Bounds::low_inside) {
    return ray.cosine * own - band.y_lo;
  }
  if (bounds.outer == Bounds::edge && bounds.inner == Bounds::high_inside) {
    return band.y_hi - ray.cosine * own;
  }
  if (bounds.outer == Bounds::edge && bounds.inner != Bounds::axis) {
    return above_mark(ray, bounds.inner) - h_threshold;
  }
  return outer_radius(ray, bounds.outer) - inner_radius(ray, bounds.inner) -
         h_threshold;
}

}  // namespace

Passage passage(const geometry::Cutter& cutter, const geometry::Cut& cut,
                const ChipModel& model) {
  const int n = cutter.teeth();
  Passage p{.model = model,
            .stock = geometry::stock_band(cut.engagement, cutter.profile.D),
            .feed = n * cut.f_z / unit::turn,
            .teeth = n,
            .marks = !feels_runout(model.model) || model.lookback == Lookback::previous
                         ? 1
                         : n};
  if (const auto* arcs = std::get_if<geometry::Arcs>(&cut.engagement)) {
    p.by_arcs = true;
    p.curvature = arcs->curvature;
  }
  p.back.reserve(cutter.pitch.size() * cutter.pitch.size());
  for (int j = 0; j < n; ++j) {
    double sum = 0.0;
    for (int m = 1; m <= n; ++m) {
      sum += cutter.pitch[static_cast<std::size_t>((j - m + n) % n)];
      p.back.push_back(m == n ? unit::turn : sum);  // C-1
    }
  }
  return p;
}

int mark_of(const Chip& chip) noexcept {
  const int inner = Bounds::of(chip.bounds).inner;
  return inner < Bounds::low_inside ? inner : 0;
}

bool ends_at_edge(const Chip& chip) noexcept {
  return Bounds::of(chip.bounds).outer == Bounds::edge;
}

Chip chip_at(const Passage& passage, const Slice& slice, int tooth,
             double theta) noexcept {
  const Ray ray = ray_at(passage, slice, tooth, theta);
  if (passage.feed <= 0) {  // nothing is left for a second turn
    return {};
  }
  if (position(ray, 0).R <= 0 && feels_runout(passage.model.model)) {
    return {0.0, 0.0, position(ray, 0).R, 0, false};
  }
  return passage.model.model == Model::trochoidal ? exact_chip(ray) : simple_chip(ray);
}

double chip_over_mark(const Passage& passage, const Slice& slice, int tooth,
                      double theta, int mark) noexcept {
  return above_mark(ray_at(passage, slice, tooth, theta), mark);
}

// six parameters: where the tooth is, and the two chips compared there
double boundary(const Passage& passage, const Slice& slice, int tooth, double theta,
                const Chip& a, const Chip& b) noexcept {
  const Ray ray = ray_at(passage, slice, tooth, theta);
  if (!a.in_cut) {
    return opening(ray, Bounds::of(a.bounds));
  }
  if (!b.in_cut) {
    return opening(ray, Bounds::of(b.bounds));
  }
  const Bounds p = Bounds::of(a.bounds);
  const Bounds q = Bounds::of(b.bounds);
  return (outer_radius(ray, p.outer) - inner_radius(ray, p.inner)) -
         (outer_radius(ray, q.outer) - inner_radius(ray, q.inner));
}

}  // namespace trochoid::chip
