#include <trochoid/base/units.h>
#include <trochoid/cases/number_text.h>
#include <trochoid/cases/rules.h>

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <cmath>

namespace trochoid::cases {

namespace {

/// A whole number behind a prefix; nothing where there is none, or more.
std::optional<int> number_behind(std::string_view text, std::string_view prefix) {
  if (!text.starts_with(prefix)) return std::nullopt;
  text.remove_prefix(prefix.size());
  int number = 0;
  const char* end = text.data() + text.size();
  const auto read = std::from_chars(text.data(), end, number);
  if (text.empty() || read.ec != std::errc{} || read.ptr != end || number < 0) {
    return std::nullopt;
  }
  return number;
}

bool is_work_offset(std::string_view name) {
  const auto within = [](std::optional<int> number, int low, int high) {
    return number && *number >= low && *number <= high;
  };
  return within(number_behind(name, "G"), 54, 59) ||
         within(number_behind(name, "G"), 500, 599) ||
         within(number_behind(name, "G59."), 1, 3) ||
         number_behind(name, "G54.1P").has_value() ||
         number_behind(name, "G154P").has_value();
}

void settle_offsets(NcProgram& p, Findings& findings) {
  NamedPlaces named;
  for (const auto& [given, place] : p.offsets) {
    const std::string name = program::offset_name(given);
    if (!is_work_offset(name)) {
      report(
          findings, "program.offsets_mm",
          fmt::format("program.offsets_mm: {} is no work offset; must be G54 to G59, "
                      "G59.1 to G59.3, G54.1Pn, G154Pn, or G500 to G599",
                      toml_string(given)));
    }
    named[name] = place;
  }
  p.offsets = std::move(named);
}

/// A word of a program: a letter with its number, or a name.
bool is_word(std::string_view text) {
  const auto letter = [](char c) {
    return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z');
  };
  return !text.empty() && letter(text.front()) &&
         std::ranges::all_of(text, [&](char c) {
           return letter(c) || (c >= '0' && c <= '9') || c == '_' || c == '.';
         });
}

/// m010 as M10.
std::string canonical_word(const std::string& word) {
  double number = 0.0;
  const char* end = word.data() + word.size();
  const auto read = std::from_chars(word.data() + 1, end, number);
  if (read.ec != std::errc{} || read.ptr != end) return word;
  const char c = word.front();
  return fmt::format("{}{:g}", c >= 'a' ? static_cast<char>(c - 'a' + 'A') : c, number);
}

void settle_words(NcProgram& p, Findings& findings) {
  for (std::string& word : p.ignored_words) {
    if (is_word(word)) {
      word = canonical_word(word);
    } else {
      report(findings, "program.ignore_words",
             fmt::format("program.ignore_words: {} is no word; must be a letter with "
                         "its number, or a name",
                         toml_string(word)));
    }
  }
}

void check_tools(const NcProgram& p, Findings& findings) {
  const auto twice = [&](const std::string& name) {
    report(findings, "program.tools",
           fmt::format("program.tools: {} is there twice; each tool must be the "
                       "case's own, one of tools, or one of ignore_tools",
                       toml_string(name)));
  };
  if (p.tools.count(p.tool_number.text) > 0) twice(p.tool_number.text);
  for (const ToolName& tool : p.ignored_tools) {
    if (tool.text == p.tool_number.text || p.tools.count(tool.text) > 0) {
      twice(tool.text);
    }
  }
}

void check_places(const NcProgram& p, Findings& findings) {
  for (std::size_t i = 0; i < p.places.size(); ++i) {
    const auto [line, fraction] = p.places[i];
    if (line >= 1 && line == std::floor(line) && fraction <= 1) continue;
    report(findings, "program.places",
           fmt::format("program.places entry {}: must be the number of a line, from 1, "
                       "and a fraction from 0 to 1",
                       i + 1));
  }
}

void check_program_table(NcProgram& p, Findings& findings) {
  if (p.dialect == ProgramDialect::heidenhain_iso) {
    report(findings, "program.dialect",
           "program.dialect = \"heidenhain_iso\": this dialect is not read; post the "
           "program as ISO for another control");
  }
  settle_offsets(p, findings);
  settle_words(p, findings);
  check_tools(p, findings);
  check_places(p, findings);
}

void check_order(const std::string& key, double low, double high, std::string_view what,
                 Findings& findings) {
  if (low < high) return;
  report(findings, key, fmt::format("{}: {}", key, what));
}

void check_stock(const Stock& s, Findings& findings) {
  const int shapes =
      (s.box.empty() ? 0 : 1) + (s.cylinder ? 1 : 0) + (s.file.name.empty() ? 0 : 1);
  if (shapes != 1 && sound(findings, {"stock"}) &&
      sound(findings, {"stock.box_mm", "stock.cylinder_mm", "stock.file"})) {
    report(findings, "stock",
           fmt::format("[stock] has {}; exactly one of box_mm, cylinder_mm and file is "
                       "needed",
                       shapes == 0 ? "no shape" : "more than one shape"));
  }
  if (s.box.size() == 2 && sound(findings, {"stock.box_mm"})) {
    for (std::size_t i = 0; i < 3; ++i) {
      check_order("stock.box_mm", s.box[0][i], s.box[1][i],
                  "the first corner must be below the second in x, y and z", findings);
      if (!sound(findings, {"stock.box_mm"})) break;
    }
  }
  if (s.cylinder && sound(findings, {"stock.cylinder_mm"})) {
    check_order("stock.cylinder_mm", s.cylinder->z[0], s.cylinder->z[1],
                "z must have the lowest first", findings);
  }
}

void check_power_curve(const Pairs& curve, Findings& findings) {
  for (std::size_t i = 1; i < curve.size(); ++i) {
    if (curve[i][0] > curve[i - 1][0]) continue;
    report(
        findings, "machine.power_curve_W",
        fmt::format("machine.power_curve_W entry {}: the speed must rise from row to "
                    "row",
                    i + 1));
    return;
  }
}

/// A record made while the program ran.
void check_record(const CaseTables& tables, Findings& findings) {
  if (tables.measurements.size() > 1) {
    report(findings, "measurement[2]",
           "[[measurement]]: a program takes one record, made while it ran");
  }
  const bool automatic = tables.dynamometer &&
                         tables.dynamometer->axes == std::vector<std::string>{"auto"};
  if (!tables.measurements.empty() && automatic) {
    report(
        findings, "dynamometer.axes",
        "dynamometer.axes = \"auto\": identify finds axes, program does not; must be "
        "three names, as in [\"-x\", \"-y\", \"-z\"]");
  }
}

void check_feed(const FeedRules& feed, const ProgramTables& nc, Findings& findings) {
  if (feed.factor.size() == 2 && sound(findings, {"feed.factor"})) {
    check_order("feed.factor", feed.factor[0], feed.factor[1],
                "the lowest must be below the highest", findings);
  }
  if (feed.target == FeedTarget::limits && !nc.limits) {
    report(findings, "feed.target",
           "feed.target = \"limits\": [limits] is missing; must be there with it");
  }
  const bool plain = feed.write.find_first_of("/\\:") == std::string::npos &&
                     feed.write != "." && feed.write != "..";
  if (!plain) {
    report(findings, "feed.write",
           fmt::format("feed.write = {}: must be a name without a folder",
                       toml_string(feed.write)));
  }
}

/// A limit of what nothing tells would be kept by any cut.
void check_limits(const CaseTables& tables, Findings& findings) {
  const ForceLimits& limits = *tables.nc.limits;
  if (limits.deflection && !tables.machine.cutter_body) {
    report(findings, "limits.deflection_um",
           "limits.deflection_um: how far the tool deflects is not known; must go with "
           "[cutter_body]");
  }
  if (limits.bending_moment && !tables.tool.gauge_length) {
    report(
        findings, "limits.bending_moment_Nm",
        "limits.bending_moment_Nm: where the moment counts is not known; must go with "
        "gauge_length_mm in [tool]");
  }
}

}  // namespace

void check_program(CaseTables& tables, Findings& findings) {
  ProgramTables& nc = tables.nc;
  if (nc.program && nc.limits) check_limits(tables, findings);
  if (nc.program) {
    check_program_table(*nc.program, findings);
    check_record(tables, findings);
  }
  if (nc.stock) check_stock(*nc.stock, findings);
  if (nc.limits && nc.limits->chip.size() == 2 && sound(findings, {"limits.chip_mm"})) {
    check_order("limits.chip_mm", nc.limits->chip[0], nc.limits->chip[1],
                "the lowest must be below the highest", findings);
  }
  if (nc.machine) check_power_curve(nc.machine->power_curve, findings);
  if (nc.feed) check_feed(*nc.feed, nc, findings);
}

program::ReadOptions read_options(const ProgramTables& nc) {
  const NcProgram& p = *nc.program;
  program::ReadOptions options;
  switch (p.dialect) {
    case ProgramDialect::iso:
      options.dialect = program::Dialect::iso;
      break;
    case ProgramDialect::linuxcnc:
      options.dialect = program::Dialect::linuxcnc;
      break;
    case ProgramDialect::sinumerik:
      options.dialect = program::Dialect::sinumerik;
      break;
    case ProgramDialect::automatic:
    case ProgramDialect::heidenhain_iso:
      break;
  }
  options.ignored_words = p.ignored_words;
  std::ranges::copy_n(p.origin.begin(), 3, options.origin.begin());
  if (!p.start.empty())
    std::ranges::copy_n(p.start.begin(), 3, options.start.emplace().begin());
  options.offsets = p.offsets;
  options.wear_zero = p.compensation == Compensation::wear_zero;
  options.block_delete = p.block_delete;
  if (nc.machine) options.rapid_feed = nc.machine->rapid_feed;
  return options;
}

}  // namespace trochoid::cases
