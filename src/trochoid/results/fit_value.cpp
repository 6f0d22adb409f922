#include <trochoid/results/fit_value.h>

#include <trochoid/base/units.h>
#include <trochoid/identification/reliability.h>
#include <trochoid/results/joint_of_fit.h>

#include <fmt/core.h>

#include <algorithm>
#include <array>

namespace trochoid::results {

namespace {

using identification::Fit;
using identification::unidentifiable;

/// A number that may be unknown.
Value known(bool unknown, double value) {
  return unknown ? Value() : Value(value);
}

Value offsets_value(const Fit& fit) {
  Array offsets;
  for (std::size_t k = 0; k < fit.runout.radial_offsets.size(); ++k) {
    const bool unknown =
        unidentifiable(fit, "radial_offsets_mm") ||
        unidentifiable(fit, fmt::format("radial_offsets_mm[{}]", k + 1));
    offsets.push_back(known(unknown, fit.runout.radial_offsets[k]));
  }
  return offsets;
}

Value offset_errors_value(const Fit& fit) {
  Array errors;
  for (std::size_t k = 0; k < fit.runout.radial_offsets.size(); ++k) {
    const bool gauge = k == 0 && identification::finds_offsets(fit.options.runout) &&
                       !unidentifiable(fit, "radial_offsets_mm") &&
                       !unidentifiable(fit, "radial_offsets_mm[1]");
    errors.push_back(gauge ? Value(0.0) : Value(fit.radial_offsets_se[k]));
  }
  return errors;
}

Value axial_offsets_value(const Fit& fit) {
  Array offsets;
  for (std::size_t k = 0; k < fit.runout.axial_offsets.size(); ++k) {
    const bool unknown =
        unidentifiable(fit, fmt::format("axial_offsets_mm[{}]", k + 1));
    offsets.push_back(known(unknown, fit.runout.axial_offsets[k]));
  }
  return offsets;
}

Value axial_errors_value(const Fit& fit) {
  Array errors;
  for (const auto& se : fit.channels->axial_offsets_se) errors.emplace_back(Value(se));
  return errors;
}

/// Of fits to the channels of a sensor, which may find it.
const Fields<Fit>& deep_runout_fields() {
  static const Fields<Fit> all{
      {"axial_offsets_mm", "of each tooth, positive: it reaches deeper; empty: none",
       [](const Fit& f) { return all_given(axial_offsets_value(f)); }},
      {"axial_offsets_se_mm", "standard errors or `null`, as above",
       axial_errors_value},
      {"tilt_deg", "of the tool axis",
       [](const Fit& f) {
         return all_given(known(unidentifiable(f, "tilt_deg"), f.runout.tilt));
       }},
      {"tilt_se_deg", "standard error or `null`, as above",
       [](const Fit& f) { return Value(f.channels->tilt_se); }},
      {"tilt_angle_deg",
       "where its top leans to, from the tip of tooth 1 towards tooth 2",
       [](const Fit& f) {
         return all_given(known(unidentifiable(f, "tilt_deg"), f.runout.tilt_angle));
       }},
      {"tilt_angle_se_deg", "standard error or `null`, as above",
       [](const Fit& f) { return Value(f.channels->tilt_angle_se); }}};
  return all;
}

const Fields<Fit>& runout_fields() {
  static const Fields<Fit> all{
      {"radial_offsets_mm", "of each tooth",
       [](const Fit& f) { return all_given(offsets_value(f)); }},
      {"radial_offsets_se_mm",
       "standard errors; `null` where it is given, the gauge, or found where a tooth just "
       "starts or stops cutting (warning `runout_on_edge`)",
       offset_errors_value},
      {"eccentricity_mm", "of the tool",
       [](const Fit& f) {
         return all_given(
             known(unidentifiable(f, "eccentricity_mm"), f.runout.eccentricity));
       }},
      {"eccentricity_se_mm", "standard error or `null`, as above",
       &Fit::eccentricity_se},
      {"angle_deg", "of the eccentricity, from the tip of tooth 1 towards tooth 2",
       [](const Fit& f) {
         return all_given(known(unidentifiable(f, "angle_deg"), f.runout.angle));
       }},
      {"angle_se_deg", "standard error or `null`, as above", &Fit::angle_se},
      {"", "", deep_runout_fields(), [](const Fit& f) { return &f; },
       [](const Fit& f) { return f.channels.has_value(); }}};
  return all;
}

Array phases_value(const Fit& fit) {
  Array phases;
  for (std::size_t r = 0; r < fit.phase.size(); ++r) {
    const bool unknown = (fit.channels && !fit.channels->has_phase[r]) ||
                         unidentifiable(fit, "phase_deg") ||
                         unidentifiable(fit, fmt::format("phase_deg[{}]", r + 1));
    phases.push_back(known(unknown, fit.phase[r]));
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

Value in_turns(const std::optional<double>& omega) {
  return omega ? Value(*omega / unit::turn) : Value();
}

/// Of the dynamometer, in the axes of the tool; null where none was found.
Object resonances_value(const Fit& fit) {
  Object out;
  constexpr std::array axes{"x", "y", "z"};
  for (std::size_t q = 0; q < 3; ++q) {
    const auto& one = fit.resonances[q];
    set(out, axes[q],
        one ? Value(Object{{"frequency_Hz", one->omega / unit::turn},
                           {"frequency_se_Hz", in_turns(one->omega_se)},
                           {"damping_ratio", one->zeta},
                           {"damping_ratio_se", Value(one->zeta_se)}})
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

/// Whether the channels are forces, of which a vector is left.
bool leaves_a_vector(const Fit& fit) {
  return fit.measured != std::array<bool, 3>{};
}

Value rms_value(const Fit& fit) {
  return fit.ok && leaves_a_vector(fit) ? Value(fit.rms) : Value();
}

/// Of the forces that are measured.
Value rms_axis_value(const Fit& fit) {
  if (!fit.ok || !leaves_a_vector(fit)) return {};
  Array out;
  for (std::size_t q = 0; q < 3; ++q) {
    out.push_back(fit.measured[q] ? Value(fit.rms_axis[q]) : Value());
  }
  return out;
}

/// A number of a fit that succeeded, else null.
template <class Get>
auto of_success(Get get) {
  return [get](const Fit& f) { return f.ok ? Value(std::invoke(get, f)) : Value(); };
}

/// How good a fit is.
const Fields<Fit>& quality_fields() {
  const auto solved = [](auto member) {  // a refusal may come before the equations
    return [member](const Fit& f) { return f.rank > 0 ? Value(f.*member) : Value(); };
  };
  static const Fields<Fit> all{
      {"rms_N",
       "sqrt(mean over samples of the squared difference) of the vector (I-5); `null` "
       "where the channels are not three forces",
       rms_value},
      {"rms_axis_N", "the same of each axis, `null` where that force was not measured",
       rms_axis_value},
      {"rms_meaning", "both in words",
       [](const Fit&) {
         return "square root of the mean over samples of |dF|^2, and of dF_q^2 per axis";
       }},
      {"condition", "condition number of [D] with columns of length one",
       solved(&Fit::condition)},
      {"rank", "of the same", solved(&Fit::rank)},
      {"degrees_of_freedom", "data less unknowns", of_success(&Fit::freedom)},
      {"band_harmonics", "harmonics of the spindle that were fitted; 0: all",
       of_success(band_of)},
      {"interval_factor",
       "half of a 95 % confidence interval over its standard error, for every unknown of "
       "the fit: what the terminal and the report print behind ± is this times the "
       "standard error",
       of_success(&Fit::interval_factor)},
      {"residual_correlation",
       "of neighbouring residuals (I-8); 0 with a band limit, where harmonics are counted "
       "and not samples",
       of_success(&Fit::residual_correlation)},
      {"interval_widening",
       "by how much the intervals of the coefficients are wider than white noise would "
       "make them (rms of them), because residuals agree with their neighbours, repeat "
       "turn by turn, or records disagree (I-13 to I-15): `se`, `low` and `high` "
       "include it; 1 with `errors = \"white\"`",
       of_success(&Fit::widening)},
      {"unexplained_in_band",
       "what the fit does not explain as a fraction of the force (rms, 0 to 1), within "
       "its band (I-9)",
       of_success([](const Fit& f) { return f.unexplained.in_band; })},
      {"unexplained", "the same of everything",
       of_success([](const Fit& f) { return f.unexplained.all; })},
      {"outside_band", "fraction of the force (rms) that lies outside of the band",
       of_success([](const Fit& f) { return f.unexplained.outside; })},
      Field<Fit>{
          "resonances",
          "of the dynamometer, where its response is in the model: for `x`, `y`, "
          "`z` of the tool, or `null` where none was found; of a given response the "
          "one that was scaled with the fit (I-17, I-25)",
          [](const Fit& f) { return as_named(resonances_value(f)); },
          [](const Fit& f) { return f.ok && !f.options.response.empty(); }}
          .with({{".*", "of each axis"},
                 {".*.frequency_Hz", "natural frequency"},
                 {".*.frequency_se_Hz",
                  "its standard error; `null` where it was not found with the rest"},
                 {".*.damping_ratio", "of critical damping"},
                 {".*.damping_ratio_se", "its standard error, as above"}})};
  return all;
}

/// What a fit found.
const Fields<Fit>& found_fields() {
  static const Fields<Fit> all{
      {"chip_model", "of this fit",
       [](const Fit& f) { return chip::name_of(f.chip.model); }},
      {"lookback", "of the chip model",
       [](const Fit& f) { return chip::name_of(f.chip.lookback); }},
      {"ok", "whether there is an answer", &Fit::ok},
      {"message", "when not, why", &Fit::message},
      Field<Fit>{"coefficients",
                 "each of the law, by its key in `[force]`; `null` with the reason in "
                 "`identifiable`",
                 [](const Fit& f) {
                   Object K;
                   Object identifiable;
                   add_coefficients(f, K, identifiable);
                   return as_named(std::move(K));
                 }}
          .with(below_estimate(".*.")),
      {"runout", "`null` for model none", runout_fields(),
       [](const Fit& f) {
         return f.ok && chip::feels_runout(f.chip.model) ? &f : nullptr;
       }},
      {"phase_deg",
       "true angle of the tip of tooth 1 less the recorded angle; a list in measurement "
       "order, of one measurement the number alone. Equal pitch: the first within half a "
       "pitch of 0, further ones within half a turn",
       [](const Fit& f) { return all_given(alone_or_list(phases_value(f))); }},
      {"phase_se_deg", "standard errors of the same",
       [](const Fit& f) {
         return alone_or_list(Array(f.phase_se.begin(), f.phase_se.end()));
       }},
      Field<Fit>{"channel_offsets",
                 "where they were fitted: of each channel, for each measurement",
                 [](const Fit& f) { return as_named(channel_offsets_value(f)); },
                 [](const Fit& f) { return !f.channel_offsets.empty(); }}
          .with({{"[][].constant_N", "at the middle of the record"},
                 {"[][].slope_N", "from its beginning to its end"}}),
      {"", "", quality_fields(), [](const Fit& f) { return &f; }},
      Field<Fit>{"identifiable",
                 "for each quantity `true`, or the reason why it cannot be determined",
                 [](const Fit& f) {
                   Object K;
                   Object identifiable;
                   add_coefficients(f, K, identifiable);
                   return identifiable;
                 }}
          .with({{".*", "by its key"}})};
  return all;
}

}  // namespace

const Fields<GroupOfRecords>& group_fields() {
  using Of = const GroupOfRecords&;
  static const Fields<GroupOfRecords> all{
      {"group", "its name; `null`: records without one",
       [](Of g) {
         const std::string& name = g.fit.groups[g.group].name;
         return name.empty() ? Value() : Value(name);
       }},
      Field<GroupOfRecords>{
          "coefficients", "as in the fit",
          [](Of g) { return as_named(coefficients_value(g.fit.groups[g.group])); }}
          .with(below_estimate(".*.")),
      {"covariance", "as below", joint_fields(),
       [](Of g) { return found_or_none(joint_of(g.fit, g.group)); }},
      {"files", "of its records", [](Of g) {
         Array own;
         for (const std::size_t r : g.fit.groups[g.group].runs) {
           own.emplace_back(g.files[r]);
         }
         return own;
       }}};
  return all;
}

std::vector<GroupOfRecords> groups_of(const FitOfRecords& of) {
  std::vector<GroupOfRecords> groups;
  for (std::size_t g = 0; g < of.fit.groups.size(); ++g) {
    groups.push_back({of.fit, g, of.files});
  }
  return groups;
}

const Fields<FitOfRecords>& fit_fields() {
  static const Fields<FitOfRecords> all{
      {"", "", found_fields(), [](const FitOfRecords& of) { return &of.fit; }},
      {"", "", channel_fit_fields(),
       [](const FitOfRecords& of) {
         return FitOfChannels{of.fit, *of.sensor};
       },
       [](const FitOfRecords& of) {
         return of.sensor != nullptr && of.fit.channels.has_value();
       }},
      {"groups",
       "where a record names its `group`; the fit's own `coefficients` are for the "
       "first group",
       group_fields(), groups_of, &FitOfRecords::grouped}};
  return all;
}

}  // namespace trochoid::results
