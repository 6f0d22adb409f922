#include <trochoid/correction/controller.h>
#include <trochoid/correction/controller_memory.h>

#include <math.h>

// Only what C's library has: this file is compiled without
// exceptions and linked without libstdc++ in real-time hosts. No
// square roots or sines: the same bits everywhere.

namespace {

using trochoid::correction::clamped;
using trochoid::correction::fraction;
using trochoid::correction::within;

constexpr int32_t most_kept_turns = 1000000;
constexpr double absurd_position = 1e9;  // [rev]: the fraction would be lost
constexpr double absurd_speed = 10.0;    // times max_speed_rps
constexpr double absurd_gain = 1e6;

/// Into [-1/2, 1/2].
double wrapped(double turns) {
  return turns - floor(turns + 0.5);
}

/// cos and sin of 2 pi times some turns.
struct Phasor {
  double cosine = 1.0;
  double sine = 0.0;
};

/// By Taylor's series within an eighth of a turn of a quarter: below 1e-11 off.
Phasor phasor(double turns) {
  const double quarters = 4.0 * fraction(turns);
  const double nearest = floor(quarters + 0.5);
  const double x = (quarters - nearest) * 1.5707963267948966;
  const double y = x * x;
  const double s =
      x * (1 + y * (-1.0 / 6 + y * (1.0 / 120 + y * (-1.0 / 5040 + y / 362880))));
  const double c =
      1 +
      y * (-0.5 + y * (1.0 / 24 + y * (-1.0 / 720 + y * (1.0 / 40320 - y / 3628800))));
  const auto quadrant = static_cast<int32_t>(nearest) & 3;
  if (quadrant == 0) {
    return {c, s};
  }
  if (quadrant == 1) {
    return {-s, c};
  }
  return quadrant == 2 ? Phasor{-c, -s} : Phasor{s, -c};
}

/// What is added to the table (L-7).
double wave_at(const TrochoidController& c, double turns) {
  const Phasor one = phasor(turns);
  Phasor all = one;
  double sum = 0.0;
  for (int32_t n = 0; n < TROCHOID_WAVE_HARMONICS; ++n) {
    sum += c.cosine_m[n] * all.cosine + c.sine_m[n] * all.sine;
    all = {all.cosine * one.cosine - all.sine * one.sine,
           all.sine * one.cosine + all.cosine * one.sine};
  }
  return sum;
}

/// Signed, within half of what a counter wraps by (L-8).
double unwrapped(const TrochoidControllerConfig& c, double turns) {
  return c.wrap_rev > 0.0 ? turns - c.wrap_rev * floor(turns / c.wrap_rev + 0.5)
                          : turns;
}

double from_table(const TrochoidControllerConfig& c, double turns) {
  const double place = fraction(turns) * c.points;
  int32_t i = static_cast<int32_t>(place);
  if (i >= c.points) {
    i = 0;
  }
  const int32_t next = i + 1 < c.points ? i + 1 : 0;
  const double part = clamped(place - i, 0.0, 1.0);
  return c.table_m[i] + part * (c.table_m[next] - c.table_m[i]);
}

bool sane(const TrochoidControllerConfig& c, const TrochoidControllerInput& in) {
  const double speed = absurd_speed * c.max_speed_rps;
  for (int32_t n = 0; n < TROCHOID_WAVE_HARMONICS; ++n) {
    if (!within(in.cosine_m[n], -1.0, 1.0) || !within(in.sine_m[n], -1.0, 1.0)) {
      return false;
    }
  }
  return within(in.position_rev, -absurd_position, absurd_position) &&
         within(in.speed_rps, -speed, speed) &&
         within(in.gain, -absurd_gain, absurd_gain) &&
         (in.index == 0 ||
          within(in.index_position_rev, -absurd_position, absurd_position));
}

/// The position is not known any more; the next index pulse begins anew.
int32_t lose_position(TrochoidController& c, int32_t problem) {
  c.synchronised = 0;
  c.turns = 0;
  c.expected_rev = problem == TROCHOID_INDEX_LOST ? c.expected_rev : 0.0;
  return problem;
}

void filter_speed(TrochoidController& c, double measured, double dt) {
  if (c.speed_known == 0) {
    c.speed_rps = measured;
    c.reference_rps = measured;
    c.speed_known = 1;
    return;
  }
  const double d = fmax(fabs(measured), fabs(c.speed_rps)) * dt;
  c.speed_rps += (measured - c.speed_rps) * (d / (d + c.config.filter_rev));  // L-2
}

/// L-4. An index pulse sets the zero; one that bounces is passed over.
int32_t follow_position(TrochoidController& c, const TrochoidControllerInput& in,
                        double dt) {
  const bool pulse = in.index != 0 && c.index_was == 0;
  c.index_was = in.index != 0 ? 1 : 0;
  c.expected_rev += in.speed_rps * dt;
  if (pulse && c.synchronised == 0) {
    c.synchronised = 1;
    c.turns = 0;
    c.zero_rev = in.index_position_rev;
    c.angle_rev = unwrapped(c.config, in.position_rev - c.zero_rev);
    c.expected_rev = c.angle_rev;
    c.position_rev = in.position_rev;
    return TROCHOID_NO_PROBLEM;
  }
  const bool turned = pulse && c.expected_rev > 0.5;
  if (turned) {
    c.zero_rev = in.index_position_rev;
  }
  c.angle_rev =
      turned || !(c.config.wrap_rev > 0.0)
          ? unwrapped(c.config, in.position_rev - c.zero_rev)
          : c.angle_rev + unwrapped(c.config, in.position_rev - c.position_rev);
  c.position_rev = in.position_rev;
  const double error = wrapped(c.angle_rev - c.expected_rev);
  if (c.synchronised != 0 && fabs(error) > c.config.position_tol_rev) {
    return lose_position(c, TROCHOID_BAD_POSITION);
  }
  if (turned) {
    c.expected_rev = wrapped(c.angle_rev);
    c.turns = c.turns < most_kept_turns ? c.turns + 1 : most_kept_turns;
  }
  if (c.expected_rev > c.config.index_turns) {
    return lose_position(c, TROCHOID_INDEX_LOST);
  }
  return TROCHOID_NO_PROBLEM;
}

bool running(const TrochoidController& c) {
  return c.state == TROCHOID_FADING_IN || c.state == TROCHOID_RUNNING ||
         c.state == TROCHOID_FADING_OUT;
}

int32_t examine_speed(TrochoidController& c) {
  if (c.speed_rps > c.config.max_speed_rps) {
    return TROCHOID_OVERSPEED;
  }
  if (c.speed_rps < c.config.min_speed_rps) {
    return TROCHOID_UNDERSPEED;
  }
  const double change = fabs(c.speed_rps - c.reference_rps);
  if (change > c.config.speed_change * c.reference_rps) {
    return TROCHOID_SPEED_CHANGED;
  }
  return TROCHOID_NO_PROBLEM;
}

/// What is wrong at this step; follows speed and position where they can be believed.
int32_t examine(TrochoidController& c, const TrochoidControllerInput* in) {
  if (in == nullptr || !(in->dt_s > 0.0) || !(in->dt_s <= c.config.max_step_s)) {
    c.speed_known = 0;
    return lose_position(c, TROCHOID_BAD_TIME);
  }
  if (!sane(c.config, *in)) {
    c.speed_known = 0;
    return lose_position(c, TROCHOID_BAD_INPUT);
  }
  filter_speed(c, in->speed_rps, in->dt_s);
  const int32_t position = follow_position(c, *in, in->dt_s);
  const int32_t speed = examine_speed(c);
  const int32_t problem = in->inhibit != 0 ? static_cast<int32_t>(TROCHOID_INHIBITED)
                          : position != TROCHOID_NO_PROBLEM ? position
                                                            : speed;
  if (speed != TROCHOID_NO_PROBLEM) {
    c.reference_rps = c.speed_rps;
  }
  if (problem != TROCHOID_NO_PROBLEM) {
    c.turns = 0;
  }
  return problem;
}

bool at_rest(const TrochoidController& c) {
  return c.output_m == c.middle_m;
}

void begin(TrochoidController& c, double gain) {
  c.state = TROCHOID_FADING_IN;
  c.fault = TROCHOID_NO_PROBLEM;
  c.reference_rps = c.speed_rps;
  c.gain = clamped(gain, -c.gain_limit, c.gain_limit);
}

void fail(TrochoidController& c, int32_t problem, bool enabled) {
  c.state = TROCHOID_FAULT;
  c.fault = problem;
  c.fade = 0.0;
  c.released = enabled ? 0 : 1;
}

/// From a state without a command: rests, or moves to mid-stroke.
void leave_rest(TrochoidController& c, int32_t problem, bool enabled, double gain) {
  if (c.state == TROCHOID_FAULT) {
    c.released = enabled ? c.released : 1;
    const bool may_go =
        c.released != 0 || c.config.recovery == TROCHOID_RECOVER_BY_TURNS;
    if (!may_go || !at_rest(c)) {
      return;
    }
  }
  c.state = enabled ? TROCHOID_WAITING : TROCHOID_DISABLED;
  if (enabled && problem == TROCHOID_NO_PROBLEM && c.turns >= c.config.good_turns &&
      at_rest(c)) {
    begin(c, gain);
  }
}

void change_state(TrochoidController& c, int32_t problem,
                  const TrochoidControllerInput* in, double dt) {
  const bool enabled = in != nullptr && in->enable != 0;
  if (!running(c)) {
    leave_rest(c, problem, enabled, in != nullptr ? in->gain : 0.0);
    return;
  }
  if (problem != TROCHOID_NO_PROBLEM) {
    fail(c, problem, enabled);
    return;
  }
  const double change = dt / c.config.fade_s;
  c.fade = clamped(c.fade + (enabled ? change : -change), 0.0, 1.0);
  if (enabled) {
    c.state = c.fade < 1.0 ? TROCHOID_FADING_IN : TROCHOID_RUNNING;
  } else {
    c.state = c.fade > 0.0 ? TROCHOID_FADING_OUT : TROCHOID_DISABLED;
  }
}

/// Where the command should be (L-1).
double target(TrochoidController& c, double gain, double dt, int32_t& limited) {
  const double wanted = clamped(gain, -c.gain_limit, c.gain_limit);
  if (wanted != gain) {
    limited |= TROCHOID_LIMITED_GAIN;
  }
  const double change = dt / c.config.gain_time_s;
  c.gain = clamped(wanted, c.gain - change, c.gain + change);
  const double ahead = c.speed_rps * (c.config.lead_s + 0.5 * c.config.period_s);
  const double angle = fraction(c.angle_rev) + ahead + c.config.phase_rev;
  return c.middle_m +
         c.fade * (c.gain * from_table(c.config, angle) + wave_at(c, angle));
}

/// The waves of the input, at the rate at which the gain changes.
void follow_waves(TrochoidController& c, const TrochoidControllerInput& in, double dt) {
  const double half = c.middle_m - c.config.lower_m;
  const double most = half * (dt / c.config.gain_time_s);
  for (int32_t n = 0; n < TROCHOID_WAVE_HARMONICS; ++n) {
    double* const own[] = {&c.cosine_m[n], &c.sine_m[n]};
    const double wanted[] = {in.cosine_m[n], in.sine_m[n]};
    for (int32_t k = 0; k < 2; ++k) {
      *own[k] =
          clamped(clamped(wanted[k], -half, half), *own[k] - most, *own[k] + most);
    }
  }
}

/// L-3, exactly: the last bit of the sum is given up
/// where it rounds away from the limit.
double limited_move(double before, double wanted, double most) {
  if (fabs(wanted - before) <= most) {
    return wanted;
  }
  const double after = wanted > before ? before + most : before - most;
  return fabs(after - before) <= most ? after : nextafter(after, before);
}

}  // namespace

