#include <trochoid/base/overloaded.h>
#include <trochoid/python/bindings.h>
#include <trochoid/report/report.h>
#include <trochoid/results/answer.h>
#include <trochoid/results/folder.h>

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <unordered_map>
#include <utility>

namespace py = pybind11;

namespace trochoid::python {

namespace {

using results::Answer;

/// The same value that summary.json would show: what is not finite is None.
py::object answer_object(const results::Value& value) {
  return std::visit(
      base::Overloaded{[](std::nullptr_t) -> py::object { return py::none(); },
                       [](double number) -> py::object {
                         return std::isfinite(number) ? py::object(py::float_(number))
                                                      : py::none();
                       },
                       [](const results::Array& entries) -> py::object {
                         py::list list;
                         for (const results::Value& entry : entries)
                           list.append(answer_object(entry));
                         return list;
                       },
                       [](const results::Object& members) -> py::object {
                         py::dict dict;
                         for (const results::Member& member : members) {
                           dict[py::str(member.key)] = answer_object(member.value);
                         }
                         return dict;
                       },
                       [](const auto& other) -> py::object { return py::cast(other); }},
      value.data);
}

/// A column of texts; like ones are one object.
py::object texts_of(const base::Texts& texts) {
  std::unordered_map<const std::string*, py::str> objects;
  for (const std::string& word : texts.words()) objects.emplace(&word, word);
  py::list list(texts.size());
  for (std::size_t i = 0; i < texts.size(); ++i) list[i] = objects.at(&texts[i]);
  return py::module_::import("numpy").attr("array")(list, py::arg("dtype") = "O");
}

/// A column as an array that looks into the answer, which it keeps.
py::object array_of(const base::Table::Column& column, const py::object& owner) {
  if (!column.texts.empty()) {
    py::object texts = texts_of(column.texts);
    texts.attr("flags").attr("writeable") = false;
    return texts;
  }
  py::array_t<double> array(static_cast<py::ssize_t>(column.values.size()),
                            column.values.data(), owner);
  array.attr("flags").attr("writeable") = false;
  return array;
}

py::dict tables_of(const py::object& self) {
  py::dict tables;
  for (const base::Table& table : py::cast<const Answer&>(self).tables) {
    py::dict columns;
    for (const base::Table::Column& column : table.columns) {
      columns[py::str(column.name)] = array_of(column, self);
    }
    const std::filesystem::path file(table.file);
    tables[py::str(file.stem().string())] = columns;
  }
  return tables;
}

/// @param case_toml  the case with names of files as they count from that folder
void write(const Answer& answer, const std::filesystem::path& folder,
           const std::string& case_toml, bool with_report) {
  std::optional<std::string> failure;
  {
    const py::gil_scoped_release release;
    Answer placed = answer;
    placed.heading.case_toml = case_toml;
    try {
      const std::string page =
          with_report ? report::html(placed, results::summary_json(placed)) : "";
      results::write_folder(folder, placed, page);
    } catch (const std::runtime_error& error) {  // the place is wrong
      failure = error.what();
    }
  }
  if (failure) {
    PyErr_SetString(PyExc_OSError, failure->c_str());
    throw py::error_already_set();
  }
}

}  // namespace

void bind_results(py::module_& m) {
  py::class_<Answer, std::shared_ptr<Answer>>(m, "Answer")
      .def_readonly("command", &Answer::command)
      .def_readonly("short_table", &Answer::short_table)
      .def_property_readonly("ok", [](const Answer& a) { return a.heading.ok; })
      .def_property_readonly("title", [](const Answer& a) { return a.heading.title; })
      .def_property_readonly("message",
                             [](const Answer& a) { return a.heading.message; })
      .def_property_readonly("case_toml",
                             [](const Answer& a) { return a.heading.case_toml; })
      .def_property_readonly(
          "warnings",
          [](const Answer& a) {
            py::list all;
            for (const base::Warning& warning : a.heading.warnings) {
              all.append(py::make_tuple(warning.code, warning.message));
            }
            return all;
          })
      .def_property_readonly("texts",
                             [](const Answer& a) {
                               py::dict all;
                               for (const auto& [file, text, named] : a.texts) {
                                 all[py::str(file)] = file.ends_with(".h5")
                                                          ? py::object(py::bytes(text))
                                                          : py::object(py::str(text));
                               }
                               return all;
                             })
      .def("result",
           [](const Answer& a) {
             const bool none = std::holds_alternative<std::nullptr_t>(a.result.data);
             return none ? py::dict() : answer_object(a.result);
           })
      .def("tables", [](const py::object& self) { return tables_of(self); })
      .def("report_html",
           [](const Answer& a) {
             const py::gil_scoped_release release;
             return report::html(a, results::summary_json(a));
           })
      .def("write", &write);
}

}  // namespace trochoid::python
