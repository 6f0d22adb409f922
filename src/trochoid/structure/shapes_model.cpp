#include <trochoid/structure/shapes_model.h>

#include <cmath>

namespace trochoid::structure {

using Complex = std::complex<double>;

Complex laplace(const DirectedResponse& response, double omega) {
  return {response.decay, omega};
}

Complex unit_mode(const ShapeTerm& term, Complex s) {
  const Complex D = term.omega * term.omega + s * s + 2 * term.zeta * term.omega * s;
  return std::conj(D) / std::norm(D);
}

Complex quadrature(const ShapeTerm& term, Complex s) {
  return (s + term.zeta * term.omega) /
         (term.omega * std::sqrt(1 - term.zeta * term.zeta));
}

std::vector<Complex> modelled(const ShapesModel& model,
                              const DirectedResponse& response, std::size_t which) {
  std::vector<Complex> out;
  out.reserve(response.response.omega.size());
  for (const double omega : response.response.omega) {
    const Complex s = laplace(response, omega);
    Complex H = 0.0;
    for (const ShapeTerm& t : model.terms) {
      const Complex Z = t.phi[response.motion] * t.phi[response.force];
      H += (Z.real() + Z.imag() * quadrature(t, s)) * unit_mode(t, s);
    }
    if (model.residual_terms) {
      const auto& [U, L] = model.residual[which];
      H += U + L / (s * s);  // M-30
    }
    out.push_back(factor(response.response.kind, omega) * H);
  }
  return out;
}

std::vector<Complex> gaps(const ShapesModel& model, const DirectedResponse& response,
                          std::size_t which) {
  std::vector<Complex> out = modelled(model, response, which);
  for (std::size_t i = 0; i < out.size(); ++i) {
    out[i] = response.response.H[i] - out[i];
  }
  return out;
}

}  // namespace trochoid::structure
