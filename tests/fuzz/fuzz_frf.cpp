#include <trochoid/base/error.h>
#include <trochoid/inputs/frf_file.h>

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string>

namespace {

using trochoid::inputs::FrfFile;

void demand(bool condition) {
  if (!condition) std::abort();
}

/// What every frequency response that is accepted must be.
void use(const FrfFile& file) {
  if (file.tap) {
    demand(file.tap->force.size() == file.tap->response.size());
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
  trochoid::inputs::FrfSource source;
  if (data[0] % 4 != 3) {
    source.kind = static_cast<trochoid::structure::ResponseKind>(data[0] % 4);
  }
  source.dataset = data[0] / 64;
  try {
    use(trochoid::inputs::read_frf(
        std::string(reinterpret_cast<const char*>(data) + 1, size - 1), "frf", source));
  } catch (const trochoid::base::InputError& error) {
    demand(!error.problems().empty());
  }
  return 0;
}
