#include <trochoid/cases/schema_machine.h>
#include <trochoid/cases/tables.h>

#include <utility>

namespace trochoid::cases {

namespace {

using base::Command;
using Commands = std::vector<Command>;

template <class Table>
TableEntry one(std::string_view name, std::string_view meaning, Table& table,
               const Commands& needed_by = {}) {
  return {.name = name,
          .meaning = meaning,
          .needed_by = needed_by,
          .count = [] { return std::size_t{1}; },
          .add = [] {},
          .describe = [&table](std::size_t, const Visitor& v) { describe(v, table); }};
}

template <class Table>
TableEntry perhaps(std::string_view name, std::string_view meaning,
                   std::optional<Table>& table, const Commands& needed_by = {}) {
  return {.name = name,
          .meaning = meaning,
          .needed_by = needed_by,
          .count = [&table] { return std::size_t{table ? 1U : 0U}; },
          .add = [&table] { table.emplace(); },
          .describe = [&table](std::size_t, const Visitor& v) { describe(v, *table); }};
}

template <class Table>
TableEntry several(std::string_view name, std::string_view meaning,
                   std::vector<Table>& all, const Commands& needed_by = {}) {
  return {.name = name,
          .meaning = meaning,
          .needed_by = needed_by,
          .many = true,
          .count = [&all] { return all.size(); },
          .add = [&all] { all.emplace_back(); },
          .describe = [&all](std::size_t i, const Visitor& v) { describe(v, all[i]); }};
}

/// The tool, its cut, its forces, and what was measured of them.
std::vector<TableEntry> tables_of_cut(CaseTables& t) {
  const Commands all_commands{Command::simulate,  Command::identify,  Command::surface,
                              Command::calibrate, Command::stability, Command::dynamics,
                              Command::correct,   Command::plan};
  Commands with_program = all_commands;
  with_program.push_back(Command::program);
  return {
      one("tool", "the cutter", t.tool, with_program),
      one("runout", "how the teeth stand out; left out: no runout", t.runout),
      one("cut", "the cut; the tool feeds along +x", t.cut, all_commands),
      one("chip", "the model of the uncut chip thickness", t.chip),
      one("force", "the force law and its coefficients, as forces on the tool", t.force,
          {Command::simulate, Command::surface, Command::stability, Command::dynamics,
           Command::program}),
      perhaps(
          "orthogonal",
          "what orthogonal cutting told of the material, in place of K_tc, K_rc and "
          "K_ac of [force]: they are computed by F-19",
          t.orthogonal),
      one("sampling", "where a simulation is evaluated, and how exactly", t.sampling),
      perhaps("dynamometer", "what the channels read; left out: x, y, z",
              t.dynamometer),
      several("measurement", "a record, or means; several are fitted together",
              t.measurements, {Command::identify}),
      perhaps("identify", "what is to be found from the measurements", t.identify),
      perhaps("prior",
              "what is known of the coefficients beforehand, for example of another "
              "tool in this material",
              t.prior),
      perhaps(
          "plan",
          "among which cuts the one to be measured next is chosen; or how a wall is "
          "measured and cut",
          t.plan),
  };
}

/// What bends, vibrates and moves.
std::vector<TableEntry> tables_of_machine(CaseTables& t) {
  return {
      perhaps("cutter_body", "the cutter as an elastic beam", t.machine.cutter_body),
      perhaps("wall",
              "the workpiece as an elastic plate, clamped below and, unless said "
              "otherwise, at both ends; left out: rigid",
              t.machine.wall),
      perhaps("surface", "how the machined surface is computed", t.machine.surface),
      several("pass",
              "one of several passes over the wall, in their order; left out: one, as "
              "[cut] has it",
              t.machine.passes),
      several("surface_measurement", "a measured surface; several are fitted together",
              t.machine.surface_measurements, {Command::calibrate}),
      several("mode", "a mode of vibration", t.machine.modes,
              {Command::dynamics, Command::correct}),
      several("measured_frf",
              "how the tool point, or the work, answers to a force, as measured: for "
              "stability, and for modes that several responses share",
              t.machine.measured_frfs),
      perhaps("actuator", "the actuator that moves the table", t.machine.actuator,
              {Command::correct}),
      perhaps("frf",
              "a measured frequency response, from which `modes` finds modes, and how",
              t.machine.frf),
      perhaps("step", "a measured step, from which the actuator is found",
              t.machine.step, {Command::actuator}),
      perhaps("command", "an imposed command of the actuator", t.machine.command),
      perhaps("correct", "how runout is to be cancelled", t.machine.correct),
      perhaps(
          "spindle",
          "what turns the tool: with it a spindle speed that changes within the turn "
          "is compared with the table that moves",
          t.machine.spindle),
      perhaps("controller", "the real-time controller, when it is simulated",
              t.machine.controller),
      perhaps("stability", "where stability is looked at, and how exactly",
              t.machine.stability),
  };
}

/// A whole NC program.
std::vector<TableEntry> tables_of_program(CaseTables& t) {
  return {
      perhaps("program", "a whole NC program in G code, and what is known of it",
              t.nc.program, {Command::program}),
      perhaps(
          "stock",
          "the workpiece before the program; exactly one of box_mm, cylinder_mm and "
          "file",
          t.nc.stock, {Command::program}),
      perhaps("limits", "what no step of the program may exceed", t.nc.limits),
      perhaps("machine", "the drives and the spindle of the machine", t.nc.machine),
      perhaps("feed", "how the feed of the program is to be changed", t.nc.feed),
  };
}

}  // namespace

std::vector<TableEntry> tables_of(CaseTables& t) {
  std::vector<TableEntry> tables = tables_of_cut(t);
  for (TableEntry& table : tables_of_machine(t)) tables.push_back(std::move(table));
  for (TableEntry& table : tables_of_program(t)) tables.push_back(std::move(table));
  return tables;
}

}  // namespace trochoid::cases
