#include <trochoid/correction/equal_flutes.h>

#include <trochoid/numerics/least_squares.h>
#include <trochoid/numerics/levenberg_marquardt.h>
#include <trochoid/numerics/parallel.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace trochoid::correction {

namespace {

/// Unknowns are at most this many times the largest of the offsets.
constexpr double most_level = 6.0;
/// Step of the differences, over the largest offset; and what keeps unknowns that change
/// nothing where they were.
constexpr double flute_difference = 1e-3;
constexpr double tether = 1e-4;
/// Starts but the first, at the levels of the teeth, are off it by so much of the largest
/// offset.
constexpr double scatter = 0.6;
/// Root mean squares of v that are none, and that are the same.
constexpr double none = 5e-4;
constexpr double alike = 1e-3;
constexpr int exact_steps = 14;
constexpr double longest_step = 0.7;  ///< over the largest offset
constexpr double ridge = 1e-3;
constexpr double flutes_rank_tolerance = 1e-12;

/// v_j over their mean, less 1.
std::vector<double> differences(Target target, const std::vector<Flute>& flutes) {
  std::vector<double> v;
  double mean = 0.0;
  for (const Flute& f : flutes) {
    v.push_back(f.*value_of(target));
    mean += v.back() / static_cast<double>(flutes.size());
  }
  for (double& x : v) {
    x = mean > 0 ? x / mean - 1 : 0.0;
  }
  return v;
}

double rms_of(const std::vector<double>& v) {
  double sum = 0.0;
  for (const double x : v) {
    sum += x * x;
  }
  return std::sqrt(sum / static_cast<double>(v.size()));
}

/// What is looked for, over the largest offset, and the motion that it makes.
struct Unknowns {
  double unit = 1.0;  ///< [m]
  std::vector<double> start;
  std::function<PeriodicMotion(std::span<const double>)> motion;
};

std::vector<double> levels_of(std::span<const double> y, double unit) {
  std::vector<double> levels(y.size() + 1, 0.0);
  for (std::size_t j = 0; j < y.size(); ++j) {
    levels[j] = y[j] * unit;
    levels.back() -= levels[j];
  }
  return levels;
}

Unknowns level_unknowns(const RigidCut& cut, Shape shape, const ShapeOptions& options,
                        double factor) {
  Unknowns out;
  const std::vector<double> x = levels(cut.offsets());
  double largest = 0.0;
  for (const double level : x) {
    largest = std::max(largest, std::abs(level));
  }
  out.unit = largest;
  for (std::size_t j = 0; j + 1 < x.size(); ++j) {
    out.start.push_back(factor * x[j] / out.unit);
  }
  out.motion = [&cut, shape, options, unit = out.unit](std::span<const double> y) {
    return table_motion(cut, shape, options, levels_of(y, unit));
  };
  return out;
}

/// The harmonics that change a chip, all of them.
Unknowns harmonic_unknowns(const RigidCut& cut, const ShapeOptions& options,
                           double factor) {
  Unknowns out = level_unknowns(cut, Shape::harmonics, options, factor);
  const auto x = std::get<Harmonics>(table_motion(cut, Shape::harmonics, options));
  std::vector<std::size_t> in_it;
  out.start.clear();
  for (std::size_t n = 0; n < x.c.size(); ++n) {
    if (std::abs(x.c[n]) > 0) {
      in_it.push_back(n);
      out.start.push_back(factor * x.c[n].real() / out.unit);
      out.start.push_back(factor * x.c[n].imag() / out.unit);
    }
  }
  out.motion = [in_it, count = x.c.size(), unit = out.unit](std::span<const double> y) {
    Harmonics wave;
    wave.c.resize(count);
    for (std::size_t i = 0; i < in_it.size(); ++i) {
      wave.c[in_it[i]] = {y[2 * i] * unit, y[2 * i + 1] * unit};
    }
    return PeriodicMotion(wave);
  };
  return out;
}

/// The search on one model.
struct Search {
  const Unknowns& unknowns;
  Target target;
  const FlutesOf& flutes;

  [[nodiscard]] std::vector<double> v(std::span<const double> y) const {
    return differences(target, flutes(unknowns.motion(y)));
  }

  /// Columns dv/dy, shape (teeth, unknowns), column-major.
  [[nodiscard]] std::vector<double> jacobian(std::span<const double> y) const {
    std::vector<std::vector<double>> columns(y.size());
    numerics::for_each_index(y.size(), [&](std::size_t k) {
      std::vector<double> moved(y.begin(), y.end());
      moved[k] += flute_difference;
      columns[k] = v(moved);
      moved[k] -= 2 * flute_difference;
      const std::vector<double> down = v(moved);
      for (std::size_t j = 0; j < down.size(); ++j) {
        columns[k][j] = (columns[k][j] - down[j]) / (2 * flute_difference);
      }
    });
    std::vector<double> all;
    for (const auto& column : columns) {
      all.insert(all.end(), column.begin(), column.end());
    }
    return all;
  }

