#include <trochoid/force/node_force.h>

#include <trochoid/force/node_panels.h>

#include <trochoid/base/overloaded.h>
#include <trochoid/base/units.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace trochoid::force {

namespace {

/// Chips are followed at least so closely: it costs next to nothing.
constexpr double coarsest_at_nodes = 1e-6;
/// Of edges that differ more panels err by what they are allowed.
constexpr double caution_of_any = 0.2;
/// The quadrature keeps its error so much below its tolerance, at the least.
constexpr double caution_of_quadrature = 10.0;
/// Panels near the axis err by about what they are allowed: they are allowed so much less.
constexpr double caution_near_axis = 0.05;
/// Tolerance of a tip that is next to nothing of the edge.
constexpr double coarsest_at_tip = 1e-2;

/// The 16 integrals of NodeMoments.
using Sums = std::array<double, NodeMoments::count>;

/// @brief One matrix [C] from its integrals: F-3 and F-4.
/// @return row-major, 3 x 6
std::array<double, 18> to_matrix(const Sums& m) noexcept {
  std::array<double, 18> C{};
  for (std::size_t part = 0; part < 2; ++part) {
    const double* x = &m[8 * part];
    double* c = &C[3 * part];
    c[0] = -x[1];  // rows x, y, z; columns t, r, a
    c[1] = -x[2];
    c[2] = -x[5];
    c[6] = x[0];
    c[7] = -x[3];
    c[8] = -x[6];
    c[12] = 0.0;
    c[13] = x[4];
    c[14] = -x[7];
  }
  return C;
}

/// @brief Walks along all edges, one angle after the other.
class Walk {
 public:
  explicit Walk(const NodePanels& all) : all_(all) {
    chips_.over.resize(static_cast<std::size_t>(all.passage.marks) * all.rule->width);
  }

  [[nodiscard]] bool power() const noexcept { return all_.form.power; }

  /// @param visit  takes panel, tooth, chips and weights of what is in cut
  template <class Visit>
  void at(double phi, const Visit& visit) {
    const std::array<double, 2> tip{std::sin(phi), std::cos(phi)};
    for (const NodePanel& panel : all_.panels) {
      const double reach = panel.reach + panel.half_turn;
      for (const NodeTooth& tooth : panel.teeth) {
        const double theta = phi + tooth.middle - panel.centre;
        const double off = theta - unit::turn * std::floor(theta / unit::turn + 0.5);
        if (std::abs(off) > reach) {
          continue;
        }
        node_chips(all_, panel, tooth, tip, chips_);
        if (weigh(all_, panel, chips_, scratch_, weights_)) {
          visit(panel, tooth, chips_, weights_);
        }
      }
    }
  }

 private:
  NodeChips chips_;
  NodeWeights weights_;
  NodeScratch scratch_;
  const NodePanels& all_;
};

Sums moments_at(Walk& walk, double phi) {
  NodeMoments sum;
  walk.at(phi, [&](const NodePanel& /*panel*/, const NodeTooth& /*tooth*/,
                   const NodeChips& chips, const NodeWeights& weights) {
    add_moments(*chips.edge, walk.power(), chips, weights, sum);
  });
  Sums sums{};
  for (std::size_t q = 0; q < sums.size(); ++q) {
    for (const double lane : sum.lanes[q]) {
      sums[q] += lane;
    }
  }
  return sums;
}

/// Weights of a node in t, r and a for unit coefficients.
std::array<double, 3> cutting_at(const NodePanels& all, const NodeEdge& edge,
                                 const NodeWeights& weights, std::size_t k) noexcept {
  if (all.form.power) {
    return {weights.power[0][k] * edge.length[k], weights.power[1][k] * edge.length[k],
            weights.power[2][k] * edge.length[k]};
  }
  const double h = weights.chip[k] * edge.width[k];
  return {h, h, h};
}

}  // namespace

NodeForce::NodeForce(NodePanels panels, const Law& law)
    : panels_(std::move(panels)), terms_(terms(law)) {}

