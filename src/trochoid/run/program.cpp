#include <trochoid/run/commands.h>

#include <trochoid/base/error.h>
#include <trochoid/base/units.h>
#include <trochoid/engagement/steps.h>
#include <trochoid/force/setup.h>
#include <trochoid/run/program.h>
#include <trochoid/run/wall.h>
#include <trochoid/stock/path.h>

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string_view>
#include <utility>

namespace trochoid::run {

namespace {

using engagement::Line;
using results::ProgramForces;
using results::ProgramResult;

/// Longer programs need fewer steps.
constexpr double most_steps = 1e8;
/// Rows that are kept for steps.csv; lines and peaks count all of them.
constexpr std::size_t most_rows = 2'000'000;

stock::Initial stock_of(const cases::Stock& stock, double cell,
                        std::vector<base::Warning>& warnings) {
  if (stock.box.size() == 2) return stock::Box{stock.box[0], stock.box[1]};
  if (stock.cylinder) {
    const cases::StockCylinder& c = *stock.cylinder;
    return stock::Cylinder{c.axis, c.radius, c.z[0], c.z[1]};
  }
  stock::FromAbove seen = stock::seen_from_above(stock.faces.get(), cell);
  if (seen.undercut) {
    warnings.push_back(
        {"stock_undercut",
         fmt::format("{}: there is air below the top of the body. It counts as stock, "
                     "down to the lowest point of the body.",
                     stock.file.name)});
  }
  return std::move(seen.field);
}

/// A quantity against its limit.
struct Limited {
  std::string_view key;
  std::optional<double> allowed;
  double unit;
  double Line::*value;
  engagement::Peak engagement::Totals::*peak;
  std::optional<double> results::PeakErrors::*error;
};

std::vector<Limited> limited(const cases::ForceLimits& limits) {
  using T = engagement::Totals;
  using E = results::PeakErrors;
  std::vector<Limited> all{
      {"peak_force_N", limits.peak_force, 1.0, &Line::peak_xy, &T::peak_xy,
       &E::peak_xy},
      {"peak_tooth_N", limits.peak_tooth, 1.0, &Line::peak_tooth, &T::peak_tooth,
       &E::peak_tooth},
      {"torque_Nm", limits.torque, 1.0, &Line::torque_peak, &T::torque, &E::torque},
      {"power_W", limits.power, 1.0, &Line::power, &T::power, &E::power},
      {"bending_moment_Nm", limits.bending_moment, 1.0, &Line::moment_peak, &T::moment,
       &E::moment},
      {"deflection_um", limits.deflection, unit::um, &Line::deflection, &T::deflection,
       &E::deflection}};
  if (limits.chip.size() == 2) {
    all.push_back(
        {"chip_mm", limits.chip[1], unit::mm, &Line::peak_chip, &T::chip, &E::chip});
  }
  return all;
}

/// Limits that are kept, but lie within the interval of the largest value.
void warn_of_close_limits(const cases::ForceLimits& limits, const ProgramForces& forces,
                          std::vector<base::Warning>& warnings) {
  if (!forces.errors) return;
  for (const Limited& one : limited(limits)) {
    const std::optional<double> error = (*forces.errors).*one.error;
    const double value = std::abs((forces.summary.totals.*one.peak).value);
    if (!one.allowed || !error || value > *one.allowed) continue;
    if (value + *error <= *one.allowed) continue;
    warnings.push_back(
        {"limit_within_interval",
         fmt::format("{} = {:.4g} is kept, but the largest value is {:.4g} +- {:.2g} "
                     "(95 %), in line {}: it may go beyond.",
                     one.key, *one.allowed / one.unit, value / one.unit,
                     *error / one.unit, (forces.summary.totals.*one.peak).line)});
  }
}

std::vector<results::BrokenLimit> broken(const cases::ForceLimits& limits,
                                         std::span<const Line> lines) {
  std::vector<results::BrokenLimit> out;
  for (const Limited& one : limited(limits)) {
    if (!one.allowed) continue;
    results::BrokenLimit found{one.key, *one.allowed / one.unit, 0.0, {}};
    for (const Line& line : lines) {
      const double value = std::abs(line.*one.value);
      if (value <= *one.allowed) continue;
      found.lines.push_back(line.line);
      found.worst = std::max(found.worst, value / one.unit);
    }
    if (!found.lines.empty()) out.push_back(std::move(found));
  }
  return out;
}

/// The lines that need more power than the spindle has at their speed.
std::optional<results::BrokenLimit> beyond_spindle(
    const engagement::Limits& limits, std::span<const engagement::Step> steps) {
  engagement::Limits spindle;
  spindle.power_curve = limits.power_curve;
  results::BrokenLimit found{"power_curve_W", 0.0, 0.0, {}};
  double most = 1.0;
  for (const engagement::Step& step : steps) {
    const double allowed = engagement::power_at(spindle, step.spindle);
    if (!(step.forces.power > allowed)) continue;
    if (found.lines.empty() || found.lines.back() != step.line) {
      found.lines.push_back(step.line);
    }
    if (step.forces.power > most * allowed || found.worst == 0) {
      most = allowed > 0 ? step.forces.power / allowed : most;
      found.allowed = allowed;
      found.worst = step.forces.power;
    }
  }
  if (found.lines.empty()) return std::nullopt;
  return found;
}

/// The lines of a text that an answer names.
std::vector<std::string> texts_of(std::string_view text, std::span<const Line> lines) {
  std::vector<std::string> out;
  std::uint32_t number = 1;
  for (const Line& line : lines) {
    for (; number < line.line; ++number) {
      text.remove_prefix(std::min(text.size(), text.find('\n')));
      if (!text.empty()) text.remove_prefix(1);
    }
    std::string_view one = text.substr(0, text.find('\n'));
    if (one.ends_with('\r')) one.remove_suffix(1);
    out.emplace_back(one);
  }
  return out;
}

/// What rows say by their flags, once each, at the first line.
void warn_of_flags(const ProgramForces& forces, std::vector<base::Warning>& warnings) {
  struct Said {
    engagement::Flag flag;
    std::string_view code;
    std::string_view what;
  };
  constexpr std::array<Said, 3> all{
      {{engagement::rubs_above_flute, "rubs_above_flute",
        "the tool cuts higher than its flutes reach"},
       {engagement::thin_layer, "thin_layer",
        "only layers thinner than floor_um are cut"},
       {engagement::straight_after_corner, "straight_after_corner",
        "in the first turn after the corner forces are too low; those before it are "
        "right"}}};
  for (const Said& one : all) {
    const auto at = std::ranges::find_if(forces.steps, [&](const engagement::Step& s) {
      return (s.flags & one.flag) != 0;
    });
    if (at == forces.steps.end()) continue;
    warnings.push_back(
        {std::string(one.code), fmt::format("line {}: {}", at->line, one.what)});
  }
}

/// What the case asks for and this answer does not do.
void warn_of_unused(const cases::ProgramTables& nc,
                    std::vector<base::Warning>& warnings) {
  if (!nc.machine) return;
  std::vector<std::string_view> keys;
  const auto add = [&](bool given, std::string_view key) {
    if (given) keys.push_back(key);
  };
  const bool brakes = !nc.machine->max_acceleration.empty();
  add(!nc.machine->max_jerk.empty(), "machine.max_jerk_m_per_s3");
  add(!brakes && !nc.machine->max_feed.empty(), "machine.max_feed_mm_per_min");
  add(!brakes && nc.machine->corner_tolerance > 0, "machine.corner_tolerance_mm");
  if (keys.empty()) return;
  warnings.push_back(
      {"not_used",
       fmt::format("The answer does not use these: {}.{}", fmt::join(keys, ", "),
                   brakes ? ""
                          : " Without max_acceleration_m_per_s2 every feed is "
                            "reached at once.")});
}

void warn_of_no_machine(const engagement::Options& options, const ProgramForces& forces,
                        std::vector<base::Warning>& warnings) {
  if (options.drives || !(forces.summary.totals.time_in_cut > 0)) return;
  warnings.push_back(
      {"no_machine",
       "Without [machine] max_acceleration_m_per_s2 the feed is taken as reached at "
       "once: in corners, where a machine brakes, forces are upper bounds."});
}

/// What the new feeds do not reach.
void warn_of_feeds(const results::NewFeeds& feed,
                   std::vector<base::Warning>& warnings) {
  const auto some = [](const std::vector<std::uint32_t>& lines) {
    constexpr std::size_t shown = 10;
    const auto first = std::span(lines).first(std::min(shown, lines.size()));
    return fmt::format(
        "{}{}", fmt::join(first, ", "),
        lines.size() > shown ? fmt::format(" and {} more", lines.size() - shown) : "");
  };
  if (!feed.keeps_limits) {
    warnings.push_back(
        {"limit_not_kept",
         "The new program still goes beyond a limit where a feed could be "
         "lower. Run it with [limits] to see the lines."});
  }
  if (!feed.not_reachable.empty()) {
    warnings.push_back(
        {"limit_not_reachable",
         fmt::format(
             "Even the lowest feed that [feed] factor allows breaks a limit in "
             "lines {}. It is written there; take less depth or width, or lower "
             "the factor.",
             some(feed.not_reachable))});
  }
  if (!feed.rubbing.empty()) {
    warnings.push_back(
        {"rubbing", fmt::format("The largest chip stays below the lower number of "
                                "chip_mm in lines {}: the edges rub there.",
                                some(feed.rubbing))});
  }
}

/// Feeds that nothing but [feed] factor holds.
void warn_of_no_limit(const cases::ProgramTables& nc,
                      std::vector<base::Warning>& warnings) {
  const cases::ForceLimits limits = nc.limits.value_or(cases::ForceLimits{});
  const bool any = limits.peak_force || limits.peak_tooth || limits.torque ||
                   limits.power || limits.bending_moment || limits.deflection ||
                   !limits.chip.empty() ||
                   (nc.machine && !nc.machine->power_curve.empty());
  if (any || nc.feed->target != cases::FeedTarget::limits) return;
  warnings.push_back(
      {"no_limits",
       "[limits] has no limit: every feed is raised to the highest that [feed] factor "
       "allows. Write what the tool may bear, such as peak_tooth_N."});
}

/// What is missing in the answer.
void warn_of_gaps(const ProgramForces& forces, std::vector<base::Warning>& warnings) {
  const engagement::Summary& summary = forces.summary;
  if (!summary.complete) {
    warnings.insert(
        warnings.begin(),
        {"time_limit",
         fmt::format(
             "The time was up: forces are computed for the first {} steps, up to "
             "line {}. Peaks and the removed volume count these steps only.",
             summary.totals.steps,
             summary.lines.empty() ? 0 : summary.lines.back().line)});
  }
  if (forces.rows > forces.steps.size()) {
    warnings.push_back(
        {"rows_left_out",
         fmt::format("steps.csv and arcs.csv have the first {} of {} rows. Lines and "
                     "peaks count all of them. A larger step_turns makes fewer rows.",
                     forces.steps.size(), forces.rows)});
  }
}

engagement::Options options_of(const cases::Case& given, const base::Stop& stop) {
  const cases::NcProgram& nc = *given.nc.program;
  engagement::Options options{.step_turns = nc.step_turns,
                              .floor = nc.floor,
                              .bottom = nc.bottom == cases::BottomEdges::none
                                            ? engagement::Bottom::none
                                            : engagement::Bottom::estimate,
                              .stop = stop};
  if (!given.nc.machine) return options;
  const cases::MachineDrives& machine = *given.nc.machine;
  options.rapid_feed = machine.rapid_feed;
  if (machine.max_acceleration.empty()) return options;
  stock::Drives& drives = options.drives.emplace();
  std::ranges::copy_n(machine.max_acceleration.begin(), 3, drives.acceleration.begin());
  if (!machine.max_feed.empty()) {
    std::ranges::copy_n(machine.max_feed.begin(), 3, drives.feed.begin());
  }
  drives.corner_tolerance = machine.corner_tolerance;
  return options;
}

void check_length(const engagement::Job& job, const cases::Case& given) {
  const double steps = engagement::step_count(job);
  if (steps <= most_steps) return;
  throw base::InputError(
      {fmt::format("{}: program.step_turns = {}: {:.3g} steps are too many; must be at "
                   "least {:.3g} for this program",
                   given.file.string(), job.options.step_turns, steps,
                   job.options.step_turns * steps / most_steps)});
}

/// A place has the forces of a feed move that goes somewhere.
void check_places(const engagement::Job& job, const cases::Case& given) {
  const auto& places = given.nc.program->places;
  if (places.empty()) return;
  const auto& moves = job.program.moves;
  const stock::Path path = stock::path(moves, job.options.rapid_feed);
  std::vector<std::string> problems;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const auto line = static_cast<std::uint32_t>(places[i][0]);
    bool there = false;
    for (std::size_t m = 0; m < moves.size() && !there; ++m) {
      there =
          moves[m].line == line && is_fed(moves[m]) && std::isfinite(path.begins[m]);
    }
    if (there) continue;
    problems.push_back(
        fmt::format("{}: program.places entry {}: line {} of the program has no move "
                    "with a feed, or one without length",
                    given.file.string(), i + 1, line));
  }
  if (!problems.empty()) throw base::InputError(std::move(problems));
}

ProgramForces forces_of(const engagement::Job& job, const cases::Case& given,
                        const Progress& progress) {
  check_length(job, given);
  check_places(job, given);
  const cases::NcProgram& nc = *given.nc.program;
  ProgramForces out;
  for (const engagement::Tool& tool : job.tools) {
    if (tool.cuts) out.teeth = std::max(out.teeth, tool.cutter.pitch.size());
  }
  const double count = std::max(1.0, engagement::step_count(job));
  std::size_t done = 0;
  out.summary =
      engagement::compute_steps(job, [&](std::span<const engagement::Step> rows) {
        out.rows += rows.size();
        for (const engagement::Step& row : rows)
          done += static_cast<std::size_t>(row.count);
        const std::size_t room = most_rows - std::min(most_rows, out.steps.size());
        const auto kept = rows.first(std::min(room, rows.size()));
        out.steps.insert(out.steps.end(), kept.begin(), kept.end());
        if (!rows.empty()) {
          progress({fmt::format("Forces of line {}", rows.back().line),
                    static_cast<double>(done) / count});
        }
      });
  std::vector<engagement::PlaceRequest> places;
  for (const auto& [line, fraction] : nc.places) {
    places.push_back({static_cast<std::uint32_t>(line), fraction});
  }
  out.asked = nc.places;
  if (!places.empty()) {
    out.places = engagement::steps_at(job, places, nc.place_heights);
  }
  out.broken =
      broken(given.nc.limits.value_or(cases::ForceLimits{}), out.summary.lines);
  if (auto beyond = beyond_spindle(limits_of(given.nc), out.steps)) {
    out.broken.push_back(std::move(*beyond));
  }
  out.texts = texts_of(*nc.text.get().text, out.summary.lines);
  if (given.nc.feed && out.summary.complete && out.summary.totals.time_in_cut > 0) {
    out.feed = new_feeds(job, given, out, progress);
  }
  return out;
}

void say(const ProgramForces& forces, std::size_t moves, results::Heading& heading) {
  const engagement::Totals& all = forces.summary.totals;
  if (!(all.time_in_cut > 0)) {
    heading.ok = false;
    heading.message =
        "No feed move of the program cuts anything: compare the places of the moves with "
        "[stock] and origin_mm.";
    return;
  }
  heading.message = fmt::format(
      "{} moves in {:.4g} s, {:.4g} s of it in cut. The largest force across the tool is "
      "{:.4g} N, in line {} ({}).",
      moves, all.time, all.time_in_cut, all.peak_xy.value, all.peak_xy.line,
      name_of(all.peak_xy.cause));
  for (const results::BrokenLimit& one : forces.broken) {
    heading.warnings.push_back(
        {"limit_broken",
         fmt::format(
             "{} = {:.4g}: {} lines go beyond it, line {} first; the most is {:.6g}",
             one.limit, one.allowed, one.lines.size(), one.lines.front(), one.worst)});
  }
}

}  // namespace

