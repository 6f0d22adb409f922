#include <trochoid/run/work.h>

#include <trochoid/base/units.h>
#include <trochoid/correction/moving_cut.h>
#include <trochoid/dynamics/motion.h>
#include <trochoid/dynamics/steady_state.h>
#include <trochoid/run/problems.h>
#include <trochoid/run/wall.h>

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <system_error>

namespace trochoid::run {

namespace {

std::string time_needed(double seconds) {
  constexpr double minute = 60;
  constexpr double hour = 60 * minute;
  constexpr double day = 24 * hour;
  return seconds < 2 * minute ? fmt::format("{:.0f} s", std::ceil(seconds))
         : seconds < 2 * hour ? fmt::format("{:.0f} min", seconds / minute)
         : seconds < 2 * day  ? fmt::format("{:.0f} h", seconds / hour)
                              : fmt::format("{:.0f} days", seconds / day);
}

/// Downwards, for more would again be too much; upwards where less would be.
double two_digits(double value, bool up) {
  const double unit = std::pow(10.0, std::floor(std::log10(value)) - 1);
  const double digits = value / unit;
  return unit * (up ? std::ceil(digits - 1e-9) : std::floor(digits + 1e-9));
}

/// How many times too much.
double excess(double evaluations, double bytes) {
  return std::max(evaluations / most_evaluations, bytes / most_bytes);
}

/// The value with which this part leaves room for the others; empty: none.
std::string would_do(const Work& part, double evaluations, double bytes) {
  const auto room = [](double all, double own, double most) {
    return all > most ? std::max(most - (all - own), most / 10) / own : 1.0;
  };
  const double left = std::min(room(evaluations, part.evaluations, most_evaluations),
                               room(bytes, part.bytes, most_bytes));
  const WorkKey& key = part.key;
  if (key.power == 0 || key.value == 0) {
    return "";
  }
  const bool up = key.power < 0;
  const double value = two_digits(key.value * std::pow(left, 1 / key.power), up);
  return fmt::format(": {} {:g}{} would do", up ? "from" : "up to", value, key.of);
}

/// How often the edge winds around the cutter.
double windings(const force::Setup& setup) {
  const double lag = setup.cutter.lag_diameter > 0 ? setup.cutter.lag_diameter
                                                   : setup.cutter.profile.D;
  return 2 * setup.cut.a_p * std::abs(std::tan(setup.cutter.helix)) /
         (lag * unit::turn);
}

double law_factor(const force::Law& law) {
  constexpr double power_law = 3;
  return force::form(law).power ? power_law : 1;
}

constexpr double megabyte = 1e6;

constexpr double most_angles_at_tip = 7000;

/// Of the evaluations at an angle, what the edge near the axis takes, or all edges under a
/// power law where the tool has such a tip: of a turn no more than about
/// `most_angles_at_tip` are computed.
double evaluations_at_tip(const force::Setup& setup, const force::Law& law) {
  constexpr double pair_to_axis = 130;
  const geometry::Profile& profile = setup.cutter.profile;
  const bool to_axis = profile.Rr == 0 && (profile.R > 0 || profile.alpha != 0);
  const double teeth = setup.cutter.teeth();
  return to_axis ? teeth * teeth * pair_to_axis * law_factor(law) : 0.0;
}

/// Of the force on all teeth at one angle of the spindle.
double evaluations_per_angle(const force::Setup& setup, const force::Law& law) {
  // Measured: each tooth asks which of all the others cut before it.
  constexpr double pair = 7;
  constexpr double pair_and_winding = 13;
  const double teeth = setup.cutter.teeth();
  const double one = pair + pair_and_winding * windings(setup);
  return teeth * teeth * one * law_factor(law) + evaluations_at_tip(setup, law);
}

/// Size of a file [bytes]; 0 where there is none: reading it tells that better.
double size_of_file(const std::filesystem::path& file) {
  std::error_code error;
  const auto size = std::filesystem::file_size(file, error);
  return error ? 0.0 : static_cast<double>(size);
}

std::vector<Work> simulate_work(const cases::Case& given) {
  // Measured: a row is kept, printed, and shown in the report.
  constexpr double row_evaluations = 6;
  constexpr double row_bytes = 250;
  const cases::Sampling& s = given.sampling;
  const bool listed = !s.angles.empty();
  const double rows =
      listed ? static_cast<double>(s.angles.size()) : s.samples_per_rev * s.revolutions;
  // Turns repeat, and what repeats is not computed again.
  const double angles =
      listed ? rows : s.samples_per_rev * std::min(s.revolutions, 1.0);
  const double at_tip = evaluations_at_tip(given.setup, given.law);
  const double along = evaluations_per_angle(given.setup, given.law) - at_tip;
  const WorkKey key{.name = listed ? "sampling.angles_deg" : "sampling.samples_per_rev",
                    .value = listed ? rows : double(s.samples_per_rev),
                    .of = listed ? " values" : ""};
  std::vector<Work> parts = {{.what = "angles of the forces",
                              .count = rows,
                              .evaluations = angles * along + rows * row_evaluations,
                              .bytes = rows * row_bytes,
                              .key = key}};
  if (at_tip > 0) {
    const bool close = !listed && angles > most_angles_at_tip;
    parts.push_back({.what = "angles of the forces at the tip",
                     .count = close ? most_angles_at_tip : angles,
                     .evaluations = (close ? most_angles_at_tip : angles) * at_tip,
                     .key = key});
    parts.back().key.power = close ? 0.0 : 1.0;
  }
  return parts;
}

bool in_closed_form(const cases::Case& given) {
  return force::keeps_radius(given.setup) && !force::form(given.law).power;
}

/// Records are known by their size only.
std::vector<Work> identify_work(const cases::Case& given) {
  // Measured, with text: a byte becomes five, and is read, turned and folded once.
  constexpr double byte_evaluations = 0.2;
  constexpr double byte_bytes = 5.5;
  // A fit asks for so many turns of the force, at so many angles.
  constexpr double turns_fitted = 400;
  constexpr double angles = 720;
  std::vector<Work> parts;
  for (std::size_t i = 0; i < given.measurements.size(); ++i) {
    if (!given.measurements[i].mean.empty()) continue;
    const double size = size_of_file(given.measurements[i].source.file.path);
    parts.push_back({.what = "bytes of records",
                     .count = size,
                     .evaluations = size * byte_evaluations,
                     .bytes = size * byte_bytes,
                     .key = {.name = fmt::format("measurement[{}].file", i + 1),
                             .value = size / megabyte,
                             .of = " MB"}});
  }
  if (!in_closed_form(given)) {
    const double runs =
        static_cast<double>(std::max<std::size_t>(given.measurements.size(), 1));
    parts.push_back({.what = "turns of a force that is summed along the edges",
                     .count = runs * turns_fitted,
                     .evaluations = runs * turns_fitted * angles *
                                    evaluations_per_angle(given.setup, given.law),
                     .key = {.name = "tool.teeth",
                             .value = static_cast<double>(given.setup.cutter.teeth()),
                             .power = 0}});
  }
  return parts;
}

std::vector<Work> plan_work(const cases::Case& given) {
  constexpr double derivatives = 10;
  constexpr double in_closed = 3;  // of an angle
  const cases::Plan& plan = given.plan;
  std::size_t engagements = 0;
  for (const cases::PlannedEngagement kind : plan.engagements) {
    const bool slot = kind == cases::PlannedEngagement::slot;
    engagements += slot ? 1 : plan.radial_depths.size();
  }
  const auto cuts =
      static_cast<double>(engagements * plan.feeds.size() * plan.axial_depths.size());
  const double angle =
      in_closed_form(given)
          ? in_closed
          : derivatives * evaluations_per_angle(given.setup, given.law);
  std::vector<Work> parts =
      given.measurements.empty() ? std::vector<Work>{} : identify_work(given);
  parts.push_back({.what = "cuts to choose from",
                   .count = cuts,
                   .evaluations = cuts * plan.samples_per_rev * angle,
                   .key = {.name = "plan.samples_per_rev",
                           .value = static_cast<double>(plan.samples_per_rev)}});
  return parts;
}

/// Each tooth feels what all the others left.
double pairs_of_teeth(const cases::Case& given) {
  return static_cast<double>(given.setup.cutter.teeth() * given.setup.cutter.teeth());
}

bool is_regenerative(const cases::Surface& surface) {
  return surface.feedback == surface::Feedback::regenerative;
}

std::vector<Work> surface_work(const cases::Case& given) {
  // Measured: of a point of the map, and of the deflection that the chip feels again.
  constexpr double point = 4.5;
  constexpr double point_bytes = 60;
  constexpr double fed_back = 1.7e6;  // times the square of the teeth
  const cases::Surface table = given.machine.surface.value_or(cases::Surface{});
  const cases::Sampling& s = given.sampling;
  const bool listed = !s.angles.empty();
  const double rows = listed ? static_cast<double>(s.angles.size())
                             : std::max(1.0, s.samples_per_rev * s.revolutions);
  const auto heights = static_cast<double>(
      surface::map_heights(map_options(given), given.setup.cut.a_p).size());
  const double passes =
      static_cast<double>(std::max<std::size_t>(given.machine.passes.size(), 1)) *
      (table.also_bends.empty() ? 1 : 2);
  return {{.what = "points of the map of the wall",
           .count = rows * heights,
           .evaluations = passes * rows * heights * point,
           .bytes = rows * heights * point_bytes,
           .key = {.name = listed ? "sampling.angles_deg" : "sampling.samples_per_rev",
                   .value = listed ? rows : static_cast<double>(s.samples_per_rev),
                   .of = listed ? " values" : ""}},
          {.what = "pairs of teeth that feel each other's deflection",
           .count = pairs_of_teeth(given),
           .evaluations =
               is_regenerative(table) ? passes * fed_back * pairs_of_teeth(given) : 0.0,
           .key = {.name = "tool.teeth",
                   .value = static_cast<double>(given.setup.cutter.teeth()),
                   .power = 0}}};
}

/// Readings are known by their size only.
std::vector<Work> calibrate_work(const cases::Case& given) {
  // Measured: many readings are folded, and fitted as some hundred.
  constexpr double fits = 1.7e7;  // times the square of the teeth
  constexpr double byte_evaluations = 2;
  constexpr double byte_bytes = 12;
  std::vector<Work> parts;
  const auto& all = given.machine.surface_measurements;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const double size = size_of_file(all[i].source.file.path);
    parts.push_back({.what = "bytes of the surface",
                     .count = size,
                     .evaluations = size * byte_evaluations,
                     .bytes = size * byte_bytes,
                     .key = {.name = fmt::format("surface_measurement[{}].file", i + 1),
                             .value = size / megabyte,
                             .of = " MB"}});
  }
  if (!all.empty() && all.front().of == cases::MeasuredOf::finish) return parts;
  parts.push_back({.what = "pairs of teeth, in every fit",
                   .count = pairs_of_teeth(given),
                   .evaluations = fits * pairs_of_teeth(given),
                   .key = {.name = "tool.teeth",
                           .value = static_cast<double>(given.setup.cutter.teeth()),
                           .power = 0}});
  return parts;
}

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

std::vector<Work> stability_work(const cases::Case& given) {
  // Measured: of a multiplier, and for each vibration in the period that it belongs to.
  constexpr double multiplier = 100;
  constexpr double vibration = 80;
  constexpr double vibration_bytes = 13e3;
  constexpr double around_case = 60;      // depths that are looked at for its limit
  constexpr double along_limit = 15;      // multipliers a speed
  constexpr double by_frequency = 1.8e5;  // a speed, two solutions, of each order
  const cases::Stability& asked = *given.machine.stability;
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

/// Of turns without chatter, which asks for more. Nothing where the steps are more than
/// dynamics computes: it says that itself.
std::vector<Work> dynamics_work(const cases::Case& given) {
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
  const double turns =
      std::max<double>(given.sampling.revolutions, dynamics::fewest_turns);
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

/// By the size of the file.
std::vector<Work> measured_work(const cases::Case& given) {
  constexpr double byte_bytes = 12;
  constexpr double byte_evaluations = 2;
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
  if (given.machine.frf) add("frf", given.machine.frf->source.file.path);
  if (given.machine.step) add("step", given.machine.step->source.file.path);
  return parts;
}

/// By the size of the text: its moves are not known before it is read.
std::vector<Work> program_work(const cases::Case& given) {
  // Measured: of a byte, and of the moves that it becomes.
  constexpr double byte_evaluations = 1;
  constexpr double byte_bytes = 12;
  const double size = size_of_file(given.nc.program->file.path);
  return {{.what = "bytes of the program",
           .count = size,
           .evaluations = size * byte_evaluations,
           .bytes = size * byte_bytes,
           .key = {.name = "program.file", .value = size / megabyte, .of = " MB"}}};
}

std::vector<Work> correct_work(const cases::Case& given) {
  // Measured: of the command itself, and of every speed of the map.
  constexpr double command = 7e6;
  constexpr double speed = 8e4;
  constexpr double slice = 0.4;  // that a slice costs more
  const double slices = correction::slices_for(given.setup);
  const double speeds = given.machine.correct->spindle_speed->count;
  return {{.what = "speeds, and the command itself",
           .count = speeds,
           .evaluations = (command + speeds * speed) * (1 + slice * (slices - 1)),
           .key = {.name = "correct.spindle_rpm", .value = speeds, .of = " values"}}};
}

}  // namespace

std::string too_much(std::span<const Work> parts) {
  double evaluations = 0.0;
  double bytes = 0.0;
  for (const Work& part : parts) {
    evaluations += part.evaluations;
    bytes += part.bytes;
  }
  if (!(excess(evaluations, bytes) > 1)) {
    return "";
  }
  const Work& most = *std::ranges::max_element(
      parts, {}, [](const Work& part) { return excess(part.evaluations, part.bytes); });
  constexpr double gigabyte = 1e9;
  constexpr double worth_saying = 0.1;
  const double share = bytes / most_bytes;
  const std::string memory =
      share > worth_saying ? fmt::format(" and {:.2g} GB of memory", bytes / gigabyte)
                           : "";
  return fmt::format(
      "{} = {:g}{}{}. This would take about {:.2g} evaluations, {} on one core{}, most "
      "of it for {:.6g} {}; more than {:g} evaluations or {:g} GB are computed with "
      "--anyway only",
      most.key.name, most.key.value, most.key.of, would_do(most, evaluations, bytes),
      evaluations, time_needed(evaluations * seconds_per_evaluation), memory,
      most.count, most.what, most_evaluations, most_bytes / gigabyte);
}

std::vector<Work> work_of(base::Command command, const cases::Case& given) {
  using base::Command;
  switch (command) {
    case Command::simulate:
      return simulate_work(given);
    case Command::identify:
      return identify_work(given);
    case Command::surface:
      return surface_work(given);
    case Command::calibrate:
      return calibrate_work(given);
    case Command::stability:
      return stability_work(given);
    case Command::modes:
    case Command::actuator:
      return measured_work(given);
    case Command::dynamics:
      return dynamics_work(given);
    case Command::correct:
      return correct_work(given);
    case Command::program:
      return program_work(given);
    case Command::plan:
      return given.plan.of == cases::PlanOf::wall     ? calibrate_work(given)
             : given.plan.of == cases::PlanOf::forces ? plan_work(given)
                                                      : std::vector<Work>{};
  }
  return {};
}

}  // namespace trochoid::run
