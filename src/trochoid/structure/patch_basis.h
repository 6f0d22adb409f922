#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace trochoid::structure {

/// @brief Bending shapes of a line that is cut into patches, clamped at its beginning.
///
/// On each patch: Legendre polynomials integrated twice, which leave value and slope
/// zero at both of its ends. At each node that is not clamped: one shape with value 1
/// and one with slope 1 there, cubic on the patches beside it. Together they span every
/// polynomial of the degree on each patch with value and slope continuous.
///
/// @eq  B-5  X_k'' = P_k(t), k = 2..degree-2;  X_v, X_s: cubic Hermite at a node
/// @src [wang2015] eq. (7), with a complete basis in place of its cosines
class PatchBasis {
 public:
  /// @param nodes   ends of the patches, ascending [m]
  /// @param degree  of the polynomials, at least 3
  /// @param clamped_end  whether the last node is clamped as the first one is
  PatchBasis(std::vector<double> nodes, std::size_t degree, bool clamped_end);

  [[nodiscard]] std::size_t size() const { return functions_.size(); }
  [[nodiscard]] const std::vector<double>& nodes() const { return nodes_; }

  /// @brief Integrals over the line of the p-th times the q-th derivatives, p, q <= 2.
  ///
  /// Exact: the functions are short sums of Legendre polynomials.
  /// @return row-major, shape (size, size); few entries are not 0
  [[nodiscard]] std::vector<double> gram(std::size_t p, std::size_t q) const;

  /// Values of all functions at a point of the line, shape (size).
  [[nodiscard]] std::vector<double> values(double x) const;

  /// Mean of each function between two points of the line, shape (size).
  [[nodiscard]] std::vector<double> means(double from, double to) const;

 private:
  /// What a function is on one patch: its derivatives 0, 1, 2 as sums of the Legendre
  /// polynomials first..first+4.
  struct Piece {
    std::size_t patch = 0;
    std::size_t first = 0;
    std::array<std::array<double, 5>, 3> c{};
  };
  using Function = std::vector<Piece>;

  [[nodiscard]] double length(std::size_t patch) const {
    return nodes_[patch + 1] - nodes_[patch];
  }
  [[nodiscard]] Piece bubble(std::size_t patch, std::size_t k) const;
  [[nodiscard]] Piece cubic(std::size_t patch, std::array<double, 4> c) const;
  void add_node(std::size_t node);

  std::vector<double> nodes_;
  std::size_t degree_ = 3;
  std::vector<Function> functions_;
};

}  // namespace trochoid::structure
