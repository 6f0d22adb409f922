#pragma once

#include <trochoid/chip/model.h>
#include <trochoid/geometry/cut.h>
#include <trochoid/geometry/cutter.h>
#include <trochoid/geometry/runout.h>

#include <memory_resource>
#include <span>
#include <vector>

namespace trochoid::chip {

/// h at or below this is not in cut [m]: a million times the rounding of h.
inline constexpr double h_threshold = 1e-15;

/// @brief What all slices of a cut share: who
/// passes after whom, how fast, through what.
///
/// @eq C-1 f_m = f (sum of the last m pitches) / 2 pi
/// @src [riviere2009] eq. 3 to 5, for unequal pitch
struct Passage {
  ChipModel model;
  geometry::Band stock;
  double feed = 0.0;  ///< of the tool per angle, f / 2 pi [m/rad]
  int teeth = 0;
  int marks = 0;  ///< how many teeth before are looked at: 1 or all
  std::vector<double> back =
      {};                  ///< sum of the last m pitches [rad], shape (teeth, teeth)
  double curvature = 0.0;  ///< of the path, positive to the left [1/m]
  bool by_arcs = false;    ///< the stock is that of Slice::arcs
};

Passage passage(const geometry::Cutter& cutter, const geometry::Cut& cut,
                const ChipModel& model);

/// The teeth at one height of the cutter.
struct Slice {
  double r = 0.0;                                 ///< nominal radius [m]
  std::span<const geometry::EdgePosition> teeth;  ///< shape (teeth)
  double shift = 0.0;  ///< of the axis in y, by deflection [m]
  bool bent = false;   ///< something gives: `radial` meets the stock by its own radius
  /// How much farther out on the ray the axis stands than when the mark of the m-th
  /// tooth before was left [m], shape (teeth), or empty: no deflection.
  std::span<const double> advance = {};
  /// Of each tooth the marks that can bound its chip, as near_marks has them; empty: any.
  std::span<const std::pmr::vector<int>> near = {};
  /// Where there is stock, if arcs say it, whatever bounds them.
  std::span<const geometry::EngagedArc> arcs = {};
};

/// @brief Chip at one edge point, and what bounds it.
///
/// While nothing else than theta or height changes, h is smooth
/// as long as `bounds` stays the same; Chip::margin says how far
/// from cutting or from leaving the cut we are.
struct Chip {
  double h = 0.0;       ///< along the horizontal ray [m]; 0 where not in cut
  double outer = 0.0;   ///< outer end of the chip on the ray [m]
  double margin = 0.0;  ///< outer minus inner bound [m]; negative: air
  int bounds = 0;       ///< which pair of bounds is the closest one
  bool in_cut = false;
};

/// Which tooth before left the inner end of a chip: 1 ... teeth; 0: the stock, or none.
int mark_of(const Chip& chip) noexcept;

/// Whether the outer end of a chip is the edge itself, not that of the stock.
bool ends_at_edge(const Chip& chip) noexcept;

/// @brief Uncut chip thickness along the horizontal ray.
///
/// @eq C-2 h = f_1 sin(theta)                             (none)
/// @eq C-3 h = min_m (f_m + R_j - R_k) sin(theta)         (feed)
/// @eq C-4 h = min_m (f_m sin(theta) + R_j - R_k)         (radial)
/// @eq C-7 h = length of [max(0, L_k), R_j] within the stock  (trochoidal)
/// @eq N-4 on a path of curvature kappa L_k is that of theta - kappa f_m/2 (trochoidal)
/// @src [riviere2009] eq. 1, 2, 6 to 13; min over m and the stock: derived
/// @param tooth  0-based
/// @param theta  nominal immersion angle [rad]
/// @note C-2 to C-4 are 0 unless sin(theta) > 0 and r cos(theta) lies in the stock; C-4
///       of a bent cutter unless R_j cos(theta) does.
Chip chip_at(const Passage& passage, const Slice& slice, int tooth,
             double theta) noexcept;

/// @brief Chip thickness over the mark of one earlier tooth alone, whatever the stock.
///
/// What min over m of C-2 to C-7 is taken of.
/// @param mark  m, from 1: how many teeth before
/// @return [m], may be negative; infinite where that tooth left no mark
double chip_over_mark(const Passage& passage, const Slice& slice, int tooth,
                      double theta, int mark) noexcept;

/// @brief A continuous function whose sign changes where the bounds change from those
/// of `a` to those of `b` (one of which is in cut).
double boundary(const Passage& passage, const Slice& slice, int tooth, double theta,
                const Chip& a, const Chip& b) noexcept;

}  // namespace trochoid::chip
