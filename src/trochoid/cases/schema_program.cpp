#include <trochoid/cases/schema_choice.h>
#include <trochoid/cases/schema_machine.h>

namespace trochoid::cases {

namespace {

constexpr Range coordinate = between(-longest_mm, longest_mm);

/// Which tool is which, and what is left out.
void describe_tools(const Visitor& v, NcProgram& t) {
  v({.name = "tool_number",
     .meaning = "which T the tool of this case is: a number, or a name in Sinumerik",
     .standard = "every T that [program] names nowhere else, if there is one only",
     .example = "1"},
    &t.tool_number);
  v({.name = "covariance",
     .meaning =
         "what identify or calibrate found of the tool of this case: the largest "
         "forces then have an interval",
     .standard = "no interval",
     .example = "\"case.identify\"",
     .file = "a summary.json of identify or calibrate, or its folder",
     .in_folder = "summary.json"},
    &t.covariance);
  v({.name = "tools",
     .meaning = "other tools by their T: cases with [tool], [runout] and [force]",
     .standard = "none",
     .example = "{ 2 = \"finisher.toml\" }",
     .file = "a case"},
    &t.tools);
  v({.name = "ignore_tools",
     .meaning = "tools whose moves cut nothing here; what they would cut stays",
     .standard = "none",
     .example = "[5]"},
    &t.ignored_tools);
  v({.name = "ignore_words",
     .meaning = "words that are not known and have no effect on the load",
     .standard = "none",
     .example = "[\"M10\"]"},
    &t.ignored_words);
}

void describe_frame(const Visitor& v, NcProgram& t) {
  v({.name = "origin_mm",
     .meaning = "program zero in the frame of the stock",
     .range = coordinate,
     .count = 3},
    &t.origin);
  v({.name = "start_mm",
     .meaning =
         "where the tip is before the first block, from program zero; needed where "
         "the program begins with a feed move",
     .range = coordinate,
     .count = 3,
     .standard = "not known",
     .example = "[0, 0, 50]"},
    &t.start);
  v({.name = "offsets_mm",
     .meaning = "zero of each work offset from there; needed from the second one that "
                "the program uses on",
     .range = coordinate,
     .standard = "none",
     .example = "{ G54 = [0, 0, 0], G55 = [60, 0, 0] }"},
    &t.offsets);
  v({.name = "compensation",
     .meaning = "what G41 and G42 are. refuse: mistakes; wear_zero: without effect, "
                "the program has the path of the center"},
    choice(t.compensation));
  v({.name = "block_delete", .meaning = "whether blocks with / are left out"},
    &t.block_delete);
}

/// At which places more is told.
void describe_places(const Visitor& v, NcProgram& t) {
  v({.name = "places",
     .meaning = "single places: a line of the program, and the fraction of the path of "
                "its first feed move, 0 to 1",
     .range = between(0, 1e9),
     .standard = "none",
     .example = "[[11, 0.97]]"},
    &t.places);
  v({.name = "place_heights_mm",
     .meaning = "heights above the tip at which the arcs at these places are reported",
     .range = between(0, longest_mm),
     .standard = "every layer",
     .example = "[0.05, 0.3]"},
    &t.place_heights);
}

}  // namespace

void describe(const Visitor& v, NcProgram& t) {
  v({.name = "file",
     .meaning = "the NC program",
     .need = Need::always,
     .example = "\"part.nc\"",
     .file = "an NC program in G code"},
    &t.file);
  v({.name = "dialect",
     .meaning = "how it is written. auto: as the text shows; iso: Fanuc, Haas, Mach3, "
                "grbl; heidenhain_iso is not read"},
    choice(t.dialect));
  describe_tools(v, t);
  describe_frame(v, t);
  v({.name = "step_turns",
     .meaning = "turns of the spindle in a step",
     .range = above_up_to(0, 1000)},
    &t.step_turns);
  v({.name = "bottom",
     .meaning = "the bottom edges of flat cutters in plunges and ramps. estimate: told "
                "apart from the flank; none: left out"},
    choice(t.bottom));
  v({.name = "floor_um",
     .meaning = "layers thinner than this decide no angle and no cause",
     .range = between(0, 1000)},
    &t.floor);
  describe_places(v, t);
}

void describe(const Visitor& v, Stock& t) {
  v({.name = "box_mm",
     .meaning = "a box: its lowest and its highest corner",
     .range = coordinate,
     .count = 2,
     .standard = "none: another stock",
     .example = "[[0, 0, -20], [80, 60, 0]]"},
    &t.box);
  v({.name = "cylinder_mm",
     .meaning = "a round bar along z: its axis, radius, lowest and highest z",
     .range = coordinate,
     .standard = "none: another stock",
     .example = "{ axis_xy = [0, 0], radius = 20, z = [-30, 0] }"},
    &t.cylinder);
  v({.name = "file",
     .meaning = "a closed surface (STL), of which the height from above counts",
     .standard = "none: another stock",
     .example = "\"stock.stl\"",
     .file = "a surface in STL"},
    &t.file);
  v({.name = "cell_mm",
     .meaning = "cell of the height field of ball, bull nose and taper",
     .range = between(0.05, longest_mm),
     .standard = "a twentieth of the radius of the tool",
     .example = "0.2"},
    &t.cell);
}

void describe(const Visitor& v, ForceLimits& t) {
  constexpr Range limit = above_up_to(0, 1e6);
  const auto one = [&](std::string_view name, std::string_view meaning,
                       std::optional<double>& value, std::string_view example) {
    v({.name = name,
       .meaning = meaning,
       .range = limit,
       .standard = "no limit",
       .example = example},
      &value);
  };
  one("peak_force_N", "force of the whole cutter in the plane of the table",
      t.peak_force, "500");
  one("peak_tooth_N", "the same of a single tooth", t.peak_tooth, "400");
  one("torque_Nm", "peak of the torque", t.torque, "2");
  one("power_W", "mean power of a turn", t.power, "1500");
  one("bending_moment_Nm", "at gauge_length_mm of [tool]", t.bending_moment, "20");
  one("deflection_um", "of the tip", t.deflection, "30");
  v({.name = "chip_mm",
     .meaning = "the largest chip of a turn: lowest and highest",
     .range = between(0, 100),
     .count = 2,
     .standard = "no limit",
     .example = "[0.005, 0.12]"},
    &t.chip);
}

void describe(const Visitor& v, MachineDrives& t) {
  v({.name = "max_acceleration_m_per_s2",
     .meaning = "of x, y, z; left out: the feed is reached at once",
     .range = above_up_to(0, 1000),
     .count = 3,
     .example = "[3, 3, 2]"},
    &t.max_acceleration);
  v({.name = "max_jerk_m_per_s3",
     .meaning = "of x, y, z; not used yet",
     .range = above_up_to(0, 1e6),
     .count = 3,
     .example = "[50, 50, 50]"},
    &t.max_jerk);
  v({.name = "max_feed_mm_per_min",
     .meaning = "of x, y, z",
     .range = above_up_to(0, 1e6),
     .count = 3,
     .standard = "no limit",
     .example = "[10000, 10000, 5000]"},
    &t.max_feed);
  v({.name = "rapid_feed_mm_per_min",
     .meaning = "speed of rapids along their path",
     .range = above_up_to(0, 1e6)},
    &t.rapid_feed);
  v({.name = "corner_tolerance_mm",
     .meaning = "how far a corner may be cut; 0: a full stop at a kink above 1 deg",
     .range = between(0, 10)},
    &t.corner_tolerance);
  v({.name = "power_curve_W",
     .meaning = "power of the spindle over its speed: rows of speed in rpm and power, "
                "the speed rising",
     .range = between(0, 1e7),
     .standard = "no limit",
     .example = "[[0, 0], [6000, 2200], [24000, 2200]]"},
    &t.power_curve);
}

void describe(const Visitor& v, FeedRules& t) {
  v({.name = "target",
     .meaning = "what the feed is made for. limits: the largest within [limits]; even: "
                "peaks of the force that are alike"},
    choice(t.target));
  v({.name = "even_percentile",
     .meaning = "of the peaks of all steps in cut: which one the others are made like",
     .range = between(0, 100),
     .only = {"target", {"even"}}},
    &t.even_percentile);
  v({.name = "factor",
     .meaning = "lowest and highest feed as a part of the programmed one",
     .range = above_up_to(0, 100),
     .count = 2},
    &t.factor);
  v({.name = "write",
     .meaning = "name of the program with the new feeds, in the folder of results",
     .standard = "none is written",
     .example = "\"part_feed.nc\""},
    &t.write);
  v({.name = "split_lines",
     .meaning = "whether moves may be split where their feed changes"},
    &t.split_lines);
}

}  // namespace trochoid::cases
