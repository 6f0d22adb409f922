#pragma once

#include <cmath>
#include <complex>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace trochoid::structure {

/// What moves, over the force that moves it.
enum class ResponseKind {
  receptance,   ///< displacement over force [m/N]
  mobility,     ///< velocity over force [m/(s N)]
  accelerance,  ///< acceleration over force [m/(s^2 N)]
};

/// As files spell it.
constexpr std::string_view name_of(ResponseKind kind) noexcept {
  switch (kind) {
    case ResponseKind::receptance:
      return "receptance";
    case ResponseKind::mobility:
      return "mobility";
    case ResponseKind::accelerance:
      return "accelerance";
  }
  return {};
}

/// The unit of a response, for people.
constexpr std::string_view unit_of(ResponseKind kind) noexcept {
  switch (kind) {
    case ResponseKind::receptance:
      return "m/N";
    case ResponseKind::mobility:
      return "m/s/N";
    case ResponseKind::accelerance:
      return "m/s^2/N";
  }
  return {};
}

/// The unit of a response as the end of a name in files.
constexpr std::string_view unit_suffix(ResponseKind kind) noexcept {
  switch (kind) {
    case ResponseKind::receptance:
      return "m_per_N";
    case ResponseKind::mobility:
      return "m_per_s_N";
    case ResponseKind::accelerance:
      return "m_per_s2_N";
  }
  return {};
}

/// A measured frequency response, of one point to a force at that point.
struct FrequencyResponse {
  ResponseKind kind = ResponseKind::receptance;
  std::vector<double> omega;            ///< [rad/s], increasing, at least 0, shape (n)
  std::vector<std::complex<double>> H;  ///< in SI, shape (n)
  /// Over how many lines a window spreads the noise of one; 1: each has its own.
  double noise_bandwidth = 1.0;
  /// How many lines each is the mean of; empty: each stands for itself.
  std::vector<double> averaged = {};

  /// By how much the scatter of a line is below that of one measured line.
  [[nodiscard]] double calmer(std::size_t line) const {
    return averaged.empty() ? 1.0 : std::sqrt(averaged[line]);
  }
};

/// A response of a structure in one direction to a force in another or the same.
struct DirectedResponse {
  std::size_t motion = 0;  ///< direction that was measured, from 0
  std::size_t force = 0;   ///< direction of the force
  FrequencyResponse response;
  double decay = 0.0;  ///< a of an exponential window e^{-a t} [1/s]: M-22
  std::string name;    ///< for messages, like "xy"

  [[nodiscard]] bool direct() const noexcept { return motion == force; }
};

/// @brief What a receptance is multiplied with.
/// @eq  M-4  H_v = i omega H,  H_a = -omega^2 H
/// @src derived: time derivatives of e^{i omega t}
inline std::complex<double> factor(ResponseKind kind, double omega) noexcept {
  switch (kind) {
    case ResponseKind::mobility:
      return {0.0, omega};
    case ResponseKind::accelerance:
      return {-omega * omega, 0.0};
    case ResponseKind::receptance:
      break;
  }
  return {1.0, 0.0};
}

}  // namespace trochoid::structure
