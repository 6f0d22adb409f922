#pragma once

#include <trochoid/files/csv_table.h>
#include <trochoid/files/record_source.h>
#include <trochoid/signal/record.h>

#include <optional>
#include <string_view>
#include <vector>

namespace trochoid::files {

struct RecordColumns {
  std::size_t count = 0;  ///< of a row
  /// Of each channel, three or more of them.
  std::vector<std::optional<TableColumn>> force;
  std::optional<TableColumn> time;
  std::optional<TableColumn> angle;
  std::optional<TableColumn> pulse;  ///< as it stands, in any unit
  std::optional<TableColumn> line;   ///< of an NC program
};

/// Whether a column is a force by the rules below, whatever its unit.
bool names_force(std::string_view name);

/// @brief Find forces, time and angle by name, and their units.
///
/// Names given in the case file must occur; else Fx, Fy, Fz (or channel1 .. channel3,
/// as `simulate` writes them), or what else the channels read, time or t, angle or phi are looked for, whatever the
/// case of their letters. The unit is part of the name (`Fx_N`, `Fx [kN]`, `Fy (N)`,
/// `Fz / N`) or stands in the row of units. Forces and time without a unit are taken
/// in N and s, with a note; an angle without a unit is refused. Where the case file gives
/// `scale`, the unit of a force is not looked at. A force that no column is named after was
/// not measured, with a note; one that the case file leaves empty, without.
/// @param[out] notes  what had to be assumed
RecordColumns find_columns(const TableHead& head, const RecordSource& source,
                           Problems& problems, std::vector<base::Warning>& notes);

/// @brief Take down which channels a record has, and their names.
void keep_channels(const RecordColumns& columns, signal::Record& record);

}  // namespace trochoid::files
