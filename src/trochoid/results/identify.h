#pragma once

#include <trochoid/force/sensor.h>
#include <trochoid/force/slice.h>
#include <trochoid/identification/channel_fit.h>
#include <trochoid/identification/clocking.h>
#include <trochoid/identification/find_axes.h>
#include <trochoid/identification/identify.h>
#include <trochoid/identification/runout_form.h>
#include <trochoid/identification/systematic.h>
#include <trochoid/identification/views.h>
#include <trochoid/results/answer.h>
#include <trochoid/signal/overview.h>
#include <trochoid/signal/revolutions.h>

#include <optional>
#include <string>
#include <vector>

namespace trochoid::results {

/// What was found in one record before anything was fitted.
struct RecordSummary {
  std::string file;
  std::size_t samples = 0;
  double Omega = 0.0;         ///< spindle speed found, else as stated [rad/s]
  double Omega_se = 0.0;      ///< [rad/s]; 0: not estimated
  double stated_Omega = 0.0;  ///< [rad/s]
};

/// Root mean square residuals over the offset of tooth 2.
struct OffsetSweep {
  std::vector<double> offset;  ///< [m]
  struct Curve {
    chip::Model model = chip::Model::none;
    std::vector<double> rms;  ///< [N], shape of the offsets
  };
  std::vector<Curve> curves;  ///< one a fit
};

/// What an eccentricity means at the machine.
struct Clocking {
  identification::Offset present;
  double height = 0.0;    ///< above the tip [m], at which it is told
  int longest_tooth = 1;  ///< there
  /// With a previous clamping.
  std::optional<identification::Separation> separation;
};

/// @brief The channels, what they read, and what is said of them.
struct SensorOfFit {
  force::Sensor sensor;
  bool free = false;  ///< its angle was found
  std::vector<identification::ChannelData> data;
  std::vector<std::string> files;  ///< of each measurement; empty: means
};

/// @brief What `identify` answers: coefficients, runout and phase from measured forces.
struct IdentifyResult {
  Heading heading;
  std::vector<identification::Fit> fits;  ///< one a chip model, as they were asked for
  std::optional<std::size_t> chosen;      ///< the fit that counts; none: no answer
  /// What speaks against using the chosen numbers at all; empty: nothing.
  std::vector<std::string> reasons_against;
  /// Why the chosen numbers are to be used with care; empty: no reason seen.
  std::vector<std::string> reasons_for_care;
  /// What other bands, or a rigid dynamometer, would answer; empty: nothing else to see.
  std::vector<identification::View> views;
  std::optional<identification::RunoutForm> runout_form;  ///< where one was searched
  /// What no interval of the chosen fit holds; empty: not looked at.
  std::vector<identification::SystematicEffect> not_in_intervals;
  std::vector<RecordSummary> records;  ///< empty where they could not be used
  signal::Matrix3 channels{};          ///< channels = matrix times force on the tool
  /// Where the channels were fitted as they are, instead of forces in x, y, z.
  std::optional<SensorOfFit> sensor = {};
  std::optional<identification::AxesChoice> axes;  ///< where they were searched for
  std::vector<identification::Run> runs;           ///< measured force on the tool
  std::vector<signal::Overview> overviews;         ///< of the whole records
  /// Turns of each record laid over one another; fewer than two: nothing to lay.
  std::vector<signal::OneRevolution> folded;
  std::optional<OffsetSweep> sweep;
  bool whole_curves = false;              ///< asked for however long the records are
  std::optional<force::ChipCurve> curve;  ///< of the chosen fit
  std::vector<std::size_t> idle_teeth;    ///< that cut nothing, 0-based
  std::optional<Clocking> clocking;       ///< of its eccentricity, where it has one
  force::EdgeLength edge_length = force::EdgeLength::true_length;
};

/// @brief May the numbers be used, and why not: `Usable.`, `Usable with care: ...`,
/// `Do not use these numbers: ...`; of an answer that is there.
std::string identification_verdict(const IdentifyResult& result);

/// @brief The verdict, the two main coefficients and the runout with their intervals, and
/// how much of the force stays unexplained; of an answer that is there.
std::string identification_sentence(const IdentifyResult& result);

Answer answer_of(const IdentifyResult& result);

}  // namespace trochoid::results
