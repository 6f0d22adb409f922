#pragma once

#include <trochoid/identification/fit.h>
#include <trochoid/identification/turn_matrix.h>
#include <trochoid/identification/waves.h>

#include <array>
#include <span>
#include <vector>

namespace trochoid::identification {

/// @brief A run as the rows of a least-squares problem.
///
/// Samples at the same angle of the turn are one row a channel: their mean, weighted
/// with the root of their number. What they scatter about it does not depend on the
/// model, except through a slope in time, which keeps one row of its own (an orthogonal
/// transformation of the rows: nothing is lost). Records of more than 4000 different
/// angles are averaged over tenths of a degree.
struct FoldedRun {
  geometry::Cut cut;
  std::vector<double> angle;                 ///< [rad], shape (u)
  std::vector<double> weight;                ///< shape (u)
  std::vector<std::array<double, 3>> force;  ///< mean [N], shape (u)
  std::vector<double> slope;                 ///< mean of the slope column, shape (u)
  std::vector<std::size_t> group;            ///< index into angle, one a sample
  bool binned = false;                       ///< a group holds different angles
  WaveBasis basis;                           ///< of the band over the weighted rows
  int band = 0;                              ///< columns of the basis; 0: no limit
  int harmonics = 0;                         ///< of the band; 0: no limit
  Response response;  ///< the rows are of what the dynamometer reads
  /// Where the rows follow from the Fourier coefficients of the force over the turn, up
  /// to this harmonic (map_turn): from a_0, a_1, b_1, ... to the band, shape (band,
  /// 2 highest + 1); or empty.
  std::vector<double> turn_map;
  int highest = 0;

  /// Of the three rows of each angle or wave; what is not measured has rows of zeros.
  std::array<bool, 3> measured = {true, true, true};

  /// Standard error of the offset that was taken out of each force [N].
  std::array<double, 3> offset_se{};

  /// What the error of the speed adds to that of the phase at the first sample [rad].
  double lever_se = 0.0;

  int rows = 0;           ///< of b and drift
  std::vector<double> b;  ///< measured force, shape (rows)
  std::vector<double>
      drift;  ///< channel constants and slopes, shape (rows, 6); or empty
};

/// The slope column at sample i of n: from -1/2 to 1/2.
double slope_at(std::size_t i, std::size_t n) noexcept;

/// @throws std::invalid_argument when a run has not one force for each angle
/// @param response  of the dynamometer at the speed of the run
FoldedRun fold(const Run& run, const Options& options, const Response& response = {});

/// @brief The same run in at most so many angles, by means over equal bins; as it is
/// where it has no more, or has its rows from the turn.
FoldedRun coarsen(const FoldedRun& run, int bins);

/// @brief The same run in no more than so many harmonics, its rows from the turn: what it
/// tells then depends smoothly on runout and phase, also where edges enter suddenly.
FoldedRun from_turn(const FoldedRun& run, int harmonics);

/// @brief Bring a quantity of the shape of a force into the rows of the problem.
/// @param X  at each angle of the run, row-major, shape (u, 3, columns)
/// @return   row-major, shape (rows, columns)
std::vector<double> rows_of(const FoldedRun& run, std::span<const double> X,
                            int columns);

/// How many of the three forces are measured.
int measured_count(const FoldedRun& run) noexcept;

/// @brief Make the rows of forces that are not measured zero.
/// @param column  rows of the run, x, y and z by turns
void leave_out_unmeasured(const FoldedRun& run, std::span<double> column);

/// @brief The same run in no more harmonics of its band, where its rows are from the turn
/// and in the order of the waves; else as it is.
FoldedRun in_fewer_harmonics(const FoldedRun& run, int harmonics);

/// @brief t_km of I-11 for the first waves, shape (band, terms).
std::vector<double> band_by_waves(const FoldedRun& run, std::size_t terms);

/// @brief Let the rows of a run in a band be read off the Fourier coefficients of the
/// force; nothing without a band, and where there are so few angles that they are
/// looked at one by one, unless a dynamometer that is not rigid asks for harmonics.
///
/// @eq I-11 X_k = sum over m of t_km (a_m, b_m), t_km = sum_g w_g e_kg (cos, sin)(m phi_g),
///          e_k the orthonormal columns of the band over the weighted angles
void map_turn(FoldedRun& run, std::size_t few_angles);

/// @brief Rows of the problem from the coefficients of [C].
/// @param coefficients  row-major, shape (2 highest + 1, 3 columns), of the recorded
///                      angle
/// @param columns  of [C]
/// @return row-major, shape (rows, columns)
std::vector<double> rows_of_turn(const FoldedRun& run,
                                 std::span<const double> coefficients, int columns);

}  // namespace trochoid::identification
