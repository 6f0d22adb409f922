#include <trochoid/cases/schema_choice.h>
#include <trochoid/cases/tables.h>
#include <trochoid/files/record_source.h>

#include <set>

namespace trochoid::cases {

void describe(const Visitor& v, Sampling& t) {
  v({.name = "samples_per_rev",
     .meaning = "spindle angles in one revolution",
     .range = between(1, 1e6)},
    &t.samples_per_rev);
  v({.name = "revolutions",
     .meaning = "revolutions of the spindle",
     .range = above_up_to(0, 1e4)},
    &t.revolutions);
  v({.name = "start_deg",
     .meaning = "first spindle angle",
     .range = between(-1e6, 1e6)},
    &t.start);
  v({.name = "angles_deg",
     .meaning = "spindle angles, instead of the three keys above",
     .range = between(-1e9, 1e9),
     .example = "[0, 10, 20]"},
    &t.angles);
  v({.name = "edge_angles_deg",
     .meaning = "nominal immersion angles of chip.csv",
     .range = between(-1e6, 1e6),
     .example = "[45, 90, 135]"},
    &t.edge_angles);
  v({.name = "edge_heights_mm",
     .meaning =
         "heights above the tip of chip.csv and edges.csv; below 0 where a tooth "
         "reaches deeper",
     .range = between(-10000, 10000),
     .standard = "0, or the axial depth where the edge reaches the axis",
     .example = "[0, 1]"},
    &t.edge_heights);
  v({.name = "tolerance",
     .meaning = "allowed error of the force, relative to its peak",
     .range = between(1e-13, 0.1)},
    &t.tolerance);
}

void describe(const Visitor& v, DynamometerTable& t) {
  v({.name = "axes",
     .meaning =
         "what each of 1 to 8 channels reads, with a sign: force on the tool x, y, "
         "z, or u, v that turn with it; torque; moments Mx, My, Mu, Mv about the "
         "gauge length; power of the spindle. auto: x, y, z found from the record",
     .need = Need::always,
     .word = "auto",
     .rival = "matrix",
     .example = "[\"-x\", \"-y\", \"-z\"]"},
    &t.axes);
  v({.name = "matrix",
     .meaning = "channel i = sum of matrix[i][j] times force j on the tool; invertible",
     .range = between(-1e6, 1e6),
     .rival = "axes",
     .example = "[[1, 0, 0], [0, 1, 0], [0, 0, 1]]"},
    &t.matrix);
  v({.name = "sensor_deg",
     .meaning = "angle of u from the tip of tooth 1 towards tooth 2; free: found",
     .range = between(-360, 360),
     .word = "free"},
    &t.sensor);
  v({.name = "channel_sd",
     .meaning = "standard deviation of one sample of each channel, in N, Nm or W; of "
                "means that give none, their weights",
     .range = above_up_to(0, 1e9),
     .example = "[0.5, 0.5, 0.8]"},
    &t.channel_sd);
  v({.name = "gain_sd",
     .meaning =
         "standard deviation of the gain of each channel, 0.01 for one per cent: "
         "the intervals then include it",
     .range = above_up_to(0, 1),
     .standard = "in no interval",
     .example = "0.01"},
    &t.gain_sd);
  v({.name = "turn_sd_deg",
     .meaning = "standard deviation of the angle by which the dynamometer is turned "
                "about z: the intervals then include it",
     .range = above_up_to(0, 45),
     .standard = "in no interval",
     .example = "0.5"},
    &t.turn_sd);
  v({.name = "frf",
     .meaning =
         "measured response of the channels, reading over force, through which the "
         "computed force is passed: a universal file (UFF58), or a table with "
         "freq_Hz and H11_re, H11_im, H12_re ...; relative to the file that names "
         "it",
     .standard = "none",
     .example = "\"plate.uff\"",
     .file = "the response of the dynamometer (UFF58 or a table)"},
    &t.frf);
  v({.name = "resonance",
     .meaning = "of the dynamometer, in each axis; auto: found with the rest where the "
                "record shows it; none: the dynamometer is rigid"},
    choice(t.resonance));
}

namespace {

/// What the columns of a record are called.
void describe_columns(const Visitor& v, files::RecordSource& t) {
  v({.name = "columns",
     .meaning = "names of the columns of the channels; \"\": this channel was not "
                "measured",
     .gaps = true,
     .standard = "found by name",
     .example = "[\"Fx\", \"Fy\", \"Fz\"]"},
    &t.columns);
  v({.name = "angle_column",
     .meaning = "column of the spindle angle",
     .standard = "found by name",
     .example = "\"angle_deg\""},
    &t.angle_column);
  v({.name = "time_column",
     .meaning = "column of the time",
     .rival = "sample_rate_Hz",
     .standard = "found by name",
     .example = "\"time_s\""},
    &t.time_column);
  v({.name = "pulse_column",
     .meaning = "column with one pulse a turn: the spindle angle is 0 where it rises",
     .example = "\"index_V\""},
    &t.pulse_column);
  v({.name = "line_column",
     .meaning =
         "column with the line of the NC program that runs; a record of a program is "
         "laid over it by its lines",
     .example = "\"line\""},
    &t.line_column);
}

}  // namespace

void describe(const Visitor& v, MeasurementTable& t) {
  v({.name = "file",
     .meaning = "the force record, relative to the file that names it",
     .need = Need::always,
     .rival = "mean",
     .file = "a force record"},
    &t.source.file);
  v({.name = "mean",
     .meaning =
         "instead of a file: the mean of each channel over whole turns, in N, Nm or "
         "W",
     .range = between(-1e9, 1e9),
     .rival = "file",
     .example = "[-90.5, 179.3, -54.6]"},
    &t.mean);
  v({.name = "mean_sd",
     .meaning = "standard deviations of these means",
     .range = above_up_to(0, 1e9),
     .standard = "channel_sd as weights, else the rms of each channel",
     .example = "[0.8, 0.8, 0.5]"},
    &t.mean_sd);
  v({.name = "format", .meaning = "format of the record; detect: from its content"},
    choice(t.source.format, "detect"));
  describe_columns(v, t.source);
  v({.name = "sample_rate_Hz",
     .meaning = "samples a second, when the record has no time",
     .range = above_up_to(0, 1e9),
     .rival = "time_column",
     .example = "10000"},
    &t.source.sample_rate);
  v({.name = "scale",
     .meaning = "N, Nm or W per unit of each channel, whatever unit the record names: "
                "of volts, the range of the charge amplifier by its full output",
     .range = between(-1e12, 1e12),
     .standard = "by the unit of each column",
     .example = "[500, 500, 1000]"},
    &t.source.scale);
  v({.name = "from_s",
     .meaning = "what was recorded before this time is not fitted",
     .range = between(-1e9, 1e9),
     .standard = "the longest steady cut",
     .example = "0.8"},
    &t.from);
  v({.name = "to_s",
     .meaning = "what was recorded after this time is not fitted",
     .range = between(-1e9, 1e9),
     .standard = "the longest steady cut",
     .example = "3.2"},
    &t.to);
  v({.name = "group",
     .meaning = "measurements of one group share coefficients, for example of one "
                "state of wear; measurements without a group share one set as well",
     .standard = "all share them",
     .example = "\"after 10 min\""},
    &t.group);
  v({.name = "cut",
     .meaning = "keys of [cut] that are different in this run",
     .example = "{ feed_per_tooth_mm = 0.06 }"},
    &t.cut);
}

void describe(const Visitor& v, PreviousClamping& t) {
  v({.name = "eccentricity_mm",
     .meaning = "eccentricity found before",
     .range = between(0, 10),
     .need = Need::always},
    &t.eccentricity);
  v({.name = "angle_deg",
     .meaning = "its angle from tooth 1",
     .range = between(-360, 360),
     .need = Need::always},
    &t.angle);
  v({.name = "turned_deg",
     .meaning =
         "by which the tool was turned in its holder since, positive from tooth 1 "
         "towards tooth 2",
     .range = between(-360, 360),
     .need = Need::always},
    &t.turned);
  v({.name = "eccentricity_se_mm",
     .meaning = "standard error of that eccentricity",
     .range = between(0, 10),
     .standard = "as of the present eccentricity"},
    &t.eccentricity_se);
  v({.name = "angle_se_deg",
     .meaning = "standard error of that angle",
     .range = between(0, 360),
     .standard = "as of the present angle"},
    &t.angle_se);
}

void describe(const Visitor& v, IdentifyTable& t) {
  v({.name = "chip_models", .meaning = "one fit for each of these chip models"},
    choices(t.chip_models));
  auto runout = std::get<Choices>(choices(t.runout));
  runout.alone = true;
  v({.name = "runout",
     .meaning =
         "none; fixed: [runout] as it stands; or find the radial offsets, the "
         "eccentricity, both, axial offsets, the tilt, or a list of these; auto: "
         "the record decides"},
    runout);
  v({.name = "phase_deg",
     .meaning =
         "true angle of the tip of tooth 1 minus the recorded angle; free: found",
     .range = between(-360, 360),
     .word = "free"},
    &t.phase);
  v({.name = "band_harmonics",
     .meaning =
         "fit only the mean and so many harmonics of the spindle; 0: everything; "
         "auto: everything, or what lies below a resonance of the dynamometer",
     .range = between(0, 1e6),
     .word = "auto"},
    &t.band_harmonics);
  v({.name = "channel_offsets",
     .meaning =
         "constant and drift of the channels: idle: taken from where nothing cuts; fit: "
         "found with the coefficients; none: left as they are; auto: idle where the "
         "records have air, else fit where they have four turns"},
    choice(t.channel_offsets));
  v({.name = "errors",
     .meaning = "standard errors and intervals: auto counts residuals that agree with "
                "their neighbours or repeat turn by turn, and how far records agree; "
                "white: as if they were white noise"},
    choice(t.errors));
  v({.name = "shared",
     .meaning =
         "what measurements of different groups have in common; runout: the tool "
         "stayed in its holder between them"},
    choice(t.shared));
  v({.name = "previous_clamping",
     .meaning =
         "eccentricity_mm and angle_deg of this tool before it was turned in its "
         "holder by turned_deg (positive from tooth 1 towards tooth 2), perhaps "
         "with eccentricity_se_mm and angle_se_deg: what belongs to the tool, and "
         "what to holder and spindle",
     .example = "{ eccentricity_mm = 0.012, angle_deg = 40, turned_deg = 180 }"},
    &t.previous_clamping);
  v({.name = "sweep_um",
     .meaning =
         "first, last and number of radial offsets of tooth 2 to try for sweep.csv",
     .range = between(-1e6, 1e6),
     .example = "[-20, 20, 41]"},
    &t.sweep);
}

void describe(const Visitor& v, PriorTable& t) {
  std::set<std::string_view> seen;
  for (const force::Law& law : force::law_kinds) {
    for (const force::Quantity& quantity : force::coefficient_quantities(law)) {
      if (!seen.insert(quantity.key).second) continue;
      v({.name = quantity.key,
         .meaning = quantity.meaning,
         .range = between(-1e6, 1e6),
         .standard = "nothing is known",
         .example = "{ mean = 1800, sd = 200 }"},
        &t.numbers[quantity.key]);
    }
  }
}

}  // namespace trochoid::cases
