#include <trochoid/run/records.h>

#include <trochoid/base/error.h>
#include <trochoid/base/units.h>
#include <trochoid/signal/channel_faults.h>
#include <trochoid/signal/curved_drift.h>
#include <trochoid/signal/foreign_line.h>
#include <trochoid/signal/passes.h>
#include <trochoid/signal/revolutions.h>
#include <trochoid/signal/spindle_speed.h>
#include <trochoid/signal/wander.h>

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <span>

namespace trochoid::run {

namespace {

using Warnings = std::vector<base::Warning>;

/// A found speed that differs more than this from the stated one is worth a word.
constexpr double speed_slack = 1e-3;
/// Beyond this a percentage says less than a factor.
constexpr double far_off = 0.5;

std::vector<signal::Record> read_all(const cases::Case& given) {
  std::vector<signal::Record> records;
  std::vector<std::string> problems;
  for (const cases::Measurement& m : given.measurements) {
    try {
      records.push_back(m.record.get());
    } catch (const base::InputError& error) {
      problems.insert(problems.end(), error.problems().begin(), error.problems().end());
    }
  }
  for (const signal::Record& record : records) {
    if (given.identify.by_channels)
      break;  // each channel is looked at where it is used
    if (const std::string why = missing_channel(record, given); !why.empty()) {
      problems.push_back(why);
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

/// @brief What a record that is not periodic near the stated speed repeats at; empty:
/// nothing that explains most of it.
///
/// Where teeth are alike, fractions of the speed explain as much: the nearest is taken.
std::string far_speed(const signal::Record& record, double Omega, int teeth) {
  constexpr double range = 0.45;  // a half or a double would look periodic, too
  constexpr double most = 0.5;    // of the variance
  constexpr double as_much = 0.98;
  const auto within = [&](double r) {
    return signal::spindle_speed(record, {.Omega = Omega, .range = r, .teeth = teeth});
  };
  signal::SpeedEstimate found = within(range);
  if (!found.ok || found.explained < most) {
    return "";
  }
  for (const double nearer : {0.1, 0.15, 0.2, 0.3}) {
    const signal::SpeedEstimate other = within(nearer);
    if (!other.ok || other.explained < as_much * found.explained) continue;
    found = other;
    break;
  }
  return fmt::format(
      " It repeats at {:.1f} rpm, {:+.0f} % off: check spindle_rpm, and with it the feed.",
      found.Omega / unit::rpm, 100 * (found.Omega / Omega - 1));
}

/// Follow a speed that is not the same all the time.
void follow_wander(const signal::Record& record, MeasuredRun& run, Warnings& warnings) {
  signal::Wander wander = signal::follow_speed(record.channel, run.run.angle);
  if (wander.angle.empty()) return;
  warnings.push_back(
      {"speed_wanders",
       fmt::format(
           "{}: the spindle does not turn evenly: its speed goes from {:.1f} to "
           "{:.1f} rpm. The forces tell the angle from turn to turn, and are laid "
           "over it.",
           run.file, wander.slowest * run.Omega / unit::rpm,
           wander.fastest * run.Omega / unit::rpm)});
  run.run.angle = std::move(wander.angle);
  run.wanders = true;
}

/// A force that is not the same in the first turns and the last.
void warn_growth(const signal::Record& record, const MeasuredRun& run,
                 Warnings& warnings) {
  constexpr double worth_a_word = 0.03;
  constexpr double clear = 4.0;  // standard errors
  const auto [growth, se] = signal::growth_of_force(record.channel, run.run.angle);
  if (std::abs(growth) < std::max(worth_a_word, clear * se)) return;
  warnings.push_back(
      {"changes_within",
       fmt::format(
           "{}: the force {} by {:.0f} % from the first turn to the last, as of {}: "
           "the coefficients are those in the middle. from_s and to_s in "
           "[[measurement]] choose a part.",
           run.file, growth > 0 ? "grows" : "falls", 100 * std::abs(growth),
           growth > 0 ? "a tool that wears or a depth that grows"
                      : "a depth or a feed that falls")});
}

/// Chatter and hum, by their frequency.
void warn_foreign_line(const signal::Record& record, const MeasuredRun& run,
                       Warnings& warnings) {
  if (run.wanders) return;  // its harmonics are no lines
  const auto line = signal::foreign_line(record.channel, record.sample_rate, run.Omega);
  if (!line) return;
  const auto of_mains = [&](double mains) {
    const double harmonic = std::round(line->frequency / mains);
    return harmonic >= 1.0 && harmonic <= 3.0 &&
           std::abs(line->frequency - harmonic * mains) < 0.01 * mains * harmonic;
  };
  const bool hum = of_mains(50.0) || of_mains(60.0);
  warnings.push_back(
      {"chatter",
       fmt::format(
           "{}: channel {} has a line at {:.1f} Hz, {:.0f} % of the force (rms), "
           "which is no harmonic of the spindle: {}.",
           run.file, line->channel + 1, line->frequency, 100 * line->share,
           hum ? "hum of the mains"
               : "chatter, if it is there in the cut only; else another source of "
                 "vibration")});
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
                                      " The stated spindle speed is used as it is." +
                                      far_speed(record, run.Omega, teeth)});
  }
  angle = signal::angle_from_time(record.time, run.Omega);
  if (found.ok) follow_wander(record, run, warnings);
}

void warn_of_drift(const signal::Record& record, const signal::RemovedDrift& drift,
                   bool idle_part_wanted, Warnings& warnings) {
  if (!drift.offset && idle_part_wanted) {
    warnings.push_back({"no_idle_part",
                        record.file +
                            ": nothing in the record is free of cutting, so the offset "
                            "of the channels cannot be read off it; it is left in. "
                            "channel_offsets = \"fit\" estimates it with the rest."});
  }
  const auto most = std::ranges::max_element(drift.bend);
  if (!(*most > 0)) return;
  warnings.push_back(
      {"curved_drift",
       fmt::format(
           "{}: channel {} drifts along a curve, up to {:.3g} N from a straight "
           "line. The curve was removed, as the mean force of a steady cut does "
           "not change.",
           record.file, most - drift.bend.begin() + 1, *most)});
}

/// Where nothing cuts a channel reads its offset.
bool is_read_off_air(cases::ChannelOffset how) {
  return how == cases::ChannelOffset::idle || how == cases::ChannelOffset::automatic;
}

/// Code of the warning, and what the channel does.
std::pair<std::string_view, std::string_view> in_words(signal::ChannelFault fault) {
  switch (fault) {
    case signal::ChannelFault::constant:
      return {"dead_channel", "has the same number in every sample: was it connected?"};
    case signal::ChannelFault::clipped:
      return {"clipped_channel",
              "stays at its largest or smallest number again and again: it was driven "
              "beyond its range. Measure in a wider one."};
    case signal::ChannelFault::dropouts:
      return {"dropouts",
              "stands still for several samples now and then: samples were lost there, "
              "and are left out."};
    case signal::ChannelFault::none:
      break;
  }
  return {};
}

/// Leave out of all columns the samples that are lost in one.
void leave_out(const std::vector<bool>& lost, signal::Record& record) {
  const auto thin_out = [&](std::vector<double>& values) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (!lost[i]) values[kept++] = values[i];
    }
    values.resize(kept);
  };
  thin_out(record.angle);
  thin_out(record.time);
  for (std::size_t c = 0; c < record.channels(); ++c) thin_out(record.values_of(c));
}

