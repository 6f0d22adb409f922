#include <trochoid/results/clocking.h>

#include <trochoid/base/rounded.h>
#include <trochoid/base/units.h>

#include <fmt/core.h>

#include <cmath>

namespace trochoid::results {

namespace {

using identification::Offset;

/// An amount and its 95 % interval, which does not go below zero.
Object amount_value(double value, double se, double factor, double unit) {
  return {{"value", value / unit},
          {"se", se / unit},
          {"low", std::max(0.0, value - factor * se) / unit},
          {"high", (value + factor * se) / unit}};
}

Object offset_value(const Offset& offset, double factor) {
  return {{"eccentricity_mm",
           amount_value(offset.amount(), offset.amount_se(), factor, unit::mm)},
          {"angle_deg", offset.angle() / unit::deg},
          {"angle_se_deg", std::isfinite(offset.angle_se())
                               ? Value(offset.angle_se() / unit::deg)
                               : Value()}};
}

std::string in_um(const Offset& offset, double factor) {
  return base::with_error(offset.amount() / unit::um,
                          factor * offset.amount_se() / unit::um);
}

}  // namespace

Object clocking_value(const Clocking& c, double factor) {
  Object out{{"total_indicator_reading_um",
              amount_value(2.0 * c.present.amount(), 2.0 * c.present.amount_se(),
                           factor, unit::um)},
             {"height_mm", unit::in(c.height, unit::mm)},
             {"longest_tooth", c.longest_tooth}};
  if (c.separation) {
    set(out, "tool", offset_value(c.separation->tool, factor));
    set(out, "holder", offset_value(c.separation->holder, factor));
    set(out, "best_turn_deg", c.separation->best_turn / unit::deg);
    set(out, "least_eccentricity_mm", c.separation->least / unit::mm);
  }
  return out;
}

std::string clocking_lines(const Clocking& c, double factor) {
  std::string text = fmt::format(
      "a dial gauge would read {} um in all (TIR) at a smooth shank at the height of "
      "the cut; {:g} mm above the tip tooth {} is the longest\n",
      base::with_error(2.0 * c.present.amount() / unit::um,
                       2.0 * factor * c.present.amount_se() / unit::um),
      unit::in(c.height, unit::mm), c.longest_tooth);
  if (c.separation) {
    text += fmt::format(
        "of the tool itself {} um, of holder and spindle {} um; turn the tool by {:.0f} "
        "deg in its holder (positive from tooth 1 towards tooth 2) and {:.1f} um remain\n",
        in_um(c.separation->tool, factor), in_um(c.separation->holder, factor),
        c.separation->best_turn / unit::deg, c.separation->least / unit::um);
  }
  return text;
}

}  // namespace trochoid::results
