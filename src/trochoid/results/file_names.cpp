#include "file_names.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <nlohmann/json.hpp>

namespace trochoid::results {

namespace {

constexpr std::array<std::string_view, 26> names = {"case.toml",
                                                    "summary.json",
                                                    "report.html",
                                                    "material.toml",
                                                    "forces.csv",
                                                    "chip.csv",
                                                    "chip_curve.csv",
                                                    "fitted.csv",
                                                    "residual.csv",
                                                    "sweep.csv",
                                                    "folded.csv",
                                                    "surface.csv",
                                                    "deflection.csv",
                                                    "influence.csv",
                                                    "motion.csv",
                                                    "lobes.csv",
                                                    "limit.csv",
                                                    "command.csv",
                                                    "bent.csv",
                                                    "modes.toml",
                                                    "actuator.toml",
                                                    "once_per_turn.csv",
                                                    "surface_location.csv",
                                                    "speeds.csv",
                                                    "command.h",
                                                    "controller.csv"};

}  // namespace

bool is_ours(std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

bool holds_our_summary(const std::filesystem::path& folder) {
  std::ifstream file(folder / "summary.json", std::ios::binary);
  const auto summary = nlohmann::json::parse(file, nullptr, false);
  return summary.is_object() && summary.contains("trochoid");
}

}  // namespace trochoid::results
