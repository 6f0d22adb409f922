#pragma once

#include <trochoid/surface/fit_models.h>
#include <trochoid/surface/row_fit.h>

#include <cstddef>
#include <span>
#include <vector>

namespace trochoid::surface {

/// @brief How far a form of the wall may reach that is no work of the cut: one standard
/// deviation [m].
inline constexpr double usual_offset = 10e-6;
inline constexpr double usual_form = 5e-6;

/// @brief What is fitted, row by row: folded readings, or means.
struct FittedRows {
  std::vector<Reading> readings;
  std::vector<double> error;  ///< [um]
  std::vector<double> count;
  std::vector<std::size_t> of;  ///< which row a reading is in
  std::vector<Spot> spots;      ///< of every reading
  double within = 0.0;          ///< sum of squares about the means [um^2]
  double independent = 0.0;     ///< how many values scatter: readings, or means
};

/// @brief Readings one by one, folded where they are many.
/// @param found  of the same readings
FittedRows folded_rows(const Setting& setting, std::span<const Reading> readings,
                       const ModelFits& found);

/// @brief The means of readings.
/// @param readings  how many there are
FittedRows mean_rows(std::span<const Nominal> nominal, std::size_t readings);

/// @brief Put a form of the wall into a problem: its columns, and what is known of them
/// beforehand where they are decided on (E-22).
/// @param datum  of each set: what is stated
/// @return the columns of every reading
DatumColumns add_form(const FittedRows& rows, std::span<const Datum> datum, Form form,
                      RowProblem& problem);

}  // namespace trochoid::surface
