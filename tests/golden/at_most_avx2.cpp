// Preloaded by pins_test.py on machines with wider vectors: the program then sums as on the
// machine that the pins are of.
#include <hwy/targets.h>

namespace {

[[maybe_unused]] const bool narrowed = [] {
  hwy::SetSupportedTargetsForTest(HWY_ENABLED_BASELINE | HWY_SSSE3 | HWY_SSE4 |
                                  HWY_AVX2);
  return true;
}();

}  // namespace
