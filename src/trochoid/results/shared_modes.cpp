#include <trochoid/results/shared_modes.h>

#include <trochoid/base/estimate.h>
#include <trochoid/base/units.h>
#include <trochoid/results/joint.h>

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <limits>
#include <utility>

namespace trochoid::results {

namespace {

using base::add_column;
using structure::FittedResponse;
using structure::Known;
using structure::ShapeMode;
using structure::ShapesFit;

constexpr std::array axis_names = {"x", "y"};

/// The axis of a case nearest to a direction, and the angle from it.
struct Lying {
  std::string_view axis;
  double angle = 0.0;  ///< [deg]
};

Lying lying(const SharedModesResult& r, const ShapeMode& mode) {
  if (mode.phi.size() < 2) {
    return {name_of(r.responses.front().motion), 0.0};
  }
  const double angle = mode.angle.value / unit::deg;
  if (std::abs(angle) <= 45) {
    return {"x", angle};
  }
  return {"y", angle > 0 ? angle - 90 : angle + 90};
}

/// fitted_xy.csv: the lines of one response as measured and as fitted.
base::Table fitted_table(const SharedResponse& response, const FittedResponse& fit) {
  base::Table table{fmt::format("fitted_{}.csv", response.name), {}};
  const std::size_t n = fit.omega.size();
  const std::string_view suffix = unit_suffix(response.kind);
  add_column(table, "frequency_Hz", n,
             [&](std::size_t i) { return unit::in(fit.omega[i], unit::Hz); });
  const auto add = [&](const char* what, const std::vector<std::complex<double>>& H) {
    add_column(table, fmt::format("{}re_{}", what, suffix), n,
               [&](std::size_t i) { return H[i].real(); });
    add_column(table, fmt::format("{}im_{}", what, suffix), n,
               [&](std::size_t i) { return H[i].imag(); });
  };
  add("", fit.H);
  if (!fit.fitted.empty()) {
    add("fitted_", fit.fitted);
  }
  return table;
}

/// The shape, each component with its errors; the imaginary parts where there are any.
Array shape_value(const ShapeMode& m, bool complex_shapes) {
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

Object mode_value(const ShapeMode& m, bool complex_shapes) {
  Object out{{"frequency_Hz", m.omega.value / unit::Hz},
             {"damping_ratio", m.zeta.value},
             {"mass_kg", m.mass.value},
             {"stiffness_N_per_m", m.stiffness.value},
             {"damping_Ns_per_m", m.damping.value}};
  Object se{{"frequency_Hz", m.omega.se / unit::Hz},
            {"damping_ratio", m.zeta.se},
            {"mass_kg", m.mass.se},
            {"stiffness_N_per_m", m.stiffness.se},
            {"damping_Ns_per_m", m.damping.se}};
  const auto add = [&](const char* key, const Known& known, double size) {
    out.push_back({key, known.value / size});
    se.push_back({key, known.se / size});
  };
  if (m.phi.size() > 1) {
    add("angle_deg", m.angle, unit::deg);
  }
  if (complex_shapes) {
    add("imaginary_fraction", m.imaginary, 1.0);
  }
  out.push_back({"se", std::move(se)});
  out.push_back({"shape", shape_value(m, complex_shapes)});
  out.push_back({"lines_in_peak", m.lines_in_peak});
  return out;
}

/// What modes.toml holds, with its covariance.
Joint joint_of(const SharedModesResult& r) {
  Joint joint;
  std::vector<double> units;
  for (const ShapeMode& m : r.fit.real_modes) {
    const Lying at = lying(r, m);
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

Array modes_value(const std::vector<ShapeMode>& modes, bool complex_shapes) {
  Array out;
  for (const ShapeMode& mode : modes) {
    out.emplace_back(mode_value(mode, complex_shapes));
  }
  return out;
}

Object response_value(const SharedResponse& response, const FittedResponse& fit,
                      const ShapesFit& all) {
  const std::string_view suffix = unit_suffix(response.kind);
  Object out{{"name", response.name},
             {"axis", name_of(response.motion)},
             {"force_axis", name_of(response.force)},
             {"kind", name_of(response.kind)},
             {"lines", fit.omega.size()}};
  const auto add = [&](std::string key, Value value) {
    out.push_back({std::move(key), std::move(value)});
  };
  if (!fit.omega.empty()) {
    add("band_Hz", Array{unit::in(fit.omega.front(), unit::Hz),
                         unit::in(fit.omega.back(), unit::Hz)});
  }
  if (!response.description.empty()) {
    add("description", response.description);
  }
  if (!all.ok) {
    return out;
  }
  add("explained", fit.explained);
  add(fmt::format("rms_{}", suffix), fit.rms);
  add("noise", Object{{fmt::format("floor_{}", suffix), fit.noise.floor},
                      {"magnitude_percent", 100 * fit.noise.magnitude},
                      {"phase_deg", unit::in(fit.noise.phase, unit::deg)}});
  Array residues;
  for (const structure::ShapeResidue& residue : fit.residues) {
    Object one{{"re_per_kg", residue.value.real()}, {"re_se", residue.se.real()}};
    if (all.complex_shapes) {
      one.push_back({"im_per_kg", residue.value.imag()});
      one.push_back({"im_se", residue.se.imag()});
    }
    residues.emplace_back(std::move(one));
  }
  add("residues", std::move(residues));
  if (all.residual_terms) {
    add("residual_terms",
        Object{{"above_m_per_N", fit.residual[0]}, {"below_per_kg", fit.residual[1]}});
  }
  return out;
}

/// The fits that were tried: the evidence for each, less being better.
Array orders_value(const ShapesFit& fit) {
  double least = std::numeric_limits<double>::infinity();
  for (const structure::ShapesOrder& tried : fit.orders) {
    least = std::min(least, tried.order.criterion);
  }
  Array orders;
  for (const auto& [order, complex_shapes] : fit.orders) {
    Array frequencies;
    Array dampings;
    for (const auto& [omega, zeta] : order.modes) {
      frequencies.emplace_back(unit::in(omega, unit::Hz));
      dampings.emplace_back(zeta);
    }
    orders.emplace_back(
        Object{{"modes", order.count},
               {"shapes", complex_shapes ? "complex" : "real"},
               {"residual_terms", order.residual_terms},
               {"criterion", order.criterion - least},
               {"frequencies_Hz", std::move(frequencies)},
               {"damping_ratios", std::move(dampings)},
               {"fault", order.fault.empty() ? Value(nullptr) : Value(order.fault)}});
  }
  return orders;
}

Array reciprocity_value(const SharedModesResult& r) {
  Array out;
  for (const structure::Reciprocity& pair : r.fit.reciprocity) {
    out.emplace_back(Object{{"response", r.responses[pair.other].name},
                            {"over", r.responses[pair.one].name},
                            {"gain", pair.gain.value},
                            {"se", pair.gain.se}});
  }
  return out;
}

Object result_of(const SharedModesResult& r) {
  const ShapesFit& fit = r.fit;
  Object result{
      {"shapes", fit.ok ? Value(fit.complex_shapes ? "complex" : "real") : nullptr},
      {"modes", fit.ok ? Value(modes_value(fit.modes, fit.complex_shapes)) : nullptr}};
  const auto add = [&](std::string key, Value value) {
    result.push_back({std::move(key), std::move(value)});
  };
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
  Array outside;
  for (const double omega : fit.outside) {
    outside.emplace_back(unit::in(omega, unit::Hz));
  }
  add("terms_outside_Hz", std::move(outside));
  Array left_out;
  for (const std::string& why : fit.left_out) {
    left_out.emplace_back(Object{{"why", why}});
  }
  add("unresolved", std::move(left_out));
  add("orders", orders_value(fit));
  return result;
}

std::string modes_toml(const SharedModesResult& r) {
  std::string text =
      "# Found by trochoid modes in several responses together. Use it in another case "
      "with\n#   include = \"<this file>\"\n";
  if (r.fit.complex_shapes) {
    text += "# The shapes are complex: these are the real modes nearest to them.\n";
  }
  for (const ShapeMode& m : r.fit.real_modes) {
    const Lying at = lying(r, m);
    text += fmt::format(
        "\n[[mode]]  # {:.6g} Hz, damping ratio {:.4g}\n"
        "body = \"{}\"\naxis = \"{}\"\n",
        m.omega.value / unit::Hz, m.zeta.value, name_of(r.body), at.axis);
    if (m.phi.size() > 1) {
      text += fmt::format("angle_deg = {}  # standard error {:.2g}\n", at.angle,
                          m.angle.se / unit::deg);
    }
    text += fmt::format(
        "mass_kg = {}  # standard error {:.2g}\n"
        "stiffness_N_per_m = {}  # {:.2g}\n"
        "damping_Ns_per_m = {}  # {:.2g}\n",
        m.mass.value, m.mass.se, m.stiffness.value, m.stiffness.se, m.damping.value,
        m.damping.se);
  }
  return text;
}

std::string short_table(const SharedModesResult& r) {
  const ShapesFit& fit = r.fit;
  std::string text =
      "mode  frequency [Hz]    damping ratio      mass [kg]          "
      "stiffness [N/m]    angle [deg]      ";
  text += fit.complex_shapes ? "imaginary fraction\n" : "\n";
  const auto cell = [](const Known& known, double size) {
    return fmt::format("{:.6g} +- {:.2g}", known.value / size,
                       base::normal_interval * known.se / size);
  };
  for (std::size_t i = 0; i < fit.modes.size(); ++i) {
    const ShapeMode& m = fit.modes[i];
    text += fmt::format("{:>4}  {:<16}  {:<17}  {:<17}  {:<17}  {:<15}  {}\n", i + 1,
                        cell(m.omega, unit::Hz), cell(m.zeta, 1), cell(m.mass, 1),
                        cell(m.stiffness, 1),
                        m.phi.size() > 1 ? cell(m.angle, unit::deg) : "-",
                        fit.complex_shapes ? cell(m.imaginary, 1) : "");
  }
  text += fmt::format(
      "(+-: half of a 95 % interval; angle of the direction from +x towards +y, mass of "
      "motion along it)\n{} shapes, {}\n",
      fit.complex_shapes ? "complex" : "real",
      fit.residual_terms || !fit.outside.empty()
          ? "with terms for modes outside the band"
          : "without terms for modes outside");
  for (std::size_t q = 0; q < r.responses.size(); ++q) {
    const FittedResponse& one = fit.responses[q];
    text += fmt::format(
        "{}: {} lines of the {}, {:.4g} to {:.4g} Hz; the fit explains {:.3f} %\n",
        r.responses[q].name, one.omega.size(), name_of(r.responses[q].kind),
        one.omega.front() / unit::Hz, one.omega.back() / unit::Hz, 100 * one.explained);
  }
  for (const structure::Reciprocity& pair : fit.reciprocity) {
    text +=
        fmt::format("reciprocity: {} is {} times {}\n", r.responses[pair.other].name,
                    cell(pair.gain, 1), r.responses[pair.one].name);
  }
  if (fit.reciprocity.empty() && r.responses.size() > 1) {
    text +=
        "reciprocity: not checked, as one cross response was measured; its sign says to "
        "which side the modes lie\n";
  }
  return text;
}

}  // namespace

Answer answer_of(const SharedModesResult& r) {
  Answer answer{.command = "modes", .heading = r.heading, .result = result_of(r)};
  for (std::size_t q = 0; q < r.responses.size(); ++q) {
    answer.tables.push_back(fitted_table(r.responses[q], r.fit.responses[q]));
  }
  if (r.fit.ok) {
    answer.short_table = short_table(r);
    answer.texts.push_back({"modes.toml", modes_toml(r)});
  }
  return answer;
}

}  // namespace trochoid::results
