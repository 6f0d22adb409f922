#include <trochoid/run/fit_answer.h>

#include <trochoid/base/units.h>
#include <trochoid/identification/residuals.h>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include <array>
#include <cmath>

namespace trochoid::run {

namespace {

using Json = nlohmann::ordered_json;
using identification::Estimate;
using identification::Fit;
using identification::RunoutUnknowns;

Json estimate_json(const std::optional<Estimate>& e, double unit) {
  if (!e) {
    return nullptr;
  }
  return {{"value", e->value / unit},
          {"se", e->se / unit},
          {"low", e->low / unit},
          {"high", e->high / unit}};
}

Json optional_json(const std::optional<double>& value, double unit) {
  return value ? Json(*value / unit) : Json(nullptr);
}

Json runout_json(const Fit& fit) {
  if (!fit.ok || !chip::feels_runout(fit.chip.model)) {
    return nullptr;
  }
  Json offsets = Json::array();
  Json errors = Json::array();
  const bool found = fit.options.runout == RunoutUnknowns::offsets;
  for (std::size_t k = 0; k < fit.runout.radial_offsets.size(); ++k) {
    const bool unknown = identification::unidentifiable(fit, "radial_offsets_mm") ||
                         identification::unidentifiable(
                             fit, fmt::format("radial_offsets_mm[{}]", k + 1));
    offsets.push_back(unknown ? Json(nullptr)
                              : Json(unit::in(fit.runout.radial_offsets[k], unit::mm)));
    const bool gauge = found && k == 0 && !unknown;
    errors.push_back(gauge ? Json(0.0)
                           : optional_json(fit.radial_offsets_se[k], unit::mm));
  }
  const bool no_rho = identification::unidentifiable(fit, "eccentricity_mm");
  const bool no_angle = identification::unidentifiable(fit, "angle_deg");
  return {{"radial_offsets_mm", offsets},
          {"radial_offsets_se_mm", errors},
          {"eccentricity_mm",
           no_rho ? Json(nullptr) : Json(unit::in(fit.runout.eccentricity, unit::mm))},
          {"eccentricity_se_mm", optional_json(fit.eccentricity_se, unit::mm)},
          {"angle_deg",
           no_angle ? Json(nullptr) : Json(unit::in(fit.runout.angle, unit::deg))},
          {"angle_se_deg", optional_json(fit.angle_se, unit::deg)}};
}

Json phases_json(const Fit& fit) {
  Json phases = Json::array();
  for (std::size_t r = 0; r < fit.phase.size(); ++r) {
    const bool unknown =
        identification::unidentifiable(fit, "phase_deg") ||
        identification::unidentifiable(fit, fmt::format("phase_deg[{}]", r + 1));
    phases.push_back(unknown ? Json(nullptr) : Json(unit::in(fit.phase[r], unit::deg)));
  }
  return phases;
}

Json channel_offsets_json(const Fit& fit) {
  Json runs = Json::array();
  for (std::size_t r = 0; r < fit.channel_offsets.size(); ++r) {
    Json channels = Json::array();
    for (std::size_t q = 0; q < 3; ++q) {
      const auto known = [&](const char* what, double value) {
        const auto name = fmt::format("{} of channel {} in run {}", what, q + 1, r + 1);
        return identification::unidentifiable(fit, name) ? Json(nullptr) : Json(value);
      };
      const auto& c = fit.channel_offsets[r][q];
      channels.push_back({{"constant_N", known("offset", c.constant)},
                          {"slope_N", known("drift", c.slope)}});
    }
    runs.push_back(channels);
  }
  return runs;
}

}  // namespace

Json alone_or_list(const Json& list) {
  return list.size() == 1 ? list.front() : list;
}

Json fit_json(const Fit& fit) {
  Json out{{"chip_model", chip::name_of(fit.chip.model)},
           {"lookback", chip::name_of(fit.chip.lookback)},
           {"ok", fit.ok},
           {"message", fit.message}};
  Json K;
  Json identifiable;
  const auto names = force::coefficient_quantities(fit.law);
  for (std::size_t q = 0; q < names.size(); ++q) {
    const std::string key(names[q].key);
    K[key] = q < fit.coefficients.size() && fit.ok
                 ? estimate_json(fit.coefficients[q], names[q].unit)
                 : Json(nullptr);
    identifiable[key] = !K[key].is_null();
  }
  const auto exponents = force::exponent_quantities(fit.law);
  for (std::size_t q = 0; q < fit.exponents.size(); ++q) {
    K[std::string(exponents[q].key)] = estimate_json(fit.exponents[q], 1.0);
  }
  for (const auto& [what, why] : fit.unidentifiable) {
    identifiable[what] = why;
  }
  out["coefficients"] = K;
  out["runout"] = runout_json(fit);
  out["phase_deg"] = alone_or_list(phases_json(fit));
  Json phase_se = Json::array();
  for (const auto& se : fit.phase_se) {
    phase_se.push_back(optional_json(se, unit::deg));
  }
  out["phase_se_deg"] = alone_or_list(phase_se);
  if (!fit.channel_offsets.empty()) {
    out["channel_offsets"] = channel_offsets_json(fit);
  }
  out["rms_N"] = fit.ok ? Json(fit.rms) : Json(nullptr);
  out["rms_axis_N"] = fit.ok ? Json(fit.rms_axis) : Json(nullptr);
  out["rms_meaning"] =
      "square root of the mean over samples of |dF|^2, and of dF_q^2 per axis";
  const bool solved = fit.rank > 0;  // a refusal may come before the equations
  out["condition"] = solved ? Json(fit.condition) : Json(nullptr);
  out["rank"] = solved ? Json(fit.rank) : Json(nullptr);
  const auto number = [&](double value) {
    return fit.ok ? Json(value) : Json(nullptr);
  };
  out["degrees_of_freedom"] = number(fit.freedom);
  out["interval_factor"] = number(fit.interval_factor);
  out["residual_correlation"] = number(fit.residual_correlation);
  out["se_correlation_factor"] =
      number(identification::correlation_factor(fit.residual_correlation));
  out["unexplained_in_band"] = number(fit.unexplained.in_band);
  out["unexplained"] = number(fit.unexplained.all);
  out["outside_band"] = number(fit.unexplained.outside);
  out["identifiable"] = identifiable;
  return out;
}

}  // namespace trochoid::run
