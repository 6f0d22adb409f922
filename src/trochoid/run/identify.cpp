#include <trochoid/results/json.h>
#include <trochoid/run/identify.h>

#include <trochoid/base/units.h>
#include <trochoid/run/chip_answer.h>
#include <trochoid/run/choose_axes.h>
#include <trochoid/run/curve_tables.h>
#include <trochoid/run/fit_answer.h>
#include <trochoid/run/fit_options.h>
#include <trochoid/run/fit_warnings.h>
#include <trochoid/run/fits_table.h>
#include <trochoid/run/likely_causes.h>
#include <trochoid/run/material.h>
#include <trochoid/run/measured_run.h>
#include <trochoid/run/trust.h>
#include <trochoid/signal/axes.h>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace trochoid::run {

namespace {

using Json = nlohmann::ordered_json;
using identification::Fit;

bool is_signed_permutation(const Matrix3& M) {
  for (const auto& row : M) {
    if (std::abs(row[0]) + std::abs(row[1]) + std::abs(row[2]) != 1) {
      return false;
    }
  }
  return true;
}

Json signal_json(const std::vector<MeasuredRun>& runs, const Matrix3& M) {
  Json rpm = Json::array();
  Json rpm_se = Json::array();
  Json stated = Json::array();
  Json files = Json::array();
  Json samples = Json::array();
  for (const MeasuredRun& run : runs) {
    rpm.push_back(unit::in(run.Omega, unit::rpm));
    rpm_se.push_back(run.Omega_se > 0 ? Json(run.Omega_se / unit::rpm) : Json(nullptr));
    stated.push_back(unit::in(run.cut.Omega, unit::rpm));
    files.push_back(run.record.file);
    samples.push_back(run.record.size());
  }
  Json out{{"files", files},
           {"samples", samples},
           {"spindle_rpm", alone_or_list(rpm)},
           {"spindle_rpm_se", alone_or_list(rpm_se)},
           {"stated_rpm", alone_or_list(stated)}};
  if (is_signed_permutation(M)) {
    out["axes"] = signal::axes_names(M);
  } else {
    out["axes"] = nullptr;
    out["matrix"] = M;
  }
  return out;
}

/// The exact model answers where it was asked for, else the one that fits best.
std::size_t chosen_fit(const std::vector<Fit>& fits) {
  std::size_t best = fits.size();
  for (std::size_t i = 0; i < fits.size(); ++i) {
    if (!fits[i].ok) {
      continue;
    }
    if (fits[i].chip.model == chip::Model::trochoidal) {
      return i;
    }
    if (best == fits.size() || fits[i].rms < fits[best].rms) {
      best = i;
    }
  }
  return best;
}

std::vector<base::Table> sweep_tables(const inputs::Case& given,
                                      std::span<const identification::Run> runs,
                                      const std::vector<Fit>& fits,
                                      const Progress& progress) {
  if (!given.identify.sweep) {
    return {};
  }
  const std::vector<double> offsets = base::values(*given.identify.sweep);
  base::Table table{"sweep.csv", {{"offset_um", {}}}};
  for (const double offset : offsets) {
    table.columns[0].values.push_back(unit::in(offset, unit::um));
  }
  for (const Fit& fit : fits) {
    if (!fit.ok) {
      continue;
    }
    progress(fmt::format("sweeping the offset, {}", chip::name_of(fit.chip.model)));
    auto rms = identification::sweep(given.setup, given.law, runs, fit, offsets);
    if (rms.size() == offsets.size()) {
      table.columns.push_back(
          {fmt::format("rms_{}_N", chip::name_of(fit.chip.model)), std::move(rms)});
    }
  }
  if (table.columns.size() == 1) {
    return {};
  }
  return {std::move(table)};
}

void add_curves(const inputs::Case& given, std::span<const identification::Run> runs,
                const std::vector<Fit>& fits, const Fit& chosen,
                results::Answer& answer) {
  std::vector<ComputedForces> computed;
  for (const Fit& fit : fits) {
    if (fit.ok) {
      computed.push_back({std::string(chip::name_of(fit.chip.model)), fit.fitted});
    }
  }
  for (auto& table : curve_tables(runs, computed)) {
    answer.tables.push_back(std::move(table));
  }
  for (auto& table : folded_tables(runs)) {
    answer.tables.push_back(std::move(table));
  }
  force::Setup setup = given.setup;
  setup.chip = chosen.chip;
  setup.runout = chosen.runout;
  answer.tables.push_back(chip_curve(setup, default_height(setup)));
}

results::Answer failed(results::Answer answer, const std::string& why,
                       const Json& result) {
  answer.heading.ok = false;
  answer.heading.message = why;
  answer.short_table += "No answer: " + why + "\n";
  answer.result = results::json_value(result.dump());
  return answer;
}

std::vector<Fit> all_fits(const inputs::Case& given,
                          std::span<const identification::Run> runs,
                          const Progress& progress) {
  std::vector<Fit> fits;
  for (const chip::Model model : given.identify.chip_models) {
    progress(fmt::format("fitting, chip model {}", chip::name_of(model)));
    fits.push_back(identification::identify(given.setup, given.law, runs,
                                            fit_options(given, model)));
  }
  return fits;
}

std::string headline(const Fit& fit, const std::vector<MeasuredRun>& runs) {
  std::size_t samples = 0;
  for (const MeasuredRun& run : runs) {
    samples += run.record.size();
  }
  return fmt::format(
      "Coefficients and runout from {} samples of {} record{}; the {} model leaves "
      "{:.2f} N rms.",
      samples, runs.size(), runs.size() == 1 ? "" : "s", chip::name_of(fit.chip.model),
      fit.rms);
}

void add_causes(const inputs::Case& given, const std::vector<MeasuredRun>& measured,
                const Matrix3& M, const Progress& progress, results::Answer& answer) {
  auto causes = likely_causes(given, measured, M, progress);
  const bool after_verdict = !answer.heading.warnings.empty() &&
                             answer.heading.warnings.front().code == "do_not_use";
  answer.heading.warnings.insert(
      answer.heading.warnings.begin() + (after_verdict ? 1 : 0), causes.begin(),
      causes.end());
}

/// What the reader of the records noted is less urgent than what the fit says.
void put_notes_last(std::vector<base::Warning>& warnings) {
  std::stable_partition(
      warnings.begin(), warnings.end(), [](const base::Warning& warning) {
        return warning.code != "part_of_record" && warning.code != "unit_assumed" &&
               warning.code != "last_row_left_out";
      });
}

/// Warnings, and before everything else whether the numbers may be used at all.
/// @return what speaks against that
std::vector<std::string> judge(const inputs::Case& given, const std::vector<Fit>& fits,
                               const Fit& chosen, results::Answer& answer,
                               Json& result) {
  std::vector<std::string> reasons = reasons_against(chosen);
  result["do_not_use"] = reasons;
  add_fit_warnings(given, fits, chosen, answer.heading.warnings);
  if (!reasons.empty()) {
    const std::string verdict = do_not_use(reasons);
    answer.heading.message = verdict + " " + answer.heading.message;
    answer.short_table += verdict + "\n\n";
    answer.heading.warnings.insert(answer.heading.warnings.begin(),
                                   {"do_not_use", verdict});
  }
  return reasons;
}

/// Below the table of fits: axes and spindle speeds found.
std::string signal_lines(const std::vector<MeasuredRun>& measured,
                         const AxesChoice& axes) {
  std::string text;
  if (axes.ok) {
    const auto names = signal::axes_names(axes.matrix);
    text += fmt::format(
        "axes found: channels read {}, {}, {} (next best {:.2f} times worse)\n",
        names[0], names[1], names[2], axes.next_rms / axes.rms);
  }
  for (const MeasuredRun& run : measured) {
    text += fmt::format("{}: {:.2f} rpm (stated {:g})\n", run.record.file,
                        run.Omega / unit::rpm, run.cut.Omega / unit::rpm);
  }
  return text;
}

}  // namespace

