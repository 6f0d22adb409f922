#pragma once

#include <trochoid/dynamics/directional.h>
#include <trochoid/dynamics/system.h>

#include <array>
#include <cstddef>
#include <span>
#include <vector>

/// How a period of cutting is cut up, and where each delayed motion was.
namespace trochoid::dynamics {

/// @brief Directions of the modes in the components of q: one where all modes move
/// along one line, else x and y.
struct Components {
  std::size_t count = 2;
  double x = 1.0;  ///< of the only component
  double y = 0.0;
  std::vector<std::array<double, 2>> modes;

  [[nodiscard]] Matrix2 of(const Matrix2& A) const noexcept;
};

Components components_of(const System& system);

/// Frequency of the fastest mode [Hz].
double fastest_frequency(const System& system) noexcept;

/// Where a delayed node was, and how to interpolate there.
struct Source {
  std::size_t element = 0;
  bool previous = false;    ///< in the period before
  std::vector<double> row;  ///< empty: at the node of the same number
};

/// Matrices of one channel of D-8 at the nodes of an element, in the components of q.
struct Channel {
  /// Shape (components, components, nodes); empty: zero.
  std::vector<double> matrices;
  std::vector<Source> sources;  ///< of a delay; shape (nodes), or one for all of them
};

/// A part of a period in which all is smooth.
struct PeriodElement {
  double from = 0.0;  ///< spindle angle [rad]
  double to = 0.0;    ///< [rad]
  int degree = 0;
  bool forced = false;    ///< something cuts
  bool kept = false;      ///< its q is part of a disturbance: a later period needs it
  bool wanted = false;    ///< its q is needed at all
  std::size_t first = 0;  ///< place of its q in a disturbance
  std::size_t place = 0;  ///< place of its q among those of the period
  Channel own;
  Channel damping;  ///< of D-30: on dq/dphi [N]
  std::vector<Channel> delayed;
  std::vector<std::array<double, 2>> normal;  ///< n of D-15 at the nodes; or empty
  std::vector<std::array<double, 2>> push;    ///< u of D-15

  [[nodiscard]] std::size_t nodes() const noexcept {
    return static_cast<std::size_t>(degree) + 1;
  }
};

/// How finely a period is resolved.
struct Resolution {
  double factor = 1.0;        ///< of the number of nodes
  bool whole_period = false;  ///< every q is part of a disturbance
};

/// @brief One period in elements.
struct PeriodElements {
  std::vector<PeriodElement> all;
  std::size_t pitches = 0;        ///< of equal elements; 0: delays do not lead to nodes
  std::size_t components = 2;     ///< of motion and force at a node
  std::size_t kept_values = 0;    ///< in a disturbance
  std::size_t wanted_values = 0;  ///< in a period
};

/// @param Omega    spindle speed [rad/s], positive
/// @param fastest  frequency [Hz]
PeriodElements period_elements(const Directional& directional,
                               const Components& components, double Omega,
                               double fastest, const Resolution& resolution);

}  // namespace trochoid::dynamics
