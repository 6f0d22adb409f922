#include <trochoid/identification/runout_form.h>

#include <trochoid/base/units.h>
#include <trochoid/identification/reliability.h>
#include <trochoid/identification/resonance.h>
#include <trochoid/numerics/student.h>

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace trochoid::identification {

namespace {

/// Offsets whose intervals are wider than this part of the feed may hide a runout.
constexpr double small_part = 0.1;
/// Evidence below this, in the chance of one unknown, is none.
constexpr double by_chance = 4.0;
/// A fit that leaves less of the force (rms) leaves nothing to explain.
constexpr double nothing_left = 1e-4;

double rss(const Fit& fit, std::span<const Run> runs) {
  double samples = 0.0;
  for (const Run& run : runs) samples += static_cast<double>(run.angle.size());
  return fit.rms * fit.rms * samples;
}

int unknowns(RunoutUnknowns form, int teeth) {
  return (finds_offsets(form) ? teeth - 1 : 0) + (finds_eccentricity(form) ? 2 : 0);
}

/// @return by how much the first fit foretells better than the second, in the chance of
/// one unknown (I-18); negative: worse
double better_by(const Fit& a, const Fit& b, std::span<const Run> runs, int teeth) {
  const double v = std::min(a.chance, b.chance);
  const int more =
      unknowns(a.options.runout, teeth) - unknowns(b.options.runout, teeth);
  const double gained = rss(b, runs) - rss(a, runs);
  return v > 0 ? gained / v - 2.0 * more : (gained > 0 ? INFINITY : -INFINITY);
}

bool clearly_better(const Fit& a, const Fit& b, std::span<const Run> runs, int teeth) {
  const int more =
      unknowns(a.options.runout, teeth) - unknowns(b.options.runout, teeth);
  return better_by(a, b, runs, teeth) + 2.0 * more > by_chance * std::max(1, more);
}

/// Whether anything is left that a runout of another form could explain.
bool leaves_something(const Fit& fit, std::span<const Run> runs) {
  return fit.unexplained.all > nothing_left &&
         (repeats(runs, fit) || fit.residual_correlation > noise_correlation);
}

/// @brief What all offsets are smaller than [m], if together they may be zero: each at its
/// share of 5 % (Bonferroni).
std::optional<double> bound_of_none(const Fit& offsets) {
  constexpr double many = 1e6;  // degrees of freedom: the normal distribution
  const auto count = static_cast<double>(offsets.radial_offsets_se.size()) - 1.0;
  if (count < 1.0) return std::nullopt;
  const double share =
      numerics::student_t(1.0 - 0.025 / count, many) / numerics::student_t(0.975, many);
  double bound = 0.0;
  for (std::size_t k = 1; k < offsets.radial_offsets_se.size(); ++k) {
    const auto& se = offsets.radial_offsets_se[k];
    if (!se) return std::nullopt;
    const double half = share * offsets.interval_factor * *se;
    const double size = std::abs(offsets.runout.radial_offsets[k]);
    if (size > half) return std::nullopt;
    bound = std::max(bound, half + size);
  }
  return bound;
}

Fit fit_with(const force::Setup& setup, const force::Law& law,
             std::span<const Run> runs, const Fit& like, RunoutUnknowns form) {
  Options options = like.options;
  options.runout = form;
  options.start = std::nullopt;
  if (form == RunoutUnknowns::both) options.start = Start{like.runout, like.phase};
  force::Setup without = setup;
  without.runout.radial_offsets.clear();
  without.runout.eccentricity = 0.0;
  return identify(without, law, runs, options);
}

std::string_view in_words(RunoutUnknowns form) {
  switch (form) {
    case RunoutUnknowns::none:
      return "no runout";
    case RunoutUnknowns::fixed:
      return "the given runout";
    case RunoutUnknowns::offsets:
      return "radial offsets of the teeth";
    case RunoutUnknowns::eccentricity:
      return "an eccentricity";
    case RunoutUnknowns::both:
      return "an eccentricity and radial offsets";
  }
  return {};
}

/// Whether a runout is one that a tool can have: no tooth is shorter by what the others
/// feed in a turn, nor the eccentricity larger, and each of both is known.
bool plausible(const Fit& fit, std::span<const Run> runs) {
  const auto& offsets = fit.runout.radial_offsets;
  double most = 0.0;
  for (const Run& run : runs) most = std::max(most, run.cut.f_z);
  most *= static_cast<double>(std::max<std::size_t>(1, offsets.size() - 1));
  const auto [low, high] = std::ranges::minmax_element(offsets);
  const bool both = fit.options.runout == RunoutUnknowns::both;
  return fit.ok && *high - *low <= most && fit.runout.eccentricity <= most &&
         (!both || fit.eccentricity_se);
}

/// Whether offsets and eccentricity differ enough along the edges to be told apart.
bool both_show(const force::Setup& setup, std::span<const Run> runs) {
  constexpr double least_lag = 30.0 * unit::deg;
  double a_p = 0.0;
  for (const Run& run : runs) a_p = std::max(a_p, run.cut.a_p);
  const geometry::Cutter& cutter = setup.cutter;
  return 2.0 * a_p * std::tan(std::abs(cutter.helix)) / cutter.lag_diameter > least_lag;
}

/// Fits of one record in several forms, and which of them wins.
struct Contest {
  std::span<const Run> runs;
  int teeth = 1;
  std::vector<Fit> fits = {};  ///< the first: to be beaten

  [[nodiscard]] std::size_t winner() const {
    std::size_t best = 0;
    for (std::size_t i = 1; i < fits.size(); ++i) {
      if (plausible(fits[i], runs) && clearly_better(fits[i], fits[best], runs, teeth))
        best = i;
    }
    return best;
  }

  [[nodiscard]] std::vector<FormTried> tried(std::size_t best) const {
    std::vector<FormTried> out;
    for (const Fit& fit : fits) {
      if (!fit.ok) continue;
      out.push_back(
          {fit.options.runout, fit.rms, better_by(fits[best], fit, runs, teeth)});
    }
    return out;
  }
};

}  // namespace

FormChoice better_runout(const force::Setup& setup, const force::Law& law,
                         std::span<const Run> runs, const Fit& stated) {
  const int teeth = setup.cutter.teeth();
  if (teeth < 2 || !leaves_something(stated, runs)) {
    return {stated,
            fmt::format("{} leave nothing to explain that repeats turn by turn",
                        in_words(stated.options.runout)),
            {{stated.options.runout, stated.rms, 0.0}}};
  }
  Contest contest{runs, teeth, {stated}};
  for (const RunoutUnknowns form :
       {RunoutUnknowns::offsets, RunoutUnknowns::eccentricity, RunoutUnknowns::both}) {
    if (form == stated.options.runout) continue;
    if (form == RunoutUnknowns::both && !both_show(setup, runs)) continue;
    if (stated.options.stop.wanted()) break;
    const Fit& like = contest.fits[contest.winner()];
    contest.fits.push_back(fit_with(setup, law, runs, like, form));
  }
  const std::size_t best = contest.winner();
  FormChoice out{contest.fits[best], "", contest.tried(best)};
  if (best == 0) {
    out.why = fmt::format("no other form explains clearly more than {}",
                          in_words(stated.options.runout));
  } else {
    out.why = fmt::format(
        "{} leave{} {:.3g} N (rms), {} {:.3g} N", in_words(out.fit.options.runout),
        out.fit.options.runout == RunoutUnknowns::eccentricity ? "s" : "", out.fit.rms,
        in_words(stated.options.runout), stated.rms);
  }
  return out;
}

FormChoice choose_runout(const force::Setup& setup, const force::Law& law,
                         std::span<const Run> runs, const Fit& offsets) {
  FormChoice out = better_runout(setup, law, runs, offsets);
  if (out.fit.options.runout != RunoutUnknowns::offsets) return out;
  const std::optional<double> bound = bound_of_none(offsets);
  double f_z = INFINITY;
  for (const Run& run : runs) f_z = std::min(f_z, run.cut.f_z);
  if (!bound || setup.cutter.teeth() < 2 || *bound > small_part * f_z) {
    return out;
  }
  const Fit none = fit_with(setup, law, runs, offsets, RunoutUnknowns::none);
  if (!none.ok) return out;
  out.fit = none;
  out.why = fmt::format("none is seen: the teeth differ by less than {:.2g} um (95 %)",
                        *bound / unit::um);
  out.tried.push_back({RunoutUnknowns::none, none.rms, 0.0});
  return out;
}

}  // namespace trochoid::identification
