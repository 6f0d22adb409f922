#pragma once

#include <trochoid/dynamics/motion_problem.h>
#include <trochoid/dynamics/verdict.h>

#include <array>
#include <vector>

/// Amplitudes and frequencies of a motion that need not repeat.
namespace trochoid::dynamics {

/// Turns and samples a turn that tell the spectrum of a vibration; powers of two.
struct SpectrumSamples {
  int turns = 0;
  int per_turn = 0;
};

/// @brief As many as the slowest mode needs to be resolved and the fastest to be seen,
/// of the turns that there are.
SpectrumSamples spectrum_samples(const MotionProblem& problem, int turns_done);

/// @brief Spectrum of q over whole turns.
///
/// @eq T-13 A_k = 2 (a_k^2 + b_k^2)^(1/2), a, b the Fourier coefficients over K turns of
///          (q - mean) (1 - cos(2 pi t/T_K))/2
/// @src Hann window: [harris1978]; it halves the amplitude of a line
struct Spectrum {
  double step = 0.0;                             ///< from line to line [Hz]
  std::vector<std::array<double, 2>> amplitude;  ///< of x and y, from 0 Hz [m]
};

/// @param motion  its kept samples fill whole turns and are a power of two
Spectrum spectrum_of(const System& system, const Motion& motion);

/// @brief The peaks of a spectrum, strongest first.
///
/// @eq T-14 f = (k + d)/T_K, d = (2 r - 1)/(r + 1), r = A_(k+1)/A_k towards the larger
///          neighbour; A = A_k pi d (1 - d^2)/sin(pi d)
/// @src derived from the transform of the Hann window
/// @param spindle_frequency  turns in a second [Hz]
std::vector<VibrationLine> lines_of(const Spectrum& spectrum, double spindle_frequency);

}  // namespace trochoid::dynamics
