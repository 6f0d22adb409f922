#include <trochoid/results/json.h>
#include <trochoid/run/correction_answer.h>

#include <trochoid/base/units.h>
#include <trochoid/correction/shapes.h>
#include <trochoid/correction/wall_marks.h>
#include <trochoid/run/correction_tables.h>
#include <trochoid/run/correction_words.h>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace trochoid::run {

namespace {

using Json = nlohmann::ordered_json;

constexpr double grows = 1.02;          ///< from turn to turn: chatter
constexpr double repeats = 0.01;        ///< of the peak force: the cut is steady
constexpr int harmonics_of_table = 60;  ///< of its motion over a turn
constexpr double at_the_wall = 1e-6;    ///< [rad]
constexpr double shakes = 0.1;  ///< of the peak force: chatter that grows no more

double peak_of(const dynamics::Motion& m) {
  double peak = 0.0;
  for (const dynamics::FluteMotion& f : m.flutes) {
    peak = std::max({peak, f.peak_x, f.peak_y});
  }
  return peak;
}

Json um(const std::vector<double>& values) {
  Json list = Json::array();
  for (const double value : values) {
    list.push_back(value / unit::um);
  }
  return list;
}

Json values_json(const std::vector<correction::Value>& values) {
  Json list = Json::array();
  for (const correction::Value& v : values) {
    list.push_back({{"value", v.value / unit::um}, {"se", v.se / unit::um}});
  }
  return list;
}

Json runout_json(const CorrectionSetting& s) {
  Json runout{{"radial_offsets_um", um(s.rho)},
              {"chip_difference_um", um(chip_differences(s.rho))},
              {"designed_for_um", um(chip_differences(s.designed_for))}};
  if (s.fit && s.fit->ok) {
    runout["static_fit"] = {{"chip_difference_um", values_json(s.fit->h_ro)},
                            {"rms_N", s.fit->rms},
                            {"explained", s.fit->explained}};
  }
  if (s.ratio) {
    runout["ratio_um"] = s.ratio->ok ? um(s.ratio->h_ro) : Json(nullptr);
    if (!s.ratio->ok) {
      runout["ratio_reason"] = s.ratio->reason;
    }
  }
  runout["angle_offset_deg"] = unit::in(s.angle_offset, unit::deg);
  return runout;
}

Json limits_json(const correction::LimitReport& report) {
  struct Words {
    const char* name;
    double unit;
  };
  constexpr Words words[] = {{"stroke_um", unit::um}, {"slew_um_per_s", unit::um},
                             {"push_N", 1.0},         {"pull_N", 1.0},
                             {"frequency_Hz", 1.0},   {"spindle_rpm", unit::rpm}};
  Json list = Json::array();
  for (const correction::Limit& l : report.limits) {
    const Words& w = words[static_cast<std::size_t>(l.kind)];
    list.push_back(
        {{"what", w.name},
         {"value", unit::in(l.value, w.unit)},
         {"limit", l.known ? Json(unit::in(l.limit, w.unit)) : Json(nullptr)},
         {"margin", l.known ? Json(unit::in(l.margin, w.unit)) : Json(nullptr)},
         {"ok", l.known ? Json(l.ok) : Json(nullptr)},
         {"reason", l.reason}});
  }
  return list;
}

Json command_json(const CorrectionFindings& f) {
  const correction::Range range = correction::range_of(f.plan.command.wave);
  Json command{{"peak_to_peak_um", range.peak_to_peak() / unit::um},
               {"offset_um", f.plan.limits.offset / unit::um},
               {"motion_peak_to_peak_um",
                correction::range_of(f.plan.motion).peak_to_peak() / unit::um},
               {"table_deviation_um", table_deviation(f) / unit::um},
               {"lead_s", f.plan.command.lead},
               {"harmonics",
                f.plan.command.n_max == 0 ? Json(nullptr) : Json(f.plan.command.n_max)},
               {"within_limits", f.plan.limits.ok},
               {"limits", limits_json(f.plan.limits)}};
  for (const correction::Limit& l : f.plan.limits.limits) {
    if (l.kind == correction::LimitKind::stroke) {
      command["stroke_margin_um"] = l.margin / unit::um;
    } else if (l.kind == correction::LimitKind::slew) {
      command["slew_um_per_s"] = l.value / unit::um;
    }
  }
  if (f.plan.learned) {
    command["learning"] = {{"iterations", f.plan.learned->iterations},
                           {"converged", f.plan.learned->converged},
                           {"error_um", um(f.plan.learned->error)}};
  }
  return command;
}

/// The marks on the walls that the arc of cut reaches, with the table as it moved.
Json walls_json(const CorrectionSetting& s, const dynamics::Motion& m) {
  const correction::RigidCut cut(s.cut.setup, s.cut.law, 1);
  const std::vector<double>& table = m.mode[s.cut.tool.size()];
  const correction::PeriodicMotion X =
      correction::harmonics_of_samples(table, harmonics_of_table);
  Json walls = Json::array();
  for (const bool exit : {false, true}) {
    const double theta = exit ? std::numbers::pi : 0.0;
    if (theta < cut.arc().from - at_the_wall || theta > cut.arc().to + at_the_wall) {
      continue;
    }
    const correction::WallMarks marks = correction::wall_marks(cut, X, exit);
    walls.push_back({{"theta_deg", exit ? 180 : 0},
                     {"peak_to_valley_um", marks.peak_to_valley / unit::um},
                     {"share", marks.share}});
  }
  return walls;
}

Json cut_json(const CorrectionSetting& s, const dynamics::Motion& m) {
  Json flutes = Json::array();
  for (std::size_t j = 0; j < m.flutes.size(); ++j) {
    const dynamics::FluteMotion& f = m.flutes[j];
    flutes.push_back({{"tooth", j + 1},
                      {"peak_Fx_N", f.peak_x},
                      {"peak_Fy_N", f.peak_y},
                      {"chip_area_mm_rad", f.chip_area / unit::mm},
                      {"peak_chip_mm", f.peak_chip / unit::mm}});
  }
  return {{"flutes", flutes},
          {"difference", difference_of(m)},
          {"area_difference", area_difference_of(m)},
          {"periodic", periodic(m)},
          {"change_N", m.last_change},
          {"walls", walls_json(s, m)}};
}

Json axes_json(const correction::AxisLimits& axes) {
  return {{"uncorrected_um", axes.uncorrected / unit::um},
          {"one_axis_um", axes.one_axis / unit::um},
          {"two_axes_um", axes.two_axes / unit::um},
          {"most_teeth_in_cut", axes.most_teeth}};
}

correction::AxisLimits axes_of(const CorrectionFindings& f) {
  const correction::RigidCut rigid(f.setting.cut.setup, f.setting.cut.law,
                                   f.setting.cut.slices);
  return correction::axis_limits(rigid, f.wanted.harmonics);
}

}  // namespace

