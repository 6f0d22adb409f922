#include <trochoid/python/document.h>

#include <trochoid/base/overloaded.h>
#include <trochoid/cases/inches.h>

#include <pybind11/pybind11.h>

#include <fmt/core.h>

#include <string>
#include <utility>

namespace py = pybind11;

namespace trochoid::python {

namespace {

/// More would be a table that holds itself.
constexpr int deepest = 32;

/// What is being read, for messages and for files that it names.
struct Place {
  std::string key;  ///< path from the top: `tool.teeth`
  cases::Location where;
  int depth = 0;

  [[nodiscard]] Place of(const std::string& inner) const {
    return {key.empty() ? inner : key + "." + inner, where, depth + 1};
  }
  [[nodiscard]] Place of(std::size_t index) const {
    return {fmt::format("{}[{}]", key, index + 1), where, depth + 1};
  }
};

cases::Node converted(const py::handle& from, const Place& place);

[[noreturn]] void refuse(const Place& place, const std::string& why) {
  throw py::type_error(place.key.empty() ? why : place.key + ": " + why);
}

std::string type_name(const py::handle& value) {
  return py::str(py::type::of(value).attr("__name__"));
}

/// @throws UnicodeEncodeError for what is no text of any file: half of a surrogate pair
std::string text_of(const py::handle& value) {
  py::ssize_t size = 0;
  const char* text = PyUnicode_AsUTF8AndSize(value.ptr(), &size);
  if (text == nullptr) throw py::error_already_set();
  return {text, static_cast<std::size_t>(size)};
}

cases::Members members_of(const py::handle& mapping, const Place& place) {
  cases::Members members;
  for (const py::handle entry : mapping.attr("items")()) {
    const auto pair = py::reinterpret_borrow<py::tuple>(entry);
    const py::object key = pair[0];
    const py::object value = pair[1];
    if (!py::isinstance<py::str>(key)) {
      refuse(place, fmt::format("keys must be text, not {}", type_name(key)));
    }
    if (value.is_none()) continue;
    const std::string name = text_of(key);
    members.push_back({name, place.where, converted(value, place.of(name))});
  }
  return members;
}

cases::Array array_of(const py::handle& sequence, const Place& place) {
  cases::Array entries;
  for (const py::handle entry : sequence) {
    entries.push_back(converted(entry, place.of(entries.size())));
  }
  return entries;
}

std::int64_t whole_of(const py::handle& value, const Place& place) {
  int overflow = 0;
  const long long whole = PyLong_AsLongLongAndOverflow(value.ptr(), &overflow);
  if (overflow != 0) refuse(place, "the number has too many digits");
  return whole;
}

cases::Node converted(const py::handle& from, const Place& place) {
  if (place.depth > deepest) refuse(place, "nested too deep; no case needs that");
  cases::Node node{{}, place.where};
  if (py::isinstance<py::bool_>(from)) {
    node.value = py::cast<bool>(from);
  } else if (py::isinstance<py::int_>(from)) {
    node.value = whole_of(from, place);
  } else if (py::isinstance<py::float_>(from)) {
    node.value = py::cast<double>(from);
  } else if (py::isinstance<py::str>(from)) {
    node.value = text_of(from);
  } else if (py::hasattr(from, "__fspath__")) {
    node.value = text_of(py::str(from.attr("__fspath__")()));
  } else if (py::hasattr(from, "items") && py::hasattr(from, "keys")) {
    node.value = members_of(from, place);
  } else if (py::isinstance<py::list>(from) || py::isinstance<py::tuple>(from)) {
    node.value = array_of(from, place);
  } else if (py::hasattr(from, "tolist")) {  // of numpy: an array, or a single number
    return converted(from.attr("tolist")(), place.of(""));
  } else {
    refuse(place, fmt::format("{} is no value of a case; must be a number, text, true "
                              "or false, a list, or a dict",
                              type_name(from)));
  }
  return node;
}

}  // namespace

cases::Node node_of(const py::dict& tables, const std::filesystem::path& file) {
  cases::Node node = converted(tables, {.key = "", .where = {file.string(), 0, 0}});
  cases::take_inches(node);
  return node;
}

py::object object_of(const cases::Node& node) {
  return std::visit(
      base::Overloaded{[](const cases::DateOrTime& date) -> py::object {
                         return py::str(date.text);
                       },
                       [](const cases::Array& entries) -> py::object {
                         py::list list;
                         for (const cases::Node& entry : entries)
                           list.append(object_of(entry));
                         return list;
                       },
                       [](const cases::Members& members) -> py::object {
                         py::dict table;
                         for (const cases::Member& member : members) {
                           table[py::str(member.key)] = object_of(member.node);
                         }
                         return table;
                       },
                       [](const auto& value) -> py::object { return py::cast(value); }},
      node.value);
}

}  // namespace trochoid::python
