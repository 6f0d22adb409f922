#include <trochoid/inputs/schema_choice.h>
#include <trochoid/inputs/tables.h>

namespace trochoid::inputs {

void describe(const Visitor& v, Plan& t) {
  v({.name = "engagement", .meaning = "kinds of cut to look at"},
    choices(t.engagements));
  v({.name = "feed_per_tooth_mm",
     .meaning = "feeds per tooth to look at",
     .range = above_up_to(0, 100),
     .standard = "half, 0.75, 1, 1.5 and 2 times that of [cut]",
     .example = "[0.02, 0.04, 0.08]"},
    &t.feeds);
  v({.name = "axial_depth_mm",
     .meaning = "axial depths of cut to look at",
     .range = above_up_to(0, 10000),
     .standard = "that of [cut]",
     .example = "[1, 2]"},
    &t.axial_depths);
  v({.name = "radial_depth_mm",
     .meaning = "radial depths of cut to look at, for up and down",
     .range = above_up_to(0, 10000),
     .standard = "0.1, 0.25, 0.5 and 0.75 of the diameter",
     .example = "[1, 2, 4]"},
    &t.radial_depths);
  v({.name = "turns",
     .meaning = "turns of the spindle that would be recorded of a cut",
     .range = between(1, 100000)},
    &t.turns);
  v({.name = "samples_per_rev",
     .meaning = "samples in one turn",
     .range = between(24, 3600)},
    &t.samples_per_rev);
  v({.name = "noise_N",
     .meaning = "standard deviation of one sample of each channel",
     .range = above_up_to(0, 1e6),
     .standard = "what the fit of the measurements leaves; else 2 % of the peak force "
                 "of [cut]",
     .example = "5"},
    &t.noise);
  v({.name = "max_force_N",
     .meaning = "largest force in the plane of the table that a cut may reach",
     .range = above_up_to(0, 1e9),
     .standard = "no limit",
     .example = "800"},
    &t.max_force);
  v({.name = "quantities",
     .meaning = "what the cut is to tell: coefficients by their names without unit, "
                "coefficients for all of them, runout",
     .standard = "the tangential and the radial cutting coefficient, and the runout "
                 "where it is looked for",
     .example = "[\"K_tc\", \"runout\"]"},
    &t.quantities);
}

}  // namespace trochoid::inputs
