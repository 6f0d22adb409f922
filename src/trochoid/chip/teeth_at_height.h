#pragma once

#include <trochoid/chip/chip.h>
#include <trochoid/geometry/tooth_edges.h>

#include <cstddef>
#include <vector>

namespace trochoid::chip {

/// @brief Chips of teeth whose edges differ, at one height: a passage of those teeth alone
/// that are there.
///
/// A tooth that does not reach down to the height cuts nothing and leaves no mark, so that
/// the others cut with the feed of several teeth. Angles between teeth are those at this
/// height.
///
/// @eq C-20 back_jk = (omega_j(z'_j) - omega_k(z'_k)) mod 2 pi over the teeth that are
///         there, 2 pi for k = j; with it C-1 to C-7 at each height
/// @src derived
class TeethAtHeight {
 public:
  TeethAtHeight(const geometry::ToothEdges& edges, const Passage& passage);

  /// @brief Look at the height + beyond, with those teeth that are there.
  void stand_at(double height, double beyond = 0.0) noexcept;
  /// @brief The same, with the teeth that are said to be there: those of a zone.
  void stand_at(double height, double beyond, const std::vector<char>& there) noexcept;

  [[nodiscard]] bool there(std::size_t tooth) const noexcept {
    return place_[tooth] >= 0;
  }
  [[nodiscard]] const geometry::EdgeAt& edge(std::size_t tooth) const noexcept {
    return edge_[tooth];
  }
  /// @param theta  nominal immersion angle [rad]
  [[nodiscard]] Chip chip(std::size_t tooth, double theta) const noexcept;
  [[nodiscard]] double boundary(std::size_t tooth, double theta, const Chip& a,
                                const Chip& b) const noexcept;
  /// @brief The mark that reaches farthest out on the ray, whatever the stock: how many of
  /// all teeth before, teeth(): the tooth itself a turn ago.
  [[nodiscard]] int nearest_mark(std::size_t tooth, double theta) const noexcept;
  [[nodiscard]] std::size_t teeth() const noexcept { return edge_.size(); }

  /// The teeth that are there, in order of passage, as chips of alike teeth are asked for.
  [[nodiscard]] const Passage& passage() const noexcept { return passage_; }
  /// Which of them a tooth is; negative: not there.
  [[nodiscard]] int place(std::size_t tooth) const noexcept { return place_[tooth]; }
  [[nodiscard]] Slice slice(std::size_t tooth) const noexcept {
    return {edge_[tooth].r, positions_};
  }

 private:
  void order() noexcept;

  const geometry::ToothEdges& edges_;
  Passage passage_;
  int marks_;
  std::vector<geometry::EdgeAt> edge_;             ///< shape (teeth)
  std::vector<int> place_;                         ///< shape (teeth)
  std::vector<std::size_t> tooth_;                 ///< which are there
  std::vector<geometry::EdgePosition> positions_;  ///< of those
};

}  // namespace trochoid::chip