/// Say what channels do that no force does, and leave lost samples out.
void look_for_faults(signal::Record& record, Warnings& warnings) {
  std::vector<bool> lost(record.size(), false);
  for (std::size_t c = 0; c < record.channel.size(); ++c) {
    if (!record.measured[c]) continue;
    const signal::ChannelFault fault = signal::channel_fault(record.channel[c]);
    if (fault == signal::ChannelFault::none) {
      continue;
    }
    const auto [code, what] = in_words(fault);
    warnings.push_back(
        {std::string(code), fmt::format("{}: channel {} (column {}) {}", record.file,
                                        c + 1, record.channel_column[c], what)});
    if (fault != signal::ChannelFault::dropouts) continue;
    for (const signal::Part& part : signal::lost_samples(record.channel[c])) {
      for (std::size_t i = part.begin; i < part.end; ++i) lost[i] = true;
    }
  }
  if (std::ranges::find(lost, true) != lost.end()) leave_out(lost, record);
}

/// `0.83 s`, or the number of the turn where a record has no times.
std::string place_text(const signal::Record& record, std::span<const double> angle,
                       std::size_t at) {
  const std::size_t i = std::min(at, record.size() - 1);
  return record.time.empty()
             ? fmt::format("turn {:.1f}", (angle[i] - angle[0]) / unit::turn)
             : fmt::format("{:.4g} s", record.time[i]);
}

