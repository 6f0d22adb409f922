#include <trochoid/results/modes.h>

#include <trochoid/base/units.h>
#include <trochoid/results/joint.h>
#include <trochoid/results/modes_text.h>

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <complex>
#include <limits>
#include <utility>

namespace trochoid::results {

namespace {

using base::add_column;
using structure::FittedMode;
using structure::FittedResponse;
using structure::Known;
using structure::ModesFit;

constexpr std::array axis_names = {"x", "y"};

void add_response(base::Table& table, const char* what, structure::ResponseKind kind,
                  const std::vector<std::complex<double>>& H) {
  const std::string_view suffix = unit_suffix(kind);
  add_column(table, fmt::format("{}re_{}", what, suffix), H.size(),
             [&](std::size_t i) { return H[i].real(); });
  add_column(table, fmt::format("{}im_{}", what, suffix), H.size(),
             [&](std::size_t i) { return H[i].imag(); });
}

/// fitted.csv, fitted_xy.csv: the lines of one response as measured and as fitted.
base::Table fitted_table(std::string file, const FittedResponse& one) {
  base::Table table{std::move(file), {}};
  add_column(table, "frequency_Hz", one.omega.size(),
             [&](std::size_t i) { return unit::in(one.omega[i], unit::Hz); });
  add_response(table, "", one.kind, one.H);
  if (!one.fitted.empty()) {
    add_response(table, "fitted_", one.kind, one.fitted);
  }
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

/// The shape, each component with its errors; the imaginary parts where there are any.
Array shape_value(const FittedMode& m, bool complex_shapes) {
  Array out;
  for (std::size_t k = 0; k < m.phi.size(); ++k) {
    Object one{{"axis", axis_names[k]},
               {"re_per_sqrt_kg", m.phi[k].real()},
               {"re_se", m.phi_se[k].real()}};
    if (complex_shapes) {
      one.push_back({"im_per_sqrt_kg", m.phi[k].imag()});
      one.push_back({"im_se", m.phi_se[k].imag()});
    }
    out.emplace_back(std::move(one));
  }
  return out;
}

Object mode_value(const FittedMode& m, bool complex_shapes) {
  Object out;
  Object se;
  const auto add = [&](const char* key, const Known& known, double size) {
    out.push_back({key, known.value / size});
    se.push_back({key, known.se / size});
  };
  add("frequency_Hz", m.omega, unit::Hz);
  add("damping_ratio", m.zeta, 1.0);
  add("mass_kg", m.mass, 1.0);
  add("stiffness_N_per_m", m.stiffness, 1.0);
  add("damping_Ns_per_m", m.damping, 1.0);
  if (m.phi.size() > 1) {
    add("angle_deg", m.angle, unit::deg);
  }
  if (complex_shapes) {
    add("imaginary_fraction", m.imaginary, 1.0);
  }
  out.push_back({"se", std::move(se)});
  if (!m.phi.empty()) {
    out.push_back({"shape", shape_value(m, complex_shapes)});
  }
  out.push_back({"lines_in_peak", m.lines_in_peak});
  return out;
}

Array modes_value(const std::vector<FittedMode>& modes, bool complex_shapes) {
  Array out;
  for (const FittedMode& mode : modes) {
    out.emplace_back(mode_value(mode, complex_shapes));
  }
  return out;
}

/// What modes.toml holds, with its covariance.
Joint joint_of(const ModesResult& r) {
  Joint joint;
  std::vector<double> units;
  for (const FittedMode& m : r.fit.real_modes) {
    const NearAxis at = near_axis(r, m);
    joint.modes.push_back({std::string(name_of(r.body)), std::string(at.axis)});
    const auto add = [&](const char* what, double value, double unit) {
      add_found(joint, fmt::format("mode[{}].{}", joint.modes.size(), what), value);
      units.push_back(unit);
    };
    add("frequency_Hz", m.omega.value / unit::Hz, unit::Hz);
    add("damping_ratio", m.zeta.value, 1.0);
    add("mass_kg", m.mass.value, 1.0);
    if (m.phi.size() > 1) {
      add("angle_deg", at.angle, unit::deg);
    }
  }
  set_covariance(joint, r.fit.covariance, units);
  return joint;
}

/// Resonances that the fit holds and that are no answer, with what is missing.
Array unresolved_value(const ModesResult& r) {
  Array out;
  for (std::size_t i = 0; i < r.fit.left_out.size(); ++i) {
    Object one;
    if (!r.shared) {
      one.push_back(
          {"frequency_Hz", unit::in(r.fit.unresolved[i].omega.value, unit::Hz)});
    }
    one.push_back({"why", r.fit.left_out[i]});
    out.emplace_back(std::move(one));
  }
  return out;
}

/// The fits that were tried: the evidence for each, less being better.
Array orders_value(const ModesResult& r) {
  double least = std::numeric_limits<double>::infinity();
  for (const structure::ModesOrder& order : r.fit.orders) {
    least = std::min(least, order.criterion);
  }
  Array orders;
  for (const structure::ModesOrder& order : r.fit.orders) {
    Array frequencies;
    Array dampings;
    for (const auto& [omega, zeta] : order.modes) {
      frequencies.emplace_back(unit::in(omega, unit::Hz));
      dampings.emplace_back(zeta);
    }
    Object one{{"modes", order.count}};
    if (r.shared) {
      one.push_back({"shapes", order.complex_shapes ? "complex" : "real"});
    }
    one.push_back({"residual_terms", order.residual_terms});
    one.push_back({"criterion", order.criterion - least});
    one.push_back({"frequencies_Hz", std::move(frequencies)});
    one.push_back({"damping_ratios", std::move(dampings)});
    one.push_back({"fault", order.fault.empty() ? Value(nullptr) : Value(order.fault)});
    orders.emplace_back(std::move(one));
  }
  return orders;
}

Array outside_value(const ModesFit& fit) {
  Array out;
  for (const FittedMode& term : fit.outside) {
    out.emplace_back(unit::in(term.omega.value, unit::Hz));
  }
  return out;
}

/// Band, quality and noise of one response, as both forms of the answer tell them.
void add_band(const FittedResponse& one, Object& to) {
  if (!one.omega.empty()) {
    to.push_back({"band_Hz", Array{unit::in(one.omega.front(), unit::Hz),
                                   unit::in(one.omega.back(), unit::Hz)}});
  }
}

void add_explained(const FittedResponse& one, Object& to) {
  to.push_back({"explained", one.explained});
  to.push_back({fmt::format("rms_{}", unit_suffix(one.kind)), one.rms});
}

void add_noise(const FittedResponse& one, Object& to) {
  const auto& [floor, magnitude, phase] = one.noise;
  to.push_back({"noise", Object{{fmt::format("floor_{}", unit_suffix(one.kind)), floor},
                                {"magnitude_percent", 100 * magnitude},
                                {"phase_deg", unit::in(phase, unit::deg)}}});
}

Object residual_terms(const FittedResponse& one) {
  return {{"above_m_per_N", one.residual[0]}, {"below_per_kg", one.residual[1]}};
}

/// What puts a key and its value into an object.
auto adder(Object& to) {
  return [&to](std::string key, Value value) {
    to.push_back({std::move(key), std::move(value)});
  };
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
  add_column(table, "frequency_Hz", n,
             [&](std::size_t i) { return unit::in(tap.omega[i], unit::Hz); });
  add_response(table, "", r.fit.responses.front().kind, tap.H);
  if (!tap.coherence.empty()) {
    add_column(table, "coherence", n, [&](std::size_t i) { return tap.coherence[i]; });
  }
  return table;
}

Object result_of_one(const ModesResult& r) {
  const ModesFit& fit = r.fit;
  const FittedResponse& one = fit.responses.front();
  Object result{{"kind", name_of(one.kind)},
                {"modes", fit.ok ? Value(modes_value(fit.modes, false)) : nullptr},
                {"lines", one.omega.size()}};
  const auto add = adder(result);
  add_band(one, result);
  if (fit.ok) {
    add("covariance", joint_value(joint_of(r)));
    add_explained(one, result);
    add("residual_terms", fit.residual_terms ? Value(residual_terms(one)) : nullptr);
    add("terms_outside_Hz", outside_value(fit));
    add_noise(one, result);
    add("unresolved", unresolved_value(r));
    add("orders", orders_value(r));
  }
  if (r.tap) {
    add("hits", hits_value(*r.tap));
    add("block_s", r.tap->block);
    add("window_end", r.tap->window_end);
    add("excited_to_Hz", unit::in(r.tap->excited, unit::Hz));
  }
  if (!r.responses.front().description.empty()) {
    add("description", r.responses.front().description);
  }
  return result;
}

Object response_value(const MeasuredResponse& response, const FittedResponse& one,
                      const ModesFit& all) {
  Object out{{"name", response.name},
             {"axis", name_of(response.motion)},
             {"force_axis", name_of(response.force)},
             {"kind", name_of(one.kind)},
             {"lines", one.omega.size()}};
  add_band(one, out);
  if (!response.description.empty()) {
    out.push_back({"description", response.description});
  }
  if (!all.ok) {
    return out;
  }
  add_explained(one, out);
  add_noise(one, out);
  Array residues;
  for (const structure::ShapeResidue& residue : one.residues) {
    Object Z{{"re_per_kg", residue.value.real()}, {"re_se", residue.se.real()}};
    if (all.complex_shapes) {
      Z.push_back({"im_per_kg", residue.value.imag()});
      Z.push_back({"im_se", residue.se.imag()});
    }
    residues.emplace_back(std::move(Z));
  }
  out.push_back({"residues", std::move(residues)});
  if (all.residual_terms) {
    out.push_back({"residual_terms", residual_terms(one)});
  }
  return out;
}

Array reciprocity_value(const ModesResult& r) {
  Array out;
  for (const structure::Reciprocity& pair : r.fit.reciprocity) {
    out.emplace_back(Object{{"response", r.responses[pair.other].name},
                            {"over", r.responses[pair.one].name},
                            {"gain", pair.gain.value},
                            {"se", pair.gain.se}});
  }
  return out;
}

Object result_of_shared(const ModesResult& r) {
  const ModesFit& fit = r.fit;
  Object result{
      {"shapes", fit.ok ? Value(fit.complex_shapes ? "complex" : "real") : nullptr},
      {"modes", fit.ok ? Value(modes_value(fit.modes, fit.complex_shapes)) : nullptr}};
  const auto add = adder(result);
  if (fit.ok && fit.complex_shapes) {
    add("real_modes", modes_value(fit.real_modes, false));
  }
  Array responses;
  for (std::size_t q = 0; q < r.responses.size(); ++q) {
    responses.emplace_back(response_value(r.responses[q], fit.responses[q], fit));
  }
  add("responses", std::move(responses));
  if (!fit.ok) {
    return result;
  }
  add("covariance", joint_value(joint_of(r)));
  add("reciprocity", reciprocity_value(r));
  add("complex_evidence",
      fit.complex_evidence ? Value(*fit.complex_evidence) : Value(nullptr));
  add("terms_outside_Hz", outside_value(fit));
  add("unresolved", unresolved_value(r));
  add("orders", orders_value(r));
  return result;
}

std::vector<base::Table> tables_of_one(const ModesResult& r) {
  const FittedResponse& one = r.fit.responses.front();
  std::vector<base::Table> tables = {fitted_table("fitted.csv", one)};
  const std::vector<double> mif =
      structure::mode_indicator({.kind = one.kind, .omega = one.omega, .H = one.H});
  add_column(tables.front(), "mode_indicator", mif.size(),
             [&](std::size_t i) { return mif[i]; });
  if (r.tap && !r.tap->omega.empty()) {
    tables.push_back(response_table(r));
  }
  if (!r.poles.empty()) {
    tables.push_back(stabilisation_table(r));
  }
  return tables;
}

std::vector<base::Table> tables_of_shared(const ModesResult& r) {
  std::vector<base::Table> tables;
  for (std::size_t q = 0; q < r.responses.size(); ++q) {
    tables.push_back(fitted_table(fmt::format("fitted_{}.csv", r.responses[q].name),
                                  r.fit.responses[q]));
  }
  return tables;
}

}  // namespace

Answer answer_of(const ModesResult& r) {
  Answer answer{.command = "modes",
                .heading = r.heading,
                .result = r.shared ? result_of_shared(r) : result_of_one(r),
                .tables = r.shared ? tables_of_shared(r) : tables_of_one(r)};
  if (r.fit.ok) {
    answer.short_table = short_table(r);
    answer.texts.push_back({"modes.toml", modes_toml(r)});
  }
  return answer;
}

}  // namespace trochoid::results
