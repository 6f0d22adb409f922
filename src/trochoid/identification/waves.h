#pragma once

#include <trochoid/numerics/columns.h>

#include <cstddef>
#include <span>
#include <vector>

/// The waves 1, cos phi, sin phi, cos 2 phi, .. of the spindle angle at the samples of a run.
namespace trochoid::identification {

/// @brief 1 and the cosines and sines of an angle and its multiples.
/// @param[out] out  odd in length
void fill_waves(double angle, std::span<double> out) noexcept;

/// @brief sum over g of wave_i(phi_g) x_g for each column x.
/// @param angle  [rad], shape (u)
/// @param X      columns of u rows
/// @param terms  waves, odd
/// @return row-major, shape (terms, columns of X)
std::vector<double> wave_products(std::span<const double> angle,
                                  const numerics::Columns& X, std::size_t terms);

/// @brief sum over i of a_i wave_i(phi_g) at each angle.
/// @param a  amplitudes, odd in length
/// @return shape (u)
std::vector<double> sum_of_waves(std::span<const double> angle,
                                 std::span<const double> a);

/// @brief The waves up to a harmonic made orthonormal over weighted angles: the columns e_k
/// of E = W L^-T, W the weighted waves, L L^T = W^T W.
///
/// The first 2 n + 1 columns are those of the waves up to n. The products W^T W follow from
/// the sums of waves, so that no column is ever written down. Where angles leave waves that
/// nearly depend on one another, the columns come from a QR of W, in an order of its own.
struct WaveBasis {
  std::size_t size = 0;      ///< columns; 0: none was asked for, or it holds everything
  std::vector<double> root;  ///< L, row-major lower triangle, shape (size, size)
  std::vector<double>
      columns;  ///< where there is no root: E, row-major, shape (u, size)

  [[nodiscard]] bool by_root() const noexcept { return !root.empty(); }
};

/// @brief The weighted angles of a run.
struct WeightedAngles {
  std::span<const double> angle;   ///< [rad], shape (u)
  std::span<const double> weight;  ///< shape (u)
};

/// @param harmonics  at least 1, of at most as many waves as there are angles
WaveBasis wave_basis(const WeightedAngles& at, int harmonics);

/// @brief E^T w X.
/// @param X  columns of u rows
/// @return row-major, shape (size, columns of X)
std::vector<double> coordinates(const WaveBasis& basis, const WeightedAngles& at,
                                const numerics::Columns& X);

/// @brief What coordinates stand for at each angle: E c/w, shape (u).
std::vector<double> from_coordinates(const WaveBasis& basis, const WeightedAngles& at,
                                     std::span<const double> c);

/// @brief Amplitudes of the waves that coordinates stand for, shape (size, columns).
/// @param c  row-major, shape (size, columns), of a basis that has a root
std::vector<double> amplitudes(const WaveBasis& basis, std::span<const double> c,
                               std::size_t columns);

/// @brief t_km of I-11 for the first waves, row-major, shape (size, terms).
///
/// By the root the first waves up to those of the basis are L^T: zero left of the diagonal.
std::vector<double> band_by_waves(const WaveBasis& basis, const WeightedAngles& at,
                                  std::size_t terms);

}  // namespace trochoid::identification
