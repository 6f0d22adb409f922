#include <trochoid/surface/find_runout.h>

#include <trochoid/base/units.h>
#include <trochoid/numerics/least_squares.h>
#include <trochoid/numerics/levenberg_marquardt.h>
#include <trochoid/surface/datum.h>

#include <algorithm>
#include <cmath>

namespace trochoid::surface {

namespace {

using Values = std::vector<double>;

constexpr double um = 1e-6;    // scale of errors and runout
constexpr double MN_m2 = 1e8;  // scale of coefficients

double sum_of_squares(std::span<const double> r) {
  double sum = 0.0;
  for (const double x : r) {
    sum += x * x;
  }
  return sum;
}

/// Which unknowns a fit has, scaled to about one: c, s, [start], [K_tc, K_rc, datum].
struct Unknowns {
  bool start = false;
  bool all = false;
  std::size_t datum = 0;

  [[nodiscard]] std::size_t count() const {
    return 2 + (start ? 1 : 0) + (all ? 2 + datum : 0);
  }
};

struct State {
  RunoutVector runout;
  double start = 0.0;
  std::array<double, columns> K{};
  Values datum;
};

struct Problem {
  const ToothModel& model;
  std::span<const Reading> readings;
  const DatumColumns& columns_of_datum;
  double f_z;

  [[nodiscard]] Values pack(const State& s, const Unknowns& u) const {
    Values p = {s.runout.c / um, s.runout.s / um};
    if (u.start) {
      p.push_back(s.start / f_z);
    }
    if (u.all) {
      p.push_back(s.K[0] / MN_m2);
      p.push_back(s.K[1] / MN_m2);
      for (const double d : s.datum) {
        p.push_back(d / um);
      }
    }
    return p;
  }

  [[nodiscard]] State unpack(std::span<const double> p, const Unknowns& u,
                             State s) const {
    std::size_t i = 0;
    s.runout = {p[0] * um, p[1] * um};
    i = 2;
    if (u.start) {
      s.start = p[i++] * f_z;
    }
    if (u.all) {
      s.K[0] = p[i++] * MN_m2;
      s.K[1] = p[i++] * MN_m2;
      for (double& d : s.datum) {
        d = p[i++] * um;
      }
    }
    return s;
  }

  /// Predicted errors with the datum [m].
  [[nodiscard]] Values errors(const State& s, const ToothModel::Forces& forces) const {
    Values e = model.predict(forces, s.K, s.runout, s.start);
    const std::size_t n = columns_of_datum.count;
    for (std::size_t i = 0; i < e.size(); ++i) {
      for (std::size_t k = 0; k < n; ++k) {
        e[i] += columns_of_datum.values[i * n + k] * s.datum[k];
      }
    }
    return e;
  }

