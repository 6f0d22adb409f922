#include <trochoid/base/units.h>
#include <trochoid/cases/number_text.h>
#include <trochoid/cases/rules.h>

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <system_error>

namespace trochoid::cases {

namespace {

/// Below this, a matrix whose rows are long 1 counts as singular.
constexpr double least_determinant = 1e-7;

using Matrix = std::array<std::array<double, 3>, 3>;

/// Nothing where a text is no axis.
std::optional<force::Channel> channel_named(std::string_view name) {
  const double sign = name.starts_with('-') ? -1.0 : 1.0;
  if (name.starts_with('-') || name.starts_with('+')) name.remove_prefix(1);
  const auto& names = force::channel_axis_names;
  const auto* const at = std::find(names.begin(), names.end(), name);
  if (at == names.end()) return std::nullopt;
  return force::Channel{static_cast<force::ChannelAxis>(at - names.begin()), sign};
}

/// What the channels read; empty, with a report, where the axes are wrong.
std::vector<force::Channel> channels_named(const std::vector<std::string>& axes,
                                           Findings& findings) {
  constexpr std::size_t most = 8;
  std::vector<force::Channel> out;
  if (axes.size() > most) {
    report(
        findings, "dynamometer.axes",
        fmt::format("dynamometer.axes: {} entries; must be 1 to 8 (what each channel "
                    "reads)",
                    axes.size()));
    return {};
  }
  for (std::size_t i = 0; i < axes.size(); ++i) {
    const auto channel = channel_named(axes[i]);
    if (!channel) {
      report(
          findings, "dynamometer.axes",
          fmt::format("dynamometer.axes entry {} = {}: no axis; must be {}, in capital "
                      "and small letters as here, with a sign if needed (what "
                      "channel {} reads)",
                      i + 1, toml_string(axes[i]),
                      fmt::join(force::channel_axis_names, ", "), i + 1));
      return {};
    }
    if (std::ranges::find(out, channel->axis, &force::Channel::axis) != out.end()) {
      report(
          findings, "dynamometer.axes",
          fmt::format("dynamometer.axes entry {} = {}: an axis is there twice; must be "
                      "x, y, z or others, each once, in any order and with any sign",
                      i + 1, toml_string(axes[i])));
      return {};
    }
    out.push_back(*channel);
  }
  return out;
}

/// Of forces in x, y and z, the missing ones last; nothing where the channels read anything
/// else.
std::optional<Matrix> matrix_of(const std::vector<force::Channel>& channels) {
  Matrix matrix{};
  std::array<bool, 3> used{};
  std::size_t row = 0;
  for (const force::Channel& one : channels) {
    const auto axis = static_cast<std::size_t>(one.axis);
    if (axis >= 3) return std::nullopt;
    matrix[row++][axis] = one.sign;
    used[axis] = true;
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!used[axis]) matrix[row++][axis] = 1.0;
  }
  return matrix;
}

void check_invertible(const Matrix& m, Findings& findings) {
  const double det = m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
                     m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
                     m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
  double size2 = 0.0;
  for (const auto& row : m) {
    size2 += row[0] * row[0] + row[1] * row[1] + row[2] * row[2];
  }
  // |det| / size^3 bounds how much of a force the channels still tell apart.
  if (!(std::abs(det) > least_determinant * size2 * std::sqrt(size2))) {
    report(findings, "dynamometer.matrix",
           fmt::format("dynamometer.matrix: the determinant is {:.3g}, so the "
                       "channels do not determine the force; must be invertible",
                       det));
  }
}

/// Two clampings that are one separate nothing; nor do offsets.
void check_clamping(const IdentifyTable& table, Findings& findings) {
  const std::string key = "identify.previous_clamping";
  if (!table.previous_clamping || !sound(findings, {key, key + ".turned_deg"})) {
    return;
  }
  constexpr double least_turn = 1 * unit::deg;
  if (std::abs(std::remainder(table.previous_clamping->turned, unit::turn)) <
      least_turn) {
    report(findings, key + ".turned_deg",
           fmt::format("{}.turned_deg = {} deg: the tool stood as before, so tool and "
                       "holder cannot be separated; must be at least 1 deg off a whole "
                       "turn",
                       key, number_text(table.previous_clamping->turned, unit::deg)));
  }
  const bool searched = std::ranges::any_of(table.runout, [](RunoutGroup group) {
    return group == RunoutGroup::eccentricity || group == RunoutGroup::both;
  });
  if (!searched) {
    report(findings, key,
           key +
               ": only an eccentricity has a part of the holder; must go with "
               "runout = \"eccentricity\"");
  }
}

/// A record of no force at all is none.
void check_columns(const std::vector<std::string>& columns, const std::string& key,
                   Findings& findings) {
  if (std::ranges::any_of(columns, [](const auto& name) { return !name.empty(); })) {
    return;
  }
  report(findings, key, key + ": no entry names a column; must name a force at least");
}

}  // namespace

