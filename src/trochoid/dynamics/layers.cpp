#include <trochoid/dynamics/layers.h>

#include <trochoid/base/units.h>
#include <trochoid/chip/intervals.h>
#include <trochoid/chip/teeth_at_height.h>
#include <trochoid/dynamics/nodes.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>
#include <variant>

namespace trochoid::dynamics {
namespace {

constexpr double same_delay_range = 1e-9;  // [rad]
/// Error of D-36, relative.
constexpr double delay_tolerance = 1e-7;

/// A layer turns no edge by more than this [rad]; so many layers a wave and a zone at least.
constexpr double layer_turn = 10 * unit::deg;
constexpr double layers_of_wave = 12;
constexpr double fewest_layers = 8;
/// Layers of even t grow upwards: at the top they are twice as thick as even ones.
constexpr double thickest_share = 1.5;
/// A layer is halved, at most so often, until an arc that bends within it leaves less than
/// this of the depth times radians.
constexpr int most_layer_halvings = 7;
constexpr double allowed_bend = 1e-6;
/// Into so many parts a turn is divided, to find arcs by the spindle angle.
constexpr std::size_t parts_of_turn = 256;
/// A zone is looked at from here: at its very end radii may be zero.
constexpr double least_t = 1e-4;
/// Behind the tool nothing cuts: there a turn of theta begins.
constexpr double turn_begins = -unit::turn / 4;
/// Of the rule of two points on [-1, 1], whose weights are 1.
const double gauss_point = std::sqrt(1.0 / 3.0);
/// An end of an arc that moves less over a layer is a jump [rad].
constexpr double is_jump = 1e-9;

/// An arc of one tooth on the face of a layer, in theta.
struct FaceArc {
  double from = 0.0;
  double to = 0.0;
  int bounds = 0;
  int mark = 0;
  bool own = true;
};

/// The cut at one height.
struct Face {
  double t = 0.0;
  double z = 0.0;
  std::vector<geometry::EdgeAt> edges;     ///< shape (teeth)
  std::vector<std::vector<FaceArc>> arcs;  ///< shape (teeth)
};

/// Degree at which the interpolation of c vibrations is good enough.
int delay_degree(double c) {
  int n = 0;
  for (double error = 1.0; error > delay_tolerance && n < largest_degree; ++n) {
    error *= 0.25 * unit::turn * c / (n + 1);  // J_n(x) = (x/2)^n / n! and less
  }
  return std::max(n, 1);
}

/// Heights in which the same teeth are there and no profile bends.
struct Stack {
  double from = 0.0;
  double to = 0.0;
  std::vector<char> there;
};

double kappa_of(const geometry::EdgeAt& edge) {
  return std::atan2(edge.sin_kappa, edge.cos_kappa);
}

/// From tooth k to the later tooth j, a whole turn from a tooth to itself (C-20).
double angle_between(const Face& face, std::size_t k, std::size_t j) {
  const double back = face.edges[j].omega - face.edges[k].omega;
  return j == k ? unit::turn : back - unit::turn * std::floor(back / unit::turn);
}

bool alike(const std::vector<FaceArc>& a, const std::vector<FaceArc>& b) {
  return std::ranges::equal(a, b, {}, &FaceArc::bounds, &FaceArc::bounds);
}

/// @brief By how much the ends of arcs bend over a layer, and kappa over its root [rad].
double bend_of(const Face& below, const Face& middle, const Face& above) {
  if (!std::ranges::equal(below.arcs, middle.arcs, alike)) {
    return unit::turn;
  }
  const double share = (middle.z - below.z) / (above.z - below.z);
  double worst = 0.0;
  for (std::size_t j = 0; j < below.arcs.size(); ++j) {
    if (below.arcs[j].empty()) continue;
    const auto bend = [&](double a, double b, double c, double part) {
      worst = std::max(worst, std::abs(b - a - part * (c - a)));
    };
    const geometry::EdgeAt& a = below.edges[j];
    const geometry::EdgeAt& b = middle.edges[j];
    const geometry::EdgeAt& c = above.edges[j];
    bend(a.omega, b.omega, c.omega, share);
    bend(kappa_of(a), kappa_of(b), kappa_of(c), 0.5);
    for (std::size_t i = 0; i < below.arcs[j].size(); ++i) {
      const auto [first, second, third] =
          std::tie(below.arcs[j][i], middle.arcs[j][i], above.arcs[j][i]);
      bend(first.from, second.from, third.from, share);
      bend(first.to, second.to, third.to, share);
    }
  }
  return worst;
}

class Builder {
 public:
  Builder(const force::Setup& setup, Layers& out)
      : setup_(setup),
        edges_(setup.cutter, force::runout_of(setup)),
        teeth_(edges_, chip::passage(setup.cutter, setup.cut, setup.chip)),
        alike_(force::teeth_alike(setup)),
        out_(out) {
    out_.period = alike_ ? unit::turn / setup.cutter.teeth() : unit::turn;
  }

