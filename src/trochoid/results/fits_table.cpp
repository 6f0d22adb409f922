#include <trochoid/results/fits_table.h>

#include <trochoid/base/rounded.h>
#include <trochoid/base/units.h>
#include <trochoid/identification/reliability.h>
#include <trochoid/results/text_table.h>

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

namespace trochoid::results {

namespace {

using identification::Estimate;
using identification::Fit;
using identification::RunoutUnknowns;

constexpr double largest_shown_condition = 1e8;

std::string coefficient_text(const std::optional<Estimate>& e, double unit) {
  if (!e) {
    return "not identifiable";
  }
  return base::with_error(e->value / unit, 0.5 * (e->high - e->low) / unit);
}

/// A value found with its 95 % half width; `name` as in Fit::unidentifiable.
std::string found_text(const Fit& fit, const std::string& name, double value,
                       std::optional<double> se) {
  if (identification::unidentifiable(fit, name)) {
    return "not known";
  }
  return base::with_error(value, fit.interval_factor * se.value_or(0.0));
}

std::string offsets_text(const Fit& fit) {
  if (!chip::feels_runout(fit.chip.model)) {
    return "-";
  }
  std::string text;
  for (std::size_t k = 1; k < fit.runout.radial_offsets.size(); ++k) {
    const auto& se = fit.radial_offsets_se[k];
    text += k > 1 ? ", " : "";
    text += found_text(fit, fmt::format("radial_offsets_mm[{}]", k + 1),
                       fit.runout.radial_offsets[k] / unit::um,
                       se ? std::optional(*se / unit::um) : std::nullopt);
  }
  return text.empty() ? "-" : text;
}

std::string eccentricity_text(const Fit& fit) {
  if (!chip::feels_runout(fit.chip.model)) {
    return "-";
  }
  const auto& se = fit.eccentricity_se;
  return found_text(fit, "eccentricity_mm", fit.runout.eccentricity / unit::um,
                    se ? std::optional(*se / unit::um) : std::nullopt);
}

std::string direction_text(const Fit& fit) {
  if (!chip::feels_runout(fit.chip.model)) {
    return "-";
  }
  const auto& se = fit.angle_se;
  return found_text(fit, "angle_deg", unit::in(fit.runout.angle, unit::deg),
                    se ? std::optional(*se / unit::deg) : std::nullopt);
}

std::string phase_text(const Fit& fit, std::size_t run) {
  const auto& se = fit.phase_se[run];
  const std::string name =
      fit.phase.size() == 1 ? "phase_deg" : fmt::format("phase_deg[{}]", run + 1);
  return found_text(fit, name, unit::in(fit.phase[run], unit::deg),
                    se ? std::optional(*se / unit::deg) : std::nullopt);
}

using Cells = std::vector<std::string>;

/// One column a fit.
class FitColumns {
 public:
  explicit FitColumns(std::span<const Fit> fits) : fits_(fits) {}

  void row(std::string name, const std::function<std::string(const Fit&)>& text) {
    std::vector<std::string> cells{std::move(name)};
    for (const Fit& fit : fits_) {
      cells.push_back(fit.ok ? text(fit) : "-");
    }
    rows_.push_back(std::move(cells));
  }

  void head(std::vector<std::string> cells) { rows_.push_back(std::move(cells)); }

  [[nodiscard]] std::string text() const { return aligned(rows_); }

