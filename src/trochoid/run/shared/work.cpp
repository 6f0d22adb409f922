#include <trochoid/run/shared/work.h>

#include <trochoid/base/units.h>

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <system_error>

namespace trochoid::run {

namespace {

std::string duration(double seconds) {
  constexpr double minute = 60;
  constexpr double hour = 60 * minute;
  constexpr double day = 24 * hour;
  return seconds < 2 * minute ? fmt::format("{:.0f} s", std::ceil(seconds))
         : seconds < 2 * hour ? fmt::format("{:.0f} min", seconds / minute)
         : seconds < 2 * day  ? fmt::format("{:.0f} h", seconds / hour)
                              : fmt::format("{:.0f} days", seconds / day);
}

/// Downwards, for more would again be too much; upwards where less would be.
double two_digits(double value, bool up) {
  const double unit = std::pow(10.0, std::floor(std::log10(value)) - 1);
  const double digits = value / unit;
  return unit * (up ? std::ceil(digits - 1e-9) : std::floor(digits + 1e-9));
}

/// How many times too much.
double excess(double evaluations, double bytes) {
  return std::max(evaluations / most_evaluations, bytes / most_bytes);
}

/// The value with which this part leaves room for the others; empty: none.
std::string would_do(const Work& part, double evaluations, double bytes) {
  const auto room = [](double all, double own, double most) {
    return all > most ? std::max(most - (all - own), most / 10) / own : 1.0;
  };
  const double left = std::min(room(evaluations, part.evaluations, most_evaluations),
                               room(bytes, part.bytes, most_bytes));
  const WorkKey& key = part.key;
  if (key.power == 0 || key.value == 0) {
    return "";
  }
  const bool up = key.power < 0;
  const double value = two_digits(key.value * std::pow(left, 1 / key.power), up);
  return fmt::format(": {} {:g}{} would do", up ? "from" : "up to", value, key.of);
}

/// How often the edge winds around the cutter.
double windings(const force::Setup& setup) {
  const double lag = setup.cutter.lag_diameter > 0 ? setup.cutter.lag_diameter
                                                   : setup.cutter.profile.D;
  return 2 * setup.cut.a_p * std::tan(setup.cutter.helix) / (lag * unit::turn);
}

double law_factor(const force::Law& law) {
  constexpr double power_law = 3;
  return force::form(law).power ? power_law : 1;
}

}  // namespace

std::string too_much(std::span<const Work> parts) {
  double evaluations = 0.0;
  double bytes = 0.0;
  for (const Work& part : parts) {
    evaluations += part.evaluations;
    bytes += part.bytes;
  }
  if (!(excess(evaluations, bytes) > 1)) {
    return "";
  }
  const Work& most = *std::ranges::max_element(
      parts, {}, [](const Work& part) { return excess(part.evaluations, part.bytes); });
  constexpr double gigabyte = 1e9;
  constexpr double worth_saying = 0.1;
  const double share = bytes / most_bytes;
  const std::string memory =
      share > worth_saying ? fmt::format(" and {:.2g} GB of memory", bytes / gigabyte)
                           : "";
  return fmt::format(
      "{} = {:g}{}{}. This would take about {:.2g} evaluations, {} on one core{}, most "
      "of it for {:.6g} {}; more than {:g} evaluations or {:g} GB are computed with "
      "--anyway only",
      most.key.name, most.key.value, most.key.of, would_do(most, evaluations, bytes),
      evaluations, duration(evaluations * seconds_per_evaluation), memory, most.count,
      most.what, most_evaluations, most_bytes / gigabyte);
}

double evaluations_at_tip(const force::Setup& setup, const force::Law& law) {
  constexpr double pair_to_axis = 130;
  const geometry::Profile& profile = setup.cutter.profile;
  const bool to_axis = profile.Rr == 0 && (profile.R > 0 || profile.alpha != 0);
  const double teeth = setup.cutter.teeth();
  return to_axis ? teeth * teeth * pair_to_axis * law_factor(law) : 0.0;
}

double evaluations_per_angle(const force::Setup& setup, const force::Law& law) {
  // Measured: each tooth asks which of all the others cut before it.
  constexpr double pair = 7;
  constexpr double pair_and_winding = 13;
  const double teeth = setup.cutter.teeth();
  const double one = pair + pair_and_winding * windings(setup);
  return teeth * teeth * one * law_factor(law) + evaluations_at_tip(setup, law);
}

double size_of_file(const std::filesystem::path& file) {
  std::error_code error;
  const auto size = std::filesystem::file_size(file, error);
  return error ? 0.0 : static_cast<double>(size);
}

}  // namespace trochoid::run
