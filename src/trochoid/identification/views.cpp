#include <trochoid/identification/views.h>

#include <trochoid/identification/resonance.h>
#include <trochoid/identification/systematic.h>

#include <algorithm>

namespace trochoid::identification {

namespace {

View view_of(const Fit& fit) {
  return {fit.options.band_harmonics, !fit.options.response.empty(),
          fit.coefficients.front(), fit.unexplained.all};
}

/// The means and the runout; these and the teeth; further harmonics of the teeth.
std::vector<int> bands(const force::Setup& setup, std::span<const Run> runs) {
  int resolved = resolved_harmonics(runs.front());
  for (const Run& run : runs) resolved = std::min(resolved, resolved_harmonics(run));
  const int teeth = setup.cutter.teeth();
  std::vector<int> out;
  for (const int n : {teeth - 1, teeth, 2 * teeth, 4 * teeth}) {
    if (n >= 1 && 2 * n <= resolved) out.push_back(n);
  }
  return out;
}

/// A gain or cross talk that explains so much of what repeats is its cause, not a resonance
/// that mimics it. A delay may be left to a resonance that does.
constexpr double explains_most = 0.8;

bool is_sensor_fault(const force::Setup& setup, const force::Law& law,
                     std::span<const Run> runs, const Fit& rigid) {
  const std::vector<SensorFault> faults = systematics(setup, law, runs, rigid).faults;
  return !faults.empty() && faults.front().part > explains_most &&
         faults.front().systematic.kind != SystematicKind::delay;
}

}  // namespace

Viewed fit_as_seen(const force::Setup& setup, const force::Law& law,
                   std::span<const Run> runs, const Options& options) {
  Viewed out{identify(setup, law, runs, options), {}};
  if (!out.fit.ok || options.stop.wanted() || !repeats(runs, out.fit)) return out;
  out.views.push_back(view_of(out.fit));
  Options near = options;
  near.start = Start{out.fit.runout, out.fit.phase, true};
  for (const int n : bands(setup, runs)) {
    if (options.stop.wanted()) return out;
    near.band_harmonics = n;
    if (const Fit fit = identify(setup, law, runs, near); fit.ok) {
      out.views.push_back(view_of(fit));
    }
  }
  auto fit = fit_through_resonance(setup, law, runs, out.fit);
  if (fit && !is_sensor_fault(setup, law, runs, out.fit)) {
    out.views.insert(out.views.begin(), view_of(*fit));
    out.fit = std::move(*fit);
  }
  return out;
}

}  // namespace trochoid::identification
