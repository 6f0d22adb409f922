#include <trochoid/identification/match_phase.h>

#include <trochoid/base/units.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace trochoid::identification {

namespace {

using Forces = std::vector<force::Vector3>;

/// Computed forces of a run whose angle of tooth 1 is the recorded angle plus a phase.
class PhasedForces {
 public:
  PhasedForces(const force::Setup& setup, const force::Law& law, const Run& run,
               double tolerance)
      : setup_(setup), law_(law), run_(run), tolerance_(tolerance) {
    setup_.cut = run.cut;
  }

  /// @param stride  every how many samples are looked at
  [[nodiscard]] Forces at(double phase, std::size_t stride = 1) const {
    std::vector<double> phi;
    for (std::size_t i = 0; i < run_.angle.size(); i += stride) {
      phi.push_back(run_.angle[i] + phase);
    }
    return force::forces(setup_, law_, phi, tolerance_);
  }

  [[nodiscard]] double misfit(double phase, std::size_t stride) const {
    const Forces forces = at(phase, stride);
    double sum = 0.0;
    for (std::size_t i = 0; i < forces.size(); ++i) {
      for (std::size_t q = 0; q < 3; ++q) {
        const double d = run_.force[i * stride][q] - forces[i][q];
        sum += d * d;
      }
    }
    return sum;
  }

 private:
  force::Setup setup_;
  force::Law law_;
  const Run& run_;
  double tolerance_;
};

double best_phase(const PhasedForces& forces, std::size_t samples) {
  constexpr int steps = 72;
  const std::size_t stride = std::max<std::size_t>(1, samples / 180);
  double best = 0.0;
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < steps; ++i) {
    const double phase = -unit::turn / 2 + unit::turn * i / steps;
    const double misfit = forces.misfit(phase, stride);
    if (misfit < least) {
      least = misfit;
      best = phase;
    }
  }
  double lo = best - unit::turn / steps;
  double hi = best + unit::turn / steps;
  constexpr double golden = 0.6180339887498949;
  for (int i = 0; i < 30; ++i) {
    const double a = hi - golden * (hi - lo);
    const double b = lo + golden * (hi - lo);
    const bool right = forces.misfit(a, 1) > forces.misfit(b, 1);
    (right ? lo : hi) = right ? a : b;
  }
  return 0.5 * (lo + hi);
}

}  // namespace

PhaseMatch match_phase(const force::Setup& setup, const force::Law& law, const Run& run,
                       const std::optional<double>& phase, double tolerance) {
  const PhasedForces forces(setup, law, run, tolerance);
  PhaseMatch match;
  match.phase = phase ? *phase : best_phase(forces, run.angle.size());
  match.computed = forces.at(match.phase);
  const double n = static_cast<double>(run.force.size());
  double size = 0.0;
  for (std::size_t i = 0; i < run.force.size(); ++i) {
    for (std::size_t q = 0; q < 3; ++q) {
      const double d = run.force[i][q] - match.computed[i][q];
      match.rms_axis[q] += d * d / n;
      size += run.force[i][q] * run.force[i][q] / n;
    }
  }
  match.rms = std::sqrt(match.rms_axis[0] + match.rms_axis[1] + match.rms_axis[2]);
  for (double& value : match.rms_axis) {
    value = std::sqrt(value);
  }
  match.measured_rms = std::sqrt(size);
  return match;
}

}  // namespace trochoid::identification
