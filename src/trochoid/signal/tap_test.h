#pragma once

#include <complex>
#include <string>
#include <string_view>
#include <vector>

/// From blows of an instrumented hammer in time to a frequency response.
namespace trochoid::signal {

/// Force of the hammer and what a sensor shows, sample by sample, in SI.
struct TapRecord {
  double sample_rate = 0.0;      ///< [Hz]
  std::vector<double> force;     ///< [N], shape (n)
  std::vector<double> response;  ///< displacement, velocity or acceleration, shape (n)
};

enum class FrfEstimator {
  H1,  ///< noise of the response averages out
  H2,  ///< noise of the force does
};

/// The names that files use.
constexpr std::string_view name_of(FrfEstimator estimator) noexcept {
  switch (estimator) {
    case FrfEstimator::H1:
      return "H1";
    case FrfEstimator::H2:
      return "H2";
  }
  return {};
}

struct TapOptions {
  FrfEstimator estimator = FrfEstimator::H1;
  double block = 0.0;  ///< what is taken after each hit [s]; 0: chosen
  /// What the exponential window leaves at the end of a block, in (0, 1]; 0: chosen, and
  /// 1 (no window) where the response has died out by itself.
  double window_end = 0.0;
};

struct TapHit {
  double time = 0.0;  ///< of the beginning of its pulse [s]
  double peak = 0.0;  ///< of the force [N]
  std::string fault;  ///< why it is left out; empty: it is used
};

struct TapResponse {
  std::string fault;  ///< why there is none; empty: there is one
  std::vector<TapHit> hits;
  std::vector<double> omega;            ///< [rad/s], up to what the hammer excites
  std::vector<std::complex<double>> H;  ///< response over force
  std::vector<double> coherence;        ///< empty after a single hit
  double block = 0.0;                   ///< [s]
  double window_end = 1.0;
  double noise_bandwidth = 1.0;  ///< lines over which the window spreads noise (M-23)
  double decay = 0.0;            ///< a of the exponential window e^{-a t} [1/s]
  double excited = 0.0;  ///< up to where the force is within 20 dB of its most [rad/s]
};

/// @brief The frequency response of a record of hammer blows.
///
/// @eq  M-20  H1 = sum X F*/sum |F|^2,  H2 = sum |X|^2/sum F X*,  coherence = |sum X F*|^2
///            /(sum |F|^2 sum |X|^2) over the hits
/// @eq  M-21  both channels times e^{-a t} from the hit on: H(i omega + a) is measured
/// @eq  M-23  noise bandwidth of the window, in lines = (aT/2) (1 - e^{-2aT})/(1 -
///            e^{-aT})^2: so many lines share their noise
/// @src derived: least squares of either channel over the hits; the shift of the Laplace
///      transform
///
/// A hit is left out, with the reason, where the hammer strikes again in its block, where
/// a channel is cut off at its limits, and where the record ends too soon. After its pulse
/// the force is set to zero (force window).
/// @throws std::invalid_argument when the channels differ in length, or without a rate
TapResponse frequency_response(const TapRecord& record, const TapOptions& options);

}  // namespace trochoid::signal
