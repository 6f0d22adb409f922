#include <trochoid/results/json.h>
#include <trochoid/run/modes.h>

#include <trochoid/base/units.h>
#include <trochoid/inputs/frf_file.h>
#include <trochoid/structure/identify_modes.h>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include <array>
#include <cmath>

namespace trochoid::run {

namespace {

using Json = nlohmann::ordered_json;
using structure::FittedMode;
using structure::ModesFit;
using structure::ResponseKind;

constexpr double half_interval = 1.96;  ///< of 95 %, in standard errors
constexpr int few_lines = 5;            ///< between the half-power points
constexpr double poorly_explained = 0.95;
constexpr double loosely_known = 0.1;  ///< relative standard error

/// Name and unit of a kind.
struct KindWords {
  std::string_view name;
  std::string_view unit;    ///< for people
  std::string_view column;  ///< in the names of columns
};

constexpr std::array<KindWords, 3> kinds = {{{"receptance", "m/N", "m_per_N"},
                                             {"mobility", "m/s/N", "m_per_s_N"},
                                             {"accelerance", "m/s^2/N", "m_per_s2_N"}}};

const KindWords& words(ResponseKind kind) {
  return kinds[static_cast<std::size_t>(kind)];
}

structure::ModesOptions options_of(const inputs::FrfTables& frf) {
  structure::ModesOptions options{.count = frf.modes};
  if (frf.residual_terms != inputs::ResidualTerms::choose) {
    options.residual_terms = frf.residual_terms == inputs::ResidualTerms::yes;
  }
  if (frf.band.size() == 2) {
    // A line at the end of the band belongs to it, whatever rounding did to it.
    options.from = frf.band[0] * unit::Hz * (1 - 1e-12);
    options.to = frf.band[1] * unit::Hz * (1 + 1e-12);
  }
  return options;
}

base::Table fitted_table(const ModesFit& fit, ResponseKind kind) {
  const std::string unit(words(kind).column);
  base::Table table{"fitted.csv",
                    {{"frequency_Hz", {}}, {"re_" + unit, {}}, {"im_" + unit, {}}}};
  if (fit.ok) {
    table.columns.push_back({"fitted_re_" + unit, {}});
    table.columns.push_back({"fitted_im_" + unit, {}});
  }
  for (std::size_t i = 0; i < fit.omega.size(); ++i) {
    table.columns[0].values.push_back(unit::in(fit.omega[i], unit::Hz));
    table.columns[1].values.push_back(fit.H[i].real());
    table.columns[2].values.push_back(fit.H[i].imag());
    if (fit.ok) {
      table.columns[3].values.push_back(fit.fitted[i].real());
      table.columns[4].values.push_back(fit.fitted[i].imag());
    }
  }
  return table;
}

Json mode_json(const FittedMode& m) {
  return {{"frequency_Hz", m.omega / unit::Hz},
          {"damping_ratio", m.zeta},
          {"mass_kg", m.mode.mass},
          {"stiffness_N_per_m", m.mode.stiffness},
          {"damping_Ns_per_m", m.mode.damping},
          {"se",
           {{"frequency_Hz", m.omega_se / unit::Hz},
            {"damping_ratio", m.zeta_se},
            {"mass_kg", m.mass_se},
            {"stiffness_N_per_m", m.stiffness_se},
            {"damping_Ns_per_m", m.damping_se}}},
          {"lines_in_peak", m.lines_in_peak}};
}

Json result_of(const ModesFit& fit, ResponseKind kind) {
  Json modes = Json::array();
  for (const FittedMode& mode : fit.modes) {
    modes.push_back(mode_json(mode));
  }
  Json result{{"kind", words(kind).name},
              {"modes", fit.ok ? modes : Json(nullptr)},
              {"lines", fit.omega.size()}};
  if (!fit.omega.empty()) {
    result["band_Hz"] = {unit::in(fit.omega.front(), unit::Hz),
                         unit::in(fit.omega.back(), unit::Hz)};
  }
  if (fit.ok) {
    result["explained"] = fit.explained;
    result[fmt::format("rms_{}", words(kind).column)] = fit.rms;
    result["residual_terms"] = nullptr;
    if (fit.residual_terms) {
      result["residual_terms"] = {{"above_m_per_N", fit.above},
                                  {"below_per_kg", fit.below}};
    }
  }
  return result;
}

void add_warnings(const ModesFit& fit, results::Answer& answer) {
  for (const FittedMode& m : fit.modes) {
    const std::string at = fmt::format("{:.5g} Hz", m.omega / unit::Hz);
    if (m.lines_in_peak < few_lines) {
      answer.heading.warnings.push_back(
          {"few_lines",
           fmt::format("Only {} lines lie between the half-power points of "
                       "the mode at {}: its damping hangs on them. A longer "
                       "record has a finer resolution.",
                       m.lines_in_peak, at)});
    }
    if (m.damping_se > loosely_known * m.mode.damping ||
        m.stiffness_se > loosely_known * m.mode.stiffness) {
      answer.heading.warnings.push_back(
          {"loosely_known",
           fmt::format(
               "The mode at {} is known loosely: stiffness to {:.0f} %, damping "
               "to {:.0f} % (standard errors).",
               at, 100 * m.stiffness_se / m.mode.stiffness,
               100 * m.damping_se / m.mode.damping)});
    }
  }
  if (fit.explained < poorly_explained) {
    answer.heading.warnings.push_back(
        {"poor_fit",
         fmt::format("The modes leave {:.1f} % of the power of the response "
                     "unexplained: look at the fit before using them.",
                     100 * (1 - fit.explained))});
  }
}

std::string modes_toml(const ModesFit& fit, const inputs::FrfTables& frf) {
  constexpr std::string_view axes[] = {"x", "y", "z"};
  std::string text =
      "# Found by trochoid modes. Use it in another case with\n"
      "#   include = \"<this file>\"\n"
      "# A list of modes is replaced whole: put all "
      "modes of a machine into one file.\n";
  for (const FittedMode& m : fit.modes) {
    text += fmt::format(
        "\n[[mode]]  # {:.6g} Hz, damping ratio {:.4g}\n"
        "body = \"{}\"\naxis = \"{}\"\n"
        "mass_kg = {}  # standard error {:.2g}\n"
        "stiffness_N_per_m = {}  # {:.2g}\n"
        "damping_Ns_per_m = {}  # {:.2g}\n",
        m.omega / unit::Hz, m.zeta, inputs::name_of(frf.body),
        axes[static_cast<std::size_t>(frf.axis)], m.mode.mass, m.mass_se,
        m.mode.stiffness, m.stiffness_se, m.mode.damping, m.damping_se);
  }
  return text;
}

std::string short_table(const ModesFit& fit, ResponseKind kind) {
  std::string text =
      "mode  frequency [Hz]    damping ratio      mass [kg]          "
      "stiffness [N/m]    damping [N s/m]\n";
  const auto cell = [](double value, double error) {
    return fmt::format("{:.6g} +- {:.2g}", value, half_interval * error);
  };
  for (std::size_t r = 0; r < fit.modes.size(); ++r) {
    const FittedMode& m = fit.modes[r];
    text += fmt::format("{:>4}  {:<16}  {:<17}  {:<17}  {:<17}  {}\n", r + 1,
                        cell(m.omega / unit::Hz, m.omega_se / unit::Hz),
                        cell(m.zeta, m.zeta_se), cell(m.mode.mass, m.mass_se),
                        cell(m.mode.stiffness, m.stiffness_se),
                        cell(m.mode.damping, m.damping_se));
  }
  text += fmt::format(
      "(+-: half of a 95 % interval) from {} lines of the {}, {:.4g} to {:.4g} Hz{}\n"
      "the fit explains {:.3f} % of the power and leaves {:.3g} {} (rms)\n",
      fit.omega.size(), words(kind).name, fit.omega.front() / unit::Hz,
      fit.omega.back() / unit::Hz,
      fit.residual_terms ? ", with terms for modes outside of it" : "",
      100 * fit.explained, fit.rms, words(kind).unit);
  return text;
}

}  // namespace

inputs::FrfSource frf_source(const inputs::FrfTables& frf) {
  return {.file = frf.file,
          .location = frf.location,
          .kind = frf.kind,
          .dataset = frf.dataset};
}

results::Answer modes(const inputs::Case& given) {
  const inputs::FrfTables& frf = *given.machine.frf;
  results::Answer answer{
      .command = "modes",
      .heading = {.title = given.title, .case_toml = given.as_understood}};
  const inputs::FrfFile file = inputs::read_frf(frf_source(frf));
  const ResponseKind kind = file.response.kind;
  const ModesFit fit = structure::identify_modes(file.response, options_of(frf));
  answer.heading.warnings = file.notes;
  answer.heading.ok = fit.ok;
  answer.tables.push_back(fitted_table(fit, kind));
  Json result = result_of(fit, kind);
  if (!file.description.empty()) {
    result["description"] = file.description;
  }
  answer.result = results::json_value(result.dump());
  if (!fit.ok) {
    answer.heading.message = fit.reason;
    return answer;
  }
  add_warnings(fit, answer);
  answer.short_table = short_table(fit, kind);
  answer.texts.push_back({"modes.toml", modes_toml(fit, frf)});
  answer.heading.message =
      fmt::format("{} mode{} from {} lines.", fit.modes.size(),
                  fit.modes.size() == 1 ? "" : "s", fit.omega.size());
  return answer;
}

}  // namespace trochoid::run
