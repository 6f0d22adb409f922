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
  // Several functions side by side: one alone waits for each of its steps.
  constexpr std::size_t together = 4;
  const Place at = place(x);
  const double* c = coefficients_.data() + at.panel * nodes * functions_;
  const double twice = 2 * at.t;
  std::size_t q = 0;
  for (; q + together <= functions_; q += together) {
    std::array<double, together> next{};
    std::array<double, together> after{};
    for (std::size_t k = nodes; k-- > 1;) {
      for (std::size_t i = 0; i < together; ++i) {
        const double b = c[k * functions_ + q + i] + twice * next[i] - after[i];
        after[i] = next[i];
        next[i] = b;
      }
    }
    for (std::size_t i = 0; i < together; ++i) {
      out[q + i] = c[q + i] + at.t * next[i] - after[i];
    }
  }
  for (; q < functions_; ++q) {
    double next = 0.0;
    double after = 0.0;
    for (std::size_t k = nodes; k-- > 1;) {
      const double b = c[k * functions_ + q] + twice * next - after;
      after = next;
      next = b;
    }
    out[q] = c[q] + at.t * next - after;
  }
}

namespace {

/// Rows of functions times weights.
class Combination {
 public:
  Combination(std::span<const double> weights, std::size_t functions)
      : weights_(weights), functions_(functions) {}

  /// Where most weights are zeros.
  void of_few(std::span<const double> from, std::span<double> out) const {
    std::vector<std::size_t> used;
    for (std::size_t p = 0; p < results(); ++p) {
      const double* w = weights_.data() + p * functions_;
      used.clear();
      for (std::size_t q = 0; q < functions_; ++q) {
        if (w[q] != 0) {
          used.push_back(q);
        }
      }
      for (std::size_t i = 0; i * functions_ < from.size(); ++i) {
        double sum = 0.0;
        for (const std::size_t q : used) {
          sum += w[q] * from[i * functions_ + q];
        }
        out[i * results() + p] = sum;
      }
    }
  }

  /// Several results side by side.
  void of_all(std::span<const double> from, std::span<double> out) const {
    constexpr std::size_t together = 4;
    using Block = std::array<double, together>;
    std::vector<Block> of_function(functions_);
    for (std::size_t p = 0; p < results(); p += together) {
      const std::size_t count = std::min(together, results() - p);
      for (std::size_t q = 0; q < functions_; ++q) {
        for (std::size_t k = 0; k < count; ++k) {
          of_function[q][k] = weights_[(p + k) * functions_ + q];
        }
      }
      for (std::size_t i = 0; i * functions_ < from.size(); ++i) {
        const double* row = from.data() + i * functions_;
        Block sum{};
        for (std::size_t q = 0; q < functions_; ++q) {
          for (std::size_t k = 0; k < together; ++k) {
            sum[k] += of_function[q][k] * row[q];
          }
        }
        std::copy_n(sum.begin(), count,
                    out.begin() + static_cast<std::ptrdiff_t>(i * results() + p));
      }
    }
  }

 private:
  [[nodiscard]] std::size_t results() const noexcept {
    return weights_.size() / functions_;
  }

  std::span<const double> weights_;
  std::size_t functions_;
};

}  // namespace

double PeriodicPieces::largest(std::span<const double> weights) const noexcept {
  double most = 0.0;
  for (std::size_t panel = 0; panel < ends_.size(); ++panel) {
    double sum = 0.0;
    for (std::size_t k = 0; k < nodes; ++k) {
      const double* c = coefficients_.data() + (panel * nodes + k) * functions_;
      for (std::size_t q = 0; q < weights.size(); ++q) {
        sum += weights[q] * std::abs(c[q]);
      }
    }
    most = std::max(most, sum);
  }
  return most;
}

bool PeriodicPieces::at(std::size_t panel, std::span<const Part> parts) const noexcept {
  const double from = panel == 0 ? start_ : ends_[panel - 1];
  const double length = ends_[panel] - from;
  return std::ranges::any_of(parts, [&](const Part& part) {
    // From the start of the part on, where does the panel begin?
    const double ahead = from - part.from;
    const double u = ahead - std::floor(ahead / period_) * period_;
    return u <= part.to - part.from || u + length >= period_;
  });
}

PeriodicPieces PeriodicPieces::combined(std::span<const double> weights) const {
  const Part all{start_, start_ + period_};
  return combined(weights, {&all, 1});
}

PeriodicPieces PeriodicPieces::combined(std::span<const double> weights,
                                        std::span<const Part> parts) const {
  PeriodicPieces result;
  result.functions_ = weights.size() / functions_;
  result.start_ = start_;
  result.period_ = period_;
  result.ends_ = ends_;
  result.coefficients_.assign(ends_.size() * nodes * result.functions_, 0.0);
  const auto zeros = std::count(weights.begin(), weights.end(), 0.0);
  const bool few = 2 * static_cast<std::size_t>(zeros) > weights.size();
  const Combination combination(weights, functions_);
  for (std::size_t panel = 0; panel < ends_.size();) {
    std::size_t end = panel;
    while (end < ends_.size() && at(end, parts)) {
      ++end;
    }
    const auto out = std::span(result.coefficients_)
                         .subspan(panel * nodes * result.functions_,
                                  (end - panel) * nodes * result.functions_);
    const auto from =
        std::span(coefficients_)
            .subspan(panel * nodes * functions_, (end - panel) * nodes * functions_);
    few ? combination.of_few(from, out) : combination.of_all(from, out);
    for (panel = end; panel < ends_.size() && !at(panel, parts); ++panel) {
      std::fill_n(result.coefficients_.begin() +
                      static_cast<std::ptrdiff_t>(panel * nodes * result.functions_),
                  result.functions_, std::numeric_limits<double>::infinity());
    }
  }
  result.find_lower_bounds();
  return result;
}

}  // namespace trochoid::numerics
