#include <trochoid/program/motion.h>

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace trochoid::program {

namespace {

bool pecks_in(Action kind) noexcept {
  return kind == Action::peck || kind == Action::chip_break;
}

/// I J K of Haas: the first peck, by how much each next one is smaller, the smallest.
/// False: told.
bool remember_pecks(Motion& o) {
  Machine& m = o.machine();
  const Word* first = o.s.orders.take('I');
  if (first == nullptr) return true;
  const Word* less = o.s.orders.take('J');
  const Word* least = o.s.orders.take('K');
  const auto value = [&](const Word* word) {
    return word != nullptr ? word->value * m.length_unit : 0.0;
  };
  m.cycle.peck = value(first);
  m.cycle.less = value(less);
  m.cycle.least = value(least);
  const bool shrinks = m.cycle.less > 0;
  if (!(m.cycle.peck > 0) || m.cycle.less < 0 || (shrinks && !(m.cycle.least > 0))) {
    o.complain(
        first->at, Fault::order,
        "I is the first peck and above 0, J by how much each next one is smaller, "
        "K the smallest");
    return false;
  }
  return true;
}

/// Numbers of the cycle in this block, which are kept. False: told.
bool remember_cycle(Motion& o) {
  Machine& m = o.machine();
  CycleMemory& kept = m.cycle;
  Orders& orders = o.s.orders;
  const bool pecks = pecks_in(m.motion);
  if (const Word* r = orders.take('R')) kept.r_level = r->value * m.length_unit;
  if (o.axes[2] != nullptr) kept.bottom = o.axes[2]->value * m.length_unit;
  if (orders.has(Group::motion)) kept.dwell = 0.0;
  if (m.motion != Action::drill) {
    if (const Word* p = orders.take('P')) {
      kept.dwell = seconds_of(*p, o.run.habits.dialect);
    }
  }
  if (pecks && o.run.habits.dialect == Dialect::iso && !remember_pecks(o)) return false;
  if (pecks) {
    if (const Word* q = orders.take('Q')) {
      kept.peck = q->value * m.length_unit;
      kept.less = 0.0;
      if (!(kept.peck > 0)) {
        o.complain(q->at, Fault::order, "Q is the depth of a peck and is above 0");
        return false;
      }
    }
  }
  return true;
}

/// A whole number of repetitions; nothing: told.
std::optional<int> repetitions(Motion& o) {
  constexpr double most = 100000;
  const Word* l = o.s.orders.take('L');
  if (l == nullptr) return 1;
  if (!(l->value >= 0 && l->value <= most) || l->value != std::floor(l->value)) {
    o.complain(l->at, Fault::number, "L is the number of holes");
    return std::nullopt;
  }
  return static_cast<int>(l->value);
}

/// What is missing for a cycle is told.
bool cycle_is_whole(Motion& o) {
  const Machine& m = o.machine();
  const CycleMemory& kept = m.cycle;
  if (m.plane != Plane::xy) {
    o.complain(o.first_axis(), Fault::plane,
               "a cycle in another plane than G17; it is read along Z only");
    return false;
  }
  const bool no_peck = pecks_in(m.motion) && !(kept.peck > 0);
  if (!kept.r_level || !kept.bottom || no_peck) {
    o.complain(o.first_axis(), Fault::order,
               fmt::format("a cycle without {}", !kept.r_level  ? "R"
                                                 : !kept.bottom ? "Z"
                                                                : "Q"));
    return false;
  }
  if (m.feed_mode == FeedMode::inverse_time) {
    o.complain(o.motion_word(), Fault::feed, "a cycle with G93; post it with G94");
    return false;
  }
  return true;
}

void emit_leg(Motion& o, const Leg& leg, double feed) {
  if (leg.kind == MoveKind::rapid) return rapid_to(o, leg.end, MoveNote::cycle);
  Move move = begun(o.run, o.s, leg.kind);
  move.end = leg.end;
  if (leg.kind == MoveKind::dwell) {
    move.time = leg.time;
  } else {
    const double length = std::abs(leg.end[2] - o.machine().place[2]);
    move.feed = feed;
    move.time = feed > 0 ? length / feed : 0.0;
    move.note = MoveNote::cycle;
  }
  o.run.program.moves.push_back(move);
  o.machine().place = leg.end;
}

/// Levels in the frame of the stock.
Hole hole_of(const Machine& m) noexcept {
  const CycleMemory& kept = m.cycle;
  Hole hole;
  hole.kind = m.motion;
  hole.r_level = *kept.r_level + (m.incremental ? kept.initial : m.shift[2]);
  hole.bottom = *kept.bottom + (m.incremental ? hole.r_level : m.shift[2]);
  hole.clear = m.to_r_level ? hole.r_level : std::max(kept.initial, hole.r_level);
  hole.peck = kept.peck;
  hole.less = kept.less;
  hole.least = kept.least;
  hole.dwell = m.motion == Action::drill ? 0.0 : kept.dwell;
  return hole;
}

}  // namespace

void drill_holes(Motion& o) {
  constexpr double most_pecks = 10000;
  Machine& m = o.machine();
  if (!remember_cycle(o)) return;
  const auto repeat = repetitions(o);
  if (!repeat || !o.has_axes()) return;
  if (!cycle_is_whole(o)) return;
  if (!known(m.cycle.initial)) m.cycle.initial = m.place[2];
  o.target[2] = m.place[2];
  // A rapid leads to the hole first: only its height has to be known.
  const bool leads_there = known(m.place[2]) && known(o.target);
  if (!leads_there && !knows_place(o)) return;
  const double feed = feed_of(o, 0.0);
  Hole hole = hole_of(m);
  if (!(hole.bottom < hole.r_level)) {
    return o.complain(o.first_axis(), Fault::order,
                      "a cycle whose bottom Z is not below its level R");
  }
  if (pecks_of(hole) > most_pecks) {
    return o.complain(o.first_axis(), Fault::order,
                      "a hole of more than 10000 pecks; is Q meant?");
  }
  for (int i = 0; i < *repeat; ++i) {
    for (std::size_t a = 0; a < 2; ++a) {
      const Word* word = o.axes[a];
      if (i > 0 && word != nullptr && is_incremental(m, *word)) {
        o.target[a] += word->value * m.length_unit;
      }
    }
    hole.at = {o.target[0], o.target[1]};
    o.run.legs.clear();
    drill(hole, m.place, o.run.legs);
    for (const Leg& leg : o.run.legs) emit_leg(o, leg, feed);
  }
}

}  // namespace trochoid::program
