#include <trochoid/base/units.h>
#include <trochoid/structure/shapes_answer.h>

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

namespace trochoid::structure {

namespace {

using Complex = std::complex<double>;

constexpr double most_damping = 0.5;
/// Relative standard error: at three of them a mass might as well be infinite.
constexpr double worst_mass = 1.0 / 3;
constexpr int least_lines_in_peak = 2;
constexpr double least_part = 0.01;  ///< of the best response at the pole
/// A shape more imaginary than this has residues turned by 60 deg and more.
constexpr double most_imaginary = 0.5;

std::string hertz(double omega) {
  return fmt::format("{:.5g} Hz", omega / unit::Hz);
}

/// The parameters of one term, as numbers.
std::vector<double> numbers_of(const ShapesModel& model, const ShapeTerm& t) {
  std::vector<double> p{t.omega, t.zeta};
  for (const Complex& phi : t.phi) {
    p.push_back(phi.real());
  }
  for (std::size_t m = 0; model.complex_shapes && m < t.phi.size(); ++m) {
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

/// What the covariance of two terms makes of a quantity of each.
double covariance(const ShapesSolution& solution, std::size_t r,
                  std::span<const double> g, std::size_t s, std::span<const double> h) {
  const std::size_t n = solution.model.size();
  double sum = 0.0;
  for (std::size_t i = 0; i < g.size(); ++i) {
    for (std::size_t j = 0; j < h.size(); ++j) {
      sum +=
          g[i] * h[j] * solution.covariance[(r * g.size() + i) * n + s * h.size() + j];
    }
  }
  return sum;
}

/// A quantity of one term with its standard error.
Known known(const ShapesSolution& solution, std::size_t r, const Quantity& quantity) {
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
Quantity angle_about(const ShapeTerm& t) {
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

/// Lines of one response between the half-power points of a term.
int lines_in_peak(const DirectedResponse& one, const ShapeTerm& t) {
  return lines_in_peak(one.response, {.omega = t.omega, .zeta = t.zeta});
}

/// The largest fraction of a response at the pole that a term makes.
double part_of(Responses all, const ShapesModel& model, const ShapeTerm& t) {
  double most = 0.0;
  for (const DirectedResponse& one : all) {
    const Complex s(one.decay, t.omega);
    DirectedResponse at = one;
    at.response.kind = ResponseKind::receptance;
    at.response.omega = {t.omega};
    ShapesModel terms = model;
    terms.residual_terms = false;
    const double H = std::abs(modelled(terms, at, 0).front());
    const Complex Z = t.phi[one.motion] * t.phi[one.force];
    most = std::max(most, H > 0 ? std::abs(Z * unit_mode(t, s)) / H : 0.0);
  }
  return most;
}

/// Why a resonance cannot be resolved; empty: it can.
std::string unresolved(Responses all, const ShapesModel& model, const ShapeTerm& t) {
  int fewest = lines_in_peak(all.front(), t);
  for (const DirectedResponse& one : all) {
    fewest = std::min(fewest, lines_in_peak(one, t));
    if (t.omega * (1 - t.zeta) < one.response.omega.front() ||
        t.omega * (1 + t.zeta) > one.response.omega.back()) {
      return fmt::format(
          "the half-power points of the resonance at {} ({} and {}) are not both inside "
          "the band of the response {}: a wider record is needed",
          hertz(t.omega), hertz(t.omega * (1 - t.zeta)), hertz(t.omega * (1 + t.zeta)),
          one.name);
    }
  }
  if (fewest < least_lines_in_peak) {
    return fmt::format(
        "the resonance at {} is {} wide, and {} of the lines of a response lie in it: at "
        "least {} are needed, so measure longer",
        hertz(t.omega), hertz(2 * t.zeta * t.omega), fewest, least_lines_in_peak);
  }
  const double part = part_of(all, model, t);
  if (part < least_part) {
    return fmt::format(
        "the resonance at {} makes {:.2g} % of any response at its own peak: less than "
        "filters, windows and mounting leave in any record",
        hertz(t.omega), 100 * part);
  }
  return {};
}

}  // namespace

TermVerdict verdict_on(Responses all, const ShapesSolution& solution, std::size_t r) {
  const ShapeTerm& t = solution.model.terms[r];
  const bool inside =
      std::any_of(all.begin(), all.end(), [&](const DirectedResponse& one) {
        return t.omega >= one.response.omega.front() &&
               t.omega <= one.response.omega.back();
      });
  if (!inside) {
    return {TermRole::outside,
            fmt::format("no resonance lies in the band: the best fit has its resonance "
                        "at {}, where nothing was measured",
                        hertz(t.omega))};
  }
  if (t.zeta > most_damping) {
    return {TermRole::none,
            fmt::format("no resonance lies at {}: the best fit has a damping ratio of "
                        "{:.2g} there, which makes no peak",
                        hertz(t.omega), t.zeta)};
  }
  const ShapeMode mode = shape_mode(all, solution, r);
  if (mode.imaginary.value > most_imaginary) {
    return {
        TermRole::none,
        fmt::format("the shape of the mode at {} is imaginary by {:.2g} of its size: "
                    "the kind of a response, or the sign of a direct one, is wrong",
                    hertz(t.omega), mode.imaginary.value)};
  }
  const std::string why = unresolved(all, solution.model, t);
  if (solution.covariance.empty() || mode.mass.se > worst_mass * mode.mass.value) {
    return {TermRole::none,
            why.empty() ? fmt::format("the mass of the mode at {} cannot be told from "
                                      "these responses",
                                      hertz(t.omega))
                        : why};
  }
  return {why.empty() ? TermRole::mode : TermRole::unresolved, why};
}

ShapeMode shape_mode(Responses all, const ShapesSolution& solution, std::size_t r) {
  const ShapeTerm& t = solution.model.terms[r];
  const std::size_t n = solution.model.directions;
  const auto of = [&](const Quantity& quantity) {
    return known(solution, r, quantity);
  };
  ShapeMode out{.phi = t.phi};
  out.omega = of(omega_of);
  out.zeta = of(zeta_of);
  out.mass = of(mass_of);
  out.stiffness = of([](auto p) { return p[0] * p[0] / squared(p); });
  out.damping = of([](auto p) { return 2 * p[1] * p[0] / squared(p); });
  const auto largest = std::max_element(
      t.phi.begin(), t.phi.end(),
      [](Complex a, Complex b) { return std::norm(a) < std::norm(b); });
  const double sign = largest->real() < 0 ? -1.0 : 1.0;
  for (std::size_t m = 0; m < n; ++m) {
    out.phi[m] *= sign;
    const double re = of([m](auto p) { return p[2 + m]; }).se;
    const bool both = solution.model.complex_shapes;
    out.phi_se.emplace_back(
        re, both ? of([m, n](auto p) { return p[2 + n + m]; }).se : 0.0);
  }
  if (n > 1) {
    out.angle = of(angle_about(t));
    out.angle.value = of_a_line(out.angle.value);
  }
  if (solution.model.complex_shapes) {
    out.imaginary = of([n](auto p) {
      double sum = 0.0;
      for (const double value : p.subspan(2 + n)) {
        sum += value * value;
      }
      return std::sqrt(sum / squared(p));
    });
  }
  out.lines_in_peak = lines_in_peak(all.front(), t);
  for (const DirectedResponse& one : all) {
    out.lines_in_peak = std::min(out.lines_in_peak, lines_in_peak(one, t));
  }
  return out;
}

std::vector<double> shape_covariance(const ShapesSolution& solution,
                                     const std::vector<std::size_t>& terms) {
  std::vector<double> out;
  if (solution.covariance.empty()) {
    return out;
  }
  std::vector<std::vector<double>> slopes;
  for (const std::size_t r : terms) {
    const ShapeTerm& t = solution.model.terms[r];
    const std::vector<double> p = numbers_of(solution.model, t);
    for (const Quantity& quantity :
         {Quantity(omega_of), Quantity(zeta_of), Quantity(mass_of)}) {
      slopes.push_back(slopes_of(p, quantity));
    }
    if (t.phi.size() > 1) {
      slopes.push_back(slopes_of(p, angle_about(t)));
    }
  }
  const std::size_t each = slopes.size() / terms.size();
  for (std::size_t i = 0; i < slopes.size(); ++i) {
    for (std::size_t j = 0; j < slopes.size(); ++j) {
      out.push_back(
          covariance(solution, terms[i / each], slopes[i], terms[j / each], slopes[j]));
    }
  }
  return out;
}

FittedResponse fitted_response(Responses all, const ShapesTrial& trial,
                               std::size_t which,
                               const std::vector<std::size_t>& answers) {
  const DirectedResponse& one = all[which];
  const ShapesModel& model = trial.solution.model;
  FittedResponse out{.omega = one.response.omega,
                     .H = one.response.H,
                     .fitted = modelled(model, one, which),
                     .noise = trial.noise[which],
                     .residual = model.residual[which]};
  double rss = 0.0;
  double power = 0.0;
  for (std::size_t i = 0; i < out.H.size(); ++i) {
    rss += std::norm(out.H[i] - out.fitted[i]);
    power += std::norm(out.H[i]);
  }
  out.explained = 1 - rss / power;
  out.rms = std::sqrt(rss / static_cast<double>(out.H.size()));
  const std::size_t n = model.directions;
  const bool both = model.complex_shapes;
  const auto product = [&, n, both](std::span<const double> p) {
    const auto phi = [&](std::size_t m) {
      return Complex(p[2 + m], both ? p[2 + n + m] : 0.0);
    };
    return phi(one.motion) * phi(one.force);
  };
  for (const std::size_t r : answers) {
    const Known re =
        known(trial.solution, r, [&](auto p) { return product(p).real(); });
    const Known im =
        known(trial.solution, r, [&](auto p) { return product(p).imag(); });
    out.residues.push_back({.value = {re.value, im.value}, .se = {re.se, im.se}});
  }
  return out;
}

}  // namespace trochoid::structure
