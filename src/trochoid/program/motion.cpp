#include <trochoid/program/motion.h>

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace trochoid::program {

bool is_incremental(const Machine& m, const Word& word) noexcept {
  return word.sense == Sense::incremental ||
         (word.sense == Sense::modal && m.incremental);
}

namespace {

/// Where the axis words lead. An increment from a place that is not known is told.
void aim(Motion& o) {
  Machine& m = o.machine();
  o.target = m.place;
  for (std::size_t i = 0; i < 3; ++i) {
    const Word* word = o.axes[i];
    if (word == nullptr) continue;
    const double value = word->value * m.length_unit;
    if (!is_incremental(m, *word)) {
      o.target[i] = value + m.shift[i];
    } else if (known(m.place[i])) {
      o.target[i] = m.place[i] + value;
    } else if (!m.doubtful) {
      o.complain(word->at, Fault::unknown_position,
                 fmt::format("an increment, and where {} is before is not known; give "
                             "a place in G90 first",
                             axis_letters[i]));
    }
  }
}

double rapid_time(const Run& run, const std::array<double, 3>& to) noexcept {
  double square = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double from = run.machine.place[i];
    if (!known(from) && !known(to[i])) continue;
    if (!known(from) || !known(to[i])) return 0.0;
    square += (to[i] - from) * (to[i] - from);
  }
  return std::sqrt(square) / run.options.rapid_feed;
}

}  // namespace

void rapid_to(Motion& o, const std::array<double, 3>& end, MoveNote note) {
  Move move = begun(o.run, o.s, MoveKind::rapid);
  move.time = rapid_time(o.run, end);
  move.end = end;
  move.note = note;
  o.run.program.moves.push_back(move);
  o.machine().place = end;
}

double feed_of(Motion& o, double length) {
  Machine& m = o.machine();
  const double F = m.feed.value_or(0.0);
  constexpr double minute = 60;
  if (F > 0) {
    switch (m.feed_mode) {
      case FeedMode::per_minute:
        return F * m.feed_unit / minute;
      case FeedMode::inverse_time:
        return F * length / minute;
      case FeedMode::per_turn:
        if (m.speed > 0) return F * m.feed_unit * m.speed / unit::turn;
    }
  }
  if (m.doubtful) return 0.0;
  const bool inverse = m.feed_mode == FeedMode::inverse_time;
  const Word* word = o.s.orders.find('F');
  if (word != nullptr && !(word->value > 0)) {
    o.complain(word->at, Fault::feed, "F is 0; a feed above 0 is needed");
  } else if (F > 0) {
    o.complain(o.motion_word(), Fault::feed,
               "a feed a turn (G95) and no speed of the spindle; give S before");
  } else {
    const bool here = inverse && o.s.orders.has(Group::feed_mode);
    o.complain(here ? o.s.orders.place_of(Group::feed_mode) : o.motion_word(),
               Fault::feed,
               inverse ? "no F in this block; with G93 each block that is fed needs one"
                       : "no feed is given; give F in this block or before, and again "
                         "after a change of unit or of G93 G94 G95");
  }
  return 0.0;
}

bool knows_place(Motion& o) {
  Machine& m = o.machine();
  if (known(m.place) && known(o.target)) return true;
  if (m.doubtful) return false;
  for (std::size_t i = 0; i < 3; ++i) {
    if (known(m.place[i])) continue;
    o.complain(o.axes[i] != nullptr ? o.axes[i]->at : o.first_axis(),
               Fault::unknown_position,
               fmt::format("a feed move, and where {} is before is not known; let a "
                           "rapid lead there first{}",
                           axis_letters[i],
                           m.left[i] ? "" : ", or give start_mm in [program]"));
    return false;
  }
  return false;
}

void move_on_line(Motion& o) {
  if (!knows_place(o)) {
    static_cast<void>(feed_of(o, 0.0));
    o.machine().place = o.target;
    return;
  }
  const auto& from = o.machine().place;
  const double length =
      std::hypot(o.target[0] - from[0], o.target[1] - from[1], o.target[2] - from[2]);
  Move move = begun(o.run, o.s, MoveKind::line);
  move.end = o.target;
  move.feed = feed_of(o, length);
  move.time = move.feed > 0 ? length / move.feed : 0.0;
  o.run.program.moves.push_back(move);
  o.machine().place = o.target;
}

