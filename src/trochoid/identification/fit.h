#pragma once

#include <trochoid/base/estimate.h>
#include <trochoid/base/stop.h>
#include <trochoid/force/setup.h>
#include <trochoid/identification/channel_report.h>
#include <trochoid/identification/response.h>

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace trochoid::identification {

/// One run of the tool, ready for the fit: force on the tool against the spindle angle.
struct Run {
  geometry::Cut cut;
  std::vector<double> angle;                 ///< recorded angle [rad], shape (n)
  std::vector<std::array<double, 3>> force;  ///< on the tool [N], shape (n)
  /// Runs of the same name share coefficients; all runs share the runout.
  std::string group = {};
  /// Whether the force in x, y and z was measured; what was not is no equation.
  std::array<bool, 3> measured = {true, true, true};
  /// Standard error of the speed by which the angles follow from times [rad/s]; 0: they
  /// were measured.
  double Omega_se = 0.0;
  /// Standard error of the offset that was taken out of each force [N].
  std::array<double, 3> offset_se{};
};

/// What is not searched is kept as the setup gives it: with `offsets` a given
/// eccentricity, with `eccentricity` given offsets.
enum class RunoutUnknowns {
  none,          ///< the tool runs true
  fixed,         ///< as given
  offsets,       ///< of teeth 2..N; the first is 0
  eccentricity,  ///< rho and lambda
  both,          ///< offsets and, besides, an eccentricity: told apart by the helix
};

/// Whether the offsets of the teeth are searched.
constexpr bool finds_offsets(RunoutUnknowns unknowns) noexcept {
  return unknowns == RunoutUnknowns::offsets || unknowns == RunoutUnknowns::both;
}

/// Whether an eccentricity is searched.
constexpr bool finds_eccentricity(RunoutUnknowns unknowns) noexcept {
  return unknowns == RunoutUnknowns::eccentricity || unknowns == RunoutUnknowns::both;
}

/// The names that files use.
constexpr std::string_view name_of(RunoutUnknowns unknowns) noexcept {
  switch (unknowns) {
    case RunoutUnknowns::none:
      return "none";
    case RunoutUnknowns::fixed:
      return "fixed";
    case RunoutUnknowns::offsets:
      return "offsets";
    case RunoutUnknowns::eccentricity:
      return "eccentricity";
    case RunoutUnknowns::both:
      return "both";
  }
  return {};
}

/// What standard errors and intervals count.
enum class Errors {
  automatic,  ///< correlated and repeating residuals, and how far the runs agree
  white,      ///< as if what is left were white noise
};

/// The names that files use.
constexpr std::string_view name_of(Errors errors) noexcept {
  switch (errors) {
    case Errors::automatic:
      return "auto";
    case Errors::white:
      return "white";
  }
  return {};
}

/// @brief By how much dynamometer and cut may be off what is stated, as standard deviations;
/// absent: it is in no interval.
struct Tolerances {
  std::optional<double> gain;          ///< of each reading, a part of it
  std::optional<double> turn;          ///< of the dynamometer about z [rad]
  std::optional<double> axial_depth;   ///< [m]
  std::optional<double> radial_depth;  ///< [m]
  std::optional<double> feed;          ///< per tooth [m]
};

/// Where to search first.
struct Start {
  geometry::Runout runout;
  std::vector<double> phase;  ///< [rad], one a run
  /// Of a fit of the same records: no tooth is looked for anywhere else.
  bool of_fit = false;
};

/// What is to be found, and how.
struct Options {
  chip::Model chip_model = chip::Model::trochoidal;
  RunoutUnknowns runout = RunoutUnknowns::offsets;
  std::optional<double> phase;  ///< [rad]; absent: free, one for each run
  int band_harmonics = 0;       ///< 0: all; n: mean and spindle harmonics 1..n only
  bool fit_channel_offsets = false;  ///< one constant and one slope a channel and run
  bool fit_exponents = true;         ///< of a Power law; false: as given
  Errors errors = Errors::automatic;
  Tolerances tolerances = {};
  /// What the dynamometer makes of the force, one a run; empty: it is rigid. With it the
  /// fit is by harmonics, up to the last one given.
  std::vector<Response> response = {};
  /// Of the dynamometer beside its `response`: found with the rest, from these values.
  Resonances resonances = {};
  /// Absent: the runout of the setup, where there is one, at any phase. Where it does not
  /// lead to a good fit nearby, everything is searched.
  std::optional<Start> start = std::nullopt;
  /// When late, a search is content with the best that it has; counts what it computes.
  base::Stop stop = {};
};

/// Part of a channel that is not force: constant +
/// slope (t - mean t)/(t_last - t_first).
struct ChannelOffset {
  double constant = 0.0;  ///< [N]
  double slope = 0.0;     ///< change from the first sample to the last [N]
};

/// How much of the measured force a fit does not explain, as parts of its RMS from 0
/// to 1. Constants and slopes of the channels, where they are fitted, are no force.
struct Unexplained {
  double in_band = 0.0;  ///< of the force within the band of the fit
  double all = 0.0;      ///< of the whole force, what lies outside of the band included
  double outside = 0.0;  ///< part of the force that lies outside of the band
  double correlation = 0.0;  ///< of neighbouring residuals, with a band limit as well
};

/// What an unknown of a fit is.
enum class FoundKind {
  coefficient,
  exponent,
  offset,
  eccentricity_x,
  eccentricity_y,
  axial_offset,
  tilt_x,  ///< tan of the tilt, along the tip of tooth 1
  tilt_y,
};

/// An unknown that has a value and an error.
struct Found {
  FoundKind kind = FoundKind::coefficient;
  /// Coefficient in the order of files, exponent of t, r, a, or tooth; from 0.
  std::size_t at = 0;
  std::size_t group = 0;  ///< of a coefficient
  double value = 0.0;     ///< [SI]
};

/// @brief Unknowns that were found together, phases and constants of channels left out.
struct FoundTogether {
  std::vector<Found> unknowns;
  std::vector<double> covariance;  ///< of the intervals [SI], row-major
};

/// The coefficients of runs that share them, in SI, in the order of force::coefficients.
struct Group {
  std::string name;
  std::vector<std::size_t> runs;  ///< places in the runs of the fit
  force::Law law;                 ///< with the values found
  std::vector<std::optional<Estimate>> coefficients = {};
};

/// @brief Result of one fit. Coefficients in SI, in the order of force::coefficients.
///
/// A quantity that is named in `unidentifiable` has no value: what stands for it in
/// `runout` or `phase` is one of the many possible values, good for `fitted` only.
struct Fit {
  bool ok = false;
  std::string message;  ///< when not ok, why there is no answer
  Options options;      ///< as asked for
  chip::ChipModel chip;
  force::Law law;  ///< with the values found; of several groups, of the first
  std::vector<std::optional<Estimate>> coefficients;  ///< of the same
  /// In the order in which the runs name them first; empty where there is no answer.
  std::vector<Group> groups;
  /// m_t, m_r, m_a of a Power law when they were fitted, else empty.
  std::vector<std::optional<Estimate>> exponents;
  geometry::Runout runout;
  /// [m], shape (teeth). Absent: given, the gauge of tooth 1, or not identifiable.
  std::vector<std::optional<double>> radial_offsets_se;
  std::optional<double> eccentricity_se;  ///< [m]
  std::optional<double> angle_se;         ///< [rad]
  /// Of e_x and e_y where both errors are known: xx, xy, yy [m^2], as I-4 has it.
  std::array<double, 3> eccentricity_covariance{};
  std::vector<double> phase;                    ///< [rad], one a run
  std::vector<std::optional<double>> phase_se;  ///< [rad]; absent: given, or as above
  std::vector<std::array<ChannelOffset, 3>> channel_offsets;  ///< one a run, or empty
  double rms = 0.0;                                           ///< [N], I-5
  std::array<double, 3> rms_axis{};                           ///< [N]
  std::array<bool, 3> measured = {true, true, true};  ///< in x, y, z, by any run
  double condition = 0.0;                             ///< of [D], unit-norm columns
  int rank = 0;                  ///< of [D], channel columns included
  double freedom = 0.0;          ///< equations less unknowns
  double interval_factor = 0.0;  ///< half of a 95 % interval over its standard error
  /// Everything with an error that another cut shares: groups one after the other, then
  /// the runout, an eccentricity by its components, then exponents.
  FoundTogether found;
  /// Unidentifiable quantities, by name of the summary, and why.
  std::vector<std::pair<std::string, std::string>> unidentifiable;
  /// Runout that is found where a tooth just starts or stops cutting: a value without a
  /// standard error.
  std::vector<std::string> on_edge;
  /// Correlation of neighbouring residuals. 0 with a band limit, which correlates them by
  /// itself.
  double residual_correlation = 0.0;
  /// By how much the intervals of the coefficients are wider than white noise would make
  /// them: root mean square (I-13, I-14). The standard errors hold it.
  double widening = 1.0;
  /// What one more unknown explains by chance of the sum of squares [N^2], on average.
  double chance = 0.0;
  Unexplained unexplained;
  /// Of the dynamometer, in the axes of the tool, where they were found with the rest.
  Resonances resonances = {};
  /// Fitted force of each run with its channel offsets, shape (n).
  std::vector<std::vector<std::array<double, 3>>> fitted;
  std::optional<ChannelReport> channels;  ///< of a fit to the channels of a sensor
};

/// Whether a fit says of a quantity, by its name in files, that it has no value.
bool unidentifiable(const Fit& fit, const std::string& name);

/// A group for messages: its name in quotes, or that it has none.
std::string label_of_group(const std::string& name);

/// @brief What to judge one by one: the groups, or the coefficients of a fit without.
std::vector<Group> groups_of(const Fit& fit);

/// ` of "..."` where a fit has several groups, else nothing.
std::string of_group(const Fit& fit, const Group& group);

}  // namespace trochoid::identification
