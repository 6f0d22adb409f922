#include <trochoid/identification/fits.h>

#include <trochoid/identification/resonance.h>

#include <fmt/core.h>

#include <algorithm>
#include <utility>

namespace trochoid::identification {

namespace {

/// What all fits are of.
struct Records {
  const force::Setup& setup;
  const force::Law& law;
  std::span<const Run> runs;

  [[nodiscard]] Fit fit(const Options& options) const {
    return identify(setup, law, runs, options);
  }
};

/// The model that decides: the trochoidal one where it is asked for, else the last.
std::size_t deciding(const std::vector<chip::Model>& models) {
  const auto at = std::find(models.begin(), models.end(), chip::Model::trochoidal);
  return at != models.end() ? static_cast<std::size_t>(at - models.begin())
                            : models.size() - 1;
}

Fit first_fit(const Records& records, const FitRequest& request, Options options,
              Fits& out) {
  if (!options.response.empty()) {
    // Where to search is told well enough by a rigid dynamometer.
    Options rigid = options;
    rigid.response.clear();
    const Fit near = records.fit(rigid);
    if (near.ok) options.start = Start{near.runout, near.phase, true};
    Fit as_given = records.fit(options);
    if (!as_given.ok || request.options.stop.wanted()) return as_given;
    const auto scaled = with_scaled_response(records.runs, as_given.options);
    if (!scaled) return as_given;
    Options about = *scaled;
    about.start = Start{as_given.runout, as_given.phase, true};
    Fit fit = records.fit(about);
    return fit.ok ? fit : as_given;
  }
  if (!request.view_open) {
    return records.fit(options);
  }
  Viewed seen = fit_as_seen(records.setup, records.law, records.runs, options);
  out.views = std::move(seen.views);
  return std::move(seen.fit);
}

/// With the form of the runout that the records decide for, or a word on a better one than
/// the one asked for.
Fit decided(const Records& records, const std::optional<RunoutUnknowns>& asked, Fit fit,
            Fits& out) {
  const bool searched = !asked || *asked == RunoutUnknowns::offsets ||
                        *asked == RunoutUnknowns::eccentricity;
  if (!fit.ok || !chip::feels_runout(fit.chip.model) || !searched) return fit;
  FormChoice choice =
      asked ? better_runout(records.setup, records.law, records.runs, fit)
            : choose_runout(records.setup, records.law, records.runs, fit);
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
  fit.message =
      fmt::format("not fitted: {}",
                  stop.spent() ? "these records take much work" : "the time was up");
  for (const force::Quantity& coefficient : force::coefficient_quantities(fit.law)) {
    fit.unidentifiable.emplace_back(coefficient.key, fit.message);
  }
  return fit;
}

}  // namespace

Fits all_fits(const force::Setup& setup, const force::Law& law,
              std::span<const Run> runs, const FitRequest& request,
              const std::function<void(double)>& told) {
  const Records records{setup, law, runs};
  const std::vector<chip::Model>& models = request.chip_models;
  const base::Stop& stop = request.options.stop;
  const auto tell = [&](double part) {
    if (told) told(part);
  };
  Fits out;
  out.fits.resize(models.size());
  const std::size_t first = deciding(models);
  Options options = request.options;
  options.chip_model = models[first];
  tell(0.0);
  out.fits[first] = first_fit(records, request, options, out);
  if (stop.wanted()) {
    out.left_out.emplace_back("the search for another form of the runout");
  } else {
    out.fits[first] = decided(records, request.runout, std::move(out.fits[first]), out);
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
    tell(done / static_cast<double>(models.size()));
    options = found;
    options.chip_model = models[i];
    options.start =
        found.response.empty()
            ? request.options.start
            : std::optional(Start{out.fits[first].runout, out.fits[first].phase});
    out.fits[i] = records.fit(options);
    done += 1.0;
  }
  return out;
}

std::optional<std::size_t> chosen_fit(std::span<const Fit> fits) {
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

}  // namespace trochoid::identification
