#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

/// What the motion of a cut comes to: it repeats, it stays within bounds, or it grows.
namespace trochoid::dynamics {

/// @brief A motion that repeats.
struct Periodic {
  int passes = 1;         ///< teeth that pass until the motion is as it was
  int passes_of_cut = 1;  ///< until the cut without vibration is: 1, or all teeth

  /// Chatter with a period of its own, a multiple of that of the cut.
  [[nodiscard]] bool several_periods() const noexcept { return passes > passes_of_cut; }
};

/// One line of the spectrum of a vibration.
struct VibrationLine {
  double frequency = 0.0;             ///< [Hz]
  std::array<double, 2> amplitude{};  ///< of q_x and q_y [m]
  int harmonic = 0;                   ///< of the spindle; 0: a frequency of its own
};

/// @brief A motion that does not repeat, and stays within bounds.
struct Bounded {
  bool fades = false;                 ///< less and less: transients die out
  std::array<double, 2> amplitude{};  ///< half of what q_x, q_y cover [m]
  int turns = 0;                      ///< last ones in which that was looked at
  std::vector<VibrationLine> lines;   ///< strongest first; none while it fades
  double spectrum_step = 0.0;         ///< [Hz]
  /// Amplitudes of q_x and q_y, from 0 Hz [m].
  std::vector<std::array<double, 2>> spectrum;
};

/// @brief A motion that grows, or has run away.
struct Growing {
  std::optional<double> per_turn;  ///< growth of the vibration in a turn, where seen
};

/// What a motion comes to.
using Verdict = std::variant<Periodic, Bounded, Growing>;

/// The names that files use.
constexpr std::string_view name_of(const Periodic& /*verdict*/) noexcept {
  return "periodic";
}
constexpr std::string_view name_of(const Bounded& /*verdict*/) noexcept {
  return "bounded";
}
constexpr std::string_view name_of(const Growing& /*verdict*/) noexcept {
  return "growing";
}
constexpr std::string_view name_of(const Verdict& verdict) {
  return std::visit([](const auto& v) { return name_of(v); }, verdict);
}

/// Is there a vibration that the cut feeds itself?
bool chatters(const Verdict& verdict) noexcept;

/// @brief "with every tooth", "every 2 teeth", "with every turn", "every 3 turns".
/// @param teeth  of the cutter
std::string period_text(const Periodic& periodic, std::size_t teeth);

/// The strongest line that is no harmonic of the spindle; null: there is none.
const VibrationLine* chatter_line(const Bounded& bounded) noexcept;

}  // namespace trochoid::dynamics
