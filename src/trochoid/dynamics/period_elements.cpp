#include <trochoid/dynamics/period_elements.h>

#include <trochoid/base/units.h>
#include <trochoid/dynamics/nodes.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace trochoid::dynamics {

namespace {

constexpr double pi = std::numbers::pi;
/// No element holds more cycles of the fastest mode: more cost more to solve.
constexpr double most_cycles = 3.0;
/// In an element of more cycles a kink that comes back is an end.
constexpr double long_cycles = 2.0;
/// A kink closer to an end than this many cycles does no harm.
constexpr double near_end = 0.1;

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

/// Values at the nodes of a part of a directional element.
std::vector<Matrix2> sampled(const std::vector<Matrix2>& given,
                             const std::vector<double>& rows,
                             const Components& components) {
  std::vector<Matrix2> out;
  out.reserve(rows.size() / given.size());
  for (auto row = rows.begin(); row != rows.end();) {
    Matrix2 value{};
    for (const Matrix2& matrix : given) {
      for (std::size_t q = 0; q < value.size(); ++q) {
        value[q] += *row * matrix[q];
      }
      ++row;
    }
    out.push_back(components.of(value));
  }
  return out;
}

/// Angles where a kink of the motion comes back, ascending.
std::vector<double> returning_kinks(const Directional& directional) {
  std::vector<double> kinks;
  const double start = directional.elements.front().from;
  for (const double delay : directional.delays) {
    if (std::abs(delay - directional.period) < 1e-9) {
      continue;  // back at a switch
    }
    for (const DirectionalElement& element : directional.elements) {
      const double at = element.from + delay - start;
      kinks.push_back(start + at -
                      directional.period * std::floor(at / directional.period));
    }
  }
  std::sort(kinks.begin(), kinks.end());
  return kinks;
}

/// Ends of the parts of a directional element.
std::vector<double> parts_of(const DirectionalElement& whole,
                             const std::vector<double>& kinks, double cycle,
                             double longest) {
  std::vector<double> ends = {whole.from};
  const double apart = near_end * cycle;
  const bool is_long = whole.to - whole.from > long_cycles * cycle;
  for (const double kink : kinks) {
    if (is_long && kink > ends.back() + apart && kink < whole.to - apart) {
      ends.push_back(kink);
    }
  }
  ends.push_back(whole.to);
  std::vector<double> out = {whole.from};
  for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
    const double length = ends[i + 1] - ends[i];
    const int count =
        std::max({1, static_cast<int>(std::ceil(length / (most_cycles * cycle) - 1e-9)),
                  static_cast<int>(std::ceil(length / longest - 1e-9))});
    for (int k = 1; k <= count; ++k) {
      out.push_back(k == count ? ends[i + 1] : ends[i] + length * k / count);
    }
  }
  return out;
}

void add_sources(std::vector<PeriodElement>& elements, const Directional& directional) {
  for (PeriodElement& e : elements) {
    const auto self = static_cast<std::size_t>(&e - elements.data());
    for (std::size_t d = 0; d < e.delayed.size(); ++d) {
      Channel& channel = e.delayed[d];
      if (channel.at_nodes.empty()) {
        continue;
      }
      const double delay = directional.delays[d];
      const bool same = std::abs(delay - directional.period) < 1e-9;
      for (const double t : element_nodes(e.degree).t) {
        const double phi = 0.5 * (e.from + e.to) + 0.5 * (e.to - e.from) * t;
        channel.sources.push_back(
            same ? Source{self, true, {}}
                 : source_of(elements, phi, delay, directional.period));
        PeriodElement& from = elements[channel.sources.back().element];
        from.wanted = true;
        from.kept = from.kept || channel.sources.back().previous;
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
  const double longest =
      directional.delays.empty() ? directional.period : directional.delays.front();
  const double cycle = Omega / fastest;  // [rad]
  const std::vector<double> kinks = returning_kinks(directional);
  for (const DirectionalElement& whole : directional.elements) {
    const std::vector<double> ends = parts_of(whole, kinks, cycle, longest);
    for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
      PeriodElement e{.from = ends[i], .to = ends[i + 1], .delayed = {}};
      const double length = e.to - e.from;
      const double n = 10 + 10 * length / pi + 3.5 * length / cycle;
      const int even = 2 * static_cast<int>(std::ceil(0.5 * n * resolution.factor));
      e.degree = std::clamp(even, 4, largest_degree);
      const bool cuts =
          std::any_of(whole.matrices.begin(), whole.matrices.end(),
                      [](const auto& channel) { return !channel.empty(); });
      const std::vector<double> rows = cuts ? rows_of(whole, e) : std::vector<double>();
      const auto channel_of = [&](const std::vector<Matrix2>& given) {
        e.forced = e.forced || !given.empty();
        return given.empty() ? Channel{}
                             : Channel{sampled(given, rows, components), {}};
      };
      e.own = channel_of(whole.matrices[0]);
      for (std::size_t d = 1; d < whole.matrices.size(); ++d) {
        e.delayed.push_back(channel_of(whole.matrices[d]));
      }
      out.all.push_back(std::move(e));
    }
  }
  add_sources(out.all, directional);
  for (PeriodElement& e : out.all) {
    e.kept = e.kept || resolution.whole_period;
    e.wanted = e.wanted || e.kept || e.forced;
    e.first = out.kept_values;
    e.place = out.wanted_values;
    out.kept_values += e.kept ? components.count * e.nodes() : 0;
    out.wanted_values += e.wanted ? components.count * e.nodes() : 0;
  }
  return out;
}

}  // namespace trochoid::dynamics
