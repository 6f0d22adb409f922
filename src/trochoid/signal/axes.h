#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace trochoid::signal {

using Matrix3 = std::array<std::array<double, 3>, 3>;

/// @brief All 48 signed permutations, in a fixed order, the identity first.
///
/// @eq  S-3  channels = Q F, Q_cq = +-1 where q = pi(c), else 0;  F = Q^T channels
std::vector<Matrix3> axes_candidates();

/// @brief Names as `axes` of the case file has them: {"-x", "y", "z"}.
/// @param Q  a signed permutation
std::array<std::string, 3> axes_names(const Matrix3& Q);

/// @brief The matrix of three names; none when they name no signed permutation.
std::optional<Matrix3> axes_matrix(std::span<const std::string> names);

/// One of the eight ways to read a record of a class that no cylinder can tell apart.
struct AxesReading {
  Matrix3 Q;  ///< channels = Q F
  /// The coefficients that explain the record with Q: (K_t, K_r, K_a) =
  /// turn (K_t, K_r, K_a) of the first reading of the class; cutting and edge alike.
  Matrix3 turn;
};

/// Readings of the channels that fit the record equally well.
struct AxesClass {
  std::array<AxesReading, 8> readings;
};

/// @brief The 48 signed permutations in 6 classes of 8.
///
/// On a cylinder the radial direction is the tangential one turned by 90 degrees about
/// z, and the axial force is alone in z. Turning the frame by 90 degrees therefore is
/// the same as exchanging K_t and K_r (one with the opposite sign), and mirroring z
/// the same as the opposite K_a: the residual says which channel is z and which way
/// round the others go, the signs of the coefficients say the rest. Cutters whose
/// edges are not on a cylinder break this; their 48 readings all differ.
std::array<AxesClass, 6> axes_classes();

/// @brief Force on the tool from the channels, channels = M force.
/// @return [N], shape (n); absent: M cannot be inverted (condition beyond 1e8)
std::optional<std::vector<std::array<double, 3>>> force_on_tool(
    const std::array<std::vector<double>, 3>& channels, const Matrix3& M);

}  // namespace trochoid::signal