  bool operator()(std::span<const double> y, std::span<double> r,
                  std::span<double> derivatives) const {
    if (std::any_of(y.begin(), y.end(),
                    [](double each) { return !(std::abs(each) < most_level); })) {
      return false;
    }
    const std::vector<double> now = v(y);
    std::copy(now.begin(), now.end(), r.begin());
    for (std::size_t k = 0; k < y.size(); ++k) {
      r[now.size() + k] = tether * (y[k] - unknowns.start[k]);
    }
    if (!derivatives.empty()) {
      std::fill(derivatives.begin(), derivatives.end(), 0.0);
      const std::vector<double> J = jacobian(y);
      for (std::size_t k = 0; k < y.size(); ++k) {
        const auto column = static_cast<std::ptrdiff_t>(k * now.size());
        std::copy_n(J.begin() + column, now.size(),
                    derivatives.begin() + static_cast<std::ptrdiff_t>(k * r.size()));
        derivatives[k * r.size() + now.size() + k] = tether;
      }
    }
    return true;
  }
};

struct FoundFlutes {
  std::vector<double> y;
  double rms = 0.0;
};

FoundFlutes descend(const Search& search, std::vector<double> start,
                    std::size_t teeth) {
  const auto found = numerics::levenberg_marquardt(
      std::cref(search), static_cast<int>(teeth + start.size()), start,
      {.max_iterations = 20, .parameter_tolerance = 1e-6});
  return {found.p, rms_of(search.v(found.p))};
}

/// Several starts; ends as soon as nothing is left.
FoundFlutes descend_from_several(const Search& search, std::size_t teeth, int starts,
                                 Optimum& optimum) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> off(-scatter, scatter);
  std::vector<FoundFlutes> all;
  for (int k = 0; k < starts; ++k) {
    std::vector<double> start = search.unknowns.start;
    for (double& y : start) {
      y += k > 0 ? off(random) : 0.0;
    }
    all.push_back(descend(search, start, teeth));
    if (all.back().rms < none) {
      optimum = {Optimality::equal, true, k + 1, 1};
      return all.back();
    }
  }
  const FoundFlutes best = *std::ranges::min_element(all, {}, &FoundFlutes::rms);
  optimum.starts = starts;
  optimum.agreeing = static_cast<int>(std::ranges::count_if(
      all, [&](const FoundFlutes& each) { return each.rms < best.rms + alike; }));
  optimum.optimality = starts > 1 && optimum.agreeing == starts
                           ? Optimality::limit_of_one_axis
                           : Optimality::local_minimum;
  return best;
}

/// Smallest s with J s = -v: a little of s is added to what is made small.
std::vector<double> step_of(const std::vector<double>& J,
                            const std::vector<double>& v) {
  const std::size_t n = v.size();
  const std::size_t m = J.size() / n;
  std::vector<double> rows;  // row-major J
  std::vector<double> right;
  for (std::size_t j = 0; j < n; ++j) {
    for (std::size_t k = 0; k < m; ++k) {
      rows.push_back(J[k * n + j]);
    }
    right.push_back(-v[j]);
  }
  for (std::size_t k = 0; k < m; ++k) {
    rows.insert(rows.end(), m, 0.0);
    rows[(n + k) * m + k] = ridge;
    right.push_back(0.0);
  }
  std::vector<double> s =
      numerics::least_squares(rows, static_cast<int>(m), right, flutes_rank_tolerance)
          .x;
  const double longest =
      std::abs(*std::ranges::max_element(s, {}, [](double x) { return std::abs(x); }));
  for (double& x : s) {
    x *= longest > longest_step ? longest_step / longest : 1.0;
  }
  return s;
}

///
void improve(std::vector<double>& J, const std::vector<double>& s,
             const std::vector<double>& change) {
  const std::size_t n = change.size();
  double square = 0.0;
  std::vector<double> missed = change;
  for (std::size_t k = 0; k < s.size(); ++k) {
    square += s[k] * s[k];
    for (std::size_t j = 0; j < n; ++j) {
      missed[j] -= J[k * n + j] * s[k];
    }
  }
  for (std::size_t k = 0; k < s.size() && square > 0; ++k) {
    for (std::size_t j = 0; j < n; ++j) {
      J[k * n + j] += missed[j] * s[k] / square;
    }
  }
}

