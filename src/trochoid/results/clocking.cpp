#include <trochoid/results/clocking.h>

#include <trochoid/base/rounded.h>
#include <trochoid/base/units.h>

#include <fmt/core.h>

#include <cmath>

namespace trochoid::results {

namespace {

using identification::Offset;

/// An amount and its 95 % interval, which does not go below zero.
Value amount_value(double value, double se, double factor, double unit) {
  return Object{{"value", value / unit},
                {"se", se / unit},
                {"low", std::max(0.0, value - factor * se) / unit},
                {"high", (value + factor * se) / unit}};
}

/// Tool, or spindle and holder.
struct ClampingPart {
  const Offset& offset;
  double factor;
};

const Fields<ClampingPart>& clamping_part_fields() {
  static const Fields<ClampingPart> all{
      Field<ClampingPart>{"eccentricity_mm", "of this part",
                          [](const ClampingPart& p) {
                            return as_named(amount_value(p.offset.amount(),
                                                         p.offset.amount_se(), p.factor,
                                                         unit::mm));
                          }}
          .with(below_estimate()),
      {"angle_deg",
       "of the tool from the tip of tooth 1, of the holder from where tooth 1 stood "
       "before",
       [](const ClampingPart& p) { return p.offset.angle(); }},
      {"angle_se_deg", "one standard error, or `null`", [](const ClampingPart& p) {
         return std::isfinite(p.offset.angle_se()) ? Value(p.offset.angle_se())
                                                   : Value();
       }}};
  return all;
}

std::string in_um(const Offset& offset, double factor) {
  return base::with_error(offset.amount() / unit::um,
                          factor * offset.amount_se() / unit::um);
}

}  // namespace

const Fields<Clocked>& clocking_fields() {
  using Of = const Clocked&;
  const auto separated = [](Of c) { return c.clocking.separation.has_value(); };
  static const Fields<Clocked> all{
      Field<Clocked>{"total_indicator_reading_um", "of a dial gauge at the shank",
                     [](Of c) {
                       const Offset& now = c.clocking.present;
                       return as_named(amount_value(2.0 * now.amount(),
                                                    2.0 * now.amount_se(), c.factor,
                                                    unit::um));
                     }}
          .with(below_estimate()),
      {"height_mm", "half of the axial depth",
       [](Of c) { return given(c.clocking.height); }},
      {"longest_tooth", "at that height",
       [](Of c) { return c.clocking.longest_tooth; }},
      {"tool", "with `previous_clamping`: the part of the tool", clamping_part_fields(),
       [](Of c) {
         return ClampingPart{c.clocking.separation->tool, c.factor};
       },
       separated},
      {"holder", "with `previous_clamping`: the part of the holder",
       clamping_part_fields(),
       [](Of c) {
         return ClampingPart{c.clocking.separation->holder, c.factor};
       },
       separated},
      {"best_turn_deg", "by which to turn the tool in its holder from now on",
       [](Of c) { return c.clocking.separation->best_turn; }, separated},
      {"least_eccentricity_mm", "that then remains",
       [](Of c) { return c.clocking.separation->least; }, separated}};
  return all;
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
