#pragma once

namespace pybind11 {
class module_;
}

/// The Python module: one file a room that it shows. What is here translates; what a
/// person calls, with its documentation, stands in trochoid/*.py.
namespace trochoid::python {

void bind_inputs(pybind11::module_& module);
void bind_results(pybind11::module_& module);
void bind_sweep(pybind11::module_& module);
void bind_run(pybind11::module_& module);
void bind_force(pybind11::module_& module);
void bind_dynamics(pybind11::module_& module);

}  // namespace trochoid::python
