#include <trochoid/surface/mixture.h>

#include <trochoid/base/units.h>
#include <trochoid/surface/joint_model.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace trochoid::surface {

namespace {

using Values = std::vector<double>;

constexpr double um = JointModel::scale;
constexpr double MN_m2 = 1e8;

/// Unknowns turned by whole pitches to where those of another explanation lie: without
/// numbers on the teeth both are the same wall.
Values turned_towards(const Values& to, const Values& p, int teeth) {
  Values best = p;
  double least = std::numeric_limits<double>::infinity();
  for (int k = 0; k < teeth; ++k) {
    const double angle = unit::turn * k / teeth;
    Values q = p;
    q[0] = std::cos(angle) * p[0] - std::sin(angle) * p[1];
    q[1] = std::sin(angle) * p[0] + std::cos(angle) * p[1];
    q[2] += k;
    q[2] -= teeth * std::round((q[2] - to[2]) / teeth);
    const double apart = std::hypot(q[0] - to[0], q[1] - to[1]);
    if (apart < least) {
      least = apart;
      best = q;
    }
  }
  return best;
}

/// Mean and covariance over all explanations.
struct Mixture {
  Values mean;
  Values covariance;  ///< row-major
  Values own;         ///< variance of the likeliest if no error were shared
};

Mixture mixture_of(const Given& wall, std::span<const Tried> tried) {
  const Values& likeliest = tried.front().fit.p;
  const std::size_t n = likeliest.size();
  const bool turn =
      wall.runout.ok && !wall.runout.labelled && wall.setting.model == Model::envelope;
  std::vector<Values> all;
  Mixture m{Values(n), Values(n * n), tried.front().fit.own};
  for (const Tried& t : tried) {
    all.push_back(
        turn ? turned_towards(likeliest, t.fit.p, wall.setting.setup.cutter.teeth())
             : t.fit.p);
    for (std::size_t k = 0; k < n; ++k) {
      m.mean[k] += t.what.weight * all.back()[k];
    }
  }
  for (std::size_t e = 0; e < tried.size(); ++e) {
    const std::size_t width = n + tried[e].fit.form.size();
    for (std::size_t a = 0; a < n; ++a) {
      for (std::size_t b = 0; b < n; ++b) {
        m.covariance[a * n + b] +=
            tried[e].what.weight *
            (tried[e].fit.covariance[a * width + b] +
             (all[e][a] - m.mean[a]) * (all[e][b] - m.mean[b]));  // E-24
      }
    }
  }
  return m;
}

/// Degrees of freedom of a variance of which a part is that of shared errors.
int freedom_of(const Scatter& scatter, double whole, double own) {
  double shared = std::numeric_limits<double>::infinity();
  for (std::size_t l = 0; l < scatter.ratio.size(); ++l) {
    if (scatter.ratio[l] > 0) {
      shared = std::min(shared, scatter.freedom[l + 1]);
    }
  }
  const double more = std::max(0.0, whole - own);
  const double least = std::isinf(shared) ? 0.0 : more * more / shared;
  const double sum = own * own / scatter.freedom.front() + least;
  const double both = own + more;
  return sum > 0 ? std::max(1, static_cast<int>(both * both / sum))
                 : static_cast<int>(scatter.freedom.front());
}

void put_runout(const Mixture& m, const Scatter& scatter, double f_z, RunoutFit& fit) {
  const std::size_t n = m.mean.size();
  const double c = m.mean[0];
  const double s = m.mean[1];
  const double rho2 = std::max(c * c + s * s, 1e-30);
  const auto along = [&](double x, double y, const auto& G) {
    return (x * x * G(0, 0) + 2 * x * y * G(0, 1) + y * y * G(1, 1)) / rho2;
  };
  const auto whole = [&](std::size_t i, std::size_t k) {
    return m.covariance[i * n + k];
  };
  const double radial = along(c, s, whole);
  const double across = along(-s, c, whole) / rho2;
  const int freedom =
      freedom_of(scatter, whole(0, 0) + whole(1, 1), m.own[0] + m.own[1]);
  fit.eccentricity = estimate(um * std::sqrt(rho2), um * um * radial, freedom);
  double angle = std::atan2(s, c);
  angle += angle < 0 ? unit::turn : 0.0;
  fit.angle = estimate(angle, across, freedom);
  const std::array<std::size_t, 4> place = {0, 1, n - 2, n - 1};
  const std::array<double, 4> unit = {um, um, MN_m2, MN_m2};
  for (std::size_t a = 0; a < 4; ++a) {
    for (std::size_t b = 0; b < 4; ++b) {
      fit.covariance[4 * a + b] = unit[a] * unit[b] * whole(place[a], place[b]);
    }
  }
  if (n == 5) {
    fit.start = estimate(f_z * m.mean[2], f_z * f_z * whole(2, 2), freedom);
  }
}

void put_coefficients(const Mixture& m, const Scatter& scatter, RunoutFit& fit) {
  const std::size_t n = m.mean.size();
  const auto put = [&](std::size_t k, Estimate& K) {
    const double variance = m.covariance[k * n + k];
    K = estimate(MN_m2 * m.mean[k], MN_m2 * MN_m2 * variance,
                 freedom_of(scatter, variance, m.own[k]));
  };
  put(n - 2, fit.K_tc);
  put(n - 1, fit.K_rc);
  fit.correlation =
      m.covariance[(n - 2) * n + n - 1] /
      std::sqrt(m.covariance[(n - 2) * n + n - 2] * m.covariance[(n - 1) * n + n - 1]);
}

/// What the likeliest explanation says of all readings, its form included.
void put_predicted(const Given& wall, const Tried& likeliest, RunoutFit& fit) {
  fit.predicted = likeliest.way.predict(wall.readings, likeliest.fit.p);
  const std::size_t n = likeliest.form.count;
  double sum = 0.0;
  for (std::size_t i = 0; i < fit.predicted.size(); ++i) {
    for (std::size_t k = 0; k < n; ++k) {
      fit.predicted[i] += um * likeliest.fit.form[k] * likeliest.form.values[i * n + k];
    }
    sum += std::pow(wall.readings[i].error - fit.predicted[i], 2);
  }
  fit.rms = std::sqrt(sum / static_cast<double>(fit.predicted.size()));
}

Explanation described(const Tried& tried, const Scatter& scatter, bool with_runout) {
  Explanation what = tried.what;
  const Mixture alone{tried.fit.p, {}, tried.fit.own};
  const std::size_t n = tried.fit.p.size();
  const std::size_t width = n + tried.fit.form.size();
  Mixture m = alone;
  for (std::size_t a = 0; a < n; ++a) {
    for (std::size_t b = 0; b < n; ++b) {
      m.covariance.push_back(tried.fit.covariance[a * width + b]);
    }
  }
  RunoutFit fit;
  put_coefficients(m, scatter, fit);
  if (with_runout) {
    put_runout(m, scatter, 1.0, fit);
  }
  what.K_tc = fit.K_tc;
  what.K_rc = fit.K_rc;
  what.correlation = fit.correlation;
  what.eccentricity = fit.eccentricity;
  return what;
}

}  // namespace

