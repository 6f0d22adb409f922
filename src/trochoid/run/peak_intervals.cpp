#include <trochoid/run/program.h>

#include <trochoid/base/error.h>
#include <trochoid/base/units.h>
#include <trochoid/results/joint.h>

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string_view>

namespace trochoid::run {

namespace {

using engagement::Tool;
using engagement::TurnForces;

/// What identify found of the numbers of a tool.
struct FoundNumbers {
  std::vector<std::size_t> places;  ///< in the covariance
  std::vector<Tool> tools;          ///< each number lower, then higher by its sd
};

/// An entry of a list of a tooth: `radial_offsets_mm[2]`.
std::optional<std::size_t> tooth_in(std::string_view name, std::string_view list) {
  if (!name.starts_with(list)) return std::nullopt;
  name.remove_prefix(list.size());
  std::size_t tooth = 0;
  const auto read = std::from_chars(name.data(), name.data() + name.size(), tooth);
  if (read.ec != std::errc{} || tooth == 0) return std::nullopt;
  return tooth - 1;
}

/// An amount and its angle as a vector, moved along one of its axes.
void move_vector(double& amount, double& angle, bool along_x, double by) {
  const double x = amount * std::cos(angle) + (along_x ? by : 0.0);
  const double y = amount * std::sin(angle) + (along_x ? 0.0 : by);
  amount = std::hypot(x, y);
  angle = std::atan2(y, x);
}

/// The tool with one of its numbers changed; nothing where the name is of something else.
/// @param value  that was found, in the unit of the name
/// @param by     in the same unit
std::optional<Tool> with_number(Tool tool, std::string_view name, double value,
                                double by) {
  constexpr std::string_view law = "force.";
  if (name.starts_with(law)) {
    const std::string_view key = name.substr(law.size());
    for (const force::Quantity& q : force::quantities(tool.law)) {
      if (q.key != key) continue;
      tool.law = force::with_number(tool.law, key, (value + by) * q.unit);
      return tool;
    }
    return std::nullopt;
  }
  geometry::Runout& runout = tool.runout;
  const auto move_offset = [&](std::vector<double>& offsets, std::size_t tooth) {
    offsets.resize(static_cast<std::size_t>(tool.cutter.teeth()), 0.0);
    if (tooth < offsets.size()) offsets[tooth] += by * unit::mm;
  };
  if (const auto tooth = tooth_in(name, "runout.radial_offsets_mm[")) {
    move_offset(runout.radial_offsets, *tooth);
  } else if (const auto deep = tooth_in(name, "runout.axial_offsets_mm[")) {
    move_offset(runout.axial_offsets, *deep);
  } else if (name == "runout.e_x_mm" || name == "runout.e_y_mm") {
    move_vector(runout.eccentricity, runout.angle, name == "runout.e_x_mm",
                by * unit::mm);
  } else if (name == "runout.t_x" || name == "runout.t_y") {
    double slope = std::tan(runout.tilt);
    move_vector(slope, runout.tilt_angle, name == "runout.t_x", by);
    runout.tilt = std::atan(slope);
  } else {
    return std::nullopt;
  }
  return tool;
}

FoundNumbers found_numbers(const results::Joint& joint, const Tool& tool) {
  FoundNumbers out;
  const std::size_t n = joint.names.size();
  for (std::size_t i = 0; i < n; ++i) {
    const double sd = std::sqrt(joint.covariance[i * n + i]);
    auto below = with_number(tool, joint.names[i], joint.values[i], -sd);
    auto above = with_number(tool, joint.names[i], joint.values[i], sd);
    if (!below || !above || !(sd > 0)) continue;
    out.places.push_back(i);
    out.tools.push_back(*std::move(below));
    out.tools.push_back(*std::move(above));
  }
  return out;
}

/// A quantity of a turn, and where its largest value and its error stand.
struct Quantity {
  engagement::Peak engagement::Totals::*peak;
  std::optional<double> results::PeakErrors::*error;
  double (*value)(const TurnForces&);
};

const std::array<Quantity, 7>& peak_quantities() {
  using T = engagement::Totals;
  using E = results::PeakErrors;
  using F = const TurnForces&;
  static const std::array<Quantity, 7> all{
      {{&T::peak_xy, &E::peak_xy, [](F f) { return f.peak_xy; }},
       {&T::peak_tooth, &E::peak_tooth,
        [](F f) {
          return f.peak_of_tooth.empty() ? 0.0
                                         : *std::ranges::max_element(f.peak_of_tooth);
        }},
       {&T::torque, &E::torque, [](F f) { return f.torque_peak; }},
       {&T::power, &E::power, [](F f) { return f.power; }},
       {&T::moment, &E::moment, [](F f) { return f.moment_peak; }},
       {&T::deflection, &E::deflection, [](F f) { return f.deflection; }},
       {&T::chip, &E::chip, [](F f) { return f.peak_chip; }}}};
  return all;
}

/// @eq N-20  se^2 = g' C g, g_i = (Q(x_i + s_i) - Q(x_i - s_i))/(2 s_i), s_i^2 = C_ii
/// @src standard
/// @param forces  of the tools of found, in their order
double half_interval(const results::Joint& joint, const FoundNumbers& found,
                     std::span<const TurnForces> forces,
                     double (*value)(const TurnForces&)) {
  const std::size_t all = joint.names.size();
  const std::size_t n = found.places.size();
  std::vector<double> g(n);
  double factor = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t k = found.places[i];
    const double sd = std::sqrt(joint.covariance[k * all + k]);
    g[i] = (value(forces[2 * i + 1]) - value(forces[2 * i])) / (2 * sd);
    factor = std::max(factor, joint.factors[k]);
  }
  double variance = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      variance +=
          g[i] * joint.covariance[found.places[i] * all + found.places[j]] * g[j];
    }
  }
  return factor * std::sqrt(std::max(variance, 0.0));
}

