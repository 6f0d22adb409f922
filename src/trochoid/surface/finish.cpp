#include <trochoid/surface/finish.h>

#include <trochoid/base/units.h>
#include <trochoid/geometry/tooth_edges.h>
#include <trochoid/surface/written_profile.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <variant>

namespace trochoid::surface {
namespace {

constexpr double nowhere = std::numeric_limits<double>::infinity();

/// @brief Lower side of an insert over the radius: W-5.
class LowerSide {
 public:
  LowerSide(const geometry::Profile& profile, const BottomEdge& bottom)
      : meridian_(geometry::meridian(profile)),
        R_(profile.R),
        q_0_(profile.alpha > 0 ? 0.0 : meridian_.M.r),
        dish_(bottom.dish),
        wiper_(bottom.wiper) {}

  [[nodiscard]] PassPoint at(double q) const noexcept {
    return q >= q_0_ ? outside(q) : inside(q_0_ - q);
  }
  [[nodiscard]] double lowest_radius() const noexcept { return q_0_; }

 private:
  enum Part { flank, corner, cone, land, inner_arc, bottom };

  [[nodiscard]] PassPoint outside(double q) const noexcept {
    const geometry::Profile& p = meridian_.profile;
    if (p.alpha > 0 && q < meridian_.M.r) {
      return {q * std::tan(p.alpha), cone};
    }
    if (q < meridian_.N.r && R_ > 0) {
      const double u = (q - p.Rr) / R_;
      return {p.Rz - R_ * std::sqrt(std::max(0.0, 1 - u * u)), corner};
    }
    if (p.beta > 0) {
      return {meridian_.N.z + (q - meridian_.N.r) / std::tan(p.beta), flank};
    }
    return {q > meridian_.N.r ? nowhere : meridian_.N.z, flank};
  }
  /// @param d  how far inside the lowest point [m]
  [[nodiscard]] PassPoint inside(double d) const noexcept {
    const double beyond = d - wiper_;
    if (beyond <= 0) return {0.0, land};
    const double end = R_ * std::sin(dish_);
    if (beyond <= end) {
      const double u = beyond / R_;
      return {R_ * u * u / (1 + std::sqrt(std::max(0.0, 1 - u * u))), inner_arc};
    }
    constexpr double upright = 1e-9;
    if (dish_ > std::numbers::pi / 2 - upright) return {nowhere, bottom};
    const double half = std::sin(0.5 * dish_);
    return {2 * R_ * half * half + (beyond - end) * std::tan(dish_), bottom};
  }

  geometry::Meridian meridian_;
  double R_;
  double q_0_;
  double dish_;
  double wiper_;
};

/// @brief One blade, straight and radial.
struct Blade {
  double psi = 0.0;
  double radial = 0.0;  ///< [m]
  double axial = 0.0;   ///< [m]
  double lean = 0.0;    ///< tan(tilt) cos(psi - mu)
  double e_par = 0.0;   ///< of the eccentricity along the blade [m]
  double e_perp = 0.0;  ///< and across [m]
};

std::vector<Blade> blades_of(const force::Setup& setup) {
  const geometry::Runout& runout = setup.runout;
  std::vector<Blade> all;
  for (const double psi : geometry::tooth_angles(setup.cutter)) {
    const std::size_t j = all.size();
    Blade blade{.psi = psi};
    if (!runout.radial_offsets.empty()) blade.radial = runout.radial_offsets[j];
    if (!runout.axial_offsets.empty()) blade.axial = runout.axial_offsets[j];
    blade.lean = std::tan(runout.tilt) * std::cos(psi - runout.tilt_angle);
    blade.e_par = runout.eccentricity * std::cos(psi - runout.angle);
    blade.e_perp = runout.eccentricity * std::sin(psi - runout.angle);
    all.push_back(blade);
  }
  return all;
}

/// The floor on one line.
struct Floor {
  LowerSide lower;
  std::vector<Blade> blades;
  double feed = 0.0;  ///< f/2 pi [m/rad]
  double tan_lead = 0.0;
  double y = 0.0;

