#pragma once

#include <trochoid/base/table.h>
#include <trochoid/force/slice.h>
#include <trochoid/identification/identify.h>
#include <trochoid/results/columns.h>
#include <trochoid/signal/revolutions.h>

#include <array>
#include <span>
#include <string>
#include <vector>

/// Tables that several commands write.
namespace trochoid::results {

/// Forces computed for the samples of every run, and what computed them.
struct ComputedForces {
  std::string name;  ///< of the chip model
  std::vector<std::vector<std::array<double, 3>>> of_run;
};

/// @brief fitted.csv and residual.csv: measured force on the tool, computed forces and
/// what is left, against the recorded angle.
std::vector<base::Table> curve_tables(std::span<const identification::Run> runs,
                                      std::span<const ComputedForces> computed);
void add_texts_of_curves(std::vector<ColumnText>& out);

/// @brief The mean turn of runs that are long, measured and computed, in at most 720 bins
/// each; runs that are not, whole.
/// @param[in,out] computed  the same of each
/// @return the runs, or their mean turns
std::vector<identification::Run> mean_turns(std::span<const identification::Run> runs,
                                            std::vector<ComputedForces>& computed);

/// Samples of all runs beyond which fitted.csv and residual.csv hold the mean turn.
inline constexpr std::size_t most_curve_samples = 50000;

/// chip_curve.csv: h of every tooth over nominal theta, at one height.
base::Table chip_curve_table(const force::ChipCurve& curve);
void add_texts_of_chip_curve(std::vector<ColumnText>& out);

}  // namespace trochoid::results
