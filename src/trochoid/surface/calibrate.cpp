#include <trochoid/surface/calibrate.h>

#include <trochoid/numerics/least_squares.h>
#include <trochoid/surface/datum.h>
#include <trochoid/surface/fit_nominal.h>

#include <algorithm>
#include <cmath>

namespace trochoid::surface {

namespace {

/// Readings that an advice is about.
constexpr double more_readings = 10;
constexpr int candidates = 19;

Answer named(Answer answer, Model model, Feedback feedback) {
  answer.model = model;
  answer.feedback = feedback;
  return answer;
}

std::array<double, columns> start_at(const Answer& answer,
                                     std::array<double, columns> K) {
  if (answer.ok) {
    K[0] = answer.K_tc.value;
    K[1] = answer.K_rc.value;
  }
  return K;
}

/// The same places at another height.
std::vector<Nominal> candidates_at(double height, std::span<const Nominal> nominal,
                                   Model model) {
  std::vector<Nominal> rows;
  for (const Nominal& n : nominal) {
    const bool known = std::any_of(rows.begin(), rows.end(), [&](const Nominal& row) {
      return model != Model::quasi_static || row.travel == n.travel;
    });
    if (!known) {
      rows.push_back(n);
      rows.back().height = height;
    }
  }
  return rows;
}

std::vector<Advice> advice_for(const Setting& setting, const Answer& answer,
                               const NominalFit& fit, const Prediction& at) {
  const double a_p = setting.setup.cut.a_p;
  std::vector<Nominal> rows;
  for (int i = 0; i < candidates; ++i) {
    const auto more =
        candidates_at(a_p * (i + 1) / (candidates + 1), fit.nominal, setting.model);
    rows.insert(rows.end(), more.begin(), more.end());
  }
  const std::size_t each = rows.size() / candidates;
  const std::array<double, columns> K = start_at(answer, fit.K);
  const Prediction there = NominalModel(setting, rows).rigid(K);
  const std::vector<double> D = weighted_columns(fit, at);
  const std::size_t n = 2 + answer.datum.size();
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
        more.push_back(fit.datum.front().offset && c == 2 ? w : 0.0);
      }
    }
    const std::vector<double> b(more.size() / n);
    const auto solved = numerics::least_squares(more, static_cast<int>(n), b, 1e-12);
    if (!solved.inverse_gram.empty()) {
      advice.push_back({rows[i * each].height,
                        answer.noise * std::sqrt(solved.inverse_gram[0]),
                        answer.noise * std::sqrt(solved.inverse_gram[n + 1])});
    }
  }
  std::sort(advice.begin(), advice.end(),
            [](const Advice& a, const Advice& b) { return a.se_K_tc < b.se_K_tc; });
  return advice;
}

}  // namespace

Calibration calibrate(const Setting& setting, std::span<const Reading> readings,
                      std::span<const Datum> datum, Feedback feedback) {
  Calibration result;
  result.nominal = nominal_errors(readings, setting.model, setting.setup.cut.f_z,
                                  setting.setup.cutter.teeth());
  NominalFit fit{result.nominal, datum, wall_coefficients(setting.law)};
  fit.K[0] = 0.0;
  fit.K[1] = 0.0;
  Setting linear_setting = setting;
  if (setting.model == Model::envelope) {
    linear_setting.model = Model::imprint;
  }
  result.stations = NominalModel::stations_for(setting, result.nominal);
  const NominalModel linear(linear_setting, result.nominal, result.stations);
  const auto add = [&](const NominalModel& model, Model name, Feedback with) {
    const auto predict = [&](std::span<const double, columns> K) {
      return with == Feedback::none ? model.rigid(K) : model.bent(K, with);
    };
    result.answers.push_back(named(fit_nominal(fit, predict), name, with));
    if (name == setting.model && with == feedback) {
      result.chosen = result.answers.size() - 1;
    }
    fit.K = start_at(result.answers.back(), fit.K);
  };
  const Feedback bent = feedback == Feedback::none ? Feedback::entry : feedback;
  add(linear, linear_setting.model, Feedback::none);
  if (!result.answers.front().ok) {
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
  add(setting.model == Model::envelope ? rigorous : linear, setting.model, bent);
  const Answer& answer = result.answers[result.chosen];
  if (answer.ok) {
    const NominalModel& model = setting.model == Model::envelope ? rigorous : linear;
    result.advice =
        advice_for(setting, answer, fit, model.rigid(start_at(answer, fit.K)));
  }
  return result;
}

}  // namespace trochoid::surface
