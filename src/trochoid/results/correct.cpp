#include <trochoid/results/correct.h>

#include <trochoid/base/units.h>
#include <trochoid/results/correct_tables.h>

#include <cmath>
#include <utility>

namespace trochoid::results {

namespace {

using correction::ControllerInLoop;
using correction::Correction;
using correction::MovedCut;
using correction::Plan;
using correction::Setting;

/// Flutes whose peaks differ by less are equal, for `turns_to_3_percent`.
constexpr double equal_difference = 0.03;

Value um(const std::vector<double>& values) {
  return all_in_unit(values, unit::um);
}

Array estimates_value(const std::vector<correction::Value>& values) {
  Array list;
  for (const correction::Value& v : values) {
    list.push_back(Object{{"value", v.value / unit::um}, {"se", v.se / unit::um}});
  }
  return list;
}

Object runout_value(const Setting& s) {
  Object runout{{"radial_offsets_um", um(s.rho)},
                {"chip_difference_um", um(correction::chip_differences(s.rho))},
                {"designed_for_um", um(correction::chip_differences(s.designed_for))}};
  const auto add = [&](const char* key, Value value) {
    runout.push_back({key, std::move(value)});
  };
  if (s.fit && s.fit->ok) {
    add("static_fit", Object{{"chip_difference_um", estimates_value(s.fit->h_ro)},
                             {"rms_N", s.fit->rms},
                             {"explained", s.fit->explained}});
  }
  if (s.ratio) {
    add("ratio_um", s.ratio->ok ? um(s.ratio->h_ro) : Value());
    if (!s.ratio->ok) {
      add("ratio_reason", s.ratio->reason);
    }
  }
  add("angle_offset_deg", unit::in(s.angle_offset, unit::deg));
  return runout;
}

Array walls_value(const std::vector<correction::MarkedWall>& walls) {
  Array list;
  for (const correction::MarkedWall& wall : walls) {
    list.push_back(Object{{"theta_deg", wall.exit ? 180 : 0},
                          {"peak_to_valley_um", wall.marks.peak_to_valley / unit::um},
                          {"share", wall.marks.share}});
  }
  return list;
}

Object cut_value(const MovedCut& cut) {
  const dynamics::Motion& m = cut.motion;
  Array flutes;
  for (std::size_t j = 0; j < m.flutes.size(); ++j) {
    const dynamics::FluteMotion& f = m.flutes[j];
    flutes.push_back(Object{
        {"tooth", j + 1},
        {"peak_Fx_N", f.peak_x},
        {"peak_Fy_N", f.peak_y},
        {"own_peak_Fy_N", j < cut.own.size() ? Value(cut.own[j].peak_y) : Value()},
        {"chip_area_mm_rad", f.chip_area / unit::mm},
        {"peak_chip_mm", f.peak_chip / unit::mm}});
  }
  return {{"flutes", std::move(flutes)},
          {"difference", dynamics::peak_difference(m)},
          {"own_difference", correction::own_difference(cut)},
          {"area_difference", dynamics::area_difference(m)},
          {"periodic", std::holds_alternative<dynamics::Periodic>(cut.verdict)},
          {"change_N", m.last_change},
          {"walls", walls_value(cut.walls)}};
}

Array limits_value(const correction::LimitReport& report) {
  Array list;
  for (const correction::Limit& l : report.limits) {
    const auto known = [&](double value) {
      return l.known ? Value(unit::in(value, unit_of(l.kind))) : Value();
    };
    list.push_back(Object{{"what", name_of(l.kind)},
                          {"value", unit::in(l.value, unit_of(l.kind))},
                          {"limit", known(l.limit)},
                          {"margin", known(l.margin)},
                          {"ok", l.known ? Value(l.ok) : Value()},
                          {"reason", l.reason}});
  }
  return list;
}

Object optimum_value(const correction::Optimum& optimum) {
  return {{"kind", name_of(optimum.optimality)},
          {"proven", optimum.proven},
          {"starts", optimum.starts},
          {"agreeing", optimum.agreeing}};
}

Object command_value(const Correction& c) {
  const Plan& plan = c.plan;
  Object command{
      {"spindle_rpm", unit::in(c.setting.cut.setup.cut.Omega, unit::rpm)},
      {"peak_to_peak_um",
       correction::range_of(plan.command.wave).peak_to_peak() / unit::um},
      {"offset_um", plan.limits.offset / unit::um},
      {"motion_peak_to_peak_um",
       correction::range_of(plan.motion).peak_to_peak() / unit::um},
      {"table_deviation_um", c.cuts.table_deviation / unit::um},
      {"lead_s", plan.command.lead},
      {"harmonics", plan.command.n_max == 0 ? Value() : Value(plan.command.n_max)},
      {"transition_deg",
       plan.transition ? Value(unit::in(*plan.transition, unit::deg)) : Value()},
      {"optimum", plan.optimum ? Value(optimum_value(*plan.optimum)) : Value()},
      {"within_limits", plan.limits.ok},
      {"limits", limits_value(plan.limits)}};
  for (const correction::Limit& l : plan.limits.limits) {
    if (l.kind == correction::LimitKind::stroke) {
      command.push_back({"stroke_margin_um", l.margin / unit::um});
    } else if (l.kind == correction::LimitKind::slew) {
      command.push_back({"slew_um_per_s", l.value / unit::um});
    }
  }
  if (plan.learned) {
    command.push_back({"learning", Object{{"iterations", plan.learned->iterations},
                                          {"converged", plan.learned->converged},
                                          {"error_um", um(plan.learned->error)}}});
  }
  return command;
}

Object speeds_value(const correction::SpeedMap& map) {
  Object highest;
  for (const correction::Curve& curve : map.curves) {
    highest.push_back({curve.name, unit::in(curve.highest, unit::rpm)});
  }
  return highest;
}

Object spindle_value(const correction::SpeedModulation& m, double allowed) {
  return {{"difference", m.peak_difference},
          {"part", m.part},
          {"limit", m.limit.empty() ? Value() : Value(m.limit)},
          {"speed_change", m.speed_change},
          {"torque_Nm", m.torque},
          {"torque_wanted_Nm",
           std::isfinite(m.torque_wanted) ? Value(m.torque_wanted) : Value()},
          {"torque_limit_Nm", allowed}};
}

Array turns_value(const ControllerInLoop& run) {
  Array turns;
  for (std::size_t n = 0; n < run.turns.size(); ++n) {
    const correction::LoopTurn& t = run.turns[n];
    turns.push_back(Object{{"turn", n + 1},
                           {"peaks_Fy_N", t.peaks},
                           {"difference", t.difference},
                           {"gain", t.gain},
                           {"wave_um", t.wave / unit::um},
                           {"tool", trochoid_tool_event_name(t.event)},
                           {"state", trochoid_state_name(t.state)}});
  }
  return turns;
}

Object controller_value(const ControllerInLoop& run) {
  const correction::LoopTurn* running = last_running(run);
  const bool fault = run.fault != TROCHOID_NO_PROBLEM;
  return {
      {"difference_before", run.turns[correction::enabling_turn - 1].difference},
      {"difference_running", running != nullptr ? Value(running->difference) : Value()},
      {"turns_to_3_percent", turns_to_equal(run, equal_difference)},
      {"gain", running != nullptr ? Value(running->gain) : Value()},
      {"lowest_um", run.lowest / unit::um},
      {"highest_um", run.highest / unit::um},
      {"fault", fault ? Value(trochoid_problem_name(run.fault)) : Value()},
      {"fault_time_s", fault ? Value(run.fault_time) : Value()},
      {"time_to_safe_s", run.time_to_safe},
      {"turns", turns_value(run)}};
}

Object result_of(const CorrectResult& r) {
  const Correction& c = r.correction;
  if (!c.ok) {
    return {};
  }
  const correction::AxisLimits& axes = c.axes;
  Object result{{"runout", runout_value(c.setting)},
                {"before", cut_value(c.cuts.before)},
                {"after", cut_value(c.cuts.after)},
                {"reduction", correction::reduction(c.cuts)},
                {"command", command_value(c)},
                {"allowed_difference", r.options.allowed_difference},
                {"max_rpm", speeds_value(c.speeds)},
                {"max_rpm_cut", name_of(c.speeds.cut)},
                {"axes", Object{{"uncorrected_um", axes.uncorrected / unit::um},
                                {"one_axis_um", axes.one_axis / unit::um},
                                {"two_axes_um", axes.two_axes / unit::um},
                                {"one_axis_bound_um", axes.one_axis_bound / unit::um},
                                {"two_axes_bound_um", axes.two_axes_bound / unit::um},
                                {"most_teeth_in_cut", axes.most_teeth}}}};
  if (c.speeds.spindle) {
    result.push_back(
        {"spindle_speed", spindle_value(*c.speeds.spindle, r.options.spindle->torque)});
  }
  if (c.controller && c.controller->ok) {
    result.push_back({"controller", controller_value(*c.controller)});
  }
  return result;
}

}  // namespace

Answer answer_of(const CorrectResult& r) {
  const Correction& c = r.correction;
  Answer answer{.command = "correct", .heading = r.heading, .result = result_of(r)};
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

}  // namespace trochoid::results
