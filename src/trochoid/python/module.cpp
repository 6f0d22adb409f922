#include <trochoid/base/command.h>
#include <trochoid/base/error.h>
#include <trochoid/base/names.h>
#include <trochoid/numerics/thread_count.h>
#include <trochoid/python/bindings.h>
#include <trochoid/results/provenance.h>

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <exception>
#include <memory>
#include <string>
#include <string_view>

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

/// As long as the module is loaded.
void limit_threads(py::module_& m) {
  using trochoid::numerics::ThreadLimit;
  if (auto limit = trochoid::numerics::thread_limit_of_environment()) {
    m.attr("_threads") = py::capsule(
        limit.release(), [](void* held) { delete static_cast<ThreadLimit*>(held); });
  }
}

}  // namespace

PYBIND11_MODULE(_core, m) {
  m.doc() = "What trochoid's Python files call; use those.";
  py::register_exception_translator(&translate);
  m.attr("version") = std::string(trochoid::results::version());
  m.attr("build") = std::string(trochoid::results::version()) + " " +
                    std::string(trochoid::results::commit());
  py::list commands;
  for (const std::string_view name : trochoid::base::names<trochoid::base::Command>) {
    commands.append(std::string(name));
  }
  m.attr("commands") = py::tuple(commands);
  limit_threads(m);
  trochoid::python::bind_inputs(m);
  trochoid::python::bind_results(m);
  trochoid::python::bind_run(m);
  trochoid::python::bind_sweep(m);
  trochoid::python::bind_force(m);
  trochoid::python::bind_dynamics(m);
}