namespace {

identification::Tolerances tolerances_of(const CaseTables& tables) {
  identification::Tolerances out{.axial_depth = tables.cut.axial_depth_sd,
                                 .radial_depth = tables.cut.radial_depth_sd,
                                 .feed = tables.cut.feed_per_tooth_sd};
  if (tables.dynamometer) {
    out.gain = tables.dynamometer->gain_sd;
    out.turn = tables.dynamometer->turn_sd;
  }
  return out;
}

}  // namespace

Dynamometer dynamometer_of(DynamometerTable& table, Findings& findings) {
  Dynamometer result;
  if (!sound(findings, {"dynamometer.axes", "dynamometer.matrix"})) {
    return result;
  }
  result.rigid = table.resonance == Resonance::none;
  result.frf = table.frf;
  result.sensor.angle = table.sensor.value_or(0.0);
  result.sensor_free = !table.sensor;
  result.channel_sd = table.channel_sd;
  if (!table.axes.empty() && !table.matrix.empty()) {
    report(
        findings, "dynamometer.matrix",
        "dynamometer.matrix: axes is given as well; must be one of the two (what the "
        "channels read)");
  } else if (table.axes == std::vector<std::string>{"auto"}) {
    result.automatic = true;
  } else if (!table.axes.empty()) {
    result.sensor.channels = channels_named(table.axes, findings);
    result.matrix = matrix_of(result.sensor.channels).value_or(result.matrix);
  } else if (table.matrix.size() == 3) {
    std::copy(table.matrix.begin(), table.matrix.end(), result.matrix.begin());
    check_invertible(result.matrix, findings);
  }
  return result;
}

Measurement measurement_of(MeasurementTable& table, std::size_t number,
                           Findings& findings) {
  const std::string path = fmt::format("measurement[{}]", number);
  const files::RecordSource& source = table.source;
  Measurement m{.source = source,
                .from = table.from,
                .to = table.to,
                .mean = table.mean,
                .mean_sd = table.mean_sd,
                .group = table.group};
  if (std::any_of(table.group.begin(), table.group.end(),
                  [](char c) { return static_cast<unsigned char>(c) < 0x20; })) {
    report(findings, path + ".group",
           fmt::format("{}.group = {}: must be text of one line (records of the same "
                       "group share coefficients)",
                       path, toml_string(table.group)));
  }
  if (!source.time_column.empty() && source.sample_rate) {
    report(
        findings, path + ".sample_rate_Hz",
        fmt::format("{}.sample_rate_Hz = {} Hz: time_column is given as well; must be "
                    "one of the two",
                    path, number_text(*source.sample_rate)));
  }
  if (!source.angle_column.empty() && !source.pulse_column.empty()) {
    report(
        findings, path + ".pulse_column",
        fmt::format("{}.pulse_column = {}: angle_column is given as well; must be one "
                    "of the two",
                    path, toml_string(source.pulse_column)));
  }
  if (!source.columns.empty()) {
    check_columns(source.columns, path + ".columns", findings);
  }
  if (std::find(source.scale.begin(), source.scale.end(), 0.0) != source.scale.end()) {
    report(findings, path + ".scale",
           fmt::format("{}.scale: an entry is 0, so that its channel would read no "
                       "force; must be newtons per unit of each channel",
                       path));
  }
  if (table.from && table.to && !(*table.from < *table.to)) {
    report(findings, path + ".to_s",
           fmt::format("{}.to_s = {} s: not after from_s = {} s; must be later", path,
                       number_text(*table.to), number_text(*table.from)));
  }
  return m;
}

