#pragma once

#include <trochoid/geometry/cutter.h>
#include <trochoid/geometry/edge.h>
#include <trochoid/geometry/meridian.h>
#include <trochoid/geometry/runout.h>

#include <cstddef>
#include <vector>

namespace trochoid::geometry {

/// @brief Whether one profile, one lag and one radius at a height hold for all teeth, as the
/// closed forms want it: no list of helix angles and none below 0, no serration, all
/// teeth level.
bool edges_alike(const Cutter& cutter, const Runout& runout) noexcept;

/// @brief Where the edge of one tooth is at a height of the workpiece frame.
struct EdgeAt {
  bool there = false;       ///< whether the tooth reaches down to this height
  double own_height = 0.0;  ///< z' above its own tip [m]
  double r = 0.0;           ///< own radius, serrated, without runout [m]
  double omega = 0.0;       ///< nominal angle behind the tip of tooth 1 [rad]
  double sin_kappa = 1.0;
  double cos_kappa = 0.0;  ///< negative: undercut by a serration
  double dS_dz = 1.0;      ///< length of edge per height of the workpiece
  EdgePosition position;   ///< from the axis of rotation, with all runout
};

/// @brief A cutter as a radius, an angle and a slope of each tooth at each height.
///
/// Profile, helix, pitch, serration, offsets, eccentricity and tilt are parts of this.
///
/// @eq G-20 r_j(z') = r(z') - (A/2)(1 - cos(2 pi (z' - s_j)/wavelength)) on the flank,
///          kappa_j = atan2(1, dr_j/dz')
/// @eq G-21 z'_j = z + a_j + tan(tilt) r_j(z_1) cos(omega_j(z_1) - mu),
///          z_1 = max(z + a_j, 0)
/// @eq G-22 dS/dz = sqrt(1 + (dr_j/dz')^2 + (r_j dlag_j/dz')^2) dz'_j/dz
/// @eq G-23 e(z) = rho (cos lambda, sin lambda) + z tan(tilt) (cos mu, sin mu),
///          in place of the eccentricity of G-9 and G-10
/// @src derived
/// @note A tooth is there where z'_j >= 0. G-21 is one step of a fixed point: it errs by
///       the square of the tilt.
class ToothEdges {
 public:
  ToothEdges(const Cutter& cutter, const Runout& runout);

  [[nodiscard]] std::size_t teeth() const noexcept { return teeth_.size(); }

  /// @param height  above the nominal plane of the tips [m], may be negative
  [[nodiscard]] EdgeAt edge_at(std::size_t tooth, double height) const noexcept {
    return edge_at(tooth, height, 0.0);
  }
  /// @brief The same at height + beyond: exact for small `beyond` above the lowest height.
  [[nodiscard]] EdgeAt edge_at(std::size_t tooth, double height,
                               double beyond) const noexcept;

  /// Height at which the edge of a tooth begins [m].
  [[nodiscard]] double lowest_height(std::size_t tooth) const noexcept;

  /// @brief Heights at which the edge of some tooth begins or bends, up to a top: between
  /// two of them edges are smooth but for a root at the lower end.
  /// @return [m], ascending; the first where the lowest tooth begins, the last `top`
  [[nodiscard]] std::vector<double> breaks(double top) const;

  /// @brief By how much the edge of a tooth turns between two heights, at most [rad].
  [[nodiscard]] double turn_between(std::size_t tooth, double from,
                                    double to) const noexcept;

  /// Wavelength of the serration [m]; 0: none.
  [[nodiscard]] double wavelength() const noexcept { return wavelength_; }
  [[nodiscard]] const Meridian& meridian() const noexcept { return meridian_; }

 private:
  struct Tooth {
    double psi = 0.0;  ///< [rad]
    LagOf lag;
    double shift = 0.0;   ///< s_j [m]
    double axial = 0.0;   ///< a_j [m]
    double radial = 0.0;  ///< [m]
  };
  /// The edge in the frame of its own tip.
  struct Own {
    double r = 0.0;
    double slope = 0.0;  ///< dr/dz'
    double omega = 0.0;
    double turn = 0.0;  ///< dlag/dz' [rad/m]
    double sin_kappa = 1.0;
    double cos_kappa = 0.0;
  };
  [[nodiscard]] Own own(const Tooth& tooth, double z) const noexcept;
  /// Rise of z' over z + a_j by the tilt [m].
  [[nodiscard]] double lift(const Tooth& tooth, double z1) const noexcept;
  [[nodiscard]] double height_of(const Tooth& tooth, double own_height) const noexcept;
  [[nodiscard]] EdgePosition placed(const Tooth& tooth, const Own& at,
                                    double height) const noexcept;

  Meridian meridian_;
  Runout runout_;
  double tan_tilt_ = 0.0;
  double amplitude_ = 0.0;
  double wavelength_ = 0.0;
  std::vector<Tooth> teeth_;
};

}  // namespace trochoid::geometry
