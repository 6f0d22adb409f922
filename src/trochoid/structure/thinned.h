#pragma once

#include <trochoid/structure/frequency_response.h>

#include <complex>
#include <cstddef>
#include <span>
#include <vector>

/// A response with as many lines as it needs.
namespace trochoid::structure {

/// @brief Scatter of lines one after the other, from fourth differences: a resonance with
/// several lines in it leaves little of them, and the median keeps peaks out.
/// @param H  of five lines at least; of fewer it is 0
double scatter_of_lines(std::span<const std::complex<double>> H);

/// @brief A response with fewer lines, where neighbours say the same.
///
/// @eq  M-35 parts of the band in which H is a parabola of omega, within a tolerance or the
///           scatter of its lines; in each three means of as many lines as keep the bias of
///           a mean below a fifth of its scatter
/// @src derived: the mean of a parabola over a part of width b is above its middle by
///      b^2 H''/24, and by a ninth of that over each third
///
/// Lines that share their noise are left as they are.
/// @param tolerance  of what a part is no parabola, relative to H
FrequencyResponse thinned(const FrequencyResponse& response, double tolerance);

/// What is thinned, and how far.
struct Thinning {
  std::size_t lines = 0;   ///< so many are few enough
  double tolerance = 0.0;  ///< as of thinned()
};
/// Of a search for number and start of modes, and of the last fit.
inline constexpr Thinning for_a_search{400, 0.1};
inline constexpr Thinning for_a_fit{3000, 0.005};

/// @brief Those of several responses that have too many lines; where the tolerance leaves
/// hardly any, with that of a fit, and else as they are.
std::vector<DirectedResponse> thinned(std::span<const DirectedResponse> all,
                                      Thinning enough);

/// Whether any of them has.
bool is_thinned(std::span<const DirectedResponse> all);

}  // namespace trochoid::structure
