#pragma once

#include <trochoid/chip/chip.h>
#include <trochoid/dynamics/edge_force.h>
#include <trochoid/dynamics/engaged_grid.h>
#include <trochoid/dynamics/near_power.h>
#include <trochoid/force/law.h>
#include <trochoid/force/setup.h>

#include <array>
#include <cstddef>
#include <utility>
#include <vector>

namespace trochoid::dynamics {

using Force = std::array<double, 3>;  ///< on the tool [N]

/// q of the nodes up to now and its slope over the spindle angle; index 0 is the node
/// in question, -n the n-th before.
struct History {
  const double* x = nullptr;
  const double* y = nullptr;
  const double* dx = nullptr;
  const double* dy = nullptr;
};

/// Force, and how it changes with q.
struct Response {
  Force F{};
  std::array<double, 6> per_q{};  ///< dF/dq, rows x, y, z; columns x, y [N/m]
  /// dF/d(dq/dt) of process damping, rows x, y; columns x, y [N s/m].
  std::array<double, 4> per_speed{};
};

/// A place where the force jumps while a tooth leaves the cut or comes back.
struct Crossing {
  double part = 0.0;  ///< of the step
  Force jump{};       ///< after minus before [N]
};

/// @brief Process damping as a law over the speed into the work.
///
/// @eq T-16 B = sum over the points in cut of [B]_xy (mu, 1, 0)^T n^T c w / (R Omega),
///          c = K_sp L_w^2 / 2
/// @src derived: F-16 at the speed of the cut
/// @param setup  a cylinder that turns
/// @return its K of t, r, a [N s/m^2]
force::Terms flank_terms(const force::Setup& setup) noexcept;

/// @brief Force of the contacts of a node, whatever q is at that moment.
///
/// The marks of earlier teeth are met once a step: h = constant + q . n for each point.
class CutForce {
 public:
  /// @param grid   outlives this
  /// @param flank  force on the flank [N s/m^2], of flank_terms; none: nothing damps
  CutForce(const force::Law& law, const EngagedGrid& grid,
           const force::Terms& flank = {});

  /// @brief Meet the marks: the chips of these contacts are then known but for q.
  /// @param node  whose delays these are
  void prepare(std::size_t node, const Contacts& contacts,
               const History& past) noexcept {
    contacts_ = contacts;
    if (grid_.one_point && grid_.delays.empty()) {
      prepare_points(past);
    } else {
      prepare_edges(node, past);
    }
  }

  /// For the contacts prepared.
  [[nodiscard]] Response response(double q_x, double q_y) noexcept {
    if (grid_.one_point) {
      return point_response(q_x, q_y);
    }
    return edge_response(q_x, q_y);
  }

  /// @brief The same with process damping, at the speed v = dq/dt [m/s].
  [[nodiscard]] Response response(const std::array<double, 2>& q,
                                  const std::array<double, 2>& v) noexcept {
    Response out = response(q[0], q[1]);
    if (damps_) {
      add_damping(q, v, out);
    }
    return out;
  }
  /// Is there process damping?
  [[nodiscard]] bool damps() const noexcept { return damps_; }

  /// @return tooth and chip [m] of the lowest point
  /// of each tooth; negative: off the work
  [[nodiscard]] std::vector<std::pair<std::size_t, double>> chips(double q_x,
                                                                  double q_y) const;

  /// @brief Remember the chips of single points at the start of a step.
  void watch(double q_x, double q_y) noexcept {
    if (watches_) {
      remember_chips(q_x, q_y);
    }
  }
  /// @brief Forces of edges and flanks that came or went since.
  const std::vector<Crossing>& crossings(const std::array<double, 2>& q,
                                         const std::array<double, 2>& v) noexcept {
    if (watches_) {
      find_crossings(q, v);
    }
    return crossings_;
  }
  /// By how much forces may jump where chips begin, all teeth together [N].
  /// @param speed  of the motion [m/s]
  [[nodiscard]] double largest_jump(double speed) const noexcept {
    return largest_jump_ + jump_per_speed_ * speed;
  }

 private:
  /// One of the three directions of a power law.
  struct Direction {
    double m = 0.0;
    double slope = 1.0;       ///< 1 - m
    double K = 0.0;           ///< [N/m^2]
    std::size_t same_as = 0;  ///< the first direction with the same m
    NearPower near;
  };

