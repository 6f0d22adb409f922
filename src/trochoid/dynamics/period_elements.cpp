#include <trochoid/dynamics/period_elements.h>

#include <trochoid/base/units.h>
#include <trochoid/dynamics/nodes.h>
#include <trochoid/dynamics/period_parts.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

namespace trochoid::dynamics {
namespace {

/// @brief One number a node where that is enough: as long as one tooth cuts at a time,
/// and that without helix, nothing counts but the motion along its normal, and its force
/// has one direction.
///
/// D-15 A_d = alpha_d u n^T for all delays;  w = n . q,
///          F = u (alpha_0 w - sum over d of alpha_d w(phi - d))
/// @src derived: n is the same a pitch before, where the tooth before was
/// @param[in,out] elements  in two components; then in one, if all of their matrices are
///                          such products
void follow_normals(PeriodElements& elements);

using Plane = std::array<double, 2>;

/// Of the largest entry: matrices are not better than that.
constexpr double nothing = 1e-9;

using Seen = std::function<void(const Channel&)>;

/// The channels of an element that hold anything.
void each_channel(const PeriodElement& e, const Seen& seen) {
  if (!e.own.matrices.empty()) seen(e.own);
  for (const Channel& channel : e.delayed) {
    if (!channel.matrices.empty()) seen(channel);
  }
}

Matrix2 matrix_at(const Channel& channel, std::size_t i) {
  const std::size_t n = channel.matrices.size() / 4;
  Matrix2 A;
  for (std::size_t q = 0; q < 4; ++q) A[q] = channel.matrices[q * n + i];
  return A;
}

double size_of(const Matrix2& A) {
  return std::max({std::abs(A[0]), std::abs(A[1]), std::abs(A[2]), std::abs(A[3])});
}

/// The largest matrix at each node.
/// @param each  calls for every channel
std::vector<Matrix2> largest_of(const std::function<void(const Seen&)>& each,
                                std::size_t nodes) {
  std::vector<Matrix2> largest(nodes);
  each([&](const Channel& channel) {
    for (std::size_t i = 0; i < nodes; ++i) {
      const Matrix2 A = matrix_at(channel, i);
      if (size_of(A) > size_of(largest[i])) largest[i] = A;
    }
  });
  return largest;
}

/// The row space of A, in the sense of that of the node before.
Plane normal_of(const Matrix2& A, const Plane& before) {
  const double upper = std::hypot(A[0], A[1]);
  const double lower = std::hypot(A[2], A[3]);
  if (!(upper + lower > 0)) {
    return before;
  }
  const Plane n = upper > lower ? Plane{A[0] / upper, A[1] / upper}
                                : Plane{A[2] / lower, A[3] / lower};
  const bool turned = n[0] * before[0] + n[1] * before[1] < 0;
  return turned ? Plane{-n[0], -n[1]} : n;
}

std::vector<Plane> normals_of(const std::vector<Matrix2>& largest) {
  std::vector<Plane> out;
  out.reserve(largest.size());
  for (const Matrix2& A : largest) {
    out.push_back(normal_of(A, out.empty() ? Plane{1, 0} : out.back()));
  }
  return out;
}

/// The direction of A n; where that is nothing, of the node before.
std::vector<Plane> pushes_of(const std::vector<Matrix2>& largest,
                             const std::vector<Plane>& normal) {
  std::vector<Plane> out;
  for (std::size_t i = 0; i < normal.size(); ++i) {
    const Matrix2& A = largest[i];
    const Plane u = {A[0] * normal[i][0] + A[1] * normal[i][1],
                     A[2] * normal[i][0] + A[3] * normal[i][1]};
    const double length = std::hypot(u[0], u[1]);
    const Plane before = out.empty() ? Plane{1, 0} : out.back();
    out.push_back(length > 0 ? Plane{u[0] / length, u[1] / length} : before);
  }
  return out;
}

/// alpha of A = alpha u n^T.
double share_of(const Matrix2& A, const Plane& u, const Plane& n) {
  return u[0] * (A[0] * n[0] + A[1] * n[1]) + u[1] * (A[2] * n[0] + A[3] * n[1]);
}

/// Are all matrices of an element such products?
bool are_products(const PeriodElement& e, double allowed) {
  bool all = true;
  each_channel(e, [&](const Channel& channel) {
    for (std::size_t i = 0; i < e.nodes(); ++i) {
      const Matrix2 A = matrix_at(channel, i);
      const double alpha = share_of(A, e.push[i], e.normal[i]);
      for (std::size_t q = 0; q < 4; ++q) {
        const double product = alpha * e.push[i][q / 2] * e.normal[i][q % 2];
        all = all && std::abs(A[q] - product) <= allowed;
      }
    }
  });
  return all;
}

void reduce(Channel& channel, const PeriodElement& e) {
  if (channel.matrices.empty()) {
    return;
  }
  std::vector<double> shares;
  for (std::size_t i = 0; i < e.nodes(); ++i) {
    shares.push_back(share_of(matrix_at(channel, i), e.push[i], e.normal[i]));  // D-15
  }
  channel.matrices = std::move(shares);
}

/// No matrix that turns more than one direction into a force: soon seen where there is one.
bool each_has_one_normal(const PeriodElements& elements, double largest) {
  return std::all_of(
      elements.all.begin(), elements.all.end(), [&](const PeriodElement& e) {
        bool one = true;
        each_channel(e, [&](const Channel& channel) {
          for (std::size_t i = 0; i < e.nodes() && one; ++i) {
            const Matrix2 A = matrix_at(channel, i);
            one = std::abs(A[0] * A[3] - A[1] * A[2]) <= nothing * largest * size_of(A);
          }
        });
        return one;
      });
}

/// The directions of all elements, the normals the same in every pitch.
void add_directions(PeriodElements& elements) {
  const std::size_t a_pitch = elements.all.size() / elements.pitches;
  for (std::size_t k = 0; k < a_pitch; ++k) {
    const auto each = [&](const Seen& seen) {
      for (std::size_t i = k; i < elements.all.size(); i += a_pitch) {
        each_channel(elements.all[i], seen);
      }
    };
    const auto normals = normals_of(largest_of(each, elements.all[k].nodes()));
    for (std::size_t i = k; i < elements.all.size(); i += a_pitch) {
      PeriodElement& e = elements.all[i];
      const auto own = [&](const Seen& seen) { each_channel(e, seen); };
      e.normal = normals;
      e.push = pushes_of(largest_of(own, e.nodes()), normals);
    }
  }
}

double largest_entry(const PeriodElements& elements) {
  double largest = 0.0;
  for (const PeriodElement& e : elements.all) {
    each_channel(e, [&](const Channel& channel) {
      for (const double value : channel.matrices) {
        largest = std::max(largest, std::abs(value));
      }
    });
  }
  return largest;
}

void follow_normals(PeriodElements& elements) {
  if (elements.pitches == 0 || elements.components != 2) {
    return;
  }
  const double largest = largest_entry(elements);
  if (!each_has_one_normal(elements, largest)) {
    return;
  }
  add_directions(elements);
  const double allowed = nothing * largest;
  const bool all =
      std::all_of(elements.all.begin(), elements.all.end(),
                  [&](const PeriodElement& e) { return are_products(e, allowed); });
  for (PeriodElement& e : elements.all) {
    if (all) {
      reduce(e.own, e);
      for (Channel& channel : e.delayed) reduce(channel, e);
    } else {
      e.normal.clear();
      e.push.clear();
    }
  }
  elements.components = all ? 1 : 2;
}

std::size_t place_of(const std::vector<PeriodElement>& elements, double phi) {
  const auto after = std::lower_bound(
      elements.begin(), elements.end(), phi,
      [](const PeriodElement& element, double angle) { return element.to < angle; });
  return std::min(static_cast<std::size_t>(after - elements.begin()),
                  elements.size() - 1);
}

Source source_of(const std::vector<PeriodElement>& elements, double phi, double delay,
                 double period) {
  constexpr double slack = 1e-11;  // rounding of angles [rad]
  Source source;
  double at = phi - delay;
  if (at < elements.front().from - slack) {
    source.previous = true;
    at += period;
  }
  source.element = place_of(elements, at - slack);
  const PeriodElement& e = elements[source.element];
  const double t = (2 * at - e.from - e.to) / (e.to - e.from);
  source.row.resize(e.nodes());
  lagrange_row(element_nodes(e.degree), std::clamp(t, -1.0, 1.0), source.row);
  return source;
}

/// How to interpolate a directional element at the nodes of a part of it, row by row.
std::vector<double> rows_of(const DirectionalElement& whole,
                            const PeriodElement& part) {
  const ElementNodes& coarse = element_nodes(directional_degree);
  const std::size_t columns = coarse.t.size();
  std::vector<double> rows(part.nodes() * columns);
  std::size_t i = 0;
  for (const double t : element_nodes(part.degree).t) {
    const double phi = 0.5 * (part.from + part.to) + 0.5 * (part.to - part.from) * t;
    const double u = (2 * phi - whole.from - whole.to) / (whole.to - whole.from);
    lagrange_row(coarse, std::clamp(u, -1.0, 1.0),
                 std::span(rows).subspan(columns * i++, columns));
  }
  return rows;
}

/// Matrices at the nodes of a part of a directional element.
std::vector<double> sampled(const std::vector<Matrix2>& given,
                            const std::vector<double>& rows,
                            const Components& components) {
  const std::size_t nodes = rows.size() / given.size();
  const std::size_t count = components.count;
  std::vector<double> out(count * count * nodes);
  auto row = rows.begin();
  for (std::size_t i = 0; i < nodes; ++i) {
    Matrix2 value{};
    for (const Matrix2& matrix : given) {
      for (std::size_t q = 0; q < value.size(); ++q) {
        value[q] += *row * matrix[q];
      }
      ++row;
    }
    const Matrix2 own = components.of(value);
    for (std::size_t q = 0; q < count * count; ++q) out[q * nodes + i] = own[q];
  }
  return out;
}

/// Where the nodes of an element were one delay before.
std::vector<Source> sources_of(const PeriodElements& elements, std::size_t self,
                               double delay, const Directional& directional) {
  const PeriodElement& e = elements.all[self];
  const double period = directional.period;
  const std::size_t count = elements.all.size();
  if (elements.pitches > 0) {  // node by node, some pitches before
    const auto pitches =
        std::lround(delay / period * static_cast<double>(elements.pitches));
    const std::size_t back =
        static_cast<std::size_t>(pitches) * (count / elements.pitches);
    const bool previous = self < back;
    return {Source{self + (previous ? count : 0) - back, previous, {}}};
  }
  std::vector<Source> sources;
  for (const double t : element_nodes(e.degree).t) {
    const double phi = 0.5 * (e.from + e.to) + 0.5 * (e.to - e.from) * t;
    sources.push_back(source_of(elements.all, phi, delay, period));
  }
  return sources;
}

void add_sources(PeriodElements& elements, const Directional& directional) {
  for (std::size_t self = 0; self < elements.all.size(); ++self) {
    PeriodElement& e = elements.all[self];
    for (std::size_t d = 0; d < e.delayed.size(); ++d) {
      Channel& channel = e.delayed[d];
      if (channel.matrices.empty()) {
        continue;
      }
      channel.sources = sources_of(elements, self, directional.delays[d], directional);
      for (const Source& source : channel.sources) {
        PeriodElement& from = elements.all[source.element];
        from.wanted = true;
        from.kept = from.kept || source.previous;
      }
    }
  }
}

}  // namespace

Matrix2 Components::of(const Matrix2& A) const noexcept {
  if (count == 2) {
    return A;
  }
  return {x * (A[0] * x + A[1] * y) + y * (A[2] * x + A[3] * y), 0, 0, 0};
}

Components components_of(const System& system) {
  Components c;
  const ChipMode& first = system.modes.front();
  const bool one_line =
      std::all_of(system.modes.begin(), system.modes.end(), [&](const ChipMode& mode) {
        return std::abs(mode.x * first.y - mode.y * first.x) < 1e-14;
      });
  if (one_line) {
    c.count = 1;
    c.x = first.x;
    c.y = first.y;
  }
  for (const ChipMode& mode : system.modes) {
    c.modes.push_back(one_line ? std::array{mode.x * c.x + mode.y * c.y, 0.0}
                               : std::array{mode.x, mode.y});
  }
  return c;
}

double fastest_frequency(const System& system) noexcept {
  double fastest = 0.0;
  for (const ChipMode& mode : system.modes) {
    fastest = std::max(fastest, std::sqrt(mode.stiffness / mode.mass) / unit::turn);
  }
  return fastest;
}

PeriodElements period_elements(const Directional& directional,
                               const Components& components, double Omega,
                               double fastest, const Resolution& resolution) {
  PeriodElements out;
  const double cycle = Omega / fastest;  // [rad]
  const PeriodParts parts = period_parts(directional, cycle);
  bool damped = false;
  out.pitches = parts.pitches;
  out.components = components.count;
  const std::size_t a_pitch =
      parts.all.size() / std::max<std::size_t>(1, parts.pitches);
  for (const PeriodPart& part : parts.all) {
    const DirectionalElement& whole = directional.elements[part.whole];
    PeriodElement e{.from = part.from, .to = part.to, .delayed = {}};
    e.degree = out.all.size() < a_pitch
                   ? part_degree(e.to - e.from, cycle, resolution.factor)
                   : out.all[out.all.size() - a_pitch].degree;
    const bool cuts = std::any_of(whole.matrices.begin(), whole.matrices.end(),
                                  [](const auto& channel) { return !channel.empty(); });
    const std::vector<double> rows = cuts ? rows_of(whole, e) : std::vector<double>();
    const auto channel_of = [&](const std::vector<Matrix2>& given) {
      e.forced = e.forced || !given.empty();
      return given.empty() ? Channel{} : Channel{sampled(given, rows, components), {}};
    };
    e.own = channel_of(whole.matrices[0]);
    e.damping = channel_of(whole.damping);
    damped = damped || !whole.damping.empty();
    for (std::size_t d = 1; d < whole.matrices.size(); ++d) {
      e.delayed.push_back(channel_of(whole.matrices[d]));
    }
    out.all.push_back(std::move(e));
  }
  add_sources(out, directional);
  // The flank feels how its normal turns: there is no one normal with process damping.
  if (!resolution.whole_period && !damped) {
    follow_normals(out);
  }
  for (PeriodElement& e : out.all) {
    e.kept = e.kept || resolution.whole_period;
    e.wanted = e.wanted || e.kept || e.forced;
    e.first = out.kept_values;
    e.place = out.wanted_values;
    out.kept_values += e.kept ? out.components * e.nodes() : 0;
    out.wanted_values += e.wanted ? out.components * e.nodes() : 0;
  }
  return out;
}

}  // namespace trochoid::dynamics