std::string air_text(const signal::Record& record, std::span<const double> angle,
                     const std::vector<signal::Part>& air) {
  std::vector<std::string> parts;
  for (const signal::Part& part : air) {
    const std::string from = place_text(record, angle, part.begin);
    const std::string to = place_text(record, angle, part.end);
    parts.push_back(part.begin == 0 ? fmt::format("up to {}", to)
                    : part.end == record.size()
                        ? fmt::format("from {} on", from)
                        : fmt::format("from {} to {}", from, to));
  }
  return fmt::format("nothing cuts {}", fmt::join(parts, ", "));
}

std::string steady_text(const signal::Record& record, std::span<const double> angle,
                        const signal::Passes& passes, const signal::Part& used) {
  std::string text = air_text(record, angle, passes.air);
  if (passes.air.empty()) {
    text = "the cut is not steady at its ends";
  }
  text += fmt::format("; the steady cut from {} to {} is used",
                      place_text(record, angle, used.begin),
                      place_text(record, angle, used.end - 1));
  if (passes.steady.size() > 1) {
    text += fmt::format(
        ", the longest of {} passes (from_s and to_s in [[measurement]] choose another)",
        passes.steady.size());
  }
  return text + ".";
}

/// The time that the case states.
/// @throws base::InputError
signal::Part stated_part(const signal::Record& record,
                         const cases::Measurement& measurement) {
  const auto& time = record.time;
  if (time.empty()) {
    throw base::InputError({record.file +
                            ": from_s and to_s need times, and this record has none: "
                            "time_column or sample_rate_Hz gives them"});
  }
  const double from = measurement.from.value_or(time.front());
  const double to = measurement.to.value_or(time.back());
  const signal::Part part = signal::part_between(time, from, to);
  if (part.size() < 2) {
    throw base::InputError({fmt::format(
        "{}: nothing was recorded from {:g} s to {:g} s (from_s, to_s): the record goes "
        "from {:g} s to {:g} s",
        record.file, from, to, time.front(), time.back())});
  }
  return part;
}

/// Angle of the spindle, before its speed is known any better than stated.
std::vector<double> stated_angle(const signal::Record& record,
                                 const geometry::Cut& cut) {
  return record.angle.empty() ? signal::angle_from_time(record.time, cut.Omega)
                              : signal::unwrapped(record.angle);
}

/// @brief Refuse times without a unit that are none in seconds, but in a smaller unit.
/// @throws base::InputError
void check_unit_of_time(const signal::Record& record, const geometry::Cut& cut) {
  constexpr double least_by_time = 2.0;  // samples a turn: fewer tell no speed
  constexpr double least = 8.0;          // of a sound record
  constexpr double most = 1e5;
  const std::string column =
      fmt::format("Column \"{}\" says no unit", record.time_column);
  const bool assumed =
      std::ranges::any_of(record.notes, [&](const base::Warning& note) {
        return note.code == "unit_assumed" && note.message.starts_with(column);
      });
  if (!record.angle.empty() || !assumed || record.size() < 2) return;
  const double step = (record.time.back() - record.time.front()) /
                      static_cast<double>(record.size() - 1);
  const double a_turn = unit::turn / (cut.Omega * step);
  if (a_turn >= least_by_time) return;
  for (const auto& [name, parts] : {std::pair{"ms", 1e3}, std::pair{"us", 1e6}}) {
    if (!(a_turn * parts >= least && a_turn * parts <= most)) continue;
    throw base::InputError({fmt::format(
        "{}: column \"{}\" says no unit: in s there are {:.2g} samples to a turn of the "
        "stated {:g} rpm, in {} {:.4g}: write the unit into its name, for example "
        "time_{}",
        record.file, record.time_column, a_turn, unit::in(cut.Omega, unit::rpm), name,
        a_turn * parts, name)});
  }
}

/// Which part of a record is fitted.
struct UsedPart {
  signal::Part part;
  std::string why;  ///< one sentence for a person; empty: all, or what the case states
};

/// The time that the case states, or else the longest steady cut.
/// @throws base::InputError where a time is stated that the record does not have
UsedPart used_part(const signal::Record& record, std::span<const double> angle,
                   const signal::Passes& passes,
                   const cases::Measurement& measurement) {
  if (measurement.from || measurement.to) {
    return {stated_part(record, measurement), ""};
  }
  const signal::Part longest = signal::longest_steady(passes);
  return {longest, longest.size() < record.size()
                       ? steady_text(record, angle, passes, longest)
                       : ""};
}

