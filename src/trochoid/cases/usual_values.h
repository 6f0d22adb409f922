#pragma once

#include <trochoid/cases/schema.h>

#include <span>
#include <string_view>

namespace trochoid::cases {

/// @brief What milling ordinarily has; beyond it a slip of the unit is likely.
struct UsualValue {
  std::string_view key;  ///< `table.key`
  Range range;           ///< in the unit of the key
};

/// @brief The one list of them, in the order of the case file.
std::span<const UsualValue> usual_values();

/// The same of a cut in proportion to the diameter.
inline constexpr double usual_feed_per_diameter = 0.08;  ///< feed per tooth, at most
inline constexpr double usual_depth_per_diameter = 5.0;  ///< axial depth, at most

/// @brief Of a path like `tool.teeth` or `measurement[1].cut.spindle_rpm`; null: none.
const Range* usual_range(std::string_view path);

}  // namespace trochoid::cases
