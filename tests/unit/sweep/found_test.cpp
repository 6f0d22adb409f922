#include <trochoid/base/error.h>
#include <trochoid/base/units.h>
#include <trochoid/results/json.h>
#include <trochoid/sweep/found.h>
#include <trochoid/sweep/rows.h>

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <set>

namespace trochoid::sweep::found_test {

namespace fs = std::filesystem;
using cases::Members;
using cases::Node;
using results::Joint;

Node number(double value) {
  return {.value = value, .where = {}};
}

Node text(const char* value) {
  return {.value = std::string(value), .where = {}};
}

Node table(Members members) {
  return {.value = std::move(members), .where = {}};
}

struct FoundFile : testing::Test {
  FoundFile() { fs::create_directories(folder); }
  ~FoundFile() override { fs::remove_all(folder); }
  FoundFile(const FoundFile&) = delete;
  FoundFile& operator=(const FoundFile&) = delete;

  cases::DrawnFile file(const Joint& joint, const char* command,
                        const std::string& name = "found") {
    const fs::path path = folder / (name + "." + command + ".json");
    std::ofstream(path) << results::json_text(results::Object{
        {"trochoid", results::Object{}},
        {"command", command},
        {"status", "ok"},
        {"result", results::Object{{"covariance", results::joint_value(joint)}}}});
    return {.path = path, .group = {}, .where = {"case.toml", 7, 14}};
  }

