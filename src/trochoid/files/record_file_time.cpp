#include <trochoid/files/record_file_time.h>

#include <trochoid/numerics/median.h>

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace trochoid::files {

namespace {

/// Nothing is sampled faster [Hz].
constexpr double highest_rate = 1e9;
/// A step of this many usual ones is a gap.
constexpr double gap_factor = 2.5;

/// By how much a printed time may be off.
double rounding(const PrintedTime& printed, double time, double rate) {
  double step = printed.step;
  if (printed.six_digits && time != 0.0) {
    step = std::pow(10.0, std::floor(std::log10(std::abs(time))) - 5.0);
  }
  // Where the period has no more decimals than are printed, nothing was rounded.
  const double steps = 1.0 / (rate * step);
  return std::abs(steps - std::round(steps)) < 1e-6 && steps > 0.5 ? 0.0 : step;
}

std::size_t line_of(const TimeColumn& time, std::size_t i) {
  return time.lines.empty() ? 0 : time.lines[i];
}

}  // namespace

void settle_time(signal::Record& record, const TimeColumn& time,
                 const SampleRates& rates, Problems& problems) {
  const auto [given, stated, stated_line, first_time] = rates;
  if (given > 0.0 && stated > 0.0 && std::abs(given - stated) > 1e-6 * stated) {
    problems.add(stated_line, 1,
                 fmt::format("the sampling rate here is {} Hz, the case file "
                             "says {} Hz: they must agree",
                             stated, given));
    return;
  }
  const double rate = given > 0.0 ? given : stated;
  if (rate > 0.0) {
    if (!record.time.empty()) check_rate(time, rate, problems);
    const double first = record.time.empty() ? first_time : record.time.front();
    record.time.resize(record.size());
    for (std::size_t i = 0; i < record.size(); ++i) {
      record.time[i] = first + static_cast<double>(i) / rate;
    }
    record.sample_rate = rate;
  } else if (!record.time.empty()) {
    check_increasing(time, problems);
    if (problems.lines.empty()) {
      record.sample_rate = even_rate(record.time);
      if (record.sample_rate > highest_rate) {
        problems.add(
            line_of(time, 1), time.column,
            fmt::format("time {} s comes after {} s: no record has more than {:g} "
                        "samples a second; look at the unit of the times",
                        record.time[1], record.time[0], highest_rate));
      }
      const auto note = gap_note(record.time);
      if (!note.empty()) record.notes.push_back({"time_gap", note});
    }
  } else if (record.angle.empty()) {
    problems.add(time.lines.empty() ? 0 : 1, 1,
                 "neither angles nor times nor a sampling rate are known: add a "
                 "column angle_deg or time_s, or sample_rate_Hz in the case file");
  }
}

void check_increasing(const TimeColumn& time, Problems& problems) {
  for (std::size_t i = 1; i < time.values.size() && !problems.full(); ++i) {
    if (time.values[i] > time.values[i - 1]) continue;
    problems.add(
        line_of(time, i), time.column,
        fmt::format("time {} s does not come after {} s of the "
                    "row before: times must increase{}",
                    time.values[i], time.values[i - 1],
                    time.values[i] == time.values[i - 1]
                        ? " (if they are printed too coarsely, give sample_rate_Hz in "
                          "the case file)"
                        : ""));
  }
}

void check_rate(const TimeColumn& time, double rate, Problems& problems) {
  for (std::size_t i = 1; i < time.values.size(); ++i) {
    const double t = time.values[i];
    const double expected = time.values[0] + static_cast<double>(i) / rate;
    const double allowed =
        0.5 / rate + rounding(time.printed, t, rate) + 1e-9 * std::abs(t);
    if (std::abs(t - expected) <= allowed) continue;
    problems.add(line_of(time, i), time.column,
                 fmt::format("time {} s where {:.9g} s should stand at {} Hz: rows are "
                             "missing or doubled, or the sampling rate is wrong",
                             t, expected, rate));
    return;  // every later time would be off as well
  }
}

double even_rate(std::span<const double> time) {
  const auto steps = static_cast<double>(time.size() - 1);
  const double step = (time.back() - time.front()) / steps;
  for (std::size_t i = 1; i < time.size(); ++i) {
    if (std::abs(time[i] - time[i - 1] - step) > 0.5 * step) return 0.0;
  }
  return 1.0 / step;
}

std::string gap_note(std::span<const double> time) {
  if (time.size() < 3) return {};
  std::vector<double> steps(time.size() - 1);
  for (std::size_t i = 1; i < time.size(); ++i) steps[i - 1] = time[i] - time[i - 1];
  const auto largest = std::max_element(steps.begin(), steps.end());
  const auto at = static_cast<std::size_t>(largest - steps.begin());
  const double longest = *largest;
  const double usual = numerics::median(steps);
  const auto gaps = std::count_if(steps.begin(), steps.end(),
                                  [&](double s) { return s > gap_factor * usual; });
  if (gaps == 0) return {};
  return fmt::format(
      "The times have {} gap{}: the longest goes from {:.6g} s to "
      "{:.6g} s, {:.0f} usual steps. Samples may be missing; the "
      "spindle is taken to turn evenly across.",
      gaps, gaps == 1 ? "" : "s", time[at], time[at + 1], longest / usual);
}

double last_decimal(std::string_view text) {
  const auto exponent_at = text.find_first_of("eE");
  int exponent = 0;
  if (exponent_at != std::string_view::npos) {
    exponent = static_cast<int>(parse_number(text.substr(exponent_at + 1)).value);
    text = text.substr(0, exponent_at);
  }
  const auto mark = text.find_first_of(".,");
  const auto decimals =
      mark == std::string_view::npos ? 0 : static_cast<int>(text.size() - mark - 1);
  return std::pow(10.0, std::clamp(exponent, -400, 400) - decimals);
}

}  // namespace trochoid::files
