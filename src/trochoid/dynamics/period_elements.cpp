#include <trochoid/dynamics/period_elements.h>

#include <trochoid/base/units.h>
#include <trochoid/dynamics/nodes.h>
#include <trochoid/dynamics/normal_motion.h>
#include <trochoid/dynamics/period_parts.h>

#include <algorithm>
#include <cmath>

namespace trochoid::dynamics {

namespace {

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
