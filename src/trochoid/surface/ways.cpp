#include <trochoid/surface/ways.h>

#include <trochoid/surface/bent_start.h>
#include <trochoid/surface/joint_model.h>

#include <algorithm>
#include <cmath>
#include <memory>

namespace trochoid::surface {

namespace {

using Values = std::vector<double>;

constexpr double um = JointModel::scale;
constexpr double MN_m2 = 1e8;
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

Way joint_way(const Setting& setting, std::span<const Reading> readings,
              const ModelFits& found, const RunoutFit& runout, Feedback feedback) {
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
         bent_starts(setting, readings, feedback, about, size)) {
      starts.push_back(model->pack(state));
    }
  }
  return {[model](std::span<const double> p, std::span<const double> steps) {
            return model->at(p, steps);
          },
          [model](std::span<const double> p) { return model->rebase(p); },
          [model](std::span<const Reading> all, std::span<const double> p) {
            return model->predict(all, p);
          },
          std::move(starts)};
}

Way nominal_way(const Setting& setting, const ModelFits& found, Feedback feedback) {
  auto model = std::make_shared<NominalModel>(setting, found.nominal, found.stations);
  const CoefficientFit& fit = chosen_fit(found);
  const auto at = [model, feedback, rest = wall_coefficients(setting.law)](
                      std::span<const double> p, std::span<const double>) {
    auto K = rest;
    K[0] = MN_m2 * p[0];
    K[1] = MN_m2 * p[1];
    const Prediction there = feedback == Feedback::none
                                 ? model->rigid(K)
                                 : model->with_feedback(K, feedback);
    Values e;
    Values per_K;
    for (std::size_t i = 0; i < there.error.size(); ++i) {
      e.push_back(there.error[i] / um);
      per_K.push_back(there.per_K[i * columns] * MN_m2 / um);
      per_K.push_back(there.per_K[i * columns + 1] * MN_m2 / um);
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
      e[i] = um * means[mean_of[i]];
    }
    return e;
  };
  return {at,
          [](std::span<const double>) { return 0.0; },
          predict,
          {{fit.K_tc.value / MN_m2, fit.K_rc.value / MN_m2}}};
}

RowFit settle(const RowProblem& problem, const Way& way, Values start) {
  constexpr int most_rounds = 6;
  constexpr double negligible = 0.02;  // of the scatter of a reading
  if (way.rebase(start) < 0) {
    return {};
  }
  RowFit fit = fit_rows(problem, way.model, std::move(start));
  for (int k = 0; fit.ok && k < most_rounds; ++k) {
    const double moved = way.rebase(fit.p);
    if (moved < 0) {
      return {};
    }
    if (moved <= negligible * um * std::sqrt(problem.scatter.s2)) {
      break;
    }
    fit = fit_rows(problem, way.model, fit.p);
  }
  return fit;
}

RowFit settle_twice(const RowProblem& problem, const Way& way, RowFit settled) {
  constexpr double aside = 1.5;  // standard errors of K_tc
  constexpr double gain = 0.3;   // of the cost
  constexpr int most_rounds = 3;
  RowFit best = std::move(settled);
  for (int k = 0; best.ok && k < most_rounds; ++k) {
    const std::size_t n = best.p.size();
    const std::size_t width = best.own.size();
    const std::size_t K_tc = n - 2;
    const double before = best.cost;
    const RowFit from = best;
    for (const double side : {-aside, aside}) {
      Values p = from.p;
      for (std::size_t i = 0; i < n; ++i) {
        p[i] += side * from.covariance[i * width + K_tc] /
                std::sqrt(from.covariance[K_tc * width + K_tc]);
      }
      RowFit fit = settle(problem, way, std::move(p));
      if (fit.ok && fit.cost < best.cost) {
        best = std::move(fit);
      }
    }
    if (before - best.cost < gain) {
      break;
    }
  }
  return best;
}

}  // namespace trochoid::surface
