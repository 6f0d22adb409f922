#pragma once

#include <trochoid/results/columns.h>

#include <string>
#include <string_view>
#include <vector>

namespace trochoid::results {

/// @brief What a command writes: the keys under `result` of its summary.json and the
/// columns of its CSV files, as its answers are made of them.
struct Description {
  std::string_view command;
  std::vector<KeyText> keys;
  std::vector<ColumnText> columns;
};

Description description_of_simulate();
Description description_of_identify();
Description description_of_surface();
Description description_of_calibrate();
Description description_of_stability();
Description description_of_dynamics();
Description description_of_modes();
Description description_of_actuator();
Description description_of_correct();
Description description_of_plan();
Description description_of_wall_plan();
Description description_of_finish_plan();
Description description_of_program();
Description description_of_sweep();

/// @brief Of the commands that are described.
std::vector<Description> descriptions();

/// @brief docs/formats/results.md with the tables of what is described, each between two
/// marks of the page.
std::string page_with_descriptions(std::string page);

}  // namespace trochoid::results
