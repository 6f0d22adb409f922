#include <trochoid/dynamics/element_response.h>

#include <trochoid/dynamics/nodes.h>
#include <trochoid/dynamics/oscillator.h>

#include <array>
#include <optional>
#include <span>

namespace trochoid::dynamics {

namespace {

/// A mode and where it moves the tool.
struct MovingMode {
  const ChipMode& mode;
  std::size_t number = 0;
  const std::array<double, 2>& direction;

  /// What q has of a displacement and a velocity of the mode (D-35).
  [[nodiscard]] double moved(double eta, double velocity) const noexcept {
    return mode.in_phase * eta + mode.lead * velocity;
  }
};

/// @param count  components of q
void add_mode(ElementResponse& response, const DrivenMotion& motion,
              const MovingMode& moving, std::size_t count) {
  const std::size_t n = motion.free.size();
  const std::size_t r = moving.number;
  const std::array<double, 2>& direction = moving.direction;
  const std::span<const double> at_end = std::span(motion.eta).last(n);
  const std::span<const double> velocity_at_end = std::span(motion.velocity).last(n);
  const std::size_t state = count * n + 2 * r;
  for (std::size_t c = 0; c < count; ++c) {
    for (std::size_t i = 0; i < n; ++i) {
      const std::array<double, 4>& free = motion.free[i];
      response.motion.column(state)[c * n + i] =
          direction[c] * moving.moved(free[0], free[2]);
      response.motion.column(state + 1)[c * n + i] =
          direction[c] * moving.moved(free[1], free[3]);
      response.end.column(c * n + i)[2 * r] = direction[c] * at_end[i];
      response.end.column(c * n + i)[2 * r + 1] = direction[c] * velocity_at_end[i];
    }
    for (std::size_t b = 0; b < count; ++b) {
      const double factor = direction[c] * direction[b];
      for (std::size_t k = 0; k < n && factor != 0; ++k) {
        double* const column = response.motion.column(b * n + k) + c * n;
        for (std::size_t i = 0; i < n; ++i) {
          column[i] +=
              factor * moving.moved(motion.eta[i * n + k], motion.velocity[i * n + k]);
        }
      }
    }
  }
}

}  // namespace

ElementResponse element_response(const std::vector<ChipMode>& modes,
                                 const Components& components, int degree,
                                 double duration) {
  const std::size_t values =
      degree > 0 ? components.count * (static_cast<std::size_t>(degree) + 1) : 0;
  const std::size_t states = 2 * modes.size();
  ElementResponse response{degree, duration,
                           numerics::padded_zeros(values, values + states),
                           numerics::padded_zeros(states, values + states)};
  std::optional<DrivenMotion> motion;
  for (std::size_t r = 0; r < modes.size(); ++r) {
    const bool alike = motion && modes[r].mass == modes[r - 1].mass &&
                       modes[r].damping == modes[r - 1].damping &&
                       modes[r].stiffness == modes[r - 1].stiffness;
    if (!alike && degree > 0) {
      motion = driven_motion(modes[r], degree, duration);
    }
    if (motion) {
      add_mode(response, *motion, {modes[r], r, components.modes[r]}, components.count);
    }
    const auto over = free_motion(modes[r], duration);
    for (std::size_t i = 0; i < 4; ++i) {
      response.end.column(values + 2 * r + i % 2)[2 * r + i / 2] = over[i];
    }
  }
  return response;
}

ElementResponse response_along_normals(const ElementResponse& response,
                                       const PeriodElement& e) {
  const std::size_t n = e.nodes();
  const std::size_t states = response.end.rows;
  ElementResponse out{response.degree, response.duration,
                      numerics::padded_zeros(n, n + states),
                      numerics::padded_zeros(states, n + states)};
  const auto add = [&](std::size_t from, std::size_t to, double factor) {
    const double* const motion = response.motion.column(from);
    const double* const end = response.end.column(from);
    for (std::size_t i = 0; i < n; ++i) {
      out.motion.column(to)[i] +=
          factor * (e.normal[i][0] * motion[i] + e.normal[i][1] * motion[n + i]);
    }
    for (std::size_t i = 0; i < states; ++i) out.end.column(to)[i] += factor * end[i];
  };
  for (std::size_t k = 0; k < n; ++k) {
    add(k, k, e.push[k][0]);  // D-15
    add(n + k, k, e.push[k][1]);
  }
  for (std::size_t r = 0; r < states; ++r) add(2 * n + r, n + r, 1.0);
  return out;
}

namespace {

/// Of work.system the first columns are complete: the right sides follow.
void eliminate(const numerics::PaddedMatrix& given, Elimination& work,
               numerics::PaddedMatrix& motion) {
  numerics::PaddedMatrix& system = work.system;
  system.values.insert(system.values.end(), given.values.begin(), given.values.end());
  work.room.resize(2 * system.columns);
  numerics::eliminate(system, work.room);  // D-11
  const std::span<const double> solved = system.from(given.rows);
  motion.rows = given.rows;
  motion.columns = given.columns;
  motion.values.assign(solved.begin(), solved.end());
}

}  // namespace

void answer_cut(const numerics::PaddedMatrix& given, std::span<const double> matrices,
                double force, Elimination& work, numerics::PaddedMatrix& motion) {
  const std::size_t values = given.rows;
  const std::size_t count = matrices.size() > values ? 2 : 1;
  const std::size_t n = values / count;
  const std::size_t room = numerics::padded(values);
  numerics::PaddedMatrix& system = work.system;
  system.rows = values;
  system.columns = values + given.columns;
  system.values.assign(values * room, 0.0);
  for (std::size_t j = 0; j < values; ++j) {
    double* const column = system.column(j);
    for (std::size_t a = 0; a < count; ++a) {
      const double A = force * matrices[(a * count + j / n) * n + j % n];
      const double* const G = given.column(a * n + j % n);
      for (std::size_t i = 0; i < room; ++i) column[i] -= G[i] * A;
    }
    column[j] += 1.0;
  }
  eliminate(given, work, motion);
}

void answer_damped_cut(const numerics::PaddedMatrix& given,
                       const numerics::PaddedMatrix& whole, double force,
                       Elimination& work, numerics::PaddedMatrix& motion) {
  const std::size_t values = given.rows;
  const std::size_t room = numerics::padded(values);
  numerics::PaddedMatrix& system = work.system;
  system.rows = values;
  system.columns = values + given.columns;
  system.values.assign(values * room, 0.0);
  const std::span<const double> G = std::span(given.values).first(values * room);
  for (std::size_t j = 0; j < values; ++j) {
    const std::span<double> column(system.column(j), room);
    numerics::padded_product(G, {whole.column(j), values}, column);
    for (double& value : column) value *= -force;
    column[j] += 1.0;
  }
  eliminate(given, work, motion);
}

numerics::PaddedMatrix force_on_nodes(const PeriodElement& e) {
  const std::vector<double>& D = e.damping.matrices;
  if (D.empty()) {
    return {};
  }
  const std::size_t n = e.nodes();
  const std::size_t count = D.size() / n > 1 ? 2 : 1;
  const std::vector<double> E = slopes_at_nodes(element_nodes(e.degree));
  const double per_angle = 2 / (e.to - e.from);
  numerics::PaddedMatrix whole = numerics::padded_zeros(count * n, count * n);
  for (std::size_t a = 0; a < count; ++a) {
    for (std::size_t b = 0; b < count; ++b) {
      const std::size_t first = (a * count + b) * n;
      for (std::size_t j = 0; j < n; ++j) {
        double* const column = whole.column(b * n + j) + a * n;
        for (std::size_t i = 0; i < n; ++i) {
          column[i] = D[first + i] * per_angle * E[i * n + j];
        }
        column[j] += e.own.matrices.empty() ? 0.0 : e.own.matrices[first + j];
      }
    }
  }
  return whole;
}

}  // namespace trochoid::dynamics
