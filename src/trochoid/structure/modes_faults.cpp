#include <trochoid/base/units.h>
#include <trochoid/structure/modes_faults.h>
#include <trochoid/structure/pole_search.h>

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace trochoid::structure {

namespace {

using Complex = std::complex<double>;

constexpr double most_damping = 0.5;  ///< more has no peak worth the name
/// Relative standard error: at three of them a mass might as well be infinite.
constexpr double worst_mass = 1.0 / 3;
constexpr int least_lines_in_peak = 2;
constexpr double least_part = 0.01;  ///< of the response, that a resonance makes
/// A residue turned by more than this belongs to another kind of response.
constexpr double most_turned = 50 * std::numbers::pi / 180;

std::string hertz(double omega) {
  return fmt::format("{:.5g} Hz", omega / unit::Hz);
}

/// Why a resonance cannot be resolved; empty: it can.
std::string unresolved(const FrequencyResponse& lines, const ModesModel& model,
                       const ModeTerm& t, const std::string& band) {
  const double from = t.omega * (1 - t.zeta);
  const double to = t.omega * (1 + t.zeta);
  if (from < lines.omega.front() || to > lines.omega.back()) {
    return fmt::format(
        "the half-power points of the resonance at {} ({} and {}) are "
        "not both inside {}: a wider record is needed",
        hertz(t.omega), hertz(from), hertz(to), band);
  }
  const int count = lines_in_peak(lines, t);
  if (count < least_lines_in_peak) {
    return fmt::format(
        "the resonance at {} is {} wide, and {} of the measured lines "
        "lies in it: at least {} are needed, so measure longer",
        hertz(t.omega), hertz(2 * t.zeta * t.omega), count, least_lines_in_peak);
  }
  const double peak = t.A / (2 * t.zeta * t.omega * t.omega);
  const double part = peak / std::abs(receptance(model, t.omega));
  if (part < least_part) {
    return fmt::format(
        "the resonance at {} makes {:.2g} % of the response at its own peak: less than "
        "filters, windows and mounting leave in any record",
        hertz(t.omega), 100 * part);
  }
  return {};
}

}  // namespace

int lines_in_peak(const FrequencyResponse& lines, const ModeTerm& t) {
  return static_cast<int>(std::count_if(
      lines.omega.begin(), lines.omega.end(),
      [&](double w) { return std::abs(w - t.omega) <= t.zeta * t.omega; }));
}

TermVerdict verdict_on(const FrequencyResponse& lines, const ModesSolution& solution,
                       std::size_t r) {
  const ModeTerm& t = solution.model.terms[r];
  const double low = lines.omega.front();
  const double high = lines.omega.back();
  const std::string band =
      fmt::format("the band from {} to {}", hertz(low), hertz(high));
  if (t.omega < low || t.omega > high) {
    return {
        TermRole::outside,
        fmt::format("no resonance lies in {}: the best fit has its resonance at {}, "
                    "where nothing was measured",
                    band, hertz(t.omega))};
  }
  if (t.zeta > most_damping) {
    return {TermRole::none,
            fmt::format("no resonance lies in {}: the best fit has a damping ratio of "
                        "{:.2g}, which makes no peak",
                        band, t.zeta)};
  }
  if (t.A <= 0) {
    return {
        TermRole::none,
        fmt::format("the mode at {} has a negative mass: the response has the wrong "
                    "sign. Is the sensor against the force, or is it not a response "
                    "at the point of the force?",
                    hertz(t.omega))};
  }
  const std::string why = unresolved(lines, solution.model, t, band);
  const bool known = !solution.variance.empty() &&
                     std::sqrt(solution.variance[3 * r + 2]) <= worst_mass * t.A;
  if (!known) {
    return {
        TermRole::none,
        why.empty()
            ? fmt::format("the mass of the mode at {} cannot be told from this record",
                          hertz(t.omega))
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