  fs::path folder = fs::temp_directory_path() /
                    (std::string("trochoid_found_") +
                     testing::UnitTest::GetInstance()->current_test_info()->name());
};

Joint slot() {
  return {.law = "linear_edge",
          .chip_model = "trochoidal",
          .teeth = 2,
          .names = {"force.K_tc_MPa", "runout.e_x_mm", "runout.e_y_mm"},
          .values = {800, 0.003, 0.004},
          .factors = {2, 2, 2},
          .covariance = {100, 0, 0, 0, 1e-6, 0, 0, 0, 4e-6},
          .not_found = {{"force.K_ae_N_per_mm", "no axial force was measured"}}};
}

Joint two_modes() {
  return {.modes = {{"tool", "x"}, {"tool", "x"}},
          .names = {"mode[1].frequency_Hz", "mode[1].damping_ratio", "mode[1].mass_kg",
                    "mode[2].frequency_Hz", "mode[2].damping_ratio", "mode[2].mass_kg"},
          .values = {900, 0.02, 0.04, 1500, 0.03, 0.05},
          .factors = std::vector<double>(6, 1.96),
          .covariance = std::vector<double>(36, 0.0)};
}

Node a_mode(const char* body, const char* axis, double f) {
  return table({{"body", {}, text(body)},
                {"axis", {}, text(axis)},
                {"frequency_Hz", {}, number(f)},
                {"stiffness_N_per_m", {}, number(1e6)},
                {"damping_Ns_per_m", {}, number(10)}});
}

std::string problems_of(const cases::Sweep& sweep, const Node& root) {
  try {
    find_all(sweep, root);
  } catch (const base::InputError& error) {
    return error.what();
  }
  return {};
}

TEST_F(FoundFile, IsPutIntoTheCase) {  // [U-6]
  const Node root = table({{"force", {}, table({{"K_tc_MPa", {}, number(805)}})}});
  const Found found =
      find_all({.covariance = {file(slot(), "identify")}, .draws = 5}, root);
  ASSERT_EQ(found.keys.size(), 3U);
  EXPECT_EQ(found.keys[0].key, "force.K_tc_MPa");
  EXPECT_EQ(found.keys[1].key, "runout.eccentricity_mm");
  EXPECT_EQ(found.keys[2].key, "runout.angle_deg");
  EXPECT_EQ(std::get<double>(found.values[0].value), 800);
  EXPECT_NEAR(std::get<double>(found.values[1].value), 0.005, 1e-15);
  EXPECT_NEAR(std::get<double>(found.values[2].value), std::atan2(4, 3) / unit::deg,
              1e-12);
  const Node* force = find(found.root, "force");
  EXPECT_EQ(std::get<double>(find(*force, "K_tc_MPa")->value), 800);
  EXPECT_EQ(std::get<std::string>(find(*force, "law")->value), "linear_edge");
  ASSERT_EQ(found.warnings.size(), 1U);
  EXPECT_EQ(found.warnings[0].code, "not_drawn");
}

TEST_F(FoundFile, AxialOffsetsAndTiltArePutIntoTheCaseToo) {  // [U-6]
  const Joint inserts{
      .law = "linear_edge",
      .chip_model = "trochoidal",
      .teeth = 2,
      .names = {"runout.axial_offsets_mm[2]", "runout.t_x", "runout.t_y"},
      .values = {-0.02, 0.0003, 0.0004},
      .factors = {2, 2, 2},
      .covariance = {1e-6, 0, 0, 0, 1e-10, 0, 0, 0, 1e-10}};
  const Found found =
      find_all({.covariance = {file(inserts, "identify")}, .draws = 5}, table({}));
  ASSERT_EQ(found.keys.size(), 3U);
  EXPECT_EQ(found.keys[0].key, "runout.axial_offsets_mm[2]");
  EXPECT_EQ(found.keys[1].key, "runout.tilt_deg");
  EXPECT_EQ(found.keys[2].key, "runout.tilt_angle_deg");
  EXPECT_NEAR(std::get<double>(found.values[1].value), std::atan(0.0005) / unit::deg,
              1e-12);
  EXPECT_NEAR(std::get<double>(found.values[2].value), std::atan2(4, 3) / unit::deg,
              1e-12);
  const Node* list = find(*find(found.root, "runout"), "axial_offsets_mm");
  EXPECT_EQ(std::get<double>(std::get<cases::Array>(list->value)[1].value), -0.02);
}

/// Found offsets count from tooth 1; so must those of the case that stay.
TEST_F(FoundFile, OfOffsetsMovesThoseThatStayToTheSameZero) {
  const Joint second{.law = "linear_edge",
                     .chip_model = "trochoidal",
                     .teeth = 3,
                     .names = {"runout.radial_offsets_mm[2]"},
                     .values = {-0.010},
                     .factors = {2},
                     .covariance = {1e-6}};
  const Node own = {.value = cases::Array{number(0.010), number(0.004), number(0.002)},
                    .where = {}};
  const Node root = table({{"runout", {}, table({{"radial_offsets_mm", {}, own}})}});
  const Found found =
      find_all({.covariance = {file(second, "identify")}, .draws = 5}, root);
  const Node* list = find(*find(found.root, "runout"), "radial_offsets_mm");
  const auto& offsets = std::get<cases::Array>(list->value);
  ASSERT_EQ(offsets.size(), 3U);
  EXPECT_NEAR(std::get<double>(offsets[0].value), 0.0, 1e-15);
  EXPECT_NEAR(std::get<double>(offsets[1].value), -0.010, 1e-15);
  EXPECT_NEAR(std::get<double>(offsets[2].value), -0.008, 1e-15);
}

TEST_F(FoundFile, OfAnEccentricityNearZeroIsDrawnByItsComponents) {
  Joint joint = slot();
  joint.values = {800, 0, 0};
  const cases::Sweep sweep{
      .covariance = {file(joint, "identify")}, .draws = 4000, .rows = 1};
  const Found found = find_all(sweep, table({}));
  const Rows rows(sweep, found);
  ASSERT_EQ(rows.size(), 4000U);
  double x = 0.0;
  double xx = 0.0;
  double yy = 0.0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto row = rows.row(i);
    const double rho = std::get<double>(row[1].value);
    const double angle = std::get<double>(row[2].value) * unit::deg;
    EXPECT_GE(rho, 0);
    x += rho * std::cos(angle) / 4000;
    xx += std::pow(rho * std::cos(angle), 2) / 4000;
    yy += std::pow(rho * std::sin(angle), 2) / 4000;
  }
  EXPECT_NEAR(x, 0, 5e-5);
  // Student's t of 60 degrees of freedom is wider than the normal by 60/58.
  EXPECT_NEAR(std::sqrt(xx), 1e-3, 5e-5);
  EXPECT_NEAR(std::sqrt(yy), 2e-3, 1e-4);
}

TEST_F(FoundFile, FindsItsModesAmongThoseOfTheCase) {
  const Node root = table(
      {{"mode",
        {},
        {.value = cases::Array{a_mode("tool", "y", 901), a_mode("tool", "x", 1510),
                               a_mode("tool", "x", 890)},
         .where = {}}}});
  const Found found =
      find_all({.covariance = {file(two_modes(), "modes")}, .draws = 5}, root);
  EXPECT_EQ(found.keys[0].key, "mode[3].frequency_Hz");
  EXPECT_EQ(found.keys[5].key, "mode[2].mass_kg");
  const auto& modes = std::get<cases::Array>(find(found.root, "mode")->value);
  EXPECT_EQ(std::get<double>(find(modes[2], "frequency_Hz")->value), 900);
  EXPECT_EQ(std::get<double>(find(modes[2], "mass_kg")->value), 0.04);
  EXPECT_EQ(find(modes[2], "stiffness_N_per_m"), nullptr);
  EXPECT_EQ(std::get<double>(find(modes[0], "stiffness_N_per_m")->value), 1e6);
}

