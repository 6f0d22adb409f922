#include <trochoid/run/identify/fits.h>

#include <trochoid/identification/runout_form.h>
#include <trochoid/run/identify/fit_options.h>

#include <fmt/core.h>

#include <algorithm>
#include <utility>

namespace trochoid::run {

namespace {

using identification::Fit;
using identification::Options;
using identification::RunoutUnknowns;

/// The model that decides: the trochoidal one where it is asked for, else the last.
std::size_t deciding(const std::vector<chip::Model>& models) {
  const auto at = std::find(models.begin(), models.end(), chip::Model::trochoidal);
  return at != models.end() ? static_cast<std::size_t>(at - models.begin())
                            : models.size() - 1;
}

/// Whether band and resonance are left to the records.
bool view_is_open(const inputs::Case& given) {
  return !given.identify.band_harmonics &&
         !(given.dynamometer && given.dynamometer->rigid);
}

Fit first_fit(const inputs::Case& given, std::span<const identification::Run> runs,
              Options options, Fits& out) {
  if (!options.response.empty()) {
    // Where to search is told well enough by a rigid dynamometer.
    Options rigid = options;
    rigid.response.clear();
    const Fit near = identification::identify(given.setup, given.law, runs, rigid);
    if (near.ok) options.start = identification::Start{near.runout, near.phase};
    return identification::identify(given.setup, given.law, runs, options);
  }
  if (!view_is_open(given)) {
    return identification::identify(given.setup, given.law, runs, options);
  }
  identification::Viewed seen =
      identification::fit_as_seen(given.setup, given.law, runs, options);
  out.views = std::move(seen.views);
  return std::move(seen.fit);
}

/// With the form of the runout that the records decide for, or a word on a better one than
/// the one asked for.
Fit decided(const inputs::Case& given, std::span<const identification::Run> runs,
            Fit fit, Fits& out) {
  const auto& asked = given.identify.runout;
  const bool searched = !asked || *asked == RunoutUnknowns::offsets ||
                        *asked == RunoutUnknowns::eccentricity;
  if (!fit.ok || !chip::feels_runout(fit.chip.model) || !searched) return fit;
  identification::FormChoice choice =
      asked ? identification::better_runout(given.setup, given.law, runs, fit)
            : identification::choose_runout(given.setup, given.law, runs, fit);
  out.runout_form = {fit.options.runout, choice.fit.options.runout, asked.has_value(),
                     std::move(choice.why), std::move(choice.tried)};
  return asked ? fit : std::move(choice.fit);
}

/// There was no time for this one.
Fit not_fitted(const Fit& other, chip::Model model, const base::Stop& stop) {
  Fit fit;
  fit.options = other.options;
  fit.options.chip_model = model;
  fit.chip = {model, other.chip.lookback};
  fit.law = other.law;
  fit.coefficients.resize(other.coefficients.size());
  fit.measured = other.measured;
  fit.message = fmt::format("not fitted: {}", why_ended(stop));
  for (const force::Quantity& coefficient : force::coefficient_quantities(fit.law)) {
    fit.unidentifiable.emplace_back(coefficient.key, fit.message);
  }
  return fit;
}

}  // namespace

Fits all_fits(const inputs::Case& given, std::span<const identification::Run> runs,
              const Known& known, const Progress& progress, base::Stop stop) {
  const std::vector<chip::Model>& models = given.identify.chip_models;
  Fits out;
  out.fits.resize(models.size());
  const std::size_t first = deciding(models);
  Options options = fit_options(given, models[first]);
  options.start = known.start;
  options.response = known.response;
  options.stop = stop;
  progress({"fitting, one chip model after the other", 0.0});
  out.fits[first] = first_fit(given, runs, options, out);
  if (stop.wanted()) {
    out.left_out.emplace_back("the search for another form of the runout");
  } else {
    out.fits[first] = decided(given, runs, std::move(out.fits[first]), out);
  }
  const Options found = out.fits[first].options;
  double done = 1.0;
  for (std::size_t i = 0; i < models.size(); ++i) {
    if (i == first) continue;
    if (stop.wanted()) {
      out.fits[i] = not_fitted(out.fits[first], models[i], stop);
      out.left_out.push_back(fmt::format("chip model {}", chip::name_of(models[i])));
      continue;
    }
    progress({"fitting, one chip model after the other",
              done / static_cast<double>(models.size())});
    options = found;
    options.chip_model = models[i];
    options.start = found.response.empty()
                        ? known.start
                        : std::optional(identification::Start{out.fits[first].runout,
                                                              out.fits[first].phase});
    out.fits[i] = identification::identify(given.setup, given.law, runs, options);
    done += 1.0;
  }
  return out;
}

std::string why_ended(const base::Stop& stop) {
  return stop.spent() ? "these records take much work" : "the time was up";
}

std::optional<std::size_t> chosen_fit(const std::vector<Fit>& fits) {
  std::optional<std::size_t> best;
  for (std::size_t i = 0; i < fits.size(); ++i) {
    if (!fits[i].ok) {
      continue;
    }
    if (fits[i].chip.model == chip::Model::trochoidal) {
      return i;
    }
    if (!best || fits[i].rms < fits[*best].rms) {
      best = i;
    }
  }
  return best;
}

}  // namespace trochoid::run