/// That the numbers are those of this tool.
void check_joint(const results::ReadJoint& read, const cases::Case& given) {
  const results::Joint& joint = read.joint;
  const files::FileRef& file = given.nc.program->covariance;
  const auto refuse = [&](const std::string& why) {
    throw base::InputError({fmt::format("{}: program.covariance: {}: {}", file.location,
                                        read.file.string(), why)});
  };
  if (joint.law.empty()) {
    refuse("no coefficients are in it; must be of identify or calibrate");
  }
  if (joint.law != force::name_of(given.law)) {
    refuse(
        fmt::format("coefficients of the law {}, but the case has force.law = "
                    "\"{}\"; must be the same, as in the material.toml next to it",
                    joint.law, force::name_of(given.law)));
  }
  const auto teeth = static_cast<std::size_t>(given.setup.cutter.teeth());
  if (joint.teeth > 0 && joint.teeth != teeth) {
    refuse(fmt::format("the runout of {} teeth, but the case has tool.teeth = {}",
                       joint.teeth, teeth));
  }
}

/// Coefficients of the case that are clearly not those that were found.
std::vector<std::string> other_values(const results::Joint& joint,
                                      const force::Law& law) {
  std::vector<std::string> out;
  const auto quantities = force::coefficient_quantities(law);
  const std::vector<double> K = force::coefficients(law);
  const std::size_t n = joint.names.size();
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t q = 0; q < quantities.size(); ++q) {
      if (joint.names[i] != fmt::format("force.{}", quantities[q].key)) continue;
      const double half = joint.factors[i] * std::sqrt(joint.covariance[i * n + i]);
      const double own = K[q] / quantities[q].unit;
      if (std::abs(own - joint.values[i]) > half) {
        out.push_back(fmt::format("{} ({:.4g}, found {:.4g} +- {:.2g})",
                                  quantities[q].key, own, joint.values[i], half));
      }
    }
  }
  return out;
}

void warn_of_joint(const results::ReadJoint& read, const cases::Case& given,
                   std::vector<base::Warning>& warnings) {
  const std::string file = read.file.filename().string();
  if (read.do_not_use) {
    warnings.push_back(
        {"do_not_use", fmt::format("{}: {} itself says not to use these numbers", file,
                                   read.command)});
  }
  if (const auto others = other_values(read.joint, given.law); !others.empty()) {
    warnings.push_back(
        {"other_value",
         fmt::format("{}: the case has other coefficients than were found: {}. The "
                     "intervals are about the forces of the case.",
                     file, fmt::join(others, ", "))});
  }
  std::vector<std::string> known;
  for (const auto& [name, why] : read.joint.not_found) known.push_back(name);
  if (!known.empty()) {
    warnings.push_back(
        {"not_in_the_interval",
         fmt::format("{}: {} found no error of these, so they count as exact: {}", file,
                     read.command, fmt::join(known, ", "))});
  }
}

}  // namespace

std::optional<results::PeakErrors> peak_errors(const engagement::Job& job,
                                               const cases::Case& given,
                                               std::span<const std::size_t> own,
                                               const engagement::Totals& totals,
                                               std::vector<base::Warning>& warnings) {
  const files::FileRef& file = given.nc.program->covariance;
  if (file.name.empty()) return std::nullopt;
  const results::ReadJoint read = file.bytes
                                      ? results::joint_in_text(*file.bytes, file.name)
                                      : results::read_joint(file.path, "");
  check_joint(read, given);
  warn_of_joint(read, given, warnings);
  if (own.empty()) return results::PeakErrors{};
  const FoundNumbers found = found_numbers(read.joint, job.tools[own.front()]);
  std::vector<std::int64_t> steps;
  for (const Quantity& q : peak_quantities()) steps.push_back((totals.*q.peak).step);
  const std::vector<TurnForces> forces =
      engagement::forces_with(job, steps, found.tools);
  results::PeakErrors out;
  const std::size_t width = found.tools.size();
  for (std::size_t k = 0; k < steps.size(); ++k) {
    const Quantity& q = peak_quantities()[k];
    const engagement::Peak& peak = totals.*q.peak;
    const std::size_t tool = peak.tool < 0 ? 0 : static_cast<std::size_t>(peak.tool);
    if (peak.step < 0 || std::ranges::find(own, tool) == own.end()) continue;
    out.*q.error = half_interval(read.joint, found,
                                 std::span(forces).subspan(k * width, width), q.value);
  }
  return out;
}

}  // namespace trochoid::run