 private:
  std::span<const Fit> fits_;
  std::vector<std::vector<std::string>> rows_;
};

/// `0, 12 +- 1, ...` of axial offsets [um].
std::string axial_text(const Fit& fit) {
  std::string text;
  for (std::size_t k = 1; k < fit.runout.axial_offsets.size(); ++k) {
    const auto& se = fit.channels->axial_offsets_se[k];
    text += k > 1 ? ", " : "";
    text += found_text(fit, fmt::format("axial_offsets_mm[{}]", k + 1),
                       fit.runout.axial_offsets[k] / unit::um,
                       se ? std::optional(*se / unit::um) : std::nullopt);
  }
  return text.empty() ? "-" : text;
}

void add_deep_runout(const Fit& first, FitColumns& columns) {
  if (!first.channels) return;
  if (!first.channels->axial_offsets_se.empty()) {
    columns.row("axial_offsets_um[2..]", axial_text);
  }
  if (first.channels->tilt_se) {
    columns.row("tilt_mdeg", [](const Fit& fit) {
      const auto& se = fit.channels->tilt_se;
      return found_text(fit, "tilt_deg", 1000 * fit.runout.tilt / unit::deg,
                        se ? std::optional(1000 * *se / unit::deg) : std::nullopt);
    });
  }
}

void add_runout(const Fit& first, FitColumns& columns) {
  const RunoutUnknowns form = first.options.runout;
  if (form == RunoutUnknowns::none) return;
  if (form != RunoutUnknowns::eccentricity) {
    columns.row("radial_offsets_um[2..]", offsets_text);
  }
  if (finds_eccentricity(form)) {
    columns.row("eccentricity_um", eccentricity_text);
    columns.row("angle_deg", direction_text);
  }
}

void add_quality(std::span<const Fit> fits, FitColumns& columns) {
  const auto is_vector = [](const Fit& fit) {
    return fit.measured != std::array<bool, 3>{};
  };
  if (std::ranges::any_of(fits, is_vector)) {
    columns.row("rms_N", [](const Fit& fit) { return fmt::format("{:.3f}", fit.rms); });
  }
  columns.row("unexplained (rms)",
              [](const Fit& fit) { return base::percent(fit.unexplained.in_band); });
  columns.row("condition number", [](const Fit& fit) {
    return fit.condition < largest_shown_condition
               ? fmt::format("{:.1f}", fit.condition)
               : std::string("rank deficient");
  });
  const auto as_stated = [](const Fit& fit) {
    return fit.channels && fit.widening == 1;
  };
  if (std::ranges::all_of(fits, as_stated)) return;
  columns.row("+- wider than by noise",
              [](const Fit& fit) { return fmt::format("x {:.1f}", fit.widening); });
}

}  // namespace

std::string groups_table(const Fit& fit) {
  Cells head{fmt::format("group ({}, 95 %: +-)", chip::name_of(fit.chip.model))};
  for (const identification::Group& group : fit.groups) {
    head.push_back(group.name.empty() ? "without a group" : group.name);
  }
  std::vector<Cells> rows{std::move(head)};
  const auto names = force::coefficient_quantities(fit.law);
  for (std::size_t q = 0; q < names.size(); ++q) {
    Cells cells{std::string(names[q].key)};
    for (const identification::Group& group : fit.groups) {
      cells.push_back(coefficient_text(group.coefficients[q], names[q].unit));
    }
    rows.push_back(std::move(cells));
  }
  return aligned(rows);
}

std::string fits_table(std::span<const Fit> fits) {
  FitColumns columns(fits);
  std::vector<std::string> head{"chip model (95 %: +-)"};
  for (const Fit& fit : fits) {
    head.emplace_back(chip::name_of(fit.chip.model));
  }
  columns.head(std::move(head));
  const auto names = force::coefficient_quantities(fits.front().law);
  const bool grouped =
      std::ranges::any_of(fits, [](const Fit& fit) { return fit.groups.size() > 1; });
  for (std::size_t q = 0; q < names.size() && !grouped; ++q) {
    columns.row(std::string(names[q].key), [&, q](const Fit& fit) {
      return coefficient_text(fit.coefficients[q], names[q].unit);
    });
  }
  const auto exponents = force::exponent_quantities(fits.front().law);
  for (std::size_t q = 0; q < exponents.size(); ++q) {
    columns.row(std::string(exponents[q].key), [q](const Fit& fit) {
      return q < fit.exponents.size() ? coefficient_text(fit.exponents[q], 1.0) : "-";
    });
  }
  add_runout(fits.front(), columns);
  add_deep_runout(fits.front(), columns);
  std::size_t runs = 0;
  for (const Fit& fit : fits) {
    runs = std::max(runs, fit.ok ? fit.phase.size() : 0);
  }
  for (std::size_t r = 0; r < runs; ++r) {
    const auto by_angle = [r](const Fit& fit) {  // a mean has no phase
      return !fit.channels || fit.channels->has_phase[r];
    };
    if (std::ranges::none_of(fits, by_angle)) continue;
    columns.row(runs == 1 ? "phase_deg" : fmt::format("phase_deg, record {}", r + 1),
                [r](const Fit& fit) { return phase_text(fit, r); });
  }
  add_quality(fits, columns);
  return columns.text();
}

}  // namespace trochoid::results
