#pragma once

#include <trochoid/surface/choices.h>

#include <cstddef>
#include <span>
#include <vector>

namespace trochoid::surface {

/// One measured point of a wall.
struct Reading {
  double x = 0.0;       ///< along the wall [m]
  double travel = 0.0;  ///< of the feed within the pass, from the phase on [m]
  double height = 0.0;  ///< above the tip [m]
  double error = 0.0;   ///< positive: material left [m]
  int tooth = -1;       ///< that made it, 0-based; -1: not known
  std::size_t set = 0;  ///< which measurement
};

/// @brief Readings that differ by the tooth only, as their mean.
struct Nominal {
  double x = 0.0;
  double travel = 0.0;  ///< quasi_static: within one tooth feed [m]
  double height = 0.0;
  double error = 0.0;  ///< mean [m]
  std::size_t set = 0;
  std::vector<std::size_t> readings;
  bool whole = true;  ///< as many of each tooth: runout drops out
};

/// @brief Nominal errors.
/// @eq E-11 e_N(k, h) = mean over g of e(x_k + g f_z, h), g over whole multiples of N
/// @src [wang2015] eq. 14 to 18
/// @param f_z  feed per tooth [m]
std::vector<Nominal> nominal_errors(std::span<const Reading> readings, Model model,
                                    double f_z, int teeth);

}  // namespace trochoid::surface