  void prepare_points(const History& past) noexcept;
  void prepare_edges(std::size_t node, const History& past) noexcept;
  [[nodiscard]] Response point_response(double q_x, double q_y) noexcept;
  void add_point(std::size_t k, double h, Response& out) noexcept;
  [[nodiscard]] Response edge_response(double q_x, double q_y) const noexcept;
  [[nodiscard]] PointsInCut points_at(std::size_t first,
                                      std::size_t count) const noexcept;
  void remember_chips(double q_x, double q_y) noexcept;
  void find_crossings(const std::array<double, 2>& q,
                      const std::array<double, 2>& v) noexcept;
  void add_damping(const std::array<double, 2>& q, const std::array<double, 2>& v,
                   Response& out) const noexcept;
  [[nodiscard]] double chip(std::size_t at, std::size_t point, double q_x,
                            double q_y) const noexcept {
    return constant_[at] + q_x * grid_.sine[point] + q_y * grid_.cosine[point];
  }
  static void add(double s, double c, const std::array<double, 3>& f,
                  const std::array<double, 3>& slope, Response& out) noexcept;

  const EngagedGrid& grid_;
  bool axial_ = true;     ///< is there a force along the axis?
  bool watches_ = false;  ///< single points whose force jumps at h = 0
  bool damps_ = false;    ///< do flanks damp?
  double largest_jump_ = 0.0;
  double jump_per_speed_ = 0.0;
  force::Terms law_;
  force::Terms flank_;
  std::array<Direction, 3> directions_;  ///< t, r, a
  Contacts contacts_;
  std::vector<double> constant_;
  PointsInCut points_;            ///< with helix: all of the contacts, side by side
  std::vector<Displaced> marks_;  ///< of a tooth, in one stretch after another
  std::vector<double> watched_;   ///< chip of each tooth, NaN: not there
  std::vector<Crossing> crossings_;
};

/// Add a force and its slope over the chip, both along t, r, a.
inline void CutForce::add(double s, double c, const std::array<double, 3>& f,
                          const std::array<double, 3>& slope, Response& out) noexcept {
  const auto [F_x, F_y] = force::in_plane(f[0], f[1], s, c);
  out.F[0] += F_x;
  out.F[1] += F_y;
  out.F[2] -= f[2];
  const auto [x, y] = force::in_plane(slope[0], slope[1], s, c);
  out.per_q[0] += x * s;
  out.per_q[1] += x * c;
  out.per_q[2] += y * s;
  out.per_q[3] += y * c;
  out.per_q[4] -= slope[2] * s;
  out.per_q[5] -= slope[2] * c;
}

inline void CutForce::prepare_points(const History& past) noexcept {
  const auto pitch = static_cast<std::ptrdiff_t>(grid_.pitch);
  for (std::size_t k = contacts_.first; k < contacts_.last; ++k) {
    const double s = grid_.sine[k];
    const double c = grid_.cosine[k];
    const double* above = grid_.above.data() + k * (grid_.lookback + 1);
    double least = *above;  // the stock
    std::ptrdiff_t back = 0;
    for (std::size_t m = 1; m <= grid_.lookback; ++m) {
      back -= pitch;
      const double h = above[m] - (past.x[back] * s + past.y[back] * c);  // T-1
      least = h < least ? h : least;
    }
    constant_[k - contacts_.first] = least;
  }
}

inline Response CutForce::point_response(double q_x, double q_y) noexcept {
  Response out;
  for (std::size_t k = contacts_.first; k < contacts_.last; ++k) {
    const double h = chip(k - contacts_.first, k, q_x, q_y);
    if (h > chip::h_threshold) {
      add_point(k, h, out);
    }
  }
  return out;
}

inline void CutForce::add_point(std::size_t k, double h, Response& out) noexcept {
  const double w = grid_.width[k];
  const double edge = grid_.edge[k];
  std::array<double, 3> f{};
  std::array<double, 3> slope{};
  const auto along = [&](std::size_t e, double K, double share) {
    f[e] = K * h + law_.K_e[e] * edge;  // K_q1 h_0 (h/h_0)^(1 - m) + K_qe
    slope[e] = share * K;
  };
  if (law_.form.power) {
    const std::size_t tooth = grid_.stretches[k].tooth;
    auto& [t, r, a] = directions_;
    const double g_t = t.near(tooth, h);
    const double g_r = r.same_as == 0 ? g_t : r.near(tooth, h);
    along(0, t.K * w * g_t, t.slope);
    along(1, r.K * w * g_r, r.slope);
    if (axial_) {
      const double g_a = a.same_as == 0 ? g_t : a.same_as == 1 ? g_r : a.near(tooth, h);
      along(2, a.K * w * g_a, a.slope);
    }
  } else {
    for (std::size_t e = 0; e < 3; ++e) along(e, law_.K[e] * w, 1.0);
  }
  add(grid_.sine[k], grid_.cosine[k], f, slope, out);
}

}  // namespace trochoid::dynamics
