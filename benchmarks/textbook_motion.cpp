#include "textbook_motion.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace trochoid::benchmarks {

namespace {

constexpr double pi = std::numbers::pi;

class Cut {
 public:
  Cut(const dynamics::MotionProblem& p, int steps, int slices)
      : p_(p),
        law_(std::get<force::Power>(p.law)),
        steps_(steps),
        slices_(slices),
        teeth_(p.setup.cutter.teeth()),
        dt_(2 * pi / p.setup.cut.Omega / teeth_ / steps) {
    const auto total = static_cast<std::size_t>(steps) *
                       static_cast<std::size_t>(teeth_ * (p.revolutions + 2));
    q_.assign(total + 1, {0.0, 0.0});
    first_ = static_cast<std::size_t>(2 * teeth_ * steps);
    z_.assign(2 * p.system.modes.size() + 2, 0.0);
  }

  TextbookMotion run() {
    const int total = steps_ * teeth_ * p_.revolutions;
    for (int i = 0; i < total; ++i) {
      step(i);
    }
    return {z_, peak_};
  }

 private:
  using State = std::vector<double>;

  [[nodiscard]] std::array<double, 2> relative(const State& z) const {
    std::array<double, 2> q{};
    for (std::size_t r = 0; r < p_.system.modes.size(); ++r) {
      q[0] += p_.system.modes[r].x * z[2 * r];
      q[1] += p_.system.modes[r].y * z[2 * r];
    }
    return q;
  }

  /// At a time given in steps.
  [[nodiscard]] std::array<double, 2> past(double at) const {
    const double floor = std::floor(at);
    const auto i = static_cast<std::size_t>(static_cast<double>(first_) + floor);
    const double t = at - floor;
    const auto& a = q_[i];
    const auto& b = q_[i + 1];
    return {a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])};
  }

  [[nodiscard]] std::array<double, 2> force(double at, const State& z) const {
    const auto q = relative(z);
    const auto& rho = p_.setup.runout.radial_offsets;
    const double f = p_.setup.cut.f_z;
    const double width = p_.setup.cut.a_p / slices_;
    std::array<double, 2> F{};
    for (int j = 0; j < teeth_; ++j) {
      for (int s = 0; s < slices_; ++s) {
        const double height = (s + 0.5) * width;
        const double lag =
            2 * height * std::tan(p_.setup.cutter.helix) / p_.setup.cutter.profile.D;
        const double theta =
            std::fmod(2 * pi * (at / steps_ - j) / teeth_ - lag + 8 * pi, 2 * pi);
        if (theta >= pi) {
          continue;
        }
        const double sine = std::sin(theta);
        const double cosine = std::cos(theta);
        double h = 1.0;
        for (int m = 1; m <= 2 * teeth_; ++m) {
          const auto old = past(at - m * steps_);
          const int before = ((j - m) % teeth_ + teeth_) % teeth_;
          h = std::min(h, m * f * sine + rho[static_cast<std::size_t>(j)] -
                              rho[static_cast<std::size_t>(before)] +
                              (q[0] - old[0]) * sine + (q[1] - old[1]) * cosine);
        }
        if (h > 0) {
          const double tangential =
              law_.K_t1 * 1e-3 * width * std::pow(h / 1e-3, 1 - law_.m_t);
          const double radial =
              law_.K_r1 * 1e-3 * width * std::pow(h / 1e-3, 1 - law_.m_r);
          F[0] -= tangential * cosine + radial * sine;
          F[1] += tangential * sine - radial * cosine;
        }
      }
    }
    return F;
  }

  [[nodiscard]] State rate(double at, const State& z) const {
    const auto F = force(at, z);
    const auto& modes = p_.system.modes;
    const auto& drive = *p_.drive;
    State out(z.size());
    const std::size_t a = 2 * modes.size();
    for (std::size_t r = 0; r < modes.size(); ++r) {
      const auto& m = modes[r];
      double load =
          m.x * F[0] + m.y * F[1] - m.damping * z[2 * r + 1] - m.stiffness * z[2 * r];
      if (r == drive.mode) {
        load += drive.k_s * z[a] + drive.c_s * z[a + 1];
      }
      out[2 * r] = z[2 * r + 1];
      out[2 * r + 1] = load / m.mass;
    }
    const double command = p_.command ? p_.command(at * dt_) : 0.0;
    out[a] = z[a + 1];
    out[a + 1] = (command - drive.a_0 * z[a] - drive.a_1 * z[a + 1]) / drive.a_2;
    return out;
  }

  void step(int i) {
    const auto moved = [&](const State& k, double by) {
      State z = z_;
      for (std::size_t n = 0; n < z.size(); ++n) {
        z[n] += by * dt_ * k[n];
      }
      return z;
    };
    const State k_1 = rate(i, z_);
    const State k_2 = rate(i + 0.5, moved(k_1, 0.5));
    const State k_3 = rate(i + 0.5, moved(k_2, 0.5));
    const State k_4 = rate(i + 1, moved(k_3, 1.0));
    for (std::size_t n = 0; n < z_.size(); ++n) {
      z_[n] += dt_ / 6 * (k_1[n] + 2 * k_2[n] + 2 * k_3[n] + k_4[n]);
    }
    q_[first_ + static_cast<std::size_t>(i) + 1] = relative(z_);
    if (i >= steps_ * teeth_ * (p_.revolutions - 1)) {
      const auto F = force(i + 1, z_);
      peak_ = std::max(peak_, std::hypot(F[0], F[1]));
    }
  }

  const dynamics::MotionProblem& p_;
  force::Power law_;
  int steps_;
  int slices_;
  int teeth_;
  double dt_;
  std::size_t first_ = 0;
  std::vector<std::array<double, 2>> q_;
  State z_;
  double peak_ = 0.0;
};

}  // namespace

TextbookMotion textbook_motion(const dynamics::MotionProblem& problem,
                               int steps_per_tooth, int slices) {
  return Cut(problem, steps_per_tooth, slices).run();
}

}  // namespace trochoid::benchmarks
