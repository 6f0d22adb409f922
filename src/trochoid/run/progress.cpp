#include <trochoid/run/progress.h>

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace trochoid::run {

namespace {

std::string duration(double seconds) {
  const double whole = std::max(1.0, std::round(seconds));
  constexpr double minute = 60;
  return whole < 2 * minute ? fmt::format("{:.0f} s", whole)
                            : fmt::format("{:.0f} min", std::ceil(whole / minute));
}

}  // namespace

std::string progress_text(const Step& step, double elapsed, double in_step) {
  constexpr double too_little = 0.02;  // to judge the rest by
  std::string text = step.what;
  if (step.share >= 0) {
    text += fmt::format(": {:.0f} %", std::floor(100 * std::min(step.share, 1.0)));
  }
  text += fmt::format(", {}", duration(elapsed));
  if (step.share > too_little && step.share < 1) {
    text += fmt::format(", about {} left",
                        duration(in_step * (1 - step.share) / step.share));
  }
  return text;
}

}  // namespace trochoid::run
