#include <trochoid/base/error.h>
#include <trochoid/cases/case_source.h>
#include <trochoid/cases/read_table.h>
#include <trochoid/cases/rules.h>
#include <trochoid/cases/tables.h>
#include <trochoid/cases/wall_readings.h>
#include <trochoid/cases/write_case.h>
#include <trochoid/files/command_file.h>
#include <trochoid/files/program_file.h>
#include <trochoid/files/record_file.h>

#include <fmt/core.h>

#include <algorithm>
#include <array>

namespace trochoid::cases {

namespace {

namespace fs = std::filesystem;

/// One [name], or every [[name]], into its entry.
void read_entry(const TableEntry& entry, const Node& node, const Reading& reading,
                Findings& findings) {
  const std::string name{entry.name};
  const auto read = [&](const Node& table, const std::string& path) {
    entry.add();
    const std::size_t last = entry.count() - 1;
    read_table(
        table, path, [&](const Visitor& v) { entry.describe(last, v); }, reading,
        findings);
  };
  const auto* list = std::get_if<Array>(&node.value);
  if (!entry.many && std::holds_alternative<Members>(node.value)) {
    read(node, name);
  } else if (entry.many && list != nullptr && !list->empty() &&
             std::holds_alternative<Members>(list->front().value)) {
    for (std::size_t i = 0; i < list->size(); ++i) {
      const std::string path = fmt::format("{}[{}]", name, i + 1);
      if (std::holds_alternative<Members>((*list)[i].value)) {
        read((*list)[i], path);
      } else {
        report(findings, path, (*list)[i].where,
               fmt::format("{} = {}: not a table ({})", path, to_string((*list)[i]),
                           entry.meaning));
      }
    }
  } else {
    report(
        findings, name, node.where,
        fmt::format("{} = {}: not a table of that kind; must be written as {} ({})",
                    name, to_string(node),
                    entry.many ? "[[" + name + "]]" : "[" + name + "]", entry.meaning));
  }
}

/// @return the tables that are there, but misspelt
std::vector<std::string> report_unknown(const Node& root,
                                        const std::vector<TableEntry>& entries,
                                        Findings& findings) {
  std::vector<std::string> names;
  names.reserve(entries.size());
  for (const TableEntry& entry : entries) {
    names.emplace_back(entry.name);
  }
  std::vector<std::string> meant;
  for (const Member& member : std::get<Members>(root.value)) {
    const bool known = member.key == "title" || member.key == "schema" ||
                       member.key == "include" || member.key == "sweep" ||
                       std::find(names.begin(), names.end(), member.key) != names.end();
    if (known) {
      continue;
    }
    const bool table = std::holds_alternative<Members>(member.node.value);
    const std::string shown = shown_key(member.key);
    if (table) {
      meant.push_back(nearest(member.key, names));
      report(
          findings, shown, member.where,
          fmt::format("[{}]: no such table{}", shown, suggestion(member.key, names)));
    } else {
      const std::string home = home_of(member.key);
      report(findings, shown, member.where,
             fmt::format("{} = {}: no such key above the tables{}", shown,
                         to_string(member.node),
                         home.empty()
                             ? suggestion(member.key, {"title", "include", "schema"})
                             : home));
    }
  }
  return meant;
}

/// Whether [force] has the coefficient that every law has in some form.
bool knows_coefficients(const Node& root) {
  const Node* force = find(root, "force");
  if (force == nullptr) return false;
  return std::ranges::any_of(
      std::array<std::string_view, 2>{"K_tc_MPa", "K_t1_MPa"},
      [&](std::string_view key) { return find(*force, key) != nullptr; });
}

/// Whether a surface is asked for of which nothing bends: it needs no forces.
bool is_rigid_finish(Command purpose, const Node& root) {
  return purpose == Command::surface && find(root, "cutter_body") == nullptr &&
         find(root, "wall") == nullptr && find(root, "force") == nullptr;
}

/// What a command needs of a case.
Reading reading_for(Command purpose, const Node& root) {
  const bool fitted = find(root, "measurement") != nullptr;
  return {.cutting_needed = find(root, "orthogonal") == nullptr,
          .coefficients_needed =
              purpose == Command::simulate ||
              (purpose == Command::surface && !is_rigid_finish(purpose, root)) ||
              purpose == Command::stability || purpose == Command::dynamics ||
              purpose == Command::program || (purpose == Command::correct && !fitted) ||
              (purpose == Command::plan && !fitted &&
               find(root, "surface_measurement") == nullptr)};
}

/// @param purpose    none: nothing is missing
/// @param tool_only  of a program only the tool is needed
CaseTables read_tables(const Node& given, std::optional<Command> purpose,
                       Findings& findings, bool tool_only = false) {
  CaseTables tables;
  const Node root = without_outvoted_coefficients(given);
  const Node* cut = find(root, "cut");
  Reading reading = purpose ? reading_for(*purpose, root) : Reading{};
  reading.cut =
      cut != nullptr && std::holds_alternative<Members>(cut->value) ? cut : nullptr;
  read_table(
      root, "", [&](const Visitor& v) { describe(v, tables); }, reading, findings);
  const auto entries = tables_of(tables);
  const auto meant = report_unknown(root, entries, findings);
  for (const TableEntry& entry : entries) {
    if (const Node* node = find(root, entry.name)) {
      read_entry(entry, *node, reading, findings);
    } else if ((tool_only && (entry.name == "program" || entry.name == "stock")) ||
               (purpose && entry.name == "force" && is_rigid_finish(*purpose, root))) {
      continue;
    } else if (purpose && std::count(entry.needed_by.begin(), entry.needed_by.end(),
                                     *purpose) > 0) {
      findings.wrong.insert(std::string(entry.name));
      if (std::count(meant.begin(), meant.end(), entry.name) > 0) {
        continue;
      }
      report(findings, std::string(entry.name),
             fmt::format("{} is missing ({}); {} needs it", heading(entry),
                         entry.meaning, name_of(*purpose)));
    }
  }
  for (std::size_t i = 0; i < tables.measurements.size(); ++i) {
    if (findings.places.count(fmt::format("measurement[{}].cut", i + 1)) == 0) {
      tables.measurements[i].cut = tables.cut;
    }
  }
  return tables;
}

/// The simple chip models know no turn of a tooth by the runout: nor does a runout that
/// calibrate looks for with one of them, unless the file says so.
void settle_order(CaseTables& t, Command purpose, const Findings& findings) {
  const bool simple = t.chip.model != chip::Model::trochoidal;
  if (purpose == Command::calibrate && simple &&
      findings.places.count("runout.eccentricity_order") == 0) {
    t.runout.order = geometry::EccentricityOrder::first;
  }
}

/// Motion in time is followed until it settles.
void settle_turns(CaseTables& t, bool in_time, const Findings& findings) {
  constexpr double until_it_settles = 20;
  if (in_time && findings.places.count("sampling.revolutions") == 0) {
    t.sampling.revolutions = until_it_settles;
  }
}

/// Tool, cut and chip.
void assemble_cut(CaseTables& t, Command purpose, Findings& findings, Case& c) {
  c.setup.cutter = cutter_of(t.tool, findings);
  settle_order(t, purpose, findings);
  check_runout(t.runout, t.tool, findings);
  c.setup.runout = t.runout;
  if (purpose != Command::program)
    c.setup.cut = cut_of(t.cut, "cut", c.setup.cutter, findings);
  check_chip(t.chip, findings);
  c.setup.chip = t.chip;
  c.setup.edge_length = t.force.edge_length;
  settle_orthogonal(t, c.setup, purpose, findings);
  c.setup.process_damping = damping_of(t.force, purpose, findings);
  c.gauge_length = t.tool.gauge_length;
  c.dish = t.tool.dish;
  c.wiper = t.tool.wiper;
  c.spindle_lead = t.cut.spindle_lead;
  check_edges(t, c.setup, purpose, findings);
}

Case assemble(CaseTables& t, Command purpose, Findings& findings) {
  Case c;
  c.title = t.title;
  assemble_cut(t, purpose, findings, c);
  const bool in_time = purpose == Command::dynamics || purpose == Command::correct;
  settle_turns(t, in_time, findings);
  check_sampling(t.sampling, findings);
  c.sampling = t.sampling;
  const bool of_program = purpose == Command::program;
  const bool to_fit =
      purpose == Command::identify || (!t.measurements.empty() && !of_program);
  c.law = law_of(t.force, to_fit || purpose == Command::calibrate);
  if (t.dynamometer) {
    c.dynamometer = dynamometer_of(*t.dynamometer, findings);
  }
  for (std::size_t i = 0; i < t.measurements.size(); ++i) {
    c.measurements.push_back(measurement_of(t.measurements[i], i + 1, findings));
    if (of_program) continue;  // the program is the cut
    c.measurements.back().cut =
        cut_of(t.measurements[i].cut, fmt::format("measurement[{}].cut", i + 1),
               c.setup.cutter, findings);
  }
  if ((to_fit || purpose == Command::plan) && !t.identify) {
    t.identify.emplace();
  }
  if (t.identify) {
    settle_serrated_models(t, findings);
    c.identify = identify_of(*t.identify, t, findings);
  }
  settle_channels(t, purpose, findings, c);
  check_machine(t.machine, t.tool, findings);
  if (purpose == Command::calibrate && is_finish(t.machine)) {
    check_finish(t, findings);
  } else if (purpose == Command::surface || purpose == Command::calibrate) {
    check_wall_cut(t, name_of(purpose), findings);
  }
  check_surface(t, findings);
  if (purpose == Command::stability) {
    check_stability(t, findings);
  }
  if (in_time) {
    check_dynamics(t, findings);
  }
  if (purpose == Command::correct) {
    check_correct(t, findings);
  }
  if (purpose == Command::plan) check_plan(t, findings);
  check_program(t, findings);
  if (of_program) check_measured_frfs(t.machine.measured_frfs, findings);
  c.nc = t.nc;
  c.plan = t.plan.value_or(Plan{});
  c.machine = t.machine;
  for (std::size_t i = 0; i < c.machine.surface_measurements.size(); ++i) {
    auto& frame = c.machine.surface_measurements[i].source.frame;
    if (frame) settle_frame(*frame, i + 1, findings);
  }
  return c;
}

/// A case about a machine without a cut: modes and actuator need none.
Case assemble_machine(CaseTables& t, Findings& findings) {
  Case c;
  c.title = t.title;
  check_machine(t.machine, t.tool, findings);
  c.machine = t.machine;
  return c;
}

Findings findings_of(const CaseSource& source) {
  return {.file = source.file.string(),
          .first_line = std::min(1, source.root.where.line),
          .base = source.base};
}

/// The cases of further tools of a program, each with all its problems.
/// @return  these problems
std::vector<std::string> read_tools(NcProgram& program, const Findings& findings) {
  std::vector<std::string> problems;
  for (const auto& [name, file] : program.tools) {
    if (!sound(findings, {"program.tools." + name})) continue;
    try {
      const Node root =
          file.bytes ? parse_text(*file.bytes, file.name) : load_document(file.path);
      const CaseSource source{
          .root = root, .file = file.path, .data = {}, .tool_only = true};
      program.cases_of_tools[name] =
          std::make_shared<const Case>(read_case(source, Command::program));
    } catch (const base::InputError& error) {
      problems.insert(problems.end(), error.problems().begin(), error.problems().end());
    }
  }
  return problems;
}

/// Every file that the case names is read when its data are asked for.
void hold_data(Case& c) {
  for (Measurement& m : c.measurements) {
    if (!m.mean.empty()) continue;
    m.record = Held<signal::Record>::by(
        [source = m.source] { return files::read_record(source); });
  }
  if (c.dynamometer && !c.dynamometer->frf.name.empty()) {
    c.dynamometer->response = Held<files::TransmissionFile>::by(
        [file = c.dynamometer->frf] { return files::read_transmission(file); });
  }
  MachineTables& machine = c.machine;
  for (SurfaceMeasurement& m : machine.surface_measurements) {
    if (m.of == MeasuredOf::finish) {
      if (!m.source.height) m.source.height = 0.0;  // its file has none
      m.surface = Held<files::SurfaceFile>::by(
          [source = m.source] { return files::read_surface_file(source); });
      continue;
    }
    m.surface = Held<files::SurfaceFile>::by(
        [wall = wall_of(c), source = m.source] { return read_wall(source, wall); });
  }
  const auto response = [](const files::FrfSource& source) {
    return Held<files::FrfFile>::by([source] { return files::read_frf(source); });
  };
  if (machine.frf) {
    machine.frf->response = response(machine.frf->source);
    machine.frf->directed = Held<std::vector<files::DirectedFrf>>::by(
        [source = machine.frf->source] { return files::read_directed_frfs(source); });
  }
  for (MeasuredFrf& frf : machine.measured_frfs) frf.response = response(frf.source);
  if (machine.step) {
    machine.step->step = Held<files::StepFile>::by(
        [source = machine.step->source] { return files::read_step(source); });
  }
  if (c.nc.program) {
    c.nc.program->text = Held<files::ProgramFile>::by(
        [file = c.nc.program->file, options = read_options(c.nc)] {
          return files::read_program(file, options);
        });
  }
  if (c.nc.stock && !c.nc.stock->file.name.empty()) {
    c.nc.stock->faces = Held<std::vector<stock::Triangle>>::by(
        [file = c.nc.stock->file] { return files::read_stl(file); });
  }
  if (machine.command && machine.command->shape == CommandShape::table) {
    machine.command->table = Held<dynamics::CommandTable>::by(
        [file = machine.command->file] { return files::read_command(file); });
  }
}

}  // namespace

Case read_case(const fs::path& file, std::optional<Command> command,
               const fs::path& result_folder) {
  const Node root = load_document(file);
  return read_case(CaseSource{root, file, {}}, command, result_folder);
}

Command command_of(const Node& root) {
  const auto has = [&root](std::string_view table) {
    return find(root, table) != nullptr;
  };
  // Coefficients that are known are compared with a measurement, not searched.
  const bool known = knows_coefficients(root);
  if (has("program")) return Command::program;
  if (has("plan")) return Command::plan;
  if (has("correct")) return Command::correct;
  if (has("command") && has("mode")) return Command::dynamics;
  if (has("measurement")) {
    return known && !has("identify") ? Command::simulate : Command::identify;
  }
  if (has("surface_measurement")) {
    return known && has("surface") ? Command::surface : Command::calibrate;
  }
  if (has("stability")) return Command::stability;
  if (!has("tool") && (has("frf") || has("measured_frf"))) return Command::modes;
  if (!has("tool") && has("step")) return Command::actuator;
  return has("surface") || has("wall") || has("cutter_body") ? Command::surface
                                                             : Command::simulate;
}

void check_keys(const CaseSource& source) {
  Findings findings = findings_of(source);
  static_cast<void>(read_tables(source.root, std::nullopt, findings));
  if (!findings.problems.empty()) {
    throw base::InputError(lines(findings));
  }
}

Case read_case(const CaseSource& source, std::optional<Command> command,
               const fs::path& result_folder) {
  const Node& root = source.root;
  Findings findings = findings_of(source);
  const Command purpose = command.value_or(command_of(root));
  CaseTables tables = read_tables(root, purpose, findings, source.tool_only);
  settle_files(tables, source.data, findings);
  if (purpose == Command::modes && !tables.machine.measured_frfs.empty() &&
      !tables.machine.frf) {
    tables.machine.frf.emplace();  // its defaults stand in the echo
  }
  const bool no_cut = (purpose == Command::modes || purpose == Command::actuator) &&
                      find(root, "tool") == nullptr && find(root, "cut") == nullptr;
  Case c =
      no_cut ? assemble_machine(tables, findings) : assemble(tables, purpose, findings);
  check_files(tables, findings);
  if (purpose == Command::modes) {
    check_shared_modes(c.machine, findings);
  }
  std::vector<std::string> problems = lines(findings);
  if (c.nc.program && !source.tool_only) {
    const auto of_tools = read_tools(*c.nc.program, findings);
    problems.insert(problems.end(), of_tools.begin(), of_tools.end());
  }
  if (!problems.empty()) {
    throw base::InputError(std::move(problems));
  }
  if (purpose == Command::program && find(root, "cut") != nullptr &&
      !source.tool_only) {
    findings.notes.push_back(
        {"cut_not_used", "[cut] is not used: the program is the cut"});
  }
  c.file = source.file;
  c.forces_known = find(root, "force") != nullptr;
  hold_data(c);
  c.notes = std::move(findings.notes);
  if (!source.echo) return c;
  name_files_from(result_folder, tables);
  c.as_understood = no_cut                        ? write_machine_case(tables)
                    : purpose == Command::program ? write_program_case(tables)
                                                  : write_case(tables);
  return c;
}

Case bare_case(const MachineTables& machine, Command command,
               const fs::path& result_folder) {
  const bool modes = command == Command::modes;
  Findings findings{.file = modes ? machine.frf->source.file.path
                                  : machine.step->source.file.path};
  CaseTables tables;
  tables.machine = machine;
  tables.title = fs::path(findings.file).filename().string();
  check_machine(tables.machine, tables.tool, findings);
  if (!findings.problems.empty()) {
    throw base::InputError(lines(findings));
  }
  Case c;
  c.file = findings.file;
  c.title = tables.title;
  c.machine = tables.machine;
  hold_data(c);
  name_files_from(result_folder, tables);
  c.as_understood = write_machine_case(tables);
  return c;
}

}  // namespace trochoid::cases
