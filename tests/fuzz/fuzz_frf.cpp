#include <trochoid/base/error.h>
#include <trochoid/files/frf_file.h>

#include <cmath>
#include <cstdint>
#include <string>

#include "bytes.h"

namespace {

using trochoid::files::FrfFile;

using trochoid::fuzz::demand;

/// What a record of hammer blows must be, and must bear.
void use(const trochoid::signal::TapRecord& tap) {
  demand(tap.force.size() == tap.response.size());
  demand(std::isfinite(tap.sample_rate) && tap.sample_rate > 0.0);
  const auto response = trochoid::signal::frequency_response(tap, {});
  demand(response.fault.empty() ? !response.omega.empty() : response.omega.empty());
  demand(response.omega.size() == response.H.size());
  for (const auto& h : response.H) {
    demand(std::isfinite(h.real()) && std::isfinite(h.imag()));
  }
  for (const double coherence : response.coherence) {
    demand(coherence >= 0.0 && coherence <= 1.0 + 1e-9);
  }
}

/// What every frequency response that is accepted must be.
void use(const FrfFile& file) {
  if (file.tap) {
    use(*file.tap);
    return;
  }
  const auto& omega = file.response.omega;
  const auto& H = file.response.H;
  demand(!omega.empty() && omega.size() == H.size());
  for (std::size_t i = 0; i < omega.size(); ++i) {
    demand(std::isfinite(omega[i]) && omega[i] >= 0);
    demand(i == 0 || omega[i] > omega[i - 1]);
    demand(std::isfinite(H[i].real()) && std::isfinite(H[i].imag()));
  }
}

}  // namespace

/// The first byte says the kind, or that the file must, and which data set.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  trochoid::files::FrfSource source;
  if (data[0] % 4 != 3) {
    source.kind = static_cast<trochoid::structure::ResponseKind>(data[0] % 4);
  }
  source.dataset = data[0] / 64;
  try {
    use(trochoid::files::read_frf(
        std::string(reinterpret_cast<const char*>(data) + 1, size - 1), "frf", source));
  } catch (const trochoid::base::InputError& error) {
    demand(!error.problems().empty());
  }
  return 0;
}
