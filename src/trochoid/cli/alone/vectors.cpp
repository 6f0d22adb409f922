// Which vectors the processor has, as Highway asks it, for a program without its shared
// library: Debian has no static one. Wider ones than named here go unused.
#include <hwy/targets.h>

#include <cstdint>

namespace hwy {

namespace {

#if HWY_ARCH_X86_64
std::int64_t found() {
  __builtin_cpu_init();  // looks whether the system keeps the registers, too
  std::int64_t targets = HWY_ENABLED_BASELINE;
  if (!__builtin_cpu_supports("ssse3")) {
    return targets;
  }
  targets |= HWY_SSSE3;
  if (!__builtin_cpu_supports("sse4.1") || !__builtin_cpu_supports("sse4.2") ||
      !__builtin_cpu_supports("pclmul") || !__builtin_cpu_supports("aes")) {
    return targets;
  }
  targets |= HWY_SSE4;
  if (!__builtin_cpu_supports("avx2") || !__builtin_cpu_supports("fma") ||
      !__builtin_cpu_supports("bmi") || !__builtin_cpu_supports("bmi2") ||
      !__builtin_cpu_supports("lzcnt") || !__builtin_cpu_supports("f16c")) {
    return targets;
  }
  targets |= HWY_AVX2;
  if (!__builtin_cpu_supports("avx512f") || !__builtin_cpu_supports("avx512cd") ||
      !__builtin_cpu_supports("avx512bw") || !__builtin_cpu_supports("avx512dq") ||
      !__builtin_cpu_supports("avx512vl")) {
    return targets;
  }
  return targets | HWY_AVX3;
}
#else
std::int64_t found() {
  return HWY_ENABLED_BASELINE;
}
#endif

}  // namespace

std::int64_t SupportedTargets() {
  return found();
}

ChosenTarget& GetChosenTarget() {
  static ChosenTarget chosen;
  return chosen;
}

}  // namespace hwy
