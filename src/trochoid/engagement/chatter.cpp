#include <trochoid/engagement/chatter.h>

#include <trochoid/base/units.h>
#include <trochoid/dynamics/chatter.h>
#include <trochoid/dynamics/directional.h>
#include <trochoid/dynamics/multiplier.h>
#include <trochoid/dynamics/period_elements.h>
#include <trochoid/engagement/turn.h>
#include <trochoid/numerics/parallel.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <numeric>

namespace trochoid::engagement {
namespace {

/// Cuts are one within these.
constexpr double shared_arc = 1 * unit::deg;
constexpr double shared_direction = 5 * unit::deg;
constexpr double shared_height = 0.01;  // of the diameter
constexpr double shared_feed = 0.05;    // relative

/// Depths up to so many times that of the cut are looked at, and down to this part of it.
constexpr double deepest = 2.0;
constexpr double shallowest = 1e-3;
/// From one depth to the next in search of a change.
constexpr double search_step = 1.4143;
/// Of multipliers, of matrices, and of the limit depth, relative.
constexpr double multiplier_tolerance = 3e-3;
constexpr double matrices_tolerance = 1e-3;
constexpr double limit_tolerance = 1e-2;
constexpr int most_root_steps = 20;
/// Other speeds: so far apart, so many on each side, and stable by this much.
constexpr double speed_step = 0.02;
constexpr int other_speeds = 15;
constexpr double clearly_stable = 0.95;
/// Of which chatter frequencies only the strongest is wanted.
constexpr double strongest = 0.9;

/// More layers of stock than these become as many bands of one height.
constexpr std::size_t most_bands = 3;

/// Stock in a few bands: each with the arcs at its middle.
std::vector<Layer> in_bands(const std::vector<Layer>& layers) {
  if (layers.size() <= most_bands) return layers;
  const double bottom = layers.front().from;
  const double band = (layers.back().to - bottom) / static_cast<double>(most_bands);
  std::vector<Layer> out;
  for (std::size_t i = 0; i < most_bands; ++i) {
    Layer one{bottom + band * static_cast<double>(i),
              bottom + band * static_cast<double>(i + 1),
              {}};
    const double middle = 0.5 * (one.from + one.to);
    const auto at = std::ranges::find_if(
        layers, [&](const Layer& l) { return l.from <= middle && middle < l.to; });
    if (at != layers.end()) one.arcs = at->arcs;
    out.push_back(std::move(one));
  }
  return out;
}

/// Modes along the feed of a step and to its left.
dynamics::System seen_along(const dynamics::System& system, double direction) {
  dynamics::System out = system;
  const double c = std::cos(direction);
  const double s = std::sin(direction);
  for (dynamics::ChipMode& mode : out.modes) {
    const double x = mode.x;
    mode.x = c * x + s * mode.y;
    mode.y = c * mode.y - s * x;
  }
  return out;
}

/// The cut in the axes of its feed. Its upper arcs reach as high as one likes.
force::Setup setup_of(const SharedCut& cut, const Tool& tool) {
  geometry::Arcs arcs;
  const double more = past_own_wall(cut.f_z, 0.0, tool.cutter);
  for (const Layer& layer : cut.layers) {
    geometry::ArcLayer& out = arcs.layers.emplace_back();
    out.from = layer.from;
    out.to = layer.to;
    for (const chip::Arc& arc : layer.arcs) {
      out.arcs.push_back({past_own_walls({arc.from, arc.to}, more), {}, {}});
    }
  }
  arcs.layers.back().to = std::numeric_limits<double>::infinity();
  return {.cutter = tool.cutter,
          .runout = tool.runout,
          .cut = {std::move(arcs), cut.a_p, cut.f_z, cut.spindle},
          .chip = tool.chip,
          .edge_length = tool.edge_length,
          .process_damping = {}};
}

/// One cut ready to be asked.
class Asked {
 public:
  Asked(const SharedCut& cut, const Tool& tool, const Vibration& vibration)
      : cut_(cut),
        height_(cut.a_p - cut.layers.front().from),
        system_(seen_along(vibration.system, cut.direction)),
        model_(setup_of(cut, tool), tool.law, vibration.chip_floor, matrices_tolerance,
               {cut.layers.front().from + deepest * height_,
                cut.spindle / dynamics::fastest_frequency(vibration.system)}) {}

