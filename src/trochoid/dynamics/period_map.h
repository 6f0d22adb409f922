#pragma once

#include <trochoid/dynamics/directional.h>
#include <trochoid/dynamics/period_elements.h>
#include <trochoid/dynamics/system.h>

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

namespace trochoid::dynamics {

/// @brief What one period of cutting makes of a small disturbance.
///
/// The period is cut into elements. In each, q at the nodes follows from the state of
/// the modes at its start and from the forces at its nodes, which depend on q there and
/// on q one delay before: interpolated on the element that held it.
///
/// @eq  D-11 (I - G A_0) q = sum over modes of (x, y) Phi state(a)
///           - G sum over d of A_d q(t - d),
///           G = sum over modes of (x, y)(x, y)^T and the kernels of D-4
/// @src derived: elements in time of [bayly2003], spectral as in [khasawneh2013], here
///      in integral form
class PeriodMap {
 public:
  /// @param Omega  spindle speed [rad/s], positive
  PeriodMap(const Directional& directional, const System& system, double Omega,
            const Resolution& resolution);
  ~PeriodMap();
  PeriodMap(PeriodMap&&) noexcept;
  PeriodMap& operator=(PeriodMap&&) noexcept;

  /// @brief The same cut with all forces times a factor of those given: what does not
  /// depend on them stays, and nothing is allocated.
  void scale_forces(double factor);

  /// @brief Length of a disturbance: q at the nodes that a later period needs, and the
  /// states at the end of the period.
  [[nodiscard]] std::size_t size() const noexcept;
  /// @param[in]  in   shape (size)
  /// @param[out] out  one period later, shape (size)
  void apply(std::span<const double> in, std::span<double> out);

  /// @brief What of a disturbance and its forces the nodes do not hold, estimated over
  /// the period that follows it.
  ///
  /// @eq  D-14 e = largest |c_(n-1)|, |c_n| of any element's q or force over their
  ///      largest values; c_k its Chebyshev coefficients
  /// @src derived
  [[nodiscard]] double unresolved(std::span<const double> in);
  /// Does every delay lead from a node to a node? Then no kink of the motion comes back
  /// inside an element.
  [[nodiscard]] bool smooth() const noexcept;

  /// A node of a disturbance.
  struct Node {
    double t = 0.0;         ///< since the start of the period [s]
    double weight = 0.0;    ///< of an integral over the period [s]
    std::size_t first = 0;  ///< place of its q in a disturbance
    std::size_t step = 0;   ///< from one component of q to the next
  };
  [[nodiscard]] std::vector<Node> disturbance_nodes() const;
  /// Numbers of a node: 1 where all modes move along one line, or where only the motion
  /// along a normal counts (not with `whole_period`), else 2.
  [[nodiscard]] std::size_t components() const noexcept;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace trochoid::dynamics