namespace {

/// Axes go to a place that is not in the program: G53, G75, CYCLE800 that lifts.
void go_elsewhere(Motion& o, std::array<bool, 3> axes) {
  Machine& m = o.machine();
  std::array<double, 3> end = m.place;
  for (std::size_t i = 0; i < 3; ++i) {
    if (axes[i]) end[i] = unknown;
    m.left[i] = m.left[i] || axes[i];
  }
  rapid_to(o, end, MoveNote::retract);
}

/// G28, G30: by a place of the program to one that is not in it.
void go_home(Motion& o) {
  Machine& m = o.machine();
  const bool rotary = o.s.orders.find('A') != nullptr ||
                      o.s.orders.find('B') != nullptr ||
                      o.s.orders.find('C') != nullptr;
  const bool all = !o.has_axes() && !rotary;
  // An increment of 0 on an axis whose place is not known goes straight there.
  std::array<const Word*, 3> named = o.axes;
  for (std::size_t i = 0; i < 3; ++i) {
    const Word* word = o.axes[i];
    const bool still = word != nullptr && word->value == 0 &&
                       is_incremental(m, *word) && !known(m.place[i]);
    if (still) o.axes[i] = nullptr;
  }
  aim(o);
  const bool on_the_way = [&] {
    for (std::size_t i = 0; i < 3; ++i) {
      if (known(o.target[i]) && o.target[i] != m.place[i]) return true;
    }
    return false;
  }();
  if (on_the_way) rapid_to(o, o.target, MoveNote::retract);
  if (!o.has_axes() && !all &&
      std::ranges::none_of(named, [](const Word* w) { return w != nullptr; })) {
    return;
  }
  go_elsewhere(o, {all || named[0] != nullptr, all || named[1] != nullptr,
                   all || named[2] != nullptr});
}

/// G53, G153, SUPA: a place in the frame of the machine.
void go_to_machine_place(Motion& o) {
  if (!o.has_axes()) return;
  if (o.machine().motion != Action::rapid) {
    return o.complain(o.s.orders.place_of(Group::once), Fault::coordinates,
                      "a place of the machine is not in the program; it is read with "
                      "G0 only");
  }
  go_elsewhere(o, {o.axes[0] != nullptr, o.axes[1] != nullptr, o.axes[2] != nullptr});
}

bool is_cycle(Action action) noexcept {
  return action == Action::drill || action == Action::drill_dwell ||
         action == Action::peck || action == Action::chip_break;
}

void set_motion(Motion& o) {
  Machine& m = o.machine();
  if (!o.s.orders.has(Group::motion)) return;
  const Action asked = o.s.orders.of(Group::motion);
  const bool ended = !is_cycle(asked) || o.s.orders.cancels;
  if (ended) m.cycle = CycleMemory{};
  m.motion = asked;
}

bool has_center(const Orders& orders) noexcept {
  return orders.find('I') != nullptr || orders.find('J') != nullptr ||
         orders.find('K') != nullptr;
}

/// Whether a cycle is given numbers without a place.
bool feeds_cycle(const Orders& orders) noexcept {
  return orders.has(Group::motion) || orders.find('R') != nullptr ||
         orders.find('Q') != nullptr;
}

void modal_motion(Motion& o) {
  const Action action = o.machine().motion;
  const bool circular =
      action == Action::clockwise || action == Action::counter_clockwise;
  if (is_cycle(action)) {
    if (!o.has_axes() && !feeds_cycle(o.s.orders)) return;
  } else if (!o.has_axes() && !(circular && has_center(o.s.orders))) {
    return;
  }
  if (action == Action::cancel_motion) {
    return o.complain(o.first_axis(), Fault::order,
                      "where to, but not how; G0, G1, G2 or G3 is needed");
  }
  // In a cycle Z is a depth.
  const Word* depth = o.axes[2];
  if (is_cycle(action)) o.axes[2] = nullptr;
  aim(o);
  o.axes[2] = depth;
  if (action == Action::rapid) {
    rapid_to(o, o.target, MoveNote::none);
  } else if (action == Action::line) {
    move_on_line(o);
  } else if (circular) {
    move_on_arc(o);
  } else {
    drill_holes(o);
  }
}

/// The axis words that say where to. X of a dwell is a time, those of G50.1 name the
/// mirrors that end.
void take_axes(Motion& o) {
  Orders& orders = o.s.orders;
  for (std::size_t i = 0; i < 3; ++i) {
    const char letter = axis_letters[i];
    if (!orders.is_taken(letter)) {
      o.axes[i] = orders.take(letter);
      continue;
    }
    const Word* const word = orders.find(letter);
    const bool two_uses = orders.has(Group::scaling) && orders.has(Group::motion);
    if (word == nullptr || !two_uses) continue;
    return o.complain(
        word->at, Fault::order,
        "does it end a mirror (G50.1) or is it a place to go to? Write two "
        "blocks");
  }
}

}  // namespace

void move(Run& run, Sorted& s) {
  Motion o{run, s};
  take_axes(o);
  set_motion(o);
  switch (s.orders.of(Group::once)) {
    case Action::home:
      return go_home(o);
    case Action::machine_place:
      return go_to_machine_place(o);
    case Action::fixed_point:
      return go_elsewhere(
          o, {o.axes[0] != nullptr, o.axes[1] != nullptr, o.axes[2] != nullptr});
    case Action::lift:
      return go_elsewhere(o, {false, false, true});
    default:
      return modal_motion(o);
  }
}

}  // namespace trochoid::program
