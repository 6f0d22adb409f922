#include <trochoid/run/fit_warnings.h>

#include <trochoid/base/units.h>
#include <trochoid/run/coefficient_names.h>
#include <trochoid/run/fit_answer.h>
#include <trochoid/signal/band.h>

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace trochoid::run {

namespace {

using identification::Fit;
using identification::Run;
using Warnings = std::vector<base::Warning>;

/// Neighbouring residuals that agree more than this are not white noise.
constexpr double much_correlation = 0.3;
/// Part of the force that may lie above the harmonics that a rigid tool makes.
constexpr double much_ringing = 0.2;

void warn_correlation(const Fit& chosen, Warnings& warnings) {
  const double r = chosen.residual_correlation;
  if (r > much_correlation) {
    warnings.push_back(
        {"correlated_residuals",
         fmt::format("What the fit leaves is not noise: neighbouring samples agree "
                     "(correlation {:.2f}). The standard errors assume white noise; "
                     "multiply them by about {:.1f}.",
                     r, std::sqrt((1 + r) / (1 - std::min(r, 0.999))))});
  }
}

void warn_unidentifiable(const Fit& chosen, Warnings& warnings) {
  for (const auto& [what, why] : chosen.unidentifiable) {
    warnings.push_back({"not_identifiable", fmt::format("{}: {}", what, why)});
  }
}

void warn_signs(const Fit& chosen, Warnings& warnings) {
  const auto names = coefficient_names(chosen.law);
  for (std::size_t q = 0; q < chosen.coefficients.size(); ++q) {
    const auto& K = chosen.coefficients[q];
    const bool along_the_axis = q % 3 == 2;  // may pull either way
    if (K && K->high < 0 && !along_the_axis) {
      warnings.push_back(
          {"negative_coefficient",
           fmt::format("{} came out negative, which no cut does: check the axes of the "
                       "dynamometer and the sense of rotation.",
                       names[q].key)});
    }
  }
}

/// What the band leaves out, as a part of the force.
void warn_ringing(const inputs::Case& given, std::span<const Run> runs,
                  const Fit& chosen, Warnings& warnings) {
  const int band = given.identify.band_harmonics;
  double left_out = 0.0;
  double all = 0.0;
  for (std::size_t r = 0; r < runs.size(); ++r) {
    for (std::size_t q = 0; q < 3; ++q) {
      std::vector<double> difference(runs[r].angle.size());
      for (std::size_t i = 0; i < difference.size(); ++i) {
        difference[i] = runs[r].force[i][q] - chosen.fitted[r][i][q];
        all += runs[r].force[i][q] * runs[r].force[i][q];
      }
      for (const double d : difference) {
        left_out += d * d;
      }
      if (band > 0) {
        for (const double d : signal::Band(runs[r].angle, band).project(difference)) {
          left_out -= d * d;
        }
      }
    }
  }
  const double part = std::sqrt(std::max(0.0, left_out) / std::max(all, 1e-300));
  if (part <= much_ringing) {
    return;
  }
  if (band > 0) {
    warnings.push_back(
        {"outside_the_band",
         fmt::format(
             "{:.0f} % of the force (rms) lies outside the mean and the first {} "
             "harmonics and is not explained: a ringing dynamometer, chatter or "
             "noise.",
             100 * part, band)});
  } else {
    warnings.push_back(
        {"poor_fit",
         fmt::format("{:.0f} % of the force (rms) is not explained. If the dynamometer "
                     "rings, a fit of every harmonic is confidently wrong: try "
                     "band_harmonics = {} in [identify].",
                     100 * part, given.setup.cutter.teeth())});
  }
}

void warn_freedom(const Fit& chosen, Warnings& warnings) {
  if (chosen.freedom < 10) {
    warnings.push_back(
        {"few_equations",
         fmt::format("Only {:g} equations more than unknowns: the standard errors "
                     "themselves are uncertain.",
                     chosen.freedom)});
  }
}

void warn_other_model(std::span<const Fit> fits, const Fit& chosen,
                      Warnings& warnings) {
  for (const Fit& fit : fits) {
    if (fit.ok && fit.rms < 0.95 * chosen.rms) {
      warnings.push_back(
          {"other_model_fits_better",
           fmt::format("The {} chip model fits better ({:.2f} N against {:.2f} N) than "
                       "the {} one, though it is less exact: something else than the "
                       "chip shapes this record.",
                       model_name(fit.chip.model), fit.rms, chosen.rms,
                       model_name(chosen.chip.model))});
    }
  }
}

void warn_large_runout(const inputs::Case& given, const Fit& chosen,
                       Warnings& warnings) {
  const auto& offsets = chosen.runout.radial_offsets;
  if (offsets.empty() || chosen.chip.model == chip::Model::none) {
    return;
  }
  const auto [lo, hi] = std::minmax_element(offsets.begin(), offsets.end());
  if (*hi - *lo > given.setup.cut.f_z && given.setup.cut.f_z > 0) {
    warnings.push_back(
        {"runout_above_feed",
         fmt::format("The teeth differ by {:.1f} um, more than the feed per tooth: a "
                     "tooth may cut nothing.",
                     (*hi - *lo) / unit::um)});
  }
}

}  // namespace

void add_fit_warnings(const inputs::Case& given, std::span<const Run> runs,
                      std::span<const Fit> fits, const Fit& chosen,
                      Warnings& warnings) {
  for (const Fit& fit : fits) {
    if (!fit.ok) {
      warnings.push_back(
          {"no_fit",
           fmt::format("chip model {}: {}", model_name(fit.chip.model), fit.message)});
    }
  }
  warn_unidentifiable(chosen, warnings);
  warn_signs(chosen, warnings);
  warn_correlation(chosen, warnings);
  warn_ringing(given, runs, chosen, warnings);
  warn_freedom(chosen, warnings);
  warn_other_model(fits, chosen, warnings);
  warn_large_runout(given, chosen, warnings);
}

}  // namespace trochoid::run
