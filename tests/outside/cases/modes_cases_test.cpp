// The worked cases of ../shared on modes and actuators that no command shows: free
// vibration, frequency response and step of given parameters. Whatever the files are
// called, their keys say which kind they are.
#include <gtest/gtest.h>
#include <trochoid/structure/actuator.h>
#include <trochoid/structure/mode.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <vector>

namespace trochoid::structure {
namespace {

using nlohmann::json;

constexpr double Hz = 2 * std::numbers::pi;

struct Worked {
  json inputs, expected, tolerance;

  void near(double value, double wanted, const char* what) const {
    EXPECT_NEAR(
        value, wanted,
        tolerance.value("rel", 0.0) * std::abs(wanted) + tolerance.value("abs", 0.0))
        << what;
  }
  /// A list over a list of inputs; the lists of the file have the same length.
  template <class F>
  void compare(const char* over, const char* what, const F& of) const {
    if (!expected.contains(what)) return;
    for (std::size_t i = 0; i < expected[what].size(); ++i) {
      near(of(inputs[over][i].get<double>()), expected[what][i], what);
    }
  }
};

std::vector<std::pair<std::string, Worked>> worked_cases(const char* key) {
  const char* const elsewhere = std::getenv("TROCHOID_SHARED");
  const std::filesystem::path shared =
      elsewhere != nullptr ? elsewhere : TROCHOID_SOURCE_DIR "/../shared";
  std::vector<std::pair<std::string, Worked>> out;
  std::error_code absent;
  for (const auto& entry :
       std::filesystem::directory_iterator(shared / "cases/correction", absent)) {
    if (entry.path().extension() != ".json") continue;
    std::ifstream in(entry.path());
    const json file = json::parse(in);
    if (file.contains("expected") && file["expected"].contains(key)) {
      out.emplace_back(entry.path().filename().string(),
                       Worked{file["inputs"], file["expected"],
                              file.value("tolerance", json::object())});
    }
  }
  return out;
}

ActuatorDynamics actuator_of(const Worked& w) {
  return from_time_constants(w.inputs["K0"], w.inputs["T1"], w.inputs["T2"]);
}

TEST(WorkedModes, FreeVibration) {
  const auto cases = worked_cases("x_m");
  if (cases.empty()) GTEST_SKIP() << "the worked cases are not here";
  for (const auto& [name, w] : cases) {
    SCOPED_TRACE(name);
    const Mode mode{w.inputs["m"], w.inputs["k"], w.inputs["c"]};
    const double wn = natural_frequency(mode);
    const double zeta = damping_ratio(mode);
    const double root = std::sqrt(1 - zeta * zeta);
    w.near(wn / Hz, w.expected["fn_Hz"], "fn_Hz");
    w.near(zeta, w.expected["zeta"], "zeta");
    w.near(wn * root / Hz, w.expected["fd_Hz"], "fd_Hz");
    w.near(Hz * zeta / root, w.expected["log_decrement"], "log_decrement");
    const Motion start{w.inputs["x0_m"], w.inputs["v0"]};
    w.compare("t_s", "x_m", [&](double t) { return free_vibration(mode, start, t).x; });
  }
}

TEST(WorkedModes, ActuatorFrequencyResponse) {
  const auto cases = worked_cases("f_3dB_Hz");
  if (cases.empty()) GTEST_SKIP() << "the worked cases are not here";
  for (const auto& [name, w] : cases) {
    SCOPED_TRACE(name);
    const ActuatorDynamics d = actuator_of(w);
    w.compare("f_Hz", "mag", [&](double f) { return std::abs(response(d, f * Hz)); });
    const auto& phase = w.expected["phase_deg"];
    for (std::size_t i = 0; i < phase.size(); ++i) {
      const double f = w.inputs["f_Hz"][i];
      EXPECT_NEAR(std::arg(response(d, f * Hz)) * 180 / std::numbers::pi,
                  phase[i].get<double>(), w.tolerance.value("phase_abs", 0.0));
    }
    const auto a = equation_coefficients(d);
    w.near(half_power_frequency(d), w.expected["f_3dB_Hz"], "f_3dB_Hz");
    w.near(lag_frequency(d, std::numbers::pi / 4), w.expected["f_phase_minus45_Hz"],
           "f_phase_minus45_Hz");
    w.near(a[0], w.expected["a0"], "a0");
    w.near(a[1], w.expected["a1"], "a1");
    w.near(a[2], w.expected["a2"], "a2");
    w.near(low_frequency_delay(d), w.expected["low_frequency_delay_s"], "delay");
  }
}

TEST(WorkedModes, ActuatorStep) {
  const auto cases = worked_cases("t90_s");
  if (cases.empty()) GTEST_SKIP() << "the worked cases are not here";
  for (const auto& [name, w] : cases) {
    SCOPED_TRACE(name);
    const ActuatorDynamics d = actuator_of(w);
    const double step = w.inputs["step_um"];
    w.compare("t_s", "y_um", [&](double t) { return step * step_response(d, t); });
    w.near(step * d.gain, w.expected["final_um"], "final_um");
    for (const auto& [key, part] : {std::pair{"t10_s", 0.1},
                                    {"t50_s", 0.5},
                                    {"t90_s", 0.9},
                                    {"t95_s", 0.95},
                                    {"t98_s", 0.98}}) {
      w.near(rise_time(d, part), w.expected[key], key);
    }
  }
}

}  // namespace
}  // namespace trochoid::structure
