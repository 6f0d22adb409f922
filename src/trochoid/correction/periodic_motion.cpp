#include <trochoid/correction/periodic_motion.h>

#include <trochoid/base/units.h>
#include <trochoid/numerics/gauss_kronrod.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace trochoid::correction {

namespace {

using Complex = std::complex<double>;

/// A change of place or slope below this part of the motion's size is none.
constexpr double rounding = 1e-9;

double wrapped(double phi, double from) noexcept {
  return phi - unit::turn * std::floor((phi - from) / unit::turn);
}

MotionPoint at(const Harmonics& motion, double phi) noexcept {
  const Complex step = std::polar(1.0, phi);
  Complex e = 1.0;
  MotionPoint point{motion.mean};
  for (std::size_t i = 0; i < motion.c.size(); ++i) {
    e *= step;
    const double n = static_cast<double>(i) + 1;
    const Complex term = motion.c[i] * e;
    point.x += term.real();
    point.slope -= n * term.imag();
    point.curvature -= n * n * term.real();
  }
  return point;
}

MotionPoint at(const Segment& s, double phi) noexcept {
  const double width = s.to - s.from;
  const double u = (phi - s.from) / width;
  MotionPoint point;
  for (std::size_t k = s.c.size(); k-- > 0;) {
    point.curvature = point.curvature * u + 2 * point.slope;
    point.slope = point.slope * u + point.x;
    point.x = point.x * u + s.c[k];
  }
  point.slope /= width;
  point.curvature /= width * width;
  return point;
}

MotionPoint at(const Segments& motion, double phi) noexcept {
  if (motion.all.empty()) {
    return {};
  }
  const double angle = wrapped(phi, motion.all.front().from);
  const auto next =
      std::upper_bound(motion.all.begin() + 1, motion.all.end(), angle,
                       [](double a, const Segment& s) { return a < s.from; });
  return at(*(next - 1), angle);
}

/// Integral of one segment times e^(-i n phi).
Complex transformed(const Segment& s, double n) {
  const bool linear =
      std::all_of(s.c.begin() + 2, s.c.end(), [](double c) { return c == 0; });
  const Complex a = std::polar(1.0, -n * s.from);
  const Complex b = std::polar(1.0, -n * s.to);
  const double width = s.to - s.from;
  if (linear && n > 0) {
    const Complex in(0.0, n);
    return (s.c[0] * a - (s.c[0] + s.c[1]) * b) / in -
           s.c[1] / width * (b - a) / (in * in);
  }
  const auto& rule = numerics::kronrod_rule();
  const auto panels = static_cast<int>(std::ceil(n * width / 2)) + 1;
  const double half = width / (2 * panels);
  Complex sum = 0.0;
  for (int p = 0; p < panels; ++p) {
    for (std::size_t i = 0; i < rule.t.size(); ++i) {
      const double phi = s.from + half * (2 * p + 1 + rule.t[i]);
      sum += half * rule.kronrod[i] * at(s, phi).x * std::polar(1.0, -n * phi);
    }
  }
  return sum;
}

Harmonics harmonics(const Segments& motion, int n_max) {
  Harmonics out;
  for (int n = 0; n <= n_max; ++n) {
    Complex c = 0.0;
    for (const Segment& s : motion.all) {
      c += transformed(s, n);
    }
    if (n == 0) {
      out.mean = c.real() / unit::turn;
    } else {
      out.c.push_back(2.0 * c / unit::turn);
    }
  }
  return out;
}

Harmonics harmonics(const Harmonics& motion, int n_max) {
  Harmonics out = motion;
  out.c.resize(static_cast<std::size_t>(n_max));
  return out;
}

/// Points looked at within a stretch of a motion.
void look(const PeriodicMotion& motion, double from, double to, Range& range) {
  constexpr int count = 64;
  const auto points =
      static_cast<int>(std::ceil((to - from) / unit::turn * 2880)) + count;
  for (int i = 0; i <= points; ++i) {
    const double inside = std::clamp(static_cast<double>(i), 1e-9, points - 1e-9);
    const MotionPoint p = motion_at(motion, from + (to - from) * inside / points);
    range.low = std::min(range.low, p.x);
    range.high = std::max(range.high, p.x);
    range.slope = std::max(range.slope, std::abs(p.slope));
    range.curvature = std::max(range.curvature, std::abs(p.curvature));
  }
}

}  // namespace