/// From where the quick model is at its best to where the exact one is.
FoundFlutes correct_on(const Search& exact, const Search& quick,
                       const FoundFlutes& from) {
  std::vector<double> J = quick.jacobian(from.y);
  std::vector<double> at = from.y;
  std::vector<double> v = exact.v(at);
  FoundFlutes best{at, rms_of(v)};
  for (int i = 0; i < exact_steps && best.rms > none / 2; ++i) {
    std::vector<double> s = step_of(J, v);
    std::vector<double> next = at;
    for (std::size_t k = 0; k < s.size(); ++k) {
      next[k] = std::clamp(at[k] + s[k], -most_level, most_level);
      s[k] = next[k] - at[k];
    }
    const std::vector<double> new_v = exact.v(next);
    std::vector<double> change = new_v;
    for (std::size_t j = 0; j < v.size(); ++j) {
      change[j] -= v[j];
    }
    improve(J, s, change);
    if (rms_of(new_v) < 1.5 * best.rms) {  // else tried again with what was learnt
      at = next;
      v = new_v;
    }
    if (rms_of(new_v) < best.rms) {
      best = {next, rms_of(new_v)};
    }
  }
  return best;
}

/// From there, and where something is left from the levels and from rest as well.
FoundFlutes correct_on_from_several(const Search& exact, const Search& quick,
                                    const FoundFlutes& from) {
  FoundFlutes best = correct_on(exact, quick, from);
  const std::vector<double>& levels = exact.unknowns.start;
  for (const auto& start : {levels, std::vector<double>(levels.size(), 0.0)}) {
    if (best.rms < 2 * none) {
      break;
    }
    const FoundFlutes other = correct_on(exact, quick, {start, 0.0});
    best = other.rms < best.rms ? other : best;
  }
  return best;
}

/// The same goal on the exact model, where there is one.
Optimum optimum_of(const Optimum& quick, double rms) {
  Optimum out = quick;
  out.proven = rms < 2 * none;
  if (out.proven) {
    out.optimality = Optimality::equal;
  } else if (quick.optimality == Optimality::equal) {
    out.optimality = Optimality::local_minimum;
  }
  return out;
}

}  // namespace

Amplitude equal_flutes(Target target, const RigidCut& cut, Shape shape,
                       const ShapeOptions& options, const FluteModels& models) {
  const bool one_number = cut.teeth() <= 2 || target == Target::least_squares;
  const FlutesOf rigid = [&cut, target](const PeriodicMotion& X) {
    return target == Target::chip_area ? cut.flutes(X) : cut.peaks(X);
  };
  const FlutesOf& quick = models.quick ? models.quick : rigid;
  const FlutesOf& exact = models.exact ? models.exact : quick;
  Amplitude one = amplitude_for(target, cut, table_motion(cut, shape, options),
                                one_number ? models.exact : quick);
  if (cut.teeth() > 2 && target == Target::least_squares) {
    one.optimum =
        Optimum{Optimality::limit_of_one_axis, shape == Shape::harmonics, 0, 0};
  }
  const double through = range_of(table_motion(cut, shape, options)).peak_to_peak();
  if (one_number || through == 0) {
    return one;
  }
  const double factor = one.ok ? one.factor : 1.0;
  const Unknowns unknowns = shape == Shape::harmonics
                                ? harmonic_unknowns(cut, options, factor)
                                : level_unknowns(cut, shape, options, factor);
  const Search on_quick{unknowns, target, quick};
  const Search on_exact{unknowns, target, exact};
  Optimum optimum;
  FoundFlutes found =
      descend_from_several(on_quick, cut.psi().size(), models.starts, optimum);
  if (models.exact) {
    found = correct_on_from_several(on_exact, on_quick, found);
  }
  Amplitude out{.motion = unknowns.motion(found.y)};
  out.optimum = optimum_of(optimum, found.rms);
  out.factor = range_of(out.motion).peak_to_peak() / through;
  if (rms_of(differences(target, exact(one.motion))) <= found.rms) {
    out.motion = one.motion;
    out.factor = one.factor;
    out.reason = one.reason;
    out.optimum->proven = out.optimum->optimality == Optimality::equal;
  }
  out.ok = out.reason.empty();
  out.peak_to_peak = range_of(out.motion).peak_to_peak();
  out.flutes = models.exact ? exact(out.motion) : cut.flutes(out.motion);
  out.peak_difference = peak_difference(out.flutes);
  return out;
}

}  // namespace trochoid::correction
