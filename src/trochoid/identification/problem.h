#pragma once

#include <trochoid/base/stop.h>
#include <trochoid/force/forces.h>
#include <trochoid/identification/fit.h>
#include <trochoid/identification/folded.h>
#include <trochoid/identification/response.h>
#include <trochoid/identification/turn_matrix.h>
#include <trochoid/numerics/columns.h>

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

/// Runs that share coefficients.
namespace trochoid::identification {

/// @brief What the nonlinear unknowns p mean, in
/// their order: runout, exponents, resonances (ln omega, ln zeta of each axis), phases.
///
/// p is scaled to about one: runout by `length`, resonances over where their search begins,
/// the phases in radians.
struct Unknowns {
  RunoutUnknowns runout = RunoutUnknowns::none;
  int teeth = 1;
  double length = 1.0;  ///< [m]: the feed per tooth
  /// The eccentricity is searched along this angle only [rad].
  std::optional<double> direction;
  bool exponents = false;
  std::array<bool, 3> rings{};  ///< axes of which a resonance is searched
  int phases = 0;

  [[nodiscard]] int runout_count() const noexcept;
  [[nodiscard]] int exponent_count() const noexcept { return exponents ? 3 : 0; }
  [[nodiscard]] int resonance_count() const noexcept {
    return 2 * (int{rings[0]} + int{rings[1]} + int{rings[2]});
  }
  [[nodiscard]] int first_resonance() const noexcept {
    return runout_count() + exponent_count();
  }
  [[nodiscard]] int first_phase() const noexcept {
    return first_resonance() + resonance_count();
  }
  [[nodiscard]] int count() const noexcept { return first_phase() + phases; }
};

/// The physical meaning of p.
struct Point {
  geometry::Runout runout;
  force::Law law;
  std::vector<double> phase;  ///< [rad], one a run
  Resonances resonances = {};
};

/// @brief A fit to be made: data, model and unknowns. Constant once made.
struct Problem {
  force::Setup setup;  ///< its cut is that of the run in question
  force::Law law;
  std::vector<FoldedRun> runs;
  Unknowns unknowns;
  double fixed_phase = 0.0;    ///< [rad], where the phases are not unknown
  Resonances resonances = {};  ///< where the search for them begins
  double tolerance = 1e-7;     ///< of the force matrix
  /// At so many angles of the turn at least the matrix of a run is evaluated that has
  /// its rows from the turn; at four times as many on a cylinder whose edges lag, where
  /// they cost little.
  int angles = 256;
  int columns = 0;  ///< of the force matrix of one run
  std::vector<std::string> groups = {
      ""};                            ///< names of those with coefficients of their own
  std::vector<std::size_t> group_of;  ///< place of the group of each run; empty: all 0
  std::optional<Point> start;         ///< where to search first
  bool start_of_fit = false;          ///< as of Start
  Tolerances tolerances = {};         ///< that the intervals hold
  base::Stop stop = {};               ///< when late, the best so far is enough

  /// Coefficients of all groups.
  [[nodiscard]] int force_columns() const noexcept {
    return columns * static_cast<int>(groups.size());
  }
  [[nodiscard]] int drift_columns() const noexcept;
  [[nodiscard]] int linear() const noexcept {
    return force_columns() + drift_columns();
  }
  [[nodiscard]] int rows() const noexcept;
};

Point point_of(const Problem& problem, std::span<const double> p);

/// p at which the unknowns have these values.
std::vector<double> parameters_of(const Problem& problem, const Point& point);

/// Force matrices of all runs at one p.
struct Evaluation {
  std::vector<double> p;   ///< the unknowns
  double tolerance = 0.0;  ///< of the force matrices
  Point point;             ///< the same, in words
  std::vector<force::ForceMatrix> matrix;
  std::vector<TurnMatrix> turn;    ///< empty where the rows are not from the turn
  std::vector<Response> response;  ///< with the resonances, where they are searched
  std::vector<double> D;  ///< with its channel columns, by columns: (linear, rows);
                          ///< with room for the derivatives beside it
};

/// What the force of a run is computed from.
force::Setup setup_of(const Problem& problem, const Point& point, const FoldedRun& run);

/// Where the rows of a run begin.
std::size_t first_row(const Problem& problem, std::size_t r) noexcept;

/// @brief Fourier coefficients of [C] of a run at its phase, as the dynamometer reads it.
/// @return row-major, shape (2 highest + 1, 3, columns)
std::vector<double> read_at_phase(const Problem& problem, const Evaluation& at,
                                  std::size_t r);

/// @brief The force columns of a run at its phase.
/// @param[out] C  its rows, by columns that are the rows of the problem apart
void fill_run(const Problem& problem, const Evaluation& at, std::size_t r,
              std::span<double> C);

/// @brief Rows of a run whose rows are from the turn, to which a force is added.
struct TurnRows {
  std::size_t run = 0;
  std::span<const double> K;  ///< coefficients of the run
  double factor = 1.0;
  std::span<double> out;  ///< shape (rows of the run)
};

/// @brief Add its force at another place.
/// @param point  of the same resonances as the evaluation
void add_turn_force(const Problem& problem, const Evaluation& at, const Point& point,
                    const TurnRows& to);

/// @brief Add the derivative of its force by the phase.
void add_phase_slope(const Problem& problem, const Evaluation& at, const TurnRows& to);

/// @brief Add the derivative of its force by an unknown of a resonance.
/// @param i  of those of the resonances
void add_resonance_slope(const Problem& problem, const Evaluation& at, int i,
                         const TurnRows& to);

/// [D] at an evaluation.
numerics::Columns design(const Problem& problem, const Evaluation& at) noexcept;

/// @brief Whether p is in the range where the model means anything.
bool in_range(const Problem& problem, std::span<const double> p);

/// @param[in,out] at  an evaluation of this problem elsewhere, whose matrices serve again
///                    where only phases differ, and whose memory always does; or empty
void evaluate(const Problem& problem, std::span<const double> p, Evaluation& at);

Evaluation evaluate(const Problem& problem, std::span<const double> p);

/// @brief Whether an evaluation is what evaluate would give at p.
bool serves(const Problem& problem, const Evaluation& at, std::span<const double> p);

/// @brief Whether the edges of a run enter within less than two steps of that size
/// [rad].
bool enters_suddenly(const Problem& problem, const FoldedRun& run, double step);

/// Measured force of all runs, shape (rows).
std::vector<double> measured(const Problem& problem);

/// @brief Take down which runs share coefficients (I-19).
void set_groups(std::span<const Run> runs, Problem& problem);

/// Where the coefficients of a run begin among those of all groups.
std::size_t first_column(const Problem& problem, std::size_t r) noexcept;

/// Whether teeth can be renumbered without changing anything but names.
bool teeth_are_alike(const Problem& problem);

/// @brief Choose names: phase of the first run in [-pi/N, pi/N) when the teeth are
/// alike, or as near to it as no tooth that is half a feed shorter than another becomes
/// tooth 1; else in [-pi, pi). Other phases in [-pi, pi).
/// @return whether teeth were renumbered
bool apply_gauge(const Problem& problem, std::vector<double>& p);

}  // namespace trochoid::identification
