#include <trochoid/run/coefficient_names.h>

#include <trochoid/base/units.h>

#include <algorithm>

namespace trochoid::run {

namespace {

constexpr std::array<CoefficientName, 6> linear_names = {
    {{"K_tc_MPa", unit::MPa},
     {"K_rc_MPa", unit::MPa},
     {"K_ac_MPa", unit::MPa},
     {"K_te_N_per_mm", unit::N_per_mm},
     {"K_re_N_per_mm", unit::N_per_mm},
     {"K_ae_N_per_mm", unit::N_per_mm}}};
constexpr std::array<CoefficientName, 3> power_names = {
    {{"K_t1_MPa", unit::MPa}, {"K_r1_MPa", unit::MPa}, {"K_a1_MPa", unit::MPa}}};

}  // namespace

std::span<const CoefficientName> coefficient_names(const force::Law& law) {
  if (std::holds_alternative<force::Power>(law)) {
    return power_names;
  }
  return linear_names;
}

bool unidentifiable(const identification::Fit& fit, const std::string& name) {
  return std::any_of(fit.unidentifiable.begin(), fit.unidentifiable.end(),
                     [&](const auto& entry) { return entry.first == name; });
}

}  // namespace trochoid::run
