#include <trochoid/base/error.h>
#include <trochoid/python/bindings.h>
#include <trochoid/results/provenance.h>

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <exception>
#include <string>

namespace py = pybind11;

namespace {

/// The one place where errors of ours become those of Python: the input is wrong. What
/// else there is pybind11 knows: std::invalid_argument is ValueError, std::bad_alloc is
/// MemoryError.
void translate(std::exception_ptr thrown) {
  try {
    if (thrown) std::rethrow_exception(thrown);
  } catch (const trochoid::base::InputError& error) {
    const py::object type = py::module_::import("trochoid._errors").attr("InputError");
    const py::object raised = type(py::cast(error.problems()), error.what());
    PyErr_SetObject(type.ptr(), raised.ptr());
  }
}

}  // namespace

PYBIND11_MODULE(_core, m) {
  m.doc() = "What trochoid's Python files call; use those.";
  py::register_exception_translator(&translate);
  m.attr("version") = std::string(trochoid::results::version());
  trochoid::python::bind_inputs(m);
  trochoid::python::bind_results(m);
  trochoid::python::bind_run(m);
  trochoid::python::bind_force(m);
  trochoid::python::bind_dynamics(m);
}
