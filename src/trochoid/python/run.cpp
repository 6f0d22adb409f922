#include <trochoid/base/command.h>
#include <trochoid/base/names.h>
#include <trochoid/inputs/case.h>
#include <trochoid/python/bindings.h>
#include <trochoid/sweep/answer.h>

#include <pybind11/pybind11.h>

#include <memory>
#include <string>

namespace py = pybind11;

namespace trochoid::python {

void bind_run(py::module_& m) {
  m.def(
      "run",
      [](const std::string& command, const std::shared_ptr<inputs::Case>& given,
         bool curves, bool simulate_controller, bool anyway) {
        const auto wanted = base::named<base::Command>(command);
        const py::gil_scoped_release release;
        return std::make_shared<results::Answer>(sweep::answer(
            wanted.value(), *given, {curves, simulate_controller, anyway}));
      },
      py::arg("command"), py::arg("case"), py::kw_only(), py::arg("curves") = false,
      py::arg("simulate_controller") = false, py::arg("anyway") = false);
}

}  // namespace trochoid::python