  void build(double deepest) {
    std::vector<double> ends = edges_.breaks(deepest);
    if (const auto* arcs = std::get_if<geometry::Arcs>(&setup_.cut.engagement)) {
      for (const geometry::ArcLayer& layer : arcs->layers) {
        for (const double end : {layer.from, layer.to}) {
          if (end > ends.front() && end < ends.back()) ends.push_back(end);
        }
      }
      std::ranges::sort(ends);
      ends.erase(std::ranges::unique(ends).begin(), ends.end());
    }
    depth_ = ends.back() - ends.front();
    for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
      add_stack(ends[i], ends[i + 1]);
    }
  }

  /// Delays from each tooth to each other one, as far apart as they get [rad].
  [[nodiscard]] std::vector<std::array<double, 2>> delay_ranges() const {
    std::vector<std::array<double, 2>> ranges;
    for (const auto& [pair, range] : ranges_) ranges.push_back(range);
    return ranges;
  }

 private:
  void add_stack(double from, double to) {
    stack_ = {from, to, {}};
    double turned = 0.0;
    for (std::size_t j = 0; j < edges_.teeth(); ++j) {
      const bool there = edges_.edge_at(j, 0.5 * (from + to)).there;
      stack_.there.push_back(there ? 1 : 0);
      if (there) turned = std::max(turned, edges_.turn_between(j, from, to));
    }
    const double fewest = std::max(2.0, fewest_layers * (to - from) / depth_);
    double count = std::max(fewest, turned / layer_turn);
    if (edges_.wavelength() > 0) {
      count = std::max(count, layers_of_wave * (to - from) / edges_.wavelength());
    }
    const auto layers = static_cast<int>(std::ceil(thickest_share * count));
    const std::size_t begin = out_.all.size();
    Face below = face_at(least_t);
    for (int i = 1; i <= layers; ++i) {
      Face above = face_at(static_cast<double>(i) / layers);
      add_between(below, above, most_layer_halvings);
      below = std::move(above);
    }
    if (out_.all.size() > begin) out_.all[begin].first = true;
  }

  void stand_at(double t) {
    teeth_.stand_at(stack_.from, (stack_.to - stack_.from) * t * t, stack_.there);
  }
  [[nodiscard]] double height(double t) const {
    return stack_.from + (stack_.to - stack_.from) * t * t;
  }
  [[nodiscard]] std::span<const geometry::EngagedArc> stock_at(double z) const {
    const auto* arcs = std::get_if<geometry::Arcs>(&setup_.cut.engagement);
    return arcs == nullptr ? std::span<const geometry::EngagedArc>() : arcs->at(z);
  }

  Face face_at(double t) {
    stand_at(t);
    Face face{t, height(t), {}, {}};
    for (std::size_t j = 0; j < edges_.teeth(); ++j) {
      face.edges.push_back(teeth_.edge(j));
      std::vector<FaceArc>& arcs = face.arcs.emplace_back();
      if (!teeth_.there(j)) continue;
      if (alike_ && j > 0) {
        arcs = face.arcs.front();
        continue;
      }
      chip::Slice slice = teeth_.slice(j);
      slice.arcs = stock_at(face.z);
      for (const chip::ChipPiece& piece : chip::engaged_pieces(
               teeth_.passage(), slice, teeth_.place(j), turn_begins)) {
        const chip::Chip& chip = piece.state.chip;
        arcs.push_back({piece.from, piece.to, chip.bounds, chip::mark_of(chip),
                        chip::ends_at_edge(chip)});
      }
    }
    return face;
  }

  void add_between(const Face& below, const Face& above, int halvings) {
    const bool same = std::ranges::equal(below.arcs, above.arcs, alike);
    const Face middle = face_at(0.5 * (below.t + above.t));
    const double share = (above.z - below.z) / depth_;
    if (same && share * bend_of(below, middle, above) <= allowed_bend) {
      add_layer(below, above, below.arcs, above.arcs);
    } else if (halvings > 0) {
      add_between(below, middle, halvings - 1);
      add_between(middle, above, halvings - 1);
    } else {  // thin enough for each half to keep the arcs of its own end
      add_layer(below, middle, below.arcs, below.arcs);
      add_layer(middle, above, above.arcs, above.arcs);
    }
  }

