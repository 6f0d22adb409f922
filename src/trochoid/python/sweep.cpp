#include <trochoid/base/names.h>
#include <trochoid/numerics/parallel.h>
#include <trochoid/python/bindings.h>
#include <trochoid/python/document.h>
#include <trochoid/python/state.h>
#include <trochoid/results/folder.h>
#include <trochoid/sweep/parts.h>
#include <trochoid/sweep/work.h>

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <chrono>
#include <filesystem>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace py = pybind11;

namespace trochoid::python {

namespace {

namespace fs = std::filesystem;
using cases::Node;
using sweep::Study;
using sweep::Work;

/// Signals are looked for between parts.
constexpr std::chrono::duration<double> part_time{0.25};

py::tuple state_of_study(const Study& study) {
  py::list over;
  for (const cases::SweptKey& key : study.over) {
    over.append(py::make_tuple(key.key, state_of(key.where)));
  }
  return py::make_tuple(std::string(name_of(study.command)), state_of(study.root),
                        study.file.string(), over, study.take, state_of(study.data),
                        study.base.string());
}

Study study_of_state(const py::tuple& state) {
  Study study{.command = *base::named<base::Command>(state[0].cast<std::string>()),
              .root = node_of_state(state[1]),
              .file = state[2].cast<std::string>(),
              .over = {},
              .take = state[4].cast<std::vector<std::string>>(),
              .data = data_of_state(state[5]),
              .base = state[6].cast<std::string>()};
  for (const py::handle one : state[3]) {
    const auto key = one.cast<py::tuple>();
    study.over.push_back({.key = key[0].cast<std::string>(),
                          .where = location_of_state(key[1]),
                          .values = {}});
  }
  return study;
}

void check_place(const fs::path& folder) {
  try {
    results::check_place(folder);
  } catch (const std::runtime_error& error) {
    PyErr_SetString(PyExc_OSError, error.what());
    throw py::error_already_set();
  }
}

/// @param folder  where the result will be; empty: nowhere yet
std::unique_ptr<Work> begun(const Document& document, sweep::Request request) {
  if (!request.folder.empty()) {
    check_place(request.folder);
    if (request.part_file.empty()) {
      request.part_file = sweep::part_file_of(request.folder);
    }
  }
  const py::gil_scoped_release release;
  cases::CaseSource source = document.source();
  source.base = fs::current_path();
  return std::make_unique<Work>(source, request, run::Progress());
}

/// Answers what is left; between parts Python is told, and asked whether to go on.
void go_on(Work& work, const py::object& progress) {
  const auto tell = [&](const run::Step&) {
    const py::gil_scoped_acquire acquire;
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    if (!progress.is_none()) progress(work.done(), work.rows());
  };
  {
    const py::gil_scoped_release release;
    work.go_on(tell, {}, part_time);
  }
  tell("done");
}

/// The values of some rows, a tuple each.
py::list rows_of(const Work& work, std::size_t first, std::size_t count) {
  py::list rows;
  for (std::size_t i = first; i < first + count; ++i) {
    py::list values;
    for (const Node& value : work.prepared().rows.row(i)) {
      values.append(object_of(value));
    }
    rows.append(py::tuple(values));
  }
  return rows;
}

Node node_of_value(const py::handle& value) {
  if (py::isinstance<py::bool_>(value))
    return {.value = value.cast<bool>(), .where = {}};
  if (py::isinstance<py::int_>(value)) {
    return {.value = value.cast<std::int64_t>(), .where = {}};
  }
  if (py::isinstance<py::float_>(value)) {
    return {.value = value.cast<double>(), .where = {}};
  }
  return {.value = value.cast<std::string>(), .where = {}};
}

/// Rows of these values as text, answered on this thread alone: whoever asks has
/// threads or processes of its own.
py::bytes rows(const Study& study, std::size_t first, const py::list& values) {
  std::vector<std::vector<Node>> given;
  for (const py::handle row : values) {
    auto& nodes = given.emplace_back();
    for (const py::handle value : row) nodes.push_back(node_of_value(value));
  }
  std::string text;
  {
    const py::gil_scoped_release release;
    numerics::on_one_thread([&] {
      text = sweep::part_text(
          first,
          sweep::rows(study, given.size(), [&](std::size_t i) { return given[i]; }));
    });
  }
  return py::bytes(text);
}

/// @throws std::invalid_argument where the text is not that of the next rows
void add(Work& work, std::size_t count, const std::string& text) {
  const Study& study = work.prepared().study;
  std::istringstream in(text);
  auto part = sweep::read_part(in, work.done(), study.over.size() + study.take.size());
  if (!part || part->size() != count) {
    throw std::invalid_argument("a part of the sweep did not come whole");
  }
  work.add(*part);
}

}  // namespace

void bind_sweep(py::module_& m) {
  py::class_<Study>(m, "Study").def(py::pickle(&state_of_study, &study_of_state));
  py::class_<Work>(m, "SweepWork")
      .def(py::init([](const Document& document, const std::string& command,
                       const std::vector<std::string>& take, const fs::path& part_file,
                       const fs::path& folder) {
             return begun(document, {.command = command,
                                     .take = take,
                                     .part_file = part_file,
                                     .folder = folder});
           }),
           py::arg("document"), py::arg("command"), py::arg("take"),
           py::arg("part_file"), py::arg("folder"))
      .def_property_readonly("rows", &Work::rows)
      .def_property_readonly("done", &Work::done)
      .def_property_readonly("part_file",
                             [](const Work& work) { return work.part_file().string(); })
      .def_property_readonly("study",
                             [](const Work& work) { return work.prepared().study; })
      .def("values", &rows_of)
      .def("add", &add)
      .def("go_on", &go_on)
      .def("case_toml",
           [](const Work& work, const fs::path& folder) {
             return sweep::case_toml(work.prepared(), folder);
           })
      .def("take_answer", [](Work& work) {
        const py::gil_scoped_release release;
        return std::make_shared<results::Answer>(
            results::answer_of(work.take_result()));
      });
  m.def("rows", &rows);
}

}  // namespace trochoid::python
