#include <trochoid/engagement/contact.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace trochoid::engagement {

namespace {

using std::numbers::pi;

/// Sublayers where a straight ramp and a helix have passed.
constexpr std::array<int, 2> sublayers = {4, 24};
/// Layers of the curve of a cutter that is not flat, and of its flank at most.
constexpr int curved_layers = 12;
constexpr int flank_layers = 12;
/// Arcs that differ less are those of one layer [rad].
constexpr double same_arc = 1e-9;
/// The floor below a tip is looked at so much below it [m].
constexpr double just_below = 1e-9;

/// Gauss-Legendre nodes and weights on [0, 1].
struct Rule {
  std::array<double, 8> node;
  std::array<double, 8> weight;
};
constexpr Rule gauss = {
    {0.019855071751231884, 0.10166676129318664, 0.2372337950418355, 0.40828267875217511,
     0.59171732124782489, 0.7627662049581645, 0.89833323870681336, 0.98014492824876812},
    {0.050614268145188130, 0.11119051722668724, 0.15685332293894364,
     0.18134189168918099, 0.18134189168918099, 0.15685332293894364, 0.11119051722668724,
     0.050614268145188130}};

/// Whether a piece that moves on may have its own wall beside the front (rho < R, or more
/// than half a circle).
bool meets_itself(const stock::Piece& piece, double R) noexcept {
  return piece.arc() && (piece.radius < R || std::abs(piece.turn) > pi);
}

/// Arcs of the front: own walls are at 0 and pi.
std::vector<geometry::EngagedArc> in_front(std::vector<geometry::EngagedArc> arcs) {
  std::vector<geometry::EngagedArc> out;
  const auto add = [&](geometry::EngagedArc arc) {
    if (arc.arc.from < 0) {
      arc.arc.from = 0.0;
      arc.at_from = {};
    }
    if (arc.arc.to > pi) {
      arc.arc.to = pi;
      arc.at_to = {};
    }
    if (arc.arc.to > arc.arc.from) {
      out.push_back(arc);
    }
  };
  for (const geometry::EngagedArc& arc : arcs) {
    // An arc that begins behind may reach round to the front.
    geometry::EngagedArc image = arc;
    image.arc.from -= 2 * pi;
    image.arc.to -= 2 * pi;
    add(image);
    add(arc);
  }
  std::ranges::sort(out, {}, [](const auto& a) { return a.arc.from; });
  return out;
}

bool alike(const std::vector<geometry::EngagedArc>& a,
           const std::vector<geometry::EngagedArc>& b) noexcept {
  return std::ranges::equal(a, b, [](const auto& p, const auto& q) {
    return std::abs(p.arc.from - q.arc.from) < same_arc &&
           std::abs(p.arc.to - q.arc.to) < same_arc;
  });
}

void find_layers(const stock::Surroundings& around, const ContactQuery& query,
                 Contact& out) {
  const double R = query.wall->largest();
  if (!query.layers) {
    for (const double z : query.heights) {
      out.layers.push_back({z, z, in_front(around.arcs(z, R))});
    }
    return;
  }
  const std::vector<double> z = around.heights(sublayers);
  for (std::size_t i = 0; i + 1 < z.size(); ++i) {
    auto arcs = in_front(around.arcs(0.5 * (z[i] + z[i + 1]), R));
    if (arcs.empty()) continue;
    if (!out.layers.empty() && out.layers.back().to == z[i] &&
        alike(out.layers.back().arcs, arcs)) {
      out.layers.back().to = z[i + 1];
      continue;
    }
    out.layers.push_back({z[i], z[i + 1], std::move(arcs)});
  }
}

/// Layers of a cutter that is not flat: its curve in equal angles, as of a ball, and its
/// flank above.
std::vector<double> curved_heights(const stock::Wall& wall, double top, double flank) {
  const double base = wall.lowest();
  const double curve = wall.highest() - base;
  const double part = std::clamp((top - base) / curve, 0.0, 1.0);
  const double last = std::acos(1 - part);
  std::vector<double> out;
  for (int i = 0; i <= curved_layers; ++i) {
    out.push_back(base + curve * (1 - std::cos(last * i / curved_layers)));
  }
  out.back() = base + curve * part;
  if (top > wall.highest() && flank > 0) {
    const int n = std::clamp(
        static_cast<int>(std::ceil((top - wall.highest()) / flank)), 1, flank_layers);
    for (int i = 1; i <= n; ++i) {
      out.push_back(wall.highest() + (top - wall.highest()) * i / n);
    }
  }
  return out;
}

std::vector<geometry::ArcLayer> layers_between(const stock::Surroundings& around,
                                               const stock::Wall& wall,
                                               const std::vector<double>& z) {
  std::vector<geometry::ArcLayer> out;
  for (std::size_t i = 0; i + 1 < z.size(); ++i) {
    const double middle = 0.5 * (z[i] + z[i + 1]);
    const double r = wall.radius(middle);
    if (!(r > 0) || !(z[i + 1] > z[i])) continue;
    out.push_back({z[i], z[i + 1], around.arcs(middle, r)});
  }
  return out;
}

/// Where there is stock is looked for first, and then in what is left of the curve.
void find_curved_layers(const stock::Surroundings& around, double top,
                        const ContactQuery& query, Contact& out) {
  const stock::Wall& wall = *query.wall;
  if (!query.layers) {
    for (const double z : query.heights) {
      const double r = wall.radius(z);
      out.layers.push_back({z, z, {}});
      if (r > 0) out.layers.back().arcs = around.arcs(z, r);
    }
    return;
  }
  if (!(top > wall.lowest())) return;
  out.layers =
      layers_between(around, wall, curved_heights(wall, top, 0.25 * wall.largest()));
  const auto with_stock = [](const geometry::ArcLayer& l) { return !l.arcs.empty(); };
  const auto last =
      std::ranges::find_if(out.layers.rbegin(), out.layers.rend(), with_stock);
  const auto count = out.layers.rend() - last;
  if (count > 0 && count < curved_layers / 2) {
    out.layers = layers_between(around, wall, curved_heights(wall, last->to, 0.0));
  }
  std::erase_if(out.layers, [&](const auto& l) { return !with_stock(l); });
}

/// Integral of the positive part of a sin(theta) + b over an arc.
double positive_part(const geometry::Arc& arc, double a, double b) noexcept {
  if (!(a > 0) || b >= a) {
    return std::max(b, 0.0) * (arc.to - arc.from) +
           a * (std::cos(arc.from) - std::cos(arc.to));
  }
  if (b <= -a) return 0.0;
  const double zero = std::asin(-b / a);  // positive between it and pi less it
  double sum = 0.0;
  for (int turn = -1; turn <= 1; ++turn) {
    const double from = std::max(arc.from, zero + 2 * pi * turn);
    const double to = std::min(arc.to, pi - zero + 2 * pi * turn);
    if (to > from) sum += b * (to - from) + a * (std::cos(from) - std::cos(to));
  }
  return sum;
}

/// What a slice of a cutter that is not flat takes as it moves on and down [m^3].
double volume_of(const geometry::ArcLayer& layer, const stock::Wall& wall,
                 double forward, double fall) noexcept {
  const stock::Wall::At at = wall.at(0.5 * (layer.from + layer.to));
  double sum = 0.0;
  for (const geometry::EngagedArc& arc : layer.arcs) {
    sum += positive_part(arc.arc, forward, fall * at.slope);
  }
  return (layer.to - layer.from) * at.radius * sum;
}

double angle_of(const std::vector<geometry::EngagedArc>& arcs) noexcept {
  double sum = 0.0;
  for (const geometry::EngagedArc& arc : arcs) {
    sum += arc.arc.to - arc.arc.from;
  }
  return sum;
}

/// Integrals over the disc of the cutter of the stock at a height.
struct Floor {
  double length = 0.0;  ///< int m drho, m the angle of stock at rho [m]
  double area = 0.0;    ///< int m rho drho [m^2]
};

Floor floor_at(const stock::Surroundings& around, double height, double R) {
  constexpr int parts = 4;
  Floor out;
  for (int i = 0; i < parts; ++i) {
    for (std::size_t k = 0; k < gauss.node.size(); ++k) {
      const double rho = R * (i + gauss.node[k]) / parts;
      const double m = angle_of(around.arcs(height, rho));
      const double weight = R / parts * gauss.weight[k];
      out.length += weight * m;
      out.area += weight * m * rho;
    }
  }
  return out;
}

/// What the bottom of a falling tool takes between two heights about the tip.
void find_bottom(const stock::Surroundings& around, double half_fall,
                 const ContactQuery& query, const std::vector<double>& changes,
                 Contact& out) {
  const Floor below = floor_at(around, -just_below, query.wall->largest());
  out.bottom_length = below.length / (2 * pi);
  out.bottom_moment = below.area / (2 * pi);
  std::vector<double> ends{-half_fall};
  for (const double z : changes) {
    if (z > -half_fall && z < half_fall) ends.push_back(z);
  }
  ends.push_back(half_fall);
  if (ends.size() == 2) {
    out.bottom_volume = below.area * 2 * half_fall;
    return;
  }
  for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
    const double height = ends[i + 1] - ends[i];
    if (height > 1e-12) {
      out.bottom_volume +=
          height *
          floor_at(around, 0.5 * (ends[i] + ends[i + 1]), query.wall->largest()).area;
    }
  }
}

}  // namespace

