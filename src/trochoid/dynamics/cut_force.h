#pragma once

#include <trochoid/dynamics/engaged_grid.h>
#include <trochoid/force/law.h>

#include <array>
#include <span>
#include <utility>
#include <vector>

namespace trochoid::dynamics {

/// q of the steps up to now; index 0 is the step in question, -n the n-th before.
struct History {
  const double* x = nullptr;
  const double* y = nullptr;
};

/// @brief Force of the contacts of a node, whatever q is at that moment.
///
/// The marks of earlier teeth are met once a step: h = constant + q . n for each
/// contact.
class CutForce {
 public:
  CutForce(const force::Law& law, const EngagedGrid& grid);

  void prepare(const Contacts& contacts, const History& past);
  /// @return force on the tool [N] for the contacts prepared
  [[nodiscard]] std::array<double, 3> force(double q_x, double q_y) const noexcept;
  /// @return tooth and chip [m] of the contacts of the lowest slice
  [[nodiscard]] std::vector<std::pair<std::size_t, double>> chips(double q_x,
                                                                  double q_y) const;

  std::array<double, 3> at(const Contacts& contacts, const History& past, double q_x,
                           double q_y) {
    prepare(contacts, past);
    return force(q_x, q_y);
  }

 private:
  force::Law law_;
  const EngagedGrid& grid_;
  Contacts contacts_;
  std::vector<double> constant_;
};

}  // namespace trochoid::dynamics
