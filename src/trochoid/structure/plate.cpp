#include <trochoid/structure/patches.h>
#include <trochoid/structure/plate.h>

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <stdexcept>
#include <utility>

namespace trochoid::structure {

namespace {

/// Degrees that are tried one after the other.
constexpr std::array<std::size_t, 11> degrees = {6,  8,  11, 15, 20, 27,
                                                 36, 48, 64, 86, 115};
/// Beyond this many terms the plate is given up.
constexpr std::size_t most_terms = 20000;
/// The error falls at least with this power of the degree, even for a point load that
/// lies inside a patch.
constexpr double order = 2.0;
/// Where the error is looked at, from the top of a patch down, in parts of it.
constexpr std::array<double, 9> probed_at_top = {0.0,  0.02, 0.06, 0.14, 0.26,
                                                 0.38, 0.52, 0.67, 0.84};
constexpr std::array<double, 3> probed_below = {0.14, 0.38, 0.62};

/// Layers within the wall, one above the other.
bool sound_layers(const Plate& plate) {
  double below = 0.0;
  for (const Layer& layer : plate.layers) {
    if (!(layer.from > below && layer.from < plate.height && layer.thickness > 0 &&
          std::isfinite(layer.thickness))) {
      return false;
    }
    below = layer.from;
  }
  return true;
}

void check(const Plate& plate, std::span<const double> x) {
  const bool sound = std::isfinite(plate.length + plate.height + plate.thickness +
                                   plate.youngs_modulus) &&
                     plate.length > 0 && plate.height > 0 && plate.thickness > 0 &&
                     plate.youngs_modulus > 0 && plate.poisson_ratio > -1 &&
                     plate.poisson_ratio <= 0.5 && sound_layers(plate);
  if (!sound) {
    throw std::invalid_argument(fmt::format(
        "no plate: length {}, height {}, thickness {}, E {}, nu {}, {} layers",
        plate.length, plate.height, plate.thickness, plate.youngs_modulus,
        plate.poisson_ratio, plate.layers.size()));
  }
  for (const double at : x) {
    if (!(at >= 0 && at <= plate.length)) {
      throw std::invalid_argument(
          fmt::format("x = {} is outside 0..{}", at, plate.length));
    }
  }
}

std::vector<double> line_shapes(const PatchBasis& basis, std::span<const double> y) {
  std::vector<double> shapes;
  for (const double at : y) {
    const std::vector<double> values = basis.values(at);
    shapes.insert(shapes.end(), values.begin(), values.end());
  }
  return shapes;
}

/// Loads where the error is looked at.
struct Probes {
  std::vector<double> x;
  std::vector<double> y;  ///< the free edge first
};

Probes probes(const Patches& patches) {
  Probes out{.x = patches.loads, .y = {}};
  const double height = patches.y.back();
  const double top = height - patches.y[patches.y.size() - 2];
  for (const double down : probed_at_top) {
    out.y.push_back(height - down * top);
  }
  for (std::size_t i = patches.y.size() - 2; i > 0; --i) {
    for (const double part : probed_below) {
      const double y = patches.y[i] - part * (patches.y[i] - patches.y[i - 1]);
      if (height - y <= patches.depth) {
        out.y.push_back(y);
      }
    }
  }
  return out;
}

/// Deflections under the probes themselves, times D, shape (x, y).
std::vector<double> deflections(const RitzSystem& ritz, const Probes& probes) {
  std::vector<double> out;
  const std::vector<double> fy = line_shapes(ritz.y(), probes.y);
  for (const double at : probes.x) {
    const std::vector<double> z = ritz.reduced(ritz.x().values(at), fy);
    for (std::size_t j = 0; j < probes.y.size(); ++j) {
      const std::span<const double> row(z.data() + j * ritz.size(), ritz.size());
      out.push_back(products(row, row, ritz.size()).front());
    }
  }
  return out;
}

/// Largest change of a deflection, as a part of that of the loaded edge.
/// @param rows  probes in y
double largest_change(const std::vector<double>& before, const std::vector<double>& now,
                      std::size_t rows) {
  double change = 0.0;
  for (std::size_t i = 0; i < now.size(); ++i) {
    const double edge = now[i - i % rows];
    change = std::max(change, std::abs(now[i] - before[i]) / edge);
  }
  return change;
}

/// What is left to come after a change from one degree to the next.
double remainder(double change, std::size_t degree) {
  const double r = std::pow(
      static_cast<double>(degrees[degree - 1]) / static_cast<double>(degrees[degree]),
      order);
  return change * r / (1 - r);  // B-8
}

/// Degrees in x and y, and what each still leaves of the error.
struct Refinement {
  std::size_t x = 0;  ///< index of degrees
  std::size_t y = 0;
  double x_error = std::numeric_limits<double>::infinity();
  double y_error = std::numeric_limits<double>::infinity();
};

/// Rigidities of the patches in y, as parts of that of the foot; none: all alike.
std::vector<double> rigidities(const Plate& plate, const Patches& patches) {
  std::vector<double> parts;
  for (std::size_t i = 0; !plate.layers.empty() && i + 1 < patches.y.size(); ++i) {
    const double middle = (patches.y[i] + patches.y[i + 1]) / 2;
    parts.push_back(std::pow(thickness_at(plate, middle) / plate.thickness, 3));  // B-9
  }
  return parts;
}

RitzSystem system(const Plate& plate, const Patches& patches, const Refinement& at) {
  return {PatchBasis(patches.x, degrees[at.x], clamps_of(plate.ends)),
          PatchBasis(patches.y, degrees[at.y], {.start = true, .end = false}),
          plate.poisson_ratio, rigidities(plate, patches)};
}

}  // namespace

double thickness_at(const Plate& plate, double y) {
  double thickness = plate.thickness;
  for (const Layer& layer : plate.layers) {
    thickness = layer.from <= y ? layer.thickness : thickness;
  }
  return thickness;
}

double flexural_rigidity(const Plate& plate) {
  const double t = plate.thickness;
  const double nu = plate.poisson_ratio;
  return plate.youngs_modulus * t * t * t / (12 * (1 - nu * nu));  // B-3
}

PlateSolution::Refined PlateSolution::refined(const Plate& plate,
                                              std::span<const double> x,
                                              double tolerance, double depth) {
  check(plate, x);
  if (x.empty()) {
    throw std::invalid_argument("a wall without a load");
  }
  const Patches mesh = patches(plate, x, depth);
  const Probes at = probes(mesh);
  Refinement now;
  Refined out{.ritz = system(plate, mesh, now),
              .depth = mesh.depth,
              .error = std::numeric_limits<double>::infinity()};
  std::vector<double> before = deflections(out.ritz, at);
  while (!out.converged && out.ritz.size() < most_terms) {
    const bool along_x = now.x_error >= now.y_error;
    std::size_t& degree = along_x ? now.x : now.y;
    if (++degree == degrees.size()) {
      break;
    }
    out.ritz = system(plate, mesh, now);
    std::vector<double> after = deflections(out.ritz, at);
    (along_x ? now.x_error : now.y_error) =
        remainder(largest_change(before, after, at.y.size()), degree);
    out.error = now.x_error + now.y_error;
    out.converged = out.error <= tolerance;
    before = std::move(after);
  }
  return out;
}

PlateSolution::PlateSolution(const Plate& plate, double x, double tolerance,
                             double depth)
    : PlateSolution(plate, std::span<const double>(&x, 1), tolerance, depth) {}

PlateSolution::PlateSolution(const Plate& plate, std::span<const double> x,
                             double tolerance, double depth)
    : plate_(plate),
      D_(flexural_rigidity(plate)),
      found_(refined(plate, x, tolerance, depth)) {
  std::vector<double> over_height = ritz().y().means(0, plate.height);
  for (double& f : over_height) {
    f *= plate.height;
  }
  even_pressure_ = reduced_along(over_height);
  edge_load_ = reduced_along(ritz().y().values(plate.height));
}

std::vector<double> PlateSolution::reduced_along(std::span<const double> fy) const {
  std::vector<double> fx = ritz().x().means(0, plate_.length);
  for (double& f : fx) {
    f *= plate_.length;
  }
  return ritz().reduced(fx, fy);
}

void PlateSolution::check_line(double x, std::span<const double> y) const {
  check(plate_, std::span<const double>(&x, 1));
  for (const double at : y) {
    if (!(at >= 0 && at <= plate_.height)) {
      throw std::invalid_argument(
          fmt::format("y = {} is outside 0..{}", at, plate_.height));
    }
  }
}

std::vector<double> PlateSolution::reduced(double x, std::span<const double> y) const {
  check_line(x, y);
  return ritz().reduced(ritz().x().values(x), line_shapes(ritz().y(), y));
}

std::vector<double> PlateSolution::influence(double x_observed,
                                             std::span<const double> y_observed,
                                             double x_loaded,
                                             std::span<const double> y_loaded) const {
  const std::vector<double> loaded = reduced(x_loaded, y_loaded);
  const bool same =
      x_observed == x_loaded && std::equal(y_observed.begin(), y_observed.end(),
                                           y_loaded.begin(), y_loaded.end());
  std::vector<double> G =
      products(same ? loaded : reduced(x_observed, y_observed), loaded, ritz().size());
  for (double& g : G) {
    g /= D_;  // B-7
  }
  return G;
}

std::vector<double> PlateSolution::line_load(double x_observed,
                                             std::span<const double> y_observed,
                                             double x_loaded, double y_from,
                                             double y_to) const {
  if (!(y_from >= 0 && y_to >= y_from && y_to <= plate_.height)) {
    throw std::invalid_argument(fmt::format("the load from {} to {} is not on 0..{}",
                                            y_from, y_to, plate_.height));
  }
  check(plate_, std::span<const double>(&x_loaded, 1));
  const std::vector<double> loaded =
      ritz().reduced(ritz().x().values(x_loaded), ritz().y().means(y_from, y_to));
  std::vector<double> w =
      products(reduced(x_observed, y_observed), loaded, ritz().size());
  for (double& one : w) {
    one /= D_;
  }
  return w;
}

std::vector<double> PlateSolution::couple(Line observed, Line loaded,
                                          Along along) const {
  check_line(loaded.x, loaded.y);
  const PatchBasis& bx = ritz().x();
  const PatchBasis& by = ritz().y();
  std::vector<double> fy;
  for (const double y : loaded.y) {
    const std::vector<double> f = along == Along::y ? by.slopes(y) : by.values(y);
    fy.insert(fy.end(), f.begin(), f.end());
  }
  const std::vector<double> fx =
      along == Along::x ? bx.slopes(loaded.x) : bx.values(loaded.x);
  std::vector<double> G =
      products(reduced(observed.x, observed.y), ritz().reduced(fx, fy), ritz().size());
  for (double& g : G) {
    g /= D_;  // B-10
  }
  return G;
}

double PlateSolution::under(double x, double y, std::span<const double> load) const {
  const std::vector<double> observed = reduced(x, std::span<const double>(&y, 1));
  return products(observed, load, ritz().size()).front() / D_;
}

double PlateSolution::pressure(double x, double y) const {
  return under(x, y, even_pressure_);
}

double PlateSolution::edge_load(double x, double y) const {
  return under(x, y, edge_load_);
}

}  // namespace trochoid::structure
