#include <trochoid/dynamics/make_grid.h>

#include <trochoid/base/units.h>
#include <trochoid/dynamics/edge_points.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace trochoid::dynamics {

namespace {

/// Just before and just after a node [rad].
constexpr double beside = 1e-9;

/// Steps that fill a length, halved again and again towards both ends: where the chip
/// begins, the force of a power law has an infinite slope.
std::vector<double> steps_of(double length, double longest) {
  constexpr int levels = 5;
  constexpr int each = 8;
  std::vector<double> sizes;  // relative to the longest
  double ends = 0.0;
  for (int level = levels; level > 0; --level) {
    for (int k = 0; k < each; ++k) {
      sizes.push_back(std::ldexp(1.0, -level));
      ends += 2 * sizes.back();
    }
  }
  const double inner = std::ceil(length / longest * (1 - 1e-9) - ends);
  if (inner < 1) {
    const auto count = std::ceil(length / longest * (1 - 1e-9));
    return std::vector<double>(static_cast<std::size_t>(std::max(1.0, count)),
                               length / std::max(1.0, count));
  }
  const double step = length / (inner + ends);
  std::vector<double> steps;
  steps.reserve(2 * sizes.size() + static_cast<std::size_t>(inner));
  for (const double size : sizes) {
    steps.push_back(size * step);
  }
  steps.insert(steps.end(), static_cast<std::size_t>(inner), step);
  for (auto size = sizes.rbegin(); size != sizes.rend(); ++size) {
    steps.push_back(*size * step);
  }
  return steps;
}

/// Nodes of one revolution: those of one pitch repeated where pitches are equal.
void add_nodes(const force::Setup& setup, const EdgePoints& points, int steps,
               EngagedGrid& grid) {
  const auto& pitch = setup.cutter.pitch;
  const bool equal = geometry::equally_pitched(pitch);
  const double period =
      equal ? unit::turn / static_cast<double>(pitch.size()) : unit::turn;
  const double smallest = *std::min_element(pitch.begin(), pitch.end());
  const double longest =
      std::min(unit::turn / static_cast<double>(pitch.size()) / steps, smallest / 4);
  std::vector<double> marks = {0.0, period};
  for (const double phi : points.events()) {
    marks.push_back(phi - period * std::floor(phi / period));
  }
  std::sort(marks.begin(), marks.end());
  std::vector<double> at;
  std::vector<double> step;
  double from = 0.0;
  for (const double mark : marks) {
    // Marks that rounding alone sets apart are one, and the last is the period itself.
    const double to = period - mark < 1e-8 ? period : mark;
    if (to - from < 1e-8) {
      continue;
    }
    double here = from;
    for (const double s : steps_of(to - from, longest)) {
      at.push_back(here);
      step.push_back(s);
      here += s;
    }
    from = to;
  }
  grid.pitch = equal ? at.size() : 0;
  for (std::size_t j = 0; j < (equal ? pitch.size() : 1); ++j) {
    for (std::size_t i = 0; i < at.size(); ++i) {
      grid.angle.push_back(static_cast<double>(j) * period + at[i]);
      grid.step.push_back(step[i]);
    }
  }
}

bool same_points(const EngagedGrid& grid, const Contacts& a, const Contacts& b) {
  if (a.last - a.first != b.last - b.first) {
    return false;
  }
  for (std::size_t k = 0; k < a.last - a.first; ++k) {
    const Stretch& p = grid.stretches[a.first + k];
    const Stretch& q = grid.stretches[b.first + k];
    if (p.tooth != q.tooth || p.count != q.count) {
      return false;
    }
  }
  return true;
}

/// Forget what was added after a state of the grid.
void shrink_to(EngagedGrid& grid, const Stretch& end, std::size_t stretches) {
  grid.stretches.resize(stretches);
  grid.sine.resize(end.first);
  grid.cosine.resize(end.first);
  grid.width.resize(end.first);
  grid.edge.resize(end.first);
  grid.above.resize(end.marks);
}

/// The delay by m teeth seen from an angle, `back` counted from `node`.
Delay delay_of(const EngagedGrid& nodes, double phi, double delay, std::size_t node) {
  const double turns = std::floor((phi - delay) / unit::turn);
  const double u = phi - delay - unit::turn * turns;
  const auto later = std::upper_bound(nodes.angle.begin(), nodes.angle.end(), u);
  const auto k = static_cast<std::size_t>(later - nodes.angle.begin()) - 1;
  const double step = nodes.step[k];
  const double t = std::min(1.0, (u - nodes.angle[k]) / step);
  const double s = 1 - t;
  const auto past = static_cast<std::size_t>(-turns) * nodes.angle.size();
  return {
      node + past - k,
      {s * s * (1 + 2 * t), t * t * (3 - 2 * t), step * t * s * s, -step * t * t * s}};
}

/// With equal pitches a delay leads to the same place between two nodes as no delay.
Delay whole_pitches(const EngagedGrid& nodes, double part, std::size_t node,
                    std::size_t pitches) {
  const double step = nodes.step[node - 1];
  const double t = part;
  const double s = 1 - t;
  return {
      1 + pitches * nodes.pitch,
      {s * s * (1 + 2 * t), t * t * (3 - 2 * t), step * t * s * s, -step * t * t * s}};
}

/// Delays of all angles, counted from the nodes given.
void add_delays(const force::Setup& setup, const EngagedGrid& nodes, EngagedGrid& grid,
                const std::vector<std::size_t>& node) {
  const chip::Passage passage = chip::passage(setup.cutter, setup.cut, setup.chip);
  for (std::size_t i = 0; i < grid.angle.size(); ++i) {
    for (std::size_t j = 0; j < grid.teeth; ++j) {
      for (std::size_t m = 0; m < grid.lookback; ++m) {
        const std::size_t turns = m / grid.teeth;
        const double delay = passage.back[j * grid.teeth + m % grid.teeth] +
                             unit::turn * static_cast<double>(turns);
        grid.delays.push_back(delay_of(nodes, grid.angle[i], delay, node[i]));
      }
    }
  }
}

EngagedGrid empty_grid(const force::Setup& setup, const GridOptions& options) {
  EngagedGrid grid;
  grid.teeth = static_cast<std::size_t>(setup.cutter.teeth());
  grid.lookback = options.lookback > 0 ? static_cast<std::size_t>(options.lookback)
                                       : 2 * grid.teeth;
  return grid;
}

}  // namespace

