#pragma once

#include "node_kernel.h"

#include <span>
#include <vector>

namespace trochoid::force {

/// @brief Chips over all marks at the nodes of a panel: which marks count between them.
struct NodeMarks {
  const NodeChips& chips;
  const NodeRule& rule;
  double slack;  ///< how far a chip may bend between two nodes [m]

  /// @brief Marks that may be the closest somewhere on the panel.
  /// @param[out] marks  numbers from 0 on
  void choose(std::vector<std::size_t>& marks) const;

  /// @brief Whether one of the marks alone leaves nothing between any two neighbours.
  [[nodiscard]] bool leave_air(std::span<const std::size_t> marks) const noexcept;

 private:
  [[nodiscard]] const double* over(std::size_t mark) const noexcept {
    return &chips.over[mark * rule.width];
  }
  [[nodiscard]] bool near_at_a_node(std::size_t mark) const noexcept;
  [[nodiscard]] bool may_be_between(std::size_t mark,
                                    std::span<const std::size_t> near) const noexcept;
};

}  // namespace trochoid::force
