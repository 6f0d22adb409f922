#include <trochoid/python/state.h>

#include <trochoid/base/overloaded.h>

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <cstdint>
#include <utility>

namespace py = pybind11;

namespace trochoid::python {

namespace {

/// A date is bytes, so that it is no text.
py::object state_of_value(const cases::Node& node) {
  return std::visit(
      base::Overloaded{[](const cases::DateOrTime& date) -> py::object {
                         return py::bytes(date.text);
                       },
                       [](const cases::Array& entries) -> py::object {
                         py::list list;
                         for (const cases::Node& entry : entries)
                           list.append(state_of(entry));
                         return list;
                       },
                       [](const cases::Members& members) -> py::object {
                         py::list list;
                         for (const cases::Member& member : members) {
                           list.append(py::make_tuple(member.key,
                                                      state_of(member.where),
                                                      state_of(member.node)));
                         }
                         return py::tuple(list);
                       },
                       [](const auto& value) -> py::object { return py::cast(value); }},
      node.value);
}

cases::Members members_of_state(const py::handle& state) {
  cases::Members members;
  for (const py::handle one : state) {
    const auto parts = one.cast<py::tuple>();
    members.push_back({parts[0].cast<std::string>(), location_of_state(parts[1]),
                       node_of_state(parts[2])});
  }
  return members;
}

}  // namespace

std::shared_ptr<const files::NumericTable> record_in_memory(
    const std::vector<GivenColumn>& columns) {
  auto table = std::make_shared<files::NumericTable>();
  std::vector<std::vector<double>> values;
  for (const auto& [name, unit, samples] : columns) {
    const double* begin = samples.data();
    values.emplace_back(begin, begin + samples.size());
    table->columns.push_back(
        {.name = name, .path = name, .unit = unit, .count = values.back().size()});
  }
  table->values = [values = std::move(values)](std::size_t i) { return values[i]; };
  return table;
}

py::tuple state_of(const cases::Location& where) {
  return py::make_tuple(py::bytes(where.file), where.line, where.column);
}

cases::Location location_of_state(const py::handle& state) {
  const auto parts = state.cast<py::tuple>();
  return {parts[0].cast<std::string>(), parts[1].cast<int>(), parts[2].cast<int>()};
}

py::tuple state_of(const cases::Node& node) {
  return py::make_tuple(state_of_value(node), state_of(node.where), node.inherited);
}

cases::Node node_of_state(const py::handle& state) {
  const auto parts = state.cast<py::tuple>();
  const py::object value = parts[0];
  cases::Node node{{}, location_of_state(parts[1]), parts[2].cast<bool>()};
  if (py::isinstance<py::bytes>(value)) {
    node.value = cases::DateOrTime{value.cast<std::string>()};
  } else if (py::isinstance<py::bool_>(value)) {
    node.value = value.cast<bool>();
  } else if (py::isinstance<py::int_>(value)) {
    node.value = value.cast<std::int64_t>();
  } else if (py::isinstance<py::float_>(value)) {
    node.value = value.cast<double>();
  } else if (py::isinstance<py::str>(value)) {
    node.value = value.cast<std::string>();
  } else if (py::isinstance<py::tuple>(value)) {
    node.value = members_of_state(value);
  } else {
    cases::Array entries;
    for (const py::handle entry : value) entries.push_back(node_of_state(entry));
    node.value = std::move(entries);
  }
  return node;
}

py::tuple state_of(const cases::DataInMemory& data) {
  py::dict records;
  for (const auto& [name, table] : data.records) {
    py::list columns;
    for (std::size_t i = 0; i < table->columns.size(); ++i) {
      const std::vector<double> samples = table->values(i);
      columns.append(
          py::make_tuple(table->columns[i].name, table->columns[i].unit,
                         py::array_t<double>(static_cast<py::ssize_t>(samples.size()),
                                             samples.data())));
    }
    records[py::str(name)] = columns;
  }
  py::dict texts;
  for (const auto& [name, text] : data.texts) texts[py::str(name)] = py::str(*text);
  return py::make_tuple(records, texts);
}

cases::DataInMemory data_of_state(const py::handle& state) {
  const auto parts = state.cast<py::tuple>();
  cases::DataInMemory data;
  for (const auto& [name, columns] : parts[0].cast<py::dict>()) {
    data.records[name.cast<std::string>()] =
        record_in_memory(columns.cast<std::vector<GivenColumn>>());
  }
  for (const auto& [name, text] : parts[1].cast<py::dict>()) {
    data.texts[name.cast<std::string>()] =
        std::make_shared<const std::string>(text.cast<std::string>());
  }
  return data;
}

}  // namespace trochoid::python
