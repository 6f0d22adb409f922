#include <trochoid/results/modes.h>

#include <trochoid/base/estimate.h>
#include <trochoid/base/units.h>
#include <trochoid/results/joint.h>

#include <fmt/core.h>

#include <algorithm>
#include <complex>
#include <limits>
#include <utility>

namespace trochoid::results {

namespace {

using base::add_column;
using structure::FittedMode;
using structure::ModesFit;

/// fitted.csv: the lines of the response as measured and as fitted.
base::Table fitted_table(const ModesResult& r) {
  base::Table table{"fitted.csv", {}};
  const ModesFit& fit = r.fit;
  const std::size_t n = fit.omega.size();
  add_column(table, "frequency_Hz", n,
             [&](std::size_t i) { return unit::in(fit.omega[i], unit::Hz); });
  const auto add = [&](const char* what, const std::vector<std::complex<double>>& H) {
    const std::string_view suffix = unit_suffix(r.kind);
    add_column(table, fmt::format("{}re_{}", what, suffix), n,
               [&](std::size_t i) { return H[i].real(); });
    add_column(table, fmt::format("{}im_{}", what, suffix), n,
               [&](std::size_t i) { return H[i].imag(); });
  };
  add("", fit.H);
  if (fit.ok) {
    add("fitted_", fit.fitted);
  }
  const std::vector<double> mif =
      structure::mode_indicator({.kind = r.kind, .omega = fit.omega, .H = fit.H});
  add_column(table, "mode_indicator", n, [&](std::size_t i) { return mif[i]; });
  return table;
}

/// stabilisation.csv: poles of rising order, and how they stand.
base::Table stabilisation_table(const ModesResult& r) {
  base::Table table{"stabilisation.csv", {}};
  const std::size_t n = r.poles.size();
  add_column(table, "order", n,
             [&](std::size_t i) { return static_cast<double>(r.poles[i].order); });
  add_column(table, "frequency_Hz", n,
             [&](std::size_t i) { return unit::in(r.poles[i].omega, unit::Hz); });
  add_column(table, "damping_ratio", n, [&](std::size_t i) { return r.poles[i].zeta; });
  add_column(table, "standing", n,
             [&](std::size_t i) { return static_cast<double>(r.poles[i].standing); });
  return table;
}

Object mode_value(const FittedMode& m) {
  return {{"frequency_Hz", m.omega / unit::Hz},
          {"damping_ratio", m.zeta},
          {"mass_kg", m.mode.mass},
          {"stiffness_N_per_m", m.mode.stiffness},
          {"damping_Ns_per_m", m.mode.damping},
          {"se", Object{{"frequency_Hz", m.omega_se / unit::Hz},
                        {"damping_ratio", m.zeta_se},
                        {"mass_kg", m.mass_se},
                        {"stiffness_N_per_m", m.stiffness_se},
                        {"damping_Ns_per_m", m.damping_se}}},
          {"lines_in_peak", m.lines_in_peak}};
}

Value modes_value(const ModesFit& fit) {
  if (!fit.ok) {
    return nullptr;
  }
  Array modes;
  for (const FittedMode& mode : fit.modes) {
    modes.emplace_back(mode_value(mode));
  }
  return modes;
}

/// What modes.toml holds, with its covariance.
Joint joint_of(const ModesResult& r) {
  Joint joint;
  std::vector<double> units;
  for (const FittedMode& m : r.fit.modes) {
    joint.modes.push_back({std::string(name_of(r.body)), std::string(name_of(r.axis))});
    const auto key = [&](const char* what) {
      return fmt::format("mode[{}].{}", joint.modes.size(), what);
    };
    add_found(joint, key("frequency_Hz"), m.omega / unit::Hz);
    add_found(joint, key("damping_ratio"), m.zeta);
    add_found(joint, key("mass_kg"), m.mode.mass);
    units.insert(units.end(), {unit::Hz, 1.0, 1.0});
  }
  set_covariance(joint, r.fit.covariance, units);
  return joint;
}

Value residual_terms_value(const ModesFit& fit) {
  if (!fit.residual_terms) {
    return nullptr;
  }
  return Object{{"above_m_per_N", fit.residual[0]}, {"below_per_kg", fit.residual[1]}};
}

/// Resonances that the fit holds and that are no answer, with what is missing.
Array unresolved_value(const ModesFit& fit) {
  Array out;
  for (std::size_t i = 0; i < fit.unresolved.size(); ++i) {
    out.emplace_back(
        Object{{"frequency_Hz", unit::in(fit.unresolved[i].omega, unit::Hz)},
               {"why", fit.left_out[i]}});
  }
  return out;
}

/// The numbers of modes that were tried: the evidence for each, less being better.
Array orders_value(const ModesFit& fit) {
  Array orders;
  double least = std::numeric_limits<double>::infinity();
  for (const structure::ModesOrder& order : fit.orders) {
    least = std::min(least, order.criterion);
  }
  for (const structure::ModesOrder& order : fit.orders) {
    Array frequencies;
    Array dampings;
    for (const auto& [omega, zeta] : order.modes) {
      frequencies.emplace_back(unit::in(omega, unit::Hz));
      dampings.emplace_back(zeta);
    }
    orders.emplace_back(
        Object{{"modes", order.count},
               {"residual_terms", order.residual_terms},
               {"criterion", order.criterion - least},
               {"frequencies_Hz", std::move(frequencies)},
               {"damping_ratios", std::move(dampings)},
               {"fault", order.fault.empty() ? Value(nullptr) : Value(order.fault)}});
  }
  return orders;
}

/// The blows of a record, and why some of them are left out.
Array hits_value(const signal::TapResponse& tap) {
  Array hits;
  for (const signal::TapHit& hit : tap.hits) {
    hits.emplace_back(
        Object{{"time_s", hit.time},
               {"peak_N", hit.peak},
               {"left_out", hit.fault.empty() ? Value(nullptr) : Value(hit.fault)}});
  }
  return hits;
}

/// response.csv: what the blows gave, with its coherence.
base::Table response_table(const ModesResult& r) {
  base::Table table{"response.csv", {}};
  const signal::TapResponse& tap = *r.tap;
  const std::size_t n = tap.omega.size();
  const std::string_view suffix = unit_suffix(r.kind);
  add_column(table, "frequency_Hz", n,
             [&](std::size_t i) { return unit::in(tap.omega[i], unit::Hz); });
  add_column(table, fmt::format("re_{}", suffix), n,
             [&](std::size_t i) { return tap.H[i].real(); });
  add_column(table, fmt::format("im_{}", suffix), n,
             [&](std::size_t i) { return tap.H[i].imag(); });
  if (!tap.coherence.empty()) {
    add_column(table, "coherence", n, [&](std::size_t i) { return tap.coherence[i]; });
  }
  return table;
}

Object result_of(const ModesResult& r) {
  const ModesFit& fit = r.fit;
  Object result{{"kind", name_of(r.kind)},
                {"modes", modes_value(fit)},
                {"lines", fit.omega.size()}};
  const auto add = [&](std::string key, Value value) {
    result.push_back({std::move(key), std::move(value)});
  };
  if (!fit.omega.empty()) {
    add("band_Hz", Array{unit::in(fit.omega.front(), unit::Hz),
                         unit::in(fit.omega.back(), unit::Hz)});
  }
  if (fit.ok) {
    add("covariance", joint_value(joint_of(r)));
    add("explained", fit.explained);
    add(fmt::format("rms_{}", unit_suffix(r.kind)), fit.rms);
    add("residual_terms", residual_terms_value(fit));
    Array outside;
    for (const FittedMode& term : fit.outside) {
      outside.emplace_back(unit::in(term.omega, unit::Hz));
    }
    add("terms_outside_Hz", std::move(outside));
    add("noise", Object{{fmt::format("floor_{}", unit_suffix(r.kind)), fit.noise.floor},
                        {"magnitude_percent", 100 * fit.noise.magnitude},
                        {"phase_deg", unit::in(fit.noise.phase, unit::deg)}});
    add("unresolved", unresolved_value(fit));
    add("orders", orders_value(fit));
  }
  if (r.tap) {
    add("hits", hits_value(*r.tap));
    add("block_s", r.tap->block);
    add("window_end", r.tap->window_end);
    add("excited_to_Hz", unit::in(r.tap->excited, unit::Hz));
  }
  if (!r.description.empty()) {
    add("description", r.description);
  }
  return result;
}

std::string modes_toml(const ModesResult& r) {
  std::string text =
      "# Found by trochoid modes. Use it in another case with\n"
      "#   include = \"<this file>\"\n"
      "# or, with others beside it, with\n"
      "#   include = [\"<this file>\", \"<another one>\"]\n"
      "# A list of modes in the case itself replaces those of all files.\n";
  for (const FittedMode& m : r.fit.modes) {
    text += fmt::format(
        "\n[[mode]]  # {:.6g} Hz, damping ratio {:.4g}\n"
        "body = \"{}\"\naxis = \"{}\"\n"
        "mass_kg = {}  # standard error {:.2g}\n"
        "stiffness_N_per_m = {}  # {:.2g}\n"
        "damping_Ns_per_m = {}  # {:.2g}\n",
        m.omega / unit::Hz, m.zeta, name_of(r.body), name_of(r.axis), m.mode.mass,
        m.mass_se, m.mode.stiffness, m.stiffness_se, m.mode.damping, m.damping_se);
  }
  return text;
}

std::string short_table(const ModesResult& r) {
  const ModesFit& fit = r.fit;
  std::string text =
      "mode  frequency [Hz]    damping ratio      mass [kg]          "
      "stiffness [N/m]    damping [N s/m]\n";
  const auto cell = [](double value, double error) {
    return fmt::format("{:.6g} +- {:.2g}", value, base::normal_interval * error);
  };
  for (std::size_t i = 0; i < fit.modes.size(); ++i) {
    const FittedMode& m = fit.modes[i];
    text += fmt::format("{:>4}  {:<16}  {:<17}  {:<17}  {:<17}  {}\n", i + 1,
                        cell(m.omega / unit::Hz, m.omega_se / unit::Hz),
                        cell(m.zeta, m.zeta_se), cell(m.mode.mass, m.mass_se),
                        cell(m.mode.stiffness, m.stiffness_se),
                        cell(m.mode.damping, m.damping_se));
  }
  text += fmt::format(
      "(+-: half of a 95 % interval) from {} lines of the {}, {:.4g} to {:.4g} Hz{}\n"
      "the fit explains {:.3f} % of the power and leaves {:.3g} {} (rms)\n",
      fit.omega.size(), name_of(r.kind), fit.omega.front() / unit::Hz,
      fit.omega.back() / unit::Hz,
      fit.residual_terms || !fit.outside.empty()
          ? ", with terms for modes outside of it"
          : "",
      100 * fit.explained, fit.rms, unit_of(r.kind));
  const structure::ResponseNoise& noise = fit.noise;
  text += fmt::format("noise: a floor of {:.3g} {}", noise.floor, unit_of(r.kind));
  if (noise.magnitude > 0 || noise.phase > 0) {
    text += fmt::format(" and {:.2g} % of the magnitude, {:.2g} deg of phase",
                        100 * noise.magnitude, unit::in(noise.phase, unit::deg));
  }
  return text + "\n";
}

}  // namespace

Answer answer_of(const ModesResult& r) {
  Answer answer{.command = "modes",
                .heading = r.heading,
                .result = result_of(r),
                .tables = {fitted_table(r)}};
  if (r.tap && !r.tap->omega.empty()) {
    answer.tables.push_back(response_table(r));
  }
  if (!r.poles.empty()) {
    answer.tables.push_back(stabilisation_table(r));
  }
  if (r.fit.ok) {
    answer.short_table = short_table(r);
    answer.texts.push_back({"modes.toml", modes_toml(r)});
  }
  return answer;
}

}  // namespace trochoid::results
