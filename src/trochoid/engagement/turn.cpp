#include <trochoid/engagement/turn.h>

#include <trochoid/base/units.h>
#include <trochoid/force/arc_turn.h>
#include <trochoid/geometry/tooth_edges.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

namespace trochoid::engagement {

namespace {

/// Angles of a turn at which forces are looked at, beside those where they have a kink;
/// and where forces jump, as nothing is divided there.
constexpr int angles = 144;
constexpr int angles_with_jumps = 288;
/// About the largest forces steps are divided so often, into so many parts.
constexpr int rounds = 2;
constexpr int between = 4;
constexpr double beside_jump = 1e-9;  ///< [rad]

/// Coefficients of a cubic in the height above the tip.
using Cubic = std::array<double, 4>;

/// Deflection of the tip for 1 N at a height: exactly a cubic in the fluted part.
Cubic tip_compliance(const std::optional<structure::Cantilever>& body, double height) {
  if (!body || !(height > 0)) return {};
  // Newton's form through four places, multiplied out.
  std::array<double, 4> x{};
  std::array<double, 4> d{};
  for (std::size_t i = 0; i < 4; ++i) {
    x[i] = height * static_cast<double>(i) / 3;
    d[i] = structure::compliance(*body, 0.0, x[i]);
  }
  for (std::size_t order = 1; order < 4; ++order) {
    for (std::size_t i = 3; i >= order; --i) {
      d[i] = (d[i] - d[i - 1]) / (x[i] - x[i - order]);
    }
  }
  Cubic c{d[3], 0.0, 0.0, 0.0};
  for (std::size_t i = 3; i-- > 0;) {
    for (std::size_t k = 3; k > 0; --k) {
      c[k] = c[k - 1] - x[i] * c[k];
    }
    c[0] = d[i] - x[i] * c[0];
  }
  return c;
}

double larger(double a, double b) noexcept {
  return std::abs(b) > std::abs(a) ? b : a;
}

/// @param every_event  kinks too, not only jumps
std::vector<double> angles_of(const force::ArcTurn& turn, bool every_event) {
  std::vector<double> phi;
  const int count = turn.jumps() ? angles_with_jumps : angles;
  phi.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    phi.push_back(unit::turn * i / count);
  }
  if (!every_event && !turn.jumps()) return phi;
  for (const double event : turn.events()) {
    if (turn.jumps()) {
      phi.push_back(event - beside_jump);
      phi.push_back(event + beside_jump);
    } else {
      phi.push_back(event);
    }
  }
  std::ranges::sort(phi);
  return phi;
}

double in_plane(const force::ToothLoads& F) noexcept {
  return F.x * F.x + F.y * F.y;
}

/// Forces at ascending angles of a turn.
struct Curve {
  std::vector<double> phi;                      ///< [rad]
  std::vector<force::ToothLoads> all;           ///< of all teeth
  std::vector<std::vector<double>> each_tooth;  ///< squares of F_xy [N^2]
};

Curve curve_of(const force::ArcTurn& teeth, std::vector<double> phi) {
  Curve out{std::move(phi), {}, {}};
  out.all.resize(out.phi.size());
  for (std::size_t j = 0; j < teeth.teeth(); ++j) {
    const std::vector<force::ToothLoads> one = teeth.loads_at(j, out.phi);
    std::vector<double>& squares = out.each_tooth.emplace_back();
    for (std::size_t i = 0; i < one.size(); ++i) {
      out.all[i] += one[i];
      squares.push_back(in_plane(one[i]));
    }
  }
  return out;
}

/// The first of the largest, as far as rounding tells: the same on every machine.
template <class Values, class Size>
std::size_t top_of(const Values& values, const Size& size) {
  constexpr double alike = 1 - 1e-9;
  const auto largest = std::ranges::max_element(values, {}, size);
  const double most = size(*largest);
  const auto first =
      std::ranges::find_if(values.begin(), largest,
                           [&](const auto& one) { return size(one) >= alike * most; });
  return static_cast<std::size_t>(first - values.begin());
}

/// Where the force of each tooth, that of all and the torque are largest.
std::vector<std::size_t> tops_of(const Curve& curve) {
  std::vector<std::size_t> out;
  for (const std::vector<double>& squares : curve.each_tooth) {
    out.push_back(top_of(squares, std::identity{}));
  }
  out.push_back(top_of(curve.all, in_plane));
  out.push_back(
      top_of(curve.all, [](const force::ToothLoads& F) { return std::abs(F.torque); }));
  std::ranges::sort(out);
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

/// Angles about the largest forces: kinks, and some between neighbours.
std::vector<double> near_tops(const Curve& curve, std::span<const double> events) {
  std::vector<double> out;
  const std::vector<double>& phi = curve.phi;
  const std::size_t last = phi.size() - 1;
  for (const std::size_t i : tops_of(curve)) {
    const double before = i > 0 ? phi[i - 1] : phi[last] - unit::turn;
    const double after = i < last ? phi[i + 1] : phi[0] + unit::turn;
    const auto add = [&](double angle) {
      out.push_back(angle - unit::turn * std::floor(angle / unit::turn));
    };
    for (int k = 1; k < between; ++k) {
      const double part = static_cast<double>(k) / between;
      add(before + part * (phi[i] - before));
      add(phi[i] + part * (after - phi[i]));
    }
    for (const double turn : {-unit::turn, 0.0, unit::turn}) {
      const auto first = std::ranges::upper_bound(events, before + turn);
      const auto end = std::ranges::lower_bound(events, after + turn);
      for (auto e = first; e < end; ++e) add(*e);
    }
  }
  std::ranges::sort(out);
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

/// Two curves as one.
Curve merged(const Curve& a, const Curve& b) {
  Curve out;
  out.each_tooth.resize(a.each_tooth.size());
  for (std::size_t i = 0, k = 0; i < a.phi.size() || k < b.phi.size();) {
    const bool first = k == b.phi.size() || (i < a.phi.size() && a.phi[i] <= b.phi[k]);
    const Curve& from = first ? a : b;
    const std::size_t at = first ? i++ : k++;
    out.phi.push_back(from.phi[at]);
    out.all.push_back(from.all[at]);
    for (std::size_t j = 0; j < out.each_tooth.size(); ++j) {
      out.each_tooth[j].push_back(from.each_tooth[j][at]);
    }
  }
  return out;
}

/// Forces of a turn, finer about the largest ones of each tooth and of all, and the
/// largest torque.
Curve fine_curve_of(const force::ArcTurn& teeth, bool every_event) {
  Curve curve = curve_of(teeth, angles_of(teeth, every_event));
  if (teeth.jumps()) return curve;
  const std::vector<double> events = teeth.events();
  for (int i = 0; i < rounds; ++i) {
    curve = merged(curve, curve_of(teeth, near_tops(curve, events)));
  }
  return curve;
}

/// Squares of the deflection of the tip and of the bending moment at the gauge length.
struct Bending {
  double deflection = 0.0;  ///< [m^2]
  double moment = 0.0;      ///< [N^2 m^2]
};

Bending bending_of(const force::ToothLoads& all, const Cubic& c, double gauge_length) {
  const auto& mx = all.moment_x;
  const auto& my = all.moment_y;
  const double dx = c[0] * all.x + c[1] * mx[0] + c[2] * mx[1] + c[3] * mx[2];
  const double dy = c[0] * all.y + c[1] * my[0] + c[2] * my[1] + c[3] * my[2];
  const double bx = gauge_length * all.x - mx[0];
  const double by = gauge_length * all.y - my[0];
  return {dx * dx + dy * dy, bx * bx + by * by};
}

/// Corners of the convex hull, counter-clockwise: what is largest in any direction is one.
std::vector<TurnLoads::InPlane> hull_of(std::vector<TurnLoads::InPlane> points) {
  using InPlane = TurnLoads::InPlane;
  std::ranges::sort(points, [](const InPlane& a, const InPlane& b) {
    return a.x != b.x ? a.x < b.x : a.y < b.y;
  });
  std::vector<InPlane> hull;
  const auto turns_left = [&](const InPlane& c) {
    const InPlane& a = hull[hull.size() - 2];
    const InPlane& b = hull.back();
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x) > 0;
  };
  const auto walk = [&](auto first, auto last) {
    const std::size_t start = hull.size();
    for (auto p = first; p != last; ++p) {
      while (hull.size() >= start + 2 && !turns_left(*p)) hull.pop_back();
      hull.push_back(*p);
    }
    hull.pop_back();
  };
  walk(points.begin(), points.end());
  walk(points.rbegin(), points.rend());
  return hull;
}

}  // namespace

bool is_plain(const Tool& tool) noexcept {
  const geometry::Profile& p = tool.cutter.profile;
  return p.R == 0 && p.alpha == 0 && p.beta == 0 &&
         tool.cutter.lag_law == geometry::LagLaw::constant_lead &&
         geometry::edges_alike(tool.cutter, tool.runout);
}

double past_own_wall(double f_z, double curvature,
                     const geometry::Cutter& cutter) noexcept {
  const double f = f_z * cutter.teeth();
  return f * (2 / cutter.profile.D + std::abs(curvature));
}

geometry::Arc past_own_walls(geometry::Arc arc, double more) noexcept {
  if (arc.from == 0) arc.from -= more;
  if (arc.to == std::numbers::pi) arc.to += more;
  return arc;
}

force::Setup setup_of(const Turn& turn, const Tool& tool) {
  std::vector<geometry::ArcLayer> layers = turn.layers;
  const double more = past_own_wall(turn.f_z, turn.curvature, tool.cutter);
  for (geometry::ArcLayer& layer : layers) {
    for (geometry::EngagedArc& one : layer.arcs) {
      one.arc = past_own_walls(one.arc, more);
    }
  }
  return {.cutter = tool.cutter,
          .runout = tool.runout,
          .cut = {.engagement = geometry::Arcs{std::move(layers), turn.curvature},
                  .a_p = turn.layers.back().to,
                  .f_z = turn.f_z},
          .chip = tool.chip,
          .edge_length = tool.edge_length,
          .process_damping = {}};
}

TurnLoads loads_of(const Turn& turn, const Tool& tool) {
  TurnLoads out;
  TurnForces& F = out.forces;
  F.peak_of_tooth.resize(static_cast<std::size_t>(tool.cutter.teeth()));
  const bool plain = is_plain(tool);
  if (turn.layers.empty() || !(turn.f_z > 0 || (!plain && turn.fall > 0))) {
    return out;
  }
  const double height = turn.layers.back().to;
  const force::Setup setup = setup_of(turn, tool);
  const bool moments = tool.body.has_value() || tool.gauge_length > 0;
  const double more = past_own_wall(turn.f_z, turn.curvature, tool.cutter);
  const geometry::Arc within = plain ? geometry::Arc{-more, std::numbers::pi + more}
                                     : geometry::Arc{-2 * unit::turn, 3 * unit::turn};
  const force::ArcTurn teeth(
      setup, tool.law,
      {.within = within, .heights = moments, .fall = turn.fall, .cones = !plain});
  const Curve turned = fine_curve_of(teeth, plain);
  std::ranges::transform(turned.each_tooth, F.peak_of_tooth.begin(),
                         [](const std::vector<double>& squares) {
                           return std::sqrt(std::ranges::max(squares));
                         });
  const Cubic compliance = tip_compliance(tool.body, height);
  std::vector<TurnLoads::InPlane> curve;
  Bending most;
  for (const force::ToothLoads& here : turned.all) {
    curve.push_back({here.x, here.y});
    F.peak_xy = std::max(F.peak_xy, std::hypot(here.x, here.y));
    F.peak[2] = larger(F.peak[2], here.z);
    F.torque_peak = larger(F.torque_peak, here.torque);
    if (!moments) continue;
    const Bending bending = bending_of(here, compliance, tool.gauge_length);
    most.deflection = std::max(most.deflection, bending.deflection);
    most.moment = std::max(most.moment, bending.moment);
  }
  F.deflection = std::sqrt(most.deflection);
  F.moment_peak = tool.gauge_length > 0 ? std::sqrt(most.moment) : 0.0;
  const force::ToothLoads mean = teeth.mean();
  F.mean = {mean.x, mean.y, mean.z};
  F.torque_mean = mean.torque;
  F.peak_chip = teeth.peak_chip();
  out.hull = hull_of(std::move(curve));
  return out;
}

TurnForces in_program(const TurnLoads& loads, double direction, double spindle) {
  TurnForces out = loads.forces;
  const bool upright = !std::isfinite(direction);
  const double c = upright ? 1.0 : std::cos(direction);
  const double s = upright ? 0.0 : std::sin(direction);
  const TurnForces& F = loads.forces;
  out.mean[0] = c * F.mean[0] - s * F.mean[1];  // N-10
  out.mean[1] = s * F.mean[0] + c * F.mean[1];
  for (const TurnLoads::InPlane& p : loads.hull) {
    out.peak[0] = larger(out.peak[0], c * p.x - s * p.y);
    out.peak[1] = larger(out.peak[1], s * p.x + c * p.y);
  }
  out.power = out.torque_mean * spindle;
  return out;
}

TurnKey key_of(const Turn& turn) {
  TurnKey key;
  const auto add = [&](double value, double step) {
    key.push_back(std::llround(value / step));
  };
  key.push_back(turn.tool);
  add(turn.f_z, 1e-11);
  add(turn.fall, 1e-11);
  add(turn.curvature, 1e-4);
  for (const geometry::ArcLayer& layer : turn.layers) {
    add(layer.from, 1e-9);
    add(layer.to, 1e-9);
    key.push_back(static_cast<std::int64_t>(layer.arcs.size()));
    for (const geometry::EngagedArc& arc : layer.arcs) {
      const double fine = arc.arc.to - arc.arc.from > 0.1 ? 1e-4 : 1e-6;
      add(arc.arc.from, fine);
      add(arc.arc.to, fine);
      for (const geometry::StockBoundary& b : {arc.at_from, arc.at_to}) {
        key.push_back(static_cast<std::int64_t>(b.kind));
        add(b.beta, 1e-3);
        add(b.radius, 1e-6);
      }
    }
  }
  return key;
}

std::size_t TurnKeyHash::operator()(const TurnKey& key) const noexcept {
  std::uint64_t hash = 14695981039346656037ULL;
  for (const std::int64_t value : key) {
    hash = (hash ^ static_cast<std::uint64_t>(value)) * 1099511628211ULL;
    hash ^= hash >> 29;
  }
  return static_cast<std::size_t>(hash);
}

}  // namespace trochoid::engagement
