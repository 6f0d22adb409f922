#include <trochoid/base/units.h>
#include <trochoid/cases/number_text.h>
#include <trochoid/cases/rules.h>
#include <trochoid/chip/intervals.h>
#include <trochoid/force/oblique.h>

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <numbers>
#include <span>
#include <string>
#include <string_view>
#include <utility>

namespace trochoid::cases {

namespace {

using Coefficient = std::pair<std::string_view, double force::ObliqueCoefficients::*>;
constexpr std::array<Coefficient, 3> coefficients = {
    {{"K_tc_MPa", &force::ObliqueCoefficients::K_tc},
     {"K_rc_MPa", &force::ObliqueCoefficients::K_rc},
     {"K_ac_MPa", &force::ObliqueCoefficients::K_ac}}};

/// A value that grows with the rake [deg] and the chip [mm]; what is not given is 0.
double value_at(std::span<const double> parts, double rake_deg, double chip_mm) {
  const std::array<double, 3> by = {1.0, rake_deg, chip_mm};
  double sum = 0.0;
  for (std::size_t i = 0; i < std::min(parts.size(), by.size()); ++i) {
    sum += parts[i] * by[i];
  }
  return sum;
}

void check_length(const char* key, std::size_t size, std::size_t most,
                  Findings& findings) {
  const std::string path = fmt::format("orthogonal.{}", key);
  if (size > most && sound(findings, {path})) {
    report(findings, path,
           fmt::format(
               "{} = [...]: {} numbers; must be at most {}: the value, by how much "
               "it grows with a degree of rake{}",
               path, size, most, most > 2 ? ", and with a mm of chip" : ""));
  }
}

/// [force] has no coefficients beside [orthogonal], and is linear in the chip.
void check_beside(const ForceTable& force, Findings& findings) {
  for (const auto& [key, member] : coefficients) {
    const auto given = force.numbers.find(key);
    if (given != force.numbers.end() && given->second) {
      report(
          findings, fmt::format("force.{}", key),
          fmt::format("force.{}: [orthogonal] says it as well; give one of them", key));
    }
  }
  if (force.law != 0) {
    report(findings, "force.law",
           fmt::format("force.law = \"{}\": must be \"{}\" with [orthogonal]",
                       force::law_names[static_cast<std::size_t>(force.law)],
                       force::law_names[0]));
  }
}

/// Keys without which nothing can be computed.
constexpr std::initializer_list<const char*> needed_keys = {
    "orthogonal.shear_stress_MPa",
    "orthogonal.friction_angle_deg",
    "orthogonal.shear_angle_deg",
    "orthogonal.chip_ratio",
    "orthogonal.rake_deg",
    "orthogonal.chip_mm",
    "orthogonal.inclination_deg",
    "orthogonal.chip_ratio_exponent",
    "cut.feed_rate_mm_per_min",
    "cut.spindle_rpm",
    "tool.teeth",
    "tool.diameter_mm",
    "tool.helix_deg",
    "cut.engagement",
    "cut.feed_per_tooth_mm",
    "cut.radial_depth_mm",
    "cut.stock_y_mm"};

double usual_chip(const geometry::Cut& cut, double D) {
  const chip::Arc arc = chip::tooth_arc(cut.engagement, D, D / 2);
  return arc.to > arc.from ? force::mean_chip(cut.f_z, arc.from, arc.to) : 0.0;
}

bool is_coefficient(const Member& member) {
  return std::ranges::any_of(coefficients,
                             [&](const auto& c) { return c.first == member.key; });
}

/// Its keys against one another and against [force].
/// @return whether anything can be computed from them
bool check_keys(const OrthogonalTable& o, const ForceTable& force, Findings& findings) {
  check_length("shear_stress_MPa", o.shear_stress.size(), 3, findings);
  check_length("friction_angle_deg", o.friction_angle.size(), 3, findings);
  check_length("shear_angle_deg", o.shear_angle.size(), 3, findings);
  check_length("chip_ratio", o.chip_ratio.size(), 2, findings);
  check_length("chip_ratio_exponent", o.chip_ratio_exponent.size(), 2, findings);
  if (!o.shear_angle.empty() && !o.chip_ratio.empty()) {
    report(findings, "orthogonal.chip_ratio",
           "orthogonal.chip_ratio: shear_angle_deg says it as well; give one of them");
  }
  check_beside(force, findings);
  return std::ranges::all_of(needed_keys,
                             [&](const char* key) { return sound(findings, {key}); });
}

/// What the tables say at the rake of the teeth and a chip [mm].
force::OrthogonalCut cut_at(const OrthogonalTable& o, double chip) {
  const double rake = o.rake / unit::deg;
  const double ratio = value_at(o.chip_ratio, rake, 0) *
                       std::pow(chip, value_at(o.chip_ratio_exponent, rake, 0));
  return {.tau_s = value_at(o.shear_stress, rake, chip),
          .phi_c = o.shear_angle.empty() ? force::shear_angle(ratio, o.rake)
                                         : value_at(o.shear_angle, rake, chip),
          .beta_a = value_at(o.friction_angle, rake, chip),
          .alpha_n = o.rake};
}

bool is_possible(const force::OrthogonalCut& cut) {
  constexpr double right = std::numbers::pi / 2;
  return cut.tau_s > 0 && cut.phi_c > 0 && cut.beta_a > 0 && cut.beta_a < right &&
         cut.phi_c + cut.beta_a - cut.alpha_n < right;
}

}  // namespace

Node without_outvoted_coefficients(Node root) {
  auto& tables = std::get<Members>(root.value);
  const auto orthogonal = std::ranges::find(tables, "orthogonal", &Member::key);
  const auto force = std::ranges::find(tables, "force", &Member::key);
  if (orthogonal == tables.end() || force == tables.end()) return root;
  auto* numbers = std::get_if<Members>(&force->node.value);
  if (numbers == nullptr) return root;
  const bool own = std::ranges::any_of(
      *numbers, [](const Member& m) { return is_coefficient(m) && !m.node.inherited; });
  if (!orthogonal->node.inherited) {
    std::erase_if(*numbers, [](const Member& m) {
      return is_coefficient(m) && m.node.inherited;
    });
  } else if (own) {
    tables.erase(orthogonal);
  }
  return root;
}

void settle_orthogonal(CaseTables& t, const force::Setup& setup, Command purpose,
                       Findings& findings) {
  if (!t.orthogonal) return;
  const OrthogonalTable o = *t.orthogonal;
  if (!check_keys(o, t.force, findings)) return;
  const double chip =
      o.chip.value_or(usual_chip(setup.cut, setup.cutter.profile.D)) / unit::mm;
  if (!(chip > 0)) {
    report(
        findings, "orthogonal",
        "[orthogonal]: nothing is cut, and so there is no mean chip to take it at; give "
        "chip_mm, or a feed above 0");
    return;
  }
  const force::OrthogonalCut cut = cut_at(o, chip);
  const std::string said = fmt::format(
      "at a rake of {:.4g} deg and a chip of {:.4g} mm the shear stress is {:.4g} MPa, the "
      "shear angle {:.4g} deg and the friction angle {:.4g} deg",
      o.rake / unit::deg, chip, cut.tau_s / unit::MPa, cut.phi_c / unit::deg,
      cut.beta_a / unit::deg);
  if (!is_possible(cut)) {
    report(findings, "orthogonal",
           fmt::format(
               "[orthogonal]: {}: no chip flows so; each must be above 0, and shear "
               "angle + friction angle - rake below 90 deg",
               said));
    return;
  }
  const double i = o.inclination.value_or(setup.cutter.helix);
  const force::ObliqueCoefficients K = force::oblique_coefficients(cut, i);
  for (const auto& [key, member] : coefficients) {
    t.force.numbers[key] = as_written(K.*member, unit::MPa);
  }
  t.orthogonal.reset();
  if (purpose == Command::identify || purpose == Command::calibrate) return;
  findings.notes.push_back(
      {"orthogonal_cutting",
       fmt::format(
           "K_tc = {:.4g}, K_rc = {:.4g} and K_ac = {:.4g} MPa are computed from "
           "[orthogonal] (F-19): {}. A measured cut tells better.",
           K.K_tc / unit::MPa, K.K_rc / unit::MPa, K.K_ac / unit::MPa, said)});
}

}  // namespace trochoid::cases
