#include <trochoid/run/calibration_answer.h>

#include <trochoid/base/units.h>
#include <trochoid/force/forces.h>
#include <trochoid/run/wall/setting.h>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include <cmath>

namespace trochoid::run {

namespace {

using Json = nlohmann::ordered_json;
using surface::CoefficientFit;
using surface::Estimate;

/// null where a number is not known.
Json number(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

Json estimate_json(const Estimate& e, double unit) {
  return {{"value", number(e.value / unit)},
          {"se", number(e.se / unit)},
          {"low", number(e.low / unit)},
          {"high", number(e.high / unit)}};
}

Json coefficients_json(const inputs::Case& given, const Estimate& K_tc,
                       const Estimate& K_rc, bool known) {
  const auto names = force::coefficient_quantities(given.law);
  if (!known) {
    return {{std::string(names[0].key), nullptr}, {std::string(names[1].key), nullptr}};
  }
  return {{std::string(names[0].key), estimate_json(K_tc, names[0].unit)},
          {std::string(names[1].key), estimate_json(K_rc, names[1].unit)}};
}

Json answer_json(const inputs::Case& given, const CoefficientFit& answer) {
  Json json{
      {"model", surface::name_of(answer.model)},
      {"feedback", surface::name_of(answer.feedback)},
      {"coefficients", coefficients_json(given, answer.K_tc, answer.K_rc, answer.ok)},
      {"correlation", answer.ok ? number(answer.correlation) : Json(nullptr)},
      {"rank", answer.rank},
      {"condition", number(answer.condition)},
      {"rms_mm", answer.ok ? number(answer.rms / unit::mm) : Json(nullptr)}};
  if (!answer.ok) {
    json["message"] = answer.message;
  }
  if (answer.known[0] != 0 || answer.known[1] != 0) {
    json["combination"] = {{"K_tc_weight", answer.known[0]},
                           {"K_rc_weight", answer.known[1]},
                           {"value_MPa", estimate_json(answer.combination, unit::MPa)}};
  }
  return json;
}

/// The parameters of each file's datum, in the order in which they were fitted.
Json datum_json(const inputs::Case& given, const std::vector<Estimate>& datum) {
  Json all = Json::array();
  std::size_t k = 0;
  for (const inputs::SurfaceMeasurement& m : given.machine.surface_measurements) {
    Json one = Json::object();
    if (m.datum_offset && k < datum.size()) {
      one["offset_mm"] = estimate_json(datum[k++], unit::mm);
    }
    std::vector<Json> slopes;
    while (m.datum_tilt && k < datum.size() && slopes.size() < 2) {
      slopes.push_back(estimate_json(datum[k++], 1.0));
    }
    if (!slopes.empty()) {
      one["slopes_mm_per_mm"] = slopes;
    }
    all.push_back(one);
  }
  return all;
}

/// `offset_mm` of the first file, and `datum` of all.
void put_datum(const inputs::Case& given, const std::vector<Estimate>& datum,
               Json& result) {
  const bool offset =
      !datum.empty() && given.machine.surface_measurements.front().datum_offset;
  result["offset_mm"] = offset ? number(datum.front().value / unit::mm) : Json(nullptr);
  if (!datum.empty()) {
    result["datum"] = datum_json(given, datum);
  }
}

}  // namespace

bool runout_is_seen(const surface::RunoutFit& runout) {
  constexpr double clearly = 3.0;
  return runout.ok && runout.eccentricity.value > clearly * runout.eccentricity.se;
}

bool runout_counts(const inputs::Case& given, const surface::RunoutFit& runout) {
  return runout_is_seen(runout) &&
         given.machine.surface->model == surface::Model::envelope &&
         given.machine.surface->feedback == surface::Feedback::none;
}

Json calibration_json(const inputs::Case& given,
                      const surface::ModelFits& calibration) {
  const CoefficientFit& chosen =
      calibration.fits[std::min(calibration.chosen, calibration.fits.size() - 1)];
  Json result = answer_json(given, chosen);
  put_datum(given, chosen.ok ? chosen.datum : std::vector<Estimate>{}, result);
  result["noise_mm"] = chosen.ok ? number(chosen.noise / unit::mm) : Json(nullptr);
  result["means"] = calibration.nominal.size();
  Json answers = Json::array();
  for (const CoefficientFit& answer : calibration.fits) {
    answers.push_back(answer_json(given, answer));
  }
  result["answers"] = answers;
  Json advice = Json::array();
  for (const surface::Advice& a : calibration.advice) {
    const auto names = force::coefficient_quantities(given.law);
    advice.push_back({{"height_mm", a.height / unit::mm},
                      {fmt::format("se_{}", names[0].key), a.se_K_tc / names[0].unit},
                      {fmt::format("se_{}", names[1].key), a.se_K_rc / names[1].unit}});
  }
  result["ten_more_readings"] = advice;
  return result;
}

void add_runout(const surface::RunoutFit& runout, const inputs::Case& given,
                Json& result) {
  if (!runout.ok) {
    result["runout"] = {{"eccentricity_mm", nullptr},
                        {"angle_deg", nullptr},
                        {"identifiable", runout.message}};
    return;
  }
  const double pitch = 360.0 / given.setup.cutter.teeth();
  result["runout"] = {
      {"eccentricity_mm", number(runout.eccentricity.value / unit::mm)},
      {"eccentricity_se_mm", number(runout.eccentricity.se / unit::mm)},
      {"angle_deg", number(runout.angle.value / unit::deg)},
      {"angle_se_deg", number(runout.angle.se / unit::deg)},
      {"angle_known_up_to_deg", runout.labelled ? Json(nullptr) : Json(pitch)},
      {"coefficients", coefficients_json(given, runout.K_tc, runout.K_rc, true)},
      {"correlation", number(runout.correlation)},
      {"rms_without_mm", runout.rms_without / unit::mm},
      {"rms_mm", runout.rms / unit::mm}};
  if (given.machine.surface->model == surface::Model::envelope) {
    result["runout"]["turn_begins_mm"] = number(runout.start.value / unit::mm);
  }
  result["with_runout"] = runout_counts(given, runout);
  if (runout_counts(given, runout)) {
    for (const char* key : {"coefficients", "correlation", "rms_mm"}) {
      result[key] = result["runout"][key];
    }
    put_datum(given, runout.datum, result);
  }
}

std::string refusal(const inputs::Case& given, const CoefficientFit& answer) {
  std::string text = answer.message;
  if (answer.rank > 0 && answer.condition > surface::worst_condition) {
    text += fmt::format(
        " (condition {:.3g}; readings at more heights, "
        "or a wall that bends more, would)",
        answer.condition);
  }
  if (answer.known[0] != 0 || answer.known[1] != 0) {
    const auto names = force::coefficient_quantities(given.law);
    text += fmt::format("; what is known: {:.3g} {} + {:.3g} {} = {:.4g} MPa",
                        answer.known[0], names[0].key, answer.known[1], names[1].key,
                        answer.combination.value / unit::MPa);
  }
  return text;
}

std::string calibration_table(const inputs::Case& given,
                              const surface::ModelFits& calibration,
                              const surface::RunoutFit& runout) {
  const auto names = force::coefficient_quantities(given.law);
  std::string text =
      fmt::format("  {:<26} {:>20} {:>20} {:>8} {:>10}\n", "95 %: value +- half width",
                  names[0].key, names[1].key, "corr.", "rms um");
  const auto pair = [](const Estimate& e, double unit) {
    return std::isfinite(e.se) ? fmt::format("{:.1f} +- {:.1f}", e.value / unit,
                                             (e.high - e.low) / 2 / unit)
                               : fmt::format("{:.1f} +- ?", e.value / unit);
  };
  const bool joint = runout_counts(given, runout);
  for (std::size_t i = 0; i < calibration.fits.size(); ++i) {
    const CoefficientFit& a = calibration.fits[i];
    const std::string name =
        fmt::format("{} {}{}", i == calibration.chosen && !joint ? '*' : ' ',
                    surface::name_of(a.model),
                    a.feedback == surface::Feedback::none
                        ? ""
                        : fmt::format(" + {}", surface::name_of(a.feedback)));
    if (!a.ok) {
      text += fmt::format("{:<28} {}\n", name, a.message);
      continue;
    }
    text += fmt::format("{:<28} {:>20} {:>20} {:>8.3f} {:>10.3f}\n", name,
                        pair(a.K_tc, names[0].unit), pair(a.K_rc, names[1].unit),
                        a.correlation, a.rms / unit::um);
  }
  if (!runout.ok) {
    return text + fmt::format("runout: not known: {}\n", runout.message);
  }
  text +=
      fmt::format("{:<28} {:>20} {:>20} {:>8.3f} {:>10.3f}\n",
                  joint ? "* all readings, with runout" : "  all readings, with runout",
                  pair(runout.K_tc, names[0].unit), pair(runout.K_rc, names[1].unit),
                  runout.correlation, runout.rms / unit::um);
  if (!runout_is_seen(runout)) {
    return text + fmt::format("runout {} um: not clearly different from none\n",
                              pair(runout.eccentricity, unit::um));
  }
  text += fmt::format(
      "runout {} um at {} deg{}\n", pair(runout.eccentricity, unit::um),
      pair(runout.angle, unit::deg),
      runout.labelled
          ? ""
          : fmt::format(" (or {:g} deg further: the teeth are not numbered)",
                        360.0 / given.setup.cutter.teeth()));
  return text;
}

std::string calibrated_material(const inputs::Case& given,
                                const surface::ModelFits& calibration,
                                const surface::RunoutFit& runout) {
  const CoefficientFit& chosen = calibration.fits[calibration.chosen];
  const auto names = force::coefficient_quantities(given.law);
  const bool joint = runout_counts(given, runout);
  std::string text = fmt::format(
      "# Found by trochoid calibrate ({}{}). Use it in another case with\n"
      "#   include = \"<this file>\"\n\n[force]\nlaw = \"{}\"\n",
      surface::name_of(chosen.model),
      chosen.feedback == surface::Feedback::none
          ? ""
          : fmt::format(", feedback {}", surface::name_of(chosen.feedback)),
      force::name_of(given.law));
  const std::vector<double> known = force::coefficients(given.law);
  for (std::size_t q = 0; q < names.size(); ++q) {
    if (q < 2) {
      const Estimate& e = joint ? (q == 0 ? runout.K_tc : runout.K_rc)
                                : (q == 0 ? chosen.K_tc : chosen.K_rc);
      text += fmt::format("{} = {}  # standard error {:.3g}\n", names[q].key,
                          e.value / names[q].unit, e.se / names[q].unit);
    } else {
      text += fmt::format("{} = {}  # as given: a wall does not show it\n",
                          names[q].key, unit::in(known[q], names[q].unit));
    }
  }
  const force::Form form = force::form(given.law);
  const auto exponents = force::exponent_quantities(given.law);
  for (std::size_t q = 0; q < exponents.size(); ++q) {
    text += fmt::format("{} = {}\n", exponents[q].key, form.m[q]);
  }
  if (form.edge) {
    text +=
        fmt::format("edge_length = \"{}\"\n", force::name_of(given.setup.edge_length));
  }
  if (!runout_is_seen(runout)) {
    return text + "\n# [runout]: not seen in the readings\n";
  }
  return text +
         fmt::format("\n[runout]\neccentricity_mm = {}\nangle_deg = {}{}\n{}",
                     runout.eccentricity.value / unit::mm,
                     runout.angle.value / unit::deg,
                     runout.labelled ? "" : "  # up to multiples of a pitch",
                     given.setup.runout.order == geometry::EccentricityOrder::first
                         ? "eccentricity_order = \"first\"\n"
                         : "");
}

}  // namespace trochoid::run