std::optional<NodeForce> NodeForce::make(const Setup& setup, const Law& law,
                                         double tolerance) {
  const Edges edges(setup);
  auto panels = node_panels(edges, std::min(tolerance, coarsest_at_nodes));
  if (!panels) {
    return std::nullopt;
  }
  panels->form = form(law);
  NodeForce force(std::move(*panels), law);
  if (force.panels_.begin > 0) {
    Setup tip = setup;
    tip.cut.a_p = edges.point(force.panels_.begin).meridian.z;
    const double share = force.panels_.begin / edges.ends.back();
    const double allowed =
        std::min(coarsest_at_tip, caution_of_quadrature * tolerance / share);
    if (auto near = TipForce::make(tip, law, caution_near_axis * allowed)) {
      force.tip_ = std::move(*near);
    } else {
      force.tip_.emplace<AxialForce>(tip, law, allowed);
    }
  }
  return force;
}

std::optional<NodeForce> NodeForce::make(const AnyEdges& any, const Law& law,
                                         double tolerance) {
  auto panels =
      node_panels(any, caution_of_any * std::min(tolerance, coarsest_at_nodes));
  if (!panels) {
    return std::nullopt;
  }
  panels->form = form(law);
  NodeForce force(std::move(*panels), law);
  const double low = any.zones.front().from;
  if (force.panels_.begin > low) {
    const double share = (force.panels_.begin - low) / (any.zones.back().to - low);
    force.tip_.emplace<AnyForce>(any.setup, law,
                                 std::min(coarsest_at_tip, tolerance / share),
                                 force.panels_.begin);
  }
  return force;
}

void NodeForce::matrices(std::span<const double> phi,
                         std::span<std::array<double, 18>> C) const {
  Walk walk(panels_);
  const std::size_t columns = terms_.form.columns();
  std::ranges::fill(C, std::array<double, 18>{});
  std::visit(base::Overloaded{[](std::monostate) {},
                              [&](const auto& tip) { tip.matrices(phi, C); }},
             tip_);
  for (std::size_t i = 0; i < phi.size(); ++i) {
    const std::array<double, 18> all = to_matrix(moments_at(walk, phi[i]));
    for (std::size_t row = 0; row < 3; ++row) {
      for (std::size_t q = 0; q < columns; ++q) {
        C[i][row * columns + q] += all[6 * row + q];
      }
    }
  }
}

void NodeForce::add_tip(std::span<const double> phi, double gauge_length,
                        std::span<SixLoads> all) const {
  std::visit(
      base::Overloaded{[](std::monostate) {},
                       [&](const auto& tip) { tip.loads(phi, gauge_length, all); }},
      tip_);
}

void NodeForce::forces(std::span<const double> phi,
                       std::span<std::array<double, 3>> F) const {
  Walk walk(panels_);
  std::vector<SixLoads> at_tip(phi.size());
  add_tip(phi, 0.0, at_tip);
  for (std::size_t i = 0; i < phi.size(); ++i) {
    const std::array<double, 18> C = to_matrix(moments_at(walk, phi[i]));
    std::copy_n(at_tip[i].begin(), 3, F[i].begin());
    for (std::size_t row = 0; row < 3; ++row) {
      for (std::size_t q = 0; q < 3; ++q) {
        F[i][row] += C[6 * row + q] * terms_.K[q] + C[6 * row + 3 + q] * terms_.K_e[q];
      }
    }
  }
}

void NodeForce::loads(std::span<const double> phi, double gauge_length,
                      std::span<SixLoads> all) const {
  Walk walk(panels_);
  std::ranges::fill(all, SixLoads{});
  add_tip(phi, gauge_length, all);
  for (std::size_t i = 0; i < phi.size(); ++i) {
    SixLoads& sum = all[i];
    walk.at(phi[i], [&](const NodePanel& panel, const NodeTooth& tooth,
                        const NodeChips& chips, const NodeWeights& weights) {
      const double* R = &tooth.rows[NodeTooth::radius * panels_.rule->width];
      const NodeEdge& own = *chips.edge;
      for (std::size_t k = 0; k < panels_.rule->nodes; ++k) {
        const std::array<double, 3> cutting = cutting_at(panels_, own, weights, k);
        const double edge = weights.edge[k] * own.edge[k];
        add_loads({.sine = chips.sine[k],
                   .cosine = chips.cosine[k],
                   .sin_kappa = own.sin_kappa[k],
                   .cos_kappa = own.cos_kappa[k],
                   .R = R[k],
                   .z = panel.z[k] - gauge_length},
                  {terms_.K[0] * cutting[0] + terms_.K_e[0] * edge,
                   terms_.K[1] * cutting[1] + terms_.K_e[1] * edge,
                   terms_.K[2] * cutting[2] + terms_.K_e[2] * edge},
                  sum);
      }
    });
  }
}

}  // namespace trochoid::force
