#include <trochoid/run/shared/used_part.h>

#include <trochoid/base/error.h>
#include <trochoid/base/units.h>
#include <trochoid/signal/revolutions.h>
#include <trochoid/signal/spindle_speed.h>

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace trochoid::run {

namespace {

using signal::Part;
using signal::Record;

/// `0.83 s`, or the number of the turn where a record has no times.
std::string place_text(const Record& record, std::span<const double> angle,
                       std::size_t at) {
  const std::size_t i = std::min(at, record.size() - 1);
  return record.time.empty()
             ? fmt::format("turn {:.1f}", (angle[i] - angle[0]) / unit::turn)
             : fmt::format("{:.4g} s", record.time[i]);
}

std::string air_text(const Record& record, std::span<const double> angle,
                     const std::vector<Part>& air) {
  std::vector<std::string> parts;
  for (const Part& part : air) {
    const std::string from = place_text(record, angle, part.begin);
    const std::string to = place_text(record, angle, part.end);
    parts.push_back(part.begin == 0 ? fmt::format("up to {}", to)
                    : part.end == record.size()
                        ? fmt::format("from {} on", from)
                        : fmt::format("from {} to {}", from, to));
  }
  return fmt::format("nothing cuts {}", fmt::join(parts, ", "));
}

std::string steady_text(const Record& record, std::span<const double> angle,
                        const signal::Passes& passes, const Part& used) {
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

/// @throws base::InputError
Part stated_part(const Record& record, const inputs::Measurement& measurement) {
  const auto& time = record.time;
  if (time.empty()) {
    throw base::InputError({record.file +
                            ": from_s and to_s need times, and this record has none: "
                            "time_column or sample_rate_Hz gives them"});
  }
  const double from = measurement.from.value_or(time.front());
  const double to = measurement.to.value_or(time.back());
  const auto begin = std::lower_bound(time.begin(), time.end(), from);
  const auto end = std::upper_bound(time.begin(), time.end(), to);
  if (end - begin < 2) {
    throw base::InputError({fmt::format(
        "{}: nothing was recorded from {:g} s to {:g} s (from_s, to_s): the record goes "
        "from {:g} s to {:g} s",
        record.file, from, to, time.front(), time.back())});
  }
  return {static_cast<std::size_t>(begin - time.begin()),
          static_cast<std::size_t>(end - time.begin())};
}

void keep(const Part& part, std::vector<double>& values) {
  if (values.empty()) {
    return;
  }
  values.erase(values.begin() + static_cast<std::ptrdiff_t>(part.end), values.end());
  values.erase(values.begin(),
               values.begin() + static_cast<std::ptrdiff_t>(part.begin));
}

}  // namespace

std::vector<double> stated_angle(const Record& record, const geometry::Cut& cut) {
  return record.angle.empty() ? signal::angle_from_time(record.time, cut.Omega)
                              : signal::unwrapped(record.angle);
}

UsedPart used_part(const Record& record, std::span<const double> angle,
                   const inputs::Measurement& measurement) {
  const signal::Passes passes = signal::passes_of(record.channel, angle);
  UsedPart used{.part = {0, record.size()}, .air = passes.air, .why = {}};
  if (measurement.from || measurement.to) {
    used.part = stated_part(record, measurement);
    return used;
  }
  const auto shorter = [](const Part& a, const Part& b) { return a.size() < b.size(); };
  const Part longest = *std::ranges::max_element(passes.steady, shorter);
  if (longest.size() < record.size()) {
    used.part = longest;
    used.why = steady_text(record, angle, passes, longest);
  }
  return used;
}

void keep_part(const Part& part, Record& record) {
  keep(part, record.angle);
  keep(part, record.time);
  for (auto& values : record.channel) {
    keep(part, values);
  }
}

}  // namespace trochoid::run
