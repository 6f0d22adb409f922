#pragma once

#include <trochoid/base/table.h>
#include <trochoid/identification/identify.h>
#include <trochoid/run/measured_run.h>

#include <array>
#include <span>
#include <string>
#include <vector>

namespace trochoid::run {

/// Forces computed for the samples of every run, and what computed them.
struct ComputedForces {
  std::string name;  ///< of the chip model
  std::vector<std::vector<std::array<double, 3>>> of_run;
};

/// @brief fitted.csv and residual.csv: measured force on the tool, computed forces and
/// what is left, against the recorded angle.
std::vector<base::Table> curve_tables(std::span<const identification::Run> runs,
                                      std::span<const ComputedForces> computed);

/// @brief folded.csv: mean and scatter of the measured force over one turn; absent
/// where no record holds two whole turns.
std::vector<base::Table> folded_tables(std::span<const identification::Run> runs);

}  // namespace trochoid::run
