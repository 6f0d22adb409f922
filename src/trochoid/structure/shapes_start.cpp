#include <trochoid/structure/shapes_start.h>

#include <trochoid/numerics/least_squares.h>
#include <trochoid/structure/pole_search.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace trochoid::structure {

namespace {

using Complex = std::complex<double>;

constexpr double rank_tolerance = 1e-12;
constexpr std::size_t places_looked_at = 150;  ///< frequencies
constexpr std::size_t places_tried = 3;
constexpr std::array dampings = {0.003, 0.01, 0.03, 0.1};

/// A pole for one mode more, the residue in each response, and what it would gain.
struct Place {
  double omega = 0.0;
  double zeta = 0.0;
  std::vector<Complex> Z;
  double gain = 0.0;
};

/// What a mode alone would take of all residuals (M-17).
Place place_at(Responses all, const AllWeights& weights,
               const std::vector<std::vector<Complex>>& left, const ShapeTerm& term) {
  Place place{.omega = term.omega, .zeta = term.zeta};
  for (std::size_t q = 0; q < all.size(); ++q) {
    const FrequencyResponse& lines = all[q].response;
    double gr = 0.0;
    double gg = 0.0;
    for (std::size_t i = 0; i < lines.omega.size(); ++i) {
      const Complex g = factor(lines.kind, lines.omega[i]) *
                        unit_mode(term, laplace(all[q], lines.omega[i])) *
                        weights[q].turn[i];
      const Complex r = left[q][i] * weights[q].turn[i];
      const double along = weights[q].along[i] * weights[q].along[i];
      const double across = weights[q].across[i] * weights[q].across[i];
      gr += g.real() * r.real() * along + g.imag() * r.imag() * across;
      gg += g.real() * g.real() * along + g.imag() * g.imag() * across;
    }
    const double Z = gg > 0 ? gr / gg : 0.0;
    place.Z.emplace_back(Z);
    // A mode moves with the force that pushes it.
    place.gain += all[q].direct() && Z <= 0 ? 0.0 : gr * Z;
  }
  return place;
}

/// Where one mode more would gain most, places apart from one another.
std::vector<Place> places(Responses all, const AllWeights& weights,
                          const ShapesModel& known) {
  std::vector<std::vector<Complex>> left;
  for (std::size_t q = 0; q < all.size(); ++q) {
    left.push_back(gaps(known, all[q], q));
  }
  std::vector<Place> found;
  for (const DirectedResponse& one : all) {
    if (!one.direct()) {
      continue;
    }
    const std::vector<double>& omega = one.response.omega;
    const std::size_t step = 1 + (omega.size() - 1) / places_looked_at;
    for (std::size_t i = 0; i < omega.size(); i += step) {
      for (const double zeta : dampings) {
        found.push_back(
            place_at(all, weights, left, {.omega = omega[i], .zeta = zeta, .phi = {}}));
      }
    }
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const Place& a, const Place& b) { return a.gain > b.gain; });
  std::vector<Place> out;
  for (const Place& p : found) {
    const bool near = std::any_of(out.begin(), out.end(), [&](const Place& o) {
      return std::abs(p.omega - o.omega) < 0.05 * o.omega;
    });
    if (!near && p.gain > 0) {
      out.push_back(p);
    }
    if (out.size() == places_tried) {
      break;
    }
  }
  return out;
}

/// Residues Z of each term in one response, for the poles of a model.
std::vector<Complex> residues_of(const DirectedResponse& one,
                                 const LineWeights& weights, const ShapesModel& model) {
  const std::size_t each = model.complex_shapes ? 2 : 1;
  const std::size_t terms = model.terms.size();
  const std::size_t n = each * terms + (model.residual_terms ? 2 : 0);
  const FrequencyResponse& lines = one.response;
  std::vector<double> A(2 * lines.omega.size() * n);
  std::vector<double> b(2 * lines.omega.size());
  const auto put = [&](std::size_t i, std::size_t k, Complex value) {
    const Complex turned = value * weights.turn[i];
    A[2 * i * n + k] = turned.real() * weights.along[i];
    A[(2 * i + 1) * n + k] = turned.imag() * weights.across[i];
  };
  for (std::size_t i = 0; i < lines.omega.size(); ++i) {
    const Complex s = laplace(one, lines.omega[i]);
    const Complex f = factor(lines.kind, lines.omega[i]);
    for (std::size_t r = 0; r < terms; ++r) {
      const Complex G = f * unit_mode(model.terms[r], s);
      put(i, each * r, G);
      if (model.complex_shapes) {
        put(i, each * r + 1, G * quadrature(model.terms[r], s));
      }
    }
    if (model.residual_terms) {
      put(i, n - 2, f);
      put(i, n - 1, f / (s * s));
    }
    const Complex H = lines.H[i] * weights.turn[i];
    b[2 * i] = H.real() * weights.along[i];
    b[2 * i + 1] = H.imag() * weights.across[i];
  }
  const auto fit = numerics::least_squares(A, static_cast<int>(n), b, rank_tolerance);
  std::vector<Complex> out;
  for (std::size_t r = 0; r < terms; ++r) {
    out.emplace_back(fit.x[each * r], model.complex_shapes ? fit.x[each * r + 1] : 0.0);
  }
  return out;
}

