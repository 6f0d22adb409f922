#pragma once

#include <trochoid/results/answer.h>
#include <trochoid/surface/calibrate.h>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace trochoid::results {

/// @brief What `calibrate` answers: coefficients and runout from a measured wall.
struct CalibrateResult {
  Heading heading;
  std::vector<surface::Reading> readings;  ///< of all files
  std::vector<surface::Datum> datum;       ///< what was estimated of each file
  std::size_t skipped = 0;                 ///< readings left out: without a value
  std::size_t repeats = 0;              ///< readings averaged with one of their place
  std::optional<double> repeatability;  ///< their standard deviation [m]
  surface::Calibration calibration;
  force::Law law;  ///< of the case: what the wall does not show is taken from it
  force::EdgeLength edge_length = force::EdgeLength::true_length;
  geometry::EccentricityOrder order = geometry::EccentricityOrder::exact;
  int teeth = 1;
};

/// @brief `K_tc = 812 +- 40 MPa and K_rc = ... from 468 readings; runout ...`, and
/// whether to trust it; of an answer that is there, its warnings known.
std::string calibration_sentence(const CalibrateResult& result);

Answer answer_of(const CalibrateResult& result);

}  // namespace trochoid::results
