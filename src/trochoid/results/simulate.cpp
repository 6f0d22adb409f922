#include <trochoid/results/simulate.h>

#include <trochoid/base/units.h>
#include <trochoid/results/curve_tables.h>

#include <fmt/core.h>

namespace trochoid::results {

namespace {

using base::add_column;

base::Table force_table(const SimulateResult& r) {
  base::Table table{"forces.csv", {}};
  const std::size_t n = r.phi.size();
  add_column(table, "angle_deg", n,
             [&](std::size_t i) { return unit::in(r.phi[i], unit::deg); });
  add_column(table, "time_s", n, [&](std::size_t i) { return r.phi[i] / r.Omega; });
  constexpr const char* names[] = {"Fx_N", "Fy_N", "Fz_N"};
  for (std::size_t q = 0; q < 3; ++q) {
    add_column(table, names[q], n, [&](std::size_t i) { return r.loads[i].force[q]; });
  }
  for (std::size_t q = 0; r.channels && q < 3; ++q) {
    const auto& row = (*r.channels)[q];
    add_column(table, fmt::format("channel{}_N", q + 1), n, [&](std::size_t i) {
      const force::Vector3& F = r.loads[i].force;
      return row[0] * F[0] + row[1] * F[1] + row[2] * F[2];
    });
  }
  return table;
}

base::Table chip_table(const force::ChipGrid& grid) {
  base::Table table{"chip.csv", {}};
  const std::size_t heights = grid.height.size();
  const std::size_t of_tooth = heights * grid.theta.size();
  const std::size_t n = grid.h.size();
  add_column(table, "tooth", n, [&](std::size_t i) { return i / of_tooth + 1; });
  add_column(table, "edge_angle_deg", n, [&](std::size_t i) {
    return unit::in(grid.theta[i % of_tooth / heights], unit::deg);
  });
  add_column(table, "height_mm", n, [&](std::size_t i) {
    return unit::in(grid.height[i % heights], unit::mm);
  });
  add_column(table, "h_mm", n, [&](std::size_t i) { return grid.h[i] / unit::mm; });
  return table;
}

Value teeth_value(const force::Engagement& engagement) {
  Array teeth;
  for (std::size_t j = 0; j < engagement.teeth.size(); ++j) {
    const force::ToothEngagement& tooth = engagement.teeth[j];
    Array arcs;
    for (const chip::Arc& arc : tooth.arcs) {
      arcs.push_back(Array{arc.from / unit::deg, arc.to / unit::deg});
    }
    teeth.push_back(Object{{"tooth", j + 1},
                           {"intervals_deg", std::move(arcs)},
                           {"peak_chip_mm", tooth.peak_chip / unit::mm}});
  }
  return teeth;
}

Value comparison_value(const std::vector<Comparison>& comparison) {
  Array all;
  for (const Comparison& c : comparison) {
    all.push_back(Object{{"file", c.file},
                         {"phase_deg", c.match.phase / unit::deg},
                         {"rms_N", c.match.rms},
                         {"rms_axis_N", c.match.rms_axis},
                         {"measured_rms_N", c.match.measured_rms},
                         {"spindle_rpm", c.Omega / unit::rpm}});
  }
  return all;
}

Object result_of(const SimulateResult& r) {
  Object result{{"mean_N", r.force.mean},
                {"min_N", r.force.min},
                {"max_N", r.force.max},
                {"rms_N", r.force.rms},
                {"peak_xy_N", r.force.peak_xy}};
  const auto add = [&](const char* key, Value value) {
    result.push_back({key, std::move(value)});
  };
  if (r.closed_form_mean) {
    add("closed_form_mean_N", *r.closed_form_mean);
  }
  add("torque_mean_Nm", r.moments.mean_torque);
  add("torque_peak_Nm", r.moments.peak_torque);
  add("power_W", r.moments.mean_torque * r.Omega);
  if (r.gauge_length) {
    add("gauge_length_mm", unit::in(*r.gauge_length, unit::mm));
    add("bending_peak_Nm", r.moments.peak_bending);
  }
  add("teeth", teeth_value(r.engagement));
  add("teeth_height_mm", unit::in(r.engagement.height, unit::mm));
  const chip::Removal& removal = r.engagement.removal;
  if (removal.available > 0) {
    add("volume_check", Object{{"removed_mm2_per_rev", removal.removed * 1e6},
                               {"feed_times_width_mm2", removal.available * 1e6},
                               {"ratio", removal.removed / removal.available}});
  }
  if (!r.comparison.empty()) {
    add("comparison", comparison_value(r.comparison));
  }
  return result;
}

std::string comparison_text(const Comparison& c) {
  std::string text = fmt::format("compared with {}: rms of the difference {:.2f} N",
                                 c.file, c.match.rms);
  return text + (c.match.measured_rms > 0
                     ? fmt::format(" ({:.1f} % of the force)\n",
                                   100 * c.match.rms / c.match.measured_rms)
                     : std::string(" (the record holds no force)\n"));
}

std::string tooth_text(std::size_t tooth, const force::ToothEngagement& engagement) {
  std::string text = fmt::format("tooth {}: ", tooth);
  if (engagement.arcs.empty()) {
    return text + "cuts nothing\n";
  }
  text += fmt::format("chip up to {:.5f} mm, cuts", engagement.peak_chip / unit::mm);
  for (const chip::Arc& arc : engagement.arcs) {
    text +=
        fmt::format(" {:.3f}..{:.3f} deg", arc.from / unit::deg, arc.to / unit::deg);
  }
  return text + '\n';
}

std::string short_table(const SimulateResult& r) {
  std::string text;
  for (const Comparison& c : r.comparison) {
    text += comparison_text(c);
  }
  text += "force on the tool [N]      Fx         Fy         Fz\n";
  const auto row = [&](const char* name, const force::Vector3& v) {
    text +=
        fmt::format("  {:<16} {:>10.3f} {:>10.3f} {:>10.3f}\n", name, v[0], v[1], v[2]);
  };
  row("mean", r.force.mean);
  row("least", r.force.min);
  row("largest", r.force.max);
  row("rms", r.force.rms);
  text +=
      fmt::format("  largest in the plane of the table: {:.3f} N\n", r.force.peak_xy);
  text += fmt::format("torque {:.4g} N m (peak {:.4g}), power {:.4g} W\n",
                      r.moments.mean_torque, r.moments.peak_torque,
                      r.moments.mean_torque * r.Omega);
  for (std::size_t j = 0; j < r.engagement.teeth.size(); ++j) {
    text += tooth_text(j + 1, r.engagement.teeth[j]);
  }
  const chip::Removal& removal = r.engagement.removal;
  if (removal.available > 0) {
    text += fmt::format("self-check: the chips of a turn are {:.6f} of feed x width\n",
                        removal.removed / removal.available);
  }
  return text;
}

}  // namespace

Answer answer_without_tables(const SimulateResult& r) {
  return {.command = "simulate",
          .heading = r.heading,
          .result = result_of(r),
          .short_table = short_table(r)};
}

Answer answer_of(const SimulateResult& r) {
  Answer answer = answer_without_tables(r);
  // One by one: a list in braces would copy what may be a million rows.
  answer.tables.push_back(force_table(r));
  answer.tables.push_back(chip_table(r.chips));
  answer.tables.push_back(chip_curve_table(r.curve));
  if (!r.comparison.empty()) {
    std::vector<identification::Run> runs;
    ComputedForces computed{"computed", {}};
    for (const Comparison& c : r.comparison) {
      runs.push_back(c.run);
      computed.of_run.push_back(c.match.computed);
    }
    for (base::Table& table : curve_tables(runs, std::span(&computed, 1))) {
      answer.tables.push_back(std::move(table));
    }
  }
  return answer;
}

}  // namespace trochoid::results
