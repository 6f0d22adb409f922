#include <trochoid/cases/schema_choice.h>
#include <trochoid/cases/tables.h>

#include <set>

namespace trochoid::cases {

namespace {

void describe_profile(const Visitor& v, ToolTable& t) {
  v({.name = "corner_radius_mm",
     .meaning = "corner radius R",
     .range = between(0, longest_mm),
     .only = {"shape", {"bull_nose", "taper", "apt"}},
     .neutral = 0,
     .standard = "0 for taper; bull_nose and apt must give it",
     .example = "1"},
    &t.corner_radius);
  v({.name = "corner_center_radius_mm",
     .meaning = "distance Rr of the corner's centre from the axis",
     .range = between(-longest_mm, longest_mm),
     .need = Need::always,
     .only = {"shape", {"apt"}},
     .example = "3"},
    &t.corner_center_radius);
  v({.name = "corner_center_height_mm",
     .meaning = "height Rz of the corner's centre above the tip",
     .range = between(-longest_mm, longest_mm),
     .need = Need::always,
     .only = {"shape", {"apt"}},
     .neutral = 0,
     .example = "1"},
    &t.corner_center_height);
  v({.name = "bottom_angle_deg",
     .meaning = "angle alpha of the bottom against the horizontal",
     .range = from_below(0, 90),
     .need = Need::always,
     .only = {"shape", {"apt"}},
     .neutral = 0,
     .example = "2"},
    &t.bottom_angle);
  v({.name = "taper_deg",
     .meaning = "angle beta of the flank against the axis, positive: wider upwards",
     .range = inside(-90, 90),
     .need = Need::always,
     .only = {"shape", {"taper", "apt"}},
     .neutral = 0,
     .example = "3"},
    &t.taper);
}

}  // namespace

void describe(const Visitor& v, CaseTables& t) {
  v({.name = "schema",
     .meaning = "version of the case file: of what its keys mean",
     .range = between(case_version, case_version)},
    &t.version);
  v({.name = "title", .meaning = "what this case is, for the report"}, &t.title);
}

void describe(const Visitor& v, ToolTable& t) {
  v({.name = "shape", .meaning = "shape of the cutter"}, choice(t.shape));
  v({.name = "teeth",
     .meaning = "number of teeth",
     .range = between(1, 64),
     .need = Need::always},
    &t.teeth);
  v({.name = "diameter_mm",
     .meaning = "diameter; of a taper and apt, where bottom and flank would meet",
     .range = above_up_to(0, longest_mm),
     .need = Need::always},
    &t.diameter);
  v({.name = "helix_deg",
     .meaning = "helix angle, right-hand; negative: left-hand, or negative axial rake; "
                "a list: of each tooth",
     .range = inside(-90, 90),
     .need = Need::always,
     .example = "[38, 41, 38, 41]"},
    &t.helix);
  v({.name = "pitch_deg",
     .meaning = "angle from each tooth to the next that passes; the sum is 360",
     .range = above_up_to(0, 360),
     .standard = "equal pitches",
     .example = "[178, 182]"},
    &t.pitch);
  describe_profile(v, t);
  v({.name = "lag", .meaning = "how the edge lags behind its tip with the height"},
    choice(t.lag));
  v({.name = "lag_diameter_mm",
     .meaning = "diameter to which the lag refers: lag = 2 z tan(helix) / lag_diameter",
     .range = above_up_to(0, longest_mm),
     .standard = "diameter_mm",
     .example = "8"},
    &t.lag_diameter);
  v({.name = "gauge_length_mm",
     .meaning = "height above the tip at which the bending moment is wanted",
     .range = above_up_to(0, longest_mm),
     .example = "60"},
    &t.gauge_length);
  v({.name = "serration",
     .meaning = "a wave along the flank, as roughing cutters have it",
     .standard = "none",
     .example = "{ shape = \"sine\", amplitude_mm = 0.3, wavelength_mm = 2 }"},
    &t.serration);
  v({.name = "dish_deg",
     .meaning = "floor only: the bottom edge rises towards the axis by this angle from "
                "its lowest point; 90: the inner half of a round insert",
     .range = between(0, 90)},
    &t.dish);
  v({.name = "wiper_mm",
     .meaning = "floor only: length of the flat land at the lowest point, inwards",
     .range = between(0, longest_mm)},
    &t.wiper);
}

void describe(const Visitor& v, geometry::Serration& t) {
  v({.name = "shape", .meaning = "shape of the wave"}, choice(t.shape));
  v({.name = "amplitude_mm",
     .meaning = "from crest to valley (papers often give half of it)",
     .range = between(0, longest_mm),
     .need = Need::always},
    &t.amplitude);
  v({.name = "wavelength_mm",
     .meaning = "along the axis",
     .range = above_up_to(0, longest_mm),
     .need = Need::always},
    &t.wavelength);
  v({.name = "shift_mm",
     .meaning = "height above its own tip of a crest of each tooth; \"equal\": shifted "
                "from each tooth to the next by an equal part of the wavelength",
     .range = between(-longest_mm, longest_mm),
     .word = "equal",
     .example = "[0, 0.5, 1, 1.5]"},
    &t.shift);
}

void describe(const Visitor& v, geometry::Runout& t) {
  v({.name = "radial_offsets_mm",
     .meaning = "by how much each tooth stands out; one number for each tooth",
     .range = between(-longest_mm, longest_mm),
     .standard = "all 0",
     .example = "[0, -0.008]"},
    &t.radial_offsets);
  v({.name = "eccentricity_mm",
     .meaning = "distance from the rotation centre to the geometric centre",
     .range = between(0, longest_mm)},
    &t.eccentricity);
  v({.name = "angle_deg",
     .meaning =
         "where the geometric centre lies: from the tip of tooth 1 towards tooth 2",
     .range = between(-360, 360)},
    &t.angle);
  v({.name = "eccentricity_order",
     .meaning = "exact, or first: radius + eccentricity cos only"},
    choice(t.order));
  v({.name = "axial_offsets_mm",
     .meaning = "by how much deeper each tooth reaches; one number for each tooth",
     .range = between(-longest_mm, longest_mm),
     .standard = "all 0",
     .example = "[0, -0.02]"},
    &t.axial_offsets);
  v({.name = "tilt_deg",
     .meaning = "angle of the tool axis against the rotation axis",
     .range = from_below(0, 10)},
    &t.tilt);
  v({.name = "tilt_angle_deg",
     .meaning = "where the top of the tool leans to: from the tip of tooth 1 towards "
                "tooth 2; a tooth there reaches deeper",
     .range = between(-360, 360)},
    &t.tilt_angle);
}

namespace {

/// What the intervals of identify hold besides noise.
void describe_tolerances(const Visitor& v, CutTable& t) {
  v({.name = "axial_depth_sd_mm",
     .meaning = "standard deviation of axial_depth_mm: the intervals of identify then "
                "include it",
     .range = above_up_to(0, longest_mm),
     .standard = "in no interval",
     .example = "0.02"},
    &t.axial_depth_sd);
  v({.name = "radial_depth_sd_mm",
     .meaning = "standard deviation of radial_depth_mm: the intervals of identify then "
                "include it",
     .range = above_up_to(0, longest_mm),
     .only = {"engagement", {"up", "down"}},
     .standard = "in no interval",
     .example = "0.05"},
    &t.radial_depth_sd);
  v({.name = "feed_per_tooth_sd_mm",
     .meaning = "standard deviation of the feed per tooth: the intervals of identify "
                "then include it",
     .range = above_up_to(0, 1000),
     .standard = "in no interval",
     .example = "0.0005"},
    &t.feed_per_tooth_sd);
}

/// Where there is stock, by the kind of engagement.
void describe_stock(const Visitor& v, CutTable& t) {
  v({.name = "radial_depth_mm",
     .meaning = "radial depth of cut a_e, at most the diameter",
     .range = above_up_to(0, longest_mm),
     .need = Need::always,
     .only = {"engagement", {"up", "down"}},
     .example = "2"},
    &t.radial_depth);
  v({.name = "stock_y_mm",
     .meaning = "the stock lies between these two y",
     .range = between(-1e6, 1e6),
     .need = Need::always,
     .count = 2,
     .only = {"engagement", {"band"}},
     .example = "[-4, 2]"},
    &t.stock_y);
  v({.name = "arcs_deg",
     .meaning =
         "stock on these arcs of the immersion angle at all heights, from 0 at +y "
         "clockwise; [[-90, 270]]: the whole circle. At the wall of the cut itself an arc "
         "may go on past 0 or 180: the marks of the teeth end the chip",
     .range = between(-360, 720),
     .need = Need::always,
     .only = {"engagement", {"arcs"}},
     .rival = "layers",
     .example = "[[0, 53.1], [126.9, 180]]"},
    &t.arcs);
  v({.name = "layers",
     .meaning = "the same by height above the tip, from below",
     .range = between(-longest_mm, longest_mm),
     .only = {"engagement", {"arcs"}},
     .rival = "arcs_deg",
     .standard = "arcs_deg at all heights",
     .example = "[{ from_mm = 0, to_mm = 2, arcs_deg = [[0, 53.1]] }]"},
    &t.layers);
  v({.name = "path_radius_mm",
     .meaning = "radius of the path of the tool; above 0 it turns left, below 0 right",
     .range = between(-1e6, 1e6),
     .only = {"engagement", {"arcs"}},
     .standard = "a straight path",
     .example = "12"},
    &t.path_radius);
}

}  // namespace

void describe(const Visitor& v, CutTable& t) {
  v({.name = "engagement",
     .meaning = "which part of the cutter's width is in the stock",
     .need = Need::always},
    choice(t.engagement));
  describe_stock(v, t);
  v({.name = "axial_depth_mm",
     .meaning = "axial depth of cut",
     .range = above_up_to(0, longest_mm),
     .need = Need::always},
    &t.axial_depth);
  v({.name = "feed_per_tooth_mm",
     .meaning = "feed per tooth; the feed per revolution is teeth times this",
     .range = between(0, 1000),
     .need = Need::always,
     .rival = "feed_rate_mm_per_min"},
    &t.feed_per_tooth);
  v({.name = "feed_rate_mm_per_min",
     .meaning = "feed rate; both feeds may be given only if they agree",
     .range = between(0, 1e9),
     .rival = "feed_per_tooth_mm",
     .standard = "from feed_per_tooth_mm",
     .example = "70"},
    &t.feed_rate);
  v({.name = "spindle_rpm",
     .meaning = "spindle speed",
     .range = above_up_to(0, 1e6),
     .need = Need::always},
    &t.spindle_speed);
  v({.name = "spindle_lead_deg",
     .meaning =
         "floor only: the rotation axis leans forward by this angle, so that the "
         "front cuts deeper and the rear clears",
     .range = inside(-10, 10)},
    &t.spindle_lead);
  describe_tolerances(v, t);
}

void describe(const Visitor& v, chip::ChipModel& t) {
  v({.name = "model", .meaning = "how the uncut chip thickness is computed"},
    choice(t.model));
  v({.name = "lookback",
     .meaning = "which earlier teeth left the surface: all, or only the one before "
                "(previous: feed and trochoidal only)"},
    choice(t.lookback));
}

namespace {

constexpr Range pressing = between(0, 1e6);
constexpr Range either_sign = between(-1e6, 1e6);
constexpr Range exponent = from_below(-0.5, 1);

/// The laws that have a number of that key.
std::vector<std::string_view> laws_with(std::string_view key) {
  std::vector<std::string_view> laws;
  for (const force::Law& law : force::law_kinds) {
    for (const force::Quantity& quantity : force::quantities(law)) {
      if (quantity.key == key) {
        laws.push_back(force::name_of(law));
      }
    }
  }
  return laws;
}

/// What [orthogonal] may tell instead.
bool is_of_orthogonal(std::string_view key) {
  return key == "K_tc_MPa" || key == "K_rc_MPa" || key == "K_ac_MPa";
}

void describe_number(const Visitor& v, const force::Quantity& quantity, ForceTable& t) {
  const bool is_exponent = quantity.role == force::Role::exponent;
  v({.name = quantity.key,
     .meaning = quantity.meaning,
     .range = is_exponent ? exponent : (quantity.signed_value ? either_sign : pressing),
     .need = is_of_orthogonal(quantity.key) ? Need::cutting : Need::coefficient,
     .only = {"law", laws_with(quantity.key)},
     .standard = is_exponent ? "0.25 for identify" : ""},
    &t.numbers[quantity.key]);
}

void describe_damping(const Visitor& v, ForceTable& t) {
  v({.name = "wear_land_um",
     .meaning = "width L_w of the worn land on the flank; it damps vibrations in "
                "stability, dynamics and correct",
     .range = between(0, 5000),
     .standard = "0: no process damping",
     .example = "80"},
    &t.wear_land);
  v({.name = "indentation_N_per_mm3",
     .meaning = "force on the flank per volume that it presses, K_sp; must be there "
                "with a wear land",
     .range = above_up_to(0, 1e8),
     .example = "30000"},
    &t.indentation);
  v({.name = "flank_friction",
     .meaning = "tangential force on the flank as a part of the one normal to it",
     .range = between(0, 10),
     .standard = "0.3",
     .example = "0.3"},
    &t.flank_friction);
}

}  // namespace

void describe(const Visitor& v, ForceTable& t) {
  v({.name = "law",
     .meaning = "linear_edge: K_c h + K_e; power: K_1 (h/1 mm)^(1-m); power_edge: "
                "K_1 (h/1 mm)^(1-m) + K_e"},
    choice(t.law, force::law_names));
  std::set<std::string_view> seen;
  for (const force::Law& law : force::law_kinds) {
    for (const force::Quantity& quantity : force::quantities(law)) {
      if (seen.insert(quantity.key).second) {
        describe_number(v, quantity, t);
      }
    }
  }
  v({.name = "edge_length",
     .meaning = "edge coefficients act per mm of true edge length or of axial depth"},
    choice(t.edge_length));
  describe_damping(v, t);
}

}  // namespace trochoid::cases
