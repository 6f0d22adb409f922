#include <trochoid/base/index.h>
#include <trochoid/identification/answer.h>

namespace trochoid::identification {

namespace {

using base::index;

/// An unknown, where it stands among all of them, and its unit there.
struct Placed {
  Found found;
  std::size_t column = 0;
  double unit = 1.0;
};

void add_runout(const Unknowns& u, std::span<const double> p, std::size_t first,
                std::vector<Placed>& out) {
  if (u.teeth == 1) return;  // its runout changes nothing
  std::size_t i = 0;
  const auto add = [&](FoundKind kind, std::size_t at) {
    out.push_back(
        {{.kind = kind, .at = at, .value = u.length * p[i]}, first + i, u.length});
    ++i;
  };
  for (int k = 1; finds_offsets(u.runout) && k < u.teeth; ++k) {
    add(FoundKind::offset, index(k));
  }
  // Of a single direction the other component is not known.
  if (finds_eccentricity(u.runout) && !u.direction) {
    add(FoundKind::eccentricity_x, 0);
    add(FoundKind::eccentricity_y, 0);
  }
}

/// All that may be told, known or not.
std::vector<Placed> all_of(const Problem& problem, std::span<const double> p,
                           std::span<const double> K) {
  std::vector<Placed> out;
  const std::size_t columns = index(problem.columns);
  for (std::size_t c = 0; c < index(problem.force_columns()); ++c) {
    out.push_back({{.at = c % columns, .group = c / columns, .value = K[c]}, c});
  }
  const Unknowns& u = problem.unknowns;
  const std::size_t linear = index(problem.linear());
  add_runout(u, p, linear, out);
  for (std::size_t e = 0; e < index(u.exponent_count()); ++e) {
    const std::size_t i = index(u.runout_count()) + e;
    out.push_back({{.kind = FoundKind::exponent, .at = e, .value = p[i]}, linear + i});
  }
  return out;
}

}  // namespace

FoundTogether found_together(const Problem& problem, std::span<const double> p,
                             std::span<const double> K, const Uncertainty& known) {
  std::vector<Placed> placed = all_of(problem, p, K);
  const auto has = [&](std::size_t column) {
    return known.reason[column].empty() && !known.on_edge[column];
  };
  // One component of an eccentricity without the other is no key of a case.
  std::erase_if(placed, [&](const Placed& one) {
    return !has(one.column) ||
           (one.found.kind == FoundKind::eccentricity_x && !has(one.column + 1)) ||
           (one.found.kind == FoundKind::eccentricity_y && !has(one.column - 1));
  });
  FoundTogether out;
  const std::size_t width = known.reason.size();
  for (const Placed& one : placed) {
    out.unknowns.push_back(one.found);
    for (const Placed& other : placed) {
      out.covariance.push_back(one.unit * other.unit *
                               known.covariance[one.column * width + other.column]);
    }
  }
  return out;
}

}  // namespace trochoid::identification
