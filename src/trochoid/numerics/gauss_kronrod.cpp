#include <trochoid/numerics/gauss_kronrod.h>

#include <boost/math/quadrature/gauss.hpp>
#include <boost/math/quadrature/gauss_kronrod.hpp>

namespace trochoid::numerics {

namespace {

KronrodRule make_kronrod_rule() {
  using Kronrod = boost::math::quadrature::gauss_kronrod<double, 15>;
  using Gauss = boost::math::quadrature::gauss<double, 7>;
  KronrodRule rule{};
  // Boost lists the non-negative half, ascending; every other node is a Gauss node.
  for (std::size_t i = 0; i < 8; ++i) {
    const double weight = i % 2 == 0 ? Gauss::weights()[i / 2] : 0.0;
    rule.t[7 + i] = Kronrod::abscissa()[i];
    rule.t[7 - i] = -Kronrod::abscissa()[i];
    rule.kronrod[7 + i] = rule.kronrod[7 - i] = Kronrod::weights()[i];
    rule.gauss[7 + i] = rule.gauss[7 - i] = weight;
  }
  return rule;
}

}  // namespace

const KronrodRule& kronrod_rule() {
  static const KronrodRule rule = make_kronrod_rule();
  return rule;
}

}  // namespace trochoid::numerics
