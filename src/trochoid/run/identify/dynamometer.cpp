#include <trochoid/run/identify/dynamometer.h>

#include <trochoid/base/error.h>
#include <trochoid/base/units.h>
#include <trochoid/identification/resonance.h>
#include <trochoid/signal/transmission.h>

#include <fmt/core.h>

#include <algorithm>

namespace trochoid::run {

namespace {

using identification::Response;

/// The response in the axes of the tool: Q^-1 H Q, channels = Q force.
Response::Matrix on_tool(const signal::Transmission::Matrix& H,
                         const signal::Matrix3& Q, const signal::Matrix3& inverse) {
  Response::Matrix out{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      for (std::size_t k = 0; k < 9; ++k) {
        out[3 * i + j] += inverse[i][k / 3] * H[k] * Q[k % 3][j];
      }
    }
  }
  return out;
}

/// Q^-1, from the forces that unit readings stand for.
signal::Matrix3 inverse_of(const signal::Matrix3& Q) {
  signal::Matrix3 out{};
  for (std::size_t c = 0; c < 3; ++c) {
    std::array<std::vector<double>, 3> unit_reading{{{0.0}, {0.0}, {0.0}}};
    unit_reading[c] = {1.0};
    const auto force = signal::force_on_tool(unit_reading, Q);
    for (std::size_t q = 0; force && q < 3; ++q) out[q][c] = force->front()[q];
  }
  return out;
}

}  // namespace

std::vector<Response> measured_responses(const inputs::Case& given,
                                         std::span<const identification::Run> runs,
                                         const signal::Matrix3& channels,
                                         std::vector<base::Warning>& warnings) {
  if (!given.dynamometer || given.dynamometer->frf.name.empty()) return {};
  const inputs::TransmissionFile& file = given.dynamometer->response.get();
  warnings.insert(warnings.end(), file.notes.begin(), file.notes.end());
  const signal::Matrix3 inverse = inverse_of(channels);
  std::vector<Response> out;
  for (const identification::Run& run : runs) {
    const double holds = file.transmission.omega.back() / run.cut.Omega;
    const int highest = std::min(identification::resolved_harmonics(run),
                                 static_cast<int>(std::min(holds * (1.0 + 1e-9), 1e6)));
    if (highest < given.setup.cutter.teeth()) {
      throw base::InputError({fmt::format(
          "{}: the response ends at {:g} Hz; must reach the passing of the teeth at least, "
          "{:g} Hz",
          given.dynamometer->frf.path, file.transmission.omega.back() / unit::Hz,
          given.setup.cutter.teeth() * run.cut.Omega / unit::Hz)});
    }
    Response& response = out.emplace_back();
    for (int k = 0; k <= highest; ++k) {
      response.harmonic.push_back(
          on_tool(signal::at(file.transmission, k * run.cut.Omega), channels, inverse));
    }
  }
  return out;
}

}  // namespace trochoid::run