MotionPoint motion_at(const PeriodicMotion& motion, double phi) noexcept {
  if (const auto* h = std::get_if<Harmonics>(&motion)) {
    return at(*h, phi);
  }
  return at(*std::get_if<Segments>(&motion), phi);
}

double place_at(const PeriodicMotion& motion, double phi) noexcept {
  if (const auto* h = std::get_if<Harmonics>(&motion)) {
    // Horner from the highest harmonic down: one product a harmonic.
    const Complex step = std::polar(1.0, phi);
    Complex sum = 0.0;
    for (std::size_t i = h->c.size(); i-- > 0;) {
      sum = (sum + h->c[i]) * step;
    }
    return h->mean + sum.real();
  }
  return at(*std::get_if<Segments>(&motion), phi).x;
}

PeriodicMotion scaled(const PeriodicMotion& motion, double factor) {
  PeriodicMotion out = motion;
  if (auto* h = std::get_if<Harmonics>(&out)) {
    h->mean *= factor;
    for (Complex& c : h->c) {
      c *= factor;
    }
    return out;
  }
  for (Segment& s : std::get<Segments>(out).all) {
    for (double& c : s.c) {
      c *= factor;
    }
  }
  return out;
}

PeriodicMotion advanced(const PeriodicMotion& motion, double angle) {
  PeriodicMotion out = motion;
  if (auto* h = std::get_if<Harmonics>(&out)) {
    double n = 0;
    for (Complex& c : h->c) {
      n += 1;
      c *= std::polar(1.0, n * angle);
    }
    return out;
  }
  for (Segment& s : std::get<Segments>(out).all) {
    s.from -= angle;
    s.to -= angle;
  }
  return out;
}

Harmonics harmonics_of(const PeriodicMotion& motion, int n_max) {
  return std::visit([&](const auto& m) { return harmonics(m, n_max); }, motion);
}

Range range_of(const PeriodicMotion& motion) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Range range{infinity, -infinity};
  if (std::holds_alternative<Harmonics>(motion)) {
    look(motion, 0.0, unit::turn, range);
    return range;
  }
  const auto& all = std::get<Segments>(motion).all;
  for (const Segment& s : all) {
    look(motion, s.from, s.to, range);
  }
  const double size = std::max(std::abs(range.low), std::abs(range.high));
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Segment& next = all[(i + 1) % all.size()];
    const MotionPoint a = at(all[i], all[i].to);
    const MotionPoint b = at(next, next.from);
    if (std::abs(a.x - b.x) > rounding * size) {
      range.slope = infinity;
      range.curvature = infinity;
    } else if (std::abs(a.slope - b.slope) > rounding * range.slope) {
      range.curvature = infinity;
    }
  }
  return range;
}

std::vector<double> breaks_of(const PeriodicMotion& motion) {
  std::vector<double> breaks;
  if (const auto* s = std::get_if<Segments>(&motion)) {
    for (const Segment& segment : s->all) {
      breaks.push_back(wrapped(segment.from, 0.0));
    }
    std::sort(breaks.begin(), breaks.end());
  }
  return breaks;
}

Harmonics harmonics_of_samples(const std::vector<double>& x, int n_max) {
  Harmonics out;
  const auto count = static_cast<double>(x.size());
  for (int n = 0; n <= n_max; ++n) {
    const Complex step = std::polar(1.0, -n * unit::turn / count);
    Complex sum = 0.0;
    for (std::size_t i = x.size(); i-- > 0;) {
      sum = sum * step + x[i];
    }
    if (n == 0) {
      out.mean = sum.real() / count;
    } else {
      out.c.push_back(2.0 * sum / count);
    }
  }
  return out;
}

}  // namespace trochoid::correction
