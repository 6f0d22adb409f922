#include <trochoid/base/units.h>
#include <trochoid/cases/case.h>
#include <trochoid/force/forces.h>
#include <trochoid/force/slice.h>
#include <trochoid/python/bindings.h>

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <algorithm>
#include <cstddef>
#include <map>
#include <memory>
#include <span>
#include <vector>

namespace py = pybind11;

namespace trochoid::python {

namespace {

using Numbers = py::array_t<double, py::array::c_style>;
using Whole = py::array_t<std::int64_t, py::array::c_style>;

std::span<const double> values_of(const Numbers& array) {
  return {array.data(), static_cast<std::size_t>(array.size())};
}

std::vector<double> in_si(std::span<const double> values, double unit) {
  std::vector<double> out(values.begin(), values.end());
  for (double& value : out) value *= unit;
  return out;
}

/// Shape (n, 3).
Numbers forces(const cases::Case& given, const Numbers& phi_deg) {
  const std::vector<double> phi = in_si(values_of(phi_deg), unit::deg);
  Numbers out({static_cast<py::ssize_t>(phi.size()), py::ssize_t{3}});
  double* F = out.mutable_data();
  const py::gil_scoped_release release;
  for (const force::Loads& loads : force::loads(
           given.setup, given.law, phi, given.gauge_length, given.sampling.tolerance)) {
    F = std::copy(loads.force.begin(), loads.force.end(), F);
  }
  return out;
}

/// Shape (n, 3, columns).
Numbers force_matrix(const cases::Case& given, const Numbers& phi_deg) {
  const std::vector<double> phi = in_si(values_of(phi_deg), unit::deg);
  const force::ForceMatrix matrix(given.setup, given.law, given.sampling.tolerance);
  Numbers out({static_cast<py::ssize_t>(phi.size()), py::ssize_t{3},
               static_cast<py::ssize_t>(matrix.columns())});
  const std::span<double> C(out.mutable_data(), static_cast<std::size_t>(out.size()));
  const py::gil_scoped_release release;
  matrix.evaluate(phi, C);
  return out;
}

/// @param tooth      from 1, checked
/// @param theta_deg  as long as tooth
/// @param height_mm  as long as tooth
Numbers chip(const cases::Case& given, const Whole& tooth, const Numbers& theta_deg,
             const Numbers& height_mm) {
  Numbers out(tooth.size());
  const std::span<double> h(out.mutable_data(), static_cast<std::size_t>(out.size()));
  const std::int64_t* j = tooth.data();
  const std::vector<double> theta = in_si(values_of(theta_deg), unit::deg);
  const std::vector<double> z = in_si(values_of(height_mm), unit::mm);
  const py::gil_scoped_release release;
  std::map<double, force::Slice> slices;
  for (std::size_t i = 0; i < h.size(); ++i) {
    const auto slice = slices.try_emplace(z[i], given.setup, z[i]).first;
    h[i] = slice->second.chip_thickness(static_cast<std::size_t>(j[i] - 1), theta[i]) /
           unit::mm;
  }
  return out;
}

}  // namespace

void bind_force(py::module_& m) {
  m.def("forces", &forces);
  m.def("force_matrix", &force_matrix);
  m.def("chip", &chip);
}

}  // namespace trochoid::python