namespace {

/// What is searched of the runout.
void settle_runout(const std::vector<RunoutGroup>& groups, Identify& result,
                   Findings& findings) {
  const auto has = [&](RunoutGroup group) {
    return std::ranges::find(groups, group) != groups.end();
  };
  for (const RunoutGroup alone :
       {RunoutGroup::automatic, RunoutGroup::none, RunoutGroup::fixed}) {
    if (!has(alone) || groups.size() == 1) continue;
    report(
        findings, "identify.runout",
        fmt::format("identify.runout: \"{}\" stands in a list; must stand alone (what "
                    "is searched of the runout)",
                    name_of(alone)));
  }
  using identification::RunoutUnknowns;
  const bool offsets = has(RunoutGroup::offsets) || has(RunoutGroup::both);
  const bool centre = has(RunoutGroup::eccentricity) || has(RunoutGroup::both);
  result.axial_offsets = has(RunoutGroup::axial);
  result.tilt = has(RunoutGroup::tilt);
  if (has(RunoutGroup::automatic)) return;
  result.runout = has(RunoutGroup::none) ? RunoutUnknowns::none
                  : offsets && centre    ? RunoutUnknowns::both
                  : offsets              ? RunoutUnknowns::offsets
                  : centre               ? RunoutUnknowns::eccentricity
                                         : RunoutUnknowns::fixed;
}

}  // namespace

Identify identify_of(const IdentifyTable& table, const CaseTables& tables,
                     Findings& findings) {
  Identify result{.chip_models = table.chip_models,
                  .runout = std::nullopt,
                  .phase = table.phase,
                  .band_harmonics = std::nullopt,
                  .channel_offsets = table.channel_offsets,
                  .errors = table.errors,
                  .tolerances = tolerances_of(tables),
                  .shared = table.shared,
                  .previous_clamping = table.previous_clamping};
  if (table.band_harmonics && sound(findings, {"identify.band_harmonics"})) {
    const double n = *table.band_harmonics;
    if (n != std::round(n)) {
      report(
          findings, "identify.band_harmonics",
          fmt::format("identify.band_harmonics = {}: harmonics are counted; must be a "
                      "whole number from 0 to 1000000, or \"auto\"",
                      number_text(n)));
    }
    result.band_harmonics = static_cast<int>(n);
  }
  settle_runout(table.runout, result, findings);
  check_clamping(table, findings);
  if (table.shared == Shared::coefficients) {
    report(findings, "identify.shared",
           "identify.shared = \"coefficients\": one tool of one sharpness, clamped "
           "several times, is not fitted together yet; must be \"runout\", or a case "
           "file for each clamping (what groups have in common)");
  }
  const auto& models = table.chip_models;
  if (tables.chip.lookback == chip::Lookback::previous &&
      std::find(models.begin(), models.end(), chip::Model::radial) != models.end()) {
    report(findings, "identify.chip_models",
           "identify.chip_models: \"radial\" knows no [chip] lookback = \"previous\"; "
           "must be any of \"none\", \"feed\", \"trochoidal\" with it");
  }
  if (!table.sweep || !sound(findings, {"identify.sweep_um"})) {
    return result;
  }
  constexpr double most = 100000;
  const auto& [first, last, count] = *table.sweep;
  if (first >= last || count != std::round(count) || count < 2 || count > most) {
    report(
        findings, "identify.sweep_um",
        fmt::format("identify.sweep_um = [{}, {}, {}]: no sweep; must be first < last "
                    "in um, then a whole number of offsets from 2 to 100000",
                    number_text(first, unit::um), number_text(last, unit::um),
                    number_text(count)));
  } else if (tables.tool.teeth < 2 && sound(findings, {"tool.teeth"})) {
    report(findings, "identify.sweep_um",
           "identify.sweep_um: a cutter with 1 tooth has no second one to sweep");
  }
  result.sweep = table.sweep;
  return result;
}

}  // namespace trochoid::cases
