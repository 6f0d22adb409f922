// What the controller and the estimator say to what compare_controller.py sends, as JSON.
#include <trochoid/correction/controller.h>
#include <trochoid/correction/estimator.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <iostream>

namespace {

using Json = nlohmann::json;

/// A model of teeth at equal pitch that learns at once.
TrochoidEstimatorConfig config_of(const Json& in) {
  TrochoidEstimatorConfig c;
  trochoid_estimator_defaults(&c);
  const auto S = in["S"].get<std::vector<std::vector<double>>>();
  c.teeth = static_cast<int32_t>(S.size());
  c.harmonics = static_cast<int32_t>(S[0].size() / 2);
  c.wait_turns = 0;
  c.deadband = 0.0;
  c.event_change = in.value("event_change", 0.0);
  c.settled_turns = in.value("settled_turns", c.settled_turns);
  c.most_m = 1.0;
  c.step_m = 1.0;
  for (std::size_t j = 0; j < S.size(); ++j) {
    c.start_rev[j] = static_cast<double>(j) / static_cast<double>(S.size());
    for (std::size_t k = 0; k < S[j].size(); ++k) {
      c.wave_model[j][k] = S[j][k] / 1e-5;
    }
    for (std::size_t i = 0; i < S.size() && in.contains("W"); ++i) {
      c.runout_model[j][i] = in["W"][j][i].get<double>() / 1e-5;
    }
  }
  return c;
}

/// Waves that an estimator learns from forces, turn by turn, and what it recognises.
Json learnt(const Json& in) {
  static TrochoidEstimator estimator;
  const TrochoidEstimatorConfig c = config_of(in);
  Json out = {{"waves", Json::array()}, {"events", Json::array()}};
  trochoid_estimator_init(&estimator, &c);
  const auto turns = in["v"].get<std::vector<std::vector<double>>>();
  for (std::size_t t = 0; t <= turns.size(); ++t) {
    const auto& v = turns[std::min(t, turns.size() - 1)];
    for (std::size_t i = 0; i < 20 * v.size(); ++i) {
      const double angle =
          (static_cast<double>(i) + 0.5) / (20.0 * static_cast<double>(v.size()));
      const auto result =
          trochoid_estimator_sample(&estimator, angle, 100 * (1 + v[i / 20]), 1);
      if (result.event != TROCHOID_TOOL_UNCHANGED) {
        out["events"].push_back({{"turn", t - 1},
                                 {"one", result.event == TROCHOID_TOOTH_WORN},
                                 {"tooth", result.tooth},
                                 {"change", result.change_m / 1e-5}});
      }
      if (result.turn == TROCHOID_TURN_LEARNT) {
        Json wave;
        for (int n = 0; n < c.harmonics; ++n) {
          wave.push_back(result.cosine_m[n] / 1e-5);
          wave.push_back(result.sine_m[n] / 1e-5);
        }
        out["waves"].push_back(wave);
      }
    }
  }
  return out;
}

/// Angle and command at every step, the table empty.
Json commanded(const Json& in) {
  static TrochoidController controller;
  TrochoidControllerConfig c;
  trochoid_controller_defaults(&c);
  c.wrap_rev = in["wrap"];
  c.slew_m_per_s = 1.0;
  c.lead_s = in["lead"];
  trochoid_controller_init(&controller, &c);
  Json out;
  for (const auto& step : in["steps"]) {
    TrochoidControllerInput now{};
    now.position_rev = step["position"];
    now.index = step["index"];
    now.index_position_rev = step["at_index"];
    now.speed_rps = in["speed"];
    now.dt_s = c.period_s;
    now.enable = 1;
    for (std::size_t n = 0; n < in["a"].size(); ++n) {
      now.cosine_m[n] = in["a"][n];
      now.sine_m[n] = in["b"][n];
    }
    const auto result = trochoid_controller_step(&controller, &now);
    out.push_back({result.angle_rev, result.command_m - controller.middle_m,
                   static_cast<double>(result.state == TROCHOID_RUNNING)});
  }
  return {{"period", c.period_s}, {"steps", out}};
}

}  // namespace

int main() {
  Json out;
  for (const Json& in : Json::parse(std::cin)) {
    out.push_back(in.contains("S") ? learnt(in) : commanded(in));
  }
  std::cout << out.dump() << '\n';
}
