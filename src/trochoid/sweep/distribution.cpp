#include <trochoid/sweep/distribution.h>

#include <trochoid/base/estimate.h>
#include <trochoid/numerics/semidefinite.h>
#include <trochoid/numerics/student.h>

#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/special_functions/erf.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace trochoid::sweep {

namespace {

/// From 0 to 1, neither of them; std::uniform_real_distribution is not the same
/// everywhere.
double uniform(std::mt19937_64& random) {
  return (static_cast<double>(random() >> 11) + 0.5) * 0x1p-53;
}

/// Below `most`; std::uniform_int_distribution is not the same everywhere.
std::size_t below(std::mt19937_64& random, std::size_t most) {
  return std::min(static_cast<std::size_t>(uniform(random) * static_cast<double>(most)),
                  most - 1);
}

/// One number for each row, each in a stretch of its own of 1/rows.
void add_stratified(std::mt19937_64& random, std::size_t rows,
                    std::vector<double>& chance) {
  std::vector<std::size_t> place(rows);
  std::iota(place.begin(), place.end(), std::size_t{0});
  for (std::size_t i = rows; i > 1; --i) {
    std::swap(place[i - 1], place[below(random, i)]);
  }
  for (const std::size_t p : place) {
    chance.push_back((static_cast<double>(p) + uniform(random)) /
                     static_cast<double>(rows));
  }
}

/// Of modes all but the angle are above zero.
bool above_zero(const std::string& name) {
  return name.starts_with("mode[") && !name.ends_with(".angle_deg");
}

double scale_of(double freedom, double u) {
  if (freedom == 0) {
    return 1.0;
  }
  const boost::math::chi_squared chi2(freedom);
  return std::sqrt(freedom / boost::math::quantile(chi2, u));
}

}  // namespace

std::vector<double> chances(std::mt19937_64& random, std::size_t columns,
                            std::size_t rows, bool stratified) {
  std::vector<double> chance;
  if (stratified) {
    for (std::size_t k = 0; k < columns; ++k) {
      add_stratified(random, rows, chance);
    }
  } else {
    chance.resize(rows * columns);
    std::ranges::generate(chance, [&] { return uniform(random); });
  }
  return chance;
}

double normal_quantile(double p) {
  return -std::numbers::sqrt2 * boost::math::erfc_inv(2 * p);
}

double freedom_of(double w) {
  constexpr double as_good_as_normal = 1e6;
  constexpr double least = 0.2;
  if (!(w > base::normal_interval)) {
    return 0.0;
  }
  double low = std::log(least);
  double high = std::log(as_good_as_normal);
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (numerics::student_t(0.975, std::exp(middle)) > w ? low : high) = middle;
  }
  return std::exp(0.5 * (low + high));
}

std::optional<Distribution> distribution_of(const results::Joint& joint) {
  const std::size_t n = joint.names.size();
  Distribution d{.value = joint.values};
  std::vector<double> size(n, 1.0);
  for (std::size_t i = 0; i < n; ++i) {
    d.in_log.push_back(above_zero(joint.names[i]));
    d.freedom.push_back(freedom_of(joint.factors[i]));
    if (d.in_log[i]) {
      if (!(d.value[i] > 0)) {
        return std::nullopt;
      }
      size[i] = d.value[i];
    }
  }
  std::vector<double> C = joint.covariance;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      C[i * n + j] /= size[i] * size[j];
    }
  }
  auto root = numerics::semidefinite_root(C, n);
  if (!root) {
    return std::nullopt;
  }
  d.root = *std::move(root);
  return d;
}

std::vector<double> drawn(const Distribution& d, std::span<const double> chance) {
  const std::size_t n = d.size();
  std::vector<double> z;
  for (const double p : chance.first(n)) {
    z.push_back(normal_quantile(p));
  }
  std::vector<double> x;
  for (std::size_t i = 0; i < n; ++i) {
    double away = 0.0;
    for (std::size_t k = 0; k < n; ++k) {
      away += d.root[i * n + k] * z[k];
    }
    away *= scale_of(d.freedom[i], chance[n]);
    x.push_back(d.in_log[i] ? d.value[i] * std::exp(away) : d.value[i] + away);
  }
  return x;
}

}  // namespace trochoid::sweep
