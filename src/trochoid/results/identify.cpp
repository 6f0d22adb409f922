#include <trochoid/results/identify.h>

#include <trochoid/base/units.h>
#include <trochoid/results/clocking.h>
#include <trochoid/results/curve_tables.h>
#include <trochoid/results/estimate_value.h>
#include <trochoid/results/fit_value.h>
#include <trochoid/results/fits_table.h>
#include <trochoid/results/joint_of_fit.h>
#include <trochoid/results/material.h>

#include <fmt/core.h>

#include <algorithm>
#include <limits>

namespace trochoid::results {

namespace {

using base::add_column;
using identification::Fit;

bool is_signed_permutation(const signal::Matrix3& M) {
  const auto all = signal::axes_candidates();
  return std::find(all.begin(), all.end(), M) != all.end();
}

Object signal_value(const IdentifyResult& r) {
  Array files;
  Array samples;
  Array rpm;
  Array rpm_se;
  Array stated;
  for (const RecordSummary& record : r.records) {
    files.emplace_back(record.file);
    samples.emplace_back(record.samples);
    rpm.emplace_back(unit::in(record.Omega, unit::rpm));
    rpm_se.push_back(record.Omega_se > 0 ? Value(record.Omega_se / unit::rpm)
                                         : Value());
    stated.emplace_back(unit::in(record.stated_Omega, unit::rpm));
  }
  Object out{{"files", std::move(files)},
             {"samples", std::move(samples)},
             {"spindle_rpm", alone_or_list(std::move(rpm))},
             {"spindle_rpm_se", alone_or_list(std::move(rpm_se))},
             {"stated_rpm", alone_or_list(std::move(stated))}};
  if (!r.folded.empty()) {
    Array turns;
    for (const signal::OneRevolution& one : r.folded) {
      turns.emplace_back(one.revolutions);
    }
    out.push_back({"revolutions", std::move(turns)});
  }
  if (is_signed_permutation(r.channels)) {
    out.push_back({"axes", signal::axes_names(r.channels)});
  } else {
    out.push_back({"axes", nullptr});
    out.push_back({"matrix", r.channels});
  }
  if (r.axes) {
    out.push_back({"axes_rms_N", r.axes->rms});
    out.push_back({"axes_next_rms_N", r.axes->next_rms});
  }
  return out;
}

/// Whether the curves of all samples are written, or those of a mean turn.
bool whole(const IdentifyResult& r) {
  std::size_t samples = 0;
  for (const identification::Run& run : r.runs) samples += run.angle.size();
  return r.whole_curves || samples <= most_curve_samples;
}

Object form_value(const identification::RunoutForm& form) {
  Array tried;
  for (const identification::FormTried& one : form.tried) {
    tried.push_back(Object{{"form", identification::name_of(one.form)},
                           {"rms_N", one.rms},
                           {"excess", one.excess}});
  }
  return Object{
      {"form", identification::name_of(form.stated ? form.first : form.better)},
      {"decided_by", form.stated ? "case" : "record"},
      {"better", identification::name_of(form.better)},
      {"why", form.why},
      {"tried", std::move(tried)}};
}

/// How the answer depends on the harmonics that are fitted.
Array views_value(const IdentifyResult& r) {
  const auto name = force::coefficient_quantities(r.fits.front().law).front();
  Array out;
  for (const identification::View& view : r.views) {
    out.push_back(Object{{"band_harmonics", view.band_harmonics},
                         {"resonance", view.resonant},
                         {std::string(name.key), estimate_value(view.K_t, name.unit)},
                         {"unexplained", view.unexplained}});
  }
  return out;
}

std::string_view verdict_of(const IdentifyResult& r) {
  if (!r.reasons_against.empty()) {
    return "do not use";
  }
  return r.reasons_for_care.empty() ? "usable" : "usable with care";
}

/// Half of a 95 % interval over its standard error.
double factor_of(const IdentifyResult& r) {
  return r.fits[*r.chosen].interval_factor;
}

/// Whether a record names the group that it is of.
bool has_groups(const IdentifyResult& r) {
  return std::any_of(r.runs.begin(), r.runs.end(),
                     [](const identification::Run& run) { return !run.group.empty(); });
}

Object result_of(const IdentifyResult& r) {
  std::vector<std::string> files;
  for (const RecordSummary& record : r.records) {
    files.push_back(record.file);
  }
  const bool grouped = has_groups(r);
  Array fits;
  for (const Fit& fit : r.fits) {
    Object value = fit_value(fit);
    if (grouped) {
      set(value, "groups", groups_value(fit, files));
    }
    fits.emplace_back(std::move(value));
  }
  Object result{{"fits", std::move(fits)}, {"chosen", nullptr}};
  if (r.chosen) {
    const Fit& chosen = r.fits[*r.chosen];
    set(result, "chosen", chip::name_of(chosen.chip.model));
    set(result, "covariance", joint_value(joint_of(chosen, 0)));
    if (grouped) {
      set(result, "groups", groups_value(chosen, files));
    }
  }
  if (!r.records.empty()) {
    set(result, "signal", signal_value(r));
  }
  if (r.clocking) {
    set(result, "clocking", clocking_value(*r.clocking, factor_of(r)));
  }
  if (r.chosen) {
    if (r.runout_form) set(result, "runout_form", form_value(*r.runout_form));
    if (!r.views.empty()) set(result, "views", views_value(r));
    set(result, "curves", whole(r) ? "whole" : "mean turn");
    set(result, "verdict", verdict_of(r));
    set(result, "with_care", r.reasons_for_care);
    set(result, "do_not_use", r.reasons_against);
  }
  return result;
}

/// Below the table of fits: axes and spindle speeds found.
std::string signal_lines(const IdentifyResult& r) {
  std::string text;
  if (r.axes && r.axes->ok) {
    const auto names = signal::axes_names(r.axes->matrix);
    text += fmt::format(
        "axes found: channels read {}, {}, {} (next best {:.2f} times worse)\n",
        names[0], names[1], names[2], r.axes->next_rms / r.axes->rms);
  }
  for (const RecordSummary& record : r.records) {
    text += fmt::format("{}: {:.2f} rpm (stated {:g})\n", record.file,
                        record.Omega / unit::rpm, record.stated_Omega / unit::rpm);
  }
  return text;
}

std::string form_line(const IdentifyResult& r) {
  if (!r.runout_form || r.runout_form->stated) return "";
  return fmt::format("runout: {}\n", r.runout_form->why);
}

std::string short_table(const IdentifyResult& r) {
  if (!r.chosen) {
    return "No answer: " + r.heading.message + "\n";
  }
  const Fit& chosen = r.fits[*r.chosen];
  const std::string groups =
      chosen.groups.size() > 1 ? groups_table(chosen) + "\n" : std::string();
  const std::string gauge =
      r.clocking ? clocking_lines(*r.clocking, factor_of(r)) : std::string();
  return identification_verdict(r) + "\n\n" + groups + fits_table(r.fits) +
         form_line(r) + gauge + signal_lines(r);
}

/// folded.csv: mean and scatter of the measured force over one turn; none where no
/// record holds two whole turns.
std::optional<base::Table> folded_table(
    const std::vector<signal::OneRevolution>& folded,
    std::span<const identification::Run> runs) {
  struct Bin {
    std::size_t run;
    std::size_t at;
  };
  std::vector<Bin> bins;
  for (std::size_t r = 0; r < folded.size(); ++r) {
    for (std::size_t b = 0; folded[r].revolutions >= 2 && b < folded[r].angle.size();
         ++b) {
      if (folded[r].count[b] >= 2) {
        bins.push_back({r, b});
      }
    }
  }
  if (bins.empty()) {
    return std::nullopt;
  }
  base::Table table{"folded.csv", {}};
  const std::size_t n = bins.size();
  add_column(table, "run", n, [&](std::size_t i) { return bins[i].run + 1; });
  add_column(table, "angle_deg", n, [&](std::size_t i) {
    return folded[bins[i].run].angle[bins[i].at] / unit::deg;
  });
  constexpr const char* axis[] = {"Fx", "Fy", "Fz"};
  for (std::size_t q = 0; q < 3; ++q) {
    const auto measured = [&](const Bin& bin) {
      return bin.run >= runs.size() || runs[bin.run].measured[q];
    };
    if (std::ranges::none_of(bins, measured)) continue;
    const auto value = [&](std::size_t i, const auto& of) {
      return measured(bins[i]) ? of[q][bins[i].at]
                               : std::numeric_limits<double>::quiet_NaN();
    };
    add_column(table, fmt::format("{}_mean_N", axis[q]), n,
               [&](std::size_t i) { return value(i, folded[bins[i].run].mean); });
    add_column(table, fmt::format("{}_sd_N", axis[q]), n,
               [&](std::size_t i) { return value(i, folded[bins[i].run].scatter); });
  }
  return table;
}

/// overview.csv: the whole records in few pieces, and which of them were used.
base::Table overview_table(std::span<const signal::Overview> overviews) {
  struct Piece {
    std::size_t run = 0;
    std::size_t at = 0;
  };
  std::vector<Piece> pieces;
  bool timed = true;
  for (std::size_t r = 0; r < overviews.size(); ++r) {
    timed = timed && !overviews[r].time.empty();
    for (std::size_t k = 0; k < overviews[r].turn.size(); ++k) pieces.push_back({r, k});
  }
  base::Table table{"overview.csv", {}};
  const std::size_t n = pieces.size();
  const auto of = [&](std::size_t i) -> const signal::Overview& {
    return overviews[pieces[i].run];
  };
  add_column(table, "run", n, [&](std::size_t i) { return pieces[i].run + 1; });
  if (timed) {
    add_column(table, "time_s", n,
               [&](std::size_t i) { return of(i).time[pieces[i].at]; });
  }
  add_column(table, "turn", n, [&](std::size_t i) { return of(i).turn[pieces[i].at]; });
  for (std::size_t c = 0; c < 3; ++c) {
    const auto there = [&](const signal::Overview& o) { return !o.low[c].empty(); };
    if (!std::ranges::all_of(overviews, there)) continue;
    add_column(table, fmt::format("channel{}_low_N", c + 1), n,
               [&](std::size_t i) { return of(i).low[c][pieces[i].at]; });
    add_column(table, fmt::format("channel{}_high_N", c + 1), n,
               [&](std::size_t i) { return of(i).high[c][pieces[i].at]; });
  }
  add_column(table, "used", n,
             [&](std::size_t i) { return of(i).used[pieces[i].at] ? 1 : 0; });
  return table;
}

base::Table sweep_table(const OffsetSweep& sweep) {
  base::Table table{"sweep.csv", {}};
  const std::size_t n = sweep.offset.size();
  add_column(table, "offset_um", n,
             [&](std::size_t i) { return unit::in(sweep.offset[i], unit::um); });
  for (const OffsetSweep::Curve& curve : sweep.curves) {
    add_column(table, fmt::format("rms_{}_N", chip::name_of(curve.model)), n,
               [&](std::size_t i) { return curve.rms[i]; });
  }
  return table;
}

std::vector<base::Table> tables_of(const IdentifyResult& r) {
  std::vector<ComputedForces> computed;
  for (const Fit& fit : r.fits) {
    if (fit.ok) {
      computed.push_back({std::string(chip::name_of(fit.chip.model)), fit.fitted});
    }
  }
  std::vector<base::Table> tables =
      whole(r) ? curve_tables(r.runs, computed)
               : curve_tables(mean_turns(r.runs, computed), computed);
  if (!r.overviews.empty()) tables.push_back(overview_table(r.overviews));
  if (auto folded = folded_table(r.folded, r.runs)) {
    tables.push_back(std::move(*folded));
  }
  if (r.curve) {
    tables.push_back(chip_curve_table(*r.curve));
  }
  if (r.sweep && !r.sweep->curves.empty()) {
    tables.push_back(sweep_table(*r.sweep));
  }
  return tables;
}

}  // namespace

Answer answer_of(const IdentifyResult& r) {
  Answer answer{.command = "identify",
                .heading = r.heading,
                .result = result_of(r),
                .short_table = short_table(r)};
  if (r.chosen) {
    answer.tables = tables_of(r);
    const Fit& chosen = r.fits[*r.chosen];
    answer.texts.push_back({"material.toml", material_toml(chosen, r.edge_length)});
    for (std::size_t g = 1; g < chosen.groups.size(); ++g) {
      answer.texts.push_back({fmt::format("material_{}.toml", g + 1),
                              material_toml(chosen, chosen.groups[g], r.edge_length)});
    }
  }
  return answer;
}

}  // namespace trochoid::results