  [[nodiscard]] ChatterLimit limit() const {
    ChatterLimit out{.known = true, .margin = deepest};
    const double here = growth(height_);
    const auto found = here < 0 ? from_below(here) : from_above(here);
    if (found) {
      out.depth = *found;
      out.margin = *found / height_;
      const dynamics::Directional at = at_height(*found);
      const double factor =
          dynamics::multiplier(at, system_, cut_.spindle, multiplier_tolerance).factor;
      const auto lines =
          dynamics::chatter_lines(at, system_, cut_.spindle, factor, strongest);
      if (!lines.empty()) out.frequency = lines.front().frequency;
    }
    if (here >= 0) out.better_spindle = better();
    return out;
  }

 private:
  struct Tried {
    double depth = 0.0;   ///< of the stock
    double growth = 0.0;  ///< ln |mu|
  };

  /// With stock of a height, which may begin above the tip.
  [[nodiscard]] dynamics::Directional at_height(double height) const {
    return model_.at_depth(cut_.layers.front().from + height);
  }
  [[nodiscard]] double growth(double depth) const {
    return growth_of(at_height(depth), cut_.spindle);
  }
  [[nodiscard]] double growth_of(const dynamics::Directional& at,
                                 double spindle) const {
    const auto mu = dynamics::multiplier(at, system_, spindle, multiplier_tolerance);
    return std::log(std::abs(mu.value));
  }

  /// The next depth at which a stable cut becomes unstable.
  [[nodiscard]] std::optional<double> from_below(double here) const {
    Tried stable{height_, here};
    while (stable.depth < deepest * height_) {
      const double next = std::min(search_step * stable.depth, deepest * height_);
      const Tried tried{next, growth(next)};
      if (tried.growth >= 0) return root(stable, tried);
      stable = tried;
    }
    return std::nullopt;
  }

  /// The next depth at which an unstable cut becomes stable.
  [[nodiscard]] std::optional<double> from_above(double here) const {
    Tried unstable{height_, here};
    while (unstable.depth > shallowest * height_) {
      const double next = unstable.depth / search_step;
      const Tried tried{next, growth(next)};
      if (tried.growth < 0) return root(tried, unstable);
      unstable = tried;
    }
    return unstable.depth;
  }

  /// False position, halved where one end stays (Illinois).
  [[nodiscard]] double root(Tried stable, Tried unstable) const {
    for (int i = 0; i < most_root_steps; ++i) {
      const double width = unstable.depth - stable.depth;
      if (width <= limit_tolerance * unstable.depth) break;
      const double t = stable.growth / (stable.growth - unstable.growth);
      const double depth = stable.depth + std::clamp(t, 0.02, 0.98) * width;
      const double found = growth(depth);
      if (std::abs(found) < multiplier_tolerance) return depth;
      if (found < 0) {
        stable = {depth, found};
        unstable.growth *= 0.5;
      } else {
        unstable = {depth, found};
        stable.growth *= 0.5;
      }
    }
    return stable.depth;
  }

  /// The nearest speed at which the cut is stable, with the same feed of a tooth.
  [[nodiscard]] std::optional<double> better() const {
    const dynamics::Directional at = at_height(height_);
    const double allowed = std::log(clearly_stable);
    for (int i = 1; i <= other_speeds; ++i) {
      for (const double side : {1.0, -1.0}) {
        const double spindle = cut_.spindle * (1 + side * i * speed_step);
        if (growth_of(at, spindle) < allowed) return spindle;
      }
    }
    return std::nullopt;
  }

