#include <trochoid/cases/schema_choice.h>
#include <trochoid/cases/schema_machine.h>

namespace trochoid::cases {

namespace {

/// Ultrasonic machines stay below the one, all that swings on a machine above the other.

/// Where a frequency response is: of [frf] and of [[measured_frf]].
void describe_response_file(const Visitor& v, files::FrfSource& t, Need need) {
  v({.name = "file",
     .meaning =
         need == Need::always
             ? "the measured frequency response, relative to the file that names it"
             : "the measured frequency response, relative to the file that names it; "
               "left out: all [[measured_frf]], which share their modes",
     .need = need,
     .file = "a frequency response (csv, text or uff)"},
    &t.file);
  v({.name = "kind",
     .meaning = "displacement, velocity or acceleration over force; needed where the "
                "file does not say it by its unit"},
    choice(t.kind, "detect"));
  v({.name = "dataset",
     .meaning = "which of the frequency responses of a universal file, from 1; 0: the "
                "only one",
     .range = between(0, 100000)},
    &t.dataset);
  v({.name = "scale",
     .meaning =
         "of hammer blows in time, whatever units the columns name: newtons per "
         "unit of the force, and m, m/s or m/s^2, as `kind` says, per unit of the "
         "response: of volts one over the sensitivity",
     .range = between(-1e12, 1e12),
     .count = 2,
     .standard = "by the unit of each column",
     .example = "[444.8, 98.07]"},
    &t.scale);
}

template <class Table>
void describe_band(const Visitor& v, Table& t) {
  v({.name = "band_Hz",
     .meaning = "lowest and highest frequency of the response that is used",
     .range = at_least(0),
     .count = 2,
     .standard = "the whole record",
     .example = "[200, 4000]"},
    &t.band);
}

}  // namespace

void describe(const Visitor& v, Mode& t) {
  v({.name = "body", .meaning = "what vibrates", .need = Need::always}, choice(t.body));
  v({.name = "axis", .meaning = "in which direction", .need = Need::always},
    choice(t.axis));
  v({.name = "angle_deg",
     .meaning = "by how much the direction is turned from the axis, from +x towards "
                "+y: such a mode moves the tool in x and y at once, and couples them",
     .range = inside(-90, 90),
     .only = {"axis", {"x", "y"}},
     .neutral = 0.0},
    &t.angle);
  v({.name = "mass_kg", .meaning = "modal mass", .range = above_up_to(0, 1e9)},
    &t.mass);
  v({.name = "stiffness_N_per_m",
     .meaning = "modal stiffness; may stand in place of the mass or the frequency",
     .range = above_up_to(0, 1e15),
     .example = "1340000"},
    &t.stiffness);
  v({.name = "damping_Ns_per_m",
     .meaning = "modal damping; may stand in place of damping_ratio",
     .range = between(0, 1e12),
     .rival = "damping_ratio",
     .example = "5.1"},
    &t.damping);
  v({.name = "frequency_Hz",
     .meaning = "natural frequency",
     .range = between(slowest_Hz, fastest_Hz)},
    &t.frequency);
  v({.name = "damping_ratio",
     .meaning = "damping over critical damping (zeta)",
     .range = between(0, 100),
     .rival = "damping_Ns_per_m"},
    &t.damping_ratio);
}

void describe(const Visitor& v, Actuator& t) {
  v({.name = "gain",
     .meaning = "motion for a command of 1",
     .range = above_up_to(0, 1e6)},
    &t.gain);
  v({.name = "time_constants_s",
     .meaning = "time constants of two first-order lags in series",
     .range = above_up_to(0, 1e4),
     .count = 2,
     .rival = "frequency_Hz",
     .example = "[0.0011, 0.0012]"},
    &t.time_constants);
  v({.name = "frequency_Hz",
     .meaning = "natural frequency",
     .range = between(slowest_Hz, fastest_Hz),
     .rival = "time_constants_s"},
    &t.frequency);
  v({.name = "damping_ratio",
     .meaning = "damping over critical damping (zeta)",
     .range = at_least(0),
     .rival = "time_constants_s"},
    &t.damping_ratio);
  v({.name = "stroke_um",
     .meaning = "lowest and highest position",
     .count = 2,
     .example = "[0, 60]"},
    &t.stroke);
  v({.name = "coupling_stiffness_N_per_m",
     .meaning = "stiffness between actuator and table",
     .range = above(0),
     .standard = "stiffness of the table's mode",
     .example = "17000000"},
    &t.coupling_stiffness);
  v({.name = "coupling_damping_Ns_per_m",
     .meaning = "damping between actuator and table",
     .range = at_least(0),
     .standard = "damping of the table's mode, in proportion to the stiffness",
     .example = "77.3"},
    &t.coupling_damping);
  v({.name = "slew_um_per_s",
     .meaning = "greatest speed",
     .range = above(0),
     .example = "100000"},
    &t.slew);
  v({.name = "push_N",
     .meaning = "greatest force on the table along the feed",
     .range = above(0)},
    &t.push);
  v({.name = "pull_N", .meaning = "and the other way", .range = above(0)}, &t.pull);
  v({.name = "highest_frequency_Hz",
     .meaning = "highest frequency that a command may contain",
     .range = above(0),
     .standard = "0.27 of the frequency of the table",
     .example = "400"},
    &t.highest_frequency);
}

void describe(const Visitor& v, FrfTables& t) {
  describe_response_file(v, t.source, Need::optional);
  v({.name = "modes",
     .meaning = "how many modes are fitted; 0: their number is chosen",
     .range = between(0, 20)},
    &t.modes);
  describe_band(v, t);
  v({.name = "residual_terms",
     .meaning = "residual terms: they stand for the modes below and above the band"},
    choice(t.residual_terms));
  v({.name = "shapes",
     .meaning =
         "real: a mode moves all directions in step; complex: a damper in one "
         "place puts them out of step; choose: whichever is likelier, of blows in "
         "time real with a warning"},
    choice(t.shapes));
  v({.name = "estimator",
     .meaning = "of hammer blows in time: H1 averages out the noise of the sensor, H2 "
                "the noise of the force"},
    choice(t.tap.estimator));
  v({.name = "block_s",
     .meaning = "how much of the record is taken after each blow; 0: until the next, a "
                "second at most",
     .range = between(0, 1000)},
    &t.tap.block);
  v({.name = "window_end",
     .meaning =
         "what the exponential window leaves at the end of a block; 1: no window; "
         "0: 0.01 where it still rings there, else 1",
     .range = between(0, 1)},
    &t.tap.window_end);
  v({.name = "body", .meaning = "what vibrates, for modes.toml"}, choice(t.body));
  v({.name = "axis",
     .meaning = "in which direction, for modes.toml, where `file` is one response"},
    choice(t.axis));
}

void describe(const Visitor& v, MeasuredFrf& t) {
  describe_response_file(v, t.source, Need::always);
  describe_band(v, t);
  v({.name = "body", .meaning = "what was hit and measured"}, choice(t.body));
  v({.name = "axis", .meaning = "in which direction the motion was measured"},
    choice(t.axis));
  v({.name = "force_axis",
     .meaning = "in which direction the force acted; another one than axis: a cross "
                "response"},
    choice(t.force_axis, "same"));
}

void describe(const Visitor& v, StepTables& t) {
  v({.name = "file",
     .meaning = "the record of the step, relative to the file that names it",
     .need = Need::always,
     .file = "the record of a step (csv)"},
    &t.source.file);
  v({.name = "step_um",
     .meaning = "height of the commanded step",
     .standard = "from the column command",
     .example = "6"},
    &t.source.step);
  v({.name = "start_s",
     .meaning = "when the step was commanded",
     .standard = "fitted",
     .example = "0.001"},
    &t.source.start);
}

void describe(const Visitor& v, ImposedCommand& t) {
  v({.name = "shape", .meaning = "shape of the command over one revolution"},
    choice(t.shape));
  v({.name = "peak_to_peak_um",
     .meaning = "from the lowest to the highest command",
     .range = at_least(0),
     .need = Need::always,
     .only = {"shape", {"sine", "square", "trapezoid"}}},
    &t.peak_to_peak);
  v({.name = "file",
     .meaning = "CSV with angle_deg and command_um over a turn, as correct writes it, "
                "relative to the file that names it; its mean is left out",
     .need = Need::always,
     .only = {"shape", {"table"}},
     .example = "\"command.csv\"",
     .file = "a command over the angle (csv)"},
    &t.file);
  v({.name = "lead_s", .meaning = "phase lead: by how much the command comes early"},
    &t.lead);
}

void describe(const Visitor& v, Stability& t) {
  v({.name = "spindle_rpm",
     .meaning =
         "first, last and number of the spindle speeds of the stability lobe diagram; "
         "one speed: [5000, 5000, 1]",
     .range = above_up_to(0, 1e6),
     .standard = "from 0.5 to 1.5 times the speed of [cut]",
     .example = "[5000, 25000, 200]"},
    &t.spindle_speed);
  v({.name = "axial_depth_mm",
     .meaning =
         "first, last and number of the axial depths of the stability lobe diagram; one "
         "depth: [1, 1, 1]",
     .range = above_up_to(0, longest_mm),
     .standard = "up to twice the depth of [cut]",
     .example = "[0.05, 5, 100]"},
    &t.axial_depth);
  v({.name = "harmonics",
     .meaning = "with [[measured_frf]]: harmonics of the tooth passing frequency that "
                "the multi-frequency solution keeps on each side of the chatter "
                "frequency",
     .range = between(1, 40)},
    &t.harmonics);
  v({.name = "tolerance",
     .meaning = "error allowed in the Floquet multiplier of the case",
     .range = between(1e-10, 1e-2)},
    &t.options.tolerance);
  v({.name = "margin",
     .meaning = "a Floquet multiplier this close to 1 is called marginal",
     .range = from_below(0, 1)},
    &t.options.margin);
  v({.name = "chip_floor_um",
     .meaning =
         "in a power law: the slope of the force is taken at no thinner chip, for "
         "example the radius of the edge",
     .range = above_up_to(0, 1000)},
    &t.options.chip_floor);
}

}  // namespace trochoid::cases
