#include <trochoid/engagement/look.h>

#include <trochoid/base/units.h>
#include <trochoid/geometry/edge.h>
#include <trochoid/geometry/tooth_edges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>
#include <variant>

namespace trochoid::engagement {

namespace {

/// Stock so low on a cutter that is not flat is at its tip [m].
constexpr double near_tip = 1e-4;

geometry::Runout runout_of(const Tool& tool) {
  return chip::feels_runout(tool.chip.model) ? tool.runout : geometry::Runout{};
}

/// Radius of the longest tooth of a cylinder whose teeth reach equally deep.
double upright_radius(const Tool& tool) {
  const double r = tool.cutter.profile.D / 2;
  const std::vector<double> psi = geometry::tooth_angles(tool.cutter);
  std::vector<geometry::EdgePosition> teeth(psi.size());
  const geometry::Runout runout = runout_of(tool);
  double largest = 0.0;
  // With an eccentricity the longest tooth changes along a helix: the envelope stands.
  const int places = runout.eccentricity > 0 && tool.cutter.helix != 0 ? 64 : 1;
  for (int i = 0; i < places; ++i) {
    geometry::edge_positions(runout, psi, r, unit::turn * i / places, teeth);
    for (const geometry::EdgePosition& tooth : teeth) {
      largest = std::max(largest, tooth.R);
    }
  }
  return largest;
}

/// The wall that a tool leaves in stock of a height.
stock::Wall wall_of(const Tool& tool, double height) {
  if (!tool.cuts) return {};
  const geometry::Profile& p = tool.cutter.profile;
  const geometry::Runout runout = runout_of(tool);
  if (p.R == 0 && p.alpha == 0 && p.beta == 0 && geometry::level(runout)) {
    return stock::Wall::upright(upright_radius(tool));
  }
  const geometry::ToothEdges edges(tool.cutter, runout);
  const double corner = edges.meridian().N.z;
  const double turn = p.beta != 0 || runout.tilt != 0 ? height : 0.0;
  return {edges.breaks(std::max(corner, turn) + p.D / 2), [&](double z) {
            double largest = 0.0;
            for (std::size_t j = 0; j < edges.teeth(); ++j) {
              const geometry::EdgeAt at = edges.edge_at(j, z);
              if (at.there) largest = std::max(largest, at.position.R);
            }
            return largest;
          }};
}

/// Program::tools may be empty: then the one tool there is.
std::int16_t tool_of(const Job& job, std::int16_t tool) {
  if (tool >= 0) {
    if (static_cast<std::size_t>(tool) >= job.tools.size()) {
      throw std::invalid_argument("a move has a tool that is not given");
    }
    return tool;
  }
  return job.tools.empty() ? std::int16_t{-1} : std::int16_t{0};
}

/// The path and how fast it is gone.
stock::Swept sweep(const Job& job, std::vector<stock::Speed>& speeds) {
  const stock::Heights all = stock::heights(job.stock);
  std::vector<stock::Wall> walls;
  for (const Tool& tool : job.tools) {
    walls.push_back(wall_of(tool, all.top - all.bottom));
  }
  stock::Path path = stock::path(job.program.moves, job.options.rapid_feed);
  for (stock::Piece& piece : path.pieces) {
    piece.tool = tool_of(job, piece.tool);
  }
  const double rapid = job.options.rapid_feed;
  speeds = job.options.drives ? stock::speeds(path, rapid, *job.options.drives)
                              : stock::speeds(path, rapid);
  return {std::move(path), job.stock, std::move(walls)};
}

}  // namespace

double usual_cell(std::span<const Tool> tools) noexcept {
  constexpr double finest = 5e-5;
  constexpr double where_nothing_cuts = 1e-3;
  double cell = std::numeric_limits<double>::infinity();
  for (const Tool& tool : tools) {
    if (tool.cuts) cell = std::min(cell, tool.cutter.profile.D / 40);
  }
  return std::isfinite(cell) ? std::max(cell, finest) : where_nothing_cuts;
}

std::int64_t count_of(const stock::Piece& piece, double step_turns) noexcept {
  if (!(piece.feed > 0)) return 0;
  const double turns = piece.length / piece.feed_per_turn();
  return std::max<std::int64_t>(
      1, static_cast<std::int64_t>(std::ceil(turns / step_turns - 1e-9)));
}

std::uint32_t move_at(const stock::Path& path, const stock::Piece& piece,
                      double s) noexcept {
  const auto first = path.begins.begin() + piece.first;
  const auto last = path.begins.begin() + piece.last + 1;
  const auto after = std::upper_bound(first, last, s);
  return piece.first +
         static_cast<std::uint32_t>(std::max<std::ptrdiff_t>(after - first, 1) - 1);
}

Ask ask_of(const stock::Path& path, std::uint32_t index, std::int64_t k,
           std::int64_t n) {
  const stock::Piece& piece = path.pieces[index];
  const double u = (static_cast<double>(k) + 0.5) / static_cast<double>(n);
  return {index, u, 1.0 / static_cast<double>(n), k,
          move_at(path, piece, u * piece.length)};
}

Ask StepFinder::find(std::int64_t number) {
  for (; piece_ < path_.pieces.size(); ++piece_) {
    count_ = count_of(path_.pieces[piece_], step_turns_);
    if (number < first_ + count_) break;
    first_ += count_;
  }
  return ask_of(path_, piece_, number - first_, count_);
}

Look::Look(const Job& job)
    : job_(job),
      swept_(sweep(job, speeds_)),
      kinks_(kinks(swept_.path())),
      lengths_(feed_lengths(swept_.path())) {
  // Volumes beside a field of heights, and surfaces left by tools that are not flat, are
  // those of a map. In a crowd it finds the pieces that count.
  if (swept_.all_flat() && !swept_.crowded() &&
      !std::holds_alternative<stock::HeightField>(job.stock)) {
    return;
  }
  swept_.keep_map(job.options.cell > 0 ? job.options.cell : usual_cell(job.tools));
}

Found Look::at(const Ask& ask, std::span<const double> heights) const {
  const stock::Piece& piece = swept_.path().pieces[ask.piece];
  const program::Move& move = job_.program.moves[ask.move];
  const double turns = piece.turns_to - piece.turns_from;
  Found out{.step = bare_step(ask), .traits = {.piece = ask.piece}, .turn = {}};
  Step& step = out.step;
  StepTraits& traits = out.traits;
  traits.at = step.along;
  const stock::Wall& wall = swept_.wall(piece.tool);
  traits.R = wall.largest();
  step.line = move.line;
  step.block = move.block;
  if (!(traits.R > 0) || !(turns > 0)) {
    step.flags |= turns > 0 ? 0U : static_cast<std::uint32_t>(spindle_stands);
    return out;
  }
  const Tool& tool = job_.tools[static_cast<std::size_t>(piece.tool)];
  const double f = step.feed * unit::turn / piece.spindle;
  traits.f_h = f * piece.horizontal / piece.length;
  traits.f_a = f * (piece.from[2] - piece.to[2]) / piece.length;
  step.f_z = traits.f_h / tool.cutter.teeth();
  step.curvature = piece.arc() ? std::copysign(1 / piece.radius, piece.turn) : 0.0;
  Contact contact = engagement::contact(swept_, ask.piece, ask.u,
                                        {.wall = &wall,
                                         .feed = ask.share * piece.length,
                                         .turns = step.turns,
                                         .bottom = true,
                                         .layers = heights.empty(),
                                         .heights = {heights.begin(), heights.end()}});
  describe(contact, tool, out);
  out.turn = {piece.tool, step.f_z, wall.is_upright() ? 0.0 : traits.f_a,
              step.curvature, std::move(contact.layers)};
  if (!heights.empty()) {  // forces are those of all the heights between
    out.turn.layers =
        engagement::contact(swept_, ask.piece, ask.u, {.wall = &wall, .bottom = false})
            .layers;
  }
  return out;
}

void Look::put(Step& step, std::uint32_t index) const {
  const stock::Piece& piece = swept_.path().pieces[index];
  const double s = step.along - lengths_[index];
  const stock::PathPoint point = stock::point_at(piece, s / piece.length);
  step.time = piece.time_from + stock::time_to(speeds_[index], piece.length, s);
  step.place = point.place;
  step.direction = point.direction;
  if (std::isfinite(step.direction)) {
    step.direction -= unit::turn * std::floor(step.direction / unit::turn);
  }
}

Step Look::bare_step(const Ask& ask) const {
  const stock::Piece& piece = swept_.path().pieces[ask.piece];
  const stock::Speed& speed = speeds_[ask.piece];
  const auto time_to = [&](double u) {
    return stock::time_to(speed, piece.length, std::clamp(u, 0.0, 1.0) * piece.length);
  };
  Step step;
  step.step = ask.number;
  step.tool = piece.tool;
  step.move = ask.move;
  step.along = lengths_[ask.piece] + ask.u * piece.length;
  step.duration = time_to(ask.u + 0.5 * ask.share) - time_to(ask.u - 0.5 * ask.share);
  step.turns = step.duration * piece.spindle / unit::turn;
  step.spindle = piece.spindle;
  step.feed = stock::speed_at(speed, piece.length, ask.u * piece.length);
  step.programmed_feed = piece.feed;
  put(step, ask.piece);
  return step;
}

void Look::describe(const Contact& contact, const Tool& tool, Found& out) const {
  Step& step = out.step;
  StepTraits& traits = out.traits;
  double area = 0.0;
  bool thin = false;
  for (const geometry::ArcLayer& layer : contact.layers) {
    Layer& row = step.layers.emplace_back(Layer{layer.from, layer.to, {}});
    for (const geometry::EngagedArc& arc : layer.arcs) row.arcs.push_back(arc.arc);
    const double height = layer.to - layer.from;
    if (height < job_.options.floor || layer.arcs.empty()) {
      thin = true;
      continue;
    }
    const stock::Wall& wall = swept_.wall(step.tool);
    const ArcSum sum = sum_of(layer, wall.radius(0.5 * (layer.from + layer.to)));
    step.a_p += height;
    area += height * sum.width;
    if (sum.angle > step.engaged) {
      step.engaged = sum.angle;
      step.entry = layer.arcs.front().arc.from;
      step.exit = layer.arcs.back().arc.to;
    }
  }
  step.a_e = step.a_p > 0 ? area / step.a_p : 0.0;
  step.removed = contact.flank_volume + contact.bottom_volume;
  step.removal_rate = step.removed / step.duration;
  const bool flat = swept_.wall(step.tool).is_upright();
  const bool low =
      !flat && !contact.layers.empty() && contact.layers.front().from < near_tip;
  traits.bottom = traits.f_a > 0 && (contact.bottom_length > 0 || low);
  traits.stock = step.a_p > 0 || traits.bottom;
  if (thin && !traits.stock) step.flags |= thin_layer;
  if (tool.flute_length > 0 && step.a_p > tool.flute_length) {
    step.flags |= rubs_above_flute;
  }
  if (traits.bottom && flat && job_.options.bottom == Bottom::estimate) {
    // N-11
    const force::Terms law = force::terms(tool.law);
    const int teeth = tool.cutter.teeth();
    const force::ColumnWeights w =
        force::column_weights(law.form, traits.f_a / teeth, 1.0, 1.0);
    step.bottom_force =
        teeth * contact.bottom_length * (law.K[1] * w.cutting[1] + law.K_e[1] * w.edge);
    step.bottom_torque =
        teeth * contact.bottom_moment * (law.K[0] * w.cutting[0] + law.K_e[0] * w.edge);
  }
}

}  // namespace trochoid::engagement
