#include <trochoid/base/units.h>
#include <trochoid/correction/limits.h>
#include <trochoid/correction/plant.h>
#include <trochoid/correction/rigid_cut.h>
#include <trochoid/correction/static_fit.h>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <complex>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <sstream>
#include <string>

namespace trochoid::correction::worked_test {

namespace {

using Json = nlohmann::json;

constexpr double pi = std::numbers::pi;
const PeriodicMotion still = Harmonics{};

std::filesystem::path folder() {
  return TROCHOID_SHARED "/cases/correction";
}

/// Every worked case that has all these keys among what it gives or expects.
std::vector<Json> cases_with(const std::vector<std::string>& keys) {
  std::vector<Json> cases;
  if (!std::filesystem::is_directory(folder())) {
    return cases;
  }
  for (const auto& file : std::filesystem::directory_iterator(folder())) {
    if (file.path().extension() != ".json") {
      continue;
    }
    std::ifstream stream(file.path());
    const Json j = Json::parse(stream);
    if (std::all_of(keys.begin(), keys.end(), [&](const std::string& key) {
          return j["inputs"].contains(key) || j["expected"].contains(key);
        })) {
      cases.push_back(j);
    }
  }
  return cases;
}

force::Setup setup_of(const Json& in) {
  force::Setup setup;
  setup.cutter = {.profile = geometry::cylinder(8e-3),
                  .pitch = geometry::equal_pitch(in["N"]),
                  .lag_diameter = 8e-3};
  setup.cut = {geometry::Slot{}, in.value("ap_mm", 1.0) * unit::mm,
               in["ft_mm"].get<double>() * unit::mm, 1200 * unit::rpm};
  if (in.contains("rho_mm")) {
    for (const double rho : in["rho_mm"].get<std::vector<double>>()) {
      setup.runout.radial_offsets.push_back(rho * unit::mm);
    }
  }
  setup.chip.model = chip::Model::radial;
  if (in.value("mode", "surface") == "eq1") {
    setup.chip.lookback = chip::Lookback::previous;
  }
  return setup;
}

force::Power law_of(const Json& law) {
  return {.K_t1 = law["kt0"].get<double>() * unit::MPa,
          .K_r1 = law["kr0"].get<double>() * unit::MPa,
          .K_a1 = law["ka0"].get<double>() * unit::MPa,
          .m_t = law["mt"],
          .m_r = law["mr"],
          .m_a = law["ma"]};
}

structure::ActuatorDynamics actuator_of(const Json& act) {
  return structure::from_time_constants(act["K0"], act["T1"], act["T2"]);
}

structure::Mode mode_of(const Json& j) {
  return {.mass = j["m"], .stiffness = j["k"], .damping = j["c"]};
}

}  // namespace

TEST(WorkedCorrection, ChipAtEveryAngle) {
  const auto cases = cases_with({"h_tooth0_mm", "rho_mm"});
  if (cases.empty()) {
    GTEST_SKIP() << "no worked cases at " << folder();
  }
  for (const Json& j : cases) {
    SCOPED_TRACE(j["id"].get<std::string>());
    const Json& in = j["inputs"];
    const RigidCut cut(setup_of(in), force::Power{});
    const double allowed = j["tolerance"]["abs"].get<double>() * unit::mm;
    for (int k = 0; k < cut.teeth(); ++k) {
      const auto tooth = static_cast<std::size_t>(k);
      const auto want = j["expected"]["h_tooth" + std::to_string(k) + "_mm"]
                            .get<std::vector<double>>();
      const auto phi = in["phi_deg"].get<std::vector<double>>();
      ASSERT_EQ(phi.size(), want.size());
      for (std::size_t i = 0; i < phi.size(); ++i) {
        const auto chip = cut.chip(still, k, phi[i] * unit::deg + cut.psi()[tooth]);
        EXPECT_NEAR(chip.h, want[i] * unit::mm, allowed) << k << ' ' << phi[i];
        if (k == 0 && j["expected"].contains("delay_teeth_tooth0")) {
          EXPECT_EQ(chip.mark, j["expected"]["delay_teeth_tooth0"][i].get<int>())
              << phi[i];
        }
      }
    }
  }
}

TEST(WorkedCorrection, ChipAreaAndWhereFlutesEnter) {
  const auto cases = cases_with({"chip_area_tooth0_mm_rad", "rho_mm"});
  if (cases.empty()) {
    GTEST_SKIP() << "no worked cases at " << folder();
  }
  for (const Json& j : cases) {
    SCOPED_TRACE(j["id"].get<std::string>());
    const Json& want = j["expected"];
    const RigidCut cut(setup_of(j["inputs"]), force::Power{});
    const auto flutes = cut.flutes(still);
    const double area = j["tolerance"]["chip_area_abs"].get<double>() * unit::mm;
    const double angle = j["tolerance"]["breakpoints_deg_abs"].get<double>();
    for (std::size_t k = 0; k < flutes.size(); ++k) {
      const std::string name = "tooth" + std::to_string(k);
      EXPECT_NEAR(flutes[k].chip_area,
                  want["chip_area_" + name + "_mm_rad"].get<double>() * unit::mm, area);
      const std::string ends = "entry_exit_" + name + "_deg";
      if (!want.contains(ends)) {
        continue;
      }
      for (std::size_t end = 0; end < 2; ++end) {  // in cut inside, in air outside
        const double at = want[ends][end];
        const double inward = end == 0 ? angle : -angle;
        const auto h = [&](double theta) {
          return cut.chip(still, static_cast<int>(k), theta * unit::deg + cut.psi()[k])
              .h;
        };
        EXPECT_GT(h(at + inward), 0.0);
        EXPECT_EQ(h(at - inward), 0.0);
      }
    }
  }
}

TEST(WorkedCorrection, EntryAndExitOfTeethOfTheirOwnRadius) {
  const auto cases = cases_with({"R_mm", "ae_mm", "Rj_mm", "phi_st_ex_deg"});
  if (cases.empty()) {
    GTEST_SKIP() << "no worked cases at " << folder();
  }
  for (const Json& j : cases) {
    const Json& in = j["inputs"];
    const double D = 2 * in["R_mm"].get<double>() * unit::mm;
    const double a_e = in["ae_mm"].get<double>() * unit::mm;
    for (const auto& [name, want] : j["expected"]["phi_st_ex_deg"].items()) {
      const double R_j = std::stod(name.substr(name.find('=') + 1)) * unit::mm;
      const geometry::Engagement engagement =
          name.starts_with("up") ? geometry::Engagement(geometry::UpMilling{a_e})
                                 : geometry::DownMilling{a_e};
      const chip::Arc arc = chip::tooth_arc(engagement, D, R_j);
      const double allowed = j["tolerance"]["abs"];
      EXPECT_NEAR(arc.from / unit::deg, want[0].get<double>(), allowed) << name;
      EXPECT_NEAR(arc.to / unit::deg, want[1].get<double>(), allowed) << name;
    }
  }
}

TEST(WorkedCorrection, PeaksOfTheFlutes) {
  const auto cases = cases_with({"law_A", "law_B", "rho_mm"});
  if (cases.empty()) {
    GTEST_SKIP() << "no worked cases at " << folder();
  }
  for (const Json& j : cases) {
    SCOPED_TRACE(j["id"].get<std::string>());
    const force::Setup setup = setup_of(j["inputs"]);
    const double rel = j["tolerance"]["rel"];
    for (const std::string name : {"A", "B"}) {
      const force::Power law = law_of(j["inputs"]["law_" + name]);
      const auto flutes = RigidCut(setup, law).flutes(still);
      const Json& want = j["expected"][name];
      for (std::size_t k = 0; k < flutes.size(); ++k) {
        const double peak = want["Fy_peaks"][k];
        EXPECT_NEAR(flutes[k].peak_y, peak, rel * peak);
        EXPECT_NEAR(flutes[k].peak_y_angle / unit::deg,
                    want["peak_angle_deg"][k].get<double>(),
                    j["tolerance"]["peak_angle_deg_abs"].get<double>());
      }
      EXPECT_NEAR(peak_difference(flutes), want["diff_over_max"].get<double>(), rel);
    }
    force::Setup round = setup;
    round.runout = {};
    const double peak = j["expected"]["B_no_runout_peak"];
    for (const Flute& flute :
         RigidCut(round, law_of(j["inputs"]["law_B"])).flutes(still)) {
      EXPECT_NEAR(flute.peak_y, peak, rel * peak);
    }
  }
}

TEST(WorkedCorrection, PowerLawAndRunoutFromOneRevolution) {
  const auto cases = cases_with({"csv", "theta_zero", "h_ro_tooth0_mm"});
  if (cases.empty()) {
    GTEST_SKIP() << "no worked cases at " << folder();
  }
  for (const Json& j : cases) {
    SCOPED_TRACE(j["id"].get<std::string>());
    ForceRecord record;
    std::ifstream csv(folder() / j["inputs"]["csv"].get<std::string>());
    std::string line;
    std::getline(csv, line);
    while (std::getline(csv, line)) {
      std::replace(line.begin(), line.end(), ',', ' ');
      std::istringstream words(line);
      double theta = 0.0;
      std::array<double, 3> F{};
      words >> theta >> F[0] >> F[1] >> F[2];
      F[2] = -F[2];  // the cases count F_a, not F_z
      record.angle.push_back(theta * unit::deg);
      record.force.push_back(F);
    }
    const StaticFit fit = static_fit(setup_of(j["inputs"]), record);
    ASSERT_TRUE(fit.ok) << fit.reason;
    const Json& want = j["expected"];
    const double rel = j["tolerance"]["rel"];
    const double m_abs = j["tolerance"]["m_abs"];
    const auto near = [&](double got, const char* key, double allowed) {
      EXPECT_NEAR(got, want[key].get<double>(), allowed) << key;
    };
    near(fit.law.K_t1 / unit::MPa, "kt0", rel * want["kt0"].get<double>());
    near(fit.law.K_r1 / unit::MPa, "kr0", rel * want["kr0"].get<double>());
    near(fit.law.K_a1 / unit::MPa, "ka0", rel * want["ka0"].get<double>());
    near(fit.law.m_t, "mt", m_abs);
    near(fit.law.m_r, "mr", m_abs);
    near(fit.law.m_a, "ma", m_abs);
    near(fit.h_ro[0].value / unit::mm, "h_ro_tooth0_mm",
         j["tolerance"]["h_ro_abs_mm"].get<double>());
    EXPECT_NEAR(fit.offset.value, 0.0, 1e-4);
  }
}

TEST(WorkedCorrection, TableLeftAlone) {
  const auto cases = cases_with({"x0_m", "log_decrement"});
  if (cases.empty()) {
    GTEST_SKIP() << "no worked cases at " << folder();
  }
  for (const Json& j : cases) {
    const Json& in = j["inputs"];
    const Json& want = j["expected"];
    const structure::Mode table = mode_of(in);
    const double rel = j["tolerance"]["rel"];
    for (std::size_t i = 0; i < in["t_s"].size(); ++i) {
      const double x = want["x_m"][i];
      EXPECT_NEAR(
          structure::free_vibration(table, {in["x0_m"], in["v0"]}, in["t_s"][i]).x, x,
          rel * std::abs(x) + j["tolerance"]["abs"].get<double>());
    }
    const double omega_n = structure::natural_frequency(table);
    const double zeta = structure::damping_ratio(table);
    const double root = std::sqrt(1 - zeta * zeta);
    EXPECT_NEAR(omega_n / (2 * pi), want["fn_Hz"].get<double>(), rel * 1500);
    EXPECT_NEAR(omega_n * root / (2 * pi), want["fd_Hz"].get<double>(), rel * 1500);
    EXPECT_NEAR(zeta, want["zeta"].get<double>(), rel * zeta);
    EXPECT_NEAR(2 * pi * zeta / root, want["log_decrement"].get<double>(), rel);
  }
}

TEST(WorkedCorrection, InverseOfASineAndTheSpeedAtWhichItFillsTheStroke) {
  const auto cases = cases_with({"act", "table", "per_rpm"});
  if (cases.empty()) {
    GTEST_SKIP() << "no worked cases at " << folder();
  }
  for (const Json& j : cases) {
    SCOPED_TRACE(j["id"].get<std::string>());
    const Json& in = j["inputs"];
    const Plant plant = held_by_actuator(actuator_of(in["act"]), mode_of(in["table"]));
    const PeriodicMotion sine = Harmonics{0.0, {{0.0, -13e-6}}};  // 26 um peak to peak
    const double rel = j["tolerance"]["rel"];
    const double phase = j["tolerance"]["phase_abs"];
    for (const auto& [rpm, want] : j["expected"]["per_rpm"].items()) {
      const double Omega = std::stod(rpm) * unit::rpm;
      const auto near = [&](double got, const char* key, bool angle) {
        const double x = want[key];
        EXPECT_NEAR(got, x, angle ? phase : rel * std::abs(x)) << key << ' ' << rpm;
      };
      const auto G = structure::response(plant.actuator, Omega);
      const auto P = response(plant, Omega);
      near(std::abs(G), "actuator_gain", false);
      near(std::arg(G) / unit::deg, "actuator_phase_deg", true);
      near(std::abs(P), "plant_gain", false);
      near(std::arg(P) / unit::deg, "plant_phase_deg", true);
      const Command c = command_for(sine, Method::inverse, plant, Omega, {.n_max = 1});
      const auto U = std::get<Harmonics>(c.wave).c[0];
      near(2 * std::abs(U) / unit::um, "command_pp_um_for_table_pp_26", false);
      near(std::arg(U / std::complex<double>(0, -1)) / unit::deg, "command_lead_deg",
           true);
      EXPECT_NEAR(range_of(c.wave).peak_to_peak(), 2 * std::abs(U), 1e-5 * std::abs(U));
    }
    const ActuatorLimits limits{.stroke_high =
                                    in["stroke_um"].get<double>() * unit::um};
    for (const int pp : {26, 30}) {
      const double want = j["expected"]["rpm_limit_pp" + std::to_string(pp)];
      const double got =
          stroke_speed(scaled(sine, pp / 26.0), plant, limits, 1, 20000 * unit::rpm);
      EXPECT_NEAR(got / unit::rpm, want,
                  j["tolerance"]["rpm_rel"].get<double>() * want);
    }
  }
}

}  // namespace trochoid::correction::worked_test
