#pragma once

#include <trochoid/inputs/case.h>
#include <trochoid/signal/passes.h>
#include <trochoid/signal/record.h>

#include <span>
#include <string>
#include <vector>

namespace trochoid::run {

/// @brief Which part of a record is fitted.
struct UsedPart {
  signal::Part part;
  std::vector<signal::Part> air;  ///< where nothing cuts
  std::string why;                ///< one sentence for a person; empty: all is used
};

/// @brief The time that the case file states, or else the longest steady cut.
/// @param angle  [rad], shape (record); by the stated speed will do
/// @throws base::InputError where a time is stated that the record does not have
UsedPart used_part(const signal::Record& record, std::span<const double> angle,
                   const inputs::Measurement& measurement);

/// @brief Angle of the spindle, before its speed is known any better than stated.
std::vector<double> stated_angle(const signal::Record& record,
                                 const geometry::Cut& cut);

/// @brief Leave out of a record what is not in a part.
void keep_part(const signal::Part& part, signal::Record& record);

}  // namespace trochoid::run
