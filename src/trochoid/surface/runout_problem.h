#pragma once

#include <trochoid/numerics/levenberg_marquardt.h>
#include <trochoid/surface/datum.h>
#include <trochoid/surface/tooth_model.h>

#include <array>
#include <span>
#include <vector>

/// The fit of find_runout, as its solver sees it.
namespace trochoid::surface::runout {

inline constexpr double um = 1e-6;    // scale of errors and runout
inline constexpr double MN_m2 = 1e8;  // scale of coefficients

/// Which unknowns a fit has, scaled to about one: c, s, [start], [K_tc, K_rc, datum].
struct Unknowns {
  bool start = false;
  bool all = false;
  std::size_t datum = 0;

  [[nodiscard]] std::size_t count() const {
    return 2 + (start ? 1 : 0) + (all ? 2 + datum : 0);
  }
};

struct State {
  RunoutVector runout;
  double start = 0.0;  ///< [m]
  std::array<double, columns> K{};
  std::vector<double> datum;
};

struct Problem {
  const ToothModel& model;
  std::span<const Reading> readings;  ///< of that model
  std::span<const double> count;      ///< of readings in each mean, shape (readings)
  const DatumColumns& columns_of_datum;
  double f_z;  ///< [m]

  [[nodiscard]] std::vector<double> pack(const State& s, const Unknowns& u) const;
  [[nodiscard]] State unpack(std::span<const double> p, const Unknowns& u,
                             State s) const;
  /// Predicted errors with the datum [m].
  [[nodiscard]] std::vector<double> errors(const State& s,
                                           const ToothModel::Forces& forces) const;
  /// Measured minus predicted, times the root of the count [um].
  void residuals(const State& s, const ToothModel::Forces& forces,
                 std::span<double> r) const;
};

/// @brief Residuals and their differences; forces change with the runout only, and with
/// `frozen` not even then.
/// @param problem, frozen  must live as long as the result
numerics::Residuals residuals_of(const Problem& problem, const Unknowns& u,
                                 const State& about, const ToothModel::Forces* frozen);

}  // namespace trochoid::surface::runout
