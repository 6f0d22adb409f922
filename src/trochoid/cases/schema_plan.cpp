#include <trochoid/cases/schema_choice.h>
#include <trochoid/cases/tables.h>

namespace trochoid::cases {

namespace {

Only of_forces() {
  return {"of", {"auto", "forces"}};
}

Only of_wall() {
  return {"of", {"auto", "wall"}};
}

Only of_finish() {
  return {"of", {"auto", "finish"}};
}

void describe_force_cuts(const Visitor& v, Plan& t) {
  v({.name = "engagement", .meaning = "kinds of cut to look at", .only = of_forces()},
    choices(t.engagements));
}

void describe_feeds(const Visitor& v, Plan& t) {
  v({.name = "feed_per_tooth_mm",
     .meaning = "feeds per tooth to look at; of a wall: of the map of its error",
     .range = above_up_to(0, 100),
     .standard = "half, 0.75, 1, 1.5 and 2 times the feed of [cut]; of a wall or a "
                 "finish: 15 from a quarter to twice that feed",
     .example = "[0.02, 0.04, 0.08]"},
    &t.feeds);
}

void describe_radial_depths(const Visitor& v, Plan& t) {
  v({.name = "radial_depth_mm",
     .meaning =
         "radial depths of cut to look at, for up and down; of a wall: of the map "
         "of its error",
     .range = above_up_to(0, 10000),
     .only = {"of", {"auto", "forces", "wall"}},
     .standard =
         "0.1, 0.25, 0.5 and 0.75 of the diameter; of a wall: 15 from a quarter "
         "to twice the depth of [cut]",
     .example = "[1, 2, 4]"},
    &t.radial_depths);
}

void describe_force_records(const Visitor& v, Plan& t) {
  v({.name = "axial_depth_mm",
     .meaning = "axial depths of cut to look at",
     .range = above_up_to(0, 10000),
     .only = of_forces(),
     .standard = "as in [cut]",
     .example = "[1, 2]"},
    &t.axial_depths);
  v({.name = "turns",
     .meaning = "turns of the spindle that would be recorded of a cut",
     .range = between(1, 100000),
     .only = of_forces()},
    &t.turns);
  v({.name = "samples_per_rev",
     .meaning = "samples in one turn",
     .range = between(24, 3600),
     .only = of_forces()},
    &t.samples_per_rev);
  v({.name = "noise_N",
     .meaning = "standard deviation of one sample of each channel",
     .range = above_up_to(0, 1e6),
     .only = of_forces(),
     .standard = "what the fit of the measurements leaves; else 2 % of the peak force "
                 "of [cut]",
     .example = "5"},
    &t.noise);
  v({.name = "max_force_N",
     .meaning = "largest force in the plane of the table that a cut may reach",
     .range = above_up_to(0, 1e9),
     .only = of_forces(),
     .standard = "no limit",
     .example = "800"},
    &t.max_force);
  v({.name = "quantities",
     .meaning = "what the cut is to tell: coefficients by their names without unit, "
                "coefficients for all of them, runout",
     .only = of_forces(),
     .standard = "the tangential and the radial cutting coefficient, and the runout "
                 "where it is looked for",
     .example = "[\"K_tc\", \"runout\"]"},
    &t.quantities);
}

void describe_wall(const Visitor& v, WallPlan& t) {
  v({.name = "heights",
     .meaning = "numbers of heights at which a wall may be measured",
     .range = between(2, 200),
     .only = of_wall(),
     .standard = "2, 3, 5, 9, 13 and 21",
     .example = "[5, 9, 13]"},
    &t.heights);
  v({.name = "readings_per_height",
     .meaning = "numbers of readings at each height, over whole turns of the feed",
     .range = between(1, 10000),
     .only = of_wall(),
     .standard = "1, 4, 8, 16 and 32 times the teeth",
     .example = "[12, 36]"},
    &t.per_height);
  v({.name = "spread",
     .meaning = "from the lowest to the highest height, as parts of the axial depth",
     .range = between(0.01, 1),
     .only = of_wall(),
     .standard = "0.5 and 0.8",
     .example = "[0.8]"},
    &t.spreads);
  v({.name = "noise_um",
     .meaning = "standard deviation of one reading of a wall",
     .range = above_up_to(0, 1e4),
     .only = of_wall(),
     .standard = "what the fit of the measurements leaves; else 1",
     .example = "1"},
    &t.noise);
  v({.name = "form",
     .meaning = "what of the form of the readings is unknown; each has all before it",
     .only = of_wall(),
     .example = "\"offset\""},
    choice(t.form, "auto"));
  v({.name = "wanted_percent",
     .meaning = "half of the 95 % interval of either coefficient that is wanted",
     .range = above_up_to(0, 1000),
     .only = of_wall(),
     .standard = "10",
     .example = "10"},
    &t.wanted);
  v({.name = "wanted_um",
     .meaning = "half of the 95 % interval of the eccentricity that is wanted",
     .range = above_up_to(0, 1e4),
     .only = of_wall(),
     .standard = "1",
     .example = "1"},
    &t.wanted_runout);
  v({.name = "largest_error_um",
     .meaning = "error of the wall that is allowed: which cut and which wall keep it",
     .range = above_up_to(0, 1e5),
     .only = of_wall(),
     .standard = "none",
     .example = "30"},
    &t.largest_error);
  v({.name = "limited",
     .meaning = "whether the largest error anywhere or the mean keeps largest_error_um",
     .only = of_wall()},
    choice(t.limited));
}

void describe_finish(const Visitor& v, FinishPlanTable& t) {
  v({.name = "largest_Ra_um",
     .meaning = "Ra that is allowed on the lines of [surface]: which feed keeps it",
     .range = above_up_to(0, 1000),
     .only = of_finish(),
     .standard = "none",
     .example = "1.6"},
    &t.largest_Ra);
  v({.name = "inserts_within_um",
     .meaning = "another set of inserts, for comparison: all of them within so much",
     .range = between(0, 1000),
     .only = of_finish()},
    &t.inserts_within);
}

}  // namespace

void describe(const Visitor& v, Plan& t) {
  v({.name = "of",
     .meaning =
         "plan a record of forces, readings of a wall, or the feed that keeps a "
         "finish; auto: a wall where the case has [surface] or "
         "[[surface_measurement]] and no [[measurement]], a finish where [surface] "
         "has floor_y_mm and no heights_mm"},
    choice(t.of, "auto"));
  const bool wall = !t.settled || t.of == PlanOf::wall;
  const bool forces = !t.settled || t.of == PlanOf::forces;
  const bool finish = !t.settled || t.of == PlanOf::finish;
  if (forces) {
    describe_force_cuts(v, t);
  }
  describe_feeds(v, t);
  if (!t.settled || t.of != PlanOf::finish) {
    describe_radial_depths(v, t);
  }
  if (forces) {
    describe_force_records(v, t);
  }
  if (wall) {
    describe_wall(v, t.wall);
  }
  if (finish) {
    describe_finish(v, t.finish);
  }
}

}  // namespace trochoid::cases
