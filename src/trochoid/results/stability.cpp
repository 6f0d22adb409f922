#include <trochoid/results/better_speed.h>
#include <trochoid/results/process_damping.h>
#include <trochoid/results/stability.h>

#include <trochoid/base/units.h>

#include <fmt/core.h>

#include <algorithm>
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

Value better_speed_value(const StabilityResult& r) {
  const auto better = better_speed(r);
  return better ? Value(Object{{"spindle_rpm", unit::in(better->Omega, unit::rpm)},
                               {"limit_depth_mm", better->depth / unit::mm}})
                : Value();
}

/// What damps, and the limit without it.
Value damping_value(const StabilityResult& r) {
  Object value = process_damping_value(r.problem.setup.process_damping);
  if (r.no_modes.empty()) {
    const auto& sharp = r.stability.sharp_limit;
    value.push_back(
        {"limit_depth_without_mm", sharp ? Value(sharp->depth / unit::mm) : Value()});
  }
  return value;
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

Value depth_value(const std::optional<dynamics::FrequencyLimit>& limit) {
  return limit ? Value(limit->depth / unit::mm) : Value();
}

/// By how much a limit differs from that of the multiplier, in percent of it.
Value difference(const std::optional<dynamics::FrequencyLimit>& limit,
                 const StabilityResult& r) {
  if (!limit || !r.no_modes.empty() || !r.stability.limit) {
    return {};
  }
  return 100 * (limit->depth / r.stability.limit->limit.depth - 1);
}

/// The median of that over the speeds of the diagram, without sign.
Value median_difference(const std::vector<dynamics::FrequencyLimit>& curve,
                        const StabilityResult& r) {
  std::vector<double> sizes;
  for (const dynamics::FrequencyLimit& one : curve) {
    for (const dynamics::LimitPoint& other : r.stability.limit_curve) {
      if (other.limit.Omega == one.Omega) {
        sizes.push_back(100 * std::abs(one.depth / other.limit.depth - 1));
      }
    }
  }
  if (sizes.empty()) {
    return {};
  }
  const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
  std::nth_element(sizes.begin(), middle, sizes.end());
  return *middle;
}

Object by_frequency(const ByFrequency& found, const StabilityResult& r) {
  const auto& limit = found.limit;
  return {{"limit_depth_mm", depth_value(limit)},
          {"chatter_frequency_Hz", limit ? Value(limit->chatter_frequency) : Value()},
          {"difference_percent", difference(limit, r)},
          {"median_difference_percent", median_difference(found.curve, r)}};
}

Object measured_value(const StabilityResult& r) {
  const MeasuredStability& m = *r.measured;
  Object multi = by_frequency(m.multi_frequency, r);
  multi.push_back({"harmonics", m.harmonics});
  return {{"band_Hz",
           Array{unit::in(m.band.from, unit::Hz), unit::in(m.band.to, unit::Hz)}},
          {"zeroth_order", by_frequency(m.zeroth_order, r)},
          {"multi_frequency", std::move(multi)},
          {"modes_fitted", m.modes_fitted}};
}

/// Without modes: what the measured response says alone.
Object result_without_modes(const StabilityResult& r) {
  const geometry::Cut& cut = r.problem.setup.cut;
  const auto& limit = r.measured->multi_frequency.limit;
  const bool stable = !limit || limit->depth > cut.a_p;
  Object result{{"multiplier", nullptr},
                {"stable", stable},
                {"verdict", stable ? "stable" : "unstable"},
                {"limit_depth_mm", depth_value(limit)},
                {"greatest_depth_mm", unit::in(r.measured->greatest_depth, unit::mm)},
                {"spindle_rpm", unit::in(cut.Omega, unit::rpm)},
                {"axial_depth_mm", unit::in(cut.a_p, unit::mm)},
                {"modes", nullptr},
                {"measured_frf", measured_value(r)}};
  if (r.problem.setup.process_damping.acts()) {
    result.push_back({"process_damping", damping_value(r)});
  }
  return result;
}

Object result_of(const StabilityResult& r) {
  if (!r.no_modes.empty()) {
    return result_without_modes(r);
  }
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
  if (s.whole) {
    add("better_speed", better_speed_value(r));
  }
  add("greatest_depth_mm", unit::in(s.greatest_depth, unit::mm));
  add("spindle_rpm", unit::in(cut.Omega, unit::rpm));
  add("axial_depth_mm", unit::in(cut.a_p, unit::mm));
  add("modes", modes_value(r.problem.system));
  if (r.problem.setup.process_damping.acts()) {
    add("process_damping", damping_value(r));
  }
  if (r.measured) {
    add("measured_frf", measured_value(r));
  }
  return result;
}

std::string limit_text(const ByFrequency& found) {
  return found.limit
             ? fmt::format("{:.5g} mm ({:.1f} Hz)", found.limit->depth / unit::mm,
                           found.limit->chatter_frequency)
             : "none";
}

std::string measured_table(const StabilityResult& r) {
  const MeasuredStability& m = *r.measured;
  return fmt::format(
      "limit by the measured response: {} with the mean force (zeroth order), {} with "
      "{} harmonics (multi-frequency)\n{}",
      limit_text(m.zeroth_order), limit_text(m.multi_frequency), m.harmonics,
      m.modes_fitted ? fmt::format("the multiplier is that of {} mode{} fitted to it\n",
                                   r.problem.system.modes.size(),
                                   r.problem.system.modes.size() == 1 ? "" : "s")
                     : "");
}

std::string multiplier_table(const StabilityResult& r) {
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
  const bool above = growth < 1 && cut.a_p > s.limit->limit.depth;
  text += fmt::format(
      "at {:g} rpm unstable from {:.5g} mm axial depth on; here {:g} mm{}\n", speed,
      s.limit->limit.depth / unit::mm, unit::in(cut.a_p, unit::mm),
      above ? ", where it is stable again" : "");
  if (const auto better = better_speed(r)) {
    text += fmt::format("near it, {:.5g} rpm allows {:.3g} mm\n",
                        better->Omega / unit::rpm, better->depth / unit::mm);
  }
  return text;
}

std::string damping_table(const StabilityResult& r) {
  const force::ProcessDamping& damping = r.problem.setup.process_damping;
  if (!damping.acts()) {
    return {};
  }
  const std::string with = "with " + process_damping_text(damping);
  if (!r.no_modes.empty()) {
    return with + '\n';
  }
  const auto& sharp = r.stability.sharp_limit;
  return with + (sharp ? fmt::format("; without it unstable from {:.5g} mm on\n",
                                     sharp->depth / unit::mm)
                       : "; without it stable as deep\n");
}

std::string short_table(const StabilityResult& r) {
  return (r.no_modes.empty() ? multiplier_table(r) : std::string()) + damping_table(r) +
         (r.measured ? measured_table(r) : std::string());
}

/// zeroth_order.csv, multi_frequency.csv: the limit depth over the speed.
base::Table frequency_table(const char* file,
                            const std::vector<dynamics::FrequencyLimit>& curve) {
  base::Table table{file, {}};
  const std::size_t n = curve.size();
  add_column(table, "spindle_rpm", n,
             [&](std::size_t i) { return unit::in(curve[i].Omega, unit::rpm); });
  add_column(table, "limit_depth_mm", n,
             [&](std::size_t i) { return unit::in(curve[i].depth, unit::mm); });
  add_column(table, "chatter_frequency_Hz", n,
             [&](std::size_t i) { return curve[i].chatter_frequency; });
  return table;
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

/// The modes of the multiplier, for other commands: of all directions together.
std::string modes_toml(const dynamics::System& system) {
  std::string text =
      "# Fitted by trochoid stability to the measured responses of the tool point. Use "
      "it in\n# another case with\n#   include = \"<this file>\"\n";
  for (const dynamics::ChipMode& m : system.modes) {
    const double omega = std::sqrt(m.stiffness / m.mass);
    const bool along_x = std::abs(m.x) >= std::abs(m.y);
    const double tangent = along_x ? m.y / m.x : -m.x / m.y;
    text += fmt::format(
        "\n[[mode]]  # {:.6g} Hz, damping ratio {:.4g}\n"
        "body = \"{}\"\naxis = \"{}\"\nangle_deg = {:.6g}\n"
        "mass_kg = {}\nstiffness_N_per_m = {}\ndamping_Ns_per_m = {}\n",
        omega / unit::turn, 0.5 * m.damping / (m.mass * omega),
        m.of_table ? "table" : "tool", along_x ? "x" : "y",
        std::atan(tangent) / unit::deg + 0.0, m.mass, m.stiffness, m.damping);
  }
  return text;
}

}  // namespace

Answer answer_of(const StabilityResult& r) {
  Answer answer{.command = "stability",
                .heading = r.heading,
                .result = result_of(r),
                .short_table = short_table(r)};
  if (r.no_modes.empty()) {
    answer.tables = {lobes_table(r.stability.lobes),
                     limit_table(r.stability.limit_curve)};
  }
  if (r.measured) {
    answer.tables.push_back(
        frequency_table("zeroth_order.csv", r.measured->zeroth_order.curve));
    answer.tables.push_back(
        frequency_table("multi_frequency.csv", r.measured->multi_frequency.curve));
    if (r.measured->modes_fitted) {
      answer.texts.push_back({"modes.toml", modes_toml(r.problem.system)});
    }
  }
  return answer;
}

}  // namespace trochoid::results
