#include <trochoid/program/machine.h>

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace trochoid::program {

namespace {

void set_feed_mode(Run& run, Sorted& s) {
  Machine& m = run.machine;
  if (!s.orders.has(Group::feed_mode)) return;
  const Action action = s.orders.of(Group::feed_mode);
  const FeedMode mode = action == Action::inverse_time ? FeedMode::inverse_time
                        : action == Action::per_turn   ? FeedMode::per_turn
                                                       : FeedMode::per_minute;
  if (mode != m.feed_mode) m.feed.reset();
  m.feed_mode = mode;
}

Place place_at(const Block& block, std::uint32_t at) {
  return {block.line, column_of(block.text, at)};
}

void set_unit(Run& run, Sorted& s) {
  Machine& m = run.machine;
  if (!s.orders.has(Group::unit)) return;
  const Action action = s.orders.of(Group::unit);
  const bool inches = action == Action::inch || action == Action::inch_lengths;
  const bool feed_too = action == Action::inch || action == Action::metric;
  const double length_unit = inches ? unit::inch : unit::mm;
  const Place place = place_at(s.block, s.orders.place_of(Group::unit));
  m.length_unit = length_unit;
  if (!feed_too) {
    if (m.feed_unit != m.length_unit) {
      remark(run.complaints, "feed_unit", place,
             fmt::format("lengths are in {} from here on, the feed stays in {}",
                         inches ? "inches" : "mm", inches ? "mm/min" : "inches"));
    }
    return;
  }
  const int tenths = s.orders.code[static_cast<std::size_t>(Group::unit)]->tenths;
  if (run.habits.dialect == Dialect::sinumerik && (tenths == 200 || tenths == 210)) {
    remark(run.complaints, "iso_units", place,
           fmt::format("G{} is taken as G{}", tenths / 10, inches ? 700 : 710));
  }
  if (m.feed_unit == length_unit) return;
  m.feed_unit = length_unit;
  m.feed.reset();
  if (const Word* f = s.orders.find('F')) {
    complain(run, s, f->at, Fault::feed,
             "F in the block that changes the unit: controls differ in the unit that "
             "they take it in; write F into a later block");
  }
}

/// F and S, but for those of a dwell.
void set_feed_and_speed(Run& run, Sorted& s) {
  Machine& m = run.machine;
  const bool of_dwell = s.orders.of(Group::once) == Action::dwell &&
                        run.habits.dialect == Dialect::sinumerik;
  const Word* f = s.orders.find('F');
  if (f != nullptr && !of_dwell) {
    if (f->value < 0) {
      complain(run, s, f->at, Fault::feed, "F below 0");
    } else {
      m.feed = f->value;
    }
  } else if (m.feed_mode == FeedMode::inverse_time) {
    m.feed.reset();
  }
  const Word* speed = s.orders.find('S');
  if (speed != nullptr && !of_dwell) {
    if (speed->value < 0) {
      complain(run, s, speed->at, Fault::feed, "S below 0");
    } else {
      m.speed = speed->value * unit::rpm;
    }
  }
}

/// The place of a tool among those of the program.
std::int16_t tool_index(Run& run, const std::string& name) {
  auto& tools = run.program.tools;
  auto it = std::ranges::find(tools, name);
  if (it == tools.end()) it = tools.insert(it, name);
  return static_cast<std::int16_t>(it - tools.begin());
}

void set_tool(Run& run, Sorted& s) {
  constexpr double most = 1e9;
  constexpr std::size_t most_tools = 10000;
  Machine& m = run.machine;
  if (const Word* t = s.orders.find('T')) {
    const bool number = t->has_value;
    const bool whole =
        t->value >= 0 && t->value <= most && t->value == std::floor(t->value);
    if ((number && !whole) || run.program.tools.size() > most_tools) {
      return complain(run, s, t->at, Fault::number, "T takes the number of a tool");
    }
    m.chosen = number ? fmt::format("{:.0f}", t->value) : std::string(t->inside);
    if (!run.changes_tool) {
      m.tool = tool_index(run, m.chosen);
      m.turning = false;
      remark(run.complaints, "tool_without_m6", place_at(s.block, t->at),
             "no M6 in the program: T is taken to change the tool where it stands");
    }
  }
  if (s.orders.tool_change) {
    m.tool = tool_index(run, m.chosen);
    m.turning = false;
  }
}

void set_spindle(Run& run, Sorted& s) {
  if (!s.orders.has(Group::spindle)) return;
  run.machine.turning = s.orders.of(Group::spindle) == Action::spindle_right;
}

/// The name of the work offset that a block asks for; nothing where it is told.
std::optional<std::string> asked_offset(Run& run, Sorted& s) {
  const Code& code = *s.orders.code[static_cast<std::size_t>(Group::offset)];
  const std::string name =
      code.action == Action::no_offset ? "G500"
      : code.tenths % 10 == 0
          ? fmt::format("G{}", code.tenths / 10)
          : fmt::format("G{}.{}", code.tenths / 10, code.tenths % 10);
  if (code.tenths >= 5050 && code.action == Action::offset) {
    return offset_name(s.block.text.substr(s.orders.place_of(Group::offset), 4));
  }
  if (code.action != Action::numbered_offset) return name;
  const Word* p = s.orders.take('P');
  if (p == nullptr) {
    complain(run, s, s.orders.place_of(Group::offset), Fault::order,
             fmt::format("{} without P", name));
    return std::nullopt;
  }
  return fmt::format("{}P{:g}", name, p->value);
}

void set_offset(Run& run, Sorted& s) {
  if (!s.orders.has(Group::offset)) return;
  const auto name = asked_offset(run, s);
  if (!name) return;
  const auto& known = run.options.offsets;
  std::string& first = run.machine.offset;
  const bool counts = *name != "G500";
  if (counts && first.empty()) first = *name;
  const bool second = counts && *name != first;
  for (const std::string& one : {*name, first}) {
    if (!second || known.count(one) > 0) continue;
    return complain(
        run, s, s.orders.place_of(Group::offset), Fault::coordinates,
        fmt::format("{} is a second work offset, and the place of {} is not "
                    "in offsets_mm of [program]",
                    *name, one));
  }
  std::array<double, 3> shift = run.options.origin;
  const auto it = known.find(*name);
  for (std::size_t i = 0; it != known.end() && i < shift.size(); ++i) {
    shift[i] += it->second[i];
  }
  run.machine.shift = shift;
  run.program.zeros.push_back({run.program.moves.size(), shift});
}

void set_planes(Run& run, Sorted& s) {
  Machine& m = run.machine;
  if (s.orders.has(Group::plane)) {
    const Action action = s.orders.of(Group::plane);
    m.plane = action == Action::plane_xy   ? Plane::xy
              : action == Action::plane_zx ? Plane::zx
                                           : Plane::yz;
  }
  if (s.orders.has(Group::distance)) {
    m.incremental = s.orders.of(Group::distance) == Action::incremental;
  }
  if (s.orders.has(Group::center)) {
    m.center_absolute = s.orders.of(Group::center) == Action::center_absolute;
  }
  if (s.orders.has(Group::retract)) {
    m.to_r_level = s.orders.of(Group::retract) == Action::r_level;
  }
}

}  // namespace

void complain(Run& run, Sorted& s, std::uint32_t at, Fault fault, std::string what) {
  run.machine.doubtful = true;
  complain(run.complaints, s.block, at, fault, std::move(what));
}

void pause(Run& run, Sorted& s) {
  if (s.orders.of(Group::once) != Action::dwell) return;
  const bool sinumerik = run.habits.dialect == Dialect::sinumerik;
  double time = -1.0;
  if (sinumerik) {
    const Word* f = s.orders.find('F');
    const Word* turns = s.orders.find('S');
    const double speed = run.machine.speed;
    if (f != nullptr) time = f->value;
    if (f == nullptr && turns != nullptr && speed > 0) {
      time = turns->value * unit::turn / speed;
    }
  } else {
    for (const char letter : {'P', 'U', 'X'}) {
      const Word* word = s.orders.find(letter);
      if (word == nullptr || time >= 0) continue;
      s.orders.take(letter);
      time = seconds_of(*word, run.habits.dialect);
    }
  }
  if (!(time >= 0)) {
    return complain(run, s, s.orders.place_of(Group::once), Fault::order,
                    "G4 without a time");
  }
  Move still = begun(run, s, MoveKind::dwell);
  still.time = time;
  run.program.moves.push_back(still);
}

namespace {

std::uint8_t writing_of(const Machine& m) noexcept {
  unsigned bits = 0;
  if (m.length_unit == unit::inch) bits |= in_inches;
  if (m.feed_unit == unit::inch) bits |= feed_in_inches;
  if (m.feed_mode == FeedMode::per_turn) bits |= feed_per_turn;
  if (m.feed_mode == FeedMode::inverse_time) bits |= inverse_time;
  if (m.incremental) bits |= by_increments;
  if (m.center_absolute) bits |= center_by_place;
  return static_cast<std::uint8_t>(bits);
}

}  // namespace

Move begun(const Run& run, const Sorted& s, MoveKind kind) {
  const Machine& m = run.machine;
  Move move;
  move.end = m.place;
  move.spindle = m.turning ? m.speed : 0.0;
  move.line = s.block.line;
  move.block = s.orders.number;
  move.tool = m.tool;
  move.kind = kind;
  move.writing = writing_of(m);
  return move;
}

double seconds_of(const Word& word, Dialect dialect) noexcept {
  constexpr double fewest_milliseconds = 100;
  constexpr double millisecond = 1e-3;
  const bool milliseconds = dialect == Dialect::iso && word.letter == 'P' &&
                            !word.point && word.value >= fewest_milliseconds;
  return milliseconds ? word.value * millisecond : word.value;
}

void set_modes(Run& run, Sorted& s) {
  set_feed_mode(run, s);
  set_unit(run, s);
  set_feed_and_speed(run, s);
  set_tool(run, s);
  set_spindle(run, s);
  set_planes(run, s);
  set_offset(run, s);
}

}  // namespace trochoid::program
