#include <trochoid/base/error.h>
#include <trochoid/base/printable.h>
#include <trochoid/base/units.h>
#include <trochoid/cases/case.h>
#include <trochoid/cases/document.h>
#include <trochoid/cases/number_text.h>
#include <trochoid/cases/tables.h>
#include <trochoid/cases/tool_file.h>
#include <trochoid/cases/usual_tools.h>
#include <trochoid/cases/write_case.h>

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>

namespace trochoid::cases {

namespace {

void give(ForceTable& table, const force::LinearEdge& law) {
  for (const auto& number : force::numbers(law)) {
    table.numbers[number.quantity.key] = law.*number.value;
  }
}

/// A slot like that of [riviere2009]: 8 mm, two teeth, one 8 um short.
void add_slot(CaseTables& t) {
  t.title = "Slot, 8 mm end mill";
  t.tool.teeth = 2;
  t.tool.diameter = 8 * unit::mm;
  t.tool.helix = {{30 * unit::deg}};
  t.cut.axial_depth = 2 * unit::mm;
  t.cut.feed_per_tooth = 0.04 * unit::mm;
  t.cut.spindle_speed = 875 * unit::rpm;
}

/// Down milling of an aluminium wall with a long cutter: both bend.
void add_thin_wall(CaseTables& t) {
  t.title = "Thin wall, 12 mm end mill";
  t.tool.teeth = 3;
  t.tool.diameter = 12 * unit::mm;
  t.tool.helix = {{45 * unit::deg}};
  t.cut.engagement = EngagementKind::down;
  t.cut.radial_depth = 1 * unit::mm;
  t.cut.axial_depth = 3 * unit::mm;
  t.cut.feed_per_tooth = 0.1 * unit::mm;
  t.cut.spindle_speed = 2000 * unit::rpm;
  CutterBody& body = t.machine.cutter_body.emplace();
  body.overhang = 83 * unit::mm;
  body.flute_length = 45 * unit::mm;
  body.youngs_modulus = 206 * unit::GPa;
  Wall& wall = t.machine.wall.emplace();
  wall.length = 60 * unit::mm;
  wall.height = 30 * unit::mm;
  wall.thickness = 4 * unit::mm;
  wall.youngs_modulus = 69 * unit::GPa;
  wall.poisson_ratio = 0.33;
  wall.position = wall.length / 2;
  t.machine.surface.emplace();
}

CaseTables identify_example() {
  CaseTables t;
  add_slot(t);
  t.dynamometer.emplace().axes = {"auto"};
  t.measurements.emplace_back().source.file.name = "record.csv";
  t.identify.emplace();
  return t;
}

CaseTables simulate_example() {
  CaseTables t;
  add_slot(t);
  t.runout.radial_offsets = {0.0, -0.008 * unit::mm};
  give(t.force, {.K_tc = 2620 * unit::MPa,
                 .K_rc = 1560 * unit::MPa,
                 .K_ac = 331 * unit::MPa,
                 .K_te = 7 * unit::N_per_mm,
                 .K_re = 3 * unit::N_per_mm,
                 .K_ae = 1 * unit::N_per_mm});
  return t;
}

CaseTables surface_example() {
  CaseTables t;
  add_thin_wall(t);
  t.runout.eccentricity = 0.003 * unit::mm;
  t.runout.angle = 71 * unit::deg;
  give(t.force,
       {.K_tc = 800 * unit::MPa, .K_rc = 300 * unit::MPa, .K_ac = 100 * unit::MPa});
  return t;
}

CaseTables calibrate_example() {
  CaseTables t;
  add_thin_wall(t);
  t.machine.surface->probe_diameter = 1 * unit::mm;
  SurfaceMeasurement& measurement = t.machine.surface_measurements.emplace_back();
  measurement.source.file.name = "wall.csv";
  measurement.datum_offset = true;
  return t;
}

/// The benchmark of the literature: one mode of 922 Hz along the feed.
CaseTables stability_example() {
  CaseTables t;
  t.title = "Slot with a slender tool";
  t.tool.teeth = 2;
  t.tool.diameter = 10 * unit::mm;
  t.cut.axial_depth = 0.5 * unit::mm;
  t.cut.feed_per_tooth = 0.05 * unit::mm;
  t.cut.spindle_speed = 10000 * unit::rpm;
  give(t.force, {.K_tc = 600 * unit::MPa, .K_rc = 200 * unit::MPa});
  Mode& mode = t.machine.modes.emplace_back();
  mode.mass = 0.03993;
  mode.frequency = 922.0;
  mode.damping_ratio = 0.011;
  Stability& lobes = t.machine.stability.emplace();
  lobes.spindle_speed = base::Steps{5000 * unit::rpm, 25000 * unit::rpm, 101};
  lobes.axial_depth = base::Steps{0.08 * unit::mm, 4 * unit::mm, 50};
  return t;
}

/// A slot with runout on a table whose actuator
/// follows a sine: what correction is about.
CaseTables dynamics_example() {
  CaseTables t;
  t.title = "Slot on a piezo table, 8 mm end mill";
  t.tool.teeth = 2;
  t.tool.diameter = 8 * unit::mm;
  t.runout.radial_offsets = {0.01 * unit::mm, -0.01 * unit::mm};
  t.cut.axial_depth = 1 * unit::mm;
  t.cut.feed_per_tooth = 0.05 * unit::mm;
  t.cut.spindle_speed = 1200 * unit::rpm;
  give(t.force, {.K_tc = 800 * unit::MPa,
                 .K_rc = 300 * unit::MPa,
                 .K_te = 5 * unit::N_per_mm,
                 .K_re = 3 * unit::N_per_mm});
  t.sampling.revolutions = 20;
  for (const Axis axis : {Axis::x, Axis::y}) {
    Mode& tool = t.machine.modes.emplace_back();
    tool.axis = axis;
    tool.stiffness = 2e7;
    tool.frequency = 2500.0;
    tool.damping_ratio = 0.03;
  }
  Mode& table = t.machine.modes.emplace_back();
  table.body = ModeBody::table;
  table.mass = 0.194;
  table.stiffness = 1.7e7;
  table.damping = 77.3;
  Actuator& actuator = t.machine.actuator.emplace();
  actuator.frequency = 140.0;
  actuator.damping_ratio = 1.0;
  ImposedCommand& command = t.machine.command.emplace();
  command.peak_to_peak = 20 * unit::um;
  command.lead = 0.0022;
  return t;
}

/// The same table, to be moved so that the flutes cut alike.
CaseTables correct_example() {
  CaseTables t = dynamics_example();
  t.title = "Runout taken away by a piezo table, 8 mm end mill";
  t.chip.model = chip::Model::radial;
  t.machine.command.reset();
  t.machine.actuator->stroke = {0.0, 60 * unit::um};
  t.machine.correct.emplace().options.strategy = correction::Method::lead;
  t.machine.controller.emplace();
  return t;
}

CaseTables modes_example() {
  CaseTables t;
  t.title = "Tip of the tool, along x";
  t.machine.frf.emplace().source.file.name = "tip_x.csv";
  return t;
}

CaseTables actuator_example() {
  CaseTables t;
  t.title = "Step of the actuator";
  t.machine.step.emplace().source.file.name = "step.csv";
  return t;
}

/// One slot was measured; or, without a record, coefficients that are about right.
CaseTables plan_example() {
  CaseTables t = identify_example();
  t.title = "Which cut to measure next, 8 mm end mill";
  t.dynamometer.reset();
  Plan& plan = t.plan.emplace();
  plan.of = PlanOf::forces;
  plan.settled = true;
  return t;
}

/// A slot along a program of its own: the moves stand in `part.nc` beside the case.
CaseTables program_example() {
  CaseTables t = simulate_example();
  t.title = "Forces along part.nc, 8 mm end mill";
  NcProgram& program = t.nc.program.emplace();
  program.file.name = "part.nc";
  program.tool_number.text = "1";
  t.nc.stock.emplace().box = {{0.0, 0.0, -20 * unit::mm},
                              {80 * unit::mm, 60 * unit::mm, 0.0}};
  return t;
}

/// What a new case of a command shows.
struct Template {
  CaseTables tables;
  std::vector<std::string_view> shown;
};

Template template_for(Command command) {
  switch (command) {
    case Command::identify:
      return {
          identify_example(),
          {"tool", "cut", "chip", "force", "dynamometer", "measurement", "identify"}};
    case Command::surface:
      return {
          surface_example(),
          {"tool", "runout", "cut", "chip", "force", "cutter_body", "wall", "surface"}};
    case Command::calibrate:
      return {calibrate_example(),
              {"tool", "cut", "chip", "cutter_body", "wall", "surface",
               "surface_measurement"}};
    case Command::stability:
      return {stability_example(),
              {"tool", "runout", "cut", "chip", "force", "mode", "stability"}};
    case Command::dynamics:
      return {dynamics_example(),
              {"tool", "runout", "cut", "chip", "force", "sampling", "mode", "actuator",
               "command"}};
    case Command::correct:
      return {correct_example(),
              {"tool", "runout", "cut", "chip", "force", "sampling", "mode", "actuator",
               "correct", "controller"}};
    case Command::plan:
      return {plan_example(),
              {"tool", "cut", "chip", "force", "measurement", "identify", "plan"}};
    case Command::modes:
      return {modes_example(), {"frf"}};
    case Command::actuator:
      return {actuator_example(), {"step"}};
    case Command::program:
      return {program_example(),
              {"tool", "runout", "chip", "force", "program", "stock"}};
    case Command::simulate:
      break;
  }
  return {simulate_example(), {"tool", "runout", "cut", "chip", "force", "sampling"}};
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

/// What may stand behind a key that is left out: TOML in any case.
std::string_view example_of(const Key& key) {
  return key.example.empty() ? "0" : key.example;
}

/// A kind of cutter by its name, where no file has this name.
const UsualTool* usual_tool(const ToolChoice& choice) {
  const auto all = usual_tools();
  const auto found = std::ranges::find(all, choice.file.string(), &UsualTool::name);
  const bool usual = found != all.end() && !std::filesystem::exists(choice.file);
  return usual ? &*found : nullptr;
}

/// A tool of a file in place of the example's, or a kind of cutter.
/// @return where it is from and what is not, as comments
std::string put_tool(const ToolChoice& choice, CaseTables& t) {
  if (const UsualTool* const usual = usual_tool(choice)) {
    usual->put(t);
    t.title = std::string(usual->meaning);
    return fmt::format(
        "# The tool is {}. Its numbers are usual ones:\n"
        "# put in the numbers of your tool.\n",
        usual->meaning);
  }
  const FoundTool found = read_tool(choice);
  const std::vector<std::string> stay = take_tool(found, t.tool);
  if (!found.name.empty()) t.title = found.name;
  if (t.cut.radial_depth) {
    t.cut.radial_depth = std::min(*t.cut.radial_depth, t.tool.diameter);
  }
  if (!t.runout.radial_offsets.empty()) {
    t.runout.radial_offsets.resize(static_cast<std::size_t>(t.tool.teeth));
  }
  return fmt::format(
      "# The tool is from {}{}. That file does not give these\n"
      "# keys, so check them: {}\n",
      base::one_line(choice.file.filename().string()),
      found.name.empty() ? "" : fmt::format(" ({})", base::one_line(found.name)),
      fmt::join(stay, ", "));
}

constexpr std::string_view second_record =
    "\n# [[measurement]]                 # a second "
    "record of the same tool and material,\n"
    "# file = \"record2.csv\"            # best at another feed: fitted together\n"
    "# cut = { feed_per_tooth_mm = 0.08 } # what is different from [cut]\n";

bool shows(const Template& fresh, std::string_view table) {
  return std::ranges::find(fresh.shown, table) != fresh.shown.end();
}

/// The [force] of a file, which the case includes, in place of the example's.
/// @return the name by which the case finds the file
std::string put_material(Command command, const NewCaseOptions& options,
                         Template& fresh) {
  const bool found = command == Command::identify || command == Command::plan;
  if (found || !shows(fresh, "force")) {
    throw base::InputError(
        {fmt::format("--material: {} takes no coefficients", name_of(command))});
  }
  if (find(load_document(options.material), "force") == nullptr) {
    throw base::InputError({fmt::format("{}: it has no [force] to be included",
                                        options.material.string())});
  }
  std::erase(fresh.shown, "force");
  const auto here = std::filesystem::current_path();
  const auto from = (here / options.folder).lexically_normal();
  const auto file = (here / options.material).lexically_normal();
  const auto name = file.lexically_relative(from);
  return (name.empty() ? file : name).generic_string();
}

}  // namespace

std::string new_case(Command command, const NewCaseOptions& options) {
  Template fresh = template_for(command);
  const std::optional<ToolChoice>& tool = options.tool;
  if (tool && !shows(fresh, "tool")) {
    throw base::InputError({fmt::format("--tool: {} has no tool", name_of(command))});
  }
  const std::string material =
      options.material.empty() ? "" : put_material(command, options, fresh);
  const std::string about = tool ? put_tool(*tool, fresh.tables) : "";
  std::string text = fmt::format(
      "# A case for `trochoid {}`: write your own numbers in place of these. Keys end\n"
      "# in their unit. A key behind a # may be left out. Keys and lists here replace those\n"
      "# of a file in `include`. All keys, with ranges: docs/formats/case.md\n{}\n",
      name_of(command), about);
  const auto line = [&text](std::string_view left, std::string_view right) {
    text += fmt::format("{:<33} # {}\n", left, right);
  };
  const Visitor key_line = [&](const Key& key, const Field& field) {
    // What is different in a run is nothing yet.
    const auto value = std::holds_alternative<CutTable*>(field)
                           ? std::nullopt
                           : value_text(key, field);
    const bool found = command == Command::identify || command == Command::plan;
    if (found && (key.need == Need::coefficient || key.need == Need::cutting)) {
      return;  // this is what will be found
    }
    line(value ? fmt::format("{} = {}", key.name, *value)
               : fmt::format("# {} = {}", key.name, example_of(key)),
         comment(key, field, value.has_value()));
    if (key.name == "axes" && value && *value == toml_string(key.word)) {
      line(fmt::format("# axes = {}", key.example),
           "a table dynamometer along the axes of the machine: it feels the reaction");
    }
  };
  const Visitor given_line = [&](const Key& key, const Field& field) {
    if (value_text(key, field)) {
      key_line(key, field);
    }
  };
  if (!material.empty()) {
    line(fmt::format("include = {}", toml_string(material)),
         "the [force] of a material");
  }
  describe(key_line, fresh.tables);
  const auto& shown = fresh.shown;
  for (const TableEntry& table : tables_of(fresh.tables)) {
    if (std::find(shown.begin(), shown.end(), table.name) != shown.end()) {
      text += '\n';
      line(heading(table), table.meaning);
      table.describe(0, key_line);
      for (std::size_t i = 1; i < table.count(); ++i) {
        text += '\n';
        line(heading(table), "another one");
        table.describe(i, given_line);
      }
      text += table.name == "measurement" ? second_record : "";
    }
  }
  return text;
}

}  // namespace trochoid::cases
