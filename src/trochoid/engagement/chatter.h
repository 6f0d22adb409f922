#pragma once

#include <trochoid/base/stop.h>
#include <trochoid/dynamics/system.h>
#include <trochoid/engagement/steps.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <vector>

/// Whether the cuts along a program chatter.
namespace trochoid::engagement {

/// What vibrates with a tool, in the axes of the program.
struct Vibration {
  dynamics::System system;   ///< without modes: nothing is known
  double chip_floor = 2e-6;  ///< as in StabilityOptions [m]
};

/// @brief A cut that many steps share, but for a degree of their arcs, a hundredth of the
/// diameter of their layers, 5 % of their feed and 5 degrees of its direction: the one that
/// most of their time has. Stock of more than three layers becomes three bands of one
/// height, with the arcs at their middles.
struct SharedCut {
  std::size_t tool = 0;    ///< of the job
  double spindle = 0.0;    ///< [rad/s]
  double f_z = 0.0;        ///< [m]
  double a_p = 0.0;        ///< up to where the stock reaches above the tip [m]
  double direction = 0.0;  ///< of the feed from +x [rad]
  std::vector<Layer> layers;
  double duration = 0.0;   ///< of all steps that share it [s]
  std::uint32_t line = 0;  ///< of the first of them
};

/// How a cut stands to chatter.
struct ChatterLimit {
  bool known = false;  ///< false: it was not looked at
  /// The height of stock next to that of the cut at which it begins; the upper arcs reach
  /// higher as it grows [m]. Nothing: none up to twice the height.
  std::optional<double> depth;
  double margin = 0.0;     ///< that height over the one of the cut, at most 2
  double frequency = 0.0;  ///< of the chatter there [Hz]
  std::optional<double>
      better_spindle;  ///< of a cut that chatters: nearest that does not [rad/s]
};

/// @brief The cuts of a program, as its steps come.
class SharedCuts {
 public:
  /// @param vibrations  of the tools, shape (tools)
  SharedCuts(std::span<const Tool> tools, std::span<const Vibration> vibrations);

  /// @brief Sort steps into cuts.
  /// @param[out] which  of each step: its cut; -1: in air, straight down, or nothing known
  void add(std::span<const Step> steps, std::vector<std::int32_t>& which);
  [[nodiscard]] const std::vector<SharedCut>& all() const noexcept { return cuts_; }

 private:
  std::span<const Tool> tools_;
  std::span<const Vibration> vibrations_;
  std::vector<SharedCut> cuts_;
  std::vector<double>
      leads_;  ///< time of the one that stands for a cut, less the others' [s]
  std::map<std::vector<std::int64_t>, std::int32_t> known_;
};

struct ChatterOptions {
  /// Cuts that are looked at: those of the longest time first.
  std::size_t most = 2500;
  base::Stop stop;  ///< cuts that have not begun by then are left out
  /// Told how much is done, from 0 to 1; by one thread at a time; may be empty.
  std::function<void(double share)> progress = {};
};

/// @brief Where each cut begins to chatter.
///
/// @eq  N-19 the limit: the depth d next to a_p with |mu(d)| = 1, of D-8 to D-14 with the
///           arcs of the cut, in the axes of its feed
/// @src derived
/// @return shape (cuts)
std::vector<ChatterLimit> chatter_limits(std::span<const SharedCut> cuts,
                                         std::span<const Tool> tools,
                                         std::span<const Vibration> vibrations,
                                         const ChatterOptions& options = {});

}  // namespace trochoid::engagement