/// A record told apart, over the angle by which that was done.
struct ToldApart {
  std::vector<double> angle;
  signal::Passes passes;
};

/// The middle of the steady cut, as long as it takes to know the speed.
signal::Record middle_of_cut(const signal::Record& record,
                             std::span<const double> angle, const signal::Part& cut) {
  constexpr double most_turns = 32.0;
  const std::size_t middle = cut.begin + cut.size() / 2;
  const std::size_t half = cut.size() / 4;
  signal::Part part{middle - half, middle + half};
  const double reach = 0.5 * most_turns * unit::turn;
  while (part.size() > 2 && angle[middle] - angle[part.begin] > reach) ++part.begin;
  while (part.size() > 2 && angle[part.end - 1] - angle[middle] > reach) --part.end;
  signal::Record out;
  const auto piece = [&](const std::vector<double>& all) {
    return std::vector<double>(all.begin() + static_cast<std::ptrdiff_t>(part.begin),
                               all.begin() + static_cast<std::ptrdiff_t>(part.end));
  };
  out.time = piece(record.time);
  for (std::size_t c = 0; c < 3; ++c) out.channel[c] = piece(record.channel[c]);
  return out;
}

/// @brief Air and cut of a record.
///
/// The lines of turns tell entry from cut where turns are turns: not by a stated speed that
/// is off, but by the one in the middle of the cut.
ToldApart told_apart(const signal::Record& record, const geometry::Cut& cut) {
  ToldApart out{.angle = stated_angle(record, cut), .passes = {}};
  out.passes = signal::passes_of(record.channel, out.angle);
  if (!record.angle.empty()) return out;
  const signal::Record middle =
      middle_of_cut(record, out.angle, signal::longest_steady(out.passes));
  // Of one tooth all low orders are looked at, those of any number of teeth.
  const signal::SpeedEstimate found =
      signal::spindle_speed(middle, {.Omega = cut.Omega, .teeth = 1});
  if (!found.ok || std::abs(found.Omega / cut.Omega - 1.0) <= speed_slack) return out;
  out.angle = signal::angle_from_time(record.time, found.Omega);
  out.passes = signal::passes_of(record.channel, out.angle);
  return out;
}

/// The steady cut of a record, without the offset of its channels.
void keep_cut(const cases::Case& given, const cases::Measurement& measurement,
              signal::Record& record, MeasuredRun& run, Warnings& warnings) {
  const auto [angle, passes] = told_apart(record, measurement.cut);
  const UsedPart used = used_part(record, angle, passes, measurement);
  run.overview = signal::overview_of(record, angle, used.part);
  signal::RemovedDrift drift;
  if (is_read_off_air(given.identify.channel_offsets)) {
    drift = signal::remove_drift(record.channel, angle, passes.air, used.part);
    run.further_offset_se =
        signal::remove_drift(record.further, angle, passes.air, used.part);
  }
  warn_of_drift(record, drift,
                given.identify.channel_offsets == cases::ChannelOffset::idle, warnings);
  run.offset_taken_out = drift.offset;
  run.run.offset_se = drift.offset_se;
  if (!used.why.empty()) {
    warnings.push_back({"part_used", record.file + ": " + used.why});
  }
  signal::keep_part(used.part, record);
}

std::string duration_text(const signal::Record& record) {
  if (record.time.size() < 2) {
    return "no time";
  }
  std::string text = fmt::format("{:.4g} s", record.time.back() - record.time.front());
  return record.sample_rate > 0
             ? text + fmt::format(" at {:.6g} Hz", record.sample_rate)
             : text + ", unevenly sampled";
}

std::string revolutions_text(const signal::Record& record, const geometry::Cut& cut) {
  if (!record.angle.empty()) {
    const auto angle = signal::unwrapped(record.angle);
    return fmt::format("{:.2f} revolutions by their angles",
                       std::abs(angle.back() - angle.front()) / unit::turn);
  }
  const double duration = record.time.back() - record.time.front();
  return fmt::format("about {:.1f} revolutions at the stated {:g} rpm",
                     duration * cut.Omega / unit::turn, unit::in(cut.Omega, unit::rpm));
}

