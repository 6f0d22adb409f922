#include <trochoid/structure/modes_answer.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>

namespace trochoid::structure {

namespace {

using Complex = std::complex<double>;

/// A term with the exponential window taken out (M-22), and derivatives by omega, zeta
/// and A of the term.
struct WithoutWindow {
  using Slopes = std::array<double, 3>;
  double w = 0.0;      ///< [rad/s]
  double sigma = 0.0;  ///< [1/s]
  double zeta = 0.0;
  Slopes by_w{};
  Slopes by_sigma{};
  Slopes by_zeta{};
};

WithoutWindow without_window(const ModeTerm& t, double a) {
  WithoutWindow out;
  out.sigma = t.zeta * t.omega - a;
  out.w =
      std::sqrt(std::max(t.omega * t.omega - 2 * a * t.zeta * t.omega + a * a, 0.0));
  if (out.w == 0) {
    return out;
  }
  out.zeta = out.sigma / out.w;
  out.by_sigma = {t.zeta, t.omega, 0};
  out.by_w = {(t.omega - a * t.zeta) / out.w, -a * t.omega / out.w, 0};
  for (std::size_t i = 0; i < 3; ++i) {
    out.by_zeta[i] = (out.by_sigma[i] - out.zeta * out.by_w[i]) / out.w;
  }
  return out;
}

/// The parameters of one term with a shape, as numbers.
std::vector<double> numbers_of(const ModesModel& model, const ModeTerm& t) {
  std::vector<double> p{t.omega, t.zeta};
  for (const Complex& phi : t.phi) {
    p.push_back(phi.real());
  }
  for (std::size_t m = 0; model.complex_shapes() && m < t.phi.size(); ++m) {
    p.push_back(t.phi[m].imag());
  }
  return p;
}

using Quantity = std::function<double(std::span<const double>)>;

/// Derivatives of a quantity by the parameters of its term, as quotients.
std::vector<double> slopes_of(std::vector<double> p, const Quantity& quantity) {
  constexpr double step = 1e-6;
  double size = 0.0;  // of the shape, whose components may be 0
  for (std::size_t k = 2; k < p.size(); ++k) {
    size = std::max(size, std::abs(p[k]));
  }
  std::vector<double> slope;
  for (std::size_t k = 0; k < p.size(); ++k) {
    const double at = p[k];
    const double h = step * (k < 2 ? at : size);
    p[k] = at + h;
    const double above = quantity(p);
    p[k] = at - h;
    slope.push_back((above - quantity(p)) / (2 * h));
    p[k] = at;
  }
  return slope;
}

/// A quantity of one term with its standard error.
Known known(const ModesSolution& solution, std::size_t r, const Quantity& quantity) {
  const std::vector<double> p = numbers_of(solution.model, solution.model.terms[r]);
  Known out{.value = quantity(p)};
  if (solution.covariance.empty()) {
    return out;
  }
  const std::vector<double> slope = slopes_of(p, quantity);
  out.se = std::sqrt(std::max(covariance(solution, r, slope, r, slope), 0.0));
  return out;
}

double squared(std::span<const double> p) {
  double sum = 0.0;
  for (const double value : p.subspan(2)) {
    sum += value * value;
  }
  return sum;
}

double omega_of(std::span<const double> p) {
  return p[0];
}

double zeta_of(std::span<const double> p) {
  return p[1];
}

double mass_of(std::span<const double> p) {
  return 1 / squared(p);  // M-33
}

/// The angle of a shape, near the one it has: without a jump there.
Quantity angle_about(const ModeTerm& t) {
  const double at = std::atan2(t.phi[1].real(), t.phi[0].real());
  return [at](auto p) {
    return at + std::remainder(std::atan2(p[3], p[2]) - at, 2 * std::numbers::pi);
  };
}

/// Directions are lines: an angle in (-90, 90] deg.
double of_a_line(double angle) {
  constexpr double half_turn = std::numbers::pi;
  angle = std::remainder(angle, half_turn);
  return angle <= -half_turn / 2 ? angle + half_turn : angle;
}

/// Covariance of quantities of some terms, whose derivatives are given: as many of each.
std::vector<double> covariance_of(const ModesSolution& solution,
                                  std::span<const std::size_t> terms,
                                  const std::vector<std::vector<double>>& slopes) {
  const std::size_t each = slopes.size() / terms.size();
  std::vector<double> out;
  for (std::size_t i = 0; i < slopes.size(); ++i) {
    for (std::size_t j = 0; j < slopes.size(); ++j) {
      out.push_back(
          covariance(solution, terms[i / each], slopes[i], terms[j / each], slopes[j]));
    }
  }
  return out;
}

}  // namespace

int lines_in_peak(const FrequencyResponse& lines, const ModeTerm& t) {
  return static_cast<int>(std::count_if(
      lines.omega.begin(), lines.omega.end(),
      [&](double w) { return std::abs(w - t.omega) <= t.zeta * t.omega; }));
}

FittedMode fitted_mode(const ModesSolution& solution, std::size_t r,
                       double window_decay) {
  const ModeTerm& t = solution.model.terms[r];
  const double A = t.phi.front().real();
  const auto [w, sigma, zeta, by_w, by_sigma, by_zeta] =
      without_window(t, window_decay);
  FittedMode out;
  out.omega.value = w;
  out.zeta.value = zeta;
  out.mass.value = 1 / A;
  out.stiffness.value = w * w / A;
  out.damping.value = 2 * sigma / A;
  if (solution.covariance.empty() || w == 0) {
    return out;
  }
  const auto error = [&](const WithoutWindow::Slopes& g) {
    return std::sqrt(std::max(covariance(solution, r, g, r, g), 0.0));
  };
  const double A2 = A * A;
  out.omega.se = error(by_w);
  out.zeta.se = error(by_zeta);
  out.mass.se = error({0, 0, 1 / A2});
  out.stiffness.se = error({2 * w * by_w[0] / A, 2 * w * by_w[1] / A, -w * w / A2});
  out.damping.se = error({2 * by_sigma[0] / A, 2 * by_sigma[1] / A, -2 * sigma / A2});
  return out;
}

std::vector<double> mode_covariance(const ModesSolution& solution,
                                    std::span<const std::size_t> terms,
                                    double window_decay) {
  if (solution.covariance.empty()) {
    return {};
  }
  std::vector<std::vector<double>> slopes;
  for (const std::size_t r : terms) {
    const ModeTerm& t = solution.model.terms[r];
    const double A = t.phi.front().real();
    const WithoutWindow free = without_window(t, window_decay);
    slopes.emplace_back(free.by_w.begin(), free.by_w.end());
    slopes.emplace_back(free.by_zeta.begin(), free.by_zeta.end());
    slopes.push_back({0, 0, -1 / (A * A)});
  }
  return covariance_of(solution, terms, slopes);
}

FittedMode shape_mode(Responses all, const ModesSolution& solution, std::size_t r) {
  const ModeTerm& t = solution.model.terms[r];
  const std::size_t n = solution.model.directions;
  const auto of = [&](const Quantity& quantity) {
    return known(solution, r, quantity);
  };
  FittedMode out;
  out.phi = t.phi;
  out.omega = of(omega_of);
  out.zeta = of(zeta_of);
  out.mass = of(mass_of);
  out.stiffness = of([](auto p) { return p[0] * p[0] / squared(p); });
  out.damping = of([](auto p) { return 2 * p[1] * p[0] / squared(p); });
  const auto largest = std::max_element(
      t.phi.begin(), t.phi.end(),
      [](Complex a, Complex b) { return std::norm(a) < std::norm(b); });
  const double sign = largest->real() < 0 ? -1.0 : 1.0;
  const bool both = solution.model.complex_shapes();
  for (std::size_t m = 0; m < n; ++m) {
    out.phi[m] *= sign;
    const double re = of([m](auto p) { return p[2 + m]; }).se;
    out.phi_se.emplace_back(
        re, both ? of([m, n](auto p) { return p[2 + n + m]; }).se : 0.0);
  }
  if (n > 1) {
    out.angle = of(angle_about(t));
    out.angle.value = of_a_line(out.angle.value);
  }
  if (both) {
    out.imaginary = of([n](auto p) {
      double sum = 0.0;
      for (const double value : p.subspan(2 + n)) {
        sum += value * value;
      }
      return std::sqrt(sum / squared(p));
    });
  }
  out.lines_in_peak = lines_in_peak(all.front().response, t);
  for (const DirectedResponse& one : all) {
    out.lines_in_peak = std::min(out.lines_in_peak, lines_in_peak(one.response, t));
  }
  return out;
}

std::vector<double> shape_covariance(const ModesSolution& solution,
                                     std::span<const std::size_t> terms) {
  if (solution.covariance.empty()) {
    return {};
  }
  std::vector<std::vector<double>> slopes;
  for (const std::size_t r : terms) {
    const ModeTerm& t = solution.model.terms[r];
    const std::vector<double> p = numbers_of(solution.model, t);
    for (const Quantity& quantity :
         {Quantity(omega_of), Quantity(zeta_of), Quantity(mass_of)}) {
      slopes.push_back(slopes_of(p, quantity));
    }
    if (t.phi.size() > 1) {
      slopes.push_back(slopes_of(p, angle_about(t)));
    }
  }
  return covariance_of(solution, terms, slopes);
}

FittedResponse measured_response(const DirectedResponse& one) {
  FittedResponse out;
  out.kind = one.response.kind;
  out.omega = one.response.omega;
  out.H = one.response.H;
  out.decay = one.decay;
  out.noise_bandwidth = one.response.noise_bandwidth;
  return out;
}

FittedResponse fitted_response(Responses all, const ModesTrial& trial,
                               std::size_t which) {
  const DirectedResponse& one = all[which];
  const ModesModel& model = trial.solution.model;
  FittedResponse out = measured_response(one);
  const double rss = left_over(model, one, which);
  out.fitted = modelled(model, one, which);
  out.explained = 1 - rss / power(one.response);
  out.rms = std::sqrt(rss / static_cast<double>(out.H.size()));
  out.noise = trial.noise[which];
  out.residual = model.residual[which];
  return out;
}

std::vector<ShapeResidue> residues_of(const ModesSolution& solution,
                                      const DirectedResponse& one,
                                      std::span<const std::size_t> terms) {
  const std::size_t n = solution.model.directions;
  const bool both = solution.model.complex_shapes();
  const auto residue = [&, n, both](std::span<const double> p) {
    const auto phi = [&](std::size_t m) {
      return Complex(p[2 + m], both ? p[2 + n + m] : 0.0);
    };
    return phi(one.motion) * phi(one.force);
  };
  std::vector<ShapeResidue> out;
  for (const std::size_t r : terms) {
    const Known re = known(solution, r, [&](auto p) { return residue(p).real(); });
    const Known im = known(solution, r, [&](auto p) { return residue(p).imag(); });
    out.push_back({.value = {re.value, im.value}, .se = {re.se, im.se}});
  }
  return out;
}

}  // namespace trochoid::structure
