#include <trochoid/identification/products.h>
#include <trochoid/numerics/correlation.h>

#include <numeric>

namespace trochoid::identification {
namespace {

/// The force matrix in the cells, one entry after the other.
class Planes {
 public:
  /// @param measured  axes that count; the others are as good as zero
  Planes(std::span<const double> C, std::size_t columns,
         const std::array<bool, 3>& measured)
      : columns_(columns),
        length_(2 * C.size() / (3 * columns)),
        values_(3 * columns * length_),
        zero_(3 * columns, true) {
    const std::size_t n = length_ / 2;
    for (std::size_t entry = 0; entry < zero_.size(); ++entry) {
      double* const plane = &values_[entry * length_];
      for (std::size_t i = 0; i < n; ++i) {
        plane[i] = plane[n + i] = C[i * zero_.size() + entry];
        if (plane[i] != 0.0 && measured[entry / columns]) zero_[entry] = false;
      }
    }
  }

  [[nodiscard]] std::size_t length() const noexcept { return length_; }
  [[nodiscard]] bool zero(std::size_t q, std::size_t column) const {
    return zero_[q * columns_ + column];
  }
  /// Axis q of a column in each cell, two times in a row.
  [[nodiscard]] std::span<const double> of(std::size_t q, std::size_t column) const {
    return std::span(values_).subspan((q * columns_ + column) * length_, length_);
  }

 private:
  std::size_t columns_;
  std::size_t length_;
  std::vector<double> values_;
  std::vector<bool> zero_;
};

/// sum over the axes of column a times column b in each cell; empty where it is zero.
void multiply(const Planes& planes, std::size_t a, std::size_t b,
              std::vector<double>& out) {
  out.clear();
  for (std::size_t q = 0; q < 3; ++q) {
    if (planes.zero(q, a) || planes.zero(q, b)) continue;
    out.resize(planes.length(), 0.0);
    const std::span<const double> x = planes.of(q, a);
    const std::span<const double> y = planes.of(q, b);
    for (std::size_t i = 0; i < out.size(); ++i) out[i] += x[i] * y[i];
  }
}

/// Weighted sums of each axis of each column at every shift, shape (3 columns, shifts).
std::vector<double> sums_of_columns(const Cells& cells, const Planes& planes,
                                    std::size_t columns, std::size_t shifts) {
  std::vector<double> out(3 * columns * shifts, 0.0);
  for (std::size_t q = 0; q < 3; ++q) {
    for (std::size_t a = 0; a < columns; ++a) {
      if (planes.zero(q, a)) continue;
      numerics::correlate(cells.weight, planes.of(q, a),
                          std::span(out).subspan((q * columns + a) * shifts, shifts));
    }
  }
  return out;
}

/// About the means of the axes.
void center(const Cells& cells, const Planes& planes, std::size_t shifts,
            Products& out) {
  const std::size_t n = out.columns;
  const double weight = std::accumulate(cells.weight.begin(), cells.weight.end(), 0.0);
  const std::vector<double> sums = sums_of_columns(cells, planes, n, shifts);
  for (std::size_t s = 0; s < shifts; ++s) {
    for (std::size_t q = 0; q < 3; ++q) {
      for (std::size_t a = 0; a < n; ++a) {
        const double mean = sums[(q * n + a) * shifts + s] / weight;
        for (std::size_t b = 0; b < n; ++b) {
          out.G[(s * n + a) * n + b] -= mean * sums[(q * n + b) * shifts + s];
        }
      }
    }
  }
}

void fill_gram(const Cells& cells, const Planes& planes, Products& out) {
  const std::size_t n = out.columns;
  // With equal weights a shift changes the order of the sums only.
  const std::size_t shifts = cells.even ? 1 : out.shifts;
  out.G.assign(shifts * n * n, 0.0);
  std::vector<double> product;
  std::vector<double> sums(shifts);
  for (std::size_t a = 0; a < n; ++a) {
    for (std::size_t b = 0; b <= a; ++b) {
      multiply(planes, a, b, product);
      if (product.empty()) continue;
      numerics::correlate(cells.weight, product, sums);
      for (std::size_t s = 0; s < shifts; ++s) {
        out.G[(s * n + a) * n + b] = out.G[(s * n + b) * n + a] = sums[s];
      }
    }
  }
  if (cells.centered) center(cells, planes, shifts, out);
}

/// w F of one channel, about its mean where that does not count; about the mean of the
/// channel it is about that of the axis too.
std::vector<double> weighted_channel(const Cells& cells, std::size_t c) {
  std::vector<double> out(cells.size());
  for (std::size_t i = 0; i < out.size(); ++i) {
    out[i] = cells.weight[i] * cells.force[i][c];
  }
  if (!cells.centered) return out;
  const double mean = std::accumulate(out.begin(), out.end(), 0.0) /
                      std::accumulate(cells.weight.begin(), cells.weight.end(), 0.0);
  for (std::size_t i = 0; i < out.size(); ++i) out[i] -= cells.weight[i] * mean;
  return out;
}

void fill_right(const Cells& cells, const Planes& planes, Products& out) {
  const std::size_t n = out.columns;
  const std::size_t width = out.mixed ? 9 * n : n;
  out.X.assign(out.shifts * width, 0.0);
  std::vector<double> products(out.shifts);
  for (std::size_t c = 0; c < 3; ++c) {
    const std::vector<double> wF = weighted_channel(cells, c);
    for (std::size_t q = 0; q < 3; ++q) {
      if (c != q && !out.mixed) continue;
      const std::size_t place = out.mixed ? (3 * q + c) * n : 0;
      for (std::size_t a = 0; a < n; ++a) {
        if (planes.zero(q, a)) continue;
        numerics::correlate(wF, planes.of(q, a), products);
        for (std::size_t s = 0; s < out.shifts; ++s) {
          out.X[s * width + place + a] += products[s];
        }
      }
    }
  }
}

}  // namespace

Products products(const Cells& cells, std::span<const double> C, std::size_t count,
                  bool mixed) {
  Products out;
  out.columns = C.size() / (3 * cells.size());
  out.shifts = count;
  out.mixed = mixed;
  const Planes planes(C, out.columns, cells.measured);
  fill_gram(cells, planes, out);  // I-12
  fill_right(cells, planes, out);
  return out;
}

}  // namespace trochoid::identification
