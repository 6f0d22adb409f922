#include <trochoid/force/any_edges.h>

#include <trochoid/base/units.h>
#include <trochoid/chip/intervals.h>
#include <trochoid/numerics/gauss_kronrod.h>
#include <trochoid/numerics/parallel.h>
#include <trochoid/numerics/pieces.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace trochoid::force {
namespace {

/// A first look takes steps of no more than this, along the edge [rad], and so many of a
/// wavelength and of a zone.
constexpr double look_turn = 2 * unit::deg;
constexpr int looks_of_wave = 32;
constexpr int fewest_looks = 6;
constexpr int looks_near_axis = 64;
/// Switches are found to this part of a zone.
constexpr double resolution_of_zone = 1e-13;
/// Errors allowed on a piece, in parts of the tolerance.
constexpr double share_of_any_piece = 0.02;
/// Errors of pieces are guessed far too large: with so much more allowed the mean of a
/// serrated cutter is 1e-7 off at a tolerance of 1e-6.
constexpr double slack_of_means = 5.0;
/// Parts of a zone whose means are computed side by side.
constexpr std::size_t parts_of_zone = 8;
/// Pieces of a zone shorter than this are taken as they are.
constexpr double shortest_any_piece = 1e-9;

/// Whether some edge comes down from far out to next to the axis in a zone.
bool begins_near_axis(const geometry::ToothEdges& edges, const Zone& zone) {
  constexpr double near = 0.1;  // of the radius at the end
  for (std::size_t j = 0; j < edges.teeth(); ++j) {
    if (zone.there[j] != 0 &&
        edges.edge_at(j, zone.from).r < near * edges.edge_at(j, zone.to).r) {
      return true;
    }
  }
  return false;
}

std::vector<double> look_at(const geometry::ToothEdges& edges, const Zone& zone) {
  double turned = 0.0;
  for (std::size_t j = 0; j < edges.teeth(); ++j) {
    if (zone.there[j] != 0) {
      turned = std::max(turned, edges.turn_between(j, zone.from, zone.to));
    }
  }
  double steps = std::max<double>(fewest_looks, turned / look_turn);
  if (edges.wavelength() > 0) {
    steps = std::max(steps, looks_of_wave * (zone.to - zone.from) / edges.wavelength());
  }
  const auto count = static_cast<int>(std::ceil(steps));
  std::vector<double> grid;
  for (int i = 0; i <= count; ++i) {
    grid.push_back(std::sqrt(static_cast<double>(i) / count));  // even heights
  }
  // Near the start t itself takes even steps, and near the axis, where radii grow with t,
  // all the way: within a feed of it marks change hands often.
  const bool near_axis = begins_near_axis(edges, zone);
  const double last = near_axis ? 1.0 : grid[1];
  const int even = near_axis ? looks_near_axis : 4;
  for (int i = 1; i < even; ++i) grid.push_back(last * i / even);
  std::sort(grid.begin(), grid.end());
  return grid;
}

std::vector<Zone> zones_of(const geometry::ToothEdges& edges, double top) {
  const std::vector<double> ends = edges.breaks(top);
  std::vector<Zone> zones;
  for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
    Zone zone;
    zone.from = ends[i];
    zone.to = ends[i + 1];
    const double middle = 0.5 * (zone.from + zone.to);
    for (std::size_t j = 0; j < edges.teeth(); ++j) {
      zone.there.push_back(edges.edge_at(j, middle).there ? 1 : 0);
    }
    zone.grid = look_at(edges, zone);
    zones.push_back(std::move(zone));
  }
  return zones;
}

/// One tooth in one zone, at one spindle angle, as a curve over t.
class AnyCurve {
 public:
  AnyCurve(const AnyEdges& edges, const Zone& zone)
      : zone_(zone), teeth_(edges.edges, edges.passage) {}

