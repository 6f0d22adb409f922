#pragma once

#include <trochoid/correction/rigid_cut.h>
#include <trochoid/correction/static_fit.h>

#include <array>
#include <span>
#include <vector>

namespace trochoid::correction {

/// Samples that are used, and what is looked for.
struct StaticProblem {
  force::Setup setup;
  StaticFitOptions options;
  std::vector<double> angle;
  std::vector<std::array<double, 3>> force;
  std::size_t axes = 3;  ///< 2: F_z is left out
  std::size_t teeth = 1;
  double size = 1.0;                             ///< rms of the force [N]
  std::array<double, 3> sign = {1.0, 1.0, 1.0};  ///< of K_t1, K_r1, K_a1

  [[nodiscard]] std::size_t law_parameters() const { return 2 * axes; }
  [[nodiscard]] std::size_t parameters() const {
    return law_parameters() + teeth - 1 + (options.fit_offset ? 1 : 0);
  }
  [[nodiscard]] std::size_t residuals() const { return axes * angle.size(); }
};

/// ln K and m of t, r, (a), offsets over f_z but the last one, angle.
struct StaticParameters {
  force::Power law;
  std::vector<double> rho;
  double offset = 0.0;
};

/// Samples away from entries and exits.
StaticProblem static_problem(const force::Setup& setup, const ForceRecord& record,
                             const StaticFitOptions& options);

StaticParameters parameters_of(const StaticProblem& problem, std::span<const double> p);

/// Whether there are such cuts at all.
bool possible(const StaticProblem& problem, std::span<const double> p);

/// @brief R-21 over the size of the force, and its derivatives where asked for.
/// @return false where the parameters are not possible
bool evaluate(const StaticProblem& problem, std::span<const double> p,
              std::span<double> r, std::span<double> jacobian);

/// Offsets to start from: those given, or from the peaks.
std::vector<double> start_offsets(const StaticProblem& problem, double m);

/// Parameters of a start; takes the signs of the coefficients.
std::vector<double> start_of(StaticProblem& problem, const force::Power& law);

/// Leave out the samples at which a chip begins or ends inside the arc of cut.
void leave_out_thin_chips(StaticProblem& problem, const std::vector<double>& rho,
                          double offset);

}  // namespace trochoid::correction
