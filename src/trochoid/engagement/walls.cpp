#include <trochoid/engagement/walls.h>

#include <trochoid/base/units.h>
#include <trochoid/engagement/look.h>
#include <trochoid/engagement/turn.h>
#include <trochoid/force/arc_turn.h>
#include <trochoid/numerics/parallel.h>
#include <trochoid/numerics/periodic_pieces.h>
#include <trochoid/stock/swept.h>
#include <trochoid/surface/envelope.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <unordered_map>

namespace trochoid::engagement {

namespace {

using std::numbers::pi;

/// So far outside the wall stock is looked for at the end [m].
constexpr double outside = 2e-6;
/// An arc so near to the side begins there [rad].
constexpr double at_side = 1e-6;
/// Heights of a wall, and places along the feed of a turn.
constexpr int wall_heights = 5;
constexpr int wall_places = 24;
/// Of the deflection, as a part of the largest.
constexpr double bend_tolerance = 2e-3;
constexpr double longest_bend_panel = 0.4;    ///< [rad]
constexpr double shortest_bend_panel = 0.01;  ///< [rad]
/// Turns that are looked at together.
constexpr std::size_t together = 256;

/// Compliance at a height for loads over the height: c_0 + c_1 zeta + k <zeta - z>^3.
struct HeightCompliance {
  double z;
  double c0, c1, k;
};

HeightCompliance compliance_at(const structure::Cantilever& body, double z) {
  const double far = body.flute_length > 0 ? body.flute_length : body.overhang;
  const double c0 = structure::compliance(body, 0.0, 0.0);
  const double c1 = structure::couple_compliance(body, 0.0, 0.0);
  const double k =
      (structure::compliance(body, 0.0, far) - c0 - c1 * far) / (far * far * far);
  return {z, structure::compliance(body, z, 0.0),
          structure::couple_compliance(body, z, 0.0), k};
}

/// u of N-22.
double bend(const HeightCompliance& at, const force::ToothLoads& all,
            const force::ToothLoads& above) noexcept {
  const double z = at.z;
  const auto& m = above.moment_y;
  return at.c0 * all.y + at.c1 * all.moment_y[0] +
         at.k * (m[2] - 3 * z * m[1] + 3 * z * z * m[0] - z * z * z * above.y);
}

/// u_y at each of the heights over the spindle angle.
numerics::PeriodicPieces bends(const force::ArcTurn& teeth,
                               std::span<const HeightCompliance> heights) {
  const auto f = [&](double phi, std::span<double> out) {
    force::ToothLoads all;
    for (std::size_t j = 0; j < teeth.teeth(); ++j) all += teeth.at(j, phi);
    for (std::size_t i = 0; i < heights.size(); ++i) {
      force::ToothLoads above;
      for (std::size_t j = 0; j < teeth.teeth(); ++j) {
        above += teeth.at(j, phi, heights[i].z);
      }
      out[i] = bend(heights[i], all, above);
    }
  };
  constexpr int samples = 60;
  double largest = 0.0;
  std::vector<double> values(heights.size());
  for (int i = 0; i < samples; ++i) {
    f(unit::turn * (i + 0.3) / samples, values);
    for (const double u : values) largest = std::max(largest, std::abs(u));
  }
  const double allowed =
      largest > 0 ? bend_tolerance * largest : std::numeric_limits<double>::infinity();
  return {f,
          {.start = 0.0,
           .period = unit::turn,
           .breaks = teeth.events(),
           .longest = longest_bend_panel,
           .shortest = shortest_bend_panel,
           .allowed = std::vector<double>(heights.size(), allowed)}};
}

/// Error on a wall left or right of the feed, at heights above the tip.
WallError wall_error(const Turn& turn, const Tool& tool, bool left,
                     std::span<const double> heights) {
  const force::Setup setup = setup_of(turn, tool);
  const double more = past_own_wall(turn.f_z, turn.curvature, tool.cutter);
  const force::ArcTurn teeth(setup, tool.law,
                             {.within = {-more, pi + more}, .heights = true});
  std::vector<HeightCompliance> places;
  for (const double z : heights) places.push_back(compliance_at(*tool.body, z));
  const numerics::PeriodicPieces u = bends(teeth, places);
  const surface::Side side = left ? surface::Side{-1.0, 0.0} : surface::Side{1.0, pi};
  const double feed = turn.f_z * tool.cutter.teeth();
  WallError out{.least = std::numeric_limits<double>::infinity(),
                .most = -std::numeric_limits<double>::infinity()};
  double sum = 0.0;
  for (std::size_t i = 0; i < heights.size(); ++i) {
    std::vector<double> one(heights.size());
    one[i] = side.sigma;
    const surface::HeightCut cut{.side = side,
                                 .R = tool.cutter.profile.D / 2,
                                 .feed = feed,
                                 .teeth = surface::edge_places(setup, heights[i]),
                                 .deflection = u.combined(one)};
    for (int k = 0; k < wall_places; ++k) {
      const double error = surface::envelope_error(cut, feed * k / wall_places).error;
      out.least = std::min(out.least, error);
      out.most = std::max(out.most, error);
      sum += error;
    }
  }
  out.mean = sum / (static_cast<double>(heights.size()) * wall_places);
  return out;
}

/// Heights of a turn at which a wall stays.
struct WallHeights {
  std::vector<double> left;   ///< ends of stretches, in pairs [m]
  std::vector<double> right;  ///< the same [m]
};

bool holds_angle(std::span<const geometry::EngagedArc> arcs, double theta) noexcept {
  return std::ranges::any_of(arcs, [&](const geometry::EngagedArc& a) {
    return (a.arc.from <= theta && theta <= a.arc.to) ||
           (a.arc.from <= theta + unit::turn && theta + unit::turn <= a.arc.to);
  });
}

/// The walls of N-21.
WallHeights walls_of(const Turn& turn, double R,
                     const stock::Surroundings& at_the_end) {
  WallHeights out;
  for (const geometry::ArcLayer& layer : turn.layers) {
    if (layer.arcs.empty()) continue;
    const bool left = layer.arcs.front().arc.from < at_side;
    const bool right = layer.arcs.back().arc.to > pi - at_side;
    if (!left && !right) continue;
    const auto arcs = at_the_end.arcs(0.5 * (layer.from + layer.to), R + outside);
    const auto add = [&](bool there, double theta, std::vector<double>& to) {
      if (!there || !holds_angle(arcs, theta)) return;
      if (!to.empty() && layer.from - to.back() < 1e-9) {
        to.back() = layer.to;
      } else {
        to.insert(to.end(), {layer.from, layer.to});
      }
    };
    add(left, 0.0, out.left);
    add(right, pi, out.right);
  }
  return out;
}

/// Heights within stretches, each with its ends.
std::vector<double> spread(std::span<const double> ends) {
  std::vector<double> out;
  const int each =
      std::max(2, 2 * wall_heights / std::max(1, static_cast<int>(ends.size())));
  for (std::size_t i = 0; i + 1 < ends.size(); i += 2) {
    for (int k = 0; k < each; ++k) {
      out.push_back(ends[i] + (ends[i + 1] - ends[i]) * k / (each - 1));
    }
  }
  return out;
}

/// A turn whose walls are looked for, and the steps that are like it.
struct WallTurn {
  Turn turn;
  WallHeights heights;
  StepWalls walls;
};

/// The search for walls along the rows of a program.
class WallSearch {
 public:
  WallSearch(const Job& job, std::span<const Step> steps)
      : job_(job),
        look_(job),
        finder_(look_.path(), job.options.step_turns),
        steps_(steps),
        of_step_(steps.size(), none) {}

