#include <trochoid/base/index.h>
#include <trochoid/base/units.h>
#include <trochoid/cases/number_text.h>
#include <trochoid/cases/rules.h>

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace trochoid::cases {

namespace {

/// More would take minutes, and nobody reads the list.
constexpr std::size_t most_cuts = 20000;

/// Whether a fit finds it: with a model that feels it, and a second tooth.
bool looks_for_runout(const CaseTables& t) {
  const auto& models = t.identify->chip_models;
  const bool felt = t.measurements.empty()
                        ? chip::feels_runout(t.chip.model)
                        : std::any_of(models.begin(), models.end(), [](chip::Model m) {
                            return chip::feels_runout(m);
                          });
  const bool found = std::ranges::none_of(t.identify->runout, [](RunoutGroup group) {
    return group == RunoutGroup::none || group == RunoutGroup::fixed;
  });
  return felt && found && t.tool.teeth > 1;
}

/// Names without their unit: coefficients and exponents of the law.
std::vector<std::string> names_of_law(const ForceTable& force) {
  const force::Law& law = force::law_kinds[base::index(force.law)];
  std::vector<std::string> out;
  for (const force::Quantity& K : force::coefficient_quantities(law)) {
    out.emplace_back(plain_name(K.key));
  }
  for (const force::Quantity& m : force::exponent_quantities(law)) {
    out.emplace_back(m.key);
  }
  return out;
}

/// One list of depths or feeds, from a default that follows from [cut].
void fill(std::vector<double>& list, std::initializer_list<double> parts, double of) {
  if (!list.empty()) {
    return;
  }
  for (const double part : parts) {
    // A nanometre is near enough, and short to read.
    const double nanometres = std::round(part * of / unit::mm * 1e6);
    list.push_back(as_written(nanometres * 1e-6 * unit::mm, unit::mm));
  }
}

void check_quantities(CaseTables& t, Findings& findings) {
  Plan& plan = *t.plan;
  if (!sound(findings, {"plan.quantities", "force.law", "tool.teeth"})) {
    return;
  }
  const std::vector<std::string> law = names_of_law(t.force);
  if (plan.quantities.empty()) {
    plan.quantities = {law[0], law[1]};
    if (looks_for_runout(t)) {
      plan.quantities.emplace_back("runout");
    }
  }
  for (std::string& name : plan.quantities) {
    const std::string plain{plain_name(name)};
    if (std::find(law.begin(), law.end(), plain) != law.end()) {
      name = plain;
    } else if (name == "runout" && !looks_for_runout(t)) {
      report(
          findings, "plan.quantities",
          "plan.quantities: \"runout\" is not looked for: that takes [identify] "
          "runout = \"auto\", \"offsets\" or \"eccentricity\", a chip model that feels it and "
          "two teeth");
    } else if (name != "runout" && name != "coefficients") {
      report(findings, "plan.quantities",
             fmt::format("plan.quantities: {} is none; must be of \"coefficients\", "
                         "\"runout\", \"{}\" (what the cut is to tell)",
                         toml_string(name), fmt::join(law, "\", \"")));
    }
  }
}

void check_radial(const CaseTables& t, Findings& findings) {
  if (!sound(findings, {"plan.radial_depth_mm", "tool.diameter_mm"})) {
    return;
  }
  for (const double a_e : t.plan->radial_depths) {
    if (a_e > t.tool.diameter) {
      report(findings, "plan.radial_depth_mm",
             fmt::format("plan.radial_depth_mm: {} mm is more than diameter_mm = {} mm",
                         number_text(a_e, unit::mm),
                         number_text(t.tool.diameter, unit::mm)));
    }
  }
}

}  // namespace

std::string_view plain_name(std::string_view key) {
  const std::size_t second = key.find('_', std::min(key.size(), key.find('_') + 1));
  return key.substr(0, second);
}

void check_plan(CaseTables& t, Findings& findings) {
  settle_plan(t, findings);
  check_radial(t, findings);
  if (t.plan->of == PlanOf::wall) {
    check_wall_plan(t, findings);
    return;
  }
  if (t.plan->of == PlanOf::finish) {
    check_finish_plan(t, findings);
    return;
  }
  Plan& plan = *t.plan;
  fill(plan.feeds, {0.5, 0.75, 1.0, 1.5, 2.0}, t.cut.feed_per_tooth.value_or(0.0));
  fill(plan.axial_depths, {1.0}, t.cut.axial_depth);
  fill(plan.radial_depths, {0.1, 0.25, 0.5, 0.75}, t.tool.diameter);
  check_quantities(t, findings);
  if (!(t.cut.feed_per_tooth.value_or(0.0) > 0) &&
      sound(findings, {"cut", "cut.feed_per_tooth_mm", "cut.feed_rate_mm_per_min"})) {
    report(findings, "cut.feed_per_tooth_mm",
           "cut.feed_per_tooth_mm = 0 mm: nothing is cut, and the feeds of a plan "
           "start from it; must be above 0");
  }
  const std::size_t count = 3 * plan.feeds.size() * plan.axial_depths.size() *
                            std::max<std::size_t>(1, plan.radial_depths.size());
  if (count > most_cuts) {
    report(findings, "plan",
           fmt::format("[plan]: {} combinations of engagements, feeds and depths; must "
                       "be at most {}",
                       count, most_cuts));
  }
  if (t.measurements.empty() && findings.places.count("force") == 0 &&
      sound(findings, {"force", "measurement"})) {
    report(findings, "force",
           "[force] is missing (the force law and its coefficients, as forces on the "
           "tool); plan needs it, or a [[measurement]] to find them from");
  }
}

}  // namespace trochoid::cases
