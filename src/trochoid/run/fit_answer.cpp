#include <trochoid/run/fit_answer.h>

#include <trochoid/base/units.h>
#include <trochoid/run/coefficient_names.h>

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
  if (!fit.ok || fit.chip.model == chip::Model::none) {
    return nullptr;
  }
  Json offsets = Json::array();
  Json errors = Json::array();
  const bool found = fit.options.runout == RunoutUnknowns::offsets;
  for (std::size_t k = 0; k < fit.runout.radial_offsets.size(); ++k) {
    const bool unknown =
        unidentifiable(fit, "radial_offsets_mm") ||
        unidentifiable(fit, fmt::format("radial_offsets_mm[{}]", k + 1));
    offsets.push_back(unknown ? Json(nullptr)
                              : Json(unit::in(fit.runout.radial_offsets[k], unit::mm)));
    const bool gauge = found && k == 0 && !unknown;
    errors.push_back(gauge ? Json(0.0)
                           : optional_json(fit.radial_offsets_se[k], unit::mm));
  }
  const bool no_rho = unidentifiable(fit, "eccentricity_mm");
  const bool no_angle = unidentifiable(fit, "angle_deg");
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
    const bool unknown = unidentifiable(fit, "phase_deg") ||
                         unidentifiable(fit, fmt::format("phase_deg[{}]", r + 1));
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
        return unidentifiable(fit, name) ? Json(nullptr) : Json(value);
      };
      const auto& c = fit.channel_offsets[r][q];
      channels.push_back({{"constant_N", known("offset", c.constant)},
                          {"slope_N", known("drift", c.slope)}});
    }
    runs.push_back(channels);
  }
  return runs;
}

std::string cell(const std::optional<Estimate>& e, double unit) {
  if (!e) {
    return "not identifiable";
  }
  return fmt::format("{:.5g} +- {:.2g}", e->value / unit, e->se / unit);
}

std::string offsets_text(const Fit& fit) {
  if (!fit.ok || fit.chip.model == chip::Model::none) {
    return "-";
  }
  std::string text;
  for (std::size_t k = 1; k < fit.runout.radial_offsets.size(); ++k) {
    const auto& se = fit.radial_offsets_se[k];
    text += k > 1 ? ", " : "";
    text += fmt::format("{:.2f}", fit.runout.radial_offsets[k] / unit::um);
    text += se ? fmt::format(" +- {:.2f}", *se / unit::um) : "";
  }
  return text.empty() ? "-" : text;
}

std::string eccentricity_text(const Fit& fit) {
  if (!fit.ok || fit.chip.model == chip::Model::none ||
      unidentifiable(fit, "eccentricity_mm")) {
    return "-";
  }
  return fmt::format("{:.2f} at {:.0f} deg", fit.runout.eccentricity / unit::um,
                     unit::in(fit.runout.angle, unit::deg));
}

}  // namespace

const char* model_name(chip::Model model) {
  switch (model) {
    case chip::Model::none:
      return "none";
    case chip::Model::feed:
      return "feed";
    case chip::Model::radial:
      return "radial";
    case chip::Model::trochoidal:
      return "trochoidal";
  }
  return "";
}

Json alone_or_list(const Json& list) {
  return list.size() == 1 ? list.front() : list;
}

Json fit_json(const Fit& fit) {
  Json out{{"chip_model", model_name(fit.chip.model)},
           {"lookback", fit.chip.lookback == chip::Lookback::all ? "all" : "previous"},
           {"ok", fit.ok},
           {"message", fit.message}};
  Json K;
  Json identifiable;
  const auto names = coefficient_names(fit.law);
  for (std::size_t q = 0; q < names.size(); ++q) {
    K[names[q].key] = q < fit.coefficients.size() && fit.ok
                          ? estimate_json(fit.coefficients[q], names[q].unit)
                          : Json(nullptr);
    identifiable[names[q].key] = !K[names[q].key].is_null();
  }
  for (std::size_t q = 0; q < fit.exponents.size(); ++q) {
    K[exponent_names[q]] = estimate_json(fit.exponents[q], 1.0);
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
  out["degrees_of_freedom"] = fit.ok ? Json(fit.freedom) : Json(nullptr);
  out["residual_correlation"] = fit.ok ? Json(fit.residual_correlation) : Json(nullptr);
  out["identifiable"] = identifiable;
  return out;
}

std::string fits_table(std::span<const Fit> fits) {
  std::string text = fmt::format("{:<24}", "chip model");
  for (const Fit& fit : fits) {
    text += fmt::format("{:>20}", model_name(fit.chip.model));
  }
  text += '\n';
  const auto row = [&](const char* name, const auto& value) {
    text += fmt::format("{:<24}", name);
    for (const Fit& fit : fits) {
      text += fmt::format("{:>20}", fit.ok ? value(fit) : std::string("-"));
    }
    text += '\n';
  };
  const auto names = coefficient_names(fits.front().law);
  for (std::size_t q = 0; q < names.size(); ++q) {
    row(names[q].key,
        [&](const Fit& fit) { return cell(fit.coefficients[q], names[q].unit); });
  }
  for (std::size_t q = 0; q < fits.front().exponents.size(); ++q) {
    row(exponent_names[q], [&](const Fit& fit) { return cell(fit.exponents[q], 1.0); });
  }
  if (fits.front().options.runout == RunoutUnknowns::eccentricity) {
    row("eccentricity_um", eccentricity_text);
  } else {
    row("radial_offsets_um[2..]", offsets_text);
  }
  row("phase_deg", [](const Fit& fit) {
    std::string phases;
    for (const Json& phase : phases_json(fit)) {
      phases += phases.empty() ? "" : ", ";
      phases += phase.is_null() ? "?" : fmt::format("{:.2f}", phase.get<double>());
    }
    return phases;
  });
  row("rms_N", [](const Fit& fit) { return fmt::format("{:.3f}", fit.rms); });
  row("condition", [](const Fit& fit) {
    return fit.condition < 1e8 ? fmt::format("{:.1f}", fit.condition)
                               : std::string("rank deficient");
  });
  return text;
}

}  // namespace trochoid::run