results::Answer identify(const inputs::Case& given, const Progress& progress) {
  results::Answer answer{
      .command = "identify",
      .heading = {.title = given.title, .case_toml = given.as_understood}};
  std::string message;
  progress("reading the measurements");
  const auto measured = measured_runs(given, answer.heading.warnings, message);
  const Json nothing{{"fits", Json::array()}, {"chosen", nullptr}};
  if (measured.empty()) {
    return failed(std::move(answer), message, nothing);
  }
  inputs::Dynamometer dynamometer = given.dynamometer.value_or(inputs::Dynamometer{});
  AxesChoice axes;
  if (dynamometer.automatic) {
    axes = choose_axes(given, measured, progress, answer.heading.warnings);
    if (!axes.ok) {
      if (std::isfinite(axes.rms)) {
        add_causes(given, measured, dynamometer.matrix, progress, answer);
      }
      put_notes_last(answer.heading.warnings);
      return failed(std::move(answer), axes.message, nothing);
    }
    dynamometer.matrix = axes.matrix;
  }
  const auto runs = on_tool(measured, dynamometer.matrix);
  const std::vector<Fit> fits = all_fits(given, runs, progress);
  Json result{{"fits", Json::array()}, {"chosen", nullptr}};
  for (const Fit& fit : fits) {
    result["fits"].push_back(fit_json(fit));
  }
  result["signal"] = signal_json(measured, dynamometer.matrix);
  if (axes.ok) {
    result["signal"]["axes_rms_N"] = axes.rms;
    result["signal"]["axes_next_rms_N"] =
        std::isfinite(axes.next_rms) ? Json(axes.next_rms) : Json(nullptr);
  }
  const std::size_t best = chosen_fit(fits);
  if (best == fits.size()) {
    if (fits.back().rms > 0) {  // equations that could be solved, to no avail
      add_causes(given, measured, dynamometer.matrix, progress, answer);
    }
    put_notes_last(answer.heading.warnings);
    return failed(std::move(answer), fits.back().message, result);
  }
  const Fit& chosen = fits[best];
  result["chosen"] = chip::name_of(chosen.chip.model);
  add_curves(given, runs, fits, chosen, answer);
  for (auto& table : sweep_tables(given, runs, fits, progress)) {
    answer.tables.push_back(std::move(table));
  }
  answer.texts.push_back(
      {"material.toml", material_toml(chosen, given.setup.edge_length)});
  answer.heading.message = headline(chosen, measured);
  if (!judge(given, fits, chosen, answer, result).empty()) {
    add_causes(given, measured, dynamometer.matrix, progress, answer);
  }
  put_notes_last(answer.heading.warnings);
  answer.short_table += fits_table(fits) + signal_lines(measured, axes);
  answer.result = results::json_value(result.dump());
  return answer;
}

}  // namespace trochoid::run