  /// W-3 and W-4.
  [[nodiscard]] PassPoint at(const ProfilePass& pass, double x) const noexcept {
    const Blade& blade = blades[static_cast<std::size_t>(pass.tooth)];
    const double front = pass.rear ? -1.0 : 1.0;
    double phi = unit::turn * pass.turn;
    double ahead = 0.0;  // x - x_c
    double q = 0.0;
    constexpr int most = 60;
    for (int i = 0; i < most; ++i) {
      ahead = x - feed * phi;
      const double rho2 = ahead * ahead + y * y;
      const double square = rho2 - blade.e_perp * blade.e_perp;
      if (!(square >= 0)) return {nowhere, 0};
      q = std::sqrt(square) - blade.e_par;
      const double next = std::atan2(ahead, y) + blade.psi -
                          std::atan2(blade.e_perp, q + blade.e_par) +
                          unit::turn * pass.turn;
      const bool settled = std::abs(next - phi) <= 1e-15 * (1 + std::abs(phi));
      phi = next;
      if (settled) break;
    }
    if (front * ahead < 0 || !(q >= 0)) return {nowhere, 0};
    PassPoint out = lower.at(q - blade.radial);
    out.height += -blade.axial - q * blade.lean - tan_lead * ahead;
    return out;
  }
};

/// All passes that come near the lowest point of some tooth on the line within a period.
std::vector<ProfilePass> floor_passes(const Floor& floor, double reach) {
  const double f = floor.feed * unit::turn;
  const auto most = static_cast<int>(std::ceil(reach / f)) + 3;
  std::vector<ProfilePass> all;
  for (std::size_t j = 0; j < floor.blades.size(); ++j) {
    for (int n = -most; n <= most; ++n) {
      for (const bool rear : {false, true}) {
        all.push_back({static_cast<int>(j), n, rear});
      }
    }
  }
  return all;
}

/// The wall at one height.
struct RigidWall {
  struct Tooth {
    double R = 0.0;       ///< [m]; not positive: it leaves no mark
    double behind = 0.0;  ///< omega - epsilon, in [0, 2 pi) [rad]
  };
  std::vector<Tooth> teeth;
  double R = 0.0;     ///< nominal radius [m]
  double feed = 0.0;  ///< f/2 pi [m/rad]
  bool up = false;