results::ProgramResult program(const cases::Case& given, const Progress& progress,
                               const base::Stop& stop) {
  check_name_of_program(given);
  progress("Reading the program");
  const files::ProgramFile& file = given.nc.program->text.get();
  ProgramResult r{.heading = heading_of(given), .program = file.program};
  base::add(r.heading.warnings, file.notes);
  const auto fed = std::ranges::count_if(r.program.moves, is_fed);
  r.heading.ok = fed > 0;
  if (!r.heading.ok) {
    r.heading.message = "The program has no feed move: nothing is cut.";
    return r;
  }
  double time = 0.0;
  for (const program::Move& move : r.program.moves) time += move.time;
  r.heading.message = fmt::format("{} moves, {} of them fed, in {:.4g} s.",
                                  r.program.moves.size(), fed, time);
  const ProgramTools tools = tools_of(given, r.program);
  base::add(r.heading.warnings, tools.why_not);
  base::add(r.heading.warnings, tools.notes);
  warn_of_other_tools(*given.nc.program, r.program, r.heading.warnings);
  if (!given.nc.stock) return r;
  if (!tools.why_not.empty()) {
    r.heading.ok = false;
    r.heading.message = "No forces: a tool of the program is in no case.";
    return r;
  }
  warn_of_tools(given, r.program, tools, r.heading.warnings);
  const double cell =
      given.nc.stock->cell.value_or(engagement::usual_cell(tools.tools));
  const stock::Initial stock = stock_of(*given.nc.stock, cell, r.heading.warnings);
  engagement::Options options = options_of(given, stop);
  options.cell = cell;
  const engagement::Job job{r.program, tools.tools, stock, options};
  r.forces = forces_of(job, given, progress);
  r.forces->chatter =
      chatter_of(r.forces->steps, tools.tools, tools.vibrations, progress, stop);
  r.forces->record =
      record_of(job, given, tools.own, r.forces->steps, r.heading.warnings);
  r.forces->walls = walls_of(job, r.forces->steps, progress);
  r.forces->errors =
      peak_errors(job, given, tools.own, r.forces->summary.totals, r.heading.warnings);
  warn_of_close_limits(given.nc.limits.value_or(cases::ForceLimits{}), *r.forces,
                       r.heading.warnings);
  base::add(r.heading.warnings, r.forces->summary.warnings);
  warn_of_flags(*r.forces, r.heading.warnings);
  warn_of_unused(given.nc, r.heading.warnings);
  warn_of_no_machine(job.options, *r.forces, r.heading.warnings);
  if (r.forces->chatter) warn_of_chatter(*r.forces->chatter, r.heading.warnings);
  warn_of_gaps(*r.forces, r.heading.warnings);
  if (r.forces->feed) {
    warn_of_feeds(*r.forces->feed, r.heading.warnings);
    warn_of_no_limit(given.nc, r.heading.warnings);
  } else if (given.nc.feed && r.forces->summary.totals.time_in_cut > 0) {
    r.heading.warnings.push_back(
        {"no_new_feeds", "The time was up: no program with new feeds is written."});
  }
  say(*r.forces, r.program.moves.size(), r.heading);
  return r;
}

}  // namespace trochoid::run
