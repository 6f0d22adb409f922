#pragma once

#include <trochoid/base/estimate.h>
#include <trochoid/force/sensor.h>
#include <trochoid/identification/fit.h>

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace trochoid::identification {

/// @brief What is known of the coefficients of one group, the runout and the exponents,
/// whatever phases and channel offsets are: Fisher information in SI.
///
/// The order is that of parameter_names. An eccentricity counts by its components
/// e_x = rho cos(lambda), e_y = rho sin(lambda).
struct Information {
  std::size_t size = 0;
  std::vector<double> matrix;  ///< row-major, symmetric, shape (size, size)
};

/// Means of channels over a turn, as a power meter or a table of forces has them.
struct MeansOfChannels {
  force::Sensor sensor;
  std::vector<double> sd;  ///< of each mean [N, N m, W], above 0
};

/// A cut that may be measured, and what it would be fitted with.
struct Trial {
  force::Setup setup;  ///< with the cut and the runout, about which it is linear
  force::Law law;      ///< with its coefficients
  Options options;     ///< which unknowns there are, and the band
  int samples_per_turn = 360;
  double turns = 1.0;
  double noise = 1.0;  ///< standard deviation of a sample of each channel [N]
  std::array<bool, 3> measured = {true, true, true};  ///< of the force in x, y and z
  std::optional<MeansOfChannels> means = {};  ///< in place of a record of forces
};

/// Names as of the summary: coefficients, runout, exponents.
std::vector<std::string> parameter_names(const force::Setup& setup,
                                         const force::Law& law, const Options& options);

/// @brief What a record of a trial would tell.
///
/// @eq I-20 turns/s^2 (J^T J - J^T J_0 (J_0^T J_0)^-1 J_0^T J), J of one turn (I-4), J_0 its
///          columns of phase and channel constants
/// @eq I-30 of means: sum over the channels of c c^T/sd^2, c what a channel reads for
///          coefficients of 1 (F-31, F-32); nothing of the runout
/// @src derived from I-4; Fisher information of white noise, standard
Information information_of(const Trial& trial);

/// @brief What is known beforehand, as a prior has it: 1/sd^2 of each coefficient.
/// @param prior  of each coefficient [SI]; empty: none
/// @param size   of the information
Information information_of(std::span<const std::optional<base::Normal>> prior,
                           std::size_t size);

/// @brief What records told, as their intervals have it: the inverse of their covariance
/// (I-4, I-13 to I-15). Where a parameter is not determined: J^T J over s^2, s that of I-4 times
/// the widening. Other groups, phases and channel offsets are taken out.
/// @param fit    of the same setup, law and runs; ok
/// @param group  place in fit.groups
Information information_of(const force::Setup& setup, const force::Law& law,
                           std::span<const Run> runs, const Fit& fit,
                           std::size_t group);

/// @brief Standard deviation of a sample that the intervals of a fit stand for [N].
double effective_noise(const Fit& fit, std::span<const Run> runs);

/// The sum: records are independent of one another. An empty one adds nothing.
Information sum(const Information& a, const Information& b);

/// @brief Standard error of one parameter, whatever the others are; nothing where it is
/// not determined.
std::optional<double> standard_error(const Information& known, std::size_t parameter);

/// @brief Standard error of a combination sum of gradient_i parameter_i.
/// @param parameters  shape of the gradient; the rest is unknown
std::optional<double> standard_error(const Information& known,
                                     std::span<const std::size_t> parameters,
                                     std::span<const double> gradient);

/// @brief Logarithm of the determinant of the covariance of some parameters; nothing
/// where some combination of them is not determined.
///
/// @eq I-21 1/det(I_qq - I_qo I_oo^-1 I_oq), q these, o all others: least for the cut that
///          is to be measured next
/// @src D_s-optimal design, standard
std::optional<double> log_determinant(const Information& known,
                                      std::span<const std::size_t> parameters);

}  // namespace trochoid::identification