bool periodic(const dynamics::Motion& m) {
  return m.finite && m.last_change <= repeats * peak_of(m);
}

double area_difference_of(const dynamics::Motion& m) {
  const auto [low, high] = std::minmax_element(
      m.flutes.begin(), m.flutes.end(),
      [](const auto& a, const auto& b) { return a.chip_area < b.chip_area; });
  return high->chip_area > 0 ? 1 - low->chip_area / high->chip_area : 0.0;
}

std::vector<double> chip_differences(const std::vector<double>& rho) {
  std::vector<double> h_ro;
  for (std::size_t j = 0; j < rho.size(); ++j) {
    h_ro.push_back(rho[j] - rho[(j + rho.size() - 1) % rho.size()]);
  }
  return h_ro;
}

double table_deviation(const CorrectionFindings& f) {
  const dynamics::Motion& m = f.moved.after;
  const std::vector<double>& table = m.mode[f.setting.cut.tool.size()];
  double most = 0.0;
  for (std::size_t i = 0; i < table.size(); ++i) {
    const double wanted = correction::place_at(f.plan.motion, m.angle[i]);
    most = std::max(most, std::abs(table[i] - wanted));
  }
  return most;
}

std::string chatter_in(const BeforeAfter& moved) {
  for (const auto* m : {&moved.before, &moved.after}) {
    const char* when = m == &moved.before ? "before" : "after";
    if (!m->finite || !m->solved) {
      return fmt::format(
          "chatter {} the correction: after {} turns the "
          "motion had grown beyond all bounds",
          when, m->turns_done);
    }
    if (!periodic(*m) &&
        (m->growth.value_or(1.0) > grows || m->last_change > shakes * peak_of(*m))) {
      return fmt::format(
          "chatter {} the correction: the force still changes by {:.3g} of {:.3g} N "
          "from turn to turn; there are no steady peaks to make equal",
          when, m->last_change, peak_of(*m));
    }
  }
  return {};
}

double difference_of(const dynamics::Motion& m) {
  const auto [low, high] = std::minmax_element(
      m.flutes.begin(), m.flutes.end(),
      [](const auto& a, const auto& b) { return a.peak_y < b.peak_y; });
  return high->peak_y > 0 ? 1 - low->peak_y / high->peak_y : 0.0;
}

void fill_answer(const CorrectionFindings& f, results::Answer& answer) {
  const correction::AxisLimits axes = axes_of(f);
  const double before = difference_of(f.moved.before);
  const double after = difference_of(f.moved.after);
  Json highest = Json::object();
  for (std::size_t s = 0; s < f.map.strategies.size(); ++s) {
    highest[f.map.strategies[s].name] = unit::in(f.map.highest[s], unit::rpm);
  }
  const Json result{
      {"runout", runout_json(f.setting)},
      {"before", cut_json(f.setting, f.moved.before)},
      {"after", cut_json(f.setting, f.moved.after)},
      {"reduction", before > 0 ? Json(1 - after / before) : Json(nullptr)},
      {"command", command_json(f)},
      {"allowed_difference", f.wanted.allowed_difference},
      {"max_rpm", highest},
      {"axes", axes_json(axes)}};
  answer.result = results::json_value(result.dump());
  add_correction_warnings(f, axes, answer);
  answer.tables.push_back(command_table(f.plan));
  answer.tables.push_back(before_after_table(f.setting, f.moved));
  answer.tables.push_back(map_table(f.map));
  answer.texts.push_back(
      {"command.h", command_header(f.setting, f.plan, answer.heading.title)});
  answer.heading.message = fmt::format(
      "The flutes' peaks differ by {:.2f} % with the command, {:.2f} % without.",
      100 * after, 100 * before);
  answer.short_table = correction_table(f);
}

}  // namespace trochoid::run