  /// @brief W-6, with t = theta - theta_s.
  [[nodiscard]] PassPoint at(const ProfilePass& pass, double x) const noexcept {
    const Tooth& tooth = teeth[static_cast<std::size_t>(pass.tooth)];
    const double theta_s = up ? 0.0 : std::numbers::pi;
    const double dx = x - feed * (theta_s + tooth.behind + unit::turn * pass.turn);
    // dx = feed t + R sin(theta), and sin(theta) = +-sin(t) where the wall is touched
    const double R_j = up ? tooth.R : -tooth.R;
    double t = dx / (feed + R_j);
    constexpr int most = 50;
    for (int i = 0; i < most; ++i) {
      const double step =
          (feed * t + R_j * std::sin(t) - dx) / (feed + R_j * std::cos(t));
      t -= step;
      if (!(std::abs(t) < 0.5 * std::numbers::pi)) return {nowhere, 0};
      if (std::abs(step) <= 1e-16) break;
    }
    const double s = std::sin(0.5 * t);
    return {R - tooth.R + 2 * tooth.R * s * s, 0};
  }
};

RigidWall rigid_wall_of(const force::Setup& setup, double height) {
  const geometry::ToothEdges edges(setup.cutter, setup.runout);
  RigidWall wall;
  wall.R = setup.cutter.profile.D / 2;
  wall.feed = setup.cutter.teeth() * setup.cut.f_z / unit::turn;
  wall.up = std::holds_alternative<geometry::UpMilling>(setup.cut.engagement);
  for (std::size_t j = 0; j < edges.teeth(); ++j) {
    const geometry::EdgeAt at = edges.edge_at(j, height);
    const double behind = at.omega - at.position.epsilon;
    wall.teeth.push_back({at.there ? at.position.R : 0.0,
                          behind - unit::turn * std::floor(behind / unit::turn)});
  }
  return wall;
}

std::optional<Roughness> behind_filter(const PeriodicProfile& profile,
                                       const FinishOptions& options) {
  return options.cutoff ? std::optional(filtered_roughness(profile, *options.cutoff))
                        : std::nullopt;
}

/// The points of a row, joined by straight lines.
PeriodicProfile joined(const ErrorRow& row, double length) {
  PeriodicProfile out;
  out.period = length;
  const std::size_t n = row.x.size();
  for (std::size_t i = 0; i < n; ++i) {
    out.breaks.push_back(length * static_cast<double>(i) / static_cast<double>(n));
    out.tooth.push_back(std::max(row.tooth[i], 0));
  }
  out.breaks.push_back(length);
  out.height = [&row, n, step = length / static_cast<double>(n)](std::size_t i,
                                                                 double x) {
    const double t = x / step - static_cast<double>(i);
    return row.error[i] + t * (row.error[(i + 1) % n] - row.error[i]);
  };
  return out;
}

}  // namespace

PeriodicProfile floor_profile(const force::Setup& setup, const BottomEdge& bottom,
                              double y) {
  const geometry::Cut& cut = setup.cut;
  const double f = setup.cutter.teeth() * cut.f_z;
  auto floor = std::make_shared<Floor>(Floor{LowerSide(setup.cutter.profile, bottom),
                                             blades_of(setup), f / unit::turn,
                                             std::tan(bottom.lead), y});
  double reach = setup.cutter.profile.D / 2 + setup.runout.eccentricity;
  for (const Blade& blade : floor->blades) {
    reach = std::max(reach, setup.cutter.profile.D / 2 + std::abs(blade.radial) +
                                setup.runout.eccentricity);
  }
  return written_profile(
      f, floor_passes(*floor, reach),
      [floor](const ProfilePass& pass, double x) { return floor->at(pass, x); });
}

FloorLine floor_line(const force::Setup& setup, const BottomEdge& bottom, double y,
                     const FinishOptions& options) {
  const PeriodicProfile profile = floor_profile(setup, bottom, y);
  FloorLine line;
  line.y = y;
  line.roughness = roughness(profile);
  line.filtered = behind_filter(profile, options);
  line.share = shares(profile, setup.cutter.pitch.size());
  for (int k = 0; k < options.samples_per_turn; ++k) {
    line.x.push_back(profile.period * k / options.samples_per_turn);
    const ProfilePoint point = profile_at(profile, line.x.back());
    line.z.push_back(point.height);
    line.tooth.push_back(point.tooth);
  }
  return line;
}

bool is_flat(const geometry::Profile& profile, const BottomEdge& bottom) {
  return bottom.dish == 0 && profile.alpha == 0 && geometry::meridian(profile).M.r > 0;
}

PeriodicProfile wall_profile(const force::Setup& setup, double height) {
  const auto wall = std::make_shared<const RigidWall>(rigid_wall_of(setup, height));
  constexpr int farthest =
      2;  // turns before and behind: a mark is no longer than a feed
  std::vector<ProfilePass> passes;
  for (std::size_t j = 0; j < wall->teeth.size(); ++j) {
    // In the period from x = 0 on: of the axis, so that R sin(theta_s) = 0 adds nothing.
    for (int n = -farthest - 1; wall->teeth[j].R > 0 && n <= farthest; ++n) {
      passes.push_back({static_cast<int>(j), n, false});
    }
  }
  return written_profile(
      setup.cutter.teeth() * setup.cut.f_z, std::move(passes),
      [wall](const ProfilePass& pass, double x) { return wall->at(pass, x); });
}

ErrorMap rigid_map(const force::Setup& setup, const std::vector<double>& heights,
                   const FinishOptions& options) {
  ErrorMap map;
  for (const double height : heights) {
    const PeriodicProfile profile = wall_profile(setup, height);
    ErrorRow& row = map.rows.emplace_back();
    row.height = height;
    for (int k = 0; k < options.samples_per_turn; ++k) {
      row.x.push_back(profile.period * k / options.samples_per_turn);
      const ProfilePoint point = profile_at(profile, row.x.back());
      row.error.push_back(point.height);
      row.tooth.push_back(point.tooth);
    }
  }
  return map;
}

void tell_profiles(const force::Setup& setup, const FinishOptions& options,
                   ErrorMap& map) {
  for (ErrorRow& row : map.rows) {
    const PeriodicProfile profile = wall_profile(setup, row.height);
    const Roughness r = roughness(profile);
    row.roughness = r;
    row.filtered = behind_filter(profile, options);
    row.statistics = {.error = {.mean = r.mean, .min = r.lowest, .max = r.highest},
                      .Ra = r.Ra,
                      .share = shares(profile, setup.cutter.pitch.size())};
  }
  map.error = error_of_rows(map.rows);
}

void tell_rows(double length, const FinishOptions& options, ErrorMap& map) {
  for (ErrorRow& row : map.rows) {
    const PeriodicProfile profile = joined(row, length);
    row.roughness = roughness(profile);
    row.filtered = behind_filter(profile, options);
  }
}

}  // namespace trochoid::surface
