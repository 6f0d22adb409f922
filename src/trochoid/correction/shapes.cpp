#include <trochoid/correction/shapes.h>

#include <trochoid/base/units.h>
#include <trochoid/geometry/cutter.h>
#include <trochoid/numerics/least_squares.h>

#include <algorithm>
#include <cmath>

namespace trochoid::correction {

namespace {

constexpr double shapes_rank_tolerance = 1e-9;
/// Of a harmonic, for a bound that holds for all smaller ones [m].
constexpr double largest_amplitude = 1e-3;
/// Angles of an arc of cut at which chips are compared.
constexpr int angles_of_arc = 181;
/// Levels that a sine meets with one phase only: two teeth.
constexpr double degenerate = 1e-9;

double middle_of(const RigidCut& cut) {
  return (cut.arc().from + cut.arc().to) / 2;
}

/// The tooth before.
std::size_t before(const RigidCut& cut, std::size_t j) {
  return (j + cut.psi().size() - 1) % cut.psi().size();
}

/// b_j of R-4, ascending.
std::vector<double> boundaries(const RigidCut& cut) {
  std::vector<double> b;
  for (std::size_t j = 0; j < cut.psi().size(); ++j) {
    b.push_back(cut.psi()[j] + middle_of(cut) - cut.pitch()[before(cut, j)] / 2);
  }
  return b;
}

Segments square(const RigidCut& cut, const std::vector<double>& x) {
  std::vector<double> b = boundaries(cut);
  b.push_back(b.front() + unit::turn);
  Segments motion;
  for (std::size_t j = 0; j < x.size(); ++j) {
    motion.all.push_back({b[j], b[j + 1], {x[j]}});
  }
  return motion;
}

/// @param rise  polynomial from 0 to 1
Segments with_transitions(const RigidCut& cut, const std::vector<double>& x,
                          double width, const std::array<double, 6>& rise) {
  std::vector<double> b = boundaries(cut);
  b.push_back(b.front() + unit::turn);
  width = std::min(width, *std::min_element(cut.pitch().begin(), cut.pitch().end()));
  Segments motion;
  for (std::size_t j = 0; j < x.size(); ++j) {
    const double last = x[before(cut, j)];
    Segment s{b[j] - width / 2, b[j] + width / 2, {}};
    for (std::size_t k = 0; k < rise.size(); ++k) {
      s.c[k] = (x[j] - last) * rise[k];
    }
    s.c[0] += last;
    motion.all.push_back(s);
    const double until = b[j + 1] - width / 2;
    if (until - s.to > 1e-9) {
      motion.all.push_back({s.to, until, {x[j]}});
    } else {
      motion.all.back().to = until;
    }
  }
  return motion;
}

Harmonics sine(const RigidCut& cut, const std::vector<double>& x) {
  double ss = 0.0;
  double sc = 0.0;
  double cc = 0.0;
  double sx = 0.0;
  double cx = 0.0;
  for (std::size_t j = 0; j < x.size(); ++j) {
    const double phi = cut.psi()[j] + middle_of(cut);
    const double s = std::sin(phi);
    const double c = std::cos(phi);
    ss += s * s;
    sc += s * c;
    cc += c * c;
    sx += s * x[j];
    cx += c * x[j];
  }
  const double trace = ss + cc;
  const double determinant = ss * cc - sc * sc;
  if (determinant <
      degenerate * trace * trace) {  // along one direction: the smaller one
    return {0.0, {{cx / trace, -sx / trace}}};
  }
  const double a = (cc * sx - sc * cx) / determinant;
  const double b = (ss * cx - sc * sx) / determinant;
  return {0.0, {{b, -a}}};
}

/// One comparison of a chip with that of the tooth before: R-7 at an angle.
struct Comparison {
  double e_0 = 0.0;  ///< difference with the table at rest
  double phi = 0.0;
  double back = 0.0;  ///< pitch to the tooth before
  double sine = 0.0;
  double cosine = 0.0;
};

std::vector<Comparison> comparisons(const RigidCut& cut,
                                    const std::vector<double>& rho) {
  std::vector<Comparison> all;
  for (std::size_t j = 0; j < rho.size(); ++j) {
    const std::size_t last = before(cut, j);
    for (int i = 0; i < angles_of_arc; ++i) {
      const double theta =
          cut.arc().from + (cut.arc().to - cut.arc().from) * (i + 0.5) / angles_of_arc;
      all.push_back({rho[j] - rho[last], cut.psi()[j] + theta, cut.pitch()[last],
                     std::sin(theta), std::cos(theta)});
    }
  }
  return all;
}

/// Harmonics that change a chip.
std::vector<int> visible(const RigidCut& cut, int n_max) {
  const auto& pitch = cut.pitch();
  const bool equal = geometry::equally_pitched(pitch);
  std::vector<int> n;
  for (int k = 1; k <= n_max; ++k) {
    if (pitch.size() > 1 && !(equal && k % cut.teeth() == 0)) {
      n.push_back(k);
    }
  }
  return n;
}

struct HarmonicFit {
  Harmonics x;
  double rms = 0.0;
  double bound = 0.0;  ///< below which no other fit comes
};

///
/// @param A  row-major, shape (size of e, columns)
double bound_below(std::span<const double> A, std::span<const double> e,
                   std::span<const double> residual) {
  const std::size_t columns = A.size() / e.size();
  std::vector<double> gradient(columns, 0.0);
  double product = 0.0;
  double square = 0.0;
  for (std::size_t i = 0; i < e.size(); ++i) {
    for (std::size_t k = 0; k < columns; ++k) {
      gradient[k] += A[i * columns + k] * residual[i];
    }
    product += residual[i] * e[i];
    square += residual[i] * residual[i];
  }
  for (const double g : gradient) {
    product -= std::abs(g) * largest_amplitude;
  }
  return square > 0 ? std::max(product / std::sqrt(square), 0.0) : 0.0;
}

/// Least squares of R-7 or, with the second axis, R-8.
HarmonicFit fit_harmonics(const RigidCut& cut, const std::vector<double>& rho,
                          int n_max, bool second_axis) {
  const std::vector<Comparison> all = comparisons(cut, rho);
  const std::vector<int> n = visible(cut, n_max);
  const std::size_t columns = n.size() * (second_axis ? 4 : 2);
  HarmonicFit fit;
  fit.x.c.resize(static_cast<std::size_t>(std::max(n_max, 0)));
  std::vector<double> A;
  std::vector<double> e;
  for (const Comparison& c : all) {
    for (const int k : n) {
      const double dc = std::cos(k * c.phi) - std::cos(k * (c.phi - c.back));
      const double ds = std::sin(k * c.phi) - std::sin(k * (c.phi - c.back));
      A.insert(A.end(), {dc * c.sine, ds * c.sine});
      if (second_axis) {
        A.insert(A.end(), {dc * c.cosine, ds * c.cosine});
      }
    }
    e.push_back(c.e_0);
  }
  double rss = 0.0;
  if (columns == 0) {
    for (const double v : e) {
      rss += v * v;
    }
  } else {
    const numerics::LeastSquares solved =
        numerics::least_squares(A, static_cast<int>(columns), e, shapes_rank_tolerance);
    rss = solved.rss;
    fit.bound = bound_below(A, e, solved.residual);
    for (std::size_t i = 0; i < n.size(); ++i) {
      const std::size_t at = i * (second_axis ? 4 : 2);
      fit.x.c[static_cast<std::size_t>(n[i]) - 1] = {solved.x[at], -solved.x[at + 1]};
    }
  }
  const auto count = static_cast<double>(all.size());
  fit.rms = std::sqrt(rss / count);
  fit.bound = columns == 0 ? fit.rms : fit.bound / std::sqrt(count);
  return fit;
}

}  // namespace

std::vector<double> levels(std::span<const double> rho) {
  double mean = 0.0;
  for (const double r : rho) {
    mean += r / static_cast<double>(rho.size());
  }
  std::vector<double> x(rho.begin(), rho.end());
  for (double& v : x) {
    v -= mean;
  }
  return x;
}

PeriodicMotion table_motion(const RigidCut& cut, Shape shape,
                            const ShapeOptions& options, std::span<const double> rho) {
  const std::vector<double> x = levels(rho);
  switch (shape) {
    case Shape::square:
      return square(cut, x);
    case Shape::sine:
      return sine(cut, x);
    case Shape::trapezoid:
      return with_transitions(cut, x, options.transition, {0, 1, 0, 0, 0, 0});
    case Shape::quintic:
      return with_transitions(cut, x, options.transition, {0, 0, 0, 10, -15, 6});
    case Shape::harmonics:
      break;
  }
  return fit_harmonics(cut, x, options.harmonics, false).x;
}

PeriodicMotion table_motion(const RigidCut& cut, Shape shape,
                            const ShapeOptions& options) {
  return table_motion(cut, shape, options, cut.offsets());
}

PeriodicMotion limited(const RigidCut& cut, const PeriodicMotion& motion, int n_max) {
  Harmonics part = harmonics_of(motion, n_max);
  const double mean = part.mean;
  part.mean = 0.0;
  double both = 0.0;
  double own = 0.0;
  for (const double psi : cut.psi()) {
    const double phi = psi + middle_of(cut);
    const double x = place_at(part, phi);
    both += x * (place_at(motion, phi) - mean);
    own += x * x;
  }
  return own > 0 ? scaled(part, both / own) : PeriodicMotion(part);
}

double chip_rms(const RigidCut& cut, const PeriodicMotion& X) {
  const std::vector<Comparison> all = comparisons(cut, cut.offsets());
  double sum = 0.0;
  for (const Comparison& c : all) {
    const double e =
        c.e_0 - (place_at(X, c.phi) - place_at(X, c.phi - c.back)) * c.sine;
    sum += e * e;
  }
  return std::sqrt(sum / static_cast<double>(all.size()));
}

AxisLimits axis_limits(const RigidCut& cut, int n_max) {
  AxisLimits limits;
  limits.uncorrected = chip_rms(cut, Harmonics{});
  const HarmonicFit one = fit_harmonics(cut, cut.offsets(), n_max, false);
  const HarmonicFit two = fit_harmonics(cut, cut.offsets(), n_max, true);
  limits.one_axis = one.rms;
  limits.one_axis_bound = one.bound;
  limits.two_axes = two.rms;
  limits.two_axes_bound = two.bound;
  for (const double start : cut.psi()) {
    int together = 0;
    for (const double other : cut.psi()) {
      const double theta = start + cut.arc().from + 1e-6 - other;
      const double u = theta - unit::turn * std::floor(theta / unit::turn);
      together += u > cut.arc().from && u < cut.arc().to ? 1 : 0;
    }
    limits.most_teeth = std::max(limits.most_teeth, together);
  }
  return limits;
}

}  // namespace trochoid::correction
