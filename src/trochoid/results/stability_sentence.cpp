#include <trochoid/base/units.h>
#include <trochoid/results/better_speed.h>
#include <trochoid/results/stability.h>

#include <fmt/core.h>

#include <cmath>
#include <optional>

namespace trochoid::results {

namespace {

using dynamics::StabilityVerdict;

/// A limit this near, relative to it, is no better known than modes and coefficients.
constexpr double close_to_limit = 0.1;

struct Asked {
  double depth = 0.0;  ///< [m]
  double speed = 0.0;  ///< [rpm]
};

Asked asked_of(const StabilityResult& r) {
  const geometry::Cut& cut = r.problem.setup.cut;
  return {cut.a_p, unit::in(cut.Omega, unit::rpm)};
}

std::string no_limit(const Asked& asked, double greatest) {
  return fmt::format("Stable: at {:g} rpm no axial depth up to {:g} mm chatters.",
                     asked.speed, unit::in(greatest, unit::mm));
}

std::string unstable(const Asked& asked, double limit) {
  const std::string cut =
      fmt::format("Unstable: the cut at {:g} mm and {:g} rpm chatters",
                  unit::in(asked.depth, unit::mm), asked.speed);
  return asked.depth > limit
             ? fmt::format("{}; at this speed it is stable to {:.3g} mm.", cut,
                           limit / unit::mm)
             : cut + '.';
}

std::string stable(const Asked& asked, double limit) {
  if (asked.depth > limit) {
    return fmt::format(
        "Stable at {:g} mm, on an island: at {:g} rpm chatter begins at {:.3g} mm.",
        unit::in(asked.depth, unit::mm), asked.speed, limit / unit::mm);
  }
  const double below = 1 - asked.depth / limit;
  return fmt::format(
      "Stable to {:.3g} mm at {:g} rpm: the cut of {:g} mm lies {:.2g} % below{}.",
      limit / unit::mm, asked.speed, unit::in(asked.depth, unit::mm), 100 * below,
      below < close_to_limit ? ", which is close" : "");
}

std::string verdict_of(StabilityVerdict verdict, const Asked& asked,
                       const std::optional<double>& limit, double greatest) {
  if (verdict == StabilityVerdict::marginal) {
    return fmt::format(
        "Marginal: it is uncertain whether the cut at {:g} mm and {:g} rpm is stable.",
        unit::in(asked.depth, unit::mm), asked.speed);
  }
  if (verdict == StabilityVerdict::stable) {
    return limit ? stable(asked, *limit) : no_limit(asked, greatest);
  }
  return unstable(asked, limit.value_or(asked.depth));
}

/// Whether a spindle that does not keep its speed makes a stable cut chatter.
std::string off_speed(const StabilityResult& r) {
  const auto limit = limit_of_a_spindle(r);
  if (!limit || judged_verdict(r) != StabilityVerdict::stable ||
      *limit >= r.problem.setup.cut.a_p ||
      judged_limit(r).value_or(0.0) < r.problem.setup.cut.a_p) {
    return {};
  }
  return fmt::format(" With the spindle 2 % off it may chatter from {:.2g} mm on.",
                     *limit / unit::mm);
}

/// Which speed near it allows more; empty where no lobes were asked for, or not all done.
std::string speeds_near(const StabilityResult& r) {
  const auto range = speeds_looked_at(r);
  if (!judged_limit(r) || !r.stability.whole || judged_curve(r).size() < 2 || !range) {
    return {};
  }
  const geometry::Cut& cut = r.problem.setup.cut;
  const auto better = better_speed(r);
  if (!better) {
    return fmt::format(
        " No speed from {:.4g} to {:.4g} rpm allows much more that the spindle keeps "
        "within 2 %.",
        range->from / unit::rpm, range->to / unit::rpm);
  }
  const double change = better->Omega / cut.Omega - 1;
  return fmt::format(
      " {:.5g} rpm, {:.2g} % {}, allows {:.3g} mm, also with the spindle 2 % off{}.",
      better->Omega / unit::rpm, 100 * std::abs(change),
      change < 0 ? "slower" : "faster", better->depth / unit::mm,
      better->depth < cut.a_p ? "; less than the cut asks for" : "");
}

std::string limit_words(const std::optional<double>& limit) {
  return limit ? fmt::format("the limit is {:.3g} mm", *limit / unit::mm)
               : std::string("no depth chatters");
}

/// What the measured response says by itself, beside the modes.
std::string by_response(const StabilityResult& r) {
  const auto& limit = r.measured->multi_frequency.limit;
  return fmt::format(" By the measured response itself {}.",
                     limit_words(limit ? std::optional(limit->depth) : std::nullopt));
}

/// What the modes say that do not describe the response that judges.
std::string by_modes(const StabilityResult& r) {
  if (!r.no_modes.empty()) return {};
  const auto& limit = r.stability.limit;
  return fmt::format(
      " By the modes fitted to it, which do not describe it, {}.",
      limit_words(limit ? std::optional(limit->limit.depth) : std::nullopt));
}

}  // namespace

std::string stability_sentence(const StabilityResult& r) {
  const std::string text =
      verdict_of(judged_verdict(r), asked_of(r), judged_limit(r), judged_to(r)) +
      off_speed(r) + speeds_near(r);
  if (!r.by_modes()) return "By the measured response: " + text + by_modes(r);
  return text + (r.measured ? by_response(r)
                            : " This is as sure as the modes and coefficients of the "
                              "case.");
}

}  // namespace trochoid::results
