#pragma once

#include <trochoid/numerics/parallel.h>

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

namespace trochoid::force {

/// Angles of a record, of which each turn has the same.
struct DifferentAngles {
  std::vector<double> phi;         ///< [rad]
  std::vector<std::size_t> place;  ///< which of them the i-th of the record is
};

/// @brief The different angles of a turn; turns repeat to the last digit.
DifferentAngles different_angles(std::span<const double> phi);

/// @brief Evaluate once for every angle of a turn, a few angles at a time, on several
/// threads.
/// @param evaluate     takes angles and the place of their values
/// @param[out] values  shape (phi)
template <class Value, class Evaluate>
void over_turns(std::span<const double> phi, std::span<Value> values,
                const Evaluate& evaluate) {
  constexpr std::size_t fewest = 8;
  constexpr std::size_t parts = 360;  // of a turn whose angles are close together
  const DifferentAngles different = different_angles(phi);
  const std::span<const double> angles = different.phi;
  const std::size_t few = std::max(fewest, angles.size() / parts);
  std::vector<Value> once(angles.size());
  numerics::for_each_index((angles.size() + few - 1) / few, [&](std::size_t k) {
    const std::size_t from = k * few;
    const auto some = angles.subspan(from, std::min(few, angles.size() - from));
    evaluate(some, std::span(once).subspan(from, some.size()));
  });
  std::ranges::transform(different.place, values.begin(),
                         [&](std::size_t i) { return once[i]; });
}

}  // namespace trochoid::force
