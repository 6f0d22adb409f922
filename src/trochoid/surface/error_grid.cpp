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

/// Along each side of the grid: there the feedback is found.
constexpr std::size_t feedback_nodes = 5;

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

struct Grid {
  const Setting& setting;
  MapOptions samples;
  std::span<const double> feeds;
  std::span<const double> radial_depths;

  [[nodiscard]] GridCell cell(std::size_t i, bool with_feedback) const {
    MapOptions options = samples;
    options.feedback = with_feedback ? samples.feedback : Feedback::none;
    return cell_of(setting, options, feeds[i % feeds.size()],
                   radial_depths[i / feeds.size()]);
  }
};

/// Some of 0 ... count - 1, evenly spread, both ends among them.
std::vector<std::size_t> nodes_of(std::size_t count) {
  std::vector<std::size_t> out;
  const std::size_t nodes = std::min(count, feedback_nodes);
  for (std::size_t k = 0; k < nodes; ++k) {
    out.push_back(nodes > 1 ? k * (count - 1) / (nodes - 1) : 0);
  }
  return out;
}

/// The nodes around a place, and the share of the upper one.
struct Between {
  std::size_t low = 0;
  std::size_t high = 0;
  double share = 0.0;
};

Between between(std::span<const std::size_t> nodes, std::span<const double> values,
                std::size_t at) {
  std::size_t k = 0;
  while (k + 1 < nodes.size() && nodes[k + 1] < at) {
    ++k;
  }
  if (k + 1 == nodes.size()) {
    return {k, k, 0.0};
  }
  const double from = values[nodes[k]];
  const double to = values[nodes[k + 1]];
  const double share = (values[at] - from) / (to - from);
  if (share <= 0.0 || share >= 1.0) {  // a node by itself
    return share <= 0.0 ? Between{k, k, 0.0} : Between{k + 1, k + 1, 0.0};
  }
  return {k, k + 1, share};
}

/// What the feedback changes of each cell: found at some, bilinear between them.
void add_feedback(const Grid& grid, std::vector<GridCell>& cells) {
  const auto across = nodes_of(grid.feeds.size());
  const auto up = nodes_of(grid.radial_depths.size());
  std::vector<GridCell> change(across.size() * up.size());
  numerics::for_each_index(change.size(), [&](std::size_t n) {
    const std::size_t i =
        up[n / across.size()] * grid.feeds.size() + across[n % across.size()];
    change[n] = grid.cell(i, true);
    change[n].peak -= cells[i].peak;
    change[n].mean -= cells[i].mean;
  });
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const Between x = between(across, grid.feeds, i % grid.feeds.size());
    const Between y = between(up, grid.radial_depths, i / grid.feeds.size());
    for (const auto& [row, rows] :
         {std::pair{y.low, 1.0 - y.share}, {y.high, y.share}}) {
      for (const auto& [column, columns_share] :
           {std::pair{x.low, 1.0 - x.share}, {x.high, x.share}}) {
        const GridCell& from = change[row * across.size() + column];
        cells[i].ok = cells[i].ok && from.ok;
        cells[i].peak += rows * columns_share * from.peak;
        cells[i].mean += rows * columns_share * from.mean;
      }
    }
  }
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
  const Grid grid{setting, samples, feeds, radial_depths};
  const bool bent = samples.feedback != Feedback::none;
  std::vector<GridCell> cells(feeds.size() * radial_depths.size());
  numerics::for_each_index(cells.size(),
                           [&](std::size_t i) { cells[i] = grid.cell(i, false); });
  if (bent) {
    add_feedback(grid, cells);
  }
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
  constexpr double close_enough = 5e-3;  // of the thickness: below any drawing
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
