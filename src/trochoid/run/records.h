#pragma once

#include <trochoid/base/warning.h>
#include <trochoid/cases/case.h>
#include <trochoid/identification/find_axes.h>
#include <trochoid/signal/overview.h>
#include <trochoid/signal/record.h>

#include <string>
#include <vector>

namespace trochoid::run {

/// One measurement, read and laid over the spindle angle, its idle drift taken out.
struct MeasuredRun {
  std::string file;
  identification::ChannelRun run;
  bool by_time = false;            ///< its angles follow from its times
  double Omega = 0.0;              ///< found in the record, else as stated [rad/s]
  double Omega_se = 0.0;           ///< [rad/s]; 0: not estimated
  bool wanders = false;            ///< its speed, which was followed
  bool offset_taken_out = false;   ///< what the channels read where nothing cuts
  signal::Overview overview = {};  ///< of the whole record
  std::vector<std::vector<double>> further = {};  ///< channels beyond the third
  std::vector<double> further_offset_se = {};     ///< as of Run, of these channels
};

/// @brief Why a record without all three channels cannot be used with the dynamometer of a
/// case; empty: it can.
std::string missing_channel(const signal::Record& record, const cases::Case& given);

/// @brief Read all measurements of a case.
/// @param[out] warnings  what was found out about the records
/// @return one a measurement
/// @throws base::InputError with the problems of all files
std::vector<MeasuredRun> measured_runs(const cases::Case& given,
                                       std::vector<base::Warning>& warnings);

/// Their channels alone.
std::vector<identification::ChannelRun> channels_of(
    const std::vector<MeasuredRun>& measured);

/// @brief What a record holds, for a person, in a few lines: samples, duration, rate,
/// revolutions, the columns used and their ranges, and which part of it cuts.
std::string describe_record(const signal::Record& record,
                            const cases::Measurement& measurement);

}  // namespace trochoid::run
