#include <trochoid/run/compare.h>

#include <trochoid/base/units.h>
#include <trochoid/force/forces.h>
#include <trochoid/run/curve_tables.h>
#include <trochoid/run/measured_run.h>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace trochoid::run {

namespace {

using Json = nlohmann::ordered_json;
using Forces = std::vector<force::Vector3>;

/// Computed forces of a run whose angle of tooth 1 is the recorded angle plus a phase.
class PhasedForces {
 public:
  PhasedForces(const inputs::Case& given, const identification::Run& run)
      : setup_(given.setup), law_(given.law), run_(run) {
    setup_.cut = run.cut;
    tolerance_ = given.sampling.tolerance;
  }

  /// @param stride  every how many samples are looked at
  [[nodiscard]] Forces at(double phase, std::size_t stride = 1) const {
    std::vector<double> phi;
    for (std::size_t i = 0; i < run_.angle.size(); i += stride) {
      phi.push_back(run_.angle[i] + phase);
    }
    return force::forces(setup_, law_, phi, tolerance_);
  }

  [[nodiscard]] double misfit(double phase, std::size_t stride) const {
    const Forces forces = at(phase, stride);
    double sum = 0.0;
    for (std::size_t i = 0; i < forces.size(); ++i) {
      for (std::size_t q = 0; q < 3; ++q) {
        const double d = run_.force[i * stride][q] - forces[i][q];
        sum += d * d;
      }
    }
    return sum;
  }

 private:
  force::Setup setup_;
  force::Law law_;
  const identification::Run& run_;
  double tolerance_ = 1e-6;
};

double best_phase(const PhasedForces& forces, std::size_t samples) {
  constexpr double pi = std::numbers::pi;
  constexpr int steps = 72;
  const std::size_t stride = std::max<std::size_t>(1, samples / 180);
  double best = 0.0;
  double least = INFINITY;
  for (int i = 0; i < steps; ++i) {
    const double phase = -pi + unit::turn * i / steps;
    const double misfit = forces.misfit(phase, stride);
    if (misfit < least) {
      least = misfit;
      best = phase;
    }
  }
  double lo = best - unit::turn / steps;
  double hi = best + unit::turn / steps;
  constexpr double golden = 0.6180339887498949;
  for (int i = 0; i < 30; ++i) {
    const double a = hi - golden * (hi - lo);
    const double b = lo + golden * (hi - lo);
    const bool right = forces.misfit(a, 1) > forces.misfit(b, 1);
    (right ? lo : hi) = right ? a : b;
  }
  return 0.5 * (lo + hi);
}

}  // namespace

void compare(const inputs::Case& given, results::Answer& answer, Json& result) {
  std::string message;
  const auto measured = measured_runs(given, answer.heading.warnings, message);
  if (measured.empty()) {
    answer.heading.warnings.push_back({"not_compared", message});
    return;
  }
  if (given.dynamometer && given.dynamometer->automatic) {
    answer.heading.warnings.push_back(
        {"not_compared",
         "axes = \"auto\" needs an identification; name the axes to compare here."});
    return;
  }
  const Matrix3 M = given.dynamometer.value_or(inputs::Dynamometer{}).matrix;
  const auto runs = on_tool(measured, M);
  ComputedForces computed{"computed", {}};
  Json comparison = Json::array();
  for (std::size_t r = 0; r < runs.size(); ++r) {
    const PhasedForces forces(given, runs[r]);
    const double phase =
        given.identify.phase.value_or(best_phase(forces, runs[r].angle.size()));
    computed.of_run.push_back(forces.at(phase));
    std::array<double, 3> square{};
    double size = 0.0;
    for (std::size_t i = 0; i < runs[r].force.size(); ++i) {
      for (std::size_t q = 0; q < 3; ++q) {
        const double d = runs[r].force[i][q] - computed.of_run[r][i][q];
        square[q] += d * d / static_cast<double>(runs[r].force.size());
        size += runs[r].force[i][q] * runs[r].force[i][q] /
                static_cast<double>(runs[r].force.size());
      }
    }
    const double rms = std::sqrt(square[0] + square[1] + square[2]);
    comparison.push_back(
        {{"file", measured[r].record.file},
         {"phase_deg", phase / unit::deg},
         {"rms_N", rms},
         {"rms_axis_N",
          {std::sqrt(square[0]), std::sqrt(square[1]), std::sqrt(square[2])}},
         {"measured_rms_N", std::sqrt(size)},
         {"spindle_rpm", measured[r].Omega / unit::rpm}});
    answer.short_table +=
        fmt::format("compared with {}: rms of the difference {:.2f} N",
                    measured[r].record.file, rms);
    answer.short_table += size > 0 ? fmt::format(" ({:.1f} % of the force)\n",
                                                 100 * rms / std::sqrt(size))
                                   : std::string(" (the record holds no force)\n");
  }
  result["comparison"] = comparison;
  for (auto& table : curve_tables(runs, std::vector{computed})) {
    answer.tables.push_back(std::move(table));
  }
}

}  // namespace trochoid::run
