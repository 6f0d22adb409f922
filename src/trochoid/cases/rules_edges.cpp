#include <trochoid/base/units.h>
#include <trochoid/cases/number_text.h>
#include <trochoid/cases/rules.h>
#include <trochoid/geometry/arcs.h>
#include <trochoid/geometry/tooth_edges.h>

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <variant>

namespace trochoid::cases {

namespace {

/// Heights at which edges are compared with one another.
constexpr int looks = 200;

/// What commands that know closed forms only take.
constexpr std::string_view alike_in_words =
    "takes cutters whose teeth have one edge: one helix_deg from 0 on, no serration, "
    "axial_offsets_mm of 0 and tilt_deg = 0; simulate, identify, stability, program and "
    "the finish of surface and plan take any";

/// The first key that makes the teeth differ from one another, and how.
struct Difference {
  std::string key;
  std::string why;
};

std::optional<Difference> difference(const CaseTables& t) {
  const geometry::Runout& runout = t.runout;
  const auto& helix = t.tool.helix.values;
  if (std::ranges::any_of(helix, [&](double one) { return one != helix.front(); })) {
    return Difference{"tool.helix_deg", "the helix differs from tooth to tooth"};
  }
  if (!helix.empty() && helix.front() < 0) {
    return Difference{"tool.helix_deg", "below 0"};
  }
  if (t.tool.serration && t.tool.serration->amplitude > 0) {
    return Difference{"tool.serration", "the edges are serrated"};
  }
  if (std::ranges::any_of(runout.axial_offsets, [](double a) { return a != 0; })) {
    return Difference{"runout.axial_offsets_mm", "the teeth do not reach as deep"};
  }
  if (runout.tilt != 0) {
    return Difference{"runout.tilt_deg", "the tool leans"};
  }
  return std::nullopt;
}

/// Whether the edges of a command may differ, in this case.
bool takes_any(const CaseTables& t, Command purpose) {
  const bool rigid = !t.machine.cutter_body && !t.machine.wall;
  const auto& surface = t.machine.surface;
  const bool profile = !surface || (surface->model == surface::Model::envelope &&
                                    surface->probe_diameter == 0);
  return purpose == Command::simulate || purpose == Command::identify ||
         purpose == Command::stability || purpose == Command::program ||
         purpose == Command::modes || purpose == Command::actuator ||
         (purpose == Command::plan && planned(t) == PlanOf::finish) ||
         (purpose == Command::surface && rigid && profile && t.machine.passes.empty());
}

void refuse_command(const CaseTables& t, Command purpose, Findings& findings) {
  const auto found = difference(t);
  if (!found || takes_any(t, purpose) || !sound(findings, {found->key})) {
    return;
  }
  const std::string_view what =
      purpose == Command::surface
          ? "surface with anything that bends, a probe, passes or another model than envelope"
          : "";
  report(findings, found->key,
         fmt::format("{}: {}; {} {}", found->key, found->why,
                     what.empty() ? name_of(purpose) : what, alike_in_words));
}

/// Stock that is given as arcs has them for one radius a height, and few commands know it.
void refuse_arcs(const CaseTables& t, const force::Setup& setup, Command purpose,
                 Findings& findings) {
  const std::string key = "cut.engagement";
  if (t.cut.engagement == EngagementKind::arcs && purpose != Command::simulate &&
      purpose != Command::identify && sound(findings, {key})) {
    report(
        findings, key,
        fmt::format("{} = \"arcs\": {} does not take arcs, simulate and identify do; "
                    "must be \"slot\", \"up\", \"down\" or \"band\"",
                    key, name_of(purpose)));
    return;
  }
  const auto found = difference(t);
  if (found && std::holds_alternative<geometry::Arcs>(setup.cut.engagement) &&
      sound(findings, {key, found->key})) {
    report(findings, key,
           fmt::format("{} = \"arcs\": not with {} ({}); must be \"slot\", \"up\", "
                       "\"down\" or \"band\" with it",
                       key, found->key, found->why));
  }
}

/// A serration leaves something of the flank.
void check_depth(const CaseTables& t, const force::Setup& setup, Findings& findings) {
  const std::string key = "tool.serration.amplitude_mm";
  if (!setup.cutter.serration ||
      !sound(findings, {"tool", key, "cut.axial_depth_mm"})) {
    return;
  }
  const geometry::Meridian m = geometry::meridian(setup.cutter.profile);
  const double top = std::max(setup.cut.a_p, m.N.z);
  const double at_top = m.N.r + (top - m.N.z) * std::tan(setup.cutter.profile.beta);
  const double thinnest = std::min(m.N.r, at_top);
  if (t.tool.serration->amplitude >= thinnest) {
    report(
        findings, key,
        fmt::format("{} = {} mm: not smaller than the radius of the flank, {} mm; must "
                    "be less (from crest to valley)",
                    key, mm(t.tool.serration->amplitude), mm(thinnest)));
  }
}

bool knows_serration(chip::Model model) {
  return model == chip::Model::radial || model == chip::Model::trochoidal;
}

bool is_serrated(const CaseTables& t) {
  return t.tool.serration && t.tool.serration->amplitude > 0;
}

/// Which chip models know a radius that changes within a height.
void check_serrated_chip(const CaseTables& t, Command purpose, Findings& findings) {
  const chip::Model model = t.chip.model;
  if (is_serrated(t) && !knows_serration(model) && purpose != Command::identify &&
      sound(findings, {"chip.model"})) {
    report(findings, "chip.model",
           fmt::format(
               "chip.model = \"{}\": knows no serration, whose depth it leaves out "
               "or multiplies by sin(theta); must be \"radial\" or \"trochoidal\"",
               chip::name_of(model)));
  }
}

/// Teeth pass in the order of their numbers at every height.
void check_order(const force::Setup& setup, Findings& findings) {
  const geometry::ToothEdges edges(setup.cutter, setup.runout);
  const std::size_t teeth = edges.teeth();
  for (int i = 0; i <= looks; ++i) {
    const double z = setup.cut.a_p * i / looks;
    for (std::size_t j = 0; j < teeth && teeth > 1; ++j) {
      const std::size_t next = (j + 1) % teeth;
      const double gap = edges.edge_at(next, z).omega - edges.edge_at(j, z).omega +
                         (next == 0 ? unit::turn : 0.0);
      if (gap > 0 && gap < unit::turn) continue;
      report(
          findings, "tool.helix_deg",
          fmt::format("tool.helix_deg: at {:.4g} mm above the tip the edge of tooth {} "
                      "crosses the edge of tooth {}; the angle between them must stay "
                      "above 0 over the axial depth",
                      z / unit::mm, next + 1, j + 1));
      return;
    }
  }
}

/// Teeth that do not reach the stock are said.
void note_lifted(const force::Setup& setup, Findings& findings) {
  const geometry::ToothEdges edges(setup.cutter, setup.runout);
  for (std::size_t j = 0; j < edges.teeth(); ++j) {
    const double lowest = edges.lowest_height(j);
    if (lowest < setup.cut.a_p) continue;
    findings.notes.push_back(
        {"tooth_above_stock",
         fmt::format(
             "Tooth {} begins {:.4g} mm above the nominal tip and the stock ends at "
             "{} mm: axial offset and tilt lift it out of the cut.",
             j + 1, lowest / unit::mm, mm(setup.cut.a_p))});
  }
}

}  // namespace

void settle_serrated_models(CaseTables& tables, Findings& findings) {
  const std::string key = "identify.chip_models";
  auto& models = tables.identify->chip_models;
  const auto ignorant = std::ranges::find_if_not(models, knows_serration);
  if (!is_serrated(tables) || ignorant == models.end() || !sound(findings, {key})) {
    return;
  }
  if (findings.places.count(key) == 0) {
    std::erase_if(models, [](chip::Model model) { return !knows_serration(model); });
    return;
  }
  report(findings, key,
         fmt::format("{}: \"{}\" knows no serration; must be any of \"radial\", "
                     "\"trochoidal\" with it",
                     key, chip::name_of(*ignorant)));
}

void check_edges(CaseTables& tables, const force::Setup& setup, Command purpose,
                 Findings& findings) {
  refuse_command(tables, purpose, findings);
  refuse_arcs(tables, setup, purpose, findings);
  check_depth(tables, setup, findings);
  check_serrated_chip(tables, purpose, findings);
  if (!sound(findings, {"tool", "runout", "cut"}) || !findings.problems.empty() ||
      geometry::edges_alike(setup.cutter, setup.runout)) {
    return;
  }
  check_order(setup, findings);
  note_lifted(setup, findings);
}

}  // namespace trochoid::cases
