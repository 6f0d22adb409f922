#include <trochoid/force/turn_numbers.h>

#include <trochoid/base/units.h>
#include <trochoid/force/turn_kernel.h>

#include <algorithm>
#include <cmath>
#include <span>

namespace trochoid::force {

namespace {

using Complex = std::complex<double>;
using NumberSums = std::array<Complex, 3>;
constexpr Complex i(0.0, 1.0);

struct Segment {
  double from;
  double to;
  std::size_t number;
};

template <class Function>
void for_each_segment(const TurnPolynomial& turn, const Function& f) {
  double from = 0.0;
  for (std::size_t n = 0; n < turn.ends.size(); ++n) {
    f(Segment{from, turn.ends[n], n});
    from = turn.ends[n];
  }
}

/// Integral of exp(i m phi).
Complex wave(int m, const Segment& s) {
  if (m == 0) {
    return s.to - s.from;
  }
  return (std::polar(1.0, m * s.to) - std::polar(1.0, m * s.from)) /
         (i * static_cast<double>(m));
}

/// Integral of phi exp(-i n phi).
Complex rising_wave(int n, const Segment& s) {
  if (n == 0) {
    return 0.5 * (s.to * s.to - s.from * s.from);
  }
  const auto end = [n](double phi) { return phi * std::polar(1.0, -n * phi); };
  return (end(s.to) - end(s.from) - wave(-n, s)) / (-i * static_cast<double>(n));
}

void add(const Triple& factors, Complex value, NumberSums& sums) {
  for (std::size_t q = 0; q < sums.size(); ++q) {
    sums[q] += factors[q] * value;
  }
}

Triple value_at(const TurnPanel& panel, double phi) {
  const double t = std::clamp((phi - panel.from) * panel.per_half - 1, -1.0, 1.0);
  Triple value{};
  for (std::size_t k = panel.powers.size(); k-- > 0;) {
    for (std::size_t q = 0; q < value.size(); ++q) {
      value[q] = value[q] * t + panel.powers[k][q];
    }
  }
  return value;
}

/// Panels are short and smooth: a Gauss rule on parts in which the wave is slow.
void add_panel(const TurnPanel& panel, const Segment& s, int n, NumberSums& sums) {
  constexpr std::array<double, 4> node = {0.1834346424956498, 0.5255324099163290,
                                          0.7966664774136267, 0.9602898564975363};
  constexpr std::array<double, 4> weight = {0.3626837833783620, 0.3137066458778873,
                                            0.2223810344533745, 0.1012285362903763};
  const int parts = 1 + static_cast<int>(n * (s.to - s.from));
  const double half = 0.5 * (s.to - s.from) / parts;
  for (int part = 0; part < parts; ++part) {
    const double middle = s.from + (2 * part + 1) * half;
    for (std::size_t k = 0; k < node.size(); ++k) {
      for (const double side : {-1.0, 1.0}) {
        const double phi = middle + side * half * node[k];
        add(value_at(panel, phi), half * weight[k] * std::polar(1.0, -n * phi), sums);
      }
    }
  }
}

std::span<const int> panels_of(const TurnPolynomial& turn, std::size_t segment) {
  const auto first = static_cast<std::size_t>(turn.first_panel[segment]);
  const auto end = static_cast<std::size_t>(turn.first_panel[segment + 1]);
  return std::span(turn.panel_places).subspan(first, end - first);
}

std::array<double, 3> at(const TurnPolynomial& turn, double phi) {
  std::array<double, 3> out{};
  evaluate(turn, {&phi, 1}, out);
  return out;
}

void widen(Extremes& extremes, double phi, double value) {
  if (value < extremes.min.value) {
    extremes.min = {phi, value};
  }
  if (value > extremes.max.value) {
    extremes.max = {phi, value};
  }
}

/// Where a function turns between two angles with slopes of different signs.
double turning_point(const TurnPolynomial& slopes, std::size_t q, double lo,
                     double hi) {
  const bool falls = at(slopes, lo)[q] > 0;
  while (hi - lo > 1e-13) {
    const double middle = 0.5 * (lo + hi);
    if (!(middle > lo && middle < hi)) {
      break;
    }
    ((at(slopes, middle)[q] > 0) == falls ? lo : hi) = middle;
  }
  return 0.5 * (lo + hi);
}

}  // namespace

std::array<double, 3> mean(const TurnPolynomial& turn) {
  const NumberSums c = harmonic(turn, 0);
  return {c[0].real(), c[1].real(), c[2].real()};
}

NumberSums harmonic(const TurnPolynomial& turn, int n) {
  NumberSums sums{};
  for_each_segment(turn, [&](const Segment& s) {
    const Triple* const terms = &turn.terms[s.number * turn.terms_of_segment()];
    add(terms[0], wave(-n, s), sums);
    add(terms[1], rising_wave(n, s), sums);
    for (int k = 1; k <= turn.highest; ++k) {
      const std::size_t cosine = 2 * static_cast<std::size_t>(k);
      const Complex forward = wave(k - n, s);
      const Complex backward = wave(-k - n, s);
      add(terms[cosine], 0.5 * (forward + backward), sums);
      add(terms[cosine + 1], (forward - backward) / (2.0 * i), sums);
    }
    for (const int place : panels_of(turn, s.number)) {
      add_panel(turn.panels[static_cast<std::size_t>(place)], s, n, sums);
    }
  });
  for (Complex& sum : sums) {
    sum /= unit::turn;  // F-14
  }
  return sums;
}

TurnPolynomial derivative(const TurnPolynomial& turn) {
  TurnPolynomial out = turn;
  const std::size_t count = turn.terms_of_segment();
  for (std::size_t n = 0; n < turn.ends.size(); ++n) {
    const Triple* const from = &turn.terms[n * count];
    Triple* const to = &out.terms[n * count];
    to[0] = from[1];
    to[1] = {};
    for (int k = 1; k <= turn.highest; ++k) {
      const std::size_t cosine = 2 * static_cast<std::size_t>(k);
      for (std::size_t q = 0; q < to[0].size(); ++q) {
        to[cosine][q] = k * from[cosine + 1][q];
        to[cosine + 1][q] = -k * from[cosine][q];
      }
    }
  }
  for (TurnPanel& panel : out.panels) {
    for (std::size_t k = 0; k < panel.powers.size(); ++k) {
      for (std::size_t q = 0; q < panel.powers[k].size(); ++q) {
        const double above = k + 1 < panel.powers.size() ? panel.powers[k + 1][q] : 0.0;
        panel.powers[k][q] = static_cast<double>(k + 1) * panel.per_half * above;
      }
    }
  }
  return out;
}

std::vector<double> jumps(const TurnPolynomial& turn, double least) {
  std::vector<double> out;
  for (const double end : turn.ends) {
    const auto before = at(turn, std::nextafter(end, 0.0));
    const auto after = at(turn, end);
    double largest = 0.0;
    for (std::size_t q = 0; q < before.size(); ++q) {
      largest = std::max(largest, std::abs(after[q] - before[q]));
    }
    if (largest > least) {
      out.push_back(end);
    }
  }
  return out;
}

std::array<Extremes, 3> extremes(const TurnPolynomial& turn) {
  const TurnPolynomial slopes = derivative(turn);
  const auto start = at(turn, 0.0);
  std::array<Extremes, 3> out;
  for (std::size_t q = 0; q < out.size(); ++q) {
    out[q] = {{0.0, start[q]}, {0.0, start[q]}};
  }
  // Closer than the extremes of the highest harmonic.
  const double step = unit::turn / (8.0 * turn.highest);
  for_each_segment(turn, [&](const Segment& s) {
    const int parts = 1 + static_cast<int>((s.to - s.from) / step);
    const double last = std::nextafter(s.to, 0.0);
    double before = s.from;
    auto slope_before = at(slopes, before);
    for (int part = 1; part <= parts; ++part) {
      const double phi = part == parts ? last : s.from + part * (s.to - s.from) / parts;
      const auto value = at(turn, phi);
      const auto slope = at(slopes, phi);
      for (std::size_t q = 0; q < out.size(); ++q) {
        widen(out[q], phi, value[q]);
        if ((slope[q] > 0) != (slope_before[q] > 0)) {
          const double top = turning_point(slopes, q, before, phi);
          widen(out[q], top, at(turn, top)[q]);
        }
      }
      before = phi;
      slope_before = slope;
    }
    const auto value = at(turn, s.from);
    for (std::size_t q = 0; q < out.size(); ++q) {
      widen(out[q], s.from, value[q]);
    }
  });
  return out;
}

}  // namespace trochoid::force
