// The worked cases of ../shared on the cutter and the wall alone, through the library;
// surface_cases_test.py takes them through the program.

#include <trochoid/base/units.h>
#include <trochoid/structure/cantilever.h>
#include <trochoid/structure/plate.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace trochoid::structure {

namespace {

using nlohmann::json;

constexpr double mm_per_N = 1e-3;
/// Asked of the wall: well below what the cases tolerate.
constexpr double tolerance = 2e-4;

std::vector<json> worked(const std::string& kind) {
  const char* elsewhere = std::getenv("TROCHOID_SHARED");
  const std::filesystem::path shared =
      elsewhere != nullptr ? elsewhere : TROCHOID_SOURCE_DIR "/../shared";
  std::vector<std::filesystem::path> files;
  std::error_code absent;
  for (const auto& entry :
       std::filesystem::directory_iterator(shared / "cases/surface", absent)) {
    if (entry.path().extension() == ".json") {
      files.push_back(entry.path());
    }
  }
  std::sort(files.begin(), files.end());
  std::vector<json> cases;
  for (const auto& file : files) {
    json one = json::parse(std::ifstream(file));
    if (one.at("kind") == kind) {
      cases.push_back(std::move(one));
    }
  }
  return cases;
}

void expect_near(double got, double want, const json& one, const std::string& what) {
  const json& allowed = one.at("tol");
  EXPECT_NEAR(got, want,
              allowed.at("rel").get<double>() * std::abs(want) +
                  allowed.at("abs").get<double>())
      << one.at("id") << ' ' << what;
}

/// A wall of flexural rigidity 1 where the case gives no material.
Plate wall(const json& w) {
  const double nu = w.at("nu");
  if (!w.contains("E")) {
    return {.length = w.at("length"),
            .height = w.at("height"),
            .thickness = 1,
            .youngs_modulus = 12 * (1 - nu * nu),
            .poisson_ratio = nu};
  }
  return {.length = w.at("length").get<double>() * unit::mm,
          .height = w.at("height").get<double>() * unit::mm,
          .thickness = w.at("thickness").get<double>() * unit::mm,
          .youngs_modulus = w.at("E").get<double>() * unit::MPa,
          .poisson_ratio = nu};
}

}  // namespace

TEST(WorkedCases, CutterCompliance) {  // [B-1] [B-2]
  const auto cases = worked("cutter_compliance");
  if (cases.empty()) {
    GTEST_SKIP() << "no worked cases beside the repository";
  }
  for (const json& one : cases) {
    const json& in = one.at("inputs");
    const json& tool = in.at("tool");
    const Cantilever cutter{
        .overhang = tool.at("overhang").get<double>() * unit::mm,
        .flute_length = tool.at("flute_length").get<double>() * unit::mm,
        .shank_diameter = tool.at("d_arbor").get<double>() * unit::mm,
        .flute_diameter = tool.at("d_equiv").get<double>() * unit::mm,
        .youngs_modulus = tool.at("E").get<double>() * unit::MPa};
    const json& G = one.at("expected").at("G");
    for (std::size_t i = 0; i < G.size(); ++i) {
      expect_near(compliance(cutter, in.at("z_obs").at(i).get<double>() * unit::mm,
                             in.at("z_load").at(i).get<double>() * unit::mm) /
                      mm_per_N,
                  G.at(i), one, std::to_string(i));
    }
  }
}

TEST(WorkedCases, WallUnderPressure) {  // [B-3] [B-4]
  const auto cases = worked("plate_uniform");
  if (cases.empty()) {
    GTEST_SKIP() << "no worked cases beside the repository";
  }
  for (const json& one : cases) {
    const Plate plate = wall(one.at("inputs"));
    const double a = plate.length;
    const PlateSolution solution(plate, a / 2, tolerance);
    const double scale = a * a * a * a;
    for (const auto& [name, want] : one.at("expected").items()) {
      ASSERT_TRUE(name == "w_free_edge_mid" || name == "w_centre") << name;
      const double y = name == "w_centre" ? plate.height / 2 : plate.height;
      expect_near(solution.pressure(a / 2, y) / scale, want, one, name);
    }
  }
}

TEST(WorkedCases, WallUnderALineLoad) {  // [B-6] [B-7]
  const auto cases = worked("plate_line");
  if (cases.empty()) {
    GTEST_SKIP() << "no worked cases beside the repository";
  }
  for (const json& one : cases) {
    const json& in = one.at("inputs");
    const Plate plate = wall(in.at("wall"));
    const double x = in.at("x").get<double>() * unit::mm;
    const double a_p = in.at("ap").get<double>() * unit::mm;
    std::vector<double> y;
    for (const json& one_y : in.at("y_obs")) {
      y.push_back(std::min(one_y.get<double>() * unit::mm, plate.height));
    }
    const PlateSolution solution(plate, x, tolerance, a_p);
    EXPECT_TRUE(solution.converged()) << one.at("id");
    const auto w = solution.line_load(x, y, x, plate.height - a_p, plate.height);
    for (std::size_t i = 0; i < w.size(); ++i) {
      expect_near(w[i] / mm_per_N, one.at("expected").at("w").at(i), one,
                  std::to_string(i));
    }
  }
}

}  // namespace trochoid::structure
