#pragma once

#include <trochoid/surface/readings.h>
#include <trochoid/surface/tooth_model.h>

#include <span>
#include <vector>

namespace trochoid::surface {

/// @brief Readings that a model cannot tell apart, as their mean.
///
/// Readings of one tooth, one part of the turn of the feed, one height and one stretch of
/// the wall. What a model says changes little within these, and its slope there
/// averages out; what the readings scatter about their mean is left to the one who counts
/// it, with the model taken off (E-19).
struct FoldedReadings {
  std::vector<Reading> means;   ///< travel within a turn of the feed
  std::vector<double> count;    ///< of readings in each, shape (means)
  std::vector<std::size_t> of;  ///< which mean a reading is in, shape (readings)
};

/// @brief Fold readings, where they are many.
///
/// @eq E-19 sum_i (e_i - f_i)^2 = sum_b n_b (e_b - f_b)^2 + sum_i (r_i - r_b)^2,
///          r_i = e_i - f_i, r_b its mean over a bin b
/// @src derived: the second sum hardly depends on what is fitted, and is taken once
/// @param model  of these readings
/// @return every reading by itself where they are few
FoldedReadings fold_readings(const Setting& setting, std::span<const Reading> readings,
                             const ToothModel& model);

}  // namespace trochoid::surface
