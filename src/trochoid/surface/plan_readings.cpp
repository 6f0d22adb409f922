#include <trochoid/surface/plan_readings.h>

#include <trochoid/numerics/parallel.h>
#include <trochoid/surface/error_grid.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace trochoid::surface {

namespace {

constexpr double never = std::numeric_limits<double>::infinity();
constexpr double not_told = std::numeric_limits<double>::quiet_NaN();
/// Readings that advice is about, and the heights that it looks at.
constexpr int readings_more = 10;
constexpr int heights_more = 19;
/// What is looked at beside the cut and the wall as they are, as parts of these.
constexpr std::array factors{0.5, 0.75, 1.0, 1.25, 1.5};
constexpr std::array shares{0.1, 0.3, 0.5, 0.7, 0.9};

std::vector<double> heights_for_more(double a_p) {
  std::vector<double> out;
  for (int i = 1; i <= heights_more; ++i) {
    out.push_back(a_p * i / (heights_more + 1));
  }
  return out;
}

/// The worst interval against what is wanted of it: at most 1 is enough.
double shortfall(const WallTrial& trial, const WantedWidths& wanted, bool runout_shows,
                 const WallPrediction& told) {
  const HalfWidths half = half_widths(trial.setting.law, told);
  double worst = std::max(half.K_tc, half.K_rc) / wanted.coefficients;
  if (runout_shows) {
    worst = std::max(worst, half.eccentricity / wanted.eccentricity);
  }
  return std::isfinite(half.K_tc + half.K_rc) && std::isfinite(worst) ? worst : never;
}

void append(const PlannedReadings& ten, PlannedReadings& all) {
  all.readings.insert(all.readings.end(), ten.readings.begin(), ten.readings.end());
  all.row.insert(all.row.end(), ten.row.begin(), ten.row.end());
}

/// Ten more beside the chosen design.
std::vector<MoreReadings> more_of_design(const WallCatalogue& catalogue,
                                         const WallDesign& design, double a_p) {
  const PlannedReadings base = catalogue.readings_of(design);
  std::vector<MoreReadings> out;
  for (const double height : heights_for_more(a_p)) {
    PlannedReadings all = base;
    append(catalogue.readings_at(height, readings_more), all);
    out.push_back({height, catalogue.predict(all)});
  }
  return out;
}

/// What the readings so far tell, and ten more beside them.
void judge_measured(const WallTrial& trial, const WallCatalogue& catalogue,
                    std::span<const Reading> measured, ReadingsPlan& plan) {
  std::vector<Reading> all(measured.begin(), measured.end());
  std::vector<PlannedReadings> tens;
  for (const double height : heights_for_more(trial.setting.setup.cut.a_p)) {
    PlannedReadings ten = catalogue.readings_at(height, readings_more);
    for (std::size_t i = 0; i < ten.readings.size(); ++i) {
      ten.row[i] = all.size();
      all.push_back(ten.readings[i]);
    }
    tens.push_back(std::move(ten));
  }
  const ReadingDerivatives d = derivatives_of(trial, all);
  PlannedReadings so_far{{measured.begin(), measured.end()}, {}};
  for (std::size_t i = 0; i < measured.size(); ++i) {
    so_far.row.push_back(i);
  }
  // By themselves: teeth may be numbered in the ten and not in these.
  plan.so_far = prediction_of(trial, derivatives_of(trial, measured), so_far);
  for (const PlannedReadings& ten : tens) {
    PlannedReadings both = so_far;
    append(ten, both);
    plan.more.push_back({ten.readings.front().height, prediction_of(trial, d, both)});
  }
}

/// One wall or cut that is looked at.
struct OtherWall {
  ChangedWall answer;
  WallTrial trial;
  double position = 0.0;  ///< of the cutter along the wall [m]
};

OtherWall& add(const char* key, double value, const WallTrial& trial, double position,
               std::vector<OtherWall>& out) {
  OtherWall& other = out.emplace_back();
  other.answer.key = key;
  other.answer.value = value;
  other.trial = trial;
  other.position = position;
  return other;
}

void add_axial_depths(const BodyDimensions& sizes, const WallTrial& trial,
                      std::vector<OtherWall>& out) {
  const double most = std::min(sizes.cutter ? sizes.cutter->flute_length : never,
                               sizes.wall ? sizes.wall->height : never);
  for (const double factor : factors) {
    const double a_p = factor * trial.setting.setup.cut.a_p;
    if (a_p < most) {
      OtherWall& other = add("axial_depth_mm", a_p, trial, sizes.position, out);
      other.trial.setting.setup.cut.a_p = a_p;
      other.trial.setting.bodies = bodies_solved_once(sizes, a_p);
    }
  }
}

void add_radial_depths(const BodyDimensions& sizes, const WallTrial& trial,
                       std::vector<OtherWall>& out) {
  const force::Setup& setup = trial.setting.setup;
  for (const double factor : factors) {
    const double a_e = factor * radial_depth_of(setup.cut.engagement);
    if (a_e <= setup.cutter.profile.D) {
      add("radial_depth_mm", a_e, trial, sizes.position, out).trial.setting.setup =
          with_radial_depth(setup, a_e);
    }
  }
}

void add_walls(const BodyDimensions& sizes, const WallTrial& trial,
               std::vector<OtherWall>& out) {
  if (!sizes.wall) {
    return;
  }
  for (const double factor : factors) {
    BodyDimensions other = sizes;
    other.wall->thickness = factor * sizes.wall->thickness;
    add("thickness_mm", other.wall->thickness, trial, sizes.position, out)
        .trial.setting.bodies = bodies_solved_once(other, trial.setting.setup.cut.a_p);
  }
  for (const double share : shares) {
    const double x = share * sizes.wall->length;
    add("position_mm", x, trial, x, out);
  }
}

}  // namespace

