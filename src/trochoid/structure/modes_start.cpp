#include <trochoid/structure/modes_start.h>

#include <trochoid/structure/pole_search.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace trochoid::structure {

namespace {

using Complex = std::complex<double>;

constexpr std::array dampings = {0.003, 0.01, 0.03, 0.1};
// One response is looked at where most is left of it, and everywhere.
constexpr std::size_t places_of_power = 60;
constexpr std::size_t places_everywhere = 60;
constexpr std::size_t neighbours = 3;
constexpr std::size_t places_tried = 2;
// Several have their residuals in different places: all are looked at everywhere.
constexpr std::size_t places_in_each = 150;
constexpr std::size_t places_tried_of_shapes = 3;

/// A product without the checks for infinities that the standard asks for.
Complex times(Complex a, Complex b) {
  return {a.real() * b.real() - a.imag() * b.imag(),
          a.real() * b.imag() + a.imag() * b.real()};
}

/// A line as the search for places sees it.
struct WeighedLine {
  Complex s;
  Complex f;  ///< M-4
  Complex turn;
  Complex r;                         ///< what is left of it, turned
  double along = 0.0, across = 0.0;  ///< weights

  [[nodiscard]] double power() const {
    const double re = r.real() * along;
    const double im = r.imag() * across;
    return re * re + im * im;
  }
};

/// The lines of each response.
using WeighedLines = std::vector<std::vector<WeighedLine>>;

WeighedLines weighed(Responses all, const AllWeights& weights,
                     const ModesModel& known) {
  WeighedLines out(all.size());
  for (std::size_t q = 0; q < all.size(); ++q) {
    const FrequencyResponse& lines = all[q].response;
    const std::vector<Complex> left = gaps(known, all[q], q);
    for (std::size_t i = 0; i < left.size(); ++i) {
      const Complex turn = weights[q].turn[i];
      out[q].push_back({.s = laplace(all[q], lines.omega[i]),
                        .f = factor(lines.kind, lines.omega[i]),
                        .turn = turn,
                        .r = left[i] * turn,
                        .along = weights[q].along[i],
                        .across = weights[q].across[i]});
    }
  }
  return out;
}

/// A pole for one mode more, the residue in each response, and what it would gain.
struct Place {
  double omega = 0.0;
  double zeta = 0.0;
  std::vector<Complex> Z;
  double gain = 0.0;
};

/// What a mode alone would take of all residuals (M-17).
Place place_at(Responses all, const WeighedLines& lines, double omega, double zeta) {
  Place place{.omega = omega, .zeta = zeta, .Z = {}};
  const ModeTerm term{.omega = omega, .zeta = zeta, .phi = {}};
  for (std::size_t q = 0; q < all.size(); ++q) {
    double gr = 0.0;
    double gg = 0.0;
    for (const WeighedLine& line : lines[q]) {
      const Complex g = times(times(line.f, unit_mode(term, line.s)), line.turn);
      const double along = line.along * line.along;
      const double across = line.across * line.across;
      gr += g.real() * line.r.real() * along + g.imag() * line.r.imag() * across;
      gg += g.real() * g.real() * along + g.imag() * g.imag() * across;
    }
    const double Z = gg > 0 ? gr / gg : 0.0;
    place.Z.emplace_back(Z);
    // A mode moves with the force that pushes it.
    place.gain += all[q].direct() && Z <= 0 ? 0.0 : gr * Z;
  }
  return place;
}

/// Lines of one response around which most is left, and some everywhere.
std::vector<std::size_t> lines_of_power(const std::vector<WeighedLine>& lines) {
  const std::size_t n = lines.size();
  std::vector<double> sum(n + 1, 0.0);
  for (std::size_t i = 0; i < n; ++i) {
    sum[i + 1] = sum[i] + lines[i].power();
  }
  const auto around = [&](std::size_t i) {
    return sum[std::min(i + neighbours + 1, n)] - sum[i - std::min(i, neighbours)];
  };
  std::vector<std::size_t> order(n);
  for (std::size_t i = 0; i < n; ++i) order[i] = i;
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return around(a) > around(b); });
  order.resize(std::min(n, places_of_power));
  const std::size_t step = 1 + (n - 1) / places_everywhere;
  for (std::size_t i = 0; i < n; i += step) order.push_back(i);
  return order;
}

