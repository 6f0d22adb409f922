#include <trochoid/base/unit_of_key.h>

#include <trochoid/base/units.h>

namespace trochoid::unit {

namespace {

struct Ending {
  std::string_view text;
  Named unit;
};

/// An ending that ends another one stands after it.
constexpr Ending endings[] = {
    {"_m_per_s2", {one, "m/s^2"}},
    {"_m_per_s3", {one, "m/s^3"}},
    {"_mm3_per_s", {mm * mm * mm, "mm^3/s"}},
    {"_mm_per_min", {mm_per_min, "mm/min"}},
    {"_um_per_s", {um, "um/s"}},
    {"_Ns_per_m", {one, "N s/m"}},
    {"_N_per_mm3", {N_per_mm3, "N/mm^3"}},
    {"_N_per_mm", {N_per_mm, "N/mm"}},
    {"_N_per_m", {one, "N/m"}},
    {"_m_per_N", {one, "m/N"}},
    {"_mm_per_N", {mm, "mm/N"}},
    {"_mm_per_mm", {one, "mm/mm"}},
    {"_mm_rad", {mm, "mm rad"}},
    {"_MPa", {MPa, "MPa"}},
    {"_GPa", {GPa, "GPa"}},
    {"_kPa", {kPa, "kPa"}},
    {"_deg", {deg, "deg"}},
    {"_rpm", {rpm, "rpm"}},
    {"_mm", {mm, "mm"}},
    {"_um", {um, "um"}},
    {"_kg_m2", {one, "kg m^2"}},
    {"_Nm", {one, "N m"}},
    {"_kg", {one, "kg"}},
    {"_mm3", {mm * mm * mm, "mm^3"}},
    {"_Hz", {one, "Hz"}},
    {"_N", {one, "N"}},
    {"_W", {one, "W"}},
    {"_s", {one, "s"}},
};

}  // namespace

Named of_key(std::string_view key) noexcept {
  for (const Ending& ending : endings) {
    if (key.ends_with(ending.text)) return ending.unit;
  }
  return {};
}

}  // namespace trochoid::unit