  using ArcsOfTeeth = std::vector<std::vector<FaceArc>>;

  void add_layer(const Face& below, const Face& above, const ArcsOfTeeth& at_lower,
                 const ArcsOfTeeth& at_upper) {
    stand_at(0.5 * (below.t + above.t));
    Layers::Layer layer{.from = below.z,
                        .to = above.z,
                        .root = {below.t, above.t},
                        .passage = teeth_.passage(),
                        .teeth = {},
                        .stock = {}};
    const auto stock = stock_at(0.5 * (below.z + above.z));
    layer.stock.assign(stock.begin(), stock.end());
    for (std::size_t j = 0; j < edges_.teeth(); ++j) {
      if (!teeth_.there(j)) continue;
      layer.r = teeth_.edge(j).r;
      layer.teeth.push_back(teeth_.edge(j).position);
      for (std::size_t i = 0; i < at_lower[j].size(); ++i) {
        add_arc(j, {&below, &above}, {&at_lower[j][i], &at_upper[j][i]});
      }
    }
    out_.all.push_back(std::move(layer));
  }

  void add_arc(std::size_t j, const std::array<const Face*, 2>& faces,
               const std::array<const FaceArc*, 2>& on) {
    const std::array ends = {&faces[0]->edges[j], &faces[1]->edges[j]};
    const geometry::EdgeAt& middle = teeth_.edge(j);
    LayerArc arc{.layer = out_.all.size(),
                 .place = static_cast<std::size_t>(teeth_.place(j)),
                 .omega = {ends[0]->omega, ends[1]->omega},
                 .epsilon = middle.position.epsilon,
                 .R = {ends[0]->position.R, ends[1]->position.R},
                 .own = on[0]->own};
    for (std::size_t k = 0; k < 2; ++k) {
      arc.kappa[k] = kappa_of(*ends[k]);
      arc.sine = ends[k]->sin_kappa;
      arc.cosine = ends[k]->cos_kappa;
      arc.from[k] = on[k]->from + ends[k]->omega;
      arc.to[k] = on[k]->to + ends[k]->omega;
    }
    const double turns =
        unit::turn * std::floor(std::min(arc.from[0], arc.from[1]) / unit::turn);
    for (std::size_t k = 0; k < 2; ++k) {
      arc.from[k] -= turns;
      arc.to[k] -= turns;
      arc.omega[k] -= turns;
    }
    if (on[0]->mark > 0) add_delay(j, on[0]->mark, faces, arc);
    out_.arcs.push_back(std::move(arc));
  }

  void add_delay(std::size_t j, int mark, const std::array<const Face*, 2>& faces,
                 LayerArc& arc) {
    const chip::Passage& passage = teeth_.passage();
    const auto n = static_cast<std::size_t>(passage.teeth);
    const std::size_t other = (arc.place + n - static_cast<std::size_t>(mark) % n) % n;
    std::size_t k = 0;
    while (teeth_.place(k) != static_cast<int>(other)) ++k;
    for (std::size_t i = 0; i < 2; ++i) {
      // Where an older mark counts on equal teeth, by less than f^2/R, the marks touch.
      arc.delay[i] = alike_ ? out_.period : angle_between(*faces[i], k, j);
      const auto [at, is_new] =
          ranges_.try_emplace({j, k}, std::array{arc.delay[i], arc.delay[i]});
      at->second = {std::min(at->second[0], arc.delay[i]),
                    std::max(at->second[1], arc.delay[i])};
    }
  }

