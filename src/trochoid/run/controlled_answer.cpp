#include <trochoid/results/json.h>
#include <trochoid/run/controlled_answer.h>

#include <trochoid/base/units.h>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

namespace trochoid::run {

namespace {

using Json = nlohmann::ordered_json;

/// Flutes that differ by less cut alike.
constexpr double alike = 0.03;

Json turns_json(const ControlledCut& run) {
  Json turns = Json::array();
  for (std::size_t n = 0; n < run.turns.size(); ++n) {
    const ControlledTurn& t = run.turns[n];
    turns.push_back({{"turn", n + 1},
                     {"peaks_Fy_N", t.peaks},
                     {"difference", t.difference},
                     {"gain", t.gain},
                     {"state", trochoid_state_name(t.state)}});
  }
  return turns;
}

/// Turns of running until the flutes are alike and stay so; negative: never.
int turns_to_alike(const ControlledCut& run) {
  int first = -1;
  int running = 0;
  for (const ControlledTurn& t : run.turns) {
    if (t.state != TROCHOID_RUNNING) {
      continue;
    }
    ++running;
    if (t.difference >= alike) {
      first = -1;
    } else if (first < 0) {
      first = running;
    }
  }
  return first;
}

const ControlledTurn* last_running(const ControlledCut& run) {
  const ControlledTurn* last = nullptr;
  for (const ControlledTurn& t : run.turns) {
    if (t.state == TROCHOID_RUNNING) {
      last = &t;
    }
  }
  return last;
}

base::Table samples_table(const ControlledCut& run) {
  base::Table table{"controller.csv",
                    {{"time_s", {}},
                     {"command_um", {}},
                     {"table_um", {}},
                     {"gain", {}},
                     {"state", {}}}};
  for (const ControllerSample& s : run.samples) {
    const double row[] = {s.time, s.command / unit::um, s.table / unit::um, s.gain,
                          static_cast<double>(s.state)};
    for (std::size_t c = 0; c < table.columns.size(); ++c) {
      table.columns[c].values.push_back(row[c]);
    }
  }
  return table;
}

}  // namespace

void add_controlled(const ControlledCut& run, results::Answer& answer) {
  Json result = Json::parse(results::json_text(answer.result));
  if (!run.ok) {
    answer.heading.ok = false;
    answer.heading.message = run.reason;
    return;
  }
  const ControlledTurn& before = run.turns[enabled_from - 1];
  const ControlledTurn* after = last_running(run);
  const int settled = turns_to_alike(run);
  const bool fault = run.fault != TROCHOID_NO_PROBLEM;
  result["controller"] = {
      {"difference_before", before.difference},
      {"difference_running",
       after != nullptr ? Json(after->difference) : Json(nullptr)},
      {"turns_to_3_percent", settled > 0 ? Json(settled) : Json(nullptr)},
      {"gain", after != nullptr ? Json(after->gain) : Json(nullptr)},
      {"lowest_um", run.lowest / unit::um},
      {"highest_um", run.highest / unit::um},
      {"fault", fault ? Json(trochoid_problem_name(run.fault)) : Json(nullptr)},
      {"fault_time_s", fault ? Json(run.fault_time) : Json(nullptr)},
      {"time_to_safe_s",
       run.time_to_safe >= 0 ? Json(run.time_to_safe) : Json(nullptr)},
      {"turns", turns_json(run)}};
  answer.result = results::json_value(result.dump());
  answer.tables.push_back(samples_table(run));
  answer.short_table += fmt::format(
      "controller: {:.2f} % before, {} running", 100 * before.difference,
      after != nullptr ? fmt::format("{:.2f} %", 100 * after->difference) : "never");
  answer.short_table +=
      fault ? fmt::format(
                  "; fault \"{}\" at {:.3f} s, {}\n", trochoid_problem_name(run.fault),
                  run.fault_time,
                  run.time_to_safe >= 0
                      ? fmt::format("at mid-stroke {:.3f} s later", run.time_to_safe)
                      : "not yet at mid-stroke")
            : fmt::format("; command within {:.2f} and {:.2f} um\n",
                          run.lowest / unit::um, run.highest / unit::um);
  if (!run.finite) {
    answer.heading.warnings.push_back(
        {"ran_away", "Under the controller the cut grew beyond all bounds."});
  }
}

}  // namespace trochoid::run
