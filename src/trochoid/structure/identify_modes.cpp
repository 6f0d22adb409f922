#include <trochoid/base/units.h>
#include <trochoid/structure/identify_modes.h>
#include <trochoid/structure/modes_problem.h>
#include <trochoid/structure/pole_search.h>

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace trochoid::structure {

namespace {

using Complex = std::complex<double>;

constexpr int most_modes = 6;            ///< that are chosen without being asked for
constexpr double most_damping = 0.5;     ///< more has no peak worth the name
constexpr double worst_mass = 0.2;       ///< relative standard error
constexpr double least_explained = 0.7;  ///< of the sum of |H|^2
constexpr int least_lines_in_peak = 2;
/// A residue turned by more than this belongs to another kind of response.
constexpr double most_turned = 50 * std::numbers::pi / 180;
/// How well free poles must fit for the angle of a residue to mean something.
constexpr double well_explained = 0.8;

std::string hertz(double omega) {
  return fmt::format("{:.5g} Hz", omega / unit::Hz);
}

FrequencyResponse in_band(const FrequencyResponse& response,
                          const ModesOptions& options) {
  FrequencyResponse lines{.kind = response.kind};
  const double to =
      options.to > 0 ? options.to : std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < response.omega.size(); ++i) {
    const double w = response.omega[i];
    if (w > 0 && w >= options.from && w <= to) {
      lines.omega.push_back(w);
      lines.H.push_back(response.H[i]);
    }
  }
  return lines;
}

/// Power of H: the sum of |H|^2.
double power(const FrequencyResponse& lines) {
  double sum = 0.0;
  for (const Complex& H : lines.H) {
    sum += std::norm(H);
  }
  return sum;
}

int lines_in_peak(const FrequencyResponse& lines, const ModeTerm& t) {
  return static_cast<int>(std::count_if(
      lines.omega.begin(), lines.omega.end(),
      [&](double w) { return std::abs(w - t.omega) <= t.zeta * t.omega; }));
}

/// Why a term is no resonance of this record; empty: it is one.
std::string fault_of(const FrequencyResponse& lines, const ModesSolution& solution,
                     std::size_t r) {
  const ModeTerm& t = solution.model.terms[r];
  const double low = lines.omega.front();
  const double high = lines.omega.back();
  const std::string band =
      fmt::format("the band from {} to {}", hertz(low), hertz(high));
  if (t.omega < low || t.omega > high) {
    return fmt::format(
        "no resonance lies in {}: the best fit has its resonance at {}, "
        "where nothing was measured",
        band, hertz(t.omega));
  }
  if (t.zeta > most_damping) {
    return fmt::format(
        "no resonance lies in {}: the best fit has a damping ratio of "
        "{:.2g}, which makes no peak",
        band, t.zeta);
  }
  if (t.A <= 0) {
    return fmt::format(
        "the mode at {} has a negative mass: the response has the wrong sign. Is the "
        "sensor against the force, or is it not a response at the point of the force?",
        hertz(t.omega));
  }
  if (t.omega * (1 - t.zeta) < low || t.omega * (1 + t.zeta) > high) {
    return fmt::format(
        "the half-power points of the resonance at {} ({} and {}) are "
        "not both inside {}: a wider record is needed",
        hertz(t.omega), hertz(t.omega * (1 - t.zeta)), hertz(t.omega * (1 + t.zeta)),
        band);
  }
  if (lines_in_peak(lines, t) < least_lines_in_peak) {
    return fmt::format(
        "the resonance at {} is {} wide, and {} of the measured lines "
        "lies in it: at least {} are needed, so measure longer",
        hertz(t.omega), hertz(2 * t.zeta * t.omega), lines_in_peak(lines, t),
        least_lines_in_peak);
  }
  if (solution.variance.empty() ||
      std::sqrt(solution.variance[3 * r + 2]) > worst_mass * t.A) {
    return fmt::format("the mass of the mode at {} cannot be told from this record",
                       hertz(t.omega));
  }
  return {};
}

/// A fit and what speaks against it.
struct Candidate {
  ModesSolution solution;
  std::string fault;  ///< empty: all its modes are resonances
  double criterion = std::numeric_limits<double>::infinity();
};

Candidate candidate(const FrequencyResponse& lines, int count, bool residual_terms) {
  Candidate out;
  const Poles poles = find_poles(lines, count, residual_terms);
  std::vector<ModeTerm> starts;
  for (const Pole& pole : poles.pairs) {
    const double omega = std::abs(pole.p);
    starts.push_back({.omega = omega,
                      .zeta = std::clamp(std::abs(pole.p.real()) / omega, 1e-5, 0.9)});
  }
  out.solution = fit_modes(lines, starts, residual_terms);
  for (std::size_t r = 0; r < starts.size() && out.fault.empty(); ++r) {
    out.fault = fault_of(lines, out.solution, r);
  }
  if (!out.solution.converged && out.fault.empty()) {
    out.fault = "the fit did not converge";
  }
  const double n = 2.0 * static_cast<double>(lines.omega.size());
  // Below rounding nothing is left to be explained.
  const double rss = std::max(out.solution.rss, 1e-24 * power(lines));
  out.criterion =
      n * std::log(rss) + static_cast<double>(out.solution.model.size()) * std::log(n);
  return out;
}

/// Whether the highest peak turns like a response of this kind; if not, what it may be.
std::string fault_of_kind(const FrequencyResponse& lines, int count) {
  const Poles poles = find_poles(lines, count, true);
  const Pole& pole = poles.pairs.front();
  const double omega = std::abs(pole.p);
  const bool resonance = omega > lines.omega.front() && omega < lines.omega.back() &&
                         std::abs(pole.p.real()) < most_damping * omega;
  // A/(omega_r^2 - omega^2 + ...) has R = -i A/(2 omega_d)
  const double turned = std::arg(pole.R * Complex(0.0, 1.0));
  if (!resonance || poles.explained < well_explained ||
      std::abs(turned) < most_turned) {
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

Candidate best(const FrequencyResponse& lines, const ModesOptions& options) {
  const int first = options.count > 0 ? options.count : 1;
  const int last = options.count > 0 ? options.count : most_modes;
  Candidate chosen;
  std::string fault;
  int since = 0;
  for (int count = first; count <= last && since < 2; ++count) {
    // Three numbers a mode and two residual terms from two numbers a line.
    if (lines.omega.size() < static_cast<std::size_t>(4 * count + 4)) {
      break;
    }
    ++since;
    for (const bool terms : {false, true}) {
      if (options.residual_terms.value_or(terms) != terms) {
        continue;
      }
      Candidate next = candidate(lines, count, terms);
      if (!next.fault.empty()) {
        fault = fault.empty() || count == first ? next.fault : fault;
      } else if (next.criterion < chosen.criterion) {
        chosen = std::move(next);
        since = 0;
      }
    }
  }
  if (chosen.solution.model.terms.empty()) {
    chosen.fault = fault;
  }
  return chosen;
}

ModesFit refused(ModesFit fit, std::string reason) {
  fit.reason = std::move(reason);
  fit.modes.clear();
  fit.fitted.clear();
  return fit;
}

/// Fill in a fit from its solution.
void take(const FrequencyResponse& lines, const ModesSolution& solution,
          ModesFit& fit) {
  for (std::size_t r = 0; r < solution.model.terms.size(); ++r) {
    fit.modes.push_back(fitted_mode(solution, r));
    fit.modes.back().lines_in_peak = lines_in_peak(lines, solution.model.terms[r]);
  }
  std::sort(fit.modes.begin(), fit.modes.end(),
            [](const FittedMode& a, const FittedMode& b) { return a.omega < b.omega; });
  fit.residual_terms = solution.model.residual_terms;
  fit.above = solution.model.above;
  fit.below = solution.model.below;
  for (std::size_t i = 0; i < lines.omega.size(); ++i) {
    fit.fitted.push_back(factor(lines.kind, lines.omega[i]) *
                         receptance(solution.model, lines.omega[i]));
  }
  fit.explained = 1 - solution.rss / power(lines);
  fit.rms = std::sqrt(solution.rss / static_cast<double>(lines.omega.size()));
}

}  // namespace

ModesFit identify_modes(const FrequencyResponse& response,
                        const ModesOptions& options) {
  const FrequencyResponse lines = in_band(response, options);
  ModesFit fit{.omega = lines.omega, .H = lines.H};
  const auto needed = static_cast<std::size_t>(4 * std::max(options.count, 1) + 4);
  if (lines.omega.size() < needed) {
    return refused(
        std::move(fit),
        fmt::format("the band holds {} lines: {} need at least {}", lines.omega.size(),
                    options.count > 1 ? fmt::format("{} modes", options.count)
                                      : "one mode and its surroundings",
                    needed));
  }
  if (!(power(lines) > 0)) {
    return refused(std::move(fit), "the response is zero in the whole band");
  }
  const Candidate chosen = best(lines, options);
  const int poles = std::max(1, static_cast<int>(chosen.solution.model.terms.size()));
  const std::string kind = fault_of_kind(lines, poles);
  if (!kind.empty()) {
    return refused(std::move(fit), kind);
  }
  if (chosen.solution.model.terms.empty()) {
    return refused(std::move(fit), chosen.fault);
  }
  take(lines, chosen.solution, fit);
  if (fit.explained < least_explained) {
    return refused(std::move(fit),
                   fmt::format("no modes explain this response: the best fit leaves "
                               "{:.0f} % of its power, the sum of |H|^2, unexplained",
                               100 * (1 - fit.explained)));
  }
  fit.ok = true;
  return fit;
}

std::complex<double> modelled(const ModesFit& fit, double omega) {
  ModesModel model{
      .residual_terms = fit.residual_terms, .above = fit.above, .below = fit.below};
  for (const FittedMode& mode : fit.modes) {
    model.terms.push_back({mode.omega, mode.zeta, 1 / mode.mode.mass});
  }
  return receptance(model, omega);
}

}  // namespace trochoid::structure
