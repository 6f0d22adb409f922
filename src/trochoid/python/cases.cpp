#include <trochoid/base/names.h>
#include <trochoid/base/units.h>
#include <trochoid/cases/inches.h>
#include <trochoid/python/bindings.h>
#include <trochoid/python/document.h>
#include <trochoid/python/state.h>

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace py = pybind11;

namespace trochoid::python {

namespace {

namespace fs = std::filesystem;

void remove(cases::Node& table, const std::vector<std::string>& path,
            std::size_t depth) {
  auto* members = std::get_if<cases::Members>(&table.value);
  if (members == nullptr) return;
  if (depth + 1 == path.size()) {
    const std::string key = cases::path_in_mm(path[depth]);
    std::erase_if(*members, [&](const auto& m) { return m.key == key; });
    return;
  }
  for (cases::Member& member : *members) {
    if (member.key == path[depth]) remove(member.node, path, depth + 1);
  }
}

void bind_document(py::module_& m) {
  py::class_<Document>(m, "Document")
      .def_static("from_file",
                  [](const fs::path& file) {
                    return Document{cases::load_document(file), file, {}};
                  })
      .def_static("from_dict",
                  [](const py::dict& tables, const fs::path& folder) {
                    const fs::path file = folder / "case";
                    return Document{
                        cases::with_includes(node_of(tables, file), file), file, {}};
                  })
      .def("with_tables",
           [](const Document& self, const py::dict& tables) {
             Document changed = self;
             const cases::Location root = self.root.where;
             changed.root = cases::merged(
                 self.root,
                 cases::with_includes(node_of(tables, self.file), self.file));
             changed.root.where = root;
             return changed;
           })
      .def("without",
           [](const Document& self, const std::vector<std::string>& path) {
             Document changed = self;
             remove(changed.root, path, 0);
             return changed;
           })
      .def("with_record",
           [](const Document& self, const std::string& name,
              const std::vector<GivenColumn>& columns) {
             Document changed = self;
             changed.data.records[name] = record_in_memory(columns);
             return changed;
           })
      .def("with_text",
           [](const Document& self, const std::string& name, std::string text) {
             Document changed = self;
             changed.data.texts[name] =
                 std::make_shared<const std::string>(std::move(text));
             return changed;
           })
      .def(py::pickle(
          [](const Document& self) {
            return py::make_tuple(state_of(self.root), self.file.string(),
                                  state_of(self.data));
          },
          [](const py::tuple& state) {
            return Document{node_of_state(state[0]),
                            fs::path(state[1].cast<std::string>()),
                            data_of_state(state[2])};
          }))
      .def("check_keys", [](const Document& self) { cases::check_keys(self.source()); })
      .def("to_dict", [](const Document& self) { return object_of(self.root); });
}

/// [frf] or [step] of a bare data file, in the units of the program's options.
struct BareOptions {
  std::string kind;
  int modes = 0;
  int dataset = 0;
  std::vector<double> band;
  std::optional<double> step_um;
  std::optional<double> start_s;
};

cases::Case bare_case(const std::string& file, base::Command command,
                      const BareOptions& options, const fs::path& folder) {
  cases::MachineTables machine;
  if (command == base::Command::modes) {
    machine.frf = cases::FrfTables{
        .source = {.file = files::file_at(file),
                   .kind = base::named<structure::ResponseKind>(options.kind),
                   .dataset = options.dataset},
        .modes = options.modes,
        .band = options.band};
  } else {
    machine.step = cases::StepTables{
        .source = {.file = files::file_at(file), .start = options.start_s}};
    if (options.step_um) machine.step->source.step = *options.step_um * unit::um;
  }
  return cases::bare_case(machine, command, folder);
}

}  // namespace

void bind_inputs(py::module_& m) {
  bind_document(m);
  py::class_<cases::Case, std::shared_ptr<cases::Case>>(m, "CheckedCase")
      .def_readonly("as_understood", &cases::Case::as_understood)
      .def_property_readonly("notes",
                             [](const cases::Case& self) {
                               py::list notes;
                               for (const base::Warning& note : self.notes) {
                                 notes.append(py::make_tuple(note.code, note.message));
                               }
                               return notes;
                             })
      .def_property_readonly("teeth", [](const cases::Case& self) {
        return self.setup.cutter.pitch.size();
      });
  m.def("read_case", [](const Document& document,
                        const std::optional<std::string>& command,
                        const fs::path& folder) {
    const auto wanted = command ? base::named<base::Command>(*command) : std::nullopt;
    return cases::read_case(document.source(), wanted, folder);
  });
  py::class_<BareOptions>(m, "BareOptions")
      .def(py::init())
      .def_readwrite("kind", &BareOptions::kind)
      .def_readwrite("modes", &BareOptions::modes)
      .def_readwrite("dataset", &BareOptions::dataset)
      .def_readwrite("band", &BareOptions::band)
      .def_readwrite("step_um", &BareOptions::step_um)
      .def_readwrite("start_s", &BareOptions::start_s);
  m.def("bare_case", [](const std::string& file, const std::string& command,
                        const BareOptions& options, const fs::path& folder) {
    return bare_case(file, *base::named<base::Command>(command), options, folder);
  });
  m.def("new_case", [](const std::string& command) {
    const auto wanted = base::named<base::Command>(command);
    if (!wanted) throw py::value_error("there is no such command: " + command);
    return cases::new_case(*wanted);
  });
}

}  // namespace trochoid::python
