#pragma once

#include <trochoid/base/units.h>
#include <trochoid/surface/edge_moments.h>
#include <trochoid/surface/envelope.h>
#include <trochoid/surface/setting.h>
#include <trochoid/surface/turn.h>

#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <numbers>
#include <vector>

namespace trochoid::surface {

inline constexpr double pi = std::numbers::pi;

using Coefficients = std::array<double, columns>;

/// gtest has a Setup of its own in the scope of every test.
using MadeCut = force::Setup;

/// The cut of [wang2015]: 12 mm, three teeth, 45 deg, a_e = 1 mm, a_p = 3 mm, 0.2 mm.
inline MadeCut made_cut(bool down = true, int teeth = 3, double helix_deg = 45.0) {
  MadeCut s;
  s.cutter.profile = geometry::cylinder(12e-3);
  s.cutter.pitch = geometry::equal_pitch(teeth);
  s.cutter.helix = helix_deg * unit::deg;
  s.cutter.lag_diameter = 12e-3;
  s.cut = {.a_p = 3e-3, .f_z = 0.2e-3, .Omega = 100.0};
  if (down) {
    s.cut.engagement = geometry::DownMilling{1e-3};
  } else {
    s.cut.engagement = geometry::UpMilling{1e-3};
  }
  s.chip.model = chip::Model::radial;
  return s;
}

inline MadeCut with_runout(MadeCut s, double rho, double angle) {
  s.runout = {
      .eccentricity = rho, .angle = angle, .order = geometry::EccentricityOrder::first};
  return s;
}

inline force::Law law(double K_tc, double K_rc, double K_te = 0.0, double K_re = 0.0) {
  return force::LinearEdge{K_tc, K_rc, 0.0, K_te, K_re, 0.0};
}

/// 83 mm out of the holder, 45 mm of flutes.
inline structure::Cantilever made_cutter() {
  return {83e-3, 45e-3, 12e-3, 9.6e-3, 206e9};
}

inline BodiesAt cutter_only() {
  return [](double) { return Bodies{.cutter = made_cutter()}; };
}

/// The cutter before a wall of 60 x 30 mm; solved once for each place and thickness.
inline BodiesAt with_wall(double thickness = 2e-3) {
  return [thickness](double x) {
    static std::map<std::pair<double, double>,
                    std::shared_ptr<const structure::PlateSolution>>
        solved;
    static std::mutex mutex;
    const std::lock_guard lock(mutex);
    auto& plate = solved[{thickness, x}];
    if (!plate) {
      plate = std::make_shared<structure::PlateSolution>(
          structure::Plate{60e-3, 30e-3, thickness, 69e9, 0.33}, x, 1e-3);
    }
    return Bodies{.cutter = made_cutter(), .wall = Wall{plate, 30e-3, 60e-3}};
  };
}

inline BodiesAt rigid() {
  return [](double) { return Bodies{}; };
}

inline Setting made_setting(Model model, const MadeCut& cut = made_cut(),
                            BodiesAt bodies = cutter_only()) {
  Setting s{.setup = cut, .law = law(0.0, 0.0), .bodies = std::move(bodies)};
  s.model = model;
  return s;
}

/// Samples of one turn that are no special ones [rad].
inline std::vector<double> angles(int count) {
  std::vector<double> out;
  for (int i = 0; i < count; ++i) out.push_back(2 * pi * (i + 0.3217) / count);
  return out;
}

inline double value_at(const numerics::PeriodicPieces& f, double phi,
                       std::size_t which = 0) {
  std::vector<double> out(f.functions());
  f.value(phi, out);
  return out[which];
}

/// Integral over [from, to] by Simpson's rule on many panels.
inline double simpson(const std::function<double(double)>& f, double from, double to,
                      int panels = 200) {
  const double step = (to - from) / (2 * panels);
  double sum = f(from) + f(to);
  for (int i = 1; i < 2 * panels; ++i) sum += (i % 2 == 1 ? 4 : 2) * f(from + i * step);
  return sum * step / 3;
}

/// Arc on which an edge of a made cut is in the stock [rad].
inline std::array<double, 2> arc(const MadeCut& s) {
  const double R = s.cutter.profile.D / 2;
  if (const auto* d = std::get_if<geometry::DownMilling>(&s.cut.engagement)) {
    return {pi - std::acos(1 - d->a_e / R), pi};
  }
  return {0.0, std::acos(1 - std::get<geometry::UpMilling>(s.cut.engagement).a_e / R)};
}

/// Integral of weight(z) dF_y over the edges of a cutter without runout, by hand: tooth
/// after tooth over the heights that are in the stock.
inline double weighted_force(const MadeCut& s, Coefficients K, double phi,
                             const std::function<double(double)>& weight) {
  const double R = s.cutter.profile.D / 2;
  const double per_z = std::tan(s.cutter.helix) / R;
  const double edge = 1 / std::cos(s.cutter.helix);
  const auto [first, last] = arc(s);
  double sum = 0.0;
  for (const double psi : geometry::tooth_angles(s.cutter)) {
    for (int turns = -3; turns <= 3; ++turns) {
      // theta = start - per_z z
      const double start = phi - psi + 2 * pi * turns;
      const double from = std::max(0.0, (start - last) / per_z);
      const double to = std::min(s.cut.a_p, (start - first) / per_z);
      if (to <= from) continue;
      sum += simpson(
          [&](double z) {
            const double theta = start - per_z * z;
            const double h = s.cut.f_z * std::sin(theta);
            return weight(z) * ((K[0] * h + K[2] * edge) * std::sin(theta) -
                                (K[1] * h + K[3] * edge) * std::cos(theta));
          },
          from, to);
    }
  }
  return sum;
}

/// Everything of a cut at one place and some heights, without feedback.
inline std::vector<HeightCut> height_cuts(const Setting& s, Coefficients K,
                                          const std::vector<double>& heights,
                                          double x = 0.0) {
  const Compliance compliance(s.bodies(x), s.setup.cut.a_p, x, s.load);
  const EdgeMoments edges(s.setup, s.law, compliance.basis());
  const Side side = *side_of(s.setup.cut.engagement);
  const auto moments = with_coefficients(unit_moments(edges, s.tolerance), K);
  std::vector<HeightCut> cuts;
  for (const double h : heights) {
    cuts.push_back({side, s.setup.cutter.profile.D / 2,
                    s.setup.cutter.teeth() * s.setup.cut.f_z, 0.0,
                    edge_places(s.setup, h),
                    deflection(moments, compliance.rows(std::array{h}), side.sigma)});
  }
  return cuts;
}

inline HeightCut height_cut(const Setting& s, Coefficients K, double height,
                            double x = 0.0) {
  return height_cuts(s, K, {height}, x).front();
}

/// Mean of an envelope over one turn of the cutter [m].
inline double mean_envelope(const HeightCut& cut, int points) {
  double sum = 0.0;
  for (int i = 0; i < points; ++i) {
    sum += envelope_error(cut, cut.feed * (i + 0.5) / points).error;
  }
  return sum / points;
}

}  // namespace trochoid::surface
