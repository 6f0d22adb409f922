#include <trochoid/chip/teeth_at_height.h>

#include <trochoid/base/units.h>

#include <algorithm>
#include <cmath>

namespace trochoid::chip {

TeethAtHeight::TeethAtHeight(const geometry::ToothEdges& edges, const Passage& passage)
    : edges_(edges),
      passage_(passage),
      marks_(passage.marks),
      edge_(edges.teeth()),
      place_(edges.teeth(), -1) {
  tooth_.reserve(edges.teeth());
  positions_.reserve(edges.teeth());
}

void TeethAtHeight::stand_at(double height, double beyond) noexcept {
  for (std::size_t j = 0; j < edge_.size(); ++j) {
    edge_[j] = edges_.edge_at(j, height, beyond);
    place_[j] = edge_[j].there ? 0 : -1;
  }
  order();
}

void TeethAtHeight::stand_at(double height, double beyond,
                             const std::vector<char>& there) noexcept {
  for (std::size_t j = 0; j < edge_.size(); ++j) {
    place_[j] = there[j] != 0 ? 0 : -1;
    if (there[j] != 0) edge_[j] = edges_.edge_at(j, height, beyond);
  }
  order();
}

void TeethAtHeight::order() noexcept {
  tooth_.clear();
  positions_.clear();
  for (std::size_t j = 0; j < edge_.size(); ++j) {
    if (place_[j] < 0) continue;
    place_[j] = static_cast<int>(tooth_.size());
    tooth_.push_back(j);
    positions_.push_back(edge_[j].position);
  }
  const std::size_t n = tooth_.size();
  passage_.teeth = static_cast<int>(n);
  passage_.marks = std::min(marks_, passage_.teeth);
  passage_.back.resize(n * n);  // no more than before: nothing is allocated
  for (std::size_t j = 0; j < n; ++j) {
    for (std::size_t m = 1; m <= n; ++m) {
      const std::size_t k = (j + n - m % n) % n;
      double back = edge_[tooth_[j]].omega - edge_[tooth_[k]].omega;
      back -= unit::turn * std::floor(back / unit::turn);
      passage_.back[j * n + m - 1] = m == n ? unit::turn : back;  // C-20
    }
  }
}

Chip TeethAtHeight::chip(std::size_t tooth, double theta) const noexcept {
  return place_[tooth] < 0 ? Chip{}
                           : chip_at(passage_, slice(tooth), place_[tooth], theta);
}

double TeethAtHeight::boundary(std::size_t tooth, double theta, const Chip& a,
                               const Chip& b) const noexcept {
  return chip::boundary(passage_, slice(tooth), place_[tooth], theta, a, b);
}

int TeethAtHeight::nearest_mark(std::size_t tooth, double theta) const noexcept {
  if (place_[tooth] < 0) {
    return 0;
  }
  const auto n = static_cast<int>(tooth_.size());
  int best = 0;
  double least = 0.0;
  for (int m = 1; m <= passage_.marks; ++m) {
    const double above =
        chip_over_mark(passage_, slice(tooth), place_[tooth], theta, m);
    if (best == 0 || above < least) {
      best = m;
      least = above;
    }
  }
  const auto other = tooth_[static_cast<std::size_t>((place_[tooth] - best + n) % n)];
  const auto all = edge_.size();
  const std::size_t before = (tooth + all - other) % all;
  return static_cast<int>(before == 0 ? all : before);
}

}  // namespace trochoid::chip
