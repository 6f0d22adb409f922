#include <trochoid/results/channel_fit.h>
#include <trochoid/results/simulate.h>

#include <trochoid/base/units.h>
#include <trochoid/results/curve_tables.h>
#include <trochoid/results/descriptions.h>

#include <fmt/core.h>

#include <cmath>
#include <limits>

namespace trochoid::results {

namespace {

/// A tooth and its number.
struct NumberedTooth {
  std::size_t number;
  const force::ToothEngagement& cuts;
  double lowest;  ///< [m]
};

const Fields<NumberedTooth>& tooth_fields() {
  static const Fields<NumberedTooth> all{
      {"tooth", "number, from 1", [](const NumberedTooth& t) { return t.number; }},
      {"intervals_deg", "where it cuts: pairs of nominal theta, from and to",
       [](const NumberedTooth& t) {
         Array arcs;
         for (const chip::Arc& arc : t.cuts.arcs) {
           arcs.push_back(Array{arc.from, arc.to});
         }
         return arcs;
       }},
      {"peak_chip_mm", "thickest chip",
       [](const NumberedTooth& t) { return t.cuts.peak_chip; }},
      {"lowest_height_mm", "where its edge begins, above the nominal tip",
       [](const NumberedTooth& t) { return t.lowest; }}};
  return all;
}

std::vector<NumberedTooth> numbered_teeth(const SimulateResult& r) {
  std::vector<NumberedTooth> teeth;
  for (const force::ToothEngagement& cuts : r.engagement.teeth) {
    teeth.push_back(
        {teeth.size() + 1, cuts,
         teeth.size() < r.edges.lowest.size() ? r.edges.lowest[teeth.size()] : 0.0});
  }
  return teeth;
}

const Fields<chip::Removal>& removal_fields() {
  using Of = const chip::Removal&;
  static const Fields<chip::Removal> all{
      {"removed_mm2_per_rev", "what the chips of all teeth add up to in a turn",
       [](Of of) { return of.removed * 1e6; }},
      {"feed_times_width_mm2", "feed per turn times width of cut",
       [](Of of) { return of.available * 1e6; }},
      {"ratio", "of both; 1 where the chips are what the feed takes",
       [](Of of) { return of.removed / of.available; }}};
  return all;
}

/// One of the heights asked for.
struct HeightOfEdges {
  const force::Engagement& cuts;
  bool conserves;
};

std::vector<HeightOfEdges> heights_of(const SimulateResult& r) {
  std::vector<HeightOfEdges> all;
  for (const force::Engagement& cuts : r.at_heights) {
    all.push_back({cuts, r.conserves});
  }
  return all;
}

const Fields<HeightOfEdges>& edge_height_fields() {
  using Of = const HeightOfEdges&;
  static const Fields<HeightOfEdges> all{
      {"height_mm", "above the nominal tip, as asked for",
       [](Of of) { return given(of.cuts.height); }},
      {"intervals_deg",
       "of each tooth, where it cuts: pairs of nominal theta, from and to",
       [](Of of) {
         Array teeth;
         for (const force::ToothEngagement& tooth : of.cuts.teeth) {
           Array arcs;
           for (const chip::Arc& arc : tooth.arcs) {
             arcs.push_back(Array{arc.from, arc.to});
           }
           teeth.push_back(arcs);
         }
         return teeth;
       }},
      {"removed_mm2_per_rev",
       "what the chips of all teeth add up to in a turn (C-8); null but for the "
       "trochoidal model",
       [](Of of) {
         return of.conserves ? Value(of.cuts.removal.removed * 1e6) : Value();
       }}};
  return all;
}

const Fields<Comparison>& comparison_fields() {
  using Of = const Comparison&;
  static const Fields<Comparison> all{
      {"file", "of the record", &Comparison::file},
      {"phase_deg", "true angle of tooth 1 less the recorded angle, as found",
       [](Of c) { return c.match.phase; }},
      {"rms_N", "of the difference", [](Of c) { return c.match.rms; }},
      {"rms_axis_N", "of the difference along each axis",
       [](Of c) { return c.match.rms_axis; }},
      {"measured_rms_N", "of the measured force",
       [](Of c) { return c.match.measured_rms; }},
      {"spindle_rpm", "found in the record", &Comparison::Omega}};
  return all;
}

const Fields<SimulateResult>& simulate_fields() {
  using R = SimulateResult;
  const auto moment = [](const R& r) { return r.gauge_length.has_value(); };
  static const Fields<R> all{
      {"mean_N",
       "mean force along x, y, z: of whole turns by integrals where the edges allow it (a "
       "cylinder, no power law), else over the rows of forces.csv",
       [](const R& r) { return r.force.mean; }},
      {"exact_mean_N",
       "mean force along x, y, z over a turn, as an integral along the edges (F-31)",
       [](const R& r) { return r.exact_mean.force; }},
      {"exact_mean_torque_Nm", "mean torque over a turn, as that integral",
       [](const R& r) { return r.exact_mean.torque; }},
      {"exact_mean_channels",
       "with a dynamometer whose axes are named: mean of each channel over a turn, in N, Nm "
       "or W, as that integral",
       [](const R& r) {
         return as_named(Value(Array(r.channel_means.begin(), r.channel_means.end())));
       },
       [](const R& r) { return !r.channel_means.empty(); }},
      {"min_N", "smallest of the rows of forces.csv, axis by axis",
       [](const R& r) { return r.force.min; }},
      {"max_N", "largest of them, axis by axis",
       [](const R& r) { return r.force.max; }},
      {"rms_N", "root mean square of them, axis by axis",
       [](const R& r) { return r.force.rms; }},
      {"peak_xy_N", "largest force in the plane of the table",
       [](const R& r) { return r.force.peak_xy; }},
      {"closed_form_mean_N",
       "F-8, where it applies: a slot without runout and without trochoids",
       &R::closed_form_mean, [](const R& r) { return r.closed_form_mean.has_value(); }},
      {"torque_mean_Nm", "mean torque (F-6)",
       [](const R& r) { return r.moments.mean_torque; }},
      {"torque_peak_Nm", "largest torque",
       [](const R& r) { return r.moments.peak_torque; }},
      {"power_W", "mean torque times spindle speed",
       [](const R& r) { return r.moments.mean_torque * r.Omega; }},
      {"gauge_length_mm", "of the bending moment, where it is given",
       [](const R& r) { return given(*r.gauge_length); }, moment},
      {"bending_peak_Nm", "largest bending moment there (F-7)",
       [](const R& r) { return r.moments.peak_bending; }, moment},
      {"teeth", "what each tooth does in a turn at `teeth_height_mm`", tooth_fields(),
       numbered_teeth},
      {"teeth_height_mm", "above the tip",
       [](const R& r) { return given(r.engagement.height); }},
      {"heights", "at each of `edge_heights_mm`", edge_height_fields(), heights_of,
       [](const R& r) { return !r.at_heights.empty(); }},
      {"volume_check", "C-8: whether the chips of a turn are the material there is",
       removal_fields(), [](const R& r) { return r.engagement.removal; },
       [](const R& r) { return r.engagement.removal.available > 0; }},
      {"comparison", "with each measurement", comparison_fields(), &R::comparison,
       [](const R& r) { return !r.comparison.empty(); }}};
  return all;
}

/// @param k  number of the channel among those of its unit, from 0
double channel_value(const SimulateResult& r, force::ChannelUnit unit, std::size_t i,
                     std::size_t k) {
  const std::size_t channels = r.sensor.channels.size();
  return r.channel_values[i * channels + channel_at(r.sensor, unit, k)];
}

const Columns<SimulateResult>& simulated_forces() {
  using R = SimulateResult;
  static const Columns<R> all{
      "forces.csv",
      [](const R& r) { return r.phi.size(); },
      {{"angle_deg", "spindle angle",
        [](const R& r, std::size_t i) { return given(r.phi[i]); }},
       {"time_s", "since the angle 0",
        [](const R& r, std::size_t i) { return r.phi[i] / r.Omega; }},
       {"F*_N", "force on the tool along x, y, z",
        [](const R&) {
          return std::vector<std::string>{"x", "y", "z"};
        },
        [](const R& r, std::size_t i, std::size_t q) { return r.loads[i].force[q]; }},
       {"channel*_N", "with a dynamometer: what its channels read that are forces",
        [](const R& r) {
          if (!r.channel_values.empty()) {
            return channels_of_unit(r.sensor, force::ChannelUnit::newton);
          }
          return r.channels ? std::vector<std::string>{"1", "2", "3"}
                            : std::vector<std::string>{};
        },
        [](const R& r, std::size_t i, std::size_t q) {
          if (!r.channel_values.empty()) {
            return channel_value(r, force::ChannelUnit::newton, i, q);
          }
          const auto& row = (*r.channels)[q];
          const force::Vector3& F = r.loads[i].force;
          return row[0] * F[0] + row[1] * F[1] + row[2] * F[2];
        }},
       {"channel*_Nm", "the same of torque and moments",
        [](const R& r) {
          return channels_of_unit(r.sensor, force::ChannelUnit::newton_metre);
        },
        [](const R& r, std::size_t i, std::size_t q) {
          return channel_value(r, force::ChannelUnit::newton_metre, i, q);
        }},
       {"channel*_W", "the same of power",
        [](const R& r) { return channels_of_unit(r.sensor, force::ChannelUnit::watt); },
        [](const R& r, std::size_t i, std::size_t q) {
          return channel_value(r, force::ChannelUnit::watt, i, q);
        }}}};
  return all;
}

const Columns<force::ChipGrid>& chip_columns() {
  using Of = const force::ChipGrid&;
  static const Columns<force::ChipGrid> all{
      "chip.csv",
      [](Of grid) { return grid.h.size(); },
      {{"tooth", "number, from 1",
        [](Of grid, std::size_t i) {
          return i / (grid.height.size() * grid.theta.size()) + 1;
        }},
       {"edge_angle_deg", "nominal theta, as asked for",
        [](Of grid, std::size_t i) {
          const std::size_t heights = grid.height.size();
          return given(grid.theta[i % (heights * grid.theta.size()) / heights]);
        }},
       {"height_mm", "above the tip, as asked for",
        [](Of grid, std::size_t i) {
          return given(grid.height[i % grid.height.size()]);
        }},
       {"h_mm", "uncut chip thickness along the horizontal ray",
        [](Of grid, std::size_t i) { return grid.h[i]; }},
       {"mark",
        "whose mark reaches farthest out on the ray: 1 the tooth before, the number of "
        "teeth for the tooth itself a turn ago; 0 where nothing is cut",
        [](Of grid, std::size_t i) { return grid.mark[i]; }}}};
  return all;
}

/// Of what is not there nothing is written.
double if_there(const geometry::EdgeAt& edge, double value) {
  return edge.there ? value : std::numeric_limits<double>::quiet_NaN();
}

const Columns<force::EdgeGrid>& edge_columns() {
  using Of = const force::EdgeGrid&;
  static const auto at = [](Of grid, std::size_t i) -> const geometry::EdgeAt& {
    return grid.edges[i];
  };
  static const Columns<force::EdgeGrid> all{
      "edges.csv",
      [](Of grid) { return grid.edges.size(); },
      {{"tooth", "number, from 1",
        [](Of grid, std::size_t i) { return i % grid.lowest.size() + 1; }},
       {"height_mm", "above the nominal tip, as asked for",
        [](Of grid, std::size_t i) {
          return given(grid.height[i / grid.lowest.size()]);
        }},
       {"there", "1: the tooth reaches down to this height; 0: it does not",
        [](Of grid, std::size_t i) { return at(grid, i).there ? 1 : 0; }},
       {"radius_mm", "R_j, from the axis of rotation (G-9)",
        [](Of grid, std::size_t i) {
          return if_there(at(grid, i), at(grid, i).position.R);
        }},
       {"omega_deg", "nominal angle of the edge behind the tip of tooth 1",
        [](Of grid, std::size_t i) {
          return if_there(at(grid, i), at(grid, i).omega);
        }},
       {"eps_deg", "angle by which the runout delays it (G-9)",
        [](Of grid, std::size_t i) {
          return if_there(at(grid, i), at(grid, i).position.epsilon);
        }},
       {"kappa_deg", "axial immersion angle (G-20)",
        [](Of grid, std::size_t i) {
          const geometry::EdgeAt& edge = at(grid, i);
          return if_there(edge, std::atan2(edge.sin_kappa, edge.cos_kappa));
        }},
       {"ds_dz", "length of edge per height (G-22)", [](Of grid, std::size_t i) {
          return if_there(at(grid, i), at(grid, i).dS_dz);
        }}}};
  return all;
}

std::string comparison_text(const Comparison& c) {
  std::string text = fmt::format("compared with {}: rms of the difference {:.2f} N",
                                 c.file, c.match.rms);
  return text + (c.match.measured_rms > 0
                     ? fmt::format(" ({:.1f} % of the force)\n",
                                   100 * c.match.rms / c.match.measured_rms)
                     : std::string(" (the record shows no force)\n"));
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
          .result = simulate_fields().object(r),
          .short_table = short_table(r)};
}

Answer answer_of(const SimulateResult& r) {
  Answer answer = answer_without_tables(r);
  // One by one: a list in braces would copy what may be a million rows.
  answer.tables.push_back(simulated_forces().table(r));
  answer.tables.push_back(chip_columns().table(r.chips));
  answer.tables.push_back(chip_curve_table(r.curve));
  if (!r.edges.edges.empty()) {
    answer.tables.push_back(edge_columns().table(r.edges));
  }
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

Description description_of_simulate() {
  Description all{.command = "simulate", .keys = simulate_fields().texts()};
  simulated_forces().add_texts(all.columns);
  chip_columns().add_texts(all.columns);
  add_texts_of_chip_curve(all.columns);
  edge_columns().add_texts(all.columns);
  add_texts_of_curves(all.columns);
  return all;
}

}  // namespace trochoid::results
