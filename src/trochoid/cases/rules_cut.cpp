#include <trochoid/base/index.h>
#include <trochoid/base/units.h>
#include <trochoid/cases/number_text.h>
#include <trochoid/cases/rules.h>
#include <trochoid/cases/usual_values.h>
#include <trochoid/geometry/meridian.h>

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace trochoid::cases {

namespace {

/// Two feeds agree when they differ by less than this part: files round them.
constexpr double feed_slack = 1e-3;

constexpr double most_samples = 1e7;

/// Feed per tooth is kept, feed rate is dropped once it has been used.
void settle_feed(CutTable& cut, const std::string& path, int teeth,
                 Findings& findings) {
  if (!cut.feed_rate ||
      !sound(findings, {"tool.teeth", path + ".spindle_rpm",
                        path + ".feed_rate_mm_per_min", path + ".feed_per_tooth_mm"})) {
    return;
  }
  const double teeth_per_second = teeth * cut.spindle_speed / unit::turn;
  const double from_rate = *cut.feed_rate / teeth_per_second;
  const double stated = cut.feed_per_tooth.value_or(from_rate);
  if (std::abs(stated - from_rate) > feed_slack * std::max(stated, from_rate)) {
    report(findings, path + ".feed_rate_mm_per_min",
           fmt::format("{}.feed_rate_mm_per_min = {} mm/min: with {} teeth at {} rpm "
                       "this is {:.6g} mm per tooth, but feed_per_tooth_mm = {}; give "
                       "one of them, or {:.6g} mm/min",
                       path, number_text(*cut.feed_rate, unit::mm_per_min), teeth,
                       number_text(cut.spindle_speed, unit::rpm), from_rate / unit::mm,
                       mm(stated), stated * teeth_per_second / unit::mm_per_min));
    return;
  }
  cut.feed_per_tooth =
      cut.feed_per_tooth ? *cut.feed_per_tooth : as_written(from_rate, unit::mm);
  cut.feed_rate.reset();
}

/// Below it nothing is cut, with the sharpest diamond [m].
constexpr double thinnest_feed = 1e-9;

/// A tooth that is fed as fast as it turns never comes round behind another one.
void check_feed(const CutTable& cut, const std::string& path,
                const geometry::Cutter& cutter, Findings& findings) {
  const std::string key = path + ".feed_per_tooth_mm";
  const double feed = cut.feed_per_tooth.value_or(0.0);
  if (feed > 0 && feed < thinnest_feed && sound(findings, {key})) {
    report(
        findings, key,
        fmt::format("{} = {} mm: thinner than any chip; must be 0 or at least {:g} mm",
                    key, mm(feed), thinnest_feed / unit::mm));
  }
  const geometry::Profile& profile = cutter.profile;
  const double widest =
      profile.D + 2 * cut.axial_depth * std::tan(std::max(profile.beta, 0.0));
  const double most = std::numbers::pi * widest / cutter.teeth();
  if (!(feed >= most) || !sound(findings, {"tool.teeth", "tool.diameter_mm", key,
                                           path + ".axial_depth_mm"})) {
    return;
  }
  report(findings, key,
         fmt::format("{} = {} mm: in a turn the tool is fed by as much as its teeth go "
                     "round, and cuts nothing; must be less than {:.6g} mm (pi "
                     "times the diameter over the teeth)",
                     key, mm(feed), most / unit::mm));
}

/// Arcs from one height: ascending, and none over another.
std::vector<geometry::EngagedArc> engaged(const Pairs& arcs, const std::string& key,
                                          Findings& findings) {
  std::vector<geometry::EngagedArc> out;
  for (const auto& [from, to] : arcs) {
    const double last = out.empty() ? from : out.back().arc.to;
    const double first = out.empty() ? from : out.front().arc.from;
    if (!(to > from) || from < last || to > first + unit::turn + 1e-9) {
      report(findings, key,
             fmt::format("{}: from {:.6g} to {:.6g} deg: not in order; must be arcs of "
                         "ascending angles that do not lie over each other, within one "
                         "turn",
                         key, from / unit::deg, to / unit::deg));
      return {};
    }
    out.push_back({.arc = {from, to}});
  }
  return out;
}

geometry::Arcs arcs_of(const CutTable& cut, const std::string& path,
                       Findings& findings) {
  geometry::Arcs out;
  if (cut.path_radius) {
    const std::string key = path + ".path_radius_mm";
    if (*cut.path_radius == 0 && sound(findings, {key})) {
      report(findings, key,
             fmt::format("{} = 0 mm: no radius; must be a number other than 0, or left "
                         "out where the path is straight",
                         key));
    } else {
      out.curvature = 1 / *cut.path_radius;
    }
  }
  if (!cut.arcs.empty()) {
    out.layers.push_back({.arcs = engaged(cut.arcs, path + ".arcs_deg", findings)});
  }
  double top = 0.0;
  for (const ArcLayerTable& layer : cut.layers) {
    const std::string key = path + ".layers";
    if (layer.from < top || !(layer.to > layer.from)) {
      report(
          findings, key,
          fmt::format("{}: from {} to {} mm: not in order; must be layers from below, "
                      "none over another",
                      key, mm(layer.from), mm(layer.to)));
      break;
    }
    out.layers.push_back({.from = layer.from,
                          .to = layer.to,
                          .arcs = engaged(layer.arcs, key, findings)});
    top = layer.to;
  }
  return out;
}

geometry::Engagement engagement_of(const CutTable& cut, const std::string& path,
                                   double D, Findings& findings) {
  if (cut.engagement == EngagementKind::arcs) return arcs_of(cut, path, findings);
  const double a_e = cut.radial_depth.value_or(0.0);
  switch (cut.engagement) {
    case EngagementKind::slot:
      return geometry::Slot{};
    case EngagementKind::band:
      if (cut.stock_y.size() != 2) {
        return geometry::Band{};
      }
      if (cut.stock_y[0] >= cut.stock_y[1] && sound(findings, {path + ".stock_y_mm"})) {
        report(findings, path + ".stock_y_mm",
               fmt::format("{}.stock_y_mm = [{}, {}]: not in order; must be the lower, "
                           "then the higher y of the stock",
                           path, mm(cut.stock_y[0]), mm(cut.stock_y[1])));
      }
      return geometry::Band{cut.stock_y[0], cut.stock_y[1]};
    default:
      break;
  }
  const std::string key = path + ".radial_depth_mm";
  if (a_e > D && sound(findings, {key, "tool.diameter_mm"})) {
    report(findings, key,
           fmt::format("{} = {} mm: more than diameter_mm = {} mm; must be a number "
                       "above 0 and at most {} mm (radial depth of cut)",
                       key, mm(a_e), mm(D), mm(D)));
  }
  return cut.engagement == EngagementKind::up
             ? geometry::Engagement{geometry::UpMilling{a_e}}
             : geometry::Engagement{geometry::DownMilling{a_e}};
}

/// A flank that leans inwards ends where it meets the axis.
void check_height(const CutTable& cut, const std::string& path,
                  const geometry::Profile& profile, Findings& findings) {
  const std::string key = path + ".axial_depth_mm";
  if (profile.beta >= 0 || !sound(findings, {"tool", key})) {
    return;
  }
  const double u =
      profile.D / 2 * (1 - std::tan(profile.alpha) * std::tan(profile.beta));
  const double apex = -u / std::tan(profile.beta);
  if (cut.axial_depth >= apex) {
    report(
        findings, key,
        fmt::format("{} = {} mm: the flank meets the axis at {:.6g} mm; must be less "
                    "(axial depth of cut)",
                    key, mm(cut.axial_depth), apex / unit::mm));
  }
}

/// Nothing that cuts winds about itself this often; a slip of the helix does.
void check_windings(const CutTable& cut, const std::string& path,
                    const geometry::Cutter& cutter, Findings& findings) {
  constexpr double most_windings = 1000;
  const std::string key = path + ".axial_depth_mm";
  if (!sound(findings,
             {"tool.diameter_mm", "tool.helix_deg", "tool.lag_diameter_mm", key}) ||
      !(cutter.lag_diameter > 0)) {
    return;
  }
  const double windings = 2 * cut.axial_depth * std::abs(std::tan(cutter.helix)) /
                          (cutter.lag_diameter * unit::turn);
  if (windings > most_windings) {
    report(findings, key,
           fmt::format("{} = {} mm: over it the edge winds {:.4g} times around the "
                       "cutter; must be at most {:g} (helix_deg, lag_diameter_mm)",
                       key, mm(cut.axial_depth), windings, most_windings));
  }
}

/// What each by itself may well be, but not on this tool.
void note_proportions(const CutTable& cut, const std::string& path, double D,
                      Findings& findings) {
  const auto note = [&](std::string_view name, double value, double most) {
    const std::string key = fmt::format("{}.{}", path, name);
    const std::string start = fmt::format(": {} = ", key);
    const bool noted = std::ranges::any_of(findings.notes, [&](const auto& known) {
      return known.message.find(start) != std::string::npos;
    });
    if (value <= most * D || noted || !sound(findings, {"tool.diameter_mm", key})) {
      return;
    }
    findings.notes.push_back(
        {"unusual_value",
         fmt::format(
             "{}{}{} mm: {:.3g} diameters of the tool; ordinary are up to {:g}; "
             "is the unit right?",
             to_string(place_of(findings, key)), start, mm(value), value / D, most)});
  };
  note("feed_per_tooth_mm", cut.feed_per_tooth.value_or(0.0), usual_feed_per_diameter);
  note("axial_depth_mm", cut.axial_depth, usual_depth_per_diameter);
}

}  // namespace

geometry::Cut cut_of(CutTable& cut, const std::string& path,
                     const geometry::Cutter& cutter, Findings& findings) {
  settle_feed(cut, path, cutter.teeth(), findings);
  check_feed(cut, path, cutter, findings);
  check_height(cut, path, cutter.profile, findings);
  check_windings(cut, path, cutter, findings);
  note_proportions(cut, path, cutter.profile.D, findings);
  return {.engagement = engagement_of(cut, path, cutter.profile.D, findings),
          .a_p = cut.axial_depth,
          .f_z = cut.feed_per_tooth.value_or(0.0),
          .Omega = cut.spindle_speed};
}

void check_chip(const chip::ChipModel& chip, Findings& findings) {
  const bool paths =
      chip.model == chip::Model::feed || chip.model == chip::Model::trochoidal;
  if (chip.lookback == chip::Lookback::previous && !paths) {
    report(
        findings, "chip.lookback",
        fmt::format("chip.lookback = \"previous\": has no meaning for model = \"{}\"; "
                    "belongs to \"feed\" and \"trochoidal\" only (which earlier teeth "
                    "left the surface)",
                    chip::name_of(chip.model)));
  }
}

force::Law law_of(ForceTable& force, bool exponents_default) {
  constexpr double usual_exponent = 0.25;
  force::Law law = force::law_kinds[base::index(force.law)];
  for (const force::Quantity& quantity : force::quantities(law)) {
    std::optional<double>& given = force.numbers[quantity.key];
    if (exponents_default && !given && quantity.role == force::Role::exponent) {
      given = usual_exponent;
    }
    law = force::with_number(law, quantity.key, given.value_or(0.0));
  }
  return law;
}

force::ProcessDamping damping_of(ForceTable& force, Command purpose,
                                 Findings& findings) {
  constexpr double usual_friction = 0.3;
  constexpr std::array vibrating = {Command::stability, Command::dynamics,
                                    Command::correct};
  const double land = force.wear_land.value_or(0.0);
  if (!(land > 0)) {
    return {};
  }
  const std::string key = "force.wear_land_um";
  const std::string given = fmt::format("{} = {} um", key, number_text(land, unit::um));
  if (!force.indentation && sound(findings, {key, "force.indentation_N_per_mm3"})) {
    report(findings, key,
           given +
               ": [force] has no indentation_N_per_mm3; must be there with it "
               "(force on the flank per volume that it presses), or leave out "
               "wear_land_um");
  }
  if (std::find(vibrating.begin(), vibrating.end(), purpose) == vibrating.end()) {
    findings.notes.push_back(
        {"process_damping_ignored",
         fmt::format("{} has no meaning for {} and is ignored: a flank presses the "
                     "work where a cut vibrates, in stability, dynamics and correct.",
                     given, name_of(purpose))});
  }
  force.flank_friction = force.flank_friction.value_or(usual_friction);
  return {.wear_land = land,
          .indentation = force.indentation.value_or(0.0),
          .friction = *force.flank_friction};
}

void check_sampling(Sampling& sampling, Findings& findings) {
  const double samples = sampling.samples_per_rev * sampling.revolutions;
  if (sampling.angles.empty() && (samples > most_samples || samples < 1) &&
      sound(findings, {"sampling.samples_per_rev", "sampling.revolutions"})) {
    report(findings, "sampling.samples_per_rev",
           fmt::format("sampling.samples_per_rev = {} times revolutions = {}: {:.6g} "
                       "spindle angles; must be from 1 to 1e+07",
                       sampling.samples_per_rev, number_text(sampling.revolutions),
                       samples));
  }
}

}  // namespace trochoid::cases
