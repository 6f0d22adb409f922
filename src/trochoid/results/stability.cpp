#include <trochoid/results/stability.h>

#include <trochoid/base/units.h>

#include <fmt/core.h>

#include <cmath>
#include <complex>

namespace trochoid::results {

namespace {

using base::add_column;
using dynamics::ChatterLine;
using dynamics::Stability;

double degrees(const std::complex<double>& multiplier) {
  return std::arg(multiplier) / unit::deg;
}

/// What the multiplier is of: the time from one tooth to the next where all are alike.
std::string_view period_name(const Stability& s) {
  return s.period < 0.999 * unit::turn ? "tooth" : "revolution";
}

std::string_view type_of(const std::complex<double>& multiplier) {
  return name_of(dynamics::bifurcation_of(multiplier));
}

Array frequencies(const std::vector<ChatterLine>& lines) {
  Array list;
  for (const ChatterLine& line : lines) {
    list.emplace_back(line.frequency);
  }
  return list;
}

Array shares(const std::vector<ChatterLine>& lines) {
  Array list;
  for (const ChatterLine& line : lines) {
    list.emplace_back(line.share);
  }
  return list;
}

Object multiplier_value(const Stability& s, double Omega) {
  const std::complex<double> mu = s.multiplier.value;
  return {{"absolute", std::abs(mu)},
          {"argument_deg", degrees(mu)},
          {"type", type_of(mu)},
          {"chatter_frequencies_Hz", frequencies(s.lines)},
          {"chatter_shares", shares(s.lines)},
          {"period", period_name(s)},
          {"period_s", s.period / Omega},
          {"error", s.multiplier.error}};
}

Array modes_value(const dynamics::System& system) {
  Array modes;
  for (const dynamics::ChipMode& mode : system.modes) {
    const double omega = std::sqrt(mode.stiffness / mode.mass);
    modes.push_back(Object{{"direction", Array{mode.x, mode.y}},
                           {"frequency_Hz", omega / unit::turn},
                           {"damping_ratio", 0.5 * mode.damping / (mode.mass * omega)},
                           {"mass_kg", mode.mass},
                           {"stiffness_N_per_m", mode.stiffness},
                           {"damping_Ns_per_m", mode.damping}});
  }
  return modes;
}

Object result_of(const StabilityResult& r) {
  const Stability& s = r.stability;
  const geometry::Cut& cut = r.problem.setup.cut;
  Object result{{"multiplier", multiplier_value(s, cut.Omega)},
                {"stable", std::abs(s.multiplier.value) < 1}};
  const auto add = [&](const char* key, Value value) {
    result.push_back({key, std::move(value)});
  };
  if (s.floor) {
    const double floor = r.problem.options.chip_floor;
    add("chip_floor", Object{{"chip_floor_um", unit::in(floor, unit::um)},
                             {"multiplier_at_half", s.floor->at_half},
                             {"multiplier_at_twice", s.floor->at_twice}});
  }
  add("verdict", name_of(s.verdict));
  add("limit_depth_mm", s.limit ? Value(s.limit->limit.depth / unit::mm) : Value());
  if (s.limit) {
    const std::complex<double> mu = s.limit->limit.multiplier;
    add("limit", Object{{"type", type_of(mu)},
                        {"argument_deg", degrees(mu)},
                        {"chatter_frequencies_Hz", frequencies(s.limit->lines)}});
  }
  add("greatest_depth_mm", unit::in(s.greatest_depth, unit::mm));
  add("spindle_rpm", unit::in(cut.Omega, unit::rpm));
  add("axial_depth_mm", unit::in(cut.a_p, unit::mm));
  add("modes", modes_value(r.problem.system));
  return result;
}

std::string short_table(const StabilityResult& r) {
  const Stability& s = r.stability;
  const geometry::Cut& cut = r.problem.setup.cut;
  const double growth = std::abs(s.multiplier.value);
  std::string text =
      fmt::format("{}: a small vibration {} to {:.6f} of itself in each {} ({})\n",
                  name_of(s.verdict), growth < 1 ? "fades" : "grows", growth,
                  period_name(s), type_of(s.multiplier.value));
  text += "frequencies [Hz], strongest first:";
  for (const ChatterLine& line : s.lines) {
    text += fmt::format(" {:.2f}", line.frequency);
  }
  text += '\n';
  const double speed = unit::in(cut.Omega, unit::rpm);
  if (!s.limit) {
    return text + fmt::format("at {:g} rpm no axial depth up to {:g} mm is unstable\n",
                              speed, unit::in(s.greatest_depth, unit::mm));
  }
  return text + fmt::format(
                    "at {:g} rpm unstable from {:.5g} mm axial depth on; here {:g} "
                    "mm\n",
                    speed, s.limit->limit.depth / unit::mm,
                    unit::in(cut.a_p, unit::mm));
}

/// lobes.csv: |mu| over speed and depth.
base::Table lobes_table(const dynamics::LobeGrid& grid) {
  base::Table table{"lobes.csv", {}};
  const std::size_t n = grid.multiplier.size();
  const std::size_t depths = grid.depth.size();
  add_column(table, "spindle_rpm", n, [&](std::size_t i) {
    return unit::in(grid.Omega[i / depths], unit::rpm);
  });
  add_column(table, "axial_depth_mm", n,
             [&](std::size_t i) { return unit::in(grid.depth[i % depths], unit::mm); });
  add_column(table, "multiplier", n,
             [&](std::size_t i) { return std::abs(grid.multiplier[i]); });
  return table;
}

/// limit.csv: the limit depth over the speed, and the strongest frequency of the
/// vibration that appears there.
base::Table limit_table(const std::vector<dynamics::LimitPoint>& curve) {
  base::Table table{"limit.csv", {}};
  const std::size_t n = curve.size();
  add_column(table, "spindle_rpm", n,
             [&](std::size_t i) { return unit::in(curve[i].limit.Omega, unit::rpm); });
  add_column(table, "limit_depth_mm", n,
             [&](std::size_t i) { return unit::in(curve[i].limit.depth, unit::mm); });
  add_column(table, "argument_deg", n,
             [&](std::size_t i) { return degrees(curve[i].limit.multiplier); });
  add_column(table, "chatter_frequency_Hz", n,
             [&](std::size_t i) { return curve[i].chatter_frequency; });
  return table;
}

}  // namespace

Answer answer_of(const StabilityResult& r) {
  return {
      .command = "stability",
      .heading = r.heading,
      .result = result_of(r),
      .short_table = short_table(r),
      .tables = {lobes_table(r.stability.lobes), limit_table(r.stability.limit_curve)}};
}

}  // namespace trochoid::results