  void residuals(const State& s, const ToothModel::Forces& forces,
                 std::span<double> r) const {
    const Values e = errors(s, forces);
    for (std::size_t i = 0; i < e.size(); ++i) {
      r[i] = (readings[i].error - e[i]) / um;
    }
  }
};

/// Residuals and their differences; forces change with the runout only, and with
/// `frozen` not even then.
numerics::Residuals residuals_of(const Problem& problem, const Unknowns& u,
                                 const State& about, const ToothModel::Forces* frozen) {
  return [=, &problem](std::span<const double> p, std::span<double> r,
                       std::span<double> jacobian) {
    constexpr double step = 1e-3;
    const auto forces_at = [&](const State& s) {
      return frozen != nullptr ? *frozen : problem.model.forces(s.runout);
    };
    const State here = problem.unpack(p, u, about);
    const ToothModel::Forces forces = forces_at(here);
    problem.residuals(here, forces, r);
    Values q(p.begin(), p.end());
    Values moved(r.size());
    for (std::size_t k = 0; !jacobian.empty() && k < q.size(); ++k) {
      q[k] = p[k] + step;
      const State s = problem.unpack(q, u, about);
      problem.residuals(s, k < 2 ? forces_at(s) : forces, moved);
      q[k] = p[k];
      for (std::size_t i = 0; i < r.size(); ++i) {
        jacobian[k * r.size() + i] = (moved[i] - r[i]) / step;
      }
    }
    return true;
  };
}

/// A reading counts where the mean that it belongs to lies, so that the datum has the
/// same parameters as in the fit of the means.
std::vector<Spot> spots_of(std::span<const Reading> readings,
                           std::span<const Nominal> nominal) {
  std::vector<Spot> spots(readings.size());
  for (const Nominal& n : nominal) {
    for (const std::size_t i : n.readings) {
      spots[i] = {n.x, n.height, n.set};
    }
  }
  return spots;
}

std::vector<Spot> spots_of(std::span<const Reading> readings) {
  std::vector<Spot> spots;
  for (const Reading& r : readings) {
    spots.push_back({r.x, r.height, r.set});
  }
  return spots;
}

/// Readings at a few heights, as if all were taken at one place along the wall.
std::vector<Reading> sample_of(std::span<const Reading> readings) {
  constexpr std::size_t most_heights = 5;
  Values heights;
  double x = 0.0;
  for (const Reading& r : readings) {
    heights.push_back(r.height);
    x += r.x / static_cast<double>(readings.size());
  }
  std::sort(heights.begin(), heights.end());
  heights.erase(std::unique(heights.begin(), heights.end()), heights.end());
  const std::size_t every = (heights.size() + most_heights - 1) / most_heights;
  std::vector<Reading> sample;
  for (Reading r : readings) {
    const auto at = std::lower_bound(heights.begin(), heights.end(), r.height);
    if (static_cast<std::size_t>(at - heights.begin()) % every == 0) {
      r.x = x;
      sample.push_back(r);
    }
  }
  return sample;
}

/// The best of many starts, from a sample of the readings and with the forces of a
/// cutter without runout.
State first_guess(const Problem& problem, const State& about, double amplitude) {
  constexpr int angles = 12;
  constexpr std::size_t tried = 3;
  const ToothModel::Forces forces = problem.model.forces({});
  const Unknowns u{.start = problem.model.has_phase()};
  const int starts = u.start ? 6 : 1;
  Values r(problem.readings.size());
  std::vector<std::pair<double, State>> guesses;
  for (int i = 0; i < angles * starts; ++i) {
    State s = about;
    const double angle = unit::turn * (i % angles) / angles;
    s.runout = {amplitude * std::cos(angle), amplitude * std::sin(angle)};
    s.start = problem.f_z * (i / angles) / starts;
    problem.residuals(s, forces, r);
    guesses.emplace_back(sum_of_squares(r), s);
  }
  std::sort(guesses.begin(), guesses.end(),
            [](const auto& a, const auto& b) { return a.first < b.first; });
  State best = about;
  double least = -1.0;
  for (std::size_t i = 0; i < tried; ++i) {
    const auto found = numerics::levenberg_marquardt(
        residuals_of(problem, u, about, &forces), static_cast<int>(r.size()),
        problem.pack(guesses[i].second, u),
        {.max_iterations = 12, .parameter_tolerance = 1e-4});
    if (least < 0 || found.final_cost < least) {
      least = found.final_cost;
      best = problem.unpack(found.p, u, about);
    }
  }
  return best;
}

/// Of all readings about the means that a fit without runout predicts [m].
double rms_of_means(const ModelFits& found, std::span<const Reading> readings) {
  const Values predicted = predicted_means(found, readings.size());
  double sum = 0.0;
  for (std::size_t i = 0; i < readings.size(); ++i) {
    const double r = readings[i].error - predicted[i];
    sum += r * r;
  }
  return std::sqrt(sum / static_cast<double>(readings.size()));
}

/// Values and errors of the last fit.
void describe_fit(const Problem& problem, const Unknowns& u, const State& best,
                  RunoutFit& fit) {
  const std::size_t m = problem.readings.size();
  const std::size_t n = u.count();
  Values r(m);
  Values J(m * n);
  const Values p = problem.pack(best, u);
  residuals_of(problem, u, best, nullptr)(p, r, J);
  Values rows(m * n);
  for (std::size_t i = 0; i < m; ++i) {
    for (std::size_t k = 0; k < n; ++k) {
      rows[i * n + k] = J[k * m + i];
    }
  }
  const auto solved = numerics::least_squares(rows, static_cast<int>(n), r, 1e-7);
  const double sum = sum_of_squares(r);
  fit.rms = um * std::sqrt(sum / static_cast<double>(m));
  if (solved.inverse_gram.empty()) {
    fit.message = "the readings do not tell runout and coefficients apart";
    return;
  }
  const int freedom = static_cast<int>(m) - static_cast<int>(n);
  const double s2 = freedom > 0 ? sum / freedom : 0.0;
  const auto G = [&](std::size_t i, std::size_t k) {
    return s2 * solved.inverse_gram[i * n + k];
  };
  const double c = best.runout.c / um;
  const double s = best.runout.s / um;
  const double rho2 = std::max(c * c + s * s, 1e-30);
  const double along = (c * c * G(0, 0) + 2 * c * s * G(0, 1) + s * s * G(1, 1)) / rho2;
  const double across =
      (s * s * G(0, 0) - 2 * c * s * G(0, 1) + c * c * G(1, 1)) / (rho2 * rho2);
  fit.eccentricity = estimate(um * std::sqrt(rho2), um * um * along, freedom);
  double angle = std::atan2(s, c);
  angle += angle < 0 ? unit::turn : 0.0;
  fit.angle = estimate(angle, across, freedom);
  const std::size_t k = u.start ? 3 : 2;
  if (u.start) {
    fit.start = estimate(best.start, problem.f_z * problem.f_z * G(2, 2), freedom);
  }
  fit.K_tc = estimate(best.K[0], MN_m2 * MN_m2 * G(k, k), freedom);
  fit.K_rc = estimate(best.K[1], MN_m2 * MN_m2 * G(k + 1, k + 1), freedom);
  for (std::size_t d = 0; d < best.datum.size(); ++d) {
    fit.datum.push_back(
        estimate(best.datum[d], um * um * G(k + 2 + d, k + 2 + d), freedom));
  }
  fit.correlation = G(k, k + 1) / std::sqrt(G(k, k) * G(k + 1, k + 1));
  fit.ok = true;
  fit.message.clear();
}

}  // namespace

RunoutFit find_runout(const Setting& setting, std::span<const Reading> readings,
                      std::span<const Datum> datum, const ModelFits& found) {
  RunoutFit fit;
  const CoefficientFit& start = chosen_fit(found);
  const ToothModel model(setting, readings, found.stations);
  fit.labelled = model.labelled();
  const DatumColumns datum_part =
      datum_columns(spots_of(readings, found.nominal), datum);
  const Unknowns all{
      .start = model.has_phase(), .all = true, .datum = datum_part.count};
  if (!model.why_no_runout().empty() || readings.size() <= all.count()) {
    fit.message = model.why_no_runout().empty()
                      ? "too few readings for runout beside the coefficients"
                      : model.why_no_runout();
    return fit;
  }
  const Problem problem{model, readings, datum_part, setting.setup.cut.f_z};
  State about{.K = wall_coefficients(setting.law)};
  about.K[0] = start.K_tc.value;
  about.K[1] = start.K_rc.value;
  for (const Estimate& d : start.datum) {
    about.datum.push_back(d.value);
  }
  Values r(readings.size());
  problem.residuals(about, model.forces({}), r);
  fit.rms_without = um * std::sqrt(sum_of_squares(r) / static_cast<double>(r.size()));
  const std::vector<Reading> sample = sample_of(readings);
  const ToothModel sampled(setting, sample);
  const DatumColumns sampled_datum = datum_columns(spots_of(sample), datum);
  const bool enough = sampled.why_no_runout().empty() && sample.size() > all.count() &&
                      sampled_datum.count == datum_part.count;
  const Problem part{sampled, sample, sampled_datum, problem.f_z};
  State best =
      first_guess(enough ? part : problem, about, std::max(fit.rms_without, 0.1 * um));
  const auto fitted = numerics::levenberg_marquardt(
      residuals_of(problem, all, best, nullptr), static_cast<int>(readings.size()),
      problem.pack(best, all), {.max_iterations = 30, .parameter_tolerance = 1e-9});
  best = problem.unpack(fitted.p, all, best);
  describe_fit(problem, all, best, fit);
  if (fit.ok && fit.rms > rms_of_means(found, readings)) {
    fit.ok = false;
    fit.message = "no runout was found that explains the readings better than none";
    return fit;
  }
  fit.predicted = problem.errors(best, model.forces(best.runout));
  return fit;
}

}  // namespace trochoid::surface
