#include <trochoid/surface/find_runout.h>

#include <trochoid/base/units.h>
#include <trochoid/numerics/least_squares.h>
#include <trochoid/numerics/levenberg_marquardt.h>
#include <trochoid/surface/datum.h>
#include <trochoid/surface/folded_readings.h>
#include <trochoid/surface/tooth_model.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <span>
#include <vector>

namespace trochoid::surface {
namespace {

namespace runout {

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
  double start = 0.0;  ///< [m]
  std::array<double, columns> K{};
  std::vector<double> datum;
};

struct Problem {
  const ToothModel& model;
  std::span<const Reading> readings;  ///< of that model
  std::span<const double> count;      ///< of readings in each mean, shape (readings)
  const DatumColumns& columns_of_datum;
  double f_z;  ///< [m]

  [[nodiscard]] std::vector<double> pack(const State& s, const Unknowns& u) const;
  [[nodiscard]] State unpack(std::span<const double> p, const Unknowns& u,
                             State s) const;
  /// Predicted errors with the datum [m].
  [[nodiscard]] std::vector<double> errors(const State& s,
                                           const ToothModel::Forces& forces) const;
  /// Measured minus predicted, times the root of the count [um].
  void residuals(const State& s, const ToothModel::Forces& forces,
                 std::span<double> r) const;
};

/// @brief Residuals and their differences; forces change with the runout only, and with
/// `frozen` not even then.
/// @param problem, frozen  must live as long as the result
numerics::Residuals residuals_of(const Problem& problem, const Unknowns& u,
                                 const State& about, const ToothModel::Forces* frozen);

}  // namespace runout

namespace runout {

std::vector<double> Problem::pack(const State& s, const Unknowns& u) const {
  std::vector<double> p = {s.runout.c / error_scale, s.runout.s / error_scale};
  if (u.start) {
    p.push_back(s.start / f_z);
  }
  if (u.all) {
    p.push_back(s.K[0] / coefficient_scale);
    p.push_back(s.K[1] / coefficient_scale);
    for (const double d : s.datum) {
      p.push_back(d / error_scale);
    }
  }
  return p;
}

State Problem::unpack(std::span<const double> p, const Unknowns& u, State s) const {
  std::size_t i = 0;
  s.runout = {p[0] * error_scale, p[1] * error_scale};
  i = 2;
  if (u.start) {
    s.start = p[i++] * f_z;
  }
  if (u.all) {
    s.K[0] = p[i++] * coefficient_scale;
    s.K[1] = p[i++] * coefficient_scale;
    for (double& d : s.datum) {
      d = p[i++] * error_scale;
    }
  }
  return s;
}

std::vector<double> Problem::errors(const State& s,
                                    const ToothModel::Forces& forces) const {
  std::vector<double> e = model.predict(forces, s.K, s.runout, s.start);
  const std::size_t n = columns_of_datum.count;
  for (std::size_t i = 0; i < e.size(); ++i) {
    for (std::size_t k = 0; k < n; ++k) {
      e[i] += columns_of_datum.values[i * n + k] * s.datum[k];
    }
  }
  return e;
}

void Problem::residuals(const State& s, const ToothModel::Forces& forces,
                        std::span<double> r) const {
  const std::vector<double> e = errors(s, forces);
  for (std::size_t i = 0; i < e.size(); ++i) {
    r[i] = std::sqrt(count[i]) * (readings[i].error - e[i]) / error_scale;
  }
}

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
    std::vector<double> q(p.begin(), p.end());
    std::vector<double> moved(r.size());
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

}  // namespace runout

using namespace runout;
using Values = std::vector<double>;

std::ptrdiff_t at(std::size_t i) {
  return static_cast<std::ptrdiff_t>(i);
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

/// Readings with how many each is the mean of.
struct Sample {
  std::vector<Reading> readings;
  Values count;
};

/// Readings at a few heights, as if all were taken at one place along the wall.
Sample sample_of(const FoldedReadings& all, bool few_heights) {
  constexpr std::size_t most_heights = 5;
  constexpr std::size_t enough = 4000;
  Values heights;
  double x = 0.0;
  for (const Reading& r : all.means) {
    heights.push_back(r.height);
    x += r.x / static_cast<double>(all.means.size());
  }
  std::sort(heights.begin(), heights.end());
  heights.erase(std::unique(heights.begin(), heights.end()), heights.end());
  const std::size_t every = (heights.size() + most_heights - 1) / most_heights;
  const std::size_t one_of = 1 + all.means.size() / enough;  // of a scan
  Sample sample;
  for (std::size_t i = 0; i < all.means.size(); ++i) {
    Reading r = all.means[i];
    const auto at = std::lower_bound(heights.begin(), heights.end(), r.height);
    const bool taken = few_heights
                           ? static_cast<std::size_t>(at - heights.begin()) % every == 0
                           : i % one_of == 0;
    if (taken) {
      r.x = x;
      sample.readings.push_back(r);
      sample.count.push_back(all.count[i]);
    }
  }
  return sample;
}

/// The datum of means, from that of their readings.
DatumColumns folded_datum(const DatumColumns& datum, const FoldedReadings& folded) {
  DatumColumns means{datum.count, Values(folded.means.size() * datum.count)};
  for (std::size_t i = 0; i < folded.of.size(); ++i) {
    for (std::size_t k = 0; k < datum.count; ++k) {
      means.values[folded.of[i] * datum.count + k] +=
          datum.values[i * datum.count + k] / folded.count[folded.of[i]];
    }
  }
  return means;
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
    guesses.emplace_back(numerics::dot(r, r), s);
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

/// Of all readings about what is predicted of them [m].
double rms_about(std::span<const double> predicted, std::span<const Reading> readings) {
  double sum = 0.0;
  for (std::size_t i = 0; i < readings.size(); ++i) {
    const double r = readings[i].error - predicted[i];
    sum += r * r;
  }
  return std::sqrt(sum / static_cast<double>(readings.size()));
}

/// Sum over all readings of each derivative of the residual times the residual.
Values gradient_at(const Problem& every, const Values& p, const Unknowns& u,
                   const State& about) {
  constexpr double step = 1e-3;
  const std::size_t m = every.readings.size();
  const State here = every.unpack(p, u, about);
  const ToothModel::Forces forces = every.model.forces(here.runout);
  Values r(m);
  Values moved(m);
  every.residuals(here, forces, r);
  Values gradient(p.size());
  Values q = p;
  const std::size_t datum = p.size() - u.datum;
  for (std::size_t k = 0; k < p.size(); ++k) {
    if (k >= datum) {  // linear, and known
      for (std::size_t i = 0; i < m; ++i) {
        gradient[k] -= every.columns_of_datum.values[i * u.datum + k - datum] * r[i];
      }
      continue;
    }
    q[k] = p[k] + step;
    const State s = every.unpack(q, u, about);
    every.residuals(s, k < 2 ? every.model.forces(s.runout) : forces, moved);
    q[k] = p[k];
    for (std::size_t i = 0; i < m; ++i) {
      gradient[k] += r[i] * (moved[i] - r[i]) / step;
    }
  }
  return gradient;
}

/// From the best state of the means to that of all readings, which differ where a mean
/// holds a kink: Gauss-Newton with the matrix of the means and the gradient of all.
State refined(const Problem& every, const Problem& means, const Unknowns& u,
              State best) {
  constexpr int most_steps = 3;
  constexpr double negligible = 1e-2;  // of a variance: a step of 0.1 se
  const std::size_t m = means.readings.size();
  const std::size_t n = u.count();
  Values p = means.pack(best, u);
  Values r(m);
  Values J(m * n);
  residuals_of(means, u, best, nullptr)(p, r, J);
  Values gram(n * n);
  for (std::size_t a = 0; a < n; ++a) {
    for (std::size_t b = 0; b < n; ++b) {
      gram[a * n + b] = std::inner_product(
          J.begin() + at(a * m), J.begin() + at(a * m + m), J.begin() + at(b * m), 0.0);
    }
  }
  const double s2 = numerics::dot(r, r) / static_cast<double>(m);
  for (int k = 0; k < most_steps; ++k) {
    const Values right = gradient_at(every, p, u, best);
    Values step(n);
    const double gain = numerics::solve_normal(gram, right, step);
    const double share = k == 0 ? 1.0 : 0.5;  // a kink sends whole steps to and fro
    for (std::size_t i = 0; i < n; ++i) {
      p[i] -= share * step[i];
    }
    if (gain <= negligible * s2) {
      break;
    }
  }
  return every.unpack(p, u, best);
}

/// Values and errors of the last fit.
/// @param readings  how many there are; fit.rms is that of all of them
void describe_fit(const Problem& problem, const Unknowns& u, const State& best,
                  std::size_t readings, RunoutFit& fit) {
  const std::size_t m = problem.readings.size();
  const std::size_t n = u.count();
  Values r(m);
  Values J(m * n);
  const Values p = problem.pack(best, u);
  residuals_of(problem, u, best, nullptr)(p, r, J);
  const auto solved =
      numerics::least_squares(numerics::by_rows(J, m), static_cast<int>(n), r, 1e-7);
  if (solved.inverse_gram.empty()) {
    fit.message = "the readings do not tell runout and coefficients apart";
    return;
  }
  // What the means scatter about the model and the readings about their means (E-19).
  const double sum =
      static_cast<double>(readings) * fit.rms * fit.rms / (error_scale * error_scale);
  const int freedom = static_cast<int>(readings) - static_cast<int>(n);
  const double s2 = freedom > 0 ? sum / freedom : 0.0;
  const auto G = [&](std::size_t i, std::size_t k) {
    return s2 * solved.inverse_gram[i * n + k];
  };
  const double c = best.runout.c / error_scale;
  const double s = best.runout.s / error_scale;
  const double rho2 = std::max(c * c + s * s, 1e-30);
  const double along = (c * c * G(0, 0) + 2 * c * s * G(0, 1) + s * s * G(1, 1)) / rho2;
  const double across =
      (s * s * G(0, 0) - 2 * c * s * G(0, 1) + c * c * G(1, 1)) / (rho2 * rho2);
  fit.eccentricity = estimate(error_scale * std::sqrt(rho2),
                              error_scale * error_scale * along, freedom);
  double angle = std::atan2(s, c);
  angle += angle < 0 ? unit::turn : 0.0;
  fit.angle = estimate(angle, across, freedom);
  const std::size_t k = u.start ? 3 : 2;
  if (u.start) {
    fit.start = estimate(best.start, problem.f_z * problem.f_z * G(2, 2), freedom);
  }
  fit.K_tc =
      estimate(best.K[0], coefficient_scale * coefficient_scale * G(k, k), freedom);
  fit.K_rc = estimate(best.K[1],
                      coefficient_scale * coefficient_scale * G(k + 1, k + 1), freedom);
  for (std::size_t d = 0; d < best.datum.size(); ++d) {
    fit.datum.push_back(estimate(
        best.datum[d], error_scale * error_scale * G(k + 2 + d, k + 2 + d), freedom));
  }
  fit.correlation = G(k, k + 1) / std::sqrt(G(k, k) * G(k + 1, k + 1));
  const std::array<std::size_t, 4> place = {0, 1, k, k + 1};
  const std::array<double, 4> unit = {error_scale, error_scale, coefficient_scale,
                                      coefficient_scale};
  for (std::size_t a = 0; a < 4; ++a) {
    for (std::size_t b = 0; b < 4; ++b) {
      fit.covariance[4 * a + b] = unit[a] * unit[b] * G(place[a], place[b]);
    }
  }
  fit.ok = true;
  fit.message.clear();
}

/// Where the search begins: from the fit of the means, without runout.
State start_of(const Setting& setting, const CoefficientFit& means) {
  State about{.K = wall_coefficients(setting.law)};
  about.K[0] = means.K_tc.value;
  about.K[1] = means.K_rc.value;
  for (const Estimate& d : means.datum) {
    about.datum.push_back(d.value);
  }
  return about;
}

/// What a search starts from.
struct Measured {
  const Setting& setting;
  std::span<const Datum> datum;
  const FoldedReadings& folded;
  double scatter;  ///< of the readings, runout left out [m]
};

/// A state near the best, from a sample where that has all that is needed.
State search(const Measured& from, const Problem& problem, const State& about,
             const Unknowns& all) {
  const Sample sample = sample_of(from.folded, problem.model.heights().exact());
  const ToothModel model(from.setting, sample.readings);
  const DatumColumns columns = datum_columns(spots_of(sample.readings), from.datum);
  const bool enough = model.why_no_runout().empty() &&
                      sample.readings.size() > all.count() &&
                      columns.count == problem.columns_of_datum.count;
  const Problem part{model, sample.readings, sample.count, columns, problem.f_z};
  return first_guess(enough ? part : problem, about,
                     std::max(from.scatter, 0.1 * error_scale));
}

}  // namespace

RunoutFit find_runout(const Setting& setting, std::span<const Reading> readings,
                      std::span<const Datum> datum, const ModelFits& found) {
  RunoutFit fit;
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
  const double f_z = setting.setup.cut.f_z;
  const Values ones(readings.size(), 1.0);
  const Problem every{model, readings, ones, datum_part, f_z};
  const State about = start_of(setting, chosen_fit(found));
  fit.rms_without = rms_about(every.errors(about, model.forces({})), readings);
  const FoldedReadings folded = fold_readings(setting, readings, model);
  const ToothModel of_means(setting, folded.means, found.stations);
  const DatumColumns datum_of_means = folded_datum(datum_part, folded);
  const Problem problem{of_means, folded.means, folded.count, datum_of_means, f_z};
  State best = search({setting, datum, folded, fit.rms_without}, problem, about, all);
  const auto fitted = numerics::levenberg_marquardt(
      residuals_of(problem, all, best, nullptr), static_cast<int>(folded.means.size()),
      problem.pack(best, all), {.max_iterations = 30, .parameter_tolerance = 1e-9});
  best = problem.unpack(fitted.p, all, best);
  if (folded.means.size() < readings.size()) {
    best = refined(every, problem, all, best);
  }
  fit.predicted = every.errors(best, model.forces(best.runout));
  fit.rms = rms_about(fit.predicted, readings);
  describe_fit(problem, all, best, readings.size(), fit);
  if (fit.ok &&
      fit.rms > rms_about(predicted_means(found, readings.size()), readings)) {
    fit.ok = false;
    fit.message = "no runout was found that explains the readings better than none";
  }
  if (!fit.ok) {
    fit.predicted.clear();
  }
  return fit;
}

}  // namespace trochoid::surface
