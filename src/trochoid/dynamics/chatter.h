#pragma once

#include <trochoid/dynamics/multiplier.h>

#include <complex>
#include <string_view>
#include <vector>

namespace trochoid::dynamics {

/// How a cut becomes unstable.
enum class Bifurcation {
  hopf,             ///< a vibration of its own frequency
  period_doubling,  ///< every second period alike
  period_one,       ///< every period alike
};

/// The names that files use.
constexpr std::string_view name_of(Bifurcation kind) noexcept {
  switch (kind) {
    case Bifurcation::hopf:
      return "hopf";
    case Bifurcation::period_doubling:
      return "period_doubling";
    case Bifurcation::period_one:
      return "period_one";
  }
  return {};
}

Bifurcation bifurcation_of(std::complex<double> multiplier) noexcept;

/// One line of the spectrum of a growing or decaying disturbance.
struct ChatterLine {
  double frequency = 0.0;  ///< [Hz]
  double share = 0.0;      ///< amplitude of q, of the strongest line
};

/// @brief With which frequencies the least stable disturbance vibrates.
///
/// @eq D-12 f_k = |arg(mu) + 2 pi k| / (2 pi P), P the period [s]; amplitude the k-th
///          Fourier coefficient of q(t) mu^(-t/P)
/// @src frequencies: [insperger2003]; how strong each is: [dombovari2010]
/// @param least  lines with less than this share are left out
/// @return strongest first
std::vector<ChatterLine> chatter_lines(const Directional& directional,
                                       const System& system, double Omega,
                                       double factor, double least);

}  // namespace trochoid::dynamics