/// Frequencies that are worth a look.
std::vector<double> frequencies(Responses all, const WeighedLines& lines,
                                ModeForm form) {
  std::vector<double> out;
  if (form == ModeForm::residue) {
    for (const std::size_t i : lines_of_power(lines.front())) {
      out.push_back(all.front().response.omega[i]);
    }
    return out;
  }
  for (const DirectedResponse& one : all) {
    const std::vector<double>& omega = one.response.omega;
    const std::size_t step = 1 + (omega.size() - 1) / places_in_each;
    for (std::size_t i = 0; one.direct() && i < omega.size(); i += step) {
      out.push_back(omega[i]);
    }
  }
  return out;
}

/// Where one mode more would gain most, places apart from one another.
std::vector<Place> places(Responses all, const WeighedLines& lines, ModeForm form) {
  const std::size_t most =
      form == ModeForm::residue ? places_tried : places_tried_of_shapes;
  std::vector<Place> found;
  for (const double omega : frequencies(all, lines, form)) {
    for (const double zeta : dampings) {
      found.push_back(place_at(all, lines, omega, zeta));
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
    if (out.size() == most) {
      break;
    }
  }
  return out;
}

/// What a term moves, from its residue in each response.
std::vector<Complex> phi_of(Responses all, std::span<const Complex> Z,
                            const ModesModel& model) {
  return model.is_residue() ? std::vector<Complex>(Z.begin(), Z.end())
                            : rank_one(all, Z, model.directions);
}

/// All poles anew by vector fitting from one direct response, the rest from all.
ModesModel from_poles(Responses all, const AllWeights& weights, std::size_t from,
                      const ModesModel& known) {
  ModesModel model = known;
  model.terms.clear();
  const int count = static_cast<int>(known.terms.size()) + 1;
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
    const Residues found = fit_residues(all[q], weights[q], model);
    for (std::size_t r = 0; r < Z.size(); ++r) {
      Z[r].push_back(found.Z[r]);
    }
  }
  for (std::size_t r = 0; r < model.terms.size(); ++r) {
    model.terms[r].phi = phi_of(all, Z[r], model);
  }
  return model;
}

/// One mode as two beside one another, that move at right angles where there are two
/// directions: close modes of a round tool do.
ModesModel split(ModesModel model, std::size_t r, bool across) {
  ModeTerm& t = model.terms[r];
  const double apart = std::min(t.zeta, 0.2);
  ModeTerm other = t;
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

std::vector<ModesModel> starts_with_one_more(Responses all,
                                             std::span<const AllWeights> weightings,
                                             const ModesModel& known) {
  std::vector<ModesModel> starts;
  for (std::size_t q = 0; q < all.size(); ++q) {
    if (all[q].direct()) {
      starts.push_back(from_poles(all, weightings.front(), q, known));
    }
  }
  const auto add = [&](const Place& place) {
    starts.push_back(known);
    starts.back().terms.push_back(
        {.omega = place.omega, .zeta = place.zeta, .phi = phi_of(all, place.Z, known)});
  };
  for (const AllWeights& weights : weightings) {
    for (const Place& place : places(all, weighed(all, weights, known), known.form)) {
      add(place);
    }
  }
  for (std::size_t r = 0; r < known.terms.size(); ++r) {
    starts.push_back(split(known, r, false));
    if (known.directions == 2) {
      starts.push_back(split(known, r, true));
    }
  }
  const WeighedLines lines = weighed(all, weightings.front(), known);
  const std::vector<double>& omega = all.front().response.omega;
  for (const double outside : {0.5 * omega.front(), 1.5 * omega.back()}) {
    add(place_at(all, lines, outside, 0.03));
  }
  return starts;
}

}  // namespace trochoid::structure
