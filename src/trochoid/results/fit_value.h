#pragma once

#include <trochoid/results/channel_fit.h>
#include <trochoid/results/fields.h>

#include <trochoid/identification/identify.h>

#include <span>
#include <string>
#include <vector>

namespace trochoid::results {

/// A fit, and the records that it is of.
struct FitOfRecords {
  const identification::Fit& fit;
  std::span<const std::string> files = {};
  bool grouped = false;                 ///< a record names its group
  const SensorOfFit* sensor = nullptr;  ///< of a fit to its channels
};

/// @brief The keys of an entry of `fits`.
const Fields<FitOfRecords>& fit_fields();

/// A group of records.
struct GroupOfRecords {
  const identification::Fit& fit;
  std::size_t group = 0;
  std::span<const std::string> files;
};

/// @brief What each group found: its name, coefficients and files.
const Fields<GroupOfRecords>& group_fields();
std::vector<GroupOfRecords> groups_of(const FitOfRecords& fit);

}  // namespace trochoid::results