TrochoidControllerResult trochoid_controller_step(
    TrochoidController* controller, const TrochoidControllerInput* input) {
  TrochoidControllerResult result = {};
  if (controller == nullptr || controller->ready != TROCHOID_READY) {
    result.state = TROCHOID_NOT_READY;
    return result;
  }
  TrochoidController& c = *controller;
  const bool whole = trochoid::correction::repair_memory(c);
  if (c.ready != TROCHOID_READY) {
    result.state = TROCHOID_NOT_READY;
    result.problem = TROCHOID_BAD_MEMORY;
    return result;
  }
  int32_t problem = examine(c, input);
  // Time that went backwards did not pass; too much of it is not used up at once.
  const double dt = input != nullptr && input->dt_s > 0.0
                        ? fmin(input->dt_s, c.config.max_step_s)
                        : 0.0;
  change_state(c, problem, input, dt);
  double wanted = c.middle_m;
  if (running(c)) {
    follow_waves(c, *input, dt);
    wanted = target(c, input->gain, dt, result.limited);
  }
  if (!whole || !(fabs(wanted) < 10.0)) {  // NaN in the table
    problem = TROCHOID_BAD_MEMORY;
    wanted = c.middle_m;
    fail(c, problem, input != nullptr && input->enable != 0);
  }
  const double slope = running(c) ? c.config.slew_m_per_s : c.ramp_m_per_s;
  wanted = clamped(wanted, c.config.lower_m, c.config.upper_m);
  c.output_m = limited_move(c.output_m, wanted, slope * dt);
  if (running(c) && c.output_m != wanted) {
    result.limited |= TROCHOID_LIMITED_SLEW;
  }
  result.command_m = c.output_m;
  result.speed_rps = c.speed_rps;
  result.angle_rev = fraction(c.angle_rev);
  result.fade = c.fade;
  result.gain = c.gain;
  result.state = c.state;
  result.problem = problem;
  result.fault = c.fault;
  result.turns = c.turns;
  return result;
}

double trochoid_controller_gain_limit(const TrochoidController* controller) {
  return controller != nullptr && controller->ready == TROCHOID_READY
             ? controller->gain_limit
             : 0.0;
}
