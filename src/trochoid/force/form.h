#pragma once

#include <array>
#include <cstddef>
#include <string_view>

namespace trochoid::force {

/// Reference chip thickness of the power laws [m].
inline constexpr double h_0 = 1e-3;

/// @brief What a law comes down to with its coefficients set apart: how the force of an
/// edge element follows from its chip. Kernels know a law by its form only.
///
/// The coefficients are K_t, K_r, K_a of cutting and, of a law with edge forces, K_te,
/// K_re, K_ae: the columns of the matrix [C].
struct Form {
  bool power = false;         ///< false: proportional to the chip
  std::array<double, 3> m{};  ///< exponents of t, r, a; 0 where proportional
  bool edge = false;          ///< whether there are edge forces

  [[nodiscard]] constexpr std::size_t columns() const noexcept { return edge ? 6 : 3; }
};

/// A law as kernels take it.
struct Terms {
  Form form;
  std::array<double, 3> K{};    ///< of cutting in t, r, a [N/m^2]
  std::array<double, 3> K_e{};  ///< of the edge, 0 without edge forces [N/m]
};

/// @brief How strongly an edge element pulls in t, r, a for unit coefficients, per ds.
struct ColumnWeights {
  std::array<double, 3> cutting{};  ///< w_q of t, r, a [m]
  double edge = 0.0;                ///< dS/ds, or 0 without edge forces
};

/// @brief Weights of one element per meridian length ds, zero chip excluded.
///
/// F-1, F-2 and F-9 without their coefficients: w_q = h sin(kappa), or
/// h_0 (h sin(kappa)/h_0)^(1 - m_q).
/// @param h          along the horizontal ray [m], positive
/// @param sin_kappa  dz/ds
/// @param dS         edge length per ds, as the setup asks
ColumnWeights column_weights(const Form& form, double h, double sin_kappa,
                             double dS) noexcept;

/// @brief How the weights of cutting grow with the chip: dw_q/dh of t, r, a.
/// @param h  positive where a power law is steepest at 0 [m]
std::array<double, 3> column_slopes(const Form& form, double h,
                                    double sin_kappa) noexcept;

/// What a number of a law does in it.
enum class Role { cutting, edge, exponent };

/// A number of a law, as files name it.
struct Quantity {
  std::string_view key;  ///< for example `K_tc_MPa`
  std::string_view meaning;
  double unit = 1.0;  ///< of the key [SI]
  Role role = Role::cutting;
  bool signed_value = true;  ///< false: not below 0
};

/// A number of a law and where it stands.
template <class Law>
struct Number {
  Quantity quantity;
  double Law::*value;
};

/// @brief Force in x and y of a tangential one and one towards the axis, both in the plane:
/// F-3 but for its last row; on a cylinder the radial force is the one towards the axis.
/// @param sine, cosine  of theta, effective
inline std::array<double, 2> in_plane(double t, double inward, double sine,
                                      double cosine) noexcept {
  return {-t * cosine - inward * sine, t * sine - inward * cosine};
}

}  // namespace trochoid::force
