#pragma once

#include <trochoid/identification/identify.h>

#include <array>
#include <span>
#include <string>

namespace trochoid::run {

/// A coefficient as files name it.
struct CoefficientName {
  const char* key;
  double unit;  ///< of the key [SI]
};

/// Names in the order of force::coefficients.
std::span<const CoefficientName> coefficient_names(const force::Law& law);

inline constexpr std::array<const char*, 3> exponent_names = {"m_t", "m_r", "m_a"};

/// Whether a fit says of a quantity, by its name in files, that it has no value.
bool unidentifiable(const identification::Fit& fit, const std::string& name);

}  // namespace trochoid::run