  const force::Setup& setup_;
  geometry::ToothEdges edges_;
  chip::TeethAtHeight teeth_;
  Stack stack_;
  double depth_ = 0.0;  ///< [m]
  bool alike_;          ///< all teeth do the same, a pitch apart
  std::map<std::pair<std::size_t, std::size_t>, std::array<double, 2>> ranges_;
  Layers& out_;
};

/// Part of the height of a layer.
struct Part {
  double from = 0.0;
  double to = 1.0;
};

/// @brief Keep that part in which above[0] + (above[1] - above[0]) t is positive.
/// @param side  of the jump, where both ends are the same
void keep_positive(const std::array<double, 2>& above, double side, Part& part) {
  const double slope = above[1] - above[0];
  if (std::abs(slope) < is_jump) {
    if (side < 0) part.to = part.from;
  } else if (slope > 0) {
    part.from = std::max(part.from, -above[0] / slope);
  } else {
    part.to = std::min(part.to, -above[0] / slope);
  }
}

/// A point of a layer, and the height that it stands for.
struct LayerPoint {
  double part = 0.0;    ///< of the height of the layer
  double root = 0.0;    ///< the same of the root of the height over that of its zone
  double weight = 0.0;  ///< of the height of the layer
};

/// Gauss' rule of two points over the root, over which edges are smooth.
std::array<LayerPoint, 2> points_between(const Layers::Layer& layer, double from,
                                         double to) {
  const auto [lower, upper] = layer.root;
  const double squares = upper * upper - lower * lower;
  const double a = std::sqrt(lower * lower + from * squares);
  const double b = std::sqrt(lower * lower + to * squares);
  const double half = 0.5 * (b - a);
  std::array<LayerPoint, 2> points;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double root = 0.5 * (a + b) + (i == 0 ? -half : half) * gauss_point;
    points[i] = {(root * root - lower * lower) / squares,
                 (root - lower) / (upper - lower), 2 * root * half / squares};
  }
  return points;
}

/// Which part of a turn an angle lies in.
std::size_t part_of_turn(double phi) noexcept {
  const double turns = phi / unit::turn;
  const auto part =
      static_cast<std::size_t>((turns - std::floor(turns)) * parts_of_turn);
  return std::min(part, parts_of_turn - 1);
}

std::vector<std::vector<std::uint32_t>> passed_by(const std::vector<LayerArc>& arcs) {
  std::vector<std::vector<std::uint32_t>> out(parts_of_turn);
  constexpr double part = unit::turn / parts_of_turn;
  for (std::size_t i = 0; i < arcs.size(); ++i) {
    const double first = std::min(arcs[i].from[0], arcs[i].from[1]) - is_jump;
    const double last = std::max(arcs[i].to[0], arcs[i].to[1]) + is_jump;
    const double parts = std::ceil((last - first) / part) + 1;
    const auto count = std::min(parts_of_turn, static_cast<std::size_t>(parts));
    for (std::size_t k = 0; k < count; ++k) {
      const std::size_t at = (part_of_turn(first) + k) % parts_of_turn;
      out[at].push_back(static_cast<std::uint32_t>(i));
    }
  }
  return out;
}

}  // namespace

DelayNodes::DelayNodes(std::vector<std::array<double, 2>> ranges, double cycle) {
  std::ranges::sort(ranges);
  for (const auto& [from, to] : ranges) {
    if (!ranges_.empty() && from <= ranges_.back().to + same_delay_range) {
      ranges_.back().to = std::max(ranges_.back().to, to);
    } else {
      ranges_.push_back({from, to});
    }
  }
  for (Range& range : ranges_) {
    range.first = delays_.size();
    const double length = range.to - range.from;
    if (length <= same_delay_range) {
      delays_.push_back(range.to);
      continue;
    }
    range.degree = delay_degree(length / cycle);
    for (const double t : element_nodes(range.degree).t) {
      delays_.push_back(range.from + 0.5 * length * (1 + t));
    }
  }
}

std::pair<std::size_t, std::size_t> DelayNodes::weights(
    double delay, std::span<double> weights) const noexcept {
  const auto after =
      std::ranges::upper_bound(ranges_, delay - same_delay_range, {}, &Range::to);
  const Range& range = after == ranges_.end() ? ranges_.back() : *after;
  if (range.degree == 0) {
    weights[0] = 1.0;
    return {range.first, 1};
  }
  const ElementNodes& nodes = element_nodes(range.degree);
  const double t = (2 * delay - range.from - range.to) / (range.to - range.from);
  lagrange_row(nodes, std::clamp(t, -1.0, 1.0), weights.first(nodes.t.size()));
  return {range.first, nodes.t.size()};
}

Layers layers_of(const force::Setup& setup, const force::Terms& law, double h_floor,
                 double deepest, double cycle) {
  Layers out{.law = law,
             .flank = force::damping_terms(setup.process_damping),
             .h_floor = h_floor,
             .least_R = setup.cut.f_z,
             .damps = setup.process_damping.acts(),
             .all = {},
             .arcs = {},
             .passed = {},
             .delays = {}};
  Builder builder(setup, out);
  builder.build(deepest);
  out.delays = DelayNodes(builder.delay_ranges(), cycle);
  out.passed = passed_by(out.arcs);
  return out;
}

