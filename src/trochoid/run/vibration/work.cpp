#include <trochoid/run/vibration/work.h>

#include <trochoid/base/units.h>
#include <trochoid/dynamics/motion.h>
#include <trochoid/run/shared/machine.h>

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace trochoid::run {

namespace {

/// Of the fastest mode [rad/s].
double fastest_of(const dynamics::System& system) {
  double fastest = 0.0;
  for (const dynamics::ChipMode& mode : system.modes) {
    fastest = std::max(fastest, std::sqrt(mode.stiffness / mode.mass));
  }
  return fastest;
}

/// Teeth that pass in a period of the cut: all where they are not alike.
double periods_per_turn(const force::Setup& setup) {
  const bool alike = geometry::equally_pitched(setup.cutter.pitch) &&
                     force::keeps_radius(setup) && setup.runout.eccentricity == 0;
  const bool offsets =
      std::ranges::any_of(setup.runout.radial_offsets, [](double r) { return r != 0; });
  return alike && !offsets ? setup.cutter.teeth() : 1.0;
}

}  // namespace

std::vector<Work> stability_work(const inputs::Case& given) {
  // Measured: of a multiplier, and for each vibration in the period that it belongs to.
  constexpr double multiplier = 100;
  constexpr double vibration = 80;
  constexpr double vibration_bytes = 13e3;
  constexpr double around_case = 60;      // depths that are looked at for its limit
  constexpr double along_limit = 15;      // multipliers a speed
  constexpr double by_frequency = 1.8e5;  // a speed, two solutions, of each order
  const inputs::Stability& asked = *given.machine.stability;
  const auto speeds = base::values(*asked.spindle_speed);
  const auto depths = asked.axial_depth->count;
  const dynamics::System system = chip_modes(given.machine.modes);
  const double periods = periods_per_turn(given.setup);
  const auto vibrations = [&](double Omega) {
    return fastest_of(system) / (Omega * periods);
  };
  const auto one = [&](double Omega) {
    return multiplier + vibration * vibrations(Omega);
  };
  double diagram = 0.0;
  for (const double Omega : speeds) {
    diagram += (depths + along_limit) * one(Omega);
  }
  const double Omega = given.setup.cut.Omega;
  const double count = static_cast<double>(speeds.size());
  std::vector<Work> parts = {
      {.what = "points of the lobes",
       .count = count * depths,
       .evaluations = diagram,
       .key = {.name = "stability.spindle_rpm", .value = count, .of = " values"}},
      {.what = "vibrations in a period of the cut",
       .count = vibrations(Omega),
       .evaluations = around_case * one(Omega),
       .bytes = vibration_bytes * static_cast<double>(system.modes.size()) *
                vibrations(std::min(Omega, speeds.front())),
       .key = {.name = "cut.spindle_rpm", .value = Omega / unit::rpm, .power = -1}}};
  if (!given.machine.measured_frfs.empty()) {
    parts.push_back(
        {.what = "speeds with the measured response",
         .count = count,
         .evaluations = (count + 1) * (2 * asked.harmonics + 1) * by_frequency,
         .key = {.name = "stability.spindle_rpm", .value = count, .of = " values"}});
  }
  return parts;
}

std::vector<Work> dynamics_work(const inputs::Case& given) {
  // Measured: of a step with one tooth, and what a step of a turn remembers.
  constexpr double step = 1;
  constexpr double step_bytes = 600;
  constexpr double kept_row = 400;
  const dynamics::MotionProblem problem{.setup = given.setup,
                                        .law = given.law,
                                        .system = chip_modes(given.machine.modes)};
  const int steps = dynamics::steps_needed(problem);
  if (steps > dynamics::most_steps) {
    return {};
  }
  const double teeth = given.setup.cutter.teeth();
  const double turn = steps * teeth;
  const double turns = given.sampling.revolutions;
  const double rpm = given.setup.cut.Omega / unit::rpm;
  return {{.what = "steps of the motion",
           .count = turns * turn,
           .evaluations = turns * turn * teeth * step,
           .key = {.name = "sampling.revolutions", .value = turns}},
          {.what = "steps of a turn, which are remembered",
           .count = turn,
           .bytes = turn * teeth * step_bytes,
           .key = {.name = "cut.spindle_rpm", .value = rpm, .power = -1}},
          {.what = "samples of the last turns",
           .count = std::min(turns, 2.0) * given.sampling.samples_per_rev,
           .bytes = std::min(turns, 2.0) * given.sampling.samples_per_rev * kept_row,
           .key = {.name = "sampling.samples_per_rev",
                   .value = static_cast<double>(given.sampling.samples_per_rev)}}};
}

std::vector<Work> measured_work(const inputs::MachineTables& machine) {
  constexpr double byte_bytes = 12;
  constexpr double byte_evaluations = 2;
  constexpr double megabyte = 1e6;
  std::vector<Work> parts;
  const auto add = [&](const char* table, const std::string& file) {
    const double size = size_of_file(file);
    parts.push_back({.what = "bytes of the record",
                     .count = size,
                     .evaluations = size * byte_evaluations,
                     .bytes = size * byte_bytes,
                     .key = {.name = fmt::format("{}.file", table),
                             .value = size / megabyte,
                             .of = " MB"}});
  };
  if (machine.frf) add("frf", machine.frf->source.file.path);
  if (machine.step) add("step", machine.step->source.file.path);
  return parts;
}

}  // namespace trochoid::run
