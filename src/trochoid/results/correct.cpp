#include <trochoid/results/correct.h>

#include <trochoid/base/units.h>
#include <trochoid/results/correct_tables.h>
#include <trochoid/results/descriptions.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace trochoid::results {

namespace {

using correction::ControllerInLoop;
using correction::Correction;
using correction::MovedCut;
using correction::Setting;

/// Flutes whose peaks differ by less are equal, for `turns_to_3_percent`.
constexpr double equal_difference = 0.03;

const Fields<Setting>& correct_runout_fields() {
  static const Fields<correction::Value> estimate{
      {"value", "as found",
       [](const correction::Value& v) { return v.value / unit::um; }},
      {"se", "one standard error",
       [](const correction::Value& v) { return v.se / unit::um; }}};
  using Fit = correction::StaticFit;
  static const Fields<Fit> fit{
      {"chip_difference_um", "of each tooth", estimate, &Fit::h_ro},
      {"rms_N", "that it leaves", &Fit::rms},
      {"explained",
       "1 less the sum of squares of the residual over the sum of squares of the force",
       &Fit::explained}};
  static const Fields<Setting> all{
      {"radial_offsets_um", "of what is there, mean 0", &Setting::rho},
      {"chip_difference_um", "rho_j - rho_(j-1) of the same",
       [](const Setting& s) { return correction::chip_differences(s.rho); }},
      {"designed_for_um", "of what the command is made for",
       [](const Setting& s) { return correction::chip_differences(s.designed_for); }},
      {"static_fit", "what a rigid model reads from the forces (R-21)", fit,
       [](const Setting& s) { return s.fit; },
       [](const Setting& s) { return s.fit && s.fit->ok; }},
      {"ratio_um", "with a measurement: from the peaks alone, or `null`",
       [](const Setting& s) { return s.ratio->ok ? Value(s.ratio->h_ro) : Value(); },
       [](const Setting& s) { return s.ratio.has_value(); }},
      {"ratio_reason", "why not", [](const Setting& s) { return s.ratio->reason; },
       [](const Setting& s) { return s.ratio && !s.ratio->ok; }},
      {"angle_offset_deg", "true angle less the recorded one",
       [](const Setting& s) { return given(s.angle_offset); }}};
  return all;
}

/// A flute of a cut that moves.
struct FluteOfCut {
  std::size_t number;
  const dynamics::FluteMotion& motion;
  const dynamics::FluteMotion* own;  ///< null: not known
};

const Fields<FluteOfCut>& flute_of_cut_fields() {
  using Of = const FluteOfCut&;
  static const Fields<FluteOfCut> all{
      {"tooth", "number, from 1", &FluteOfCut::number},
      {"peak_Fx_N", "of the whole force while its turn lasts",
       [](Of f) { return f.motion.peak_x; }},
      {"peak_Fy_N",
       "of the whole force while a tooth is nearest to the middle of the arc of cut",
       [](Of f) { return f.motion.peak_y; }},
      {"own_peak_Fy_N", "of this tooth alone, or `null`",
       [](Of f) { return f.own != nullptr ? Value(f.own->peak_y) : Value(); }},
      {"chip_area_mm_rad", "at the tip", [](Of f) { return f.motion.chip_area; }},
      {"peak_chip_mm", "at the tip", [](Of f) { return f.motion.peak_chip; }}};
  return all;
}

const Fields<MovedCut>& moved_cut_fields() {
  using Of = const MovedCut&;
  using Wall = const correction::MarkedWall&;
  static const Fields<correction::MarkedWall> wall{
      {"theta_deg", "0: where the teeth enter, 180: where they leave",
       [](Wall w) { return w.exit ? 180 : 0; }},
      {"peak_to_valley_um", "depth of the feed marks, for a rigid tool (R-25)",
       [](Wall w) { return w.marks.peak_to_valley; }},
      {"share", "fraction of it that each tooth leaves",
       [](Wall w) { return w.marks.share; }}};
  static const Fields<MovedCut> all{
      {"flutes", "in the last turn", flute_of_cut_fields(),
       [](Of cut) {
         std::vector<FluteOfCut> flutes;
         for (std::size_t j = 0; j < cut.motion.flutes.size(); ++j) {
           flutes.push_back({j + 1, cut.motion.flutes[j],
                             j < cut.own.size() ? &cut.own[j] : nullptr});
         }
         return flutes;
       }},
      {"difference", "of the peaks of \\|Fy\\|: (largest - smallest)/largest",
       [](Of cut) { return dynamics::peak_difference(cut.motion); }},
      {"own_difference", "the same of each tooth alone", correction::own_difference},
      {"area_difference", "the same of the chip areas",
       [](Of cut) { return dynamics::area_difference(cut.motion); }},
      {"periodic", "whether the motion repeats",
       [](Of cut) { return std::holds_alternative<dynamics::Periodic>(cut.verdict); }},
      {"change_N", "largest change of the force from the turn before",
       [](Of cut) { return cut.motion.last_change; }},
      {"walls", "beside the cutter", wall, &MovedCut::walls}};
  return all;
}

const Fields<correction::Limit>& limit_fields() {
  using Of = const correction::Limit&;
  const auto known = [](double correction::Limit::*member) {
    return [member](Of l) {
      return as_named(l.known ? Value(unit::in(l.*member, unit_of(l.kind))) : Value());
    };
  };
  static const Fields<correction::Limit> all{
      {"what", "with its unit", [](Of l) { return name_of(l.kind); }},
      {"value", "of the command",
       [](Of l) { return as_named(unit::in(l.value, unit_of(l.kind))); }},
      {"limit", "`null` where it is not known", known(&correction::Limit::limit)},
      {"margin", "up to it, or `null`", known(&correction::Limit::margin)},
      {"ok", "whether it is kept, or `null`",
       [](Of l) { return l.known ? Value(l.ok) : Value(); }},
      {"reason", "in words", [](Of l) { return l.reason; }}};
  return all;
}

/// The limit of a kind; null: there is none.
const correction::Limit* limit_of(const Correction& c, correction::LimitKind kind) {
  const auto& limits = c.plan.limits.limits;
  const auto found = std::ranges::find(limits, kind, &correction::Limit::kind);
  return found == limits.end() ? nullptr : &*found;
}

const Fields<Correction>& command_fields() {
  using C = const Correction&;
  using correction::LimitKind;
  using correction::Optimum;
  static const Fields<Optimum> optimum{
      {"kind", "`equal`, `limit_of_one_axis` or `local_minimum`",
       [](const Optimum& o) { return name_of(o.optimality); }},
      {"proven", "whether nothing better exists", &Optimum::proven},
      {"starts", "of the search", &Optimum::starts},
      {"agreeing", "how many of them ended alike", &Optimum::agreeing}};
  static const Fields<Correction> learning{
      {"iterations", "of iterative learning control",
       [](C c) { return c.plan.learned->iterations; }},
      {"converged", "whether it did", [](C c) { return c.plan.learned->converged; }},
      {"error_um", "before each iteration", [](C c) { return c.plan.learned->error; }}};
  static const Fields<Correction> all{
      {"spindle_rpm", "that it is made for",
       [](C c) { return given(c.setting.cut.setup.cut.Omega); }},
      {"peak_to_peak_um", "of the command",
       [](C c) { return correction::range_of(c.plan.command.wave).peak_to_peak(); }},
      {"offset_um", "of its middle", [](C c) { return c.plan.limits.offset; }},
      {"motion_peak_to_peak_um", "of what the table should do",
       [](C c) { return correction::range_of(c.plan.motion).peak_to_peak(); }},
      {"table_deviation_um", "from that at most, while it is cut upon",
       [](C c) { return c.cuts.table_deviation; }},
      {"lead_s", "by which it is early", [](C c) { return c.plan.command.lead; }},
      {"harmonics", "that it has, or `null`",
       [](C c) {
         return c.plan.command.n_max == 0 ? Value() : Value(c.plan.command.n_max);
       }},
      {"transition_deg", "given or chosen, or `null`",
       [](C c) {
         return all_given(c.plan.transition ? Value(*c.plan.transition) : Value());
       }},
      {"optimum", "three teeth and more: whether there is anything better; else `null`",
       optimum, [](C c) { return c.plan.optimum; }},
      {"within_limits", "of all", [](C c) { return c.plan.limits.ok; }},
      {"limits", "of the actuator", limit_fields(),
       [](C c) -> const auto& {return c.plan.limits.limits;
}
}  // namespace
,
    {"stroke_margin_um", "of the stroke",
     [](C c) { return limit_of(c, LimitKind::stroke)->margin; },
     [](C c) { return limit_of(c, LimitKind::stroke) != nullptr; }},
    {"slew_um_per_s", "largest speed of the command",
     [](C c) { return limit_of(c, LimitKind::slew)->value; },
     [](C c) { return limit_of(c, LimitKind::slew) != nullptr; }},
{
  "learning", "with `strategy = \"learning\"`", learning, [](C c) { return &c; },
      [](C c) { return c.plan.learned.has_value(); }
}
};  // namespace trochoid::results
return all;
}

Object speeds_value(const correction::SpeedMap& map) {
  Object highest;
  for (const correction::Curve& curve : map.curves) {
    highest.push_back({curve.name, unit::in(curve.highest, unit::rpm)});
  }
  return highest;
}

const Fields<CorrectResult>& spindle_fields() {
  using R = const CorrectResult&;
  const auto of = [](auto get) {
    return [get](R r) { return get(*r.correction.speeds.spindle); };
  };
  using M = const correction::SpeedModulation&;
  static const Fields<CorrectResult> all{
      {"difference", "of the peaks that a sine of the speed leaves, on a rigid cut",
       of([](M m) { return m.peak_difference; })},
      {"part", "of the sine that the drive gives", of([](M m) { return m.part; })},
      {"limit", "why not all of it, or `null`",
       of([](M m) { return m.limit.empty() ? Value() : Value(m.limit); })},
      {"speed_change", "largest, as a fraction",
       of([](M m) { return m.speed_change; })},
      {"torque_Nm", "that it takes", of([](M m) { return m.torque; })},
      {"torque_wanted_Nm", "for all of the sine, or `null`", of([](M m) {
         return std::isfinite(m.torque_wanted) ? Value(m.torque_wanted) : Value();
       })},
      {"torque_limit_Nm", "of `[spindle]`",
       [](R r) { return r.options.spindle->torque; }}};
  return all;
}

/// A turn of the controller, and its number.
struct NumberedTurn {
  std::size_t number;
  const correction::LoopTurn& turn;
};

const Fields<ControllerInLoop>& controller_fields() {
  using Run = const ControllerInLoop&;
  using Of = const NumberedTurn&;
  static const Fields<NumberedTurn> turn{
      {"turn", "number, from 1", &NumberedTurn::number},
      {"peaks_Fy_N", "of the flutes", [](Of t) { return t.turn.peaks; }},
      {"difference", "of them", [](Of t) { return t.turn.difference; }},
      {"gain", "of the command", [](Of t) { return t.turn.gain; }},
      {"wave_um", "the largest wave learnt", [](Of t) { return t.turn.wave; }},
      {"tool", "what was recognised of it",
       [](Of t) { return trochoid_tool_event_name(t.turn.event); }},
      {"state", "of the controller",
       [](Of t) { return trochoid_state_name(t.turn.state); }}};
  const auto fault = [](Run run) { return run.fault != TROCHOID_NO_PROBLEM; };
  static const Fields<ControllerInLoop> all{
      {"difference_before", "of the peaks before it runs",
       [](Run run) { return run.turns[correction::enabling_turn - 1].difference; }},
      {"difference_running", "while it runs, or `null`",
       [](Run run) {
         const auto* running = last_running(run);
         return running != nullptr ? Value(running->difference) : Value();
       }},
      {"turns_to_3_percent", "turns of running until below, or `null`",
       [](Run run) { return turns_to_equal(run, equal_difference); }},
      {"gain", "while it runs, or `null`",
       [](Run run) {
         const auto* running = last_running(run);
         return running != nullptr ? Value(running->gain) : Value();
       }},
      {"lowest_um", "of the command", &ControllerInLoop::lowest},
      {"highest_um", "of the command", &ControllerInLoop::highest},
      {"fault", "or `null`",
       [fault](Run run) {
         return fault(run) ? Value(trochoid_problem_name(run.fault)) : Value();
       }},
      {"held_by",
       "where it never runs, what was wrong most often while it waited, or `null`",
       [](Run run) {
         const bool held =
             last_running(run) == nullptr && run.held_by != TROCHOID_NO_PROBLEM;
         return held ? Value(trochoid_problem_name(run.held_by)) : Value();
       }},
      {"fault_time_s", "of it, or `null`",
       [fault](Run run) { return fault(run) ? Value(run.fault_time) : Value(); }},
      {"time_to_safe_s", "from there to rest at mid-stroke, or `null`",
       &ControllerInLoop::time_to_safe},
      {"turns", "every turn", turn, [](Run run) {
         std::vector<NumberedTurn> turns;
         for (const auto& one : run.turns) turns.push_back({turns.size() + 1, one});
         return turns;
       }}};
  return all;
}

const Fields<CorrectResult>& correct_fields() {
  using R = const CorrectResult&;
  using Axes = const correction::AxisLimits&;
  static const Fields<correction::AxisLimits> axes{
      {"uncorrected_um", "as it is", [](Axes a) { return a.uncorrected; }},
      {"one_axis_um", "with one axis at best (R-7)", [](Axes a) { return a.one_axis; }},
      {"two_axes_um", "with two (R-8)", [](Axes a) { return a.two_axes; }},
      {"one_axis_bound_um", "no motion of these harmonics leaves less (R-30)",
       [](Axes a) { return a.one_axis_bound; }},
      {"two_axes_bound_um", "nor with two axes",
       [](Axes a) { return a.two_axes_bound; }},
      {"most_teeth_in_cut", "at once", [](Axes a) { return a.most_teeth; }}};
  static const Fields<CorrectResult> all{
      {"runout", "of what is there, and how it was read", correct_runout_fields(),
       [](R r) { return &r.correction.setting; }},
      {"before", "on the moving cut, last turn, without the command",
       moved_cut_fields(), [](R r) { return &r.correction.cuts.before; }},
      {"after", "the same with it", moved_cut_fields(),
       [](R r) { return &r.correction.cuts.after; }},
      {"reduction", "1 less the ratio of both differences",
       [](R r) { return correction::reduction(r.correction.cuts); }},
      {"command", "the feedforward command", command_fields(),
       [](R r) { return &r.correction; }},
      {"allowed_difference", "as asked for",
       [](R r) { return r.options.allowed_difference; }},
      Field<CorrectResult>{
          "max_rpm",
          "highest spindle speed that keeps `allowed_difference`; the last speed looked "
          "at where it is kept up to there",
          [](R r) { return speeds_value(r.correction.speeds); }}
          .with({{".*", "for each strategy"}}),
      {"max_rpm_cut", "the cut that these are of",
       [](R r) { return name_of(r.correction.speeds.cut); }},
      {"axes", "root mean square of the chip differences over the cut", axes,
       [](R r) { return &r.correction.axes; }},
      {"spindle_speed",
       "with `[spindle]`: a speed that changes within the turn in place of the table",
       spindle_fields(), [](R r) { return &r; },
       [](R r) { return r.correction.speeds.spindle.has_value(); }},
      {"controller", "with `--simulate-controller`", controller_fields(),
       [](R r) { return r.correction.controller; },
       [](R r) { return r.correction.controller && r.correction.controller->ok; }}};
  return all;
}

}  // namespace

Answer answer_of(const CorrectResult& r) {
  const Correction& c = r.correction;
  Answer answer{.command = "correct",
                .heading = r.heading,
                .result = c.ok ? Value(correct_fields().object(r)) : Value(Object{})};
  if (!c.ok) {
    return answer;
  }
  answer.short_table = correct_text(r);
  answer.tables = {command_table(c.plan), before_after_table(c),
                   speeds_table(c.speeds)};
  if (c.speeds.spindle) {
    answer.tables.push_back(spindle_table(*c.speeds.spindle));
  }
  if (c.estimator) {
    answer.tables.push_back(estimator_table(*c.estimator));
  }
  if (c.controller && c.controller->ok) {
    answer.tables.push_back(controller_table(*c.controller));
  }
  answer.texts.push_back({"command.h", command_header(c, r.heading.title)});
  return answer;
}

Description description_of_correct() {
  Description all{.command = "correct", .keys = correct_fields().texts()};
  add_texts_of_correct_tables(all.columns);
  return all;
}

}  // namespace trochoid::results
