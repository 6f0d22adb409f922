#include <trochoid/run/measured_run.h>

#include <trochoid/base/error.h>
#include <trochoid/base/units.h>
#include <trochoid/inputs/record_file.h>
#include <trochoid/signal/axes.h>
#include <trochoid/signal/drift.h>
#include <trochoid/signal/revolutions.h>
#include <trochoid/signal/spindle_speed.h>

#include <fmt/core.h>

#include <cmath>
#include <stdexcept>

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
  const double ratio = run.Omega / run.cut.Omega;
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
                   run.record.file, run.Omega / unit::rpm, how_far,
                   run.cut.Omega / unit::rpm,
                   off < far_off ? ""
                                 : " Check spindle_rpm and the feed, or the times "
                                   "and angles of the record.")});
}

/// Angle and speed of a run; false with the reason where it has none.
bool lay_over_angle(MeasuredRun& run, int teeth, Warnings& warnings,
                    std::string& message) {
  const signal::Record& record = run.record;
  run.Omega = run.cut.Omega;
  if (!record.angle.empty()) {
    run.angle = signal::unwrapped(record.angle);
    if (!record.time.empty() && record.time.back() > record.time.front()) {
      run.Omega = (run.angle.back() - run.angle.front()) /
                  (record.time.back() - record.time.front());
      if (!(run.Omega > 0)) {
        throw base::InputError(
            {record.file +
             ": the spindle angle falls while the time rises; it must rise "
             "(if it was counted backwards, change its sign; two samples "
             "must lie less than half a turn apart)"});
      }
      compare_speed(run, warnings);
    }
    return true;
  }
  if (record.time.empty()) {
    message = record.file +
              ": neither angles nor times: name angle_column, "
              "time_column or sample_rate_Hz";
    return false;
  }
  const signal::SpeedEstimate found =
      signal::spindle_speed(record, {.Omega = run.cut.Omega, .teeth = teeth});
  if (found.ok) {
    run.Omega = found.Omega;
    run.Omega_se = found.se;
    compare_speed(run, warnings);
  } else {
    warnings.push_back(
        {"spindle_speed_unknown", record.file + ": " + found.message +
                                      " The stated spindle speed is used as it is."});
  }
  run.angle = signal::angle_from_time(record.time, run.Omega);
  return true;
}

void take_drift_out(MeasuredRun& run, Warnings& warnings) {
  const auto drift = signal::idle_drift(run.record.channel, run.angle);
  if (!drift) {
    warnings.push_back({"no_idle_part",
                        run.record.file +
                            ": nothing in the record is free of cutting, so the offset "
                            "of the channels cannot be read off it; it is left in. "
                            "channel_offsets = \"fit\" estimates it with the rest."});
    return;
  }
  signal::remove_drift(run.record.channel, *drift);
  const auto [begin, end] = signal::steady_part(run.record.channel, run.angle);
  const auto cut_to = [begin = begin, end = end](std::vector<double>& v) {
    if (!v.empty()) {
      v = std::vector<double>(v.begin() + static_cast<std::ptrdiff_t>(begin),
                              v.begin() + static_cast<std::ptrdiff_t>(end));
    }
  };
  cut_to(run.angle);
  cut_to(run.record.time);
  cut_to(run.record.angle);
  for (auto& values : run.record.channel) {
    cut_to(values);
  }
}

}  // namespace

std::vector<MeasuredRun> measured_runs(const inputs::Case& given, Warnings& warnings,
                                       std::string& message) {
  std::vector<signal::Record> records = read_all(given);
  std::vector<MeasuredRun> runs;
  for (std::size_t i = 0; i < records.size(); ++i) {
    MeasuredRun run{.record = std::move(records[i]), .cut = given.measurements[i].cut};
    for (const base::Warning& note : run.record.notes) {
      warnings.push_back({note.code, run.record.file + ": " + note.message});
    }
    if (!lay_over_angle(run, given.setup.cutter.teeth(), warnings, message)) {
      return {};
    }
    if (given.identify.channel_offsets == inputs::ChannelOffset::idle) {
      take_drift_out(run, warnings);
    }
    runs.push_back(std::move(run));
  }
  return runs;
}

std::vector<identification::Run> on_tool(const std::vector<MeasuredRun>& runs,
                                         const Matrix3& M) {
  std::vector<identification::Run> out;
  for (const MeasuredRun& run : runs) {
    auto force = signal::force_on_tool(run.record.channel, M);
    if (!force) {
      throw std::invalid_argument("the matrix of the dynamometer cannot be inverted");
    }
    out.push_back({run.cut, run.angle, std::move(*force)});
  }
  return out;
}

}  // namespace trochoid::run