  const SharedCut& cut_;
  double height_;  ///< of the stock [m]
  dynamics::System system_;
  dynamics::DirectionalModel model_;
};

/// Whether modes answer to all directions alike: a direction then needs no name.
bool answers_alike(const dynamics::System& system) {
  std::array<double, 3> sum{};  // of x x, x y, y y over the stiffness
  for (const dynamics::ChipMode& mode : system.modes) {
    sum[0] += mode.x * mode.x / mode.stiffness;
    sum[1] += mode.x * mode.y / mode.stiffness;
    sum[2] += mode.y * mode.y / mode.stiffness;
  }
  if (std::abs(sum[1]) > 1e-9 * sum[0] || std::abs(sum[0] - sum[2]) > 1e-9 * sum[0]) {
    return false;
  }
  return std::ranges::all_of(system.modes, [&](const dynamics::ChipMode& mode) {
    return mode.mass == system.modes.front().mass &&
           mode.stiffness == system.modes.front().stiffness &&
           mode.damping == system.modes.front().damping;
  });
}

/// Whether two cuts of a kind are the same but for rounding.
bool is_same(const SharedCut& a, const SharedCut& b) {
  constexpr double same_angle = 1e-4;
  constexpr double same_part = 1e-3;
  const auto near = [](double p, double q, double off) {
    return std::abs(p - q) < off;
  };
  if (!near(a.f_z, b.f_z, same_part * a.f_z) ||
      !near(a.direction, b.direction, same_part)) {
    return false;
  }
  return std::ranges::equal(a.layers, b.layers, [&](const Layer& p, const Layer& q) {
    return near(p.from, q.from, same_part * a.a_p) &&
           near(p.to, q.to, same_part * a.a_p) &&
           std::ranges::equal(p.arcs, q.arcs, [&](const auto& m, const auto& n) {
             return near(m.from, n.from, same_angle) && near(m.to, n.to, same_angle);
           });
  });
}

}  // namespace

SharedCuts::SharedCuts(std::span<const Tool> tools,
                       std::span<const Vibration> vibrations)
    : tools_(tools), vibrations_(vibrations) {}

void SharedCuts::add(std::span<const Step> steps, std::vector<std::int32_t>& which) {
  for (const Step& step : steps) {
    const auto tool = static_cast<std::size_t>(std::max<std::int16_t>(step.tool, 0));
    const bool cuts = step.tool >= 0 && !step.layers.empty() && step.f_z > 0 &&
                      step.spindle > 0 && !vibrations_[tool].system.modes.empty();
    if (!cuts) {
      which.push_back(-1);
      continue;
    }
    const bool alike = answers_alike(vibrations_[tool].system);
    const double D = tools_[tool].cutter.profile.D;
    std::vector<std::int64_t> key = {
        step.tool, std::llround(step.spindle / (0.1 * unit::rpm)),
        std::llround(std::log(step.f_z) / shared_feed),
        alike ? 0 : std::llround(step.direction / shared_direction)};
    std::vector<Layer> bands = in_bands(step.layers);
    for (const Layer& layer : bands) {
      key.push_back(std::llround(layer.from / (shared_height * D)));
      key.push_back(std::llround(layer.to / (shared_height * D)));
      key.push_back(static_cast<std::int64_t>(layer.arcs.size()));
      for (const chip::Arc& arc : layer.arcs) {
        key.push_back(std::llround(arc.from / shared_arc));
        key.push_back(std::llround(arc.to / shared_arc));
      }
    }
    const auto [at, is_new] =
        known_.try_emplace(std::move(key), static_cast<std::int32_t>(cuts_.size()));
    SharedCut here{.tool = tool,
                   .spindle = step.spindle,
                   .f_z = step.f_z,
                   .a_p = step.layers.back().to,
                   .direction = alike ? 0.0 : step.direction,
                   .layers = std::move(bands),
                   .duration = step.duration,
                   .line = step.line};
    which.push_back(at->second);
    if (is_new) {
      cuts_.push_back(std::move(here));
      leads_.push_back(step.duration);
      continue;
    }
    SharedCut& cut = cuts_[static_cast<std::size_t>(at->second)];
    double& lead = leads_[static_cast<std::size_t>(at->second)];
    here.duration += cut.duration;
    here.line = cut.line;
    // The cut that most of the time has stands for all: not the first, at an entry.
    if (is_same(here, cut)) {
      lead += step.duration;
    } else if ((lead -= step.duration) < 0) {
      lead = step.duration;
      cut = here;
    }
    cut.duration = here.duration;
  }
}

std::vector<ChatterLimit> chatter_limits(std::span<const SharedCut> cuts,
                                         std::span<const Tool> tools,
                                         std::span<const Vibration> vibrations,
                                         const ChatterOptions& options) {
  std::vector<std::size_t> order(cuts.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(
      order, [&](auto a, auto b) { return cuts[a].duration > cuts[b].duration; });
  order.resize(std::min(options.most, order.size()));
  std::vector<ChatterLimit> out(cuts.size());
  std::mutex one_at_a_time;
  std::size_t done = 0;
  numerics::for_each_index(
      order.size(),
      [&](std::size_t i) {
        if (options.stop.wanted()) return;
        const SharedCut& cut = cuts[order[i]];
        out[order[i]] = Asked(cut, tools[cut.tool], vibrations[cut.tool]).limit();
        const std::lock_guard lock(one_at_a_time);
        ++done;
        if (options.progress) {
          options.progress(static_cast<double>(done) /
                           static_cast<double>(order.size()));
        }
      },
      1);
  return out;
}

}  // namespace trochoid::engagement
