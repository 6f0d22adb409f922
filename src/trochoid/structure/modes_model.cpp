#include <trochoid/structure/modes_model.h>

#include <cmath>

namespace trochoid::structure {

using Complex = std::complex<double>;

Complex laplace(const DirectedResponse& response, double omega) {
  return {response.decay, omega};
}

Complex unit_mode(const ModeTerm& t, Complex s) {
  // By parts: the checks of a complex product for infinities cost more than the product,
  // and nothing is called as often.
  const double a = s.real();
  const double w = s.imag();
  const double k = 2 * t.zeta * t.omega;
  const double re = t.omega * t.omega + (a * a - w * w) + k * a;
  const double im = (a * w + w * a) + k * w;
  const double norm = re * re + im * im;
  return {re / norm, -im / norm};
}

Complex quadrature(const ModeTerm& t, Complex s) {
  return (s + t.zeta * t.omega) / (t.omega * std::sqrt(1 - t.zeta * t.zeta));
}

Complex product(const ModesModel& model, const ModeTerm& t,
                const DirectedResponse& response) {
  return model.is_residue() ? t.phi.front()
                            : t.phi[response.motion] * t.phi[response.force];
}

Complex below(const ModesModel& model, Complex f, Complex s) {
  return model.is_residue() ? f * (-1.0 / (s.imag() * s.imag())) : f / (s * s);
}

Complex receptance(const ModesModel& model, const DirectedResponse& response,
                   std::size_t which, Complex s) {
  Complex H = 0.0;
  for (const ModeTerm& t : model.terms) {
    const Complex Z = product(model, t, response);
    const Complex G = unit_mode(t, s);
    H += model.complex_shapes() ? (Z.real() + Z.imag() * quadrature(t, s)) * G
                                : Z.real() * G;
  }
  if (model.residual_terms) {
    const auto& [U, L] = model.residual[which];
    if (model.is_residue()) {
      H = H + U + below(model, L, s);  // M-6
    } else {
      H += U + below(model, L, s);  // M-30
    }
  }
  return H;
}

std::vector<Complex> modelled(const ModesModel& model, const DirectedResponse& one,
                              std::size_t which) {
  const FrequencyResponse& lines = one.response;
  std::vector<Complex> out;
  out.reserve(lines.omega.size());
  for (const double omega : lines.omega) {
    out.push_back(factor(lines.kind, omega) *
                  receptance(model, one, which, laplace(one, omega)));
  }
  return out;
}

std::vector<Complex> gaps(const ModesModel& model, const DirectedResponse& one,
                          std::size_t which) {
  std::vector<Complex> out = modelled(model, one, which);
  for (std::size_t i = 0; i < out.size(); ++i) {
    out[i] = one.response.H[i] - out[i];
  }
  return out;
}

}  // namespace trochoid::structure
