#include <trochoid/base/units.h>
#include <trochoid/results/plan_wall.h>
#include <trochoid/results/text_table.h>

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace trochoid::results {

namespace {

using surface::GridCell;
using surface::WallPrediction;

/// So many designs are printed: the cheapest of each quality.
constexpr std::size_t most_designs_printed = 8;

/// `K_tc` of `K_tc_MPa`.
std::string plain(std::string_view key) {
  return std::string(key.substr(0, key.find('_', key.find('_') + 1)));
}

std::string percent(double part) {
  return std::isfinite(part) ? fmt::format("+- {:.2g} %", 100 * part) : "not told";
}

std::string micrometres(double length) {
  return std::isfinite(length) ? fmt::format("+- {:.2g} um", length / unit::um)
                               : "not seen";
}

std::vector<std::string> cells_of(const PlanWallResult& r, const WallPrediction& told) {
  const HalfWidths half = half_widths(r.law, told);
  return {percent(half.K_tc), percent(half.K_rc), micrometres(half.eccentricity)};
}

std::string design_words(const PlanWallResult& r, const PlannedDesign& d) {
  const std::vector<double> heights = heights_of(d.design, r.a_p);
  return fmt::format("{} heights from {:.3g} to {:.3g} mm, {} reading{} at each",
                     d.design.heights, heights.front() / unit::mm,
                     heights.back() / unit::mm, d.design.per_height,
                     d.design.per_height == 1 ? "" : "s");
}

std::string cut_words(const GridCell& cell) {
  const double rate = cell.removal_rate / mm3_per_min;
  return fmt::format(
      "feed {:.3g} mm per tooth, radial depth {:.3g} mm ({:.{}f} mm3/min)",
      cell.f_z / unit::mm, cell.a_e / unit::mm, rate, rate < 100 ? 1 : 0);
}

/// Cheaper designs, each better at the worst of its intervals than all before it.
std::vector<std::size_t> worth_printing(const PlanWallResult& r) {
  std::vector<std::size_t> out;
  double best = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < r.designs.size(); ++i) {
    const HalfWidths half = half_widths(r.law, r.designs[i].told);
    const double worst = std::max(half.K_tc, half.K_rc);
    if ((std::isfinite(worst) && worst < 0.9 * best) || r.chosen == i) {
      out.push_back(i);
      best = std::min(best, worst);
    }
  }
  while (out.size() >
         most_designs_printed) {  // the poorest first, never the chosen one
    out.erase(out.begin() + (r.chosen == out.front() ? 1 : 0));
  }
  return out;
}

std::string cutting_sentence(const PlannedCutting& c) {
  if (!c.limit) {
    return "";
  }
  const std::string which = c.mean ? "mean" : "largest";
  std::string text =
      fmt::format(" A {} error of {:.3g} um ", which, *c.limit / unit::um);
  text += c.best ? fmt::format("allows {}", cut_words(c.cells[*c.best]))
                 : "is not kept by any cut that was looked at";
  if (c.thinnest && c.thinnest->thickness) {
    text += fmt::format(", and, for the cut as stated, a wall of {:.3g} mm{}",
                        *c.thinnest->thickness / unit::mm,
                        c.thinnest->thinner_too ? " or less" : "");
  } else if (c.thinnest) {
    text += ", and no wall is thick enough for the cut as stated";
  }
  return text + ".";
}

std::string cutting_lines(const PlannedCutting& c) {
  std::string text = fmt::format(
      "the cut as stated: {}, error {:.3g} um at most, {:.3g} um on average\n",
      cut_words(c.stated), c.stated.peak / unit::um, c.stated.mean / unit::um);
  if (!c.stated.ok) {
    text = fmt::format("the cut as stated: {}: no steady state was found\n",
                       cut_words(c.stated));
  }
  if (!c.limit) {
    return text;
  }
  text += c.best ? fmt::format(
                       "largest removal rate within {:.3g} um: {}, error {:.3g} um\n",
                       *c.limit / unit::um, cut_words(c.cells[*c.best]),
                       limited_error(c, c.cells[*c.best]) / unit::um)
                 : fmt::format("no cut that was looked at keeps {:.3g} um\n",
                               *c.limit / unit::um);
  if (c.thinnest && c.thinnest->thickness) {
    text += fmt::format("thinnest wall for the cut as stated: {:.3g} mm{}\n",
                        *c.thinnest->thickness / unit::mm,
                        c.thinnest->thinner_too ? " or less" : "");
  } else if (c.thinnest) {
    text +=
        fmt::format("no wall is thick enough for the cut as stated: {:.3g} um stay\n",
                    c.thinnest->error / unit::um);
  }
  return text;
}

}  // namespace

std::string wall_plan_sentence(const PlanWallResult& r) {
  const PlannedDesign& d = r.designs[*r.chosen];
  const auto names = force::coefficient_quantities(r.law);
  const HalfWidths half = half_widths(r.law, d.told);
  std::string text =
      fmt::format("{} {}: {} readings tell {} {}, {} {}",
                  d.enough ? "Measure" : "No way to measure is enough; the best is",
                  design_words(r, d), d.readings, plain(names[0].key),
                  percent(half.K_tc), plain(names[1].key), percent(half.K_rc));
  if (std::isfinite(half.eccentricity)) {
    text += fmt::format(", eccentricity {}", micrometres(half.eccentricity));
  }
  return text + " (95 %)." + cutting_sentence(r.cutting);
}

std::string wall_plan_table(const PlanWallResult& r) {
  const auto names = force::coefficient_quantities(r.law);
  std::vector<std::vector<std::string>> rows{{"readings (95 %: +-)", "in all",
                                              plain(names[0].key), plain(names[1].key),
                                              "eccentricity"}};
  const auto add = [&](std::string what, std::size_t count,
                       const WallPrediction& told) {
    rows.push_back({std::move(what), std::to_string(count)});
    const auto cells = cells_of(r, told);
    rows.back().insert(rows.back().end(), cells.begin(), cells.end());
  };
  if (r.so_far) {
    add("so far", r.measured, *r.so_far);
  }
  for (const std::size_t i : worth_printing(r)) {
    add((r.chosen == i ? "* " : "  ") + design_words(r, r.designs[i]),
        r.designs[i].readings, r.designs[i].told);
  }
  std::string text = r.heading.message + "\n\n" + aligned(rows);
  text += fmt::format(
      "wanted: {}, {}; noise of a reading {:.2g} um ({}); form of the "
      "readings: {}\n",
      percent(r.wanted), micrometres(r.wanted_runout), r.noise / unit::um, r.noise_from,
      surface::name_of(r.form));
  if (!r.more.empty()) {
    text += fmt::format("ten more readings help most {:.3g} mm above the tip\n",
                        r.more.front().height / unit::mm);
  }
  return text + cutting_lines(r.cutting);
}

}  // namespace trochoid::results
