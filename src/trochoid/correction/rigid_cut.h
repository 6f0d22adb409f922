#pragma once

#include <trochoid/chip/chip.h>
#include <trochoid/chip/intervals.h>
#include <trochoid/correction/periodic_motion.h>
#include <trochoid/force/law.h>
#include <trochoid/force/setup.h>

#include <array>
#include <span>
#include <vector>

namespace trochoid::correction {

/// @brief What a flute cuts in a turn.
///
/// Its force is the whole force on the tool while this tooth is the one nearest to the
/// middle of the arc of cut: what a dynamometer shows.
struct Flute {
  double peak_x = 0.0;        ///< largest |F_x| [N]
  double peak_y = 0.0;        ///< largest |F_y| [N]
  double peak_y_angle = 0.0;  ///< theta of the tooth there [rad]
  double own_peak_y = 0.0;    ///< largest |F_y| of this tooth alone [N]
  double chip_area = 0.0;     ///< integral of h over the angle, at the tip [m rad]
  double peak_chip = 0.0;     ///< thickest chip at the tip [m]
};

/// @brief dynamics::relative_difference of the peaks of |F_y|; 0 without force.
double peak_difference(std::span<const Flute> flutes);
/// @brief The same of the chip areas.
double area_difference(std::span<const Flute> flutes);

/// @brief Forces and chips over a turn, at equally spaced spindle angles from 0.
struct Prediction {
  std::vector<double> angle;                 ///< of the tip of tooth 1 [rad]
  std::vector<double> table;                 ///< X [m]
  std::vector<std::array<double, 3>> force;  ///< on the tool [N]
  /// Of each tooth, shape (teeth, angles).
  std::vector<std::vector<std::array<double, 3>>> flute_force;
  std::vector<std::vector<double>> chip;  ///< at the tip, shape (teeth, angles) [m]
  std::vector<Flute> flutes;
};

/// @brief A rigid tool in a table that moves along the feed.
///
/// @eq R-1 h_j = max(0, min_m [a_jm(phi) - (X(phi) - X(phi - back_jm)) sin(theta_j)]),
///         a_jm: chip over the mark of the m-th tooth before with the table at rest
/// @src [diez2010] eq. 1, 2 and 14 with the memory of the surface; T-1 with x = y = 0
/// @note Windows of cut are those of the nominal radius, as for all simple chips.
class RigidCut {
 public:
  /// @param setup   a cylinder; any pitch
  /// @param slices  over the axial depth; helix needs many
  /// @throws std::invalid_argument for another cutter, for depths, feeds and slices
  /// that are none, for offsets that are no numbers and for exponents of 1 or more
  RigidCut(const force::Setup& setup, const force::Law& law, int slices = 1);

  [[nodiscard]] int teeth() const noexcept;
  [[nodiscard]] const std::vector<double>& psi() const noexcept { return psi_; }
  [[nodiscard]] const std::vector<double>& pitch() const noexcept { return pitch_; }
  [[nodiscard]] double radius() const noexcept { return D_ / 2; }  ///< nominal [m]
  [[nodiscard]] double feed() const noexcept;                      ///< a turn [m]
  /// Where a tip enters and leaves the stock [rad].
  [[nodiscard]] chip::Arc arc() const noexcept { return arc_; }
  /// Offsets of the tips from the axis of rotation [m], mean 0.
  [[nodiscard]] std::vector<double> offsets() const;

  /// Thickest chip without runout: f_z times the largest sin(theta) of the arc [m].
  [[nodiscard]] double nominal_chip() const noexcept;
  /// Which tooth is the one nearest to the middle of the arc of cut.
  [[nodiscard]] std::size_t turn_of(double phi) const noexcept;

  /// Chip at the tip of a tooth, and whose mark bounds it.
  struct TipChip {
    double h = 0.0;       ///< [m]
    int mark = 0;         ///< teeth before; 0: not in cut
    double margin = 0.0;  ///< h, below 0 where the tooth passes above the mark [m];
                          ///< 0 outside of the stock
  };
  [[nodiscard]] TipChip chip(const PeriodicMotion& X, int tooth, double phi) const;

  /// Force on the tool [N].
  [[nodiscard]] std::array<double, 3> force(const PeriodicMotion& X, double phi) const;

  /// @brief Peaks of the flutes, their chip areas left out.
  [[nodiscard]] std::vector<Flute> peaks(const PeriodicMotion& X) const;
  /// @brief Peaks and chip areas.
  [[nodiscard]] std::vector<Flute> flutes(const PeriodicMotion& X) const;
  /// @param samples  of a turn
  [[nodiscard]] Prediction predict(const PeriodicMotion& X, int samples) const;

 private:
  struct Disk {
    double lag = 0.0;
    double width = 0.0;
    double dS = 0.0;  ///< edge length per height
    std::vector<geometry::EdgePosition> teeth;
  };
  struct Contact {
    double h = 0.0;
    int mark = 0;
    double margin = 0.0;
    double theta = 0.0;  ///< of the force, effective [rad]
  };
  struct Nodes;

  [[nodiscard]] std::array<double, 3> force_of_tooth(const PeriodicMotion& X,
                                                     std::size_t j, double phi) const;
  [[nodiscard]] Contact contact(const PeriodicMotion& X, const Disk& disk,
                                std::size_t j, double phi) const;
  void add_force(const Disk& disk, const Contact& c,
                 std::array<double, 3>& F) const noexcept;
  [[nodiscard]] std::vector<double> panels(const PeriodicMotion& X) const;
  [[nodiscard]] Nodes nodes(const PeriodicMotion& X) const;
  [[nodiscard]] double chip_area(const PeriodicMotion& X, std::size_t j,
                                 std::span<const double> panels) const;

  force::Terms law_;
  double D_ = 0.0;
  chip::Passage passage_;
  std::vector<double> psi_;
  std::vector<double> pitch_;
  std::vector<Disk> disks_;
  chip::Arc arc_;
};

/// @brief Largest |F_y| of measured forces while each tooth is the one nearest to the
/// middle of the arc of cut [N].
/// @param angle   recorded [rad], shape (n)
/// @param force   on the tool [N], shape (n)
/// @param offset  true angle minus the recorded one [rad]
/// @return shape (teeth)
std::vector<double> peaks_of_turns(const RigidCut& cut, std::span<const double> angle,
                                   std::span<const std::array<double, 3>> force,
                                   double offset = 0.0);

/// @brief By how much each tooth cuts more than its share of the feed: rho_j -
/// rho_(j-1), cyclic [m].
/// @param rho  offset of each tooth [m]
std::vector<double> chip_differences(std::span<const double> rho);

}  // namespace trochoid::correction
