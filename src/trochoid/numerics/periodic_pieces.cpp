#include <trochoid/numerics/parallel.h>
#include <trochoid/numerics/periodic_pieces.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace trochoid::numerics {

namespace {

constexpr std::size_t nodes = 10;

/// Points on [-1, 1], and the matrix from values there to Chebyshev coefficients.
struct Rule {
  std::array<double, nodes> t;
  std::array<std::array<double, nodes>, nodes> coefficients;
};

Rule make_rule() {
  Rule rule{};
  const auto n = static_cast<double>(nodes);
  for (std::size_t i = 0; i < nodes; ++i) {
    const double angle = (static_cast<double>(i) + 0.5) * std::numbers::pi / n;
    rule.t[i] = std::cos(angle);
    for (std::size_t k = 0; k < nodes; ++k) {
      rule.coefficients[k][i] =
          (k == 0 ? 1.0 : 2.0) / n * std::cos(static_cast<double>(k) * angle);
    }
  }
  return rule;
}

const Rule& rule() {
  static const Rule it = make_rule();
  return it;
}

/// The panels of one interval without known kinks.
struct Panels {
  std::vector<double> ends;
  std::vector<double> coefficients;
};

struct Builder {
  const PeriodicPieces::Function& f;
  const PeriodicPieces::Options& options;

  void add(double from, double to, Panels& out) const {
    const std::size_t m = options.allowed.size();
    const double middle = 0.5 * (from + to);
    const double half = 0.5 * (to - from);
    std::vector<double> values(nodes * m);
    for (std::size_t i = 0; i < nodes; ++i) {
      f(middle + half * rule().t[i], std::span(values).subspan(i * m, m));
    }
    std::vector<double> series(nodes * m);
    for (std::size_t k = 0; k < nodes; ++k) {
      for (std::size_t i = 0; i < nodes; ++i) {
        const double c = rule().coefficients[k][i];
        for (std::size_t q = 0; q < m; ++q) {
          series[k * m + q] += c * values[i * m + q];
        }
      }
    }
    if (!resolved(series) && to - from > options.shortest) {
      add(from, middle, out);
      add(middle, to, out);
      return;
    }
    out.ends.push_back(to);
    out.coefficients.insert(out.coefficients.end(), series.begin(), series.end());
  }

  [[nodiscard]] bool resolved(const std::vector<double>& series) const {
    const std::size_t m = options.allowed.size();
    for (std::size_t q = 0; q < m; ++q) {
      const double last = std::max(std::abs(series[(nodes - 1) * m + q]),
                                   std::abs(series[(nodes - 2) * m + q]));
      if (last > options.allowed[q]) {
        return false;
      }
    }
    return true;
  }
};

/// Ends of the intervals between known kinks, none longer than allowed.
std::vector<double> first_ends(const PeriodicPieces::Options& options) {
  std::vector<double> marks = {options.start, options.start + options.period};
  for (const double x : options.breaks) {
    const double turns = std::floor((x - options.start) / options.period);
    marks.push_back(x - turns * options.period);
  }
  std::sort(marks.begin(), marks.end());
  std::vector<double> ends = {options.start};
  for (const double mark : marks) {
    const double from = ends.back();
    if (mark - from <= options.shortest) {
      continue;
    }
    const int count =
        std::max(1, static_cast<int>(std::ceil((mark - from) / options.longest)));
    for (int i = 1; i <= count; ++i) {
      ends.push_back(i == count ? mark : from + (mark - from) * i / count);
    }
  }
  ends.back() = options.start + options.period;
  return ends;
}

}  // namespace

PeriodicPieces::PeriodicPieces(const Function& f, const Options& options)
    : functions_(options.allowed.size()),
      start_(options.start),
      period_(options.period) {
  const std::vector<double> ends = first_ends(options);
  std::vector<Panels> parts(ends.size() - 1);
  const Builder builder{f, options};
  for_each_index(parts.size(),
                 [&](std::size_t i) { builder.add(ends[i], ends[i + 1], parts[i]); });
  for (const Panels& part : parts) {
    ends_.insert(ends_.end(), part.ends.begin(), part.ends.end());
    coefficients_.insert(coefficients_.end(), part.coefficients.begin(),
                         part.coefficients.end());
  }
  find_lower_bounds();
}

void PeriodicPieces::find_lower_bounds() {
  lower_bounds_.assign(functions_, std::numeric_limits<double>::infinity());
  for (std::size_t panel = 0; panel < ends_.size(); ++panel) {
    const double* c = coefficients_.data() + panel * nodes * functions_;
    for (std::size_t q = 0; q < functions_; ++q) {
      double least = c[q];
      for (std::size_t k = 1; k < nodes; ++k) {
        least -= std::abs(c[k * functions_ + q]);
      }
      lower_bounds_[q] = std::min(lower_bounds_[q], least);
    }
  }
}

PeriodicPieces::Place PeriodicPieces::place(double x) const noexcept {
  const double u = x - std::floor((x - start_) / period_) * period_;
  auto panel = static_cast<std::size_t>(
      std::upper_bound(ends_.begin(), ends_.end(), u) - ends_.begin());
  panel = std::min(panel, ends_.size() - 1);
  const double from = panel == 0 ? start_ : ends_[panel - 1];
  return {panel,
          std::clamp((2 * u - from - ends_[panel]) / (ends_[panel] - from), -1.0, 1.0)};
}

void PeriodicPieces::value(double x, std::span<double> out) const noexcept {
  const Place at = place(x);
  const double* c = coefficients_.data() + at.panel * nodes * functions_;
  for (std::size_t q = 0; q < functions_; ++q) {
    double next = 0.0;
    double after = 0.0;
    for (std::size_t k = nodes; k-- > 1;) {
      const double b = c[k * functions_ + q] + 2 * at.t * next - after;
      after = next;
      next = b;
    }
    out[q] = c[q] + at.t * next - after;
  }
}

PeriodicPieces PeriodicPieces::combined(std::span<const double> weights) const {
  PeriodicPieces result;
  result.functions_ = weights.size() / functions_;
  result.start_ = start_;
  result.period_ = period_;
  result.ends_ = ends_;
  const std::size_t rows = coefficients_.size() / functions_;
  result.coefficients_.assign(rows * result.functions_, 0.0);
  std::vector<std::size_t> used;  // most weights are zeros
  for (std::size_t p = 0; p < result.functions_; ++p) {
    const double* w = weights.data() + p * functions_;
    used.clear();
    for (std::size_t q = 0; q < functions_; ++q) {
      if (w[q] != 0) {
        used.push_back(q);
      }
    }
    for (std::size_t i = 0; i < rows; ++i) {
      const double* from = coefficients_.data() + i * functions_;
      double sum = 0.0;
      for (const std::size_t q : used) {
        sum += w[q] * from[q];
      }
      result.coefficients_[i * result.functions_ + p] = sum;
    }
  }
  result.find_lower_bounds();
  return result;
}

}  // namespace trochoid::numerics
