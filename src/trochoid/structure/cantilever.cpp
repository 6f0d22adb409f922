#include <trochoid/structure/cantilever.h>

#include <algorithm>
#include <numbers>

namespace trochoid::structure {

namespace {

double positive(double x) {
  return std::max(x, 0.0);
}

double cube(double x) {
  return x * x * x;
}

/// E I of a round bar [N m^2].
double bending_stiffness(double youngs_modulus, double diameter) {
  const double square = diameter * diameter;
  return youngs_modulus * std::numbers::pi * square * square / 64;
}

/// 6 E I times the deflection at v of a cantilever loaded with 1 N at p.
double deflection(double p, double v) {
  return 3 * p * v * v - cube(v) + cube(positive(v - p));
}

/// 2 E I times the slope at v of a cantilever loaded with 1 N at p.
double slope(double p, double v) {
  const double beyond = positive(v - p);
  return 2 * p * v - v * v + beyond * beyond;
}

}  // namespace

CantileverParts compliance_parts(const Cantilever& cutter, double z_observed,
                                 double z_loaded) noexcept {
  const double s = positive(cutter.overhang - z_observed);
  const double p = positive(cutter.overhang - z_loaded);
  const double L_s = positive(cutter.overhang - cutter.flute_length);
  const double u = positive(s - L_s);
  CantileverParts parts;
  if (L_s > 0) {
    const double EI = bending_stiffness(cutter.youngs_modulus, cutter.shank_diameter);
    parts.arbor_deflection = deflection(p, std::min(s, L_s)) / (6 * EI);  // B-2
    parts.arbor_slope = slope(p, L_s) * u / (2 * EI);
  }
  if (u > 0) {
    const double EI = bending_stiffness(cutter.youngs_modulus, cutter.flute_diameter);
    parts.fluted = deflection(positive(p - L_s), u) / (6 * EI);
  }
  return parts;
}

double compliance(const Cantilever& cutter, double z_observed,
                  double z_loaded) noexcept {
  // The nearer to the holder of two points moves by the same (B-1 is symmetric), and
  // this way round no two large terms cancel.
  const CantileverParts parts = compliance_parts(cutter, std::max(z_observed, z_loaded),
                                                 std::min(z_observed, z_loaded));
  return parts.arbor_deflection + parts.arbor_slope + parts.fluted;
}

double couple_compliance(const Cantilever& cutter, double z_observed,
                         double z_loaded) noexcept {
  const double s = positive(cutter.overhang - z_observed);
  const double end = std::min(s, positive(cutter.overhang - z_loaded));
  const double L_s = positive(cutter.overhang - cutter.flute_length);
  // The integral of s1 - s from a to b, per E I of a round bar.
  const auto part = [&](double a, double b, double diameter) {
    return b > a ? (b - a) * (s - 0.5 * (a + b)) /
                       bending_stiffness(cutter.youngs_modulus, diameter)
                 : 0.0;
  };
  return -part(0.0, std::min(end, L_s), cutter.shank_diameter) -
         part(L_s, end, cutter.flute_diameter);  // B-12
}

}  // namespace trochoid::structure
