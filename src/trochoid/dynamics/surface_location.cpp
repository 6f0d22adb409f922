#include <trochoid/dynamics/surface_location.h>

#include <trochoid/base/units.h>
#include <trochoid/geometry/edge.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace trochoid::dynamics {

namespace {

/// q_y over the last revolution, which the motion repeats.
class LastTurn {
 public:
  LastTurn(const MotionProblem& problem, const Motion& m)
      : spacing_(unit::turn / problem.samples_per_rev),
        dt_(spacing_ / problem.setup.cut.Omega) {
    const auto count = static_cast<std::size_t>(problem.samples_per_rev);
    if (m.time.size() < count) {
      throw std::invalid_argument("surface_location needs a revolution of the motion");
    }
    const std::size_t first = m.time.size() - count;
    first_ = m.angle[first];
    y_.assign(count, 0.0);
    speed_.assign(count, 0.0);
    for (std::size_t r = 0; r < problem.system.modes.size(); ++r) {
      const double along = problem.system.modes[r].y;
      for (std::size_t i = 0; i < count; ++i) {
        y_[i] += along * m.mode[r][first + i];
        speed_[i] += along * m.speed[r][first + i];
      }
    }
  }

  /// Cubic between the samples, from places and speeds.
  [[nodiscard]] double at(double phi) const {
    const double u =
        std::fmod(std::fmod(phi - first_, unit::turn) + unit::turn, unit::turn) /
        spacing_;
    const auto i = static_cast<std::size_t>(u) % y_.size();
    const std::size_t k = (i + 1) % y_.size();
    const double t = u - std::floor(u);
    const double s = 1 - t;
    return s * s * (1 + 2 * t) * y_[i] + t * t * (3 - 2 * t) * y_[k] +
           t * s * dt_ * (s * speed_[i] - t * speed_[k]);
  }

 private:
  double spacing_ = 0.0;
  double dt_ = 0.0;
  double first_ = 0.0;
  std::vector<double> y_;
  std::vector<double> speed_;
};

}  // namespace

std::vector<double> wall_heights(const force::Setup& setup) {
  constexpr int steps = 10;
  std::vector<double> heights = {0.0};
  for (int i = 1; setup.cutter.helix != 0 && i <= steps; ++i) {
    heights.push_back(setup.cut.a_p * i / steps);
  }
  return heights;
}

std::vector<WallLocation> surface_location(const MotionProblem& problem,
                                           const Motion& m,
                                           const std::vector<double>& heights) {
  const LastTurn motion(problem, m);
  const geometry::Cutter& cutter = problem.setup.cutter;
  const double R = cutter.profile.D / 2;  // a cylinder
  const geometry::Band stock =
      geometry::stock_band(problem.setup.cut.engagement, 2 * R);
  const auto& offsets = problem.setup.runout.radial_offsets;
  const double lag_per_height = 2 * std::tan(cutter.helix) / cutter.lag_diameter;
  std::vector<WallLocation> walls;
  for (const int sigma : {-1, 1}) {
    const bool there = sigma < 0 ? stock.y_hi >= R : stock.y_lo <= -R;
    for (const double z : there ? heights : std::vector<double>{}) {
      WallLocation wall{.sigma = sigma, .height = z};
      const double lag = lag_per_height * z;
      double psi = 0.0;
      for (std::size_t j = 0; j < cutter.pitch.size(); ++j) {
        const double r = R + (offsets.empty() ? 0.0 : offsets[j]);
        const auto edge = geometry::edge_position(
            problem.setup.runout, r, psi + lag - problem.setup.runout.angle);
        const double theta = (sigma < 0 ? 0.0 : unit::turn / 2) - edge.epsilon;
        const double q_y = motion.at(theta + psi + lag);
        wall.teeth.push_back(R - edge.R + sigma * q_y);  // T-10
        psi += cutter.pitch[j];
      }
      wall.remains = *std::min_element(wall.teeth.begin(), wall.teeth.end());
      walls.push_back(std::move(wall));
    }
  }
  return walls;
}

}  // namespace trochoid::dynamics
