#include <trochoid/base/units.h>
#include <trochoid/inputs/case.h>
#include <trochoid/inputs/tables.h>

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace trochoid::inputs {

namespace {

/// A slot like that of the paper whose model this is: 8 mm, two teeth, one 8 um short.
CaseTables example(Command command) {
  CaseTables t;
  t.title = "Slot, 8 mm end mill";
  t.tool.teeth = 2;
  t.tool.diameter = 8 * unit::mm;
  t.tool.helix = 30 * unit::deg;
  t.cut.axial_depth = 2 * unit::mm;
  t.cut.feed_per_tooth = 0.04 * unit::mm;
  t.cut.spindle_speed = 875 * unit::rpm;
  if (command == Command::identify) {
    t.dynamometer.emplace().axes = {"x", "y", "z"};
    t.measurements.emplace_back().file = "record.csv";
    t.identify.emplace();
    return t;
  }
  t.runout.radial_offsets = {0.0, -0.008 * unit::mm};
  t.force.K_tc = 2620 * unit::MPa;
  t.force.K_rc = 1560 * unit::MPa;
  t.force.K_ac = 331 * unit::MPa;
  t.force.K_te = 7 * unit::N_per_mm;
  t.force.K_re = 3 * unit::N_per_mm;
  t.force.K_ae = 1 * unit::N_per_mm;
  return t;
}

std::vector<std::string_view> shown_tables(Command command) {
  if (command == Command::identify) {
    return {"tool", "cut", "chip", "force", "dynamometer", "measurement", "identify"};
  }
  return {"tool", "runout", "cut", "chip", "force", "sampling"};
}

std::string comment(const Key& key, const Field& field, bool given) {
  std::string text{key.meaning};
  if (std::holds_alternative<Choice>(field) || std::holds_alternative<Choices>(field)) {
    text += "; " + expectation(key, field);
  } else if (!key.word.empty()) {
    text += fmt::format("; or \"{}\"", key.word);
  }
  if (!given && !key.only.selector.empty()) {
    text = fmt::format("for {} = \"{}\": {}", key.only.selector,
                       fmt::join(key.only.values, "\" or \""), text);
  }
  return text;
}

}  // namespace

std::string new_case(Command command) {
  const std::string_view verb = command == Command::identify ? "identify" : "simulate";
  std::string text = fmt::format(
      "# A case for `trochoid {}`: write your own numbers in place of these.\n"
      "# Every key ends in its unit. A key behind a # may be left out. All keys, with\n"
      "# their ranges: docs/formats/case.md\n\n",
      verb);
  const auto line = [&text](std::string_view left, std::string_view right) {
    text += fmt::format("{:<33} # {}\n", left, right);
  };
  const Visitor key_line = [&](const Key& key, const Field& field) {
    const auto value = toml_text(key, field);
    if (command == Command::identify && key.need == Need::coefficient) {
      return;  // this is what will be found
    }
    const bool nested = std::holds_alternative<CutTable*>(field);
    line(value ? fmt::format("{} = {}", key.name, *value)
               : fmt::format("# {} = {}", key.name, nested ? "{ ... }" : "..."),
         comment(key, field, value.has_value()));
  };
  CaseTables tables = example(command);
  describe(key_line, tables);
  const auto shown = shown_tables(command);
  for (const TableEntry& table : tables_of(tables)) {
    if (std::find(shown.begin(), shown.end(), table.name) != shown.end()) {
      text += '\n';
      line(heading(table), table.meaning);
      table.describe(0, key_line);
    }
  }
  return text;
}

}  // namespace trochoid::inputs