  void stand_at(double phi, std::size_t tooth) noexcept {
    phi_ = phi;
    tooth_ = tooth;
  }
  [[nodiscard]] AnyState state(double t) const noexcept {
    teeth_.stand_at(zone_.from, zone_.beyond(t), zone_.there);
    const geometry::EdgeAt& at = teeth_.edge(tooth_);
    const double theta = phi_ - at.omega;
    return {teeth_.chip(tooth_, theta), theta + at.position.epsilon};
  }
  [[nodiscard]] double boundary(double t, const AnyState& a,
                                const AnyState& b) const noexcept {
    teeth_.stand_at(zone_.from, zone_.beyond(t), zone_.there);
    return teeth_.boundary(tooth_, phi_ - teeth_.edge(tooth_).omega, a.chip, b.chip);
  }
  /// Where state() looked last.
  [[nodiscard]] const geometry::EdgeAt& edge() const noexcept {
    return teeth_.edge(tooth_);
  }

 private:
  const Zone& zone_;
  double phi_ = 0.0;
  std::size_t tooth_ = 0;
  mutable chip::TeethAtHeight teeth_;
};

/// Weights of an element per height: F-1, F-2 and F-9 without their coefficients.
ColumnWeights weights_per_height(const Setup& setup, const Form& form, double h,
                                 const geometry::EdgeAt& at) noexcept {
  const double dS =
      (setup.edge_length == EdgeLength::axial ? 1.0 : at.dS_dz) * at.sin_kappa;
  ColumnWeights w = column_weights(form, h, at.sin_kappa, dS);
  for (double& cutting : w.cutting) cutting /= at.sin_kappa;
  w.edge /= at.sin_kappa;
  return w;
}

/// No chip is thicker than the feed of a turn, or all radii apart and the widest gap.
double thickest(const AnyEdges& any) {
  return any.passage.feed * unit::turn;
}

}  // namespace

AnyEdges::AnyEdges(const Setup& given)
    : setup(given),
      edges(given.cutter, runout_of(given)),
      passage(chip::passage(given.cutter, given.cut, given.chip)),
      zones(zones_of(edges, given.cut.a_p)) {
  setup.runout = runout_of(given);
}

AnyForce::AnyForce(const Setup& setup, const Law& law, double tolerance)
    : AnyForce(setup, law, tolerance, setup.cut.a_p) {}

AnyForce::AnyForce(const Setup& setup, const Law& law, double tolerance, double top)
    : edges_(setup), terms_(terms(law)) {
  if (top < setup.cut.a_p) edges_.zones = zones_of(edges_.edges, top);
  const double h = thickest(edges_);
  const double length =
      edges_.zones.empty() ? 0.0 : edges_.zones.back().to - edges_.zones.front().from;
  if (h > 0) {
    const ColumnWeights w = column_weights(terms_.form, h, 1.0, 1.0);
    allowed_cutting_ = share_of_any_piece * tolerance * length *
                       std::max({w.cutting[0], w.cutting[1], w.cutting[2]});
  }
  allowed_edge_ = share_of_any_piece * tolerance * length;
}

template <std::size_t M, class Element>
void AnyForce::integrate(double phi, const std::array<double, M>& allowed,
                         const Element& element, std::array<double, M>& sum) const {
  for (const Zone& zone : edges_.zones) {
    AnyCurve curve(edges_, zone);
    numerics::PieceFinder<AnyCurve> finder(curve, resolution_of_zone);
    std::vector<numerics::Piece<AnyState>> pieces;
    const auto add = [&](double t, double weight, std::array<double, M>& out) {
      const AnyState state = curve.state(t);
      if (state.active()) {
        const double z = zone.from + zone.beyond(t);
        element(curve.edge(), state, z, weight * zone.slope(t), out);
      }
    };
    for (std::size_t j = 0; j < edges_.edges.teeth(); ++j) {
      if (zone.there[j] == 0) continue;
      curve.stand_at(phi, j);
      finder.find(zone.grid, pieces);
      for (const auto& piece : pieces) {
        numerics::add_integral(piece.from, piece.to, add, allowed, shortest_any_piece,
                               sum);
      }
    }
  }
}

