#include <trochoid/base/units.h>
#include <trochoid/results/calibrate.h>
#include <trochoid/results/coefficient_words.h>

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace trochoid::results {

namespace {

using base::Estimate;

double half(const Estimate& e) {
  return (e.high - e.low) / 2;
}

/// `812 +- 40`, with as many digits as the interval justifies.
std::string value_of(const Estimate& e, double unit) {
  const double value = e.value / unit;
  const double width = half(e) / unit;
  if (!std::isfinite(width) || !(width > 0)) {
    return fmt::format("{:.4g}", value);
  }
  const int digits = std::max(0, 1 - static_cast<int>(std::floor(std::log10(width))));
  return fmt::format("{:.{}f} +- {:.{}f}", value, digits, width, digits);
}

std::string coefficient(const force::Quantity& quantity, const Estimate& e) {
  return coefficient_words(quantity.key, value_of(e, quantity.unit));
}

std::string runout_of(const CalibrateResult& r) {
  const surface::Calibration& c = r.calibration;
  if (!c.runout.ok) {
    return "runout is not known";
  }
  return c.runout_seen
             ? fmt::format("runout {} um", value_of(c.runout.eccentricity, unit::um))
             : "no runout stands out";
}

/// Whether an engineer should use the numbers, and if not, why.
std::string trust(const CalibrateResult& r) {
  constexpr double rough = 0.25;  // half of an interval over the value
  const auto& found = r.calibration.coefficients;
  if (!std::isfinite(found.K_tc.se)) {
    return "Their accuracy is not known: there are no readings to spare.";
  }
  if (found.K_tc.value <= 0 || found.K_rc.value <= 0) {
    return "Do not use them: a coefficient is not above 0.";
  }
  const bool moved = std::any_of(r.heading.warnings.begin(), r.heading.warnings.end(),
                                 [](const auto& w) { return w.code == "origin"; });
  if (moved) {
    return "Do not use them before x is clear: see the warning.";
  }
  const double worst = std::max(half(found.K_tc) / found.K_tc.value,
                                half(found.K_rc) / found.K_rc.value);
  if (worst > rough) {
    return fmt::format("Too rough to use: +- {:.0f} %.", 100 * worst);
  }
  const auto names_a_doubt = [](const base::Warning& w) {
    return w.code == "thick_deflection" || w.code == "feedback" ||
           w.code == "single_readings" || w.code == "uneven_readings" ||
           w.code == "not_decided" || w.code == "outliers";
  };
  return std::any_of(r.heading.warnings.begin(), r.heading.warnings.end(),
                     names_a_doubt)
             ? "The intervals include random errors. See the warnings for what may "
               "bias the numbers."
             : "Nothing speaks against them.";
}

}  // namespace

std::string calibration_sentence(const CalibrateResult& r) {
  const auto names = force::coefficient_quantities(r.law);
  const auto& found = r.calibration.coefficients;
  return fmt::format(
      "{} and {} from {} readings; {} (95 %). {}", coefficient(names[0], found.K_tc),
      coefficient(names[1], found.K_rc), r.readings.size(), runout_of(r), trust(r));
}

}  // namespace trochoid::results
