#pragma once

#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace trochoid::geometry {

/// @brief Meridian profile of a cutter by its APT parameters, tip at z = 0.
///
/// From the axis outwards: bottom cone z = r tan(alpha), corner arc of radius R about
/// (Rr, Rz), flank r = u + z tan(beta) with u = D/2 (1 - tan(alpha) tan(beta)).
struct Profile {
  double D = 0.0;      ///< diameter where cone and flank would meet [m]
  double R = 0.0;      ///< corner radius [m], 0: sharp
  double Rr = 0.0;     ///< radius of the corner's centre [m]
  double Rz = 0.0;     ///< height of the corner's centre [m]
  double alpha = 0.0;  ///< bottom angle [rad], in [0, pi/2)
  double beta = 0.0;   ///< taper angle [rad], in (-pi/2, pi/2)
};

Profile cylinder(double D);
Profile ball(double D);
/// @param R  corner radius [m], 0 <= R <= D/2
Profile bull_nose(double D, double R);
/// @brief Taper whose corner, if it has one, is tangent to the bottom and to the flank.
/// @param D  diameter of the flank's line at z = 0 [m]
Profile taper(double D, double beta, double R = 0.0);

/// How far the edge lags behind its tip.
enum class LagLaw {
  constant_lead,   ///< lag = 2 z tan(helix) / lag_diameter everywhere
  constant_helix,  ///< the same up to the flank, there d lag = tan(helix) dz/(r
                   ///< cos(beta))
};

/// The names that files use.
constexpr std::string_view name_of(LagLaw law) noexcept {
  switch (law) {
    case LagLaw::constant_lead:
      return "constant_lead";
    case LagLaw::constant_helix:
      return "constant_helix";
  }
  return {};
}

/// Wave of a serrated edge.
enum class SerrationShape { sine };

/// The names that files use.
constexpr std::string_view name_of(SerrationShape shape) noexcept {
  switch (shape) {
    case SerrationShape::sine:
      return "sine";
  }
  return {};
}

/// @brief A wave along the flank of each tooth, cut into its radius (G-20).
struct Serration {
  SerrationShape shape = SerrationShape::sine;
  double amplitude = 0.0;   ///< A, from crest to valley [m]
  double wavelength = 0.0;  ///< along the axis [m]
  std::vector<double>
      shift;  ///< height s_j of a crest of each tooth [m], shape (teeth);
              ///< empty: (j - 1) wavelength / teeth
};

/// @brief A cutter: profile, teeth and edges. Teeth are numbered in order of passage.
struct Cutter {
  Profile profile;
  std::vector<double> pitch;  ///< angle from tooth k to k+1 [rad], sum 2 pi; 1 to 64
  double helix = 0.0;         ///< [rad], in (-pi/2, pi/2); negative: left-hand
  LagLaw lag_law = LagLaw::constant_lead;
  double lag_diameter = 0.0;         ///< [m]
  std::vector<double> helices = {};  ///< of each tooth, where they differ [rad]
  std::optional<Serration> serration = {};

  [[nodiscard]] int teeth() const noexcept { return static_cast<int>(pitch.size()); }
};

/// Equal pitches of a cutter with so many teeth [rad].
std::vector<double> equal_pitch(int teeth);

/// @brief Whether pitches are equal, but for rounding: to 1e-9 rad.
bool equally_pitched(std::span<const double> pitch) noexcept;

/// @brief A cylinder of equal pitch and constant lead.
/// @param D      diameter [m], above 0
/// @param teeth  at least 1
/// @param helix  [rad], in [0, pi/2)
Cutter end_mill(double D, int teeth, double helix);

/// @brief psi_k, the angle from the tip of tooth 1 to the tip of tooth k [rad].
/// @return shape (teeth), first entry 0
std::vector<double> tooth_angles(const Cutter& cutter);

}  // namespace trochoid::geometry
