#pragma once

#include <trochoid/cases/case_source.h>

#include <pybind11/numpy.h>

#include <memory>
#include <string>
#include <tuple>
#include <vector>

/// Cases as plain Python values, to be pickled: places in files and data in memory
/// travel with them.
namespace trochoid::python {

/// A column of a record in memory: its name, unit and samples.
using GivenColumn = std::tuple<std::string, std::string,
                               pybind11::array_t<double, pybind11::array::c_style>>;

/// The samples are copied: what a case holds does not change.
std::shared_ptr<const files::NumericTable> record_in_memory(
    const std::vector<GivenColumn>& columns);

pybind11::tuple state_of(const cases::Location& where);
cases::Location location_of_state(const pybind11::handle& state);

pybind11::tuple state_of(const cases::Node& node);
cases::Node node_of_state(const pybind11::handle& state);

pybind11::tuple state_of(const cases::DataInMemory& data);
cases::DataInMemory data_of_state(const pybind11::handle& state);

}  // namespace trochoid::python