void AnyForce::matrices(std::span<const double> phi, std::span<Matrix> C) const {
  const std::size_t columns = terms_.form.columns();
  Matrix allowed{};
  for (std::size_t q = 0; q < allowed.size(); ++q) {
    allowed[q] = q % 6 < 3 ? allowed_cutting_ : allowed_edge_;
  }
  const auto element = [&](const geometry::EdgeAt& at, const AnyState& state,
                           double /*z*/, double weight, Matrix& out) {
    const double s = std::sin(state.theta);
    const double c = std::cos(state.theta);
    const std::array<std::array<double, 3>, 3> B = {
        // F-3
        {{-c, -s * at.sin_kappa, -s * at.cos_kappa},
         {s, -c * at.sin_kappa, -c * at.cos_kappa},
         {0.0, at.cos_kappa, -at.sin_kappa}}};
    const ColumnWeights w =
        weights_per_height(edges_.setup, terms_.form, state.chip.h, at);
    for (std::size_t row = 0; row < 3; ++row) {
      for (std::size_t q = 0; q < 3; ++q) {
        out[6 * row + q] += weight * B[row][q] * w.cutting[q];  // F-30
        out[6 * row + 3 + q] += weight * B[row][q] * w.edge;
      }
    }
  };
  for (std::size_t i = 0; i < phi.size(); ++i) {
    Matrix sum{};
    integrate(phi[i], allowed, element, sum);
    C[i] = Matrix{};
    for (std::size_t row = 0; row < 3; ++row) {
      std::copy_n(&sum[6 * row], columns, &C[i][columns * row]);
    }
  }
}

SixLoads AnyForce::allowed_loads(double gauge_length) const {
  const auto largest = [](const std::array<double, 3>& v) {
    return std::max({std::abs(v[0]), std::abs(v[1]), std::abs(v[2])});
  };
  const double force =
      allowed_cutting_ * largest(terms_.K) + allowed_edge_ * largest(terms_.K_e);
  const double arm = edges_.setup.cutter.profile.D / 2;
  const double reach = std::max({arm, edges_.setup.cut.a_p, gauge_length});
  return {force, force, force, force * arm, force * reach, force * reach};
}

std::array<double, 3> AnyForce::force_per_height(const chip::Chip& chip,
                                                 const geometry::EdgeAt& at) const {
  const ColumnWeights w = weights_per_height(edges_.setup, terms_.form, chip.h, at);
  std::array<double, 3> tra{};
  for (std::size_t q = 0; q < 3; ++q) {
    tra[q] = terms_.K[q] * w.cutting[q] + terms_.K_e[q] * w.edge;
  }
  return tra;
}

namespace {

/// @param arm  height above the section about which moments are taken [m]
Element element_at(const geometry::EdgeAt& at, double theta, double arm) noexcept {
  return {.sine = std::sin(theta),
          .cosine = std::cos(theta),
          .sin_kappa = at.sin_kappa,
          .cos_kappa = at.cos_kappa,
          .R = at.position.R,
          .z = arm};
}

std::array<double, 3> times(std::array<double, 3> tra, double weight) noexcept {
  for (double& f : tra) f *= weight;
  return tra;
}

}  // namespace

void AnyForce::loads(std::span<const double> phi, double gauge_length,
                     std::span<SixLoads> all) const {
  const SixLoads allowed = allowed_loads(gauge_length);
  const auto element = [&](const geometry::EdgeAt& at, const AnyState& state, double z,
                           double weight, SixLoads& out) {
    add_loads(element_at(at, state.theta, z - gauge_length),
              times(force_per_height(state.chip, at), weight), out);
  };
  for (std::size_t i = 0; i < phi.size(); ++i) {
    all[i] = SixLoads{};
    integrate(phi[i], allowed, element, all[i]);
  }
}

