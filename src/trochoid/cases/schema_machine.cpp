#include <trochoid/cases/schema_choice.h>
#include <trochoid/cases/schema_machine.h>

namespace trochoid::cases {

namespace {

constexpr Range length = above_up_to(0, longest_mm);
/// From soft foam to twice diamond: below, everything is a hinge.
constexpr Range modulus = between(0.01, 10000);
/// From the thinnest foil [mm].
constexpr Range thickness = between(1e-3, longest_mm);

/// Loads that no cut makes.
void describe_loads(const Visitor& v, Wall& t) {
  const auto load = [&](std::string_view name, std::string_view meaning,
                        std::optional<double>& value) {
    v({.name = name,
       .meaning = meaning,
       .range = between(-1e6, 1e6),
       .standard = "none",
       .example = "1"},
      &value);
  };
  load("pressure_kPa",
       "a pressure on the whole wall: the deflection under it is reported in addition "
       "to the cut",
       t.pressure);
  load("edge_load_N_per_mm",
       "a load along the whole free edge: the deflection under it is reported",
       t.edge_load);
  load("line_load_N_per_mm",
       "a load on an upright line at position_mm, from the free edge down to the axial "
       "depth: the deflection under it is reported",
       t.line_load);
  v({.name = "loads_x_mm",
     .meaning = "where along the wall the deflections under these loads are wanted",
     .range = between(0, longest_mm),
     .standard = "spread over length_mm",
     .example = "[10, 30]"},
    &t.loads_x);
  v({.name = "loads_heights_mm",
     .meaning = "heights above the foot of the wall where they are wanted",
     .range = between(0, longest_mm),
     .standard = "spread over height_mm",
     .example = "[15, 30]"},
    &t.loads_heights);
}

}  // namespace

void describe(const Visitor& v, CutterBody& t) {
  v({.name = "overhang_mm",
     .meaning = "from the holder to the tip",
     .range = length,
     .need = Need::always},
    &t.overhang);
  v({.name = "flute_length_mm",
     .meaning = "length of the fluted part",
     .range = length,
     .standard = "overhang_mm"},
    &t.flute_length);
  v({.name = "shank_diameter_mm",
     .meaning = "diameter of the shank",
     .range = length,
     .standard = "[tool] diameter_mm",
     .example = "12"},
    &t.shank_diameter);
  v({.name = "equivalent_diameter_mm",
     .meaning = "diameter of a round bar as stiff as the fluted part",
     .range = length,
     .standard = "0.8 of [tool] diameter_mm",
     .example = "9.6"},
    &t.equivalent_diameter);
  v({.name = "youngs_modulus_GPa",
     .meaning = "Young's modulus of the cutter",
     .range = modulus,
     .need = Need::always},
    &t.youngs_modulus);
}

void describe(const Visitor& v, WallPass& t) {
  v({.name = "radial_depth_mm",
     .meaning = "how much this pass takes off; 0: a spring pass, which takes what the "
                "pass before left",
     .range = between(0, longest_mm),
     .standard = "as in [cut]",
     .example = "0.5"},
    &t.radial_depth);
  v({.name = "feed_per_tooth_mm",
     .meaning = "feed per tooth of this pass",
     .range = above_up_to(0, 1000),
     .standard = "as in [cut]",
     .example = "0.1"},
    &t.feed_per_tooth);
  v({.name = "below_edge_mm",
     .meaning = "how far below the free edge of the wall the top of this pass lies: to "
                "step down by the axial depth",
     .range = between(0, longest_mm),
     .standard = "0",
     .example = "3"},
    &t.below_edge);
}

void describe(const Visitor& v, Wall& t) {
  const auto size = [&](std::string_view name, std::string_view meaning, Range range,
                        double& value) {
    v({.name = name, .meaning = meaning, .range = range, .need = Need::always}, &value);
  };
  size("length_mm", "length of the wall along the feed", length, t.length);
  size("height_mm", "height of the wall above its clamping", length, t.height);
  size("thickness_mm", "thickness of the wall", thickness, t.thickness);
  v({.name = "youngs_modulus_GPa",
     .meaning = "Young's modulus of the wall",
     .range = modulus,
     .need = Need::always},
    &t.youngs_modulus);
  v({.name = "poisson_ratio",
     .meaning = "Poisson's ratio of the wall",
     .range = from_below(0, 0.5),
     .need = Need::always},
    &t.poisson_ratio);
  v({.name = "position_mm",
     .meaning = "where the cutter is along the wall",
     .range = between(0, longest_mm),
     .standard = "half of length_mm"},
    &t.position);
  v({.name = "ends",
     .meaning =
         "which ends of the wall are clamped, at 0 and at length_mm; free_start: "
         "only the far one; free_end: only the near one"},
    choice(t.ends));
  describe_loads(v, t);
}

namespace {

void describe_model(const Visitor& v, Surface& t) {
  v({.name = "model",
     .meaning = "quasi_static: the deflection at each spindle angle, a pulse and no "
                "surface; imprint: where each tooth touches the wall squarely; "
                "envelope: what all passes of all teeth leave"},
    choice(t.model));
  v({.name = "load",
     .meaning = "the force acts along the axial depth, or at its middle"},
    choice(t.load));
  v({.name = "feedback",
     .meaning = "what the deflection changes; entry: where an edge enters the stock; "
                "regenerative: the chip as well; direct: the chip as if earlier teeth "
                "had not been deflected; auto: calibrate lets the readings decide "
                "between none and regenerative, surface takes none"},
    choice(t.feedback, "auto"));
}

}  // namespace

void describe(const Visitor& v, Surface& t) {
  describe_model(v, t);
  v({.name = "phase_deg",
     .meaning = "spindle angle phi0 at the start",
     .range = between(-360, 360)},
    &t.phase);
  v({.name = "heights_mm",
     .meaning = "heights above the tip where the surface is wanted",
     .range = between(0, longest_mm),
     .standard = "edge_heights_mm of [sampling], else spread over the axial depth",
     .example = "[1, 2]"},
    &t.heights);
  v({.name = "influence_heights_mm",
     .meaning = "heights above the tip for influence.csv, at most the overhang",
     .range = between(0, longest_mm),
     .standard = "the heights of the surface",
     .example = "[0, 10]"},
    &t.influence_heights);
  v({.name = "probe_diameter_mm",
     .meaning = "diameter of the ball that touches the surface, which a measuring "
                "machine cannot avoid; 0: a point",
     .range = between(0, 100)},
    &t.probe_diameter);
  v({.name = "floor_y_mm",
     .meaning = "lines along the feed on which the floor is wanted, by their y",
     .range = between(-longest_mm, longest_mm),
     .standard = "no floor",
     .example = "[0, 10]"},
    &t.floor_y);
  v({.name = "cutoff_mm",
     .meaning = "cutoff of the Gaussian filter (ISO 16610-21) for roughness",
     .range = above_up_to(0, longest_mm),
     .standard = "no filter: one period of the profile",
     .example = "0.8"},
    &t.cutoff);
  v({.name = "outliers",
     .meaning = "calibrate: readings farther than five standard deviations from what "
                "the others say"},
    choice(t.outliers));
  v({.name = "errors",
     .meaning =
         "calibrate, standard errors and intervals: auto counts what readings of "
         "one height or one place have in common; white: as if each were "
         "independent"},
    choice(t.errors));
  v({.name = "also_bends",
     .meaning =
         "forces that bend cutter and wall in addition to the force across the wall; "
         "x: along the feed; z: along the axis, by its lever arm",
     .standard = "none",
     .example = "[\"x\", \"z\"]"},
    choices(t.also_bends));
}

}  // namespace trochoid::cases
