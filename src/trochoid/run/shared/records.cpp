#include <trochoid/run/shared/records.h>

#include <trochoid/base/error.h>
#include <trochoid/base/units.h>
#include <trochoid/inputs/record_file.h>
#include <trochoid/signal/drift.h>
#include <trochoid/signal/revolutions.h>
#include <trochoid/signal/spindle_speed.h>

#include <fmt/core.h>

#include <cmath>

namespace trochoid::run {

namespace {

using Warnings = std::vector<base::Warning>;

/// A found speed that differs more than this from the stated one is worth a word.
constexpr double speed_slack = 1e-3;
/// Beyond this a percentage says less than a factor.
constexpr double far_off = 0.5;

std::vector<signal::Record> read_all(const inputs::Case& given) {
  std::vector<signal::Record> records;
  std::vector<std::string> problems;
  for (const inputs::Measurement& m : given.measurements) {
    try {
      records.push_back(inputs::read_record(m));
    } catch (const base::InputError& error) {
      problems.insert(problems.end(), error.problems().begin(), error.problems().end());
    }
  }
  if (!problems.empty()) {
    throw base::InputError(std::move(problems));
  }
  return records;
}

void compare_speed(const MeasuredRun& run, Warnings& warnings) {
  const double stated = run.run.cut.Omega;
  const double ratio = run.Omega / stated;
  const double off = std::abs(ratio - 1);
  if (off <= speed_slack) {
    return;
  }
  const std::string how_far = off < far_off
                                  ? fmt::format("{:+.2f} % off", 100 * (ratio - 1))
                                  : fmt::format("{:.3g} times", ratio);
  warnings.push_back(
      {"spindle_speed",
       fmt::format("{}: the record turns at {:.2f} rpm, {} the stated {:g} rpm. The "
                   "found speed is used.{}",
                   run.file, run.Omega / unit::rpm, how_far, stated / unit::rpm,
                   off < far_off ? ""
                                 : " Check spindle_rpm and the feed, or the times "
                                   "and angles of the record.")});
}

/// Angle and speed of a run.
void lay_over_angle(const signal::Record& record, int teeth, MeasuredRun& run,
                    Warnings& warnings) {
  std::vector<double>& angle = run.run.angle;
  run.Omega = run.run.cut.Omega;
  if (!record.angle.empty()) {
    angle = signal::unwrapped(record.angle);
    if (!record.time.empty() && record.time.back() > record.time.front()) {
      run.Omega =
          (angle.back() - angle.front()) / (record.time.back() - record.time.front());
      if (!(run.Omega > 0)) {
        throw base::InputError(
            {record.file +
             ": the spindle angle falls while the time rises; it must rise "
             "(if it was counted backwards, change its sign; two samples "
             "must lie less than half a turn apart)"});
      }
      compare_speed(run, warnings);
    }
    return;
  }
  run.by_time = true;
  const signal::SpeedEstimate found =
      signal::spindle_speed(record, {.Omega = run.Omega, .teeth = teeth});
  if (found.ok) {
    run.Omega = found.Omega;
    run.Omega_se = found.se;
    compare_speed(run, warnings);
  } else {
    warnings.push_back(
        {"spindle_speed_unknown", record.file + ": " + found.message +
                                      " The stated spindle speed is used as it is."});
  }
  angle = signal::angle_from_time(record.time, run.Omega);
}

void take_drift_out(MeasuredRun& measured, Warnings& warnings) {
  auto& [cut, angle, channel] = measured.run;
  const auto drift = signal::idle_drift(channel, angle);
  if (!drift) {
    warnings.push_back({"no_idle_part",
                        measured.file +
                            ": nothing in the record is free of cutting, so the offset "
                            "of the channels cannot be read off it; it is left in. "
                            "channel_offsets = \"fit\" estimates it with the rest."});
    return;
  }
  signal::remove_drift(channel, *drift);
  const auto [begin, end] = signal::steady_part(channel, angle);
  const auto cut_to = [begin = begin, end = end](std::vector<double>& v) {
    v = std::vector<double>(v.begin() + static_cast<std::ptrdiff_t>(begin),
                            v.begin() + static_cast<std::ptrdiff_t>(end));
  };
  cut_to(angle);
  for (std::vector<double>& values : channel) {
    cut_to(values);
  }
}

}  // namespace

std::vector<MeasuredRun> measured_runs(const inputs::Case& given, Warnings& warnings) {
  std::vector<signal::Record> records = read_all(given);
  std::vector<MeasuredRun> runs;
  for (std::size_t i = 0; i < records.size(); ++i) {
    signal::Record& record = records[i];
    MeasuredRun run{.file = record.file, .run = {.cut = given.measurements[i].cut}};
    for (const base::Warning& note : record.notes) {
      warnings.push_back({note.code, run.file + ": " + note.message});
    }
    lay_over_angle(record, given.setup.cutter.teeth(), run, warnings);
    run.run.channel = std::move(record.channel);
    if (given.identify.channel_offsets == inputs::ChannelOffset::idle) {
      take_drift_out(run, warnings);
    }
    runs.push_back(std::move(run));
  }
  return runs;
}

std::vector<identification::ChannelRun> channels_of(
    const std::vector<MeasuredRun>& measured) {
  std::vector<identification::ChannelRun> runs;
  for (const MeasuredRun& one : measured) {
    runs.push_back(one.run);
  }
  return runs;
}

}  // namespace trochoid::run
