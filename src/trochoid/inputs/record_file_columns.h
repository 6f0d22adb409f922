#pragma once

#include <trochoid/inputs/case.h>
#include <trochoid/inputs/csv.h>
#include <trochoid/signal/record.h>

#include <array>
#include <optional>
#include <span>

namespace trochoid::inputs {

/// Where a quantity stands in every row.
struct RecordColumn {
  std::size_t index = 0;
  double factor = 1.0;  ///< from the unit of the file to SI
  std::string name;
};

struct RecordColumns {
  std::size_t count = 0;  ///< of a row
  std::array<std::optional<RecordColumn>, 3> force;
  std::optional<RecordColumn> time;
  std::optional<RecordColumn> angle;
};

/// The head of a record: the row of names and, if there is one, the row of units.
struct RecordHead {
  std::vector<Field> names;
  std::size_t names_line = 0;
  std::vector<Field> units;  ///< empty: no such row
  std::size_t units_line = 0;
};

/// @brief Whether a row below the names holds units: texts, and no number at all.
bool is_unit_row(std::span<const Field> row);

/// @brief Find forces, time and angle by name, and their units.
///
/// Names given in the case file must occur; else Fx, Fy, Fz (or channel1 .. channel3,
/// as `simulate` writes them), time or t, angle or phi are looked for, whatever the
/// case of their letters. The unit is part of the name (`Fx_N`, `Fx [kN]`, `Fy (N)`,
/// `Fz / N`) or stands in the row of units. Forces and time without a unit are taken
/// in N and s, with a note; an angle without a unit is refused.
/// @param[out] notes  what had to be assumed
RecordColumns find_columns(const RecordHead& head, const Measurement& measurement,
                           Problems& problems, std::vector<base::Warning>& notes);

}  // namespace trochoid::inputs
