#include <trochoid/run/shared/heading.h>
#include <trochoid/run/wall/plan.h>

#include <trochoid/base/units.h>
#include <trochoid/numerics/parallel.h>
#include <trochoid/run/wall/measured_wall.h>
#include <trochoid/run/wall/plan_changes.h>
#include <trochoid/run/wall/plan_cut.h>
#include <trochoid/run/wall/setting.h>
#include <trochoid/surface/calibrate.h>

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace trochoid::run {

namespace {

using results::HalfWidths;
using results::MoreReadings;
using results::PlannedDesign;
using results::PlanWallResult;
using surface::PlannedReadings;
using surface::Reading;
using surface::WallCatalogue;
using surface::WallDesign;
using surface::WallPrediction;
using surface::WallTrial;

/// Of a reading where nothing tells the noise: a good measuring machine [m].
constexpr double assumed_noise = 1.0 * unit::um;
/// Readings that advice is about, and the heights that it looks at.
constexpr int more_readings = 10;
constexpr int more_heights = 19;

std::vector<double> heights_for_more(double a_p) {
  std::vector<double> out;
  for (int i = 1; i <= more_heights; ++i) {
    out.push_back(a_p * i / (more_heights + 1));
  }
  return out;
}

/// [plan] as designs, each once, the fewest readings first.
std::vector<WallDesign> designs_of(const inputs::WallPlan& plan, int teeth) {
  std::vector<WallDesign> out;
  for (const double spread : plan.spreads) {
    for (const double heights : plan.heights) {
      for (const double places : plan.per_height) {
        out.push_back({static_cast<int>(heights),
                       surface::whole_places(static_cast<int>(places), teeth), spread});
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

/// The worst interval against what is wanted of it: at most 1 is enough.
double shortfall(const PlanWallResult& r, const WallPrediction& told) {
  const HalfWidths half = half_widths(r, told);
  double worst = std::max(half.K_tc, half.K_rc) / r.wanted;
  if (r.why_no_runout.empty()) {
    worst = std::max(worst, half.eccentricity / r.wanted_runout);
  }
  return std::isfinite(half.K_tc + half.K_rc) && std::isfinite(worst)
             ? worst
             : std::numeric_limits<double>::infinity();
}

/// The work on one case.
struct WallPlanning {
  const inputs::Case& given;
  const Progress& progress;
  PlanWallResult r = {};
  WallTrial trial = {};
  std::vector<Reading> measured = {};

  PlanWallResult failed(const std::string& why) {
    r.heading.ok = false;
    r.heading.message = why;
    return std::move(r);
  }

  void expect(double K_tc, double K_rc) {
    const auto names = force::coefficient_quantities(trial.setting.law);
    trial.setting.law = force::with_number(trial.setting.law, names[0].key, K_tc);
    trial.setting.law = force::with_number(trial.setting.law, names[1].key, K_rc);
  }

  /// @return why nothing can be told from what was measured; empty: it can
  std::string learn_from_readings() {
    MeasuredWall wall = measured_wall(given);
    const surface::Calibration c =
        surface::calibrate(trial.setting, wall.readings, wall.datum, wall_fit(given));
    if (!c.ok) {
      return "the readings tell no coefficients to plan from: " + c.message;
    }
    expect(c.coefficients.K_tc.value, c.coefficients.K_rc.value);
    geometry::Runout& runout = trial.setting.setup.runout;
    if (c.runout_seen) {
      runout.eccentricity = c.runout.eccentricity.value;
      runout.angle = c.runout.angle.value;
      trial.start = c.runout.start.value;
    }
    trial.noise = c.runout.ok ? c.runout.rms : chosen_fit(c.models).noise;
    r.noise_from = "readings";
    measured = std::move(wall.readings);
    r.measured = measured.size();
    for (const inputs::SurfaceMeasurement& m : given.machine.surface_measurements) {
      r.files.push_back(m.source.file.path);
    }
    return "";
  }

  std::string settle_expectation() {
    const inputs::WallPlan& plan = given.plan.wall;
    geometry::Runout& runout = trial.setting.setup.runout;
    const auto& offsets = runout.radial_offsets;
    if (std::any_of(offsets.begin(), offsets.end(), [](double s) { return s != 0; })) {
      r.heading.warnings.push_back(
          {"offsets_not_used",
           "[runout] radial_offsets_mm are not used: a wall tells an eccentricity."});
    }
    runout.radial_offsets.clear();
    r.noise_from = "assumed";
    trial.noise = assumed_noise;
    if (!given.machine.surface_measurements.empty()) {
      runout.eccentricity = 0.0;
      if (std::string why = learn_from_readings(); !why.empty()) {
        return why;
      }
    }
    if (plan.noise) {
      trial.noise = *plan.noise;
      r.noise_from = "given";
    }
    const std::vector<double> K = force::coefficients(trial.setting.law);
    if (!(K[0] > 0.0) || !(K[1] > 0.0)) {
      return "a plan needs a tangential and a radial cutting coefficient above 0, as "
             "expected: those of a similar material will do";
    }
    if (!(trial.noise > 0.0)) {
      return "the readings have no noise to plan by: give noise_um";
    }
    return "";
  }

  void compare_designs(const WallCatalogue& catalogue,
                       const std::vector<WallDesign>& designs) {
    r.designs.resize(designs.size());
    numerics::for_each_index(designs.size(), [&](std::size_t i) {
      PlannedDesign& out = r.designs[i];
      const PlannedReadings planned = catalogue.readings_of(designs[i]);
      out = {designs[i], planned.readings.size(), catalogue.predict(planned)};
      out.enough = shortfall(r, out.told) <= 1.0;
    });
    for (std::size_t i = 0; i < r.designs.size(); ++i) {
      const bool first_enough =
          r.designs[i].enough && !(r.chosen && r.designs[*r.chosen].enough);
      const bool better = r.designs[i].told.told &&
                          (!r.chosen || shortfall(r, r.designs[i].told) <
                                            shortfall(r, r.designs[*r.chosen].told));
      if (first_enough || (better && !(r.chosen && r.designs[*r.chosen].enough))) {
        r.chosen = i;
      }
    }
  }

  void sort_more() {
    std::erase_if(r.more, [](const MoreReadings& m) { return !m.told.told; });
    std::stable_sort(r.more.begin(), r.more.end(),
                     [&](const MoreReadings& a, const MoreReadings& b) {
                       return shortfall(r, a.told) < shortfall(r, b.told);
                     });
  }

  /// Ten more beside the chosen design.
  void add_more(const WallCatalogue& catalogue) {
    const PlannedReadings base = catalogue.readings_of(r.designs[*r.chosen].design);
    for (const double height : heights_for_more(r.a_p)) {
      PlannedReadings all = base;
      const PlannedReadings ten = catalogue.readings_at(height, more_readings);
      all.readings.insert(all.readings.end(), ten.readings.begin(), ten.readings.end());
      all.row.insert(all.row.end(), ten.row.begin(), ten.row.end());
      r.more.push_back({height, catalogue.predict(all)});
    }
    sort_more();
  }

  /// What the readings so far tell, and ten more beside them.
  void judge_measured(const WallCatalogue& catalogue) {
    std::vector<Reading> all = measured;
    std::vector<PlannedReadings> tens;
    for (const double height : heights_for_more(r.a_p)) {
      PlannedReadings ten = catalogue.readings_at(height, more_readings);
      for (std::size_t i = 0; i < ten.readings.size(); ++i) {
        ten.row[i] = all.size();
        all.push_back(ten.readings[i]);
      }
      tens.push_back(std::move(ten));
    }
    const surface::ReadingDerivatives d = derivatives_of(trial, all);
    PlannedReadings so_far{measured, {}};
    for (std::size_t i = 0; i < measured.size(); ++i) {
      so_far.row.push_back(i);
    }
    // By themselves: teeth may be numbered in the ten and not in these.
    r.so_far = prediction_of(trial, derivatives_of(trial, measured), so_far);
    for (const PlannedReadings& ten : tens) {
      PlannedReadings both = so_far;
      both.readings.insert(both.readings.end(), ten.readings.begin(),
                           ten.readings.end());
      both.row.insert(both.row.end(), ten.row.begin(), ten.row.end());
      r.more.push_back({ten.readings.front().height, prediction_of(trial, d, both)});
    }
    sort_more();
  }

  /// Designs and what follows from them. @return why there are none; empty: there are
  std::string plan_readings() {
    const auto designs =
        designs_of(given.plan.wall, trial.setting.setup.cutter.teeth());
    std::vector<double> heights = heights_for_more(r.a_p);
    for (const WallDesign& design : designs) {
      const auto own = heights_of(design, r.a_p);
      heights.insert(heights.end(), own.begin(), own.end());
    }
    const WallCatalogue catalogue(trial, heights, wall_position(given));
    r.why_no_runout = catalogue.derivatives().why_no_runout;
    compare_designs(catalogue, designs);
    if (!r.chosen) {
      return fmt::format(
          "none of the ways to measure tells the coefficients apart: cut deeper or wider, "
          "with a helix{}",
          trial.form == surface::PlannedForm::none
              ? ""
              : ", or see to it that less of the form of the readings is unknown");
    }
    if (measured.empty()) {
      add_more(catalogue);
    } else {
      judge_measured(catalogue);
    }
    progress("Other cuts and walls");
    r.changes = plan_changes(given, trial, r.designs[*r.chosen].design);
    return "";
  }

  PlanWallResult answer() {
    r.heading = heading_of(given);
    trial.setting = wall_setting(given);
    trial.setting.bodies = bodies_of(given, given.setup.cut.a_p);
    trial.feedback = wall_feedback(given);
    trial.form = given.plan.wall.form.value_or(surface::PlannedForm::offset);
    r.form = trial.form;
    r.wanted = given.plan.wall.wanted.value_or(10.0) / 100;
    r.wanted_runout = given.plan.wall.wanted_runout.value_or(1.0 * unit::um);
    r.a_p = given.setup.cut.a_p;
    if (const std::string why = settle_expectation(); !why.empty()) {
      return failed(why);
    }
    r.law = trial.setting.law;
    r.eccentricity = trial.setting.setup.runout.eccentricity;
    r.noise = trial.noise;
    progress("Comparing readings");
    try {
      if (const std::string why = plan_readings(); !why.empty()) {
        return failed(why);
      }
    } catch (const std::domain_error& error) {
      return failed(error.what());
    }
    progress("Mapping the error over feed and radial depth");
    r.cutting = plan_cutting(given, trial.setting);
    warn();
    r.heading.message = wall_plan_sentence(r);
    return std::move(r);
  }

  /// Of what more might be cut; empty: nothing.
  [[nodiscard]] std::string at_the_edge() const {
    const results::PlannedCutting& c = r.cutting;
    if (!c.best) return {};
    const bool feed = c.cells[*c.best].f_z == c.feeds.back();
    const bool depth = c.cells[*c.best].a_e == c.radial_depths.back();
    return feed && depth ? "larger feeds or radial depths"
           : feed        ? "larger feeds"
           : depth       ? "larger radial depths"
                         : "";
  }

  void warn() {
    const auto add = [&](const char* code, std::string message) {
      r.heading.warnings.push_back({code, std::move(message)});
    };
    if (!r.why_no_runout.empty()) {
      add("no_runout_seen",
          fmt::format("No way to measure shows the runout: {}.", r.why_no_runout));
    }
    if (!r.designs[*r.chosen].enough) {
      const double factor = shortfall(r, r.designs[*r.chosen].told);
      add("not_enough",
          !std::isfinite(factor)
              ? "No way to measure tells the runout: readings at more places along the "
                "feed might."
              : fmt::format(
                    "The best way to measure is {:.2g} times too wide: it takes some "
                    "{:.3g} times as many readings, or a cut that tells more.",
                    factor, factor * factor));
    }
    if (!r.cutting.limit) {
      add("no_error_limit",
          "[plan] has no largest_error_um: the map has no limit, and no cut is named.");
    }
    if (const std::string more = at_the_edge(); !more.empty()) {
      add("edge_of_map", "The best cut lies at the edge of the map: " + more +
                             " may keep the error as well.");
    }
    const auto left_out = std::count_if(r.cutting.cells.begin(), r.cutting.cells.end(),
                                        [](const auto& cell) { return !cell.ok; });
    if (left_out > 0) {
      add("no_steady_state",
          fmt::format("{} of {} cuts of the map have no steady state: the deflection "
                      "does not settle.",
                      left_out, r.cutting.cells.size()));
    }
    const inputs::Wall* wall = given.machine.wall ? &*given.machine.wall : nullptr;
    if (wall != nullptr && r.cutting.stated.peak > wall->thickness / 2) {
      add("thick_deflection",
          "The error of the stated cut is more than half of the wall's thickness: a "
          "thin plate bends in proportion to the force only below that.");
    }
  }
};

}  // namespace

results::PlanWallResult plan_wall(const inputs::Case& given, const Progress& progress) {
  return WallPlanning{given, progress}.answer();
}

}  // namespace trochoid::run
