#include "made_record.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

namespace trochoid::identification::worked_cases_test {

using nlohmann::json;

std::filesystem::path folder() {
  const char* const shared = std::getenv("TROCHOID_SHARED");
  return std::filesystem::path(shared != nullptr ? shared : TROCHOID_SHARED) /
         "cases/force";
}

force::Setup setup_of(const json& worked) {
  const json& tool = worked.at("tool");
  force::Setup out = slot_setup(tool.at("N"), tool.at("helix_deg"),
                                worked.at("cut").at("ap").get<double>() * unit::mm);
  out.cutter.profile = geometry::cylinder(tool.at("D").get<double>() * unit::mm);
  out.cutter.lag_diameter = tool.at("lag_diameter").get<double>() * unit::mm;
  out.cut.f_z = worked.at("cut").at("fz").get<double>() * unit::mm;
  return out;
}

Record record_of(const json& worked, const force::Setup& setup) {
  Record out;
  out.cut = setup.cut;
  std::ifstream in(folder() / worked.at("csv").get<std::string>());
  std::string line;
  std::getline(in, line);
  while (std::getline(in, line)) {
    std::stringstream text(line);
    std::array<double, 4> v{};
    char comma = 0;
    text >> v[0] >> comma >> v[1] >> comma >> v[2] >> comma >> v[3];
    out.angle.push_back(v[0] * unit::deg);
    out.force.push_back({v[1], v[2], v[3]});
  }
  return out;
}

void set_model(const std::string& name, force::Setup& setup, Options& options) {
  setup.chip.lookback =
      name.ends_with("_m1") ? chip::Lookback::previous : chip::Lookback::all;
  options.chip_model = name == "none"               ? chip::Model::none
                       : name.starts_with("simple") ? chip::Model::feed
                       : name == "radial"           ? chip::Model::radial
                                                    : chip::Model::trochoidal;
}

double unit_of(std::size_t c) {
  return c < 3 ? unit::MPa : unit::N_per_mm;
}

class WorkedCase : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    const auto file = folder() / (std::string(GetParam()) + ".json");
    if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is not at hand";
    std::ifstream in(file);
    worked = json::parse(in);
  }
  json worked;
};

void compare(const json& expected, const char* se_name, const Fit& fit) {
  ASSERT_TRUE(fit.ok) << fit.message;
  const json& tolerance = expected.at("tolerance");
  for (std::size_t c = 0; c < 6; ++c) {
    const double unit = unit_of(c);
    EXPECT_NEAR(fit.coefficients[c]->value / unit, expected.at("K")[c].get<double>(),
                tolerance.at("K")[c].get<double>())
        << c;
    const double se = expected.at(se_name)[c];
    if (se < 1e-3) continue;  // rounding of the record, not of the fit
    EXPECT_NEAR(fit.coefficients[c]->se / unit / se, 1.0,
                tolerance.at("se_rel").get<double>())
        << c;
  }
  EXPECT_NEAR(fit.rms, expected.at("rms_vec_N").get<double>(),
              tolerance.at("rms_N").get<double>());
}

TEST_P(WorkedCase, FitsAtFixedRunout) {  // [I-1] [I-2] [I-5] [I-6]
  for (const json& expected : worked.at("fits")) {
    SCOPED_TRACE(expected.at("label").get<std::string>());
    force::Setup setup = setup_of(worked);
    Options options;
    options.phase = expected.at("phase_deg").get<double>() * unit::deg;
    options.runout = RunoutUnknowns::fixed;
    options.errors = Errors::white;
    set_model(expected.at("model"), setup, options);
    for (const double shift : expected.at("shift_mm")) {
      setup.runout.radial_offsets.push_back(shift * unit::mm);
    }
    const std::vector<Record> runs = {record_of(worked, setup)};
    const Fit fit = identify(setup, steel(), runs, options);
    compare(expected, "se", fit);
    const double condition = expected.at("cond_scaled");
    EXPECT_NEAR(fit.condition / condition, 1.0,
                expected.at("tolerance").at("cond_rel").get<double>());
    for (std::size_t q = 0; q < 3; ++q) {
      EXPECT_NEAR(fit.rms_axis[q], expected.at("rms_axis_N")[q].get<double>(),
                  expected.at("tolerance").at("rms_N").get<double>());
    }
  }
}

TEST_P(WorkedCase, JointFits) {  // [I-3] [I-4]
  for (const json& expected : worked.at("joint")) {
    SCOPED_TRACE(expected.at("label").get<std::string>());
    force::Setup setup = setup_of(worked);
    Options options;
    options.phase = 0.0;
    options.errors = Errors::white;
    set_model(expected.at("model"), setup, options);
    const std::vector<Record> runs = {record_of(worked, setup)};
    const Fit fit = identify(setup, steel(), runs, options);
    compare(expected, "se_K", fit);
    EXPECT_NEAR(fit.runout.radial_offsets[1] / unit::mm,
                expected.at("p")[0].get<double>(),
                expected.at("tolerance").at("p")[0].get<double>());
    const double se = expected.at("se_p")[0];
    if (se < 1e-9) continue;  // rounding of the record, not of the fit
    EXPECT_NEAR(*fit.radial_offsets_se[1] / unit::mm / se, 1.0, 0.05);
  }
}

TEST_P(WorkedCase, Sweep) {  // [I-5]
  if (!worked.contains("sweep")) return;
  const json& expected = worked.at("sweep");
  std::vector<double> offsets;
  for (const double um : expected.at("shift2_um")) offsets.push_back(um * unit::um);
  for (const auto& [model, rms] : expected.at("rms_vec_N").items()) {
    force::Setup setup = setup_of(worked);
    Options options;
    options.phase = 0.0;
    set_model(model, setup, options);
    const std::vector<Record> runs = {record_of(worked, setup)};
    const Fit fit = identify(setup, steel(), runs, options);
    const std::vector<double> found = sweep(setup, steel(), runs, fit, offsets);
    ASSERT_EQ(found.size(), offsets.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
      EXPECT_NEAR(found[i], rms[i].get<double>(),
                  expected.at("tolerance_N").get<double>())
          << model << " " << i;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(PaperCut, WorkedCase, testing::Values("I01", "I02"));

class WorkedRefusal : public WorkedCase {};

TEST_P(WorkedRefusal, IsNotAnsweredWithNumbers) {  // [I-6]
  const force::Setup setup = setup_of(worked);
  const std::vector<Record> runs = {record_of(worked, setup)};
  for (const char* model : {"none", "simple", "exact"}) {
    for (const bool free : {true, false}) {
      Options options;
      if (!free) options.phase = 0.0;
      force::Setup chosen = setup;
      set_model(model, chosen, options);
      const Fit fit = identify(chosen, steel(), runs, options);
      EXPECT_FALSE(fit.ok);
      EXPECT_FALSE(fit.message.empty());
      for (const auto& K : fit.coefficients) EXPECT_FALSE(K.has_value());
    }
  }
}

INSTANTIATE_TEST_SUITE_P(ConstantForce, WorkedRefusal, testing::Values("I09"));

}  // namespace trochoid::identification::worked_cases_test
