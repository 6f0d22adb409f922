#pragma once

#include <vector>

namespace trochoid::geometry {

/// from, from + step, ... below to.
inline std::vector<double> steps(double from, double to, double step) {
  std::vector<double> out;
  for (int i = 0; from + i * step < to; ++i) out.push_back(from + i * step);
  return out;
}

}  // namespace trochoid::geometry
