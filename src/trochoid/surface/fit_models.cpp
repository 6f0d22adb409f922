#include <trochoid/surface/fit_models.h>

#include <trochoid/numerics/least_squares.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace trochoid::surface {

namespace {

/// Readings that advice is about.
constexpr double more_readings = 10;
constexpr int candidates = 19;

CoefficientFit named(CoefficientFit fit, Model model, Feedback feedback) {
  fit.model = model;
  fit.feedback = feedback;
  return fit;
}

std::array<double, columns> start_at(const CoefficientFit& fit,
                                     std::array<double, columns> K) {
  if (fit.ok) {
    K[0] = fit.K_tc.value;
    K[1] = fit.K_rc.value;
  }
  return K;
}

/// The same places at another height; of very many angles of pulses, some.
std::vector<Nominal> candidates_at(double height, std::span<const Nominal> nominal,
                                   Model model) {
  constexpr std::size_t most_angles = 100;
  std::map<double, const Nominal*> angles;
  for (const Nominal& n : nominal) {
    angles.try_emplace(model == Model::quasi_static ? n.travel : 0.0, &n);
  }
  const std::size_t every = (angles.size() + most_angles - 1) / most_angles;
  std::vector<Nominal> rows;
  std::size_t count = 0;
  for (const auto& [angle, place] : angles) {
    if (count++ % every == 0) {
      rows.push_back({.x = place->x,
                      .travel = place->travel,
                      .height = height,
                      .set = place->set,
                      .readings = {}});
    }
  }
  return rows;
}

std::vector<Advice> advice_for(const Setting& setting, const CoefficientFit& fit,
                               const NominalProblem& problem, const Prediction& at) {
  const double a_p = setting.setup.cut.a_p;
  std::vector<Nominal> rows;
  for (int i = 0; i < candidates; ++i) {
    const auto more =
        candidates_at(a_p * (i + 1) / (candidates + 1), problem.nominal, setting.model);
    rows.insert(rows.end(), more.begin(), more.end());
  }
  const std::size_t each = rows.size() / candidates;
  const std::array<double, columns> K = start_at(fit, problem.K);
  const Prediction there = NominalModel(setting, rows).rigid(K);
  const std::vector<double> D = weighted_columns(problem, at);
  const std::size_t n = 2 + fit.datum.size();
  std::vector<Advice> advice;
  for (std::size_t i = 0; i < candidates; ++i) {
    std::vector<double> more = D;
    for (std::size_t k = 0; k < each; ++k) {
      const double w = std::sqrt(more_readings / static_cast<double>(each));
      const double* per_K = there.per_K.data() + (i * each + k) * columns;
      more.push_back(w * per_K[0]);
      more.push_back(w * per_K[1]);
      // An offset moves the new readings as well; slopes are left as they are.
      for (std::size_t c = 2; c < n; ++c) {
        more.push_back(problem.datum.front().offset && c == 2 ? w : 0.0);
      }
    }
    const std::vector<double> b(more.size() / n);
    const auto solved = numerics::least_squares(more, static_cast<int>(n), b, 1e-12);
    if (!solved.inverse_gram.empty()) {
      advice.push_back({rows[i * each].height,
                        fit.noise * std::sqrt(solved.inverse_gram[0]),
                        fit.noise * std::sqrt(solved.inverse_gram[n + 1])});
    }
  }
  std::sort(advice.begin(), advice.end(),
            [](const Advice& a, const Advice& b) { return a.se_K_tc < b.se_K_tc; });
  return advice;
}

}  // namespace

ModelFits fit_models(const Setting& setting, std::span<const Reading> readings,
                     std::span<const Datum> datum, Feedback feedback) {
  ModelFits result;
  result.nominal = nominal_errors(readings, setting.model, setting.setup.cut.f_z,
                                  setting.setup.cutter.teeth());
  NominalProblem problem{result.nominal, datum, wall_coefficients(setting.law)};
  problem.K[0] = 0.0;
  problem.K[1] = 0.0;
  Setting linear_setting = setting;
  if (setting.model == Model::envelope) {
    linear_setting.model = Model::imprint;
  }
  result.stations = NominalModel::stations_for(setting, result.nominal);
  const NominalModel linear(linear_setting, result.nominal, result.stations);
  const auto add = [&](const NominalModel& model, Model name, Feedback with) {
    const auto predict = [&](std::span<const double, columns> K) {
      return with == Feedback::none ? model.rigid(K) : model.with_feedback(K, with);
    };
    result.fits.push_back(named(fit_nominal(problem, predict), name, with));
    if (name == setting.model && with == feedback) {
      result.chosen = result.fits.size() - 1;
    }
    problem.K = start_at(result.fits.back(), problem.K);
  };
  const Feedback last = feedback == Feedback::none ? Feedback::entry : feedback;
  add(linear, linear_setting.model, Feedback::none);
  if (!result.fits.front().ok) {
    return result;
  }
  Setting finest = linear_setting;
  if (setting.model != Model::quasi_static) {
    finest.model = Model::envelope;
  }
  const NominalModel rigorous(finest, result.nominal, result.stations);
  if (setting.model != Model::quasi_static) {
    add(rigorous, Model::envelope, Feedback::none);
  }
  add(setting.model == Model::envelope ? rigorous : linear, setting.model, last);
  const CoefficientFit& fit = chosen_fit(result);
  if (fit.ok) {
    const NominalModel& model = setting.model == Model::envelope ? rigorous : linear;
    result.advice =
        advice_for(setting, fit, problem, model.rigid(start_at(fit, problem.K)));
  }
  return result;
}

std::vector<double> predicted_means(const ModelFits& models, std::size_t count) {
  std::vector<double> predicted(count);
  for (std::size_t i = 0; i < models.nominal.size(); ++i) {
    for (const std::size_t k : models.nominal[i].readings) {
      predicted[k] = chosen_fit(models).predicted[i];
    }
  }
  return predicted;
}

}  // namespace trochoid::surface
