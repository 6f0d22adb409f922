#include <trochoid/base/rounded.h>

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace trochoid::base {

std::string with_error(double value, double half) {
  if (!std::isfinite(value) || !std::isfinite(half)) {
    return "not known";
  }
  if (!(half > 0.0)) {
    return fmt::format("{:.5g}", value);
  }
  // Two digits of the error, as it is printed: 0.0996 is 0.10.
  const auto exponent = static_cast<int>(std::floor(std::log10(half) + 1e-12));
  const double unit = std::pow(10.0, exponent - 1);
  const double rounded = unit * std::round(half / unit);
  const auto digits = static_cast<int>(std::floor(std::log10(rounded) + 1e-12));
  const int places = 1 - digits;
  if (places >= 0) {
    const int shown = std::min(places, 12);
    const double scale = std::pow(10.0, -places);
    const double v = scale * std::round(value / scale);
    // A zero has no sign.
    return fmt::format("{:.{}f} +- {:.{}f}", v == 0.0 ? 0.0 : value, shown, half,
                       shown);
  }
  const double scale = std::pow(10.0, -places);
  return fmt::format("{:.0f} +- {:.0f}", scale * std::round(value / scale) + 0.0,
                     scale * std::round(half / scale));
}

std::string as_known(double value, double error) {
  constexpr int digits_of_error = 4;
  if (!std::isfinite(value) || !std::isfinite(error) || !(error > 0.0)) {
    return fmt::format("{}", value);
  }
  const int places =
      digits_of_error - 1 - static_cast<int>(std::floor(std::log10(error)));
  const std::string all = fmt::format("{}", value);
  const std::string known = fmt::format("{:.{}f}", value, std::clamp(places, 0, 17));
  return known.size() < all.size() ? known : all;
}

std::string percent(double part) {
  if (!(part >= 0.0 && part <= 1.0)) {
    return "not known";
  }
  return fmt::format("{:.{}f} %", 100.0 * part, part < 0.1 ? 1 : 0);
}

}  // namespace trochoid::base