JointFit together(const Given& wall, const Scatter& scatter,
                  std::span<const Tried> tried) {
  JointFit result{.ok = true, .message = {}, .with_runout = wall.runout.ok};
  const Mixture m = mixture_of(wall, tried);
  RunoutFit& fit = result.fit;
  fit = wall.runout;
  put_coefficients(m, scatter, fit);
  if (wall.runout.ok) {
    put_runout(m, scatter, wall.setting.setup.cut.f_z, fit);
  }
  const Tried& likeliest = tried.front();
  fit.datum.clear();
  const std::size_t width = likeliest.fit.own.size();
  for (std::size_t k = 0; k < likeliest.fit.form.size(); ++k) {
    const std::size_t at = likeliest.fit.p.size() + k;
    const double variance = likeliest.fit.covariance[at * width + at];
    fit.datum.push_back(estimate(um * likeliest.fit.form[k], um * um * variance,
                                 freedom_of(scatter, variance, likeliest.fit.own[at])));
  }
  put_predicted(wall, likeliest, fit);
  for (const Tried& t : tried) {
    result.explanations.push_back(described(t, scatter, wall.runout.ok));
  }
  result.own_scatter = um * std::sqrt(scatter.s2);
  double shared = 0.0;
  for (const double ratio : scatter.ratio) {
    shared += ratio;
  }
  result.shared_scatter = um * std::sqrt(scatter.s2 * shared);
  return result;
}

}  // namespace trochoid::surface
