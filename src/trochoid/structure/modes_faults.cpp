#include <trochoid/base/units.h>
#include <trochoid/structure/modes_answer.h>
#include <trochoid/structure/modes_faults.h>
#include <trochoid/structure/pole_search.h>

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace trochoid::structure {

namespace {

using Complex = std::complex<double>;

/// Relative standard error: at three of them a mass might as well be infinite.
constexpr double worst_mass = 1.0 / 3;
constexpr int least_lines_in_peak = 2;
constexpr double least_part = 0.01;  ///< of a response, that a resonance makes
/// Below this fraction a term is no more than the digits in which lines are written.
constexpr double of_rounding = 1e-3;
/// A shape more imaginary than this has residues turned by 60 deg and more.
constexpr double most_imaginary = 0.5;
/// A residue turned by more than this belongs to another kind of response.
constexpr double most_turned = 50 * std::numbers::pi / 180;

std::string hertz(double omega) {
  return fmt::format("{:.5g} Hz", omega / unit::Hz);
}

/// The largest fraction of a response at the pole of a term that the term makes.
double part_of(Responses all, const ModesModel& model, const ModeTerm& t) {
  if (model.is_residue()) {  // beside what stands for the modes out of the band
    const Complex H = receptance(model, all.front(), 0, {0.0, t.omega});
    return t.phi.front().real() / (2 * t.zeta * t.omega * t.omega) / std::abs(H);
  }
  ModesModel terms = model;
  terms.residual_terms = false;
  double most = 0.0;
  for (const DirectedResponse& one : all) {
    const Complex s = laplace(one, t.omega);
    const double H = std::abs(receptance(terms, one, 0, s));
    const Complex own = product(model, t, one) * unit_mode(t, s);
    most = std::max(most, H > 0 ? std::abs(own) / H : 0.0);
  }
  return most;
}

/// The band of a response, as messages name it.
std::string band_of(const FrequencyResponse& lines) {
  return fmt::format("the band from {} to {}", hertz(lines.omega.front()),
                     hertz(lines.omega.back()));
}

/// Why a resonance cannot be resolved; empty: it can.
std::string unresolved(Responses all, const ModesModel& model, const ModeTerm& t) {
  const bool single = model.is_residue();
  const double from = t.omega * (1 - t.zeta);
  const double to = t.omega * (1 + t.zeta);
  int fewest = std::numeric_limits<int>::max();
  for (const DirectedResponse& one : all) {
    const FrequencyResponse& lines = one.response;
    fewest = std::min(fewest, lines_in_peak(lines, t));
    if (from < lines.omega.front() || to > lines.omega.back()) {
      return fmt::format(
          "the half-power points of the resonance at {} ({} and {}) are not both inside "
          "{}: a wider record is needed",
          hertz(t.omega), hertz(from), hertz(to),
          single ? band_of(lines)
                 : fmt::format("the band of the response {}", one.name));
    }
  }
  if (fewest < least_lines_in_peak) {
    return fmt::format(
        "the resonance at {} is {} wide. {} in it: {}; at least {} are needed, so "
        "measure longer",
        hertz(t.omega), hertz(2 * t.zeta * t.omega),
        single ? "Measured lines" : "Measured lines of a response", fewest,
        least_lines_in_peak);
  }
  const double part = part_of(all, model, t);
  if (part < least_part) {
    return fmt::format(
        "the resonance at {} makes {:.2g} % of {} response at its own peak: less than "
        "filters, windows and mounting leave in any record",
        hertz(t.omega), 100 * part, single ? "the" : "any");
  }
  return {};
}

/// What is wrong with what a term moves: no mass, or no shape; empty: nothing.
std::string wrong_way(Responses all, const ModesSolution& solution, std::size_t r) {
  const ModeTerm& t = solution.model.terms[r];
  if (solution.model.is_residue()) {
    return t.phi.front().real() <= 0
               ? fmt::format(
                     "the mode at {} has a negative mass: the response has the wrong "
                     "sign. Is the sensor against the force, or is it not a response at "
                     "the point of the force?",
                     hertz(t.omega))
               : std::string();
  }
  const double imaginary = shape_mode(all, solution, r).imaginary.value;
  return imaginary > most_imaginary
             ? fmt::format(
                   "the shape of the mode at {} is imaginary by {:.2g} of its size: the "
                   "kind of a response, or the sign of a direct one, is wrong",
                   hertz(t.omega), imaginary)
             : std::string();
}

/// Whether the mass of a term can be told at all.
bool mass_known(Responses all, const ModesSolution& solution, std::size_t r) {
  if (solution.covariance.empty()) {
    return false;
  }
  if (solution.model.is_residue()) {
    return std::sqrt(solution.variance(3 * r + 2)) <=
           worst_mass * solution.model.terms[r].phi.front().real();
  }
  const Known mass = shape_mode(all, solution, r).mass;
  return mass.se <= worst_mass * mass.value;
}

}  // namespace

TermVerdict verdict_on(Responses all, const ModesSolution& solution, std::size_t r) {
  const ModeTerm& t = solution.model.terms[r];
  const bool single = solution.model.is_residue();
  const bool inside =
      std::any_of(all.begin(), all.end(), [&](const DirectedResponse& one) {
        return t.omega >= one.response.omega.front() &&
               t.omega <= one.response.omega.back();
      });
  if (!inside) {
    return {TermRole::outside,
            fmt::format(
                "no resonance lies in {}: the best fit has its resonance at {}, "
                "where nothing was measured",
                single ? band_of(all.front().response) : "the band", hertz(t.omega))};
  }
  if (t.zeta > most_damping) {
    return {TermRole::none,
            fmt::format(
                "no resonance lies {}: the best fit has a damping ratio of "
                "{:.2g}{}, which makes no peak",
                single ? "in " + band_of(all.front().response) : "at " + hertz(t.omega),
                t.zeta, single ? "" : " there")};
  }
  const std::string wrong = wrong_way(all, solution, r);
  if (!wrong.empty()) {
    return {TermRole::none, wrong};
  }
  if (part_of(all, solution.model, t) < of_rounding) {
    return {TermRole::none, fmt::format("the term at {} makes nothing of the response",
                                        hertz(t.omega))};
  }
  const std::string why = unresolved(all, solution.model, t);
  if (!mass_known(all, solution, r)) {
    return {
        TermRole::none,
        why.empty()
            ? fmt::format("the mass of the mode at {} cannot be determined from {}",
                          hertz(t.omega), single ? "this record" : "these responses")
            : why};
  }
  return {why.empty() ? TermRole::mode : TermRole::unresolved, why};
}

std::string fault_of_kind(const FrequencyResponse& lines, int count, double explained) {
  const Poles poles = find_poles(lines, count, true);
  const Pole& pole = poles.pairs.front();
  const double omega = std::abs(pole.p);
  const bool resonance = omega > lines.omega.front() && omega < lines.omega.back() &&
                         std::abs(pole.p.real()) < most_damping * omega;
  // A/(omega_r^2 - omega^2 + ...) has R = -i A/(2 omega_d)
  const double turned = std::arg(pole.R * Complex(0.0, 1.0));
  if (!resonance || poles.explained < explained || std::abs(turned) < most_turned) {
    return {};
  }
  constexpr std::string_view names[] = {"receptance", "mobility", "accelerance"};
  const int given = static_cast<int>(lines.kind);
  const int steps = static_cast<int>(std::lround(turned / (std::numbers::pi / 2)));
  std::string may;
  for (const int meant : {given + steps, given + steps - 4, given + steps + 4}) {
    if (meant >= 0 && meant <= 2 && meant != given) {
      may = fmt::format(" It turns like {} {}.", meant == 2 ? "an" : "a",
                        names[static_cast<std::size_t>(meant)]);
    }
  }
  if (std::abs(steps) == 2) {
    may += " Or the sensor points against the force: then the sign must be changed.";
  }
  return fmt::format(
      "at the resonance at {} the response is turned by {:.0f} deg from "
      "what {} {} of a mode with a mass above 0 has there.{}",
      hertz(omega), turned * 180 / std::numbers::pi, given == 2 ? "an" : "a",
      names[static_cast<std::size_t>(given)], may);
}

namespace {

/// By how much a response is turned as a whole: receptances weighed by their size.
double turned_as_a_whole(const FrequencyResponse& lines) {
  Complex sum;
  for (std::size_t i = 0; i < lines.omega.size(); ++i) {
    const Complex H = lines.H[i] / factor(lines.kind, lines.omega[i]);
    sum += H * std::abs(H);
  }
  return std::arg(sum * Complex(0.0, 1.0));
}

}  // namespace

std::string fault_before_search(const FrequencyResponse& lines) {
  constexpr int most_poles = 8;
  constexpr double explained = 0.9;
  if (std::abs(turned_as_a_whole(lines)) < most_turned) {
    return {};
  }
  for (int count = 1; count <= most_poles; ++count) {
    if (find_poles(lines, count, true).explained >= explained) {
      return fault_of_kind(lines, count, explained);
    }
  }
  return {};
}

std::string fault_of_a_line(const FrequencyResponse& lines) {
  constexpr double out_of_proportion = 1e6;
  std::size_t largest = 0;
  double next = 0.0;
  for (std::size_t i = 1; i < lines.H.size(); ++i) {
    const double size = std::abs(lines.H[i]);
    if (size > std::abs(lines.H[largest])) {
      next = std::abs(lines.H[largest]);
      largest = i;
    } else {
      next = std::max(next, size);
    }
  }
  const double most = std::abs(lines.H[largest]);
  return next > 0 && most > out_of_proportion * next
             ? fmt::format(
                   "the line at {} is {:.2g} times as large as any other: no "
                   "resonance does that, so leave it out",
                   hertz(lines.omega[largest]), most / next)
             : std::string();
}

std::size_t count_of(std::span<const TermVerdict> terms, TermRole role) noexcept {
  return static_cast<std::size_t>(std::ranges::count(terms, role, &TermVerdict::role));
}

std::string fault_of(std::span<const TermVerdict> terms, int count,
                     std::optional<bool> residual_terms, bool converged) {
  const bool none = count_of(terms, TermRole::mode) == 0;
  for (const TermVerdict& term : terms) {
    const bool fatal =
        term.role == TermRole::none ||
        (term.role == TermRole::unresolved && count > 0) ||
        (term.role == TermRole::outside && !residual_terms.value_or(true));
    if (term.role != TermRole::mode && (fatal || none) && !term.why.empty()) {
      return term.why;
    }
  }
  return converged ? std::string() : "the fit did not converge";
}

}  // namespace trochoid::structure
