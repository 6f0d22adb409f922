#include <trochoid/surface/error_grid.h>

#include <trochoid/base/overloaded.h>
#include <trochoid/base/units.h>
#include <trochoid/numerics/parallel.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <variant>

namespace trochoid::surface {

namespace {

GridCell cell_of(Setting setting, const MapOptions& samples, double f_z, double a_e) {
  setting.setup = with_radial_depth(setting.setup, a_e);
  setting.setup.cut.f_z = f_z;
  GridCell cell{.f_z = f_z, .a_e = a_e, .removal_rate = removal_rate(setting.setup)};
  const ErrorMap map = error_map(setting, samples);
  cell.ok = map.converged;
  if (cell.ok) {
    cell.peak = std::max(std::abs(map.error.max), std::abs(map.error.min));
    cell.mean = map.error.mean;
  }
  return cell;
}

}  // namespace

double radial_depth_of(const geometry::Engagement& engagement) {
  return std::visit(
      base::Overloaded{[](const geometry::UpMilling& up) { return up.a_e; },
                       [](const geometry::DownMilling& down) { return down.a_e; },
                       [](const auto&) -> double {
                         throw std::invalid_argument(
                             "a slot or a band leaves no single wall");
                       }},
      engagement);
}

double removal_rate(const force::Setup& setup) {
  const geometry::Cut& cut = setup.cut;
  return cut.a_p * radial_depth_of(cut.engagement) * setup.cutter.teeth() * cut.f_z *
         cut.Omega / unit::turn;  // E-62
}

force::Setup with_radial_depth(force::Setup setup, double a_e) {
  static_cast<void>(radial_depth_of(setup.cut.engagement));
  if (std::holds_alternative<geometry::UpMilling>(setup.cut.engagement)) {
    setup.cut.engagement = geometry::UpMilling{a_e};
  } else {
    setup.cut.engagement = geometry::DownMilling{a_e};
  }
  return setup;
}

std::vector<GridCell> error_grid(const Setting& setting, const MapOptions& samples,
                                 std::span<const double> feeds,
                                 std::span<const double> radial_depths) {
  std::vector<GridCell> cells(feeds.size() * radial_depths.size());
  numerics::for_each_index(cells.size(), [&](std::size_t i) {
    cells[i] = cell_of(setting, samples, feeds[i % feeds.size()],
                       radial_depths[i / feeds.size()]);
  });
  return cells;
}

std::vector<std::optional<double>> feed_limits(
    std::span<const GridCell> cells, std::size_t feeds, double limit,
    const std::function<double(const GridCell&)>& error) {
  std::vector<std::optional<double>> limits;
  for (std::size_t from = 0; from + feeds <= cells.size(); from += feeds) {
    std::optional<double>& found = limits.emplace_back();
    for (std::size_t i = from; i < from + feeds; ++i) {
      const bool keeps = cells[i].ok && error(cells[i]) <= limit;
      if (keeps) {
        found = cells[i].f_z;
        continue;
      }
      if (found && cells[i].ok) {
        const double before = error(cells[i - 1]);
        const double share = (limit - before) / (error(cells[i]) - before);
        found = *found + share * (cells[i].f_z - *found);
      }
      break;
    }
  }
  return limits;
}

ThinnestWall thinnest_wall(double from, double to, double limit,
                           const std::function<double(double thickness)>& error) {
  constexpr double close_enough = 2e-3;  // of the thickness: below any drawing
  const auto keeps = [&](double e) { return std::isfinite(e) && e <= limit; };
  ThinnestWall out{.error = error(to)};
  if (!keeps(out.error)) {
    return out;
  }
  out.thickness = to;
  const double thin = error(from);
  if (keeps(thin)) {
    return {from, thin, true};
  }
  double low = std::log(from);
  double high = std::log(to);
  while (high - low > close_enough) {  // E-63
    const double middle = (low + high) / 2;
    const double there = error(std::exp(middle));
    if (keeps(there)) {
      high = middle;
      out.thickness = std::exp(middle);
      out.error = there;
    } else {
      low = middle;
    }
  }
  return out;
}

}  // namespace trochoid::surface
