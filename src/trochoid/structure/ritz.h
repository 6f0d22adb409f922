#pragma once

#include <trochoid/structure/patch_basis.h>

#include <memory>
#include <span>
#include <vector>

namespace trochoid::structure {

/// @brief The stiffness of a plate in products of line shapes, factored once.
///
/// For flexural rigidity 1, or one that changes from patch to patch in y. Few products of line shapes meet, so the matrix is sparse.
///
/// @eq  B-6  K = A22 x B00 + A00 x B22 + nu (A20 x B02 + A02 x B20)
///           + 2 (1-nu) A11 x B11,  A_pq = int X^(p) X^(q)' dx, B_pq the same in y
/// @src [wang2015] eq. (7)
class RitzSystem {
 public:
  /// @param rigidity  of the patches in y, as a part of the whole's; empty: all 1
  RitzSystem(PatchBasis x, PatchBasis y, double poisson_ratio,
             std::span<const double> rigidity = {});

  [[nodiscard]] const PatchBasis& x() const { return x_; }
  [[nodiscard]] const PatchBasis& y() const { return y_; }
  [[nodiscard]] std::size_t size() const { return x_.size() * y_.size(); }

  /// @brief L^-1 f for loads f = fx x fy, with K = L L^T.
  ///
  /// What the load f does at the place g is the product of their reduced vectors.
  /// @param fx  values of the shapes in x, shape (x().size())
  /// @param fy  of the shapes in y for each load, row-major, shape (m, y().size())
  /// @return row-major, shape (m, size())
  [[nodiscard]] std::vector<double> reduced(std::span<const double> fx,
                                            std::span<const double> fy) const;

 private:
  struct Factor;

  PatchBasis x_;
  PatchBasis y_;
  std::shared_ptr<const Factor> factor_;
};

/// @brief Products of every row of one set with every row of another.
/// @param a  row-major, shape (m, n)
/// @param b  row-major, shape (k, n)
/// @return row-major, shape (m, k)
std::vector<double> products(std::span<const double> a, std::span<const double> b,
                             std::size_t n);

}  // namespace trochoid::structure
