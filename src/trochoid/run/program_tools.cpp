#include <trochoid/run/program.h>

#include <trochoid/run/wall.h>

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string>
#include <string_view>

// The tools of a program: from which cases they come, and what is not known of them.
namespace trochoid::run {

namespace {

engagement::Tool tool_of(const cases::Case& given) {
  engagement::Tool tool{.cutter = given.setup.cutter,
                        .runout = given.setup.runout,
                        .law = given.law,
                        .edge_length = given.setup.edge_length,
                        .chip = given.setup.chip,
                        .body = wall_cutter(given.machine),
                        .gauge_length = given.gauge_length.value_or(0.0)};
  if (tool.body) tool.flute_length = tool.body->flute_length;
  return tool;
}

/// Tools of which a move is fed: others are only loaded.
std::vector<std::string> fed_tools(const program::Program& program) {
  std::vector<char> fed(program.tools.size());
  for (const program::Move& move : program.moves) {
    if (is_fed(move) && move.tool >= 0) fed[static_cast<std::size_t>(move.tool)] = 1;
  }
  std::vector<std::string> out;
  for (std::size_t i = 0; i < fed.size(); ++i) {
    if (fed[i] != 0) out.push_back(program.tools[i]);
  }
  return out;
}

/// Names of fed tools for which the case says nothing else.
std::vector<std::string> unnamed(const cases::NcProgram& nc,
                                 const program::Program& program) {
  std::vector<std::string> out;
  for (const std::string& name : fed_tools(program)) {
    const bool ignored = std::ranges::any_of(
        nc.ignored_tools, [&](const cases::ToolName& t) { return t.text == name; });
    if (!ignored && nc.cases_of_tools.count(name) == 0) out.push_back(name);
  }
  return out;
}

}  // namespace

bool is_fed(const program::Move& move) noexcept {
  using enum program::MoveKind;
  return move.kind == line || move.kind == arc || move.kind == chord;
}

ProgramTools tools_of(const cases::Case& given, const program::Program& program) {
  const cases::NcProgram& nc = *given.nc.program;
  ProgramTools out;
  const engagement::Vibration vibration = vibration_of(given, out.notes);
  const auto add_own = [&] {
    out.tools.push_back(tool_of(given));
    out.vibrations.push_back(vibration);
  };
  if (program.tools.empty()) {
    add_own();
    out.own.push_back(0);
  }
  const std::vector<std::string> left = unnamed(nc, program);
  for (const std::string& name : program.tools) {
    if (const auto other = nc.cases_of_tools.find(name);
        other != nc.cases_of_tools.end()) {
      std::vector<base::Warning> notes;
      out.tools.push_back(tool_of(*other->second));
      out.vibrations.push_back(vibration_of(*other->second, notes));
      for (const base::Warning& note : notes) {
        out.notes.push_back({note.code, fmt::format("T{}: {}", name, note.message)});
      }
      continue;
    }
    out.own.push_back(out.tools.size());
    add_own();
    const bool is_left = std::ranges::find(left, name) != left.end();
    const bool known =
        nc.tool_number.text.empty() ? left.size() == 1 : name == nc.tool_number.text;
    out.tools.back().cuts = is_left;
    if (is_left && !known) {
      out.why_not.push_back(
          {"tool_not_described",
           fmt::format(
               "T{}: this tool is in no case, so no forces are computed. Give its "
               "case in [program] tools, or name it in ignore_tools: then its "
               "moves cut nothing.",
               name)});
    }
  }
  return out;
}

void warn_of_tools(const cases::Case& given, const program::Program& program,
                   const ProgramTools& tools, std::vector<base::Warning>& warnings) {
  const cases::ForceLimits limits = given.nc.limits.value_or(cases::ForceLimits{});
  const bool some_vibrate = std::ranges::any_of(
      tools.vibrations,
      [](const engagement::Vibration& one) { return !one.system.modes.empty(); });
  for (const std::string& name : fed_tools(program)) {
    const auto i = static_cast<std::size_t>(std::ranges::find(program.tools, name) -
                                            program.tools.begin());
    const engagement::Tool& tool = tools.tools[i];
    const auto warn = [&](std::string_view code, std::string_view what) {
      warnings.push_back({std::string(code), fmt::format("T{}: {}", name, what)});
    };
    if (!tool.cuts) {
      warn("tool_ignored", "its moves cut nothing here; what it would cut stays.");
      continue;
    }
    if (some_vibrate && tools.vibrations[i].system.modes.empty()) {
      warn("no_modes", "its case has no [[mode]]: whether it chatters is not known.");
    }
    if (limits.deflection && !tool.body) {
      warn("limit_not_checked",
           "its case has no [cutter_body], so deflection_um of "
           "[limits] is not checked for it.");
    }
    if (limits.bending_moment && !(tool.gauge_length > 0)) {
      warn("limit_not_checked",
           "its case has no gauge_length_mm, so bending_moment_Nm "
           "of [limits] is not checked for it.");
    }
  }
}

void warn_of_other_tools(const cases::NcProgram& nc, const program::Program& program,
                         std::vector<base::Warning>& warnings) {
  if (program.tools.empty()) return;
  std::vector<std::string> other;
  const auto look = [&](const std::string& name) {
    if (!name.empty() && std::ranges::count(program.tools, name) == 0) {
      other.push_back(name);
    }
  };
  look(nc.tool_number.text);
  for (const auto& [name, of] : nc.cases_of_tools) look(name);
  for (const cases::ToolName& tool : nc.ignored_tools) look(tool.text);
  if (other.empty()) return;
  warnings.push_back(
      {"tool_not_in_program",
       fmt::format(
           "[program] names the tool {}, which the program does not have. It has "
           "{}: write them like this.",
           fmt::join(other, ", "), fmt::join(program.tools, ", "))});
}

}  // namespace trochoid::run