namespace {

/// @brief Add loads, and the same in the frame that turns with the tool.
/// @param phi  angle of the tip of tooth 1 [rad]
void add_turning(const SixLoads& loads, double phi, std::array<double, 10>& sum) {
  const double s = std::sin(phi);
  const double c = std::cos(phi);
  for (std::size_t q = 0; q < loads.size(); ++q) sum[q] += loads[q];
  sum[6] += loads[0] * s + loads[1] * c;  // F-32
  sum[7] += loads[1] * s - loads[0] * c;
  sum[8] += loads[4] * s + loads[5] * c;
  sum[9] += loads[5] * s - loads[4] * c;
}

}  // namespace

AnyForce::TenMeans AnyForce::allowed_means(double gauge_length) const {
  SixLoads six = allowed_loads(gauge_length);
  for (double& x : six) x *= slack_of_means;
  return {six[0], six[1], six[2], six[3], six[4],
          six[5], six[0], six[1], six[4], six[5]};
}

void AnyForce::add_turn(const chip::TeethAtHeight& teeth, double z, double gauge_length,
                        double weight, TenMeans& sum) const {
  constexpr double opposite = -0.5 * std::numbers::pi;
  TenMeans allowed = allowed_means(gauge_length);
  const double length = edges_.zones.back().to - edges_.zones.front().from;
  for (double& x : allowed) x *= unit::turn / length;  // per height, over a turn
  TenMeans turn{};
  for (std::size_t j = 0; j < teeth.teeth(); ++j) {
    if (!teeth.there(j)) continue;
    const geometry::EdgeAt& at = teeth.edge(j);
    const auto add = [&](double theta, double w, TenMeans& out) {
      const chip::Chip chip = teeth.chip(j, theta);
      if (!chip.in_cut) return;
      SixLoads loads{};
      add_loads(element_at(at, theta + at.position.epsilon, z - gauge_length),
                times(force_per_height(chip, at), w), loads);
      add_turning(loads, theta + at.omega, out);
    };
    for (const chip::ChipPiece& piece : chip::engaged_pieces(
             teeth.passage(), teeth.slice(j), teeth.place(j), opposite)) {
      numerics::add_integral(piece.from, piece.to, add, allowed, shortest_any_piece,
                             turn);
    }
  }
  for (std::size_t q = 0; q < sum.size(); ++q) {
    sum[q] += weight / unit::turn * turn[q];
  }
}

TurnMeans AnyForce::mean(double gauge_length) const {
  const TenMeans allowed = allowed_means(gauge_length);
  std::vector<TenMeans> parts(parts_of_zone * edges_.zones.size());
  const auto integrate_part = [&](std::size_t i) {
    const Zone& zone = edges_.zones[i / parts_of_zone];
    const double from = static_cast<double>(i % parts_of_zone) / parts_of_zone;
    chip::TeethAtHeight teeth(edges_.edges, edges_.passage);
    const auto add = [&](double t, double weight, TenMeans& out) {
      teeth.stand_at(zone.from, zone.beyond(t), zone.there);
      add_turn(teeth, zone.from + zone.beyond(t), gauge_length, weight * zone.slope(t),
               out);
    };
    numerics::add_integral(from, from + 1.0 / parts_of_zone, add, allowed, 1e-4,
                           parts[i]);
  };
  numerics::for_each_index(parts.size(), integrate_part, 1);
  TenMeans sum{};
  for (const TenMeans& one : parts) {
    for (std::size_t q = 0; q < sum.size(); ++q) sum[q] += one[q];
  }
  TurnMeans out;
  std::copy_n(sum.begin(), 6, out.fixed.begin());
  std::copy_n(sum.begin() + 6, 4, out.turning.begin());
  return out;
}

}  // namespace trochoid::force
