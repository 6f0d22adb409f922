#include <trochoid/dynamics/cut_force.h>

#include <trochoid/chip/chip.h>
#include <trochoid/force/columns.h>

#include <cmath>
#include <limits>

namespace trochoid::dynamics {

namespace {

struct LocalForce {
  double t = 0.0;
  double r = 0.0;
  double a = 0.0;
};

LocalForce local_force(const force::LinearEdge& law, const Contact& c,
                       double h) noexcept {
  return {law.K_tc * h * c.width + law.K_te * c.edge,
          law.K_rc * h * c.width + law.K_re * c.edge,
          law.K_ac * h * c.width + law.K_ae * c.edge};
}

LocalForce local_force(const force::Power& law, const Contact& c, double h) noexcept {
  const double u = h / force::h_0;
  const double w = force::h_0 * c.width;
  const double t = std::pow(u, 1 - law.m_t);
  const double r = law.m_r == law.m_t ? t : std::pow(u, 1 - law.m_r);
  const double a = law.K_a1 == 0 ? 0.0 : std::pow(u, 1 - law.m_a);
  return {law.K_t1 * w * t, law.K_r1 * w * r, law.K_a1 * w * a};
}

}  // namespace

CutForce::CutForce(const force::Law& law, const EngagedGrid& grid)
    : law_(law), grid_(grid) {}

void CutForce::prepare(const Contacts& contacts, const History& past) {
  contacts_ = contacts;
  constant_.resize(contacts.last - contacts.first);
  const auto nodes = static_cast<std::ptrdiff_t>(grid_.nodes);
  for (std::size_t i = contacts.first; i < contacts.last; ++i) {
    const Contact& c = grid_.contacts[i];
    const double* above = grid_.above.data() + c.marks;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t m = 0; m < grid_.lookback; ++m) {
      const auto back = -static_cast<std::ptrdiff_t>(m + 1) * nodes;
      least =
          std::min(least, above[m] - past.x[back] * c.sine - past.y[back] * c.cosine);
    }
    constant_[i - contacts.first] = least;  // T-1
  }
}

std::array<double, 3> CutForce::force(double q_x, double q_y) const noexcept {
  std::array<double, 3> F{};
  std::visit(
      [&](const auto& law) {
        for (std::size_t i = contacts_.first; i < contacts_.last; ++i) {
          const Contact& c = grid_.contacts[i];
          const double h =
              constant_[i - contacts_.first] + q_x * c.sine + q_y * c.cosine;
          if (!(h > chip::h_threshold)) {
            continue;
          }
          const LocalForce f = local_force(law, c, h);
          F[0] -= f.t * c.cosine + f.r * c.sine;
          F[1] += f.t * c.sine - f.r * c.cosine;
          F[2] -= f.a;
        }
      },
      law_);
  return F;
}

std::vector<std::pair<std::size_t, double>> CutForce::chips(double q_x,
                                                            double q_y) const {
  std::vector<std::pair<std::size_t, double>> chips;
  std::vector<bool> seen;
  for (std::size_t i = contacts_.first; i < contacts_.last; ++i) {
    const Contact& c = grid_.contacts[i];
    seen.resize(std::max(seen.size(), c.tooth + 1));
    if (!seen[c.tooth]) {  // the lowest slice comes first
      const double h = constant_[i - contacts_.first] + q_x * c.sine + q_y * c.cosine;
      chips.emplace_back(c.tooth, std::max(0.0, h));
      seen[c.tooth] = true;
    }
  }
  return chips;
}

}  // namespace trochoid::dynamics