TEST_F(FoundFile, GivesItsModesToACaseWithoutAny) {
  const Found found =
      find_all({.covariance = {file(two_modes(), "modes")}, .draws = 5}, table({}));
  const auto& modes = std::get<cases::Array>(find(found.root, "mode")->value);
  ASSERT_EQ(modes.size(), 2U);
  EXPECT_EQ(std::get<std::string>(find(modes[1], "body")->value), "tool");
  EXPECT_EQ(std::get<double>(find(modes[1], "frequency_Hz")->value), 1500);
}

TEST_F(FoundFile, ACaseWithoutModesTakesThoseOfEveryFile) {
  Joint along_y = two_modes();
  along_y.modes = {{"tool", "y"}, {"tool", "y"}};
  const Found found = find_all(
      {.covariance = {file(two_modes(), "modes"), file(along_y, "modes", "other")},
       .draws = 5},
      table({}));
  ASSERT_EQ(std::get<cases::Array>(find(found.root, "mode")->value).size(), 4U);
  ASSERT_EQ(found.keys.size(), 12U);
  EXPECT_EQ(found.keys[6].key, "mode[3].frequency_Hz");
}

TEST_F(FoundFile, IsRefusedWhereTheCaseIsAnother) {
  const cases::Sweep sweep{.covariance = {file(slot(), "identify")}, .draws = 5};
  const Node power = table({{"force", {}, table({{"law", {}, text("power")}})}});
  EXPECT_NE(problems_of(sweep, power).find("linear_edge"), std::string::npos);
  const Node four = table(
      {{"tool", {}, table({{"teeth", {}, {.value = std::int64_t{4}, .where = {}}}})}});
  const std::string why = problems_of(sweep, four);
  EXPECT_NE(why.find("case.toml:7:14"), std::string::npos);
  EXPECT_NE(why.find("runout of 2 teeth"), std::string::npos);
  const Node far = table(
      {{"mode", {}, {.value = cases::Array{a_mode("tool", "x", 700)}, .where = {}}}});
  EXPECT_NE(problems_of({.covariance = {file(two_modes(), "modes")}, .draws = 5}, far)
                .find("none nearer than 700 Hz"),
            std::string::npos);
}

TEST_F(FoundFile, IsRefusedWhereAKeyIsSetTwice) {
  cases::Sweep sweep{.over = {{.key = "force.K_tc_MPa",
                               .where = {"case.toml", 9, 1},
                               .values = cases::ListedValues{{number(1)}}}},
                     .covariance = {file(slot(), "identify")},
                     .draws = 5};
  EXPECT_NE(problems_of(sweep, table({})).find("either of them"), std::string::npos);
  sweep.over.clear();
  sweep.covariance.push_back(sweep.covariance.front());
  EXPECT_NE(problems_of(sweep, table({})).find("another file too"), std::string::npos);
}

TEST_F(FoundFile, OfAGridHasTheSameDrawsAtEveryPoint) {
  cases::Sweep sweep{.over = {{.key = "cut.spindle_rpm",
                               .where = {},
                               .values = cases::EvenValues{1000, 2000, 3}}},
                     .covariance = {file(slot(), "identify")},
                     .draws = 50,
                     .rows = 3};
  const Found found = find_all(sweep, table({}));
  const Rows rows(sweep, found);
  ASSERT_EQ(rows.size(), 150U);
  std::set<double> different;
  for (std::size_t i = 0; i < 50; ++i) {
    const double K = std::get<double>(rows.row(i)[1].value);
    different.insert(K);
    EXPECT_EQ(K, std::get<double>(rows.row(i + 100)[1].value));
  }
  EXPECT_EQ(different.size(), 50U);
  EXPECT_EQ(std::get<double>(rows.row(100)[0].value), 2000);
  sweep.seed = 2;
  EXPECT_NE(std::get<double>(Rows(sweep, found).row(0)[1].value), *different.begin());
}

TEST_F(FoundFile, ByChanceDoesNotGoWithTheSweptKeys) {
  cases::Sweep sweep{.over = {{.key = "cut.spindle_rpm",
                               .where = {},
                               .values = cases::NormalValues{0, 1}}},
                     .covariance = {file(slot(), "identify")},
                     .draws = 4000,
                     .method = cases::SweepMethod::random,
                     .rows = 4000};
  const Found found = find_all(sweep, table({}));
  const Rows rows(sweep, found);
  ASSERT_EQ(rows.size(), 4000U);
  double together = 0.0;
  for (std::size_t i = 0; i < 4000; ++i) {
    const auto row = rows.row(i);
    together += std::get<double>(row[0].value) *
                (std::get<double>(row[1].value) - 800) / 10 / 4000;
  }
  EXPECT_NEAR(together, 0, 0.06);
}

}  // namespace trochoid::sweep::found_test
