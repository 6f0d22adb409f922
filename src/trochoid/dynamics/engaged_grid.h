#pragma once

#include <trochoid/force/setup.h>

#include <cstddef>
#include <vector>

namespace trochoid::dynamics {

/// A slice of a tooth in cut, at one angle.
struct Contact {
  double sine = 0.0;  ///< of the effective immersion angle
  double cosine = 0.0;
  double width = 0.0;  ///< height of the slice [m]
  double edge = 0.0;   ///< length of its edge [m]
  std::size_t tooth = 0;
  std::size_t marks = 0;  ///< where its marks begin in EngagedGrid::above
};

/// Contacts from first to last, excluded.
struct Contacts {
  std::size_t first = 0;
  std::size_t last = 0;
};

/// @brief The cut over one revolution at fixed angles, apart from vibration.
///
/// The nodes repeat with every pitch, so that delays by whole teeth are whole numbers
/// of steps. Where a tip enters or leaves the stock there is a node, with the contacts
/// just before and just after it: the force jumps there.
///
/// @eq T-1 h_j = max(0, min_m [a_jm(phi) + (q(t) - q(t - t_m)) . n_j]), n = (sin, cos);
///         a_jm: chip over the mark of the m-th tooth before, without vibration
/// @src [diez2010] eq. 14 with the memory of the surface; derived from C-2 to C-7
struct EngagedGrid {
  std::size_t lookback = 0;   ///< how many teeth before are looked at
  std::size_t nodes = 0;      ///< of one pitch
  std::vector<double> angle;  ///< of the nodes of a revolution, from 0 [rad]
  std::vector<double> step;   ///< from each node of a pitch to the next [rad]
  std::vector<Contact> contacts;
  std::vector<double> above;     ///< a_jm [m], lookback values for each contact
  std::vector<Contacts> before;  ///< of the nodes of a revolution
  std::vector<Contacts> after;
  std::vector<bool> jump;  ///< do they differ?
};

struct GridOptions {
  int steps_per_tooth = 1000;  ///< at least; entries and exits add some
  int slices = 1;              ///< over the axial depth; helix needs many
  int lookback = 0;            ///< 0: twice the number of teeth
};

/// @param setup  a cylinder of equal pitch
/// @throws std::invalid_argument for another cutter
EngagedGrid engaged_grid(const force::Setup& setup, const GridOptions& options);

}  // namespace trochoid::dynamics
