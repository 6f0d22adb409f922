#include <trochoid/force/node_kernel.h>

// Highway compiles this file once for each kind of vectors, and picks one when it runs.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "trochoid/force/node_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

// After the others: it is compiled once for each kind of vectors too.
#include <hwy/contrib/math/math-inl.h>

HWY_BEFORE_NAMESPACE();
namespace trochoid::force {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using Tag = hn::CappedTag<double, 8>;
using Vector = hn::Vec<Tag>;
constexpr Tag tag;

struct Angle {
  Vector sine;
  Vector cosine;
};

HWY_INLINE Angle turned(const Angle& tip, const double* cosine,
                        const double* sine) noexcept {
  const Vector c = hn::LoadU(tag, cosine);
  const Vector s = hn::LoadU(tag, sine);
  return {hn::MulAdd(tip.sine, c, hn::Mul(tip.cosine, s)),
          hn::MulSub(tip.cosine, c, hn::Mul(tip.sine, s))};
}

/// The rows of a mark, at one block.
struct Mark {
  Vector apart;
  Vector back;
  Vector R;
  Vector bend;
};

HWY_INLINE Vector constant(double x) noexcept {
  return hn::Set(tag, x);
}

/// sin(x) with u = x^2, to 1e-11 for |x| <= 0.8.
HWY_INLINE Vector sine_of(Vector x, Vector u) noexcept {
  Vector p = hn::MulAdd(u, constant(-1.0 / 39916800), constant(1.0 / 362880));
  p = hn::MulAdd(u, p, constant(-1.0 / 5040));
  p = hn::MulAdd(u, p, constant(1.0 / 120));
  p = hn::MulAdd(u, p, constant(-1.0 / 6));
  return hn::MulAdd(hn::Mul(x, u), p, x);
}

/// 1 - cos(x), to 1e-10 for |x| <= 0.8.
HWY_INLINE Vector fall_of(Vector u) noexcept {
  Vector p = hn::MulAdd(u, constant(1.0 / 3628800), constant(-1.0 / 40320));
  p = hn::MulAdd(u, p, constant(1.0 / 720));
  p = hn::MulAdd(u, p, constant(-1.0 / 24));
  return hn::Mul(u, hn::MulAdd(u, p, constant(0.5)));
}

/// C-5 by its third-order start and Newton, C-6 without a difference of radii.
HWY_INLINE Vector over_path(const Mark& mark, const Angle& theta, double feed,
                            int steps) noexcept {
  const Vector A = hn::Mul(mark.bend, theta.cosine);
  const Vector inverse = hn::Div(constant(1.0), hn::Add(constant(1.0), A));
  const Vector turn = hn::Mul(A, mark.back);
  const Vector x0 = hn::Mul(turn, inverse);  // the negative of the start
  const Vector cube = hn::Mul(hn::Mul(x0, x0), hn::Mul(x0, constant(1.0 / 6)));
  Vector x = hn::Neg(hn::Mul(hn::Add(turn, cube), inverse));
  for (int i = 0; i < steps; ++i) {
    const Vector u = hn::Mul(x, x);
    const Vector g = hn::Add(sine_of(x, u), hn::MulAdd(A, x, turn));
    if (steps > 2) {
      x = hn::Sub(x, hn::Div(g, hn::Sub(hn::Add(constant(1.0), A), fall_of(u))));
      continue;
    }
    const Vector slope = hn::Mul(hn::Mul(u, constant(0.5)), inverse);
    x = hn::NegMulAdd(hn::Mul(g, inverse), hn::Add(constant(1.0), slope), x);
  }
  const Vector u = hn::Mul(x, x);
  const Vector along =
      hn::Mul(hn::Mul(hn::Add(mark.back, x), theta.sine), constant(feed));
  return hn::Add(hn::MulAdd(mark.R, fall_of(u), mark.apart), along);
}

// Highway's table takes no noexcept functions; five parameters, one the answer.
void chips_at_nodes(const NodePanels& all, const NodePanel& panel,
                    const NodeTooth& tooth, const double* sine_cosine, NodeChips& out) {
  const std::size_t width = all.rule->width;
  const bool exact = all.passage.model.model == chip::Model::trochoidal;
  const double* const rows = tooth.rows.data();
  const double* const own = out.edge->r.data();
  const Angle tip{constant(sine_cosine[0]), constant(sine_cosine[1])};
  for (std::size_t i = 0; i < width; i += hn::Lanes(tag)) {
    const Angle theta = turned(tip, rows + NodeTooth::cosine * width + i,
                               rows + NodeTooth::sine * width + i);
    const Angle seen = exact ? theta
                             : turned(tip, rows + NodeTooth::chip_cosine * width + i,
                                      rows + NodeTooth::chip_sine * width + i);
    const double* radius = exact ? rows + NodeTooth::radius * width + i : own + i;
    hn::StoreU(hn::LoadU(tag, radius), tag, &out.radius[i]);
    hn::StoreU(theta.sine, tag, &out.sine[i]);
    hn::StoreU(theta.cosine, tag, &out.cosine[i]);
    hn::StoreU(seen.sine, tag, &out.chip_sine[i]);
    hn::StoreU(seen.cosine, tag, &out.chip_cosine[i]);
    Vector least = constant(1e300);
    const double* row = rows + NodeTooth::first_mark * width + i;
    for (std::size_t m = 0; m < tooth.marks; ++m) {
      const Mark mark{hn::LoadU(tag, row), hn::LoadU(tag, row + width),
                      hn::LoadU(tag, row + 2 * width), hn::LoadU(tag, row + 3 * width)};
      row += NodeTooth::rows_of_mark * width;
      const Vector h = exact ? over_path(mark, seen, all.passage.feed, panel.steps)
                             : hn::MulAdd(mark.back, seen.sine, mark.apart);
      hn::StoreU(h, tag, &out.over[m * width + i]);
      least = hn::Min(least, h);
    }
    hn::StoreU(least, tag, &out.least[i]);
  }
}

HWY_INLINE Vector value(const NodeRow& powers, std::size_t nodes, Vector t) noexcept {
  Vector v = constant(powers[nodes - 1]);
  for (std::size_t k = nodes - 1; k-- > 0;) {
    v = hn::MulAdd(v, t, constant(powers[k]));
  }
  return v;
}

// Highway's table takes no noexcept functions.
void products(const NodeRule& rule, const double* a, const double* b, const double* t,
              double* out) {
  const NodeRow first = powers_of(rule, a);
  const NodeRow second = powers_of(rule, b);
  for (std::size_t g = 0; g < power_room; g += hn::Lanes(tag)) {
    const Vector at = hn::LoadU(tag, t + g);
    hn::StoreU(hn::Mul(value(first, rule.nodes, at), value(second, rule.nodes, at)),
               tag, out + g);
  }
}

/// Sums over the places of a power of the chip times 1, t, t^2 ...
void powers(const NodeRule& rule, const PowerPiece& piece,
            std::array<NodeRow, 3>& out) {
  constexpr double nothing = 1e-300;
  std::array<std::array<Vector, node_room>, 3> sums;
  for (auto& of_one : sums) {
    for (std::size_t k = 0; k < rule.nodes; ++k) {
      of_one[k] = hn::Zero(tag);
    }
  }
  for (std::size_t g = 0; g < piece.places; g += hn::Lanes(tag)) {
    const Vector x = hn::Mul(hn::LoadU(tag, &piece.across[g]), constant(1 / h_0));
    const auto some = hn::Gt(x, hn::Zero(tag));
    const Vector log = hn::Log(tag, hn::Max(x, constant(nothing)));
    const Vector w =
        hn::Mul(hn::LoadU(tag, &piece.weight[g]), constant(piece.length * h_0));
    const Vector t = hn::LoadU(tag, &piece.t[g]);
    for (std::size_t q = 0; q < sums.size(); ++q) {
      const Vector power = hn::Exp(tag, hn::Mul(constant(1 - piece.m[q]), log));
      Vector term = hn::IfThenElseZero(some, hn::Mul(w, power));
      for (std::size_t k = 0; k < rule.nodes; ++k) {
        sums[q][k] = hn::Add(sums[q][k], term);
        term = hn::Mul(term, t);
      }
    }
  }
  for (std::size_t q = 0; q < sums.size(); ++q) {
    for (std::size_t k = 0; k < rule.nodes; ++k) {
      const Vector sum = hn::SumOfLanes(tag, sums[q][k]);
      for (std::size_t i = 0; i < rule.width; i += hn::Lanes(tag)) {
        hn::StoreU(
            hn::MulAdd(sum, hn::LoadU(tag, &rule.l[k][i]), hn::LoadU(tag, &out[q][i])),
            tag, &out[q][i]);
      }
    }
  }
}

HWY_INLINE void add(double* lanes, Vector a, Vector b) noexcept {
  hn::StoreU(hn::MulAdd(a, b, hn::LoadU(tag, lanes)), tag, lanes);
}

/// Eight moments of the weights of t, r and a.
struct Pull {
  Vector t;
  Vector r;
  Vector a;
};

HWY_INLINE void add_eight(double* lanes, const Pull& q, const Angle& theta,
                          Vector sin_kappa, Vector cos_kappa) noexcept {
  const Vector rs = hn::Mul(q.r, sin_kappa);
  const Vector ac = hn::Mul(q.a, cos_kappa);
  add(lanes, q.t, theta.sine);
  add(lanes + 8, q.t, theta.cosine);
  add(lanes + 16, rs, theta.sine);
  add(lanes + 24, rs, theta.cosine);
  hn::StoreU(hn::Add(hn::Mul(q.r, cos_kappa), hn::LoadU(tag, lanes + 32)), tag,
             lanes + 32);
  add(lanes + 40, ac, theta.sine);
  add(lanes + 48, ac, theta.cosine);
  hn::StoreU(hn::Add(hn::Mul(q.a, sin_kappa), hn::LoadU(tag, lanes + 56)), tag,
             lanes + 56);
}

// Highway's table takes no noexcept functions.
void add_at_nodes(const NodeEdge& own, bool power, const NodeChips& chips,
                  const NodeWeights& weights, NodeMoments& sum) {
  double* const lanes = sum.lanes.front().data();
  for (std::size_t i = 0; i < node_room; i += hn::Lanes(tag)) {
    if (i == 8 && own.edge[8] == 0) {
      return;  // a rule of eight nodes
    }
    const Angle theta{hn::LoadU(tag, &chips.sine[i]), hn::LoadU(tag, &chips.cosine[i])};
    const Vector sin_kappa = hn::LoadU(tag, &own.sin_kappa[i]);
    const Vector cos_kappa = hn::LoadU(tag, &own.cos_kappa[i]);
    const Vector chip =
        hn::Mul(hn::LoadU(tag, &weights.chip[i]), hn::LoadU(tag, &own.width[i]));
    const Vector edge =
        hn::Mul(hn::LoadU(tag, &weights.edge[i]), hn::LoadU(tag, &own.edge[i]));
    Pull pull{chip, chip, chip};
    if (power) {
      const Vector length = hn::LoadU(tag, &own.length[i]);
      pull = {hn::Mul(hn::LoadU(tag, &weights.power[0][i]), length),
              hn::Mul(hn::LoadU(tag, &weights.power[1][i]), length),
              hn::Mul(hn::LoadU(tag, &weights.power[2][i]), length)};
    }
    add_eight(lanes, pull, theta, sin_kappa, cos_kappa);
    add_eight(lanes + 64, {edge, edge, edge}, theta, sin_kappa, cos_kappa);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace trochoid::force
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace trochoid::force {

namespace {

HWY_EXPORT(chips_at_nodes);
HWY_EXPORT(products);
HWY_EXPORT(powers);
HWY_EXPORT(add_at_nodes);

}  // namespace

void node_chips(const NodePanels& all, const NodePanel& panel, const NodeTooth& tooth,
                std::array<double, 2> sine_cosine, NodeChips& out) noexcept {
  out.edge = &panel.edge_of(tooth);
  out.over.resize(tooth.marks * all.rule->width);
  HWY_DYNAMIC_DISPATCH(chips_at_nodes)(all, panel, tooth, sine_cosine.data(), out);
}

void chips_across(const NodeRule& rule, const double* h, const double* sin_kappa,
                  const PowerRow& t, PowerRow& out) noexcept {
  HWY_DYNAMIC_DISPATCH(products)(rule, h, sin_kappa, t.data(), out.data());
}

void add_powers(const NodeRule& rule, const PowerPiece& piece,
                std::array<NodeRow, 3>& out) noexcept {
  HWY_DYNAMIC_DISPATCH(powers)(rule, piece, out);
}

void add_moments(const NodeEdge& edge, bool power, const NodeChips& chips,
                 const NodeWeights& weights, NodeMoments& sum) noexcept {
  HWY_DYNAMIC_DISPATCH(add_at_nodes)(edge, power, chips, weights, sum);
}

}  // namespace trochoid::force
#endif
