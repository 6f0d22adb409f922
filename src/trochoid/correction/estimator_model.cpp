#include <trochoid/correction/estimator_model.h>

#include <trochoid/base/units.h>
#include <trochoid/correction/learning.h>

#include <algorithm>
#include <cmath>

namespace trochoid::correction {

namespace {

constexpr double model_difference = 0.2e-6;  ///< of waves and offsets [m]

std::vector<double> differences(const std::vector<Flute>& flutes) {
  std::vector<double> v;
  double mean = 0.0;
  for (const Flute& f : flutes) {
    v.push_back(f.peak_y);
    mean += f.peak_y / static_cast<double>(flutes.size());
  }
  for (double& x : v) {
    x = mean > 0 ? x / mean - 1 : 0.0;  // L-9
  }
  return v;
}

/// Two motions of the table at once.
Harmonics sum_of(Harmonics a, const Harmonics& b) {
  a.c.resize(std::max(a.c.size(), b.c.size()));
  for (std::size_t n = 0; n < b.c.size(); ++n) {
    a.c[n] += b.c[n];
  }
  return a;
}

/// What one wave of the command makes of the table.
Harmonics table_of_wave(const Setting& s, int k, double amplitude) {
  Harmonics wave;
  wave.c.resize(static_cast<std::size_t>(k / 2) + 1);
  wave.c.back() = k % 2 == 0 ? std::complex<double>(amplitude, 0.0)
                             : std::complex<double>(0.0, -amplitude);
  return table_response(s.cut.plant, wave, s.cut.setup.cut.Omega, table_harmonics);
}

RigidCut cut_with(const Setting& s, const std::vector<double>& rho) {
  force::Setup setup = s.cut.setup;
  setup.runout = {.radial_offsets = rho};
  return {setup, s.cut.law, s.cut.slices};
}

void set_windows(const RigidCut& cut, TrochoidEstimatorConfig& config) {
  const double middle = (cut.arc().from + cut.arc().to) / 2;
  for (std::size_t j = 0; j < cut.psi().size(); ++j) {
    const double before = cut.pitch()[(j + cut.psi().size() - 1) % cut.psi().size()];
    config.start_rev[j] = (cut.psi()[j] + middle - before / 2) / unit::turn;
  }
}

}  // namespace

std::optional<TrochoidEstimatorConfig> estimator_for(const Setting& s,
                                                     const PeriodicMotion& around) {
  const RigidCut cut = cut_with(s, s.rho);
  if (cut.teeth() > TROCHOID_ESTIMATOR_TEETH) {
    return std::nullopt;
  }
  TrochoidEstimatorConfig config;
  trochoid_estimator_defaults(&config);
  const double rps = s.cut.setup.cut.Omega / unit::turn;
  config.teeth = cut.teeth();
  const int allowed =
      static_cast<int>(most_frequency(s.limits, s.cut.plant) / rps * (1 + 1e-12));
  config.harmonics = std::clamp(std::min(allowed, std::max(2, config.teeth - 1)), 1,
                                static_cast<int>(TROCHOID_WAVE_HARMONICS));
  config.most_m = (s.limits.stroke_high - s.limits.stroke_low) / 2;
  config.step_m = config.most_m / 2;
  config.wait_turns = 1 + static_cast<int32_t>(settling_time(s.cut.plant) * rps);
  set_windows(cut, config);
  const Harmonics base = harmonics_of(around, table_harmonics / 3);
  for (int k = 0; k < 2 * config.harmonics; ++k) {
    const auto with = [&](double amplitude) {
      return differences(cut.peaks(sum_of(base, table_of_wave(s, k, amplitude))));
    };
    const auto up = with(model_difference);
    const auto down = with(-model_difference);
    for (std::size_t j = 0; j < up.size(); ++j) {
      config.wave_model[j][k] = (up[j] - down[j]) / (2 * model_difference);
    }
  }
  for (std::size_t i = 0; i < s.rho.size(); ++i) {
    const auto with = [&](double more) {
      std::vector<double> rho = s.rho;
      rho[i] += more;
      return differences(cut_with(s, rho).peaks(base));
    };
    const auto up = with(model_difference);
    const auto down = with(-model_difference);
    for (std::size_t j = 0; j < up.size(); ++j) {
      config.runout_model[j][i] = (up[j] - down[j]) / (2 * model_difference);
    }
  }
  return config;
}

}  // namespace trochoid::correction
