#include <trochoid/correction/limits.h>

#include <trochoid/base/units.h>

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace trochoid::correction {

namespace {

/// How far above the speed of the case its limit is looked for.
constexpr double speeds_searched = 50;

/// A limit that a command was made to keep is kept to the last digits.
constexpr double by_rounding = 1e-9;

Limit limit_of(LimitKind kind, double value, double limit, std::string reason) {
  const bool kept = value <= limit * (1 + by_rounding);
  const double margin = kept ? std::max(limit - value, 0.0) : limit - value;
  return {kind, value, limit, margin, true, kept, std::move(reason)};
}

Limit unknown(LimitKind kind, double value, std::string reason) {
  return {kind,
          value,
          std::numeric_limits<double>::infinity(),
          std::numeric_limits<double>::infinity(),
          false,
          true,
          std::move(reason)};
}

/// Extremes of the force through the spring over a turn [N].
struct Push {
  double push = 0.0;
  double pull = 0.0;
};

Push push_of(const Command& command, const Plant& plant, double Omega,
             const RigidCut& cut) {
  const Harmonics X = table_response(plant, command.wave, Omega, table_harmonics);
  constexpr int angles = 720;
  Push out{-std::numeric_limits<double>::infinity(), 0.0};
  double least = std::numeric_limits<double>::infinity();
  const PeriodicMotion motion = X;
  for (int i = 0; i < angles; ++i) {
    const double phi = unit::turn * (i + 0.5) / angles;
    const MotionPoint p = motion_at(motion, phi);
    const double force = plant.table.mass * Omega * Omega * p.curvature +
                         (plant.table.damping - plant.c_s) * Omega * p.slope +
                         (plant.table.stiffness - plant.k_s) * p.x +
                         cut.force(motion, phi)[0];
    out.push = std::max(out.push, force);
    least = std::min(least, force);
  }
  out.push = std::max(out.push, 0.0);
  out.pull = std::max(-least, 0.0);
  return out;
}

}  // namespace

LimitReport check_limits(const Command& command, const Plant& plant, double Omega,
                         const ActuatorLimits& limits, const RigidCut& cut) {
  const Range range = range_of(command.wave);
  LimitReport report;
  report.offset = (limits.stroke_low + limits.stroke_high) / 2 - range.middle();
  const double stroke = limits.stroke_high - limits.stroke_low;
  report.limits.push_back(
      limit_of(LimitKind::stroke, range.peak_to_peak(), stroke,
               fmt::format("the command takes {:.2f} um of a stroke of {:.2f} um",
                           range.peak_to_peak() / unit::um, stroke / unit::um)));
  const double slew = Omega * range.slope;
  const std::string fast = std::isfinite(slew)
                               ? fmt::format("the command moves at up to {:.2f} um/ms",
                                             slew / unit::um * 1e-3)
                               : std::string("the command jumps");
  report.limits.push_back(
      limits.slew ? limit_of(LimitKind::slew, slew, *limits.slew,
                             fmt::format("{}; the actuator at {:.2f} um/ms", fast,
                                         *limits.slew / unit::um * 1e-3))
                  : unknown(LimitKind::slew, slew, fast + "; the limit is not known"));
  const Push force = push_of(command, plant, Omega, cut);
  report.limits.push_back(
      limit_of(LimitKind::push, force.push, limits.push,
               fmt::format("the actuator pushes with up to {:.1f} N of {:.0f} N",
                           force.push, limits.push)));
  report.limits.push_back(
      limit_of(LimitKind::pull, force.pull, limits.pull,
               fmt::format("it pulls with up to {:.1f} N of {:.0f} N", force.pull,
                           limits.pull)));
  const double highest = most_frequency(limits, plant);
  if (command.n_max > 0) {
    const double frequency = command.n_max * Omega / unit::turn;
    report.limits.push_back(limit_of(
        LimitKind::resonance, frequency, highest,
        fmt::format(
            "the highest of {} harmonics is at {:.1f} Hz, {:.1f} Hz are allowed "
            "below the table's {:.0f} Hz",
            command.n_max, frequency, highest,
            structure::natural_frequency(plant.table) / unit::turn)));
  } else {
    report.limits.push_back(
        unknown(LimitKind::resonance, Omega / unit::turn,
                fmt::format("the command is not limited to harmonics; its first is at "
                            "{:.1f} Hz, {:.1f} Hz are allowed",
                            Omega / unit::turn, highest)));
  }
  report.ok = std::all_of(report.limits.begin(), report.limits.end(),
                          [](const Limit& l) { return l.ok; });
  return report;
}

double stroke_speed(const PeriodicMotion& motion, const Plant& plant,
                    const ActuatorLimits& limits, int n_max, double highest) {
  const double stroke = limits.stroke_high - limits.stroke_low;
  const auto over = [&](double Omega) {
    const Command c =
        command_for(motion, Method::inverse, plant, Omega, {.n_max = n_max});
    return range_of(c.wave).peak_to_peak() - stroke;
  };
  constexpr int steps = 1000;
  double low = highest / steps;
  if (over(low) > 0) {
    return 0.0;
  }
  for (int i = 2; i <= steps; ++i) {
    double high = highest * i / steps;
    if (over(high) > 0) {
      for (int k = 0; k < 50; ++k) {
        const double middle = (low + high) / 2;
        (over(middle) > 0 ? high : low) = middle;
      }
      return low;
    }
    low = high;
  }
  return highest;
}

Limit speed_limit(const Command& command, const PeriodicMotion& motion,
                  const Plant& plant, double Omega, const ActuatorLimits& limits) {
  const double stroke = (limits.stroke_high - limits.stroke_low) / unit::um;
  if (command.n_max == 0) {
    return unknown(LimitKind::speed, Omega,
                   "the range of this command does not grow with the speed");
  }
  const int n = command.n_max;
  const double highest = speeds_searched * std::max(Omega, 100.0);
  const double most = stroke_speed(motion, plant, limits, n, highest);
  if (most >= highest) {
    return unknown(
        LimitKind::speed, Omega,
        fmt::format("the inverse of {} harmonics keeps the stroke of {:.2f} um "
                    "up to {:.0f} rpm",
                    n, stroke, highest / unit::rpm));
  }
  return limit_of(
      LimitKind::speed, Omega, most,
      fmt::format("the inverse of {} harmonics fills the stroke of {:.2f} um "
                  "at {:.0f} rpm, the spindle turns at {:.0f} rpm",
                  n, stroke, most / unit::rpm, Omega / unit::rpm));
}

}  // namespace trochoid::correction