Largest Layers::largest(double a_p) const {
  Largest out;
  const double theta = unit::turn / 8;
  out.cutting =
      a_p * largest_entry(directional_gradient(law, h_floor, theta, 1.0, 0.0));
  double widest = least_R;
  for (const LayerArc& arc : arcs) widest = std::max(widest, arc.R[1]);
  if (damps) {
    out.damping = a_p / widest *
                  largest_entry(directional_gradient(flank, h_floor, theta, 1.0, 0.0));
  }
  return out;
}

std::vector<double> Layers::breaks(double a_p) const {
  std::vector<double> out;
  for (const LayerArc& arc : arcs) {
    const Layer& layer = all[arc.layer];
    const bool ends = layer.from < a_p && layer.to >= a_p;
    for (const auto& [from, to] : {arc.from, arc.to}) {
      if (layer.first && layer.from < a_p) out.push_back(from);
      if (ends) {
        out.push_back(from +
                      (to - from) * (a_p - layer.from) / (layer.to - layer.from));
      }
    }
  }
  return out;
}

void Layers::add(double a_p, double phi, double middle,
                 std::vector<Matrix2>& out) const {
  for (const std::uint32_t i : passed[part_of_turn(phi)]) {
    const LayerArc& arc = arcs[i];
    const Layer& layer = all[arc.layer];
    if (layer.from >= a_p) break;
    const double top = std::min(1.0, (a_p - layer.from) / (layer.to - layer.from));
    const double first = std::min(arc.from[0], arc.from[1]);
    const double last = std::max(arc.to[0], arc.to[1]);
    const double turns = unit::turn * (1 + std::floor((middle - first) / unit::turn));
    for (double at = phi - turns; at <= last + is_jump; at += unit::turn) {
      const double side = at + middle - phi;
      Part part{0.0, top};
      keep_positive({at - arc.from[0], at - arc.from[1]}, side - arc.from[0], part);
      keep_positive({arc.to[0] - at, arc.to[1] - at}, arc.to[0] - side, part);
      if (part.to > part.from) {
        add_part(arc, part.from, part.to, at, out);
      }
    }
  }
}

void Layers::add_part(const LayerArc& arc, double from, double to, double phi,
                      std::vector<Matrix2>& out) const {
  const Layer& layer = all[arc.layer];
  std::array<double, largest_degree + 1> weights;
  for (const LayerPoint& at : points_between(layer, from, to)) {
    const double nominal = phi - std::lerp(arc.omega[0], arc.omega[1], at.part);
    const double theta = nominal + arc.epsilon;
    double h = 0.0;
    if (law.form.power) {
      chip::Slice slice{layer.r, layer.teeth};
      slice.arcs = layer.stock;
      const auto place = static_cast<int>(arc.place);
      h = std::max(h_floor, chip::chip_at(layer.passage, slice, place, nominal).h);
    }
    const bool upright = arc.kappa[0] == arc.kappa[1];
    const double kappa = std::lerp(arc.kappa[0], arc.kappa[1], at.root);
    const double sine = upright ? arc.sine : std::sin(kappa);
    const double cosine = upright ? arc.cosine : std::cos(kappa);
    const double length = at.weight * (layer.to - layer.from) / sine;
    const Matrix2 g = directional_gradient(law, h, theta, sine, cosine);
    const auto [first, count] =
        arc.delay[0] > 0
            ? delays.weights(std::lerp(arc.delay[0], arc.delay[1], at.part), weights)
            : std::pair<std::size_t, std::size_t>();  // D-36
    for (std::size_t q = 0; q < g.size(); ++q) {
      if (arc.own) out[0][q] += length * g[q];
      for (std::size_t k = 0; k < count; ++k) {
        out[1 + first + k][q] += weights[k] * length * g[q];  // D-37
      }
    }
    if (damps && arc.own) {
      const double R = std::max(least_R, std::lerp(arc.R[0], arc.R[1], at.root));
      const Matrix2 d = directional_gradient(flank, 0.0, theta, sine, cosine);
      for (std::size_t q = 0; q < d.size(); ++q) {
        out.back()[q] += length * d[q] / R;  // D-31
      }
    }
  }
}

}  // namespace trochoid::dynamics
