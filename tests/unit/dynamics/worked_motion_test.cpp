#include <trochoid/base/units.h>
#include <trochoid/dynamics/motion.h>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>

namespace trochoid::dynamics::worked_motion_test {

namespace {

using Json = nlohmann::json;

MotionProblem problem_of(const Json& in) {
  MotionProblem p;
  p.setup.cutter = {.profile = geometry::cylinder(8e-3),
                    .pitch = geometry::equal_pitch(in["N"]),
                    .lag_diameter = 8e-3};
  p.setup.cut = {geometry::Slot{}, in["ap_mm"].get<double>() * unit::mm,
                 in["ft_mm"].get<double>() * unit::mm,
                 in["rpm"].get<double>() * unit::rpm};
  for (const double rho : in["rho_mm"].get<std::vector<double>>()) {
    p.setup.runout.radial_offsets.push_back(rho * unit::mm);
  }
  p.setup.chip.model = chip::Model::radial;
  const Json& law = in["law"];
  p.law = force::Power{.K_t1 = law["kt0"].get<double>() * unit::MPa,
                       .K_r1 = law["kr0"].get<double>() * unit::MPa,
                       .m_t = law["mt"],
                       .m_r = law["mr"]};
  const Json& tool = in["tool"];
  const Json& table = in["table"];
  p.system.modes = {{tool["m"], tool["c"], tool["k"], 1, 0},
                    {tool["m"], tool["c"], tool["k"], 0, 1},
                    {table["m"], table["c"], table["k"], -1, 0}};
  const double K_0 = in["actuator"]["K0"];
  const double T_1 = in["actuator"]["T1"];
  const double T_2 = in["actuator"]["T2"];
  p.drive =
      Drive{2, 1 / K_0, (T_1 + T_2) / K_0, T_1 * T_2 / K_0, table["k"], table["c"]};
  const std::string command = in["x_com_m"];
  if (command.starts_with("13e-6*sin(Omega*(t+T1+T2))")) {
    p.command = [omega = p.setup.cut.Omega, lead = T_1 + T_2](double t) {
      return 13e-6 * std::sin(omega * (t + lead));
    };
  } else if (command != "0") {
    ADD_FAILURE() << "a command that this test does not know: " << command;
  }
  p.grid.lookback = in["K"];
  p.revolutions = in["revolutions"];
  // The times of the cases are multiples of 1/40 of a turn.
  p.samples_per_rev = 720;
  return p;
}

}  // namespace

/// Every worked case of the whole model: forces, motion and peaks of the flutes.
TEST(WorkedMotion, AgreesWithTheMethodOfSteps) {
  const std::filesystem::path folder = TROCHOID_SHARED "/cases/correction";
  if (!std::filesystem::is_directory(folder)) {
    GTEST_SKIP() << "no worked cases at " << folder;
  }
  int cases = 0;
  for (const auto& file : std::filesystem::directory_iterator(folder)) {
    if (file.path().extension() != ".json") {
      continue;
    }
    std::ifstream stream(file.path());
    const Json j = Json::parse(stream);
    if (!j["expected"].contains("Fy_peaks_last_rev") ||
        !j["inputs"].contains("x_com_m")) {
      continue;
    }
    SCOPED_TRACE(file.path().filename().string());
    ++cases;
    const Motion m = motion(problem_of(j["inputs"]));
    const Json& want = j["expected"];
    const Json& tolerance = j["tolerance"];
    std::array<double, 2> peaks{};
    for (std::size_t k = 0; k < 2; ++k) {
      peaks[k] = want["Fy_peaks_last_rev"][k];
      EXPECT_NEAR(m.flutes[k].peak_y, peaks[k],
                  tolerance["Fy_peaks_rel"].get<double>() * peaks[k]);
    }
    const double larger = std::max(m.flutes[0].peak_y, m.flutes[1].peak_y);
    EXPECT_NEAR(std::abs(m.flutes[0].peak_y - m.flutes[1].peak_y) / larger,
                want["diff_over_max"].get<double>(),
                tolerance["diff_abs"].get<double>());
    for (std::size_t i = 0; i < want["t_s"].size(); ++i) {
      const double at = want["t_s"][i].get<double>() - m.time.front();
      const double step = m.time[1] - m.time[0];
      const auto k = static_cast<std::size_t>(std::lround(at / step));
      ASSERT_LT(k, m.time.size());
      ASSERT_NEAR(m.time[k], want["t_s"][i].get<double>(), 1e-9);
      const auto near = [&](const char* key, double got, const char* allowed) {
        EXPECT_NEAR(got, want[key][i].get<double>(), tolerance[allowed].get<double>())
            << key << ' ' << i;
      };
      near("Fx_N", m.force[k][0], "F_abs");
      near("Fy_N", m.force[k][1], "F_abs");
      near("x_tool_um", m.mode[0][k] / unit::um, "x_abs_um");
      near("y_tool_um", m.mode[1][k] / unit::um, "x_abs_um");
      near("x_table_um", m.mode[2][k] / unit::um, "x_abs_um");
      near("x_pa_um", m.actuator[k] / unit::um, "x_abs_um");
    }
  }
  EXPECT_GT(cases, 0);
}

}  // namespace trochoid::dynamics::worked_motion_test
