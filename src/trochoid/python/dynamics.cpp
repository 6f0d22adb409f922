#include <trochoid/base/units.h>
#include <trochoid/cases/case.h>
#include <trochoid/dynamics/multiplier.h>
#include <trochoid/dynamics/period_elements.h>
#include <trochoid/python/bindings.h>
#include <trochoid/run/problems.h>

#include <pybind11/complex.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <complex>
#include <cstddef>
#include <map>
#include <vector>

namespace py = pybind11;

namespace trochoid::python {

namespace {

using Numbers = py::array_t<double, py::array::c_style>;

/// Of the directional matrices, as for the multiplier of `stability`.
constexpr double matrix_tolerance = 1e-10;

std::vector<double> in_si(const double* given, std::size_t count, double unit) {
  std::vector<double> out(given, given + count);
  for (double& value : out) value *= unit;
  return out;
}

/// @param depth_mm  as long as the speeds, positive
py::array_t<std::complex<double>> multiplier(const cases::Case& given,
                                             const Numbers& spindle_rpm,
                                             const Numbers& depth_mm) {
  dynamics::StabilityProblem problem = run::stability_problem(given);
  py::array_t<std::complex<double>> out(spindle_rpm.size());
  std::complex<double>* value = out.mutable_data();
  const double* speed = spindle_rpm.data();
  const double* depth = depth_mm.data();
  const auto count = static_cast<std::size_t>(spindle_rpm.size());
  const py::gil_scoped_release release;
  problem.spindle_speeds = in_si(speed, count, unit::rpm);
  problem.depths = in_si(depth, count, unit::mm);
  const double fastest = dynamics::fastest_frequency(problem.system);
  const dynamics::DirectionalModel model(problem.setup, problem.law,
                                         problem.options.chip_floor, matrix_tolerance,
                                         dynamics::reach_of(problem, fastest));
  std::map<double, dynamics::Directional> at;
  for (std::size_t i = 0; i < count; ++i) {
    auto found = at.find(depth[i]);
    if (found == at.end()) {
      found = at.emplace(depth[i], model.at_depth(depth[i] * unit::mm)).first;
    }
    value[i] = dynamics::multiplier(found->second, problem.system, speed[i] * unit::rpm,
                                    problem.options.tolerance)
                   .value;
  }
  return out;
}

}  // namespace

void bind_dynamics(py::module_& m) {
  m.def("multiplier", &multiplier);
}

}  // namespace trochoid::python
