#include <trochoid/force/arc_turn.h>

#include <trochoid/base/units.h>

#include <algorithm>
#include <cmath>

// What the integrals of a turn say at an angle of the spindle.
namespace trochoid::force {

namespace {

/// A layer in which the edge lags less is cut at one angle [rad].
constexpr double shortest_lag = 1e-7;
/// Below this the moments over the height are those about the middle of the layer [rad].
constexpr double short_lag = 0.05;
/// How many of the integrals make up forces, and with their moments over the height.
constexpr std::size_t rows_of_force = 4;
constexpr std::size_t rows_with_heights = 10;

}  // namespace

ToothLoads& operator+=(ToothLoads& a, const ToothLoads& b) noexcept {
  a.x += b.x;
  a.y += b.y;
  a.z += b.z;
  a.torque += b.torque;
  for (std::size_t i = 0; i < 3; ++i) {
    a.moment_x[i] += b.moment_x[i];
    a.moment_y[i] += b.moment_y[i];
  }
  a.axial_x += b.axial_x;
  a.axial_y += b.axial_y;
  return a;
}

namespace {

/// A layer on its edge: z = A - theta/q, from its middle over a lag.
struct OnEdge {
  double A;
  double q;
  double middle;
  double lag;
};

/// Moments over the height from those over theta.
void add_window_moments(const std::array<double, 12>& v, const OnEdge& edge,
                        ToothLoads& out) noexcept {
  const auto& [A, q, m, lag] = edge;
  const double each = std::abs(q);
  for (std::size_t i = 0; i < 2; ++i) {
    std::array<double, 3>& moment = i == 0 ? out.moment_x : out.moment_y;
    const double whole = v[i] / each;
    const double first = (A * v[i] - v[4 + i] / q) / each;
    if (lag < short_lag) {
      const double about = lag < 1e-4 ? 0.0 : first - m * whole;
      moment[0] += m * whole + about;
      moment[1] += m * (m * whole + 2 * about);
      moment[2] += m * m * (m * whole + 3 * about);
      continue;
    }
    moment[0] += first;
    moment[1] += (A * A * v[i] - 2 * A * v[4 + i] / q + v[6 + i] / (q * q)) / each;
    moment[2] += (A * A * A * v[i] - 3 * A * A * v[4 + i] / q +
                  3 * A * v[6 + i] / (q * q) - v[8 + i] / (q * q * q)) /
                 each;
  }
}

}  // namespace

double ArcTurn::into_turn(double theta) noexcept {
  return theta - unit::turn * std::floor((theta - turn_start) / unit::turn);
}

bool ArcTurn::at_one_angle(const Layer& layer, const Edge& edge) const noexcept {
  return std::abs(edge.q) * (layer.to - layer.from) < shortest_lag;
}

ArcTurn::PerHeight ArcTurn::force_at_one_angle(const Layer& layer, const Edge& edge,
                                               double theta) const noexcept {
  const double h = ray(layer, edge, theta).h;
  return h > 0 ? per_height(edge, h, {std::sin(theta), std::cos(theta)}) : PerHeight{};
}

template <std::size_t Q, class Use>
void ArcTurn::for_each_window(const Layer& layer, const Edge& edge,
                              std::array<double, 2> phi_and_from,
                              const Use& use) const {
  const auto [phi, from] = phi_and_from;
  const double lag = std::abs(edge.q) * (layer.to - from);
  const double at_bottom = into_turn(phi - edge.behind - edge.q * (from - layer.from));
  // The window of theta, from the top to the bottom of the layer, and its images.
  const double ahead = edge.q < 0 ? lag : 0.0;
  for (double bottom = at_bottom - (edge.q < 0 ? unit::turn : 0.0);
       bottom + ahead - lag < turn_end; bottom += unit::turn) {
    const double first = std::max(bottom + ahead - lag, turn_start);
    const double last = std::min(bottom + ahead, turn_end);
    if (!(last > first)) continue;
    std::array<double, Q> v{};
    edge.integral.add_between(first, last, v);
    use(v, bottom);
  }
}

void ArcTurn::add_layer(const Layer& layer, const Edge& edge, double phi, double from,
                        ToothLoads& out) const noexcept {
  const double height = layer.to - from;
  const double middle = from + 0.5 * height;
  const auto add = [&](const PerHeight& F, double by) {
    out.x += by * F[0];
    out.y += by * F[1];
    out.z += by * F[2];
    out.torque += by * F[3] * edge.R;
  };
  if (at_one_angle(layer, edge)) {
    const double theta = into_turn(phi - edge.behind - edge.q * (middle - layer.from));
    const PerHeight F = force_at_one_angle(layer, edge, theta);
    add(F, height);
    out.axial_x += edge.R * std::sin(theta) * height * F[2];
    out.axial_y += edge.R * std::cos(theta) * height * F[2];
    for (std::size_t k = 0; options_.heights && k < 3; ++k) {
      const auto n = static_cast<int>(k) + 2;
      const double share = (std::pow(layer.to, n) - std::pow(from, n)) / n;
      out.moment_x[k] += share * F[0];
      out.moment_y[k] += share * F[1];
    }
    return;
  }
  const double q = std::abs(edge.q);
  for_each_window<all_values>(
      layer, edge, {phi, from}, [&](const Values& v, double bottom) {
        add({v[0], v[1], v[2], v[3]}, 1 / q);  // N-7
        if (!options_.heights) return;
        out.axial_x += edge.R * v[10] / q;
        out.axial_y += edge.R * v[11] / q;
        const double A = from + bottom / edge.q;  // z = A - theta/q
        add_window_moments(v, {A, edge.q, middle, q * height}, out);
      });
}

ToothLoads ArcTurn::at(std::size_t tooth, double phi, double above) const noexcept {
  ToothLoads out;
  for (const Layer& layer : layers_) {
    if (layer.edges[tooth].place >= 0 && layer.to > above) {
      add_layer(layer, layer.edges[tooth], phi, std::max(layer.from, above), out);
    }
  }
  return out;
}

void ArcTurn::add_windows(const Layer& layer, const Edge& edge,
                          std::span<const double> phi,
                          std::span<ToothLoads> out) const {
  const std::size_t n = phi.size();
  const std::size_t rows = options_.heights ? rows_with_heights : rows_of_force;
  const double height = layer.to - layer.from;
  const double lag = std::abs(edge.q) * height;
  const double ahead = edge.q < 0 ? lag : 0.0;
  const double middle = 0.5 * (layer.from + layer.to);
  std::vector<double> window(rows * n);
  const auto from_place = [&](double place, std::size_t first, std::size_t last) {
    const auto at = phi.begin();
    const auto found = std::lower_bound(at + static_cast<std::ptrdiff_t>(first),
                                        at + static_cast<std::ptrdiff_t>(last), place);
    return static_cast<std::size_t>(found - at);
  };
  for (std::size_t i = 0; i < n;) {
    // The same turns back for all angles from this one to another.
    const double back = phi[i] - into_turn(phi[i] - edge.behind);
    const std::size_t end = from_place(back + turn_end, i + 1, n);
    for (double shift = -back - (edge.q < 0 ? unit::turn : 0.0);
         phi[i] + shift + ahead - lag < turn_end; shift += unit::turn) {
      const auto first = from_place(edge.ends.front() - shift - ahead, i, end);
      const std::span<const double> some = phi.subspan(
          first,
          from_place(edge.ends.back() - shift - ahead + lag, first, end) - first);
      const std::span<double> v = std::span(window).first(rows * some.size());
      std::ranges::fill(v, 0.0);
      edge.integral.add_between(some, shift + ahead - lag, shift + ahead, v);
      for (std::size_t k = 0; k < some.size(); ++k) {
        const auto at = [&](std::size_t row) { return v[row * some.size() + k]; };
        if (at(0) == 0 && at(1) == 0 && at(2) == 0) continue;
        ToothLoads one{.x = at(0) / std::abs(edge.q),  // N-7
                       .y = at(1) / std::abs(edge.q),
                       .z = at(2) / std::abs(edge.q),
                       .torque = at(3) * edge.R / std::abs(edge.q)};
        if (options_.heights) {
          std::array<double, all_values> values{};
          for (std::size_t row = 0; row < rows; ++row) values[row] = at(row);
          const double A = layer.from + (some[k] + shift) / edge.q;
          add_window_moments(values, {A, edge.q, middle, lag}, one);
        }
        out[first + k] += one;
      }
    }
    i = end;
  }
}

std::vector<ToothLoads> ArcTurn::loads_at(std::size_t tooth,
                                          std::span<const double> phi) const {
  std::vector<ToothLoads> out(phi.size());
  for (const Layer& layer : layers_) {
    const Edge& edge = layer.edges[tooth];
    if (edge.place < 0 || edge.ends.empty()) continue;
    if (!at_one_angle(layer, edge)) {
      add_windows(layer, edge, phi, out);
      continue;
    }
    for (std::size_t i = 0; i < phi.size(); ++i) {
      add_layer(layer, edge, phi[i], layer.from, out[i]);
    }
  }
  return out;
}

std::vector<double> ArcTurn::events() const {
  std::vector<double> out;
  for (std::size_t l = 0; l < layers_.size(); ++l) {
    const Layer& layer = layers_[l];
    const Layer* const below = l > 0 ? &layers_[l - 1] : nullptr;
    const Layer* const above = l + 1 < layers_.size() ? &layers_[l + 1] : nullptr;
    for (std::size_t j = 0; j < layer.edges.size(); ++j) {
      const Edge& edge = layer.edges[j];
      // What ends alike in two layers that touch has no kink between them.
      const auto add = [&](double z, const Layer* next) {
        const bool touches =
            next != nullptr && (next->to == layer.from || next->from == layer.to);
        for (const double end : edge.ends) {
          if (touches && std::ranges::binary_search(next->edges[j].ends, end)) continue;
          const double phi = end + edge.behind + edge.q * z;
          out.push_back(phi - unit::turn * std::floor(phi / unit::turn));
        }
      };
      add(0.0, below);
      add(layer.to - layer.from, above);
    }
  }
  std::ranges::sort(out);
  out.erase(std::unique(out.begin(), out.end(),
                        [](double a, double b) { return b - a < 1e-9; }),
            out.end());
  return out;
}

}  // namespace trochoid::force
