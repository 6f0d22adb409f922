#include <trochoid/structure/identify_shapes.h>
#include <trochoid/structure/shapes_search.h>

#include <algorithm>
#include <cmath>

namespace trochoid::structure {

namespace {

/// Change of a parameter that ends a fit, in standard errors.
constexpr double closely = 1e-3;

}  // namespace

std::optional<ComplexCheck> complex_check(const ModesFit& fit, ResponseKind kind) {
  ShapesModel real{.residual_terms = fit.residual_terms,
                   .residual = {{fit.residual[0], fit.residual[1]}},
                   .directions = 1};
  for (const auto& modes : {fit.modes, fit.outside, fit.unresolved}) {
    for (const FittedMode& mode : modes) {
      if (!(mode.mode.mass > 0) || mode.zeta >= 0.9) {
        return std::nullopt;
      }
      real.terms.push_back({mode.omega,
                            mode.zeta,
                            {std::complex<double>(std::sqrt(1 / mode.mode.mass))}});
    }
  }
  if (!fit.ok) {
    return std::nullopt;
  }
  const std::vector<DirectedResponse> all = {
      {.response = {.kind = kind,
                    .omega = fit.omega,
                    .H = fit.H,
                    .noise_bandwidth = fit.noise_bandwidth},
       .decay = fit.window_decay}};
  const AllWeights even = even_weights(all);
  const ShapesTrial as_real = settle(all, real, even, closely);
  ShapesModel model = as_real.solution.model;
  model.complex_shapes = true;
  const ShapesTrial as_complex = settle(all, model, weights_of(all, as_real), closely);
  if (!as_real.solution.converged || !as_complex.solution.converged) {
    return std::nullopt;
  }
  ComplexCheck out{.evidence = as_real.criterion - as_complex.criterion};
  for (std::size_t r = 0; r < fit.modes.size(); ++r) {
    const ShapeTerm& term = as_complex.solution.model.terms[r];
    const double imaginary = std::abs(term.phi[0].imag()) / std::abs(term.phi[0]);
    if (imaginary >= out.imaginary) {
      out.imaginary = imaginary;
      out.omega = term.omega;
    }
  }
  return out;
}

}  // namespace trochoid::structure
