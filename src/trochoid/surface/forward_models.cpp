#include <trochoid/surface/forward_models.h>

#include <trochoid/base/units.h>
#include <trochoid/surface/joint_model.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <span>
#include <vector>

namespace trochoid::surface {
namespace {

/// @brief Runouts from which a fit with feedback may begin: feedback evens out the teeth,
/// so that what fits best without it can lie far off.
///
/// The pattern over a turn is compared, height by height, for runouts all around.
/// @param rows   readings or their means
/// @param about  coefficients to try with
/// @param size   of the runout to try with [m]
/// @return best first
std::vector<JointState> starts_with_feedback(const Setting& setting,
                                             std::span<const Reading> rows,
                                             Feedback feedback, const JointState& about,
                                             double size);

constexpr int angles_per_pitch = 5;
constexpr int starts_per_turn = 12;
constexpr std::size_t most_heights = 6;
constexpr std::size_t enough = 1500;
constexpr std::size_t kept = 3;

/// Rows at a few heights, as if all were taken at one place along the wall.
std::vector<Reading> sample_of(std::span<const Reading> rows) {
  std::map<double, std::size_t> heights;
  double x = 0.0;
  for (const Reading& r : rows) {
    heights.try_emplace(r.height, 0);
    x += r.x / static_cast<double>(rows.size());
  }
  std::size_t rank = 0;
  for (auto& [height, at] : heights) {
    at = rank++;
  }
  const bool scan = 4 * heights.size() > rows.size();
  const std::size_t every =
      scan ? 1 : (heights.size() + most_heights - 1) / most_heights;
  const std::size_t one_of = 1 + rows.size() / every / enough;
  std::vector<Reading> sample;
  std::size_t seen = 0;
  for (const Reading& r : rows) {
    if (heights.at(r.height) % every == 0 && seen++ % one_of == 0) {
      sample.push_back(r);
      sample.back().x = x;
    }
  }
  return sample;
}

/// Sum of squares about the mean of each height: the coefficients matter little then.
double misfit(std::span<const Reading> rows, std::span<const double> e) {
  struct Sums {
    double n = 0.0;
    double sum = 0.0;
    double squares = 0.0;
  };
  std::map<double, Sums> heights;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    Sums& at = heights[rows[i].height];
    const double r = rows[i].error - e[i];
    at.n += 1;
    at.sum += r;
    at.squares += r * r;
  }
  double total = 0.0;
  for (const auto& [height, at] : heights) {
    total += at.squares - at.sum * at.sum / at.n;
  }
  return total;
}

std::vector<JointState> starts_with_feedback(const Setting& setting,
                                             std::span<const Reading> rows,
                                             Feedback feedback, const JointState& about,
                                             double size) {
  const std::vector<Reading> sample = sample_of(rows);
  const ToothModel model(setting, sample);
  const int teeth = setting.setup.cutter.teeth();
  const double feed = teeth * setting.setup.cut.f_z;
  const int angles = model.labelled() ? angles_per_pitch * teeth : angles_per_pitch;
  const double range = model.labelled() ? unit::turn : unit::turn / teeth;
  const int starts = model.has_phase() ? starts_per_turn : 1;
  std::vector<std::pair<double, JointState>> tried;
  for (int a = 0; a < angles; ++a) {
    const double angle = range * a / angles;
    JointState state = about;
    state.runout = {size * std::cos(angle), size * std::sin(angle)};
    const auto forces =
        model.forces_with(feedback, model.forces(state.runout), state.K);
    for (int k = 0; forces.found && k < starts; ++k) {
      state.start = feed * k / starts;
      tried.emplace_back(
          misfit(sample, model.predict(forces, state.K, state.runout, state.start)),
          state);
    }
  }
  std::sort(tried.begin(), tried.end(),
            [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<JointState> best;
  for (std::size_t i = 0; i < std::min(kept, tried.size()); ++i) {
    best.push_back(tried[i].second);
  }
  return best;
}

using Values = std::vector<double>;

constexpr std::size_t coarse_stations = 3;

JointState state_of(const Setting& setting, const RunoutFit& runout) {
  JointState state{.runout = {runout.eccentricity.value * std::cos(runout.angle.value),
                              runout.eccentricity.value * std::sin(runout.angle.value)},
                   .start = runout.start.value,
                   .K = wall_coefficients(setting.law)};
  state.K[0] = runout.K_tc.value;
  state.K[1] = runout.K_rc.value;
  return state;
}

}  // namespace

ForwardModel joint_forward_model(const Setting& setting,
                                 std::span<const Reading> readings,
                                 const ModelFits& found, const RunoutFit& runout,
                                 Feedback feedback) {
  auto model = std::make_shared<JointModel>(
      setting, readings, found.stations,
      feedback == Feedback::none ? found.stations
                                 : stations_for(setting, readings, coarse_stations),
      feedback);
  const JointState about = state_of(setting, runout);
  std::vector<Values> starts = {model->pack(about)};
  if (feedback != Feedback::none) {  // it may have moved the answer far
    const double size = 2 * std::max(runout.rms_without, runout.eccentricity.value);
    for (const JointState& state :
         starts_with_feedback(setting, readings, feedback, about, size)) {
      starts.push_back(model->pack(state));
    }
  }
  return {[model](std::span<const double> p, std::span<const double> steps) {
            return model->at(p, steps);
          },
          [model](std::span<const double> p) { return model->rebase(p); },
          [model](std::span<const double> p) { return model->freeze(p); },
          [model](std::span<const double> p) { return model->exact(p); },
          [model](std::span<const Reading> all, std::span<const double> p) {
            return model->predict(all, p);
          },
          std::move(starts)};
}

ForwardModel nominal_forward_model(const Setting& setting, const ModelFits& found,
                                   Feedback feedback) {
  auto model = std::make_shared<NominalModel>(setting, found.nominal, found.stations);
  const CoefficientFit& fit = chosen_fit(found);
  const auto at = [model, feedback, rest = wall_coefficients(setting.law)](
                      std::span<const double> p, std::span<const double>) {
    auto K = rest;
    K[0] = coefficient_scale * p[0];
    K[1] = coefficient_scale * p[1];
    const Prediction there = feedback == Feedback::none
                                 ? model->rigid(K)
                                 : model->with_feedback(K, feedback);
    Values e;
    Values per_K;
    for (std::size_t i = 0; i < there.error.size(); ++i) {
      e.push_back(there.error[i] / error_scale);
      per_K.push_back(there.per_K[i * columns] * coefficient_scale / error_scale);
      per_K.push_back(there.per_K[i * columns + 1] * coefficient_scale / error_scale);
    }
    return Linearised{.f = std::move(e),
                      .slopes = [per_K = std::move(per_K)] { return per_K; },
                      .good = there.good};
  };
  std::vector<std::size_t> mean_of;
  for (std::size_t i = 0; i < found.nominal.size(); ++i) {
    for (const std::size_t k : found.nominal[i].readings) {
      mean_of.resize(std::max(mean_of.size(), k + 1));
      mean_of[k] = i;
    }
  }
  const auto predict = [at, mean_of](std::span<const Reading> readings,
                                     std::span<const double> p) {
    const Values means = at(p, {}).f;
    Values e(readings.size());
    for (std::size_t i = 0; i < e.size(); ++i) {
      e[i] = error_scale * means[mean_of[i]];
    }
    return e;
  };
  return {at,
          [](std::span<const double>) { return 0.0; },
          [](std::span<const double>) { return true; },
          {},
          predict,
          {{fit.K_tc.value / coefficient_scale, fit.K_rc.value / coefficient_scale}}};
}

RowFit fit_rebased(const RowProblem& problem, const ForwardModel& forward,
                   Values start) {
  constexpr int most_rounds = 6;
  constexpr double negligible = 0.02;  // of the scatter of a reading
  if (forward.rebase(start) < 0) {
    return {};
  }
  RowFit fit = fit_rows(problem, forward.model, std::move(start));
  for (int k = 0; fit.ok && k < most_rounds; ++k) {
    const double moved = forward.rebase(fit.p);
    if (moved < 0) {
      return {};
    }
    if (moved <= negligible * error_scale * std::sqrt(problem.scatter.s2)) {
      break;
    }
    fit = fit_rows(problem, forward.model, fit.p);
  }
  return fit;
}

}  // namespace trochoid::surface
