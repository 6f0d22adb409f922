#include <trochoid/results/fit_value.h>

#include <trochoid/base/units.h>
#include <trochoid/identification/reliability.h>
#include <trochoid/results/estimate_value.h>
#include <trochoid/results/joint_of_fit.h>

#include <fmt/core.h>

#include <algorithm>
#include <array>

namespace trochoid::results {

namespace {

using identification::finds_offsets;
using identification::Fit;
using identification::unidentifiable;

/// A number that may be unknown, as a file has it.
Value known(bool unknown, double value, double unit) {
  return unknown ? Value() : Value(unit::in(value, unit));
}

Value runout_value(const Fit& fit) {
  if (!fit.ok || !chip::feels_runout(fit.chip.model)) {
    return nullptr;
  }
  Array offsets;
  Array errors;
  const bool found = finds_offsets(fit.options.runout);
  for (std::size_t k = 0; k < fit.runout.radial_offsets.size(); ++k) {
    const bool unknown =
        unidentifiable(fit, "radial_offsets_mm") ||
        unidentifiable(fit, fmt::format("radial_offsets_mm[{}]", k + 1));
    offsets.push_back(known(unknown, fit.runout.radial_offsets[k], unit::mm));
    const bool gauge = found && k == 0 && !unknown;
    errors.push_back(gauge ? Value(0.0) : in_unit(fit.radial_offsets_se[k], unit::mm));
  }
  return Object{{"radial_offsets_mm", std::move(offsets)},
                {"radial_offsets_se_mm", std::move(errors)},
                {"eccentricity_mm", known(unidentifiable(fit, "eccentricity_mm"),
                                          fit.runout.eccentricity, unit::mm)},
                {"eccentricity_se_mm", in_unit(fit.eccentricity_se, unit::mm)},
                {"angle_deg",
                 known(unidentifiable(fit, "angle_deg"), fit.runout.angle, unit::deg)},
                {"angle_se_deg", in_unit(fit.angle_se, unit::deg)}};
}

Array phases_value(const Fit& fit) {
  Array phases;
  for (std::size_t r = 0; r < fit.phase.size(); ++r) {
    const bool unknown = unidentifiable(fit, "phase_deg") ||
                         unidentifiable(fit, fmt::format("phase_deg[{}]", r + 1));
    phases.push_back(known(unknown, fit.phase[r], unit::deg));
  }
  return phases;
}

Array channel_offsets_value(const Fit& fit) {
  Array runs;
  for (std::size_t r = 0; r < fit.channel_offsets.size(); ++r) {
    Array channels;
    for (std::size_t q = 0; q < 3; ++q) {
      const auto value = [&](const char* what, double number) {
        const auto name = fmt::format("{} of channel {} in run {}", what, q + 1, r + 1);
        return unidentifiable(fit, name) ? Value() : Value(number);
      };
      const auto& c = fit.channel_offsets[r][q];
      channels.push_back(Object{{"constant_N", value("offset", c.constant)},
                                {"slope_N", value("drift", c.slope)}});
    }
    runs.emplace_back(std::move(channels));
  }
  return runs;
}

/// Harmonics that were fitted; 0: all.
int band_of(const Fit& fit) {
  int band = fit.options.band_harmonics;
  for (const identification::Response& one : fit.options.response) {
    band = band > 0 ? std::min(band, one.highest()) : one.highest();
  }
  return band;
}

/// Of the dynamometer, in the axes of the tool; null where none was found.
Object resonances_value(const Fit& fit) {
  Object out;
  constexpr std::array axes{"x", "y", "z"};
  for (std::size_t q = 0; q < 3; ++q) {
    const auto& one = fit.resonances[q];
    set(out, axes[q],
        one ? Value(Object{{"frequency_Hz", one->omega / unit::turn},
                           {"damping_ratio", one->zeta}})
            : Value());
  }
  return out;
}

/// Coefficients alone, each with its interval.
Object coefficients_value(const identification::Group& group) {
  Object out;
  const auto names = force::coefficient_quantities(group.law);
  for (std::size_t q = 0; q < names.size(); ++q) {
    set(out, names[q].key, estimate_value(group.coefficients[q], names[q].unit));
  }
  return out;
}

/// `coefficients`, and which of them and of the rest are identifiable.
void add_coefficients(const Fit& fit, Object& K, Object& identifiable) {
  const auto names = force::coefficient_quantities(fit.law);
  for (std::size_t q = 0; q < names.size(); ++q) {
    const bool is_known = fit.ok && q < fit.coefficients.size() && fit.coefficients[q];
    set(K, names[q].key,
        is_known ? estimate_value(fit.coefficients[q], names[q].unit) : Value());
    set(identifiable, names[q].key, is_known);
  }
  const auto exponents = force::exponent_quantities(fit.law);
  for (std::size_t q = 0; q < fit.exponents.size(); ++q) {
    set(K, exponents[q].key, estimate_value(fit.exponents[q], 1.0));
  }
  for (const auto& [what, why] : fit.unidentifiable) {
    set(identifiable, what, why);
  }
}

/// Of the forces that are measured.
Array rms_axis_value(const Fit& fit) {
  Array out;
  for (std::size_t q = 0; q < 3; ++q) {
    out.push_back(fit.measured[q] ? Value(fit.rms_axis[q]) : Value());
  }
  return out;
}

}  // namespace

Array groups_value(const Fit& fit, std::span<const std::string> files) {
  Array out;
  for (const identification::Group& group : fit.groups) {
    Array own;
    for (const std::size_t r : group.runs) own.emplace_back(files[r]);
    const auto g = static_cast<std::size_t>(&group - fit.groups.data());
    out.emplace_back(Object{{"group", group.name.empty() ? Value() : Value(group.name)},
                            {"coefficients", coefficients_value(group)},
                            {"covariance", joint_value(joint_of(fit, g))},
                            {"files", std::move(own)}});
  }
  return out;
}

Object fit_value(const Fit& fit) {
  Object K;
  Object identifiable;
  add_coefficients(fit, K, identifiable);
  Array phase_se;
  for (const auto& se : fit.phase_se) {
    phase_se.push_back(in_unit(se, unit::deg));
  }
  const bool solved = fit.rank > 0;  // a refusal may come before the equations
  const auto number = [&](double value) { return fit.ok ? Value(value) : Value(); };
  Object out{{"chip_model", chip::name_of(fit.chip.model)},
             {"lookback", chip::name_of(fit.chip.lookback)},
             {"ok", fit.ok},
             {"message", fit.message},
             {"coefficients", std::move(K)},
             {"runout", runout_value(fit)},
             {"phase_deg", alone_or_list(phases_value(fit))},
             {"phase_se_deg", alone_or_list(std::move(phase_se))}};
  if (!fit.channel_offsets.empty()) {
    out.push_back({"channel_offsets", channel_offsets_value(fit)});
  }
  const Object quality{
      {"rms_N", number(fit.rms)},
      {"rms_axis_N", fit.ok ? Value(rms_axis_value(fit)) : Value()},
      {"rms_meaning",
       "square root of the mean over samples of |dF|^2, and of dF_q^2 per axis"},
      {"condition", solved ? Value(fit.condition) : Value()},
      {"rank", solved ? Value(fit.rank) : Value()},
      {"degrees_of_freedom", number(fit.freedom)},
      {"band_harmonics", fit.ok ? Value(band_of(fit)) : Value()},
      {"interval_factor", number(fit.interval_factor)},
      {"residual_correlation", number(fit.residual_correlation)},
      {"interval_widening", number(fit.widening)},
      {"unexplained_in_band", number(fit.unexplained.in_band)},
      {"unexplained", number(fit.unexplained.all)},
      {"outside_band", number(fit.unexplained.outside)}};
  out.insert(out.end(), quality.begin(), quality.end());
  if (fit.ok && !fit.options.response.empty()) {
    out.push_back({"resonances", resonances_value(fit)});
  }
  out.push_back({"identifiable", std::move(identifiable)});
  return out;
}

}  // namespace trochoid::results
