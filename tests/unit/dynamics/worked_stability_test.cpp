#include "milling_cut.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

namespace trochoid::dynamics::worked_stability_test {

using nlohmann::json;

std::filesystem::path folder() {
  const char* const shared = std::getenv("TROCHOID_SHARED");
  return std::filesystem::path(shared != nullptr ? shared : TROCHOID_SHARED) /
         "cases/correction";
}

TEST(WorkedStability, OneModeInUpDownAndSlot) {  // [D-11]
  const auto file = folder() / "G21_stability_1dof.json";
  if (!std::filesystem::exists(file)) {
    GTEST_SKIP() << file << " is not at hand";
  }
  const json worked = json::parse(std::ifstream(file));
  const json& in = worked.at("inputs");
  const double m = in.at("m_kg");
  const System system{{mode_of(m, in.at("fn_Hz"), in.at("zeta"), 1, 0)}};
  const force::LinearEdge law{.K_tc = in.at("Kt"), .K_rc = in.at("Kn")};
  const json& cases = in.at("cases");
  const json& expected = worked.at("expected");
  const double tolerance = worked.at("tolerance").at("mu_abs");
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const json& one = cases[i];
    const double a_e = one.at("aD").get<double>() * 10 * unit::mm;
    const bool up = one.at("mode") == "up";
    force::Setup setup =
        straight_cut(in.at("N"), up ? geometry::Engagement(geometry::UpMilling{a_e})
                                    : geometry::Engagement(geometry::DownMilling{a_e}));
    setup.cut.a_p = one.at("ap_mm").get<double>() * unit::mm;
    setup.cut.Omega = one.at("rpm").get<double>() * unit::rpm;
    const double mu = growth(setup, law, system);
    const double wanted = expected.at("mu").at(i);
    EXPECT_NEAR(mu, wanted, tolerance) << one;
    if (std::abs(wanted - 1) > 0.01) {
      EXPECT_EQ(mu < 1, expected.at("stable").at(i).get<bool>()) << one;
    }
  }
  EXPECT_GE(cases.size(), 26U);
}

}  // namespace trochoid::dynamics::worked_stability_test
