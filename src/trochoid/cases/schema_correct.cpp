#include <trochoid/cases/schema_choice.h>
#include <trochoid/cases/schema_machine.h>

namespace trochoid::cases {

namespace {

void describe_map(const Visitor& v, Correction& t) {
  v({.name = "allowed_difference",
     .meaning = "of the peaks of force, for the highest speed that keeps it",
     .range = inside(0, 1)},
    &t.options.allowed_difference);
  v({.name = "spindle_rpm",
     .meaning = "first, last and number of the spindle speeds of the map",
     .range = above_up_to(0, 1e6),
     .standard = "up to 10000",
     .example = "[200, 10000, 99]"},
    &t.spindle_speed);
  v({.name = "map_cut",
     .meaning = "what the map looks at: rigid, a cut that gives nowhere; moving: the "
                "simulation in time with tool, table and actuator, which takes longer"},
    choice(t.options.map_cut));
}

}  // namespace

void describe(const Visitor& v, Correction& t) {
  v({.name = "target",
     .meaning =
         "what is made equal from tooth to tooth. peak_force: the peaks of the "
         "whole force, which a dynamometer shows; own_force: the peaks of each "
         "tooth's own force, which is not the whole force where several cut at once; "
         "chip_area: what they remove; least_squares: the chips over the whole cut, "
         "as nearly as possible"},
    choice(t.options.target));
  v({.name = "strategy",
     .meaning = "how the motion becomes a command. plain: they are the same; lead: "
                "phase lead, earlier by the delay of the actuator; inverse: plant "
                "inversion, each harmonic divided by the transfer function of actuator "
                "and table; inverse_in_time: the same for smooth shapes, by "
                "derivatives; learning: iterative learning control, starting from "
                "inverse"},
    choice(t.options.strategy));
  v({.name = "shape", .meaning = "how the table moves over a turn"},
    choice(t.options.shape));
  v({.name = "estimate",
     .meaning = "known: the command is made for the runout as it is; static_fit: for "
                "what a rigid model reads from the forces, which is less"},
    choice(t.options.estimate));
  v({.name = "transition_deg",
     .meaning =
         "spindle angle in which trapezoid and quintic change from one level to the "
         "next; auto: this and the harmonics by what they leave at the speed of the "
         "case",
     .range = above_up_to(0, 360),
     .word = "auto"},
    &t.options.transition);
  v({.name = "harmonics",
     .meaning = "highest harmonic of the spindle in the command",
     .range = between(1, 100)},
    &t.options.harmonics);
  v({.name = "peak_to_peak_um",
     .meaning = "motion of the table, instead of what the target asks",
     .range = above(0),
     .standard = "from the target",
     .example = "26"},
    &t.options.peak_to_peak);
  v({.name = "sample_rate_Hz",
     .meaning =
         "sampling rate of a command that is constant between samples (zero-order "
         "hold); 0: continuous",
     .range = at_least(0)},
    &t.options.sample_rate);
  v({.name = "learning_gain",
     .meaning = "part of the error that each iteration takes away",
     .range = inside(0, 2)},
    &t.options.learning_gain);
  describe_map(v, t);
}

void describe(const Visitor& v, Spindle& t) {
  v({.name = "inertia_kg_m2",
     .meaning = "moment of inertia of everything that turns with the tool",
     .range = above(0),
     .need = Need::always,
     .example = "0.0005"},
    &t.inertia);
  v({.name = "torque_Nm",
     .meaning = "torque of the motor at the speed of the case, either way",
     .range = above(0),
     .need = Need::always,
     .example = "5"},
    &t.torque);
}

void describe(const Visitor& v, Controller& t) {
  v({.name = "loop_rate_Hz",
     .meaning = "sampling rate of the controller",
     .range = between(100, 100000)},
    &t.rate);
  v({.name = "encoder_counts",
     .meaning = "counts of the spindle encoder, per turn",
     .range = between(1, 10000000)},
    &t.counts);
  v({.name = "jitter_s",
     .meaning =
         "standard deviation of the time at which a step of the controller begins",
     .range = between(0, 0.01)},
    &t.jitter);
  v({.name = "speed_ripple",
     .meaning = "variation of the spindle speed once a turn, as a part of it",
     .range = between(0, 0.5)},
    &t.speed_ripple);
  v({.name = "fade_s",
     .meaning = "time to fade the command in and out",
     .range = above_up_to(0, 10)},
    &t.fade);
  v({.name = "ramp_s",
     .meaning = "time from the end of the stroke to its middle after a fault",
     .range = above_up_to(0, 10)},
    &t.ramp);
  v({.name = "turns",
     .meaning = "spindle turns that are simulated",
     .range = between(10, 10000)},
    &t.turns);
  v({.name = "index_lost_at_turn",
     .meaning = "from this turn on there is no index pulse; 0: it is never lost",
     .range = between(0, 10000)},
    &t.index_lost_at);
  v({.name = "adapt",
     .meaning = "the amplitude learns from the forces while the controller runs"},
    &t.adapt);
}

}  // namespace trochoid::cases