ArcSum sum_of(const geometry::ArcLayer& layer, double R) noexcept {
  ArcSum sum;
  for (const geometry::EngagedArc& arc : layer.arcs) {
    for (const double turn : {-2 * pi, 0.0}) {
      const double from = std::max(arc.arc.from + turn, 0.0);
      const double to = std::min(arc.arc.to + turn, pi);
      if (to > from) sum.width += R * (std::cos(from) - std::cos(to));
    }
    sum.angle += arc.arc.to - arc.arc.from;
  }
  return sum;
}

Contact contact(const stock::Swept& swept, std::uint32_t index, double u,
                const ContactQuery& query) {
  const stock::Piece& piece = swept.path().pieces[index];
  const stock::PathPoint point = stock::point_at(piece, u);
  const bool flat = query.wall->is_upright();
  const double R = query.wall->largest();
  const bool sideways = !piece.upright();
  const double turns = piece.turns_from + u * (piece.turns_to - piece.turns_from);
  const stock::Surroundings around(swept,
                                   {.tip = point.place,
                                    .direction = sideways ? point.direction : 0.0,
                                    .turns = turns - 1,  // N-2
                                    .last = index,
                                    .without_last = flat && !meets_itself(piece, R)},
                                   R);
  Contact out;
  const double forward = query.feed * piece.horizontal / piece.length;
  const double fall = query.feed * (piece.from[2] - piece.to[2]) / piece.length;
  const stock::Heights all = stock::heights(swept.initial());
  if (!flat) {
    find_curved_layers(around, all.top - point.place[2], query, out);
    for (const geometry::ArcLayer& layer : out.layers) {
      out.flank_volume += volume_of(layer, *query.wall, forward, fall);
    }
    return out;
  }
  if (sideways) {
    find_layers(around, query, out);
    for (const geometry::ArcLayer& layer : out.layers) {
      out.flank_volume += (layer.to - layer.from) * sum_of(layer, R).width * forward;
    }
  }
  if (query.bottom && fall > 0 && point.place[2] - 0.5 * fall < all.top) {
    find_bottom(around, 0.5 * fall, query, around.levels(), out);
  }
  return out;
}

}  // namespace trochoid::engagement
