#include <trochoid/force/closed_form.h>

#include <trochoid/base/overloaded.h>
#include <trochoid/geometry/edge.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace trochoid::force {

namespace {

/// A mean that is no simple formula.
constexpr const LinearEdge* none = nullptr;

}  // namespace

std::optional<Vector3> closed_form_mean(const Setup& setup, const Law& law) {
  const geometry::Profile& p = setup.cutter.profile;
  const bool cylinder = p.R == 0 && p.alpha == 0 && p.beta == 0;
  const LinearEdge* const K =
      std::visit(base::Overloaded{[](const LinearEdge& linear) { return &linear; },
                                  [](const Power&) { return none; },
                                  [](const PowerEdge&) { return none; }},
                 law);
  if (K == nullptr || !cylinder || setup.chip.model == chip::Model::trochoidal ||
      !std::holds_alternative<geometry::Slot>(setup.cut.engagement) ||
      !geometry::runs_true(runout_of(setup)) || !(setup.cut.f_z > 0)) {
    return std::nullopt;
  }
  using std::numbers::pi;
  const geometry::Meridian m = geometry::meridian(p);
  const double slope = geometry::lag_at(setup.cutter, m, 0.0).per_arc;
  const double e =
      setup.edge_length == EdgeLength::axial ? 1.0 : std::hypot(1.0, p.D / 2 * slope);
  const double f = setup.cut.f_z;
  const double width = setup.cutter.teeth() * setup.cut.a_p;
  return Vector3{-width * (K->K_rc * f / 4 + K->K_re * e / pi),  // F-8
                 width * (K->K_tc * f / 4 + K->K_te * e / pi),
                 -width * (K->K_ac * f / pi + K->K_ae * e / 2)};
}

}  // namespace trochoid::force
