#pragma once

#include <trochoid/correction/command.h>

#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace trochoid::correction {

struct LearningOptions {
  double gain = 0.7;     ///< gamma, in (0, 2)
  int iterations = 20;   ///< at most
  double enough = 1e-4;  ///< it ends at this error, relative to the motion
};

/// The table measured over a turn, with a command that has lasted long enough.
using MeasuredTable = std::function<Harmonics(const Harmonics& command)>;

/// What learning did.
struct Learned {
  Harmonics command;
  /// Root mean square over a turn of motion minus table [m], before each iteration and
  /// after the last one.
  std::vector<double> error;
  int iterations = 0;
  bool converged = false;
};

/// @brief Improve a command by what the table did.
///
/// @eq R-16 U_n <- U_n + gamma (X_n - measured X_n)/P_model(i n Omega)
/// @src [bristow2006]: iterative learning control with the inverse of the plant, here
///      for each harmonic of the spindle by itself
/// @param start  its harmonics are the ones that are learnt
Learned learn(const PeriodicMotion& motion, const Harmonics& start, const Plant& model,
              double Omega, const MeasuredTable& measured,
              const LearningOptions& options = {});

/// @brief Whether learning with a wrong model still converges.
///
/// @eq R-17 |1 - gamma P(i n Omega)/P_model(i n Omega)| < 1 for each harmonic:
///          the error is multiplied by this number in each iteration
/// @src derived from R-16
/// @return one number a harmonic, 1 to n_max
std::vector<double> learning_factors(const Plant& real, const Plant& model,
                                     double Omega, double gain, int n_max);

/// @brief Iterations after which the error is down to a part of what it was.
/// @return absent where learning does not converge
std::optional<int> iterations_needed(std::span<const double> factors, double part);

/// @brief How far off the plant may be at each harmonic: any P with |P/P_model -
/// 1/gamma| < 1/gamma converges; this is the largest phase error allowed for the
/// gain of the model [rad].
double phase_error_allowed(double gain) noexcept;

/// Waiting time between iterations: 5 (T_1 + T_2) [s].
double settling_time(const Plant& model) noexcept;

}  // namespace trochoid::correction