  std::vector<StepWalls> run(const WallOptions& options) {
    std::size_t first = 0;
    for (std::size_t i = 0; i < steps_.size() && !options.stop.wanted(); ++i) {
      add(i);
      if (turns_.size() - first < together) continue;
      solve(first);
      first = turns_.size();
      if (options.progress) {
        options.progress(static_cast<double>(i) / static_cast<double>(steps_.size()));
      }
    }
    if (!options.stop.wanted()) solve(first);
    std::vector<StepWalls> out(steps_.size());
    for (std::size_t i = 0; i < steps_.size(); ++i) {
      if (of_step_[i] != none) out[i] = turns_[of_step_[i]].walls;
    }
    return out;
  }

 private:
  static constexpr std::size_t none = static_cast<std::size_t>(-1);

  void add(std::size_t i) {
    const Step& step = steps_[i];
    if (step.layers.empty() || !(step.a_p > 0)) return;
    const std::size_t t = step.tool < 0 ? 0 : static_cast<std::size_t>(step.tool);
    const Tool& tool = job_.tools[t];
    if (!tool.body || !is_plain(tool)) return;
    const Ask ask = finder_.find(step.step);
    Found found = look_.at(ask);
    if (found.turn.layers.empty() || !feeds(found.turn)) return;
    const double R = look_.swept().wall(static_cast<std::int16_t>(t)).largest();
    const stock::PathPoint at = stock::point_at(look_.path().pieces[ask.piece], ask.u);
    const stock::Surroundings around(
        look_.swept(),
        {.tip = at.place,
         .direction = at.direction,
         .turns = std::numeric_limits<double>::infinity(),
         .last = static_cast<std::uint32_t>(look_.path().pieces.size() - 1)},
        R + outside);
    WallHeights heights = walls_of(found.turn, R, around);
    if (heights.left.empty() && heights.right.empty()) return;
    TurnKey key = key_of(found.turn);
    for (const auto* ends : {&heights.left, &heights.right}) {
      key.push_back(static_cast<std::int64_t>(ends->size()));
      for (const double z : *ends) key.push_back(std::llround(z / 1e-7));
    }
    const auto [place, is_new] = known_.try_emplace(std::move(key), turns_.size());
    if (is_new) {
      turns_.push_back({std::move(found.turn), std::move(heights), {}});
    }
    of_step_[i] = place->second;
  }

  void solve(std::size_t first) {
    numerics::for_each_index(
        turns_.size() - first,
        [&](std::size_t k) {
          WallTurn& one = turns_[first + k];
          const Tool& tool = job_.tools[static_cast<std::size_t>(one.turn.tool)];
          numerics::on_one_thread([&] {
            const auto error =
                [&](bool left,
                    std::span<const double> ends) -> std::optional<WallError> {
              if (ends.empty()) return std::nullopt;
              return wall_error(one.turn, tool, left, spread(ends));
            };
            one.walls = {error(true, one.heights.left),
                         error(false, one.heights.right)};
          });
        },
        1);
  }

  const Job& job_;
  Look look_;
  StepFinder finder_;
  std::span<const Step> steps_;
  std::vector<std::size_t> of_step_;
  std::unordered_map<TurnKey, std::size_t, TurnKeyHash> known_;
  std::vector<WallTurn> turns_;
};

}  // namespace

std::vector<StepWalls> wall_errors(const Job& job, std::span<const Step> steps,
                                   const WallOptions& options) {
  return WallSearch(job, steps).run(options);
}

}  // namespace trochoid::engagement
