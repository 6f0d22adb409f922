#pragma once

#include <trochoid/surface/joint_fit.h>
#include <trochoid/surface/ways.h>

#include <span>

namespace trochoid::surface {

/// @brief Everything that explanations are tried on.
struct Given {
  const Setting& setting;
  std::span<const Reading> readings;
  std::span<const Datum> datum;
  const ModelFits& found;
  const RunoutFit& runout;
};

/// @brief One explanation as it was fitted.
struct Tried {
  Explanation what;
  Way way;
  DatumColumns form;  ///< of every reading
  RowFit fit;
};

/// @brief The answer of all explanations together (E-24).
/// @param tried  likeliest first, not empty, their weights set
JointFit together(const Given& wall, const Scatter& scatter,
                  std::span<const Tried> tried);

}  // namespace trochoid::surface