HalfWidths half_widths(const force::Law& expected, const WallPrediction& told) {
  const std::vector<double> K = force::coefficients(expected);
  const auto part = [&](double se, double value) {
    return told.told && value != 0 ? told.factor * se / std::abs(value) : not_told;
  };
  return {part(told.se_K_tc, K[0]), part(told.se_K_rc, K[1]),
          told.told && told.se_eccentricity ? told.factor * *told.se_eccentricity
                                            : not_told};
}

WallTrial expected_after(WallTrial trial, const Calibration& c) {
  force::Law& law = trial.setting.law;
  const auto names = force::coefficient_quantities(law);
  law = force::with_number(law, names[0].key, c.coefficients.K_tc.value);
  law = force::with_number(law, names[1].key, c.coefficients.K_rc.value);
  if (c.runout_seen) {
    geometry::Runout& runout = trial.setting.setup.runout;
    runout.eccentricity = c.runout.eccentricity.value;
    runout.angle = c.runout.angle.value;
    trial.start = c.runout.start.value;
  }
  trial.noise = c.runout.ok ? c.runout.rms : chosen_fit(c.models).noise;
  return trial;
}

std::vector<WallDesign> wall_designs(std::span<const double> spreads,
                                     std::span<const double> heights,
                                     std::span<const double> places, int teeth) {
  std::vector<WallDesign> out;
  for (const double spread : spreads) {
    for (const double height_count : heights) {
      for (const double place_count : places) {
        out.push_back({static_cast<int>(height_count),
                       whole_places(static_cast<int>(place_count), teeth), spread});
      }
    }
  }
  const auto key = [](const WallDesign& d) {
    return std::array<double, 3>{static_cast<double>(d.heights * d.per_height),
                                 static_cast<double>(d.heights), -d.spread};
  };
  std::sort(out.begin(), out.end(),
            [&](const WallDesign& a, const WallDesign& b) { return key(a) < key(b); });
  const auto same = [&](const WallDesign& a, const WallDesign& b) {
    return key(a) == key(b);
  };
  out.erase(std::unique(out.begin(), out.end(), same), out.end());
  return out;
}

ReadingsPlan plan_readings(const WallTrial& trial, std::span<const WallDesign> designs,
                           const WantedWidths& wanted,
                           std::span<const Reading> measured, double position) {
  const double a_p = trial.setting.setup.cut.a_p;
  std::vector<double> heights = heights_for_more(a_p);
  for (const WallDesign& design : designs) {
    const auto own = heights_of(design, a_p);
    heights.insert(heights.end(), own.begin(), own.end());
  }
  const WallCatalogue catalogue(trial, heights, position);
  ReadingsPlan plan{.why_no_runout = catalogue.derivatives().why_no_runout,
                    .so_far = {},
                    .designs = std::vector<PlannedDesign>(designs.size()),
                    .chosen = {},
                    .more = {}};
  const auto short_by = [&](const WallPrediction& told) {
    return shortfall(trial, wanted, plan.why_no_runout.empty(), told);
  };
  numerics::for_each_index(designs.size(), [&](std::size_t i) {
    PlannedDesign& out = plan.designs[i];
    const PlannedReadings planned = catalogue.readings_of(designs[i]);
    out = {designs[i], planned.readings.size(), catalogue.predict(planned)};
    out.enough = short_by(out.told) <= 1.0;
  });
  plan.shortfall = never;
  for (std::size_t i = 0; i < plan.designs.size(); ++i) {
    const PlannedDesign& one = plan.designs[i];
    if (plan.chosen && plan.designs[*plan.chosen].enough) break;
    const double by = short_by(one.told);
    if (one.enough || (one.told.told && (!plan.chosen || by < plan.shortfall))) {
      plan.chosen = i;
      plan.shortfall = by;
    }
  }
  if (!plan.chosen) return plan;
  if (measured.empty()) {
    plan.more = more_of_design(catalogue, plan.designs[*plan.chosen].design, a_p);
  } else {
    judge_measured(trial, catalogue, measured, plan);
  }
  std::erase_if(plan.more, [](const MoreReadings& m) { return !m.told.told; });
  std::stable_sort(plan.more.begin(), plan.more.end(),
                   [&](const MoreReadings& a, const MoreReadings& b) {
                     return short_by(a.told) < short_by(b.told);
                   });
  return plan;
}

std::vector<ChangedWall> plan_changes(const WallTrial& trial, const WallDesign& design,
                                      const BodyDimensions& dimensions) {
  std::vector<OtherWall> others;
  add_axial_depths(dimensions, trial, others);
  add_radial_depths(dimensions, trial, others);
  add_walls(dimensions, trial, others);
  numerics::for_each_index(others.size(), [&](std::size_t i) {
    OtherWall& other = others[i];
    try {
      const auto heights = heights_of(design, other.trial.setting.setup.cut.a_p);
      const WallCatalogue catalogue(other.trial, heights, other.position);
      other.answer.told = catalogue.predict(catalogue.readings_of(design));
    } catch (const std::domain_error&) {
      other.answer.told = {};  // no steady state: nothing is told
    }
  });
  std::vector<ChangedWall> out;
  for (OtherWall& other : others) {
    out.push_back(std::move(other.answer));
  }
  return out;
}

}  // namespace trochoid::surface