/// A line for each channel: its column, range and mean.
std::string channels_text(const signal::Record& record,
                          const files::RecordSource& source) {
  std::string text;
  for (std::size_t c = 0; c < source.channels(); ++c) {
    const auto& values = c < 3 ? record.channel[c] : record.further[c - 3];
    const bool measured = c < 3 ? record.measured[c] : !values.empty();
    if (!measured) {
      text += fmt::format("  channel {} was not measured\n", c + 1);
      continue;
    }
    const auto unit = source.axes.empty() ? force::ChannelUnit::newton
                                          : force::unit_of(source.axes[c]);
    const auto [lo, hi] = std::minmax_element(values.begin(), values.end());
    const double mean = std::accumulate(values.begin(), values.end(), 0.0) /
                        static_cast<double>(values.size());
    text += fmt::format(
        "  channel {0} from column {1}: {2:.4g} to {3:.4g} {5}, mean {4:.4g} {5}\n",
        c + 1, c < 3 ? record.channel_column[c] : record.further_column[c - 3], *lo,
        *hi, mean, force::name_of(unit));
  }
  return text;
}

/// Which column tells where the spindle stands.
std::string axis_text(const signal::Record& record) {
  if (!record.angle.empty()) {
    return fmt::format("  angle from column {}\n", record.angle_column);
  }
  return record.time_column.empty()
             ? std::string("  time from the sampling rate\n")
             : fmt::format("  time from column {}\n", record.time_column);
}

}  // namespace

std::string missing_channel(const signal::Record& record, const cases::Case& given) {
  if (std::ranges::all_of(record.measured, std::identity())) return "";
  const auto dynamometer = given.dynamometer.value_or(cases::Dynamometer{});
  const std::string begin =
      record.file + ": not all three channels were measured, so that ";
  if (dynamometer.automatic) {
    return begin +
           "axes = \"auto\" cannot find what the others read; give an axis for each "
           "channel, for example axes = [\"x\", \"y\"] for two";
  }
  if (!identification::measured_forces(record.measured, dynamometer.matrix)) {
    return begin +
           "a full matrix gives no force; give axes, for example axes = [\"x\", "
           "\"y\", \"z\"], in its place";
  }
  return "";
}

std::vector<MeasuredRun> measured_runs(const cases::Case& given, Warnings& warnings) {
  std::vector<signal::Record> records = read_all(given);
  std::vector<MeasuredRun> runs;
  for (std::size_t i = 0; i < records.size(); ++i) {
    signal::Record& record = records[i];
    MeasuredRun run{.file = record.file,
                    .run = {.cut = given.measurements[i].cut,
                            .group = given.measurements[i].group}};
    for (const base::Warning& note : record.notes) {
      warnings.push_back({note.code, run.file + ": " + note.message});
    }
    check_unit_of_time(record, given.measurements[i].cut);
    look_for_faults(record, warnings);
    keep_cut(given, given.measurements[i], record, run, warnings);
    lay_over_angle(record, given.setup.cutter.teeth(), run, warnings);
    if (!run.by_time || run.Omega_se > 0.0) {  // else turns are no turns
      warn_growth(record, run, warnings);
      warn_foreign_line(record, run, warnings);
    }
    run.run.channel = std::move(record.channel);
    run.run.measured = record.measured;
    run.further = std::move(record.further);
    runs.push_back(std::move(run));
  }
  return runs;
}

std::vector<identification::ChannelRun> channels_of(
    const std::vector<MeasuredRun>& measured) {
  std::vector<identification::ChannelRun> runs;
  runs.reserve(measured.size());
  for (const MeasuredRun& one : measured) {
    runs.push_back(one.run);
    runs.back().cut.Omega = one.Omega;  // at which a dynamometer reads its harmonics
    runs.back().Omega_se = one.by_time ? one.Omega_se : 0.0;
  }
  return runs;
}

std::string describe_record(const signal::Record& record,
                            const cases::Measurement& measurement) {
  const bool of_program = !(measurement.cut.Omega > 0) && record.angle.empty();
  if (of_program) {  // it has no one speed
    return fmt::format("{}: {} samples, {}\n{}{}", record.file, record.size(),
                       duration_text(record), axis_text(record),
                       channels_text(record, measurement.source));
  }
  std::string text = fmt::format(
      "{}: {} samples, {}, {}\n{}", record.file, record.size(), duration_text(record),
      revolutions_text(record, measurement.cut), axis_text(record));
  const auto [angle, passes] = told_apart(record, measurement.cut);
  const UsedPart used = used_part(record, angle, passes, measurement);
  if (!used.why.empty()) text += "  " + used.why + "\n";
  return text + channels_text(record, measurement.source);
}

}  // namespace trochoid::run
