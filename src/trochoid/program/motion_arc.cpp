#include <trochoid/program/arcs.h>
#include <trochoid/program/motion.h>

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace trochoid::program {

namespace {

/// First, second and normal axis of a plane.
std::array<std::size_t, 3> axes_of(Plane plane) noexcept {
  switch (plane) {
    case Plane::xy:
      return {0, 1, 2};
    case Plane::zx:
      return {2, 0, 1};
    case Plane::yz:
      return {1, 2, 0};
  }
  return {0, 1, 2};
}

/// Whole turns that an arc makes more: P - 1 in LinuxCNC, TURN= in Sinumerik. Nothing: told.
std::optional<int> further_turns(Motion& o) {
  constexpr double most = 100000;
  const bool linuxcnc = o.run.habits.dialect == Dialect::linuxcnc;
  const Word* word = linuxcnc ? o.s.orders.take('P') : o.s.orders.turns;
  if (word == nullptr) return 0;
  const double least = linuxcnc ? 1 : 0;
  if (!(word->value >= least && word->value <= most) ||
      word->value != std::floor(word->value)) {
    o.complain(word->at, Fault::arc, "the turns of an arc are a whole number");
    return std::nullopt;
  }
  return static_cast<int>(word->value - least);
}

/// The words that say where the center is.
struct CenterWords {
  std::array<const Word*, 2> offset{};  ///< in the first and second axis of the plane
  const Word* radius = nullptr;

  [[nodiscard]] bool by_center() const noexcept {
    return offset[0] != nullptr || offset[1] != nullptr;
  }
};

/// Nothing: told.
std::optional<CenterWords> center_words(Motion& o, std::array<std::size_t, 3> axes) {
  Orders& orders = o.s.orders;
  CenterWords words;
  words.offset = {orders.take(center_letters[axes[0]]),
                  orders.take(center_letters[axes[1]])};
  const Word* other = orders.take(center_letters[axes[2]]);
  if (other != nullptr && (other->value != 0 || o.machine().center_absolute)) {
    o.complain(other->at, Fault::plane,
               fmt::format("{} is no word of an arc in this plane (G17: I J, G18: I K, "
                           "G19: J K)",
                           center_letters[axes[2]]));
    return std::nullopt;
  }
  orders.arc_names_taken = true;
  words.radius =
      o.run.habits.dialect == Dialect::sinumerik ? orders.radius : orders.take('R');
  if (words.radius != nullptr && words.by_center()) {
    const auto at = std::max({words.radius->at,
                              words.offset[0] != nullptr ? words.offset[0]->at : 0U,
                              words.offset[1] != nullptr ? words.offset[1]->at : 0U});
    o.complain(at, Fault::arc, "center and radius in one block; one of them is needed");
    return std::nullopt;
  }
  if (words.radius == nullptr && !words.by_center()) {
    if (const Word* r = orders.find('R'); r != nullptr && !orders.is_taken('R')) {
      o.complain(r->at, Fault::unused, "R is no radius in Sinumerik; it is CR=");
      return std::nullopt;
    }
    o.complain(o.first_axis(), Fault::arc,
               "an arc without its center (I J K) or radius");
    return std::nullopt;
  }
  return words;
}

/// The center as written. Nothing: told.
std::optional<Point> center_of(Motion& o, const CenterWords& words,
                               std::array<std::size_t, 3> axes) {
  const Machine& m = o.machine();
  Point center{};
  for (std::size_t i = 0; i < 2; ++i) {
    const Word* word = words.offset[i];
    const double start = m.place[axes[i]];
    if (word == nullptr) {
      center[i] = start;
      if (m.center_absolute) {
        const Word* there = words.offset[1 - i];
        o.complain(there->at, Fault::arc,
                   "with G90.1 both words of the center are needed");
        return std::nullopt;
      }
      continue;
    }
    const bool absolute = word->sense == Sense::absolute ||
                          (word->sense == Sense::modal && m.center_absolute);
    center[i] = word->value * m.length_unit + (absolute ? m.shift[axes[i]] : start);
  }
  return center;
}

void tell_arc(Motion& o, const CenterWords& words, const Arc& arc) {
  const Word* first = words.radius != nullptr                     ? words.radius
                      : words.offset[0] == nullptr                ? words.offset[1]
                      : words.offset[1] == nullptr                ? words.offset[0]
                      : words.offset[0]->at < words.offset[1]->at ? words.offset[0]
                                                                  : words.offset[1];
  std::string what;
  switch (arc.fault) {
    case ArcFault::radii_differ:
      what =
          "the ends of the arc are not equally far from its center; they may differ "
          "by 0.01 mm or a thousandth. Is the center absolute (G90.1)?";
      break;
    case ArcFault::no_radius:
      what = "the center of the arc is its start";
      break;
    case ArcFault::radius_too_small:
      what = "the radius of the arc is less than half the distance of its ends";
      break;
    case ArcFault::no_chord:
      what = "a radius does not tell a whole circle; give its center";
      break;
    case ArcFault::none:
      break;
  }
  o.complain(first->at, Fault::arc, std::move(what));
}

/// One move in the plane of the table, chords in the others.
void emit_arc(Motion& o, const Arc& arc, std::array<std::size_t, 3> axes) {
  Machine& m = o.machine();
  const double along = o.target[axes[2]] - m.place[axes[2]];
  const double length = std::hypot(arc.radius * arc.turn, along);
  Move move = begun(o.run, o.s, MoveKind::arc);
  move.feed = feed_of(o, length);
  const double time = move.feed > 0 ? length / move.feed : 0.0;
  if (m.plane == Plane::xy) {
    move.end = o.target;
    move.center = arc.center;
    move.turn = arc.turn;
    move.time = time;
    o.run.program.moves.push_back(move);
    m.place = o.target;
    return;
  }
  constexpr double most_chords = 1e6;
  const double count = chords_of(arc.radius, arc.turn);
  if (count > most_chords) {
    return o.complain(o.motion_word(), Fault::arc,
                      "an arc of more than a million chords; is its radius meant?");
  }
  const double a0 =
      std::atan2(m.place[axes[1]] - arc.center[1], m.place[axes[0]] - arc.center[0]);
  const std::array<double, 3> start = m.place;
  move.kind = MoveKind::chord;
  move.time = time / count;
  for (int i = 1; i <= static_cast<int>(count); ++i) {
    const double u = i / count;
    const double a = a0 + u * arc.turn;
    move.end[axes[0]] = arc.center[0] + arc.radius * std::cos(a);
    move.end[axes[1]] = arc.center[1] + arc.radius * std::sin(a);
    move.end[axes[2]] = start[axes[2]] + u * along;
    if (i == static_cast<int>(count)) move.end = o.target;
    o.run.program.moves.push_back(move);
  }
  m.place = o.target;
}

}  // namespace

void move_on_arc(Motion& o) {
  Machine& m = o.machine();
  const auto axes = axes_of(m.plane);
  const auto words = center_words(o, axes);
  const auto turns = further_turns(o);
  if (!words || !turns || !knows_place(o)) {
    m.place = o.target;
    return;
  }
  const ArcEnds ends{.start = {m.place[axes[0]], m.place[axes[1]]},
                     .end = {o.target[axes[0]], o.target[axes[1]]},
                     .clockwise = m.motion == Action::clockwise,
                     .further_turns = *turns};
  Arc found;
  if (words->radius != nullptr) {
    found = arc_of_radius(ends, words->radius->value * m.length_unit);
  } else {
    const auto center = center_of(o, *words, axes);
    if (!center) return;
    found = arc_about(ends, *center);
  }
  if (found.straight) {
    remark(o.run.complaints, "tiny_arc",
           {o.s.block.line, column_of(o.s.block.text, o.motion_word())},
           "the ends of the arc are nearer than 1 um: a straight move");
    return move_on_line(o);
  }
  if (found.fault != ArcFault::none) {
    tell_arc(o, *words, found);
    m.place = o.target;
    return;
  }
  emit_arc(o, found, axes);
}

}  // namespace trochoid::program
