#include <trochoid/base/command.h>
#include <trochoid/base/names.h>
#include <trochoid/cases/case.h>
#include <trochoid/python/bindings.h>
#include <trochoid/run/answer.h>

#include <pybind11/pybind11.h>

#include <atomic>
#include <memory>
#include <stdexcept>
#include <string>

namespace py = pybind11;

namespace trochoid::python {

namespace {

/// Whether work is no longer wanted: asked wherever it tells how far it is.
class Wanted {
 public:
  void end() noexcept { ended_.store(true, std::memory_order_relaxed); }
  void check() const {
    if (ended_.load(std::memory_order_relaxed)) {
      throw std::runtime_error("the work was ended before its answer");
    }
  }

 private:
  std::atomic<bool> ended_ = false;
};

}  // namespace

void bind_run(py::module_& m) {
  py::class_<Wanted, std::shared_ptr<Wanted>>(m, "Wanted")
      .def(py::init())
      .def("end", &Wanted::end);
  m.def(
      "run",
      [](const std::string& command, const std::shared_ptr<cases::Case>& given,
         const std::shared_ptr<Wanted>& wanted, const py::kwargs& options) {
        const auto given_option = [&](const char* name) {
          return options.contains(name) && options[name].cast<bool>();
        };
        const run::AnswerOptions chosen{
            .curves = given_option("curves"),
            .moves = given_option("moves"),
            .simulate_controller = given_option("simulate_controller"),
            .anyway = given_option("anyway")};
        const auto named = base::named<base::Command>(command);
        const py::gil_scoped_release release;
        return std::make_shared<results::Answer>(
            run::answer(named.value(), *given, chosen,
                        [&](const run::Step& /*step*/) { wanted->check(); }));
      },
      py::arg("command"), py::arg("case"), py::arg("wanted"));
}

}  // namespace trochoid::python
