#pragma once

#include <trochoid/results/answer.h>
#include <trochoid/surface/calibrate.h>
#include <trochoid/surface/trace_fit.h>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace trochoid::results {

/// @brief What a roughness trace tells of the teeth.
struct MeasuredTrace {
  std::string file;  ///< as the case names it
  surface::Trace trace;
  surface::TraceFit fit;
  std::vector<surface::FeedRoughness> feeds;  ///< the same teeth at other feeds
};

/// @brief What `calibrate` answers: coefficients and runout from a measured wall, or what
/// roughness traces tell of the teeth.
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
  std::vector<MeasuredTrace> traces;  ///< of a finish: all else is empty then
};

/// @brief `K_tc = 812 +- 40 MPa and K_rc = ... from 468 readings; runout ...`, and
/// whether to trust it; of an answer that is there, its warnings known.
std::string calibration_sentence(const CalibrateResult& result);

/// @brief How far teeth stand out by the first trace, in words.
std::string finish_sentence(const CalibrateResult& result);

Answer answer_of(const CalibrateResult& result);

}  // namespace trochoid::results