/// All poles anew from one direct response, the shapes from all.
ShapesModel from_poles(Responses all, const AllWeights& weights, std::size_t from,
                       const ShapesModel& empty, int count) {
  ShapesModel model = empty;
  const Poles poles = find_poles(all[from].response, count, model.residual_terms);
  for (const Pole& pole : poles.pairs) {
    const double omega = std::abs(pole.p);
    model.terms.push_back(
        {.omega = omega,
         .zeta = std::clamp(std::abs(pole.p.real()) / omega, 1e-5, 0.9),
         .phi = {}});
  }
  std::vector<std::vector<Complex>> Z(model.terms.size());
  for (std::size_t q = 0; q < all.size(); ++q) {
    const std::vector<Complex> found = residues_of(all[q], weights[q], model);
    for (std::size_t r = 0; r < found.size(); ++r) {
      Z[r].push_back(found[r]);
    }
  }
  for (std::size_t r = 0; r < model.terms.size(); ++r) {
    model.terms[r].phi = rank_one(all, Z[r], model.directions);
  }
  return model;
}

/// One mode as two beside one another, that move at right angles where there are two
/// directions: close modes of a round tool do.
ShapesModel split(ShapesModel model, std::size_t r, bool across) {
  ShapeTerm& t = model.terms[r];
  const double apart = std::min(t.zeta, 0.2);
  ShapeTerm other = t;
  t.omega *= 1 - 0.7 * apart;
  other.omega *= 1 + 0.7 * apart;
  if (across) {
    other.phi = {-std::conj(t.phi[1]), std::conj(t.phi[0])};
  } else {
    t.zeta *= 0.6;
    other.zeta *= 0.6;
    for (std::size_t m = 0; m < t.phi.size(); ++m) {
      t.phi[m] *= std::sqrt(0.5);
      other.phi[m] *= std::sqrt(0.5);
    }
  }
  model.terms.push_back(other);
  return model;
}

}  // namespace

std::vector<Complex> rank_one(Responses all, std::span<const Complex> Z,
                              std::size_t directions) {
  std::size_t first = 0;
  for (std::size_t q = 0; q < all.size(); ++q) {
    const bool better = !all[first].direct() || Z[q].real() > Z[first].real();
    first = all[q].direct() && better ? q : first;
  }
  const std::size_t j = all[first].motion;
  std::vector<Complex> phi(directions, 0.0);
  phi[j] = std::sqrt(Z[first].real() > 0 ? Z[first] : Complex(std::abs(Z[first])));
  if (std::abs(phi[j]) == 0) {
    return phi;
  }
  for (std::size_t k = 0; k < directions; ++k) {
    if (k == j) {
      continue;
    }
    Complex sum = 0.0;
    double count = 0.0;
    for (std::size_t q = 0; q < all.size(); ++q) {
      const auto [motion, force] = std::pair{all[q].motion, all[q].force};
      if ((motion == j && force == k) || (motion == k && force == j)) {
        sum += Z[q];
        ++count;
      }
      if (motion == k && force == k && phi[k] == 0.0) {
        phi[k] = std::sqrt(std::max(Z[q].real(), 0.0));
      }
    }
    if (count > 0) {
      phi[k] = sum / count / phi[j];  // M-32
    }
  }
  return phi;
}

std::vector<ShapesModel> starts_with_one_more(Responses all, const AllWeights& weights,
                                              const ShapesModel& known,
                                              ShapesForm form) {
  ShapesModel base = known;
  base.residual_terms = form.residual_terms;
  base.complex_shapes = form.complex_shapes;
  ShapesModel empty = base;
  empty.terms.clear();
  std::vector<ShapesModel> starts;
  for (std::size_t q = 0; q < all.size(); ++q) {
    if (all[q].direct()) {
      starts.push_back(
          from_poles(all, weights, q, empty, static_cast<int>(known.terms.size()) + 1));
    }
  }
  for (const Place& place : places(all, weights, known)) {
    starts.push_back(base);
    starts.back().terms.push_back({.omega = place.omega,
                                   .zeta = place.zeta,
                                   .phi = rank_one(all, place.Z, base.directions)});
  }
  for (std::size_t r = 0; r < known.terms.size(); ++r) {
    starts.push_back(split(base, r, false));
    if (base.directions == 2) {
      starts.push_back(split(base, r, true));
    }
  }
  const std::vector<double>& omega = all.front().response.omega;
  for (const double outside : {0.5 * omega.front(), 1.5 * omega.back()}) {
    std::vector<std::vector<Complex>> left;
    for (std::size_t q = 0; q < all.size(); ++q) {
      left.push_back(gaps(known, all[q], q));
    }
    const Place place =
        place_at(all, weights, left, {.omega = outside, .zeta = 0.03, .phi = {}});
    starts.push_back(base);
    starts.back().terms.push_back({.omega = outside,
                                   .zeta = 0.03,
                                   .phi = rank_one(all, place.Z, base.directions)});
  }
  return starts;
}

}  // namespace trochoid::structure