EngagedGrid engaged_grid(const force::Setup& setup, const GridOptions& options,
                         int steps_per_tooth) {
  const geometry::Profile& p = setup.cutter.profile;
  if (p.R != 0 || p.alpha != 0 || p.beta != 0) {
    throw std::invalid_argument("the cutter is no cylinder");
  }
  if (steps_per_tooth < 1) {
    throw std::invalid_argument("a tooth period without steps");
  }
  EngagedGrid grid = empty_grid(setup, options);
  const EdgePoints points(setup, options.points, grid.lookback);
  grid.one_point = !points.helix();
  add_nodes(setup, points, steps_per_tooth, grid);
  for (const double phi : grid.angle) {
    const Contacts before = points.add(phi, -beside, grid);
    const Stretch end{0, grid.sine.size(), 0, grid.above.size()};
    const Contacts after = points.helix() || !points.at_event(phi)
                               ? before
                               : points.add(phi, +beside, grid);
    const bool jump = !same_points(grid, before, after);
    if (!jump) {
      shrink_to(grid, end, before.last);
    }
    grid.before.push_back(before);
    grid.after.push_back(jump ? after : before);
    grid.jump.push_back(jump ? 1 : 0);
  }
  if (grid.pitch == 0) {
    std::vector<std::size_t> node(grid.angle.size());
    for (std::size_t i = 0; i < node.size(); ++i) {
      node[i] = i;
    }
    const EngagedGrid nodes{.angle = grid.angle, .step = grid.step};
    add_delays(setup, nodes, grid, node);
  }
  return grid;
}

BetweenNodes between_nodes(const force::Setup& setup, const GridOptions& options,
                           const EngagedGrid& nodes, std::vector<double> angles) {
  BetweenNodes result{empty_grid(setup, options), {}, {}};
  EngagedGrid& grid = result.grid;
  const EdgePoints points(setup, options.points, grid.lookback);
  grid.one_point = !points.helix();
  for (const double phi : angles) {
    const auto later =
        std::upper_bound(nodes.angle.begin(), nodes.angle.end(), phi + beside);
    const auto node = static_cast<std::size_t>(later - nodes.angle.begin());
    const double part = (phi - nodes.angle[node - 1]) / nodes.step[node - 1];
    result.node.push_back(node);
    result.part.push_back(std::clamp(part, 0.0, 1.0));
    const Contacts contacts = points.add(phi, +beside, grid);
    grid.before.push_back(contacts);
    grid.after.push_back(contacts);
    grid.jump.push_back(0);
  }
  grid.angle = std::move(angles);
  if (nodes.pitch == 0) {
    add_delays(setup, nodes, grid, result.node);
    return result;
  }
  for (std::size_t i = 0; i < grid.angle.size(); ++i) {
    for (std::size_t j = 0; j < grid.teeth; ++j) {
      for (std::size_t m = 1; m <= grid.lookback; ++m) {
        grid.delays.push_back(whole_pitches(nodes, result.part[i], result.node[i], m));
      }
    }
  }
  return result;
}

}  // namespace trochoid::dynamics
