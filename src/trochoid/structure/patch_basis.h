#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace trochoid::structure {

/// Which ends of a line are clamped: value and slope are zero there.
struct Clamps {
  bool start = true;
  bool end = true;
};

/// @brief Bending shapes of a line that is cut into patches.
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
  /// @param clamps  a node at an end that is not clamped has its two shapes as well
  PatchBasis(std::vector<double> nodes, std::size_t degree, Clamps clamps);

  [[nodiscard]] std::size_t size() const { return functions_.size(); }
  [[nodiscard]] const std::vector<double>& nodes() const { return nodes_; }

  /// @brief Integrals over the line of the p-th times the q-th derivatives, p, q <= 2.
  ///
  /// Exact: the functions are short sums of Legendre polynomials.
  /// @param weights  of the patches, shape (patches); empty: all 1
  /// @return row-major, shape (size, size); few entries are not 0
  [[nodiscard]] std::vector<double> gram(std::size_t p, std::size_t q,
                                         std::span<const double> weights = {}) const;

  /// Values of all functions at a point of the line, shape (size).
  [[nodiscard]] std::vector<double> values(double x) const { return at(x, 0); }

  /// Their first derivatives there, shape (size).
  [[nodiscard]] std::vector<double> slopes(double x) const { return at(x, 1); }

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
  [[nodiscard]] std::vector<double> at(double x, std::size_t derivative) const;

  std::vector<double> nodes_;
  std::size_t degree_ = 3;
  std::vector<Function> functions_;
};

}  // namespace trochoid::structure
