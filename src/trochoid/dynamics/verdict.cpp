#include <trochoid/dynamics/verdict.h>

#include <fmt/core.h>

#include <algorithm>

namespace trochoid::dynamics {

bool chatters(const Verdict& verdict) noexcept {
  if (const auto* periodic = std::get_if<Periodic>(&verdict)) {
    return periodic->several_periods();
  }
  const auto* bounded = std::get_if<Bounded>(&verdict);
  return bounded == nullptr || !bounded->fades;
}

std::string period_text(const Periodic& periodic, std::size_t teeth) {
  const int all = static_cast<int>(teeth);
  const bool turns = periodic.passes % all == 0 && (all > 1 || periodic.passes > 1);
  if (periodic.passes == 1 && !turns) {
    return "with every tooth";
  }
  if (periodic.passes == all) {
    return "with every turn";
  }
  return turns ? fmt::format("every {} turns", periodic.passes / all)
               : fmt::format("every {} teeth", periodic.passes);
}

const VibrationLine* chatter_line(const Bounded& bounded) noexcept {
  const auto found =
      std::find_if(bounded.lines.begin(), bounded.lines.end(),
                   [](const VibrationLine& line) { return line.harmonic == 0; });
  return found == bounded.lines.end() ? nullptr : &*found;
}

}  // namespace trochoid::dynamics
