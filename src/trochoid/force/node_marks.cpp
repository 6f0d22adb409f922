#include "node_marks.h"

#include <algorithm>

namespace trochoid::force {

bool NodeMarks::near_at_a_node(std::size_t mark) const noexcept {
  const double* h = over(mark);
  double nearest = h[0] - chips.least[0];
  for (std::size_t i = 1; i < rule.nodes; ++i) {
    nearest = std::min(nearest, h[i] - chips.least[i]);
  }
  return nearest <= slack;
}

/// A mark may be the closest between two nodes although it is so at neither: the closest
/// ones there lie above it where they change places.
bool NodeMarks::may_be_between(std::size_t mark,
                               std::span<const std::size_t> near) const noexcept {
  const double* h = over(mark);
  for (std::size_t i = 0; i + 1 < rule.nodes; ++i) {
    const bool below_another = std::ranges::any_of(near, [&](std::size_t k) {
      const double* other = over(k);
      const bool closest =
          other[i] == chips.least[i] || other[i + 1] == chips.least[i + 1];
      return closest && other[i] < h[i] - slack && other[i + 1] < h[i + 1] - slack;
    });
    if (!below_another) {
      return true;
    }
  }
  return false;
}

void NodeMarks::choose(std::vector<std::size_t>& marks) const {
  const std::size_t all = chips.over.size() / rule.width;
  marks.clear();
  for (std::size_t m = 0; m < all; ++m) {
    if (near_at_a_node(m)) {
      marks.push_back(m);
    }
  }
  const std::size_t near = marks.size();
  for (std::size_t m = 0; near > 1 && m < all; ++m) {
    if (std::ranges::find(marks, m) == marks.end() && may_be_between(m, marks)) {
      marks.push_back(m);
    }
  }
}

bool NodeMarks::leave_air(std::span<const std::size_t> marks) const noexcept {
  for (std::size_t i = 0; i + 1 < rule.nodes; ++i) {
    const bool air = std::ranges::any_of(marks, [&](std::size_t m) {
      return over(m)[i] < -slack && over(m)[i + 1] < -slack;
    });
    if (!air) {
      return false;
    }
  }
  return true;
}

}  // namespace trochoid::force
