#include <trochoid/results/identify.h>

#include <trochoid/base/units.h>
#include <trochoid/results/clocking.h>
#include <trochoid/results/curve_tables.h>
#include <trochoid/results/descriptions.h>
#include <trochoid/results/fit_value.h>
#include <trochoid/results/fits_table.h>
#include <trochoid/results/joint_of_fit.h>
#include <trochoid/results/material.h>

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <functional>
#include <limits>

namespace trochoid::results {

namespace {

using identification::Fit;

bool is_signed_permutation(const signal::Matrix3& M) {
  const auto all = signal::axes_candidates();
  return std::find(all.begin(), all.end(), M) != all.end();
}

/// A list of one number a record; of a single record the number alone.
template <class Get>
auto of_records(Get get) {
  return [get](const IdentifyResult& r) {
    Array list;
    for (const RecordSummary& record : r.records) {
      list.emplace_back(std::invoke(get, record));
    }
    return alone_or_list(std::move(list));
  };
}

const Fields<IdentifyResult>& signal_fields() {
  using R = const IdentifyResult&;
  const auto searched = [](R r) { return r.axes.has_value(); };
  static const Fields<IdentifyResult> all{
      {"files", "the records, in measurement order",
       [](R r) {
         Array files;
         for (const RecordSummary& record : r.records) files.emplace_back(record.file);
         return files;
       }},
      {"samples", "of each",
       [](R r) {
         Array samples;
         for (const RecordSummary& one : r.records) samples.emplace_back(one.samples);
         return samples;
       }},
      {"spindle_rpm", "spindle speed found, of a single record the number alone",
       [](R r) { return all_given(of_records(&RecordSummary::Omega)(r)); }},
      {"spindle_rpm_se", "its standard error, or `null`",
       of_records([](const RecordSummary& one) {
         return one.Omega_se > 0 ? Value(one.Omega_se / unit::rpm) : Value();
       })},
      {"stated_rpm", "spindle speed of the case",
       [](R r) { return all_given(of_records(&RecordSummary::stated_Omega)(r)); }},
      {"revolutions", "how many turns of each record were laid over each other",
       [](R r) {
         Array turns;
         for (const signal::OneRevolution& one : r.folded) {
           turns.emplace_back(one.revolutions);
         }
         return turns;
       },
       [](R r) { return !r.folded.empty(); }},
      {"axes", "of the dynamometer; `null` where they are no signed permutation",
       [](R r) {
         if (r.sensor) return channel_names_value(r.sensor->sensor);
         return is_signed_permutation(r.channels)
                    ? Value(signal::axes_names(r.channels))
                    : Value();
       }},
      {"matrix", "of the dynamometer, in that case", &IdentifyResult::channels,
       [](R r) { return !r.sensor && !is_signed_permutation(r.channels); }},
      {"axes_rms_N", "with `axes = \"auto\"`: what the choice leaves",
       [](R r) { return r.axes->rms; }, searched},
      {"axes_next_rms_N", "and what the next one leaves",
       [](R r) { return r.axes->next_rms; }, searched}};
  return all;
}

/// Whether the curves of all samples are written, or those of a mean turn.
bool whole(const IdentifyResult& r) {
  std::size_t samples = 0;
  for (const identification::Run& run : r.runs) samples += run.angle.size();
  return r.whole_curves || samples <= most_curve_samples;
}

const Fields<identification::RunoutForm>& form_fields() {
  using Tried = identification::FormTried;
  static const Fields<Tried> tried{
      {"form", "as in `[identify] runout`",
       [](const Tried& one) { return identification::name_of(one.form); }},
      {"rms_N", "that it leaves", &Tried::rms},
      {"excess",
       "how much worse it would foretell further turns than the better one, in what one "
       "unknown explains by chance (I-18); below 4 it decides nothing",
       &Tried::excess}};
  static const Fields<identification::RunoutForm> all{
      {"form", "that was fitted",
       [](const identification::RunoutForm& f) {
         return identification::name_of(f.stated ? f.first : f.better);
       }},
      {"decided_by", "`case` or `record`",
       [](const identification::RunoutForm& f) {
         return f.stated ? "case" : "record";
       }},
      {"better", "that the records decide for",
       [](const identification::RunoutForm& f) {
         return identification::name_of(f.better);
       }},
      {"why", "in words", &identification::RunoutForm::why},
      {"tried", "each form that was tried", tried, &identification::RunoutForm::tried}};
  return all;
}

/// How much of a systematic is told of, in words and in SI.
struct Untold {
  const identification::SystematicEffect& effect;
  const Fit& fit;

  [[nodiscard]] double amount() const {
    using enum identification::SystematicKind;
    switch (effect.systematic.kind) {
      case turn:
        return unit::deg;
      case gain:
      case cross_talk:
      case all_gains:
        return 0.01;
      case delay:
        return 1e-3;
      case axial_depth:
      case radial_depth:
        return 0.1 * unit::mm;
      case feed:
        break;
    }
    return 0.001 * unit::mm;
  }
  [[nodiscard]] std::string_view what() const {
    using enum identification::SystematicKind;
    switch (effect.systematic.kind) {
      case turn:
        return "1 deg of the dynamometer about z";
      case gain:
        return "1 % of one gain";
      case cross_talk:
        return "1 % of cross talk";
      case delay:
        return "1 ms of one channel";
      case all_gains:
        return "1 % of all gains";
      case axial_depth:
        return "0.1 mm of axial depth";
      case radial_depth:
        return "0.1 mm of radial depth";
      case feed:
        break;
    }
    return "0.001 mm of feed per tooth";
  }
  /// Of a coefficient [SI].
  [[nodiscard]] double change(std::size_t q) const {
    return effect.on_coefficients[q] * amount();
  }
};

std::vector<Untold> untold_of(const IdentifyResult& r) {
  std::vector<Untold> out;
  for (const auto& effect : r.not_in_intervals) {
    out.push_back({effect, r.fits[*r.chosen]});
  }
  return out;
}

/// The coefficients that make most of the force.
constexpr std::size_t told_coefficients = 2;

const Fields<Untold>& untold_fields() {
  static const Fields<Untold> all{
      {"what", "how much of what was not told", &Untold::what},
      Field<Untold>{"effect", "by how much the coefficients are then found too large",
                    [](const Untold& one) {
                      Object out;
                      const auto names = force::coefficient_quantities(one.fit.law);
                      for (std::size_t q = 0; q < told_coefficients; ++q) {
                        set(out, names[q].key, one.change(q) / names[q].unit);
                      }
                      return as_named(out);
                    }}
          .with({{".K_*", "in the unit of its key"}})};
  return all;
}

/// `not in the intervals: 1 deg of the dynamometer about z: K_tc -0.8 %, K_rc +4.2 %; ...`
std::string untold_line(const IdentifyResult& r) {
  if (r.not_in_intervals.empty()) return "";
  std::vector<std::string> parts;
  for (const Untold& one : untold_of(r)) {
    const auto names = force::coefficient_quantities(one.fit.law);
    std::vector<std::string> changes;
    for (std::size_t q = 0; q < told_coefficients; ++q) {
      const auto& K = one.fit.coefficients[q];
      if (!K || K->value == 0.0) continue;
      changes.push_back(fmt::format("{} {:+.2g} %",
                                    names[q].key.substr(0, names[q].key.find('_', 2)),
                                    100 * one.change(q) / K->value));
    }
    parts.push_back(fmt::format("{}: {}", one.what(), fmt::join(changes, ", ")));
  }
  return fmt::format("not in the intervals: {}\n", fmt::join(parts, "; "));
}

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

/// A result, and what all its fits and groups need of it.
struct Identified {
  const IdentifyResult& r;
  std::vector<std::string> files;
  bool grouped = has_groups(r);

  explicit Identified(const IdentifyResult& of) : r(of) {
    for (const RecordSummary& record : r.records) files.push_back(record.file);
  }
  [[nodiscard]] FitOfRecords fit(std::size_t i) const {
    return {r.fits[i], files, grouped, r.sensor ? &*r.sensor : nullptr};
  }
};

const Fields<Identified>& identified_fields() {
  using Of = const Identified&;
  const auto chosen = [](Of of) { return of.r.chosen.has_value(); };
  static const Fields<Identified> all{
      {"fits", "one for each entry of `chip_models`, in that order", fit_fields(),
       [](Of of) {
         std::vector<FitOfRecords> fits;
         for (std::size_t i = 0; i < of.r.fits.size(); ++i) fits.push_back(of.fit(i));
         return fits;
       }},
      {"chosen",
       "the fit in `material.toml`: the trochoidal one if it was asked for, else "
       "the best",
       [](Of of) {
         return of.r.chosen ? Value(chip::name_of(of.r.fits[*of.r.chosen].chip.model))
                            : Value();
       }},
      {"covariance",
       "of the chosen fit, the first group: what `[sweep] covariance` draws "
       "from",
       joint_fields(),
       [](Of of) { return found_or_none(joint_of(of.r.fits[*of.r.chosen], 0)); },
       chosen},
      {"groups", "of the chosen fit", group_fields(),
       [](Of of) { return groups_of(of.fit(*of.r.chosen)); },
       [](Of of) { return of.r.chosen && of.grouped; }},
      {"signal", "what was found in the records before anything was fitted",
       signal_fields(), [](Of of) { return &of.r; },
       [](Of of) { return !of.r.records.empty(); }},
      {"clocking", "of an identified eccentricity", clocking_fields(),
       [](Of of) {
         return Clocked{*of.r.clocking, factor_of(of.r)};
       },
       [](Of of) { return of.r.clocking.has_value(); }},
      {"runout_form", "how the form of the runout was decided", form_fields(),
       [](Of of) { return of.r.runout_form; },
       [](Of of) { return of.r.chosen && of.r.runout_form; }},
      Field<Identified>{
          "views",
          "where what a fit leaves repeats turn by turn: the chosen view first, then "
          "others",
          [](Of of) { return as_named(views_value(of.r)); },
          [](Of of) { return of.r.chosen && !of.r.views.empty(); }}
          .with({{"[].band_harmonics", "0: all"},
                 {"[].resonance",
                  "whether resonances of the dynamometer are in the model"},
                 {"[].K_*", "the first coefficient of the law, by its key"},
                 {"[].K_*.value", "in the unit of its key"},
                 {"[].K_*.se", "one standard error"},
                 {"[].K_*.low", "of the 95 % confidence interval"},
                 {"[].K_*.high", "of the 95 % confidence interval"},
                 {"[].unexplained", "part of the whole force"}}),
      {"not_in_the_intervals",
       "errors that the record cannot show and no interval includes, and how they "
       "would change the coefficients (I-24)",
       untold_fields(), [](Of of) { return untold_of(of.r); },
       [](Of of) { return of.r.chosen && !of.r.not_in_intervals.empty(); }},
      {"curves",
       "`whole`, or `mean turn` where the records are long and `fitted.csv`, "
       "`residual.csv` contain the mean turn of each (`--curves` keeps every sample)",
       [](Of of) { return whole(of.r) ? "whole" : "mean turn"; }, chosen},
      {"verdict",
       "`usable`, `usable with care` or `do not use`: the first line printed and the "
       "first of the report",
       [](Of of) { return verdict_of(of.r); }, chosen},
      {"with_care",
       "why to use the numbers with care, a few words for each; empty: no reason seen, or "
       "`do_not_use` has some",
       [](Of of) { return of.r.reasons_for_care; }, chosen},
      {"do_not_use",
       "reasons why the numbers must not be used; empty: none. Then `message`, the table "
       "and `material.toml` begin with `Do not use these numbers`, and warnings "
       "`likely_cause` say what to look at",
       [](Of of) { return of.r.reasons_against; }, chosen}};
  return all;
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
         form_line(r) + untold_line(r) + gauge +
         (r.sensor ? channel_lines({chosen, *r.sensor}) : std::string()) +
         signal_lines(r);
}

constexpr std::array<const char*, 3> axis_words = {"Fx", "Fy", "Fz"};

/// The bins of all records that hold something.
struct Folded {
  struct Bin {
    std::size_t run;
    std::size_t at;
  };
  std::span<const signal::OneRevolution> folded;
  std::span<const identification::Run> runs;
  std::vector<Bin> bins = {};
  std::vector<std::size_t> axes = {};  ///< that any of the runs has measured

  Folded(std::span<const signal::OneRevolution> turns,
         std::span<const identification::Run> of)
      : folded(turns), runs(of) {
    for (std::size_t r = 0; r < folded.size(); ++r) {
      for (std::size_t b = 0; folded[r].revolutions >= 2 && b < folded[r].angle.size();
           ++b) {
        if (folded[r].count[b] >= 2) bins.push_back({r, b});
      }
    }
    for (std::size_t q = 0; q < 3; ++q) {
      if (std::ranges::any_of(bins, [&](Bin bin) { return measured(bin, q); })) {
        axes.push_back(q);
      }
    }
  }
  [[nodiscard]] bool measured(Bin bin, std::size_t q) const {
    return bin.run >= runs.size() || runs[bin.run].measured[q];
  }
  [[nodiscard]] double value(std::size_t i, std::size_t which) const {
    const std::size_t q = axes[which / 2];
    if (!measured(bins[i], q)) return std::numeric_limits<double>::quiet_NaN();
    const signal::OneRevolution& one = folded[bins[i].run];
    return (which % 2 == 0 ? one.mean : one.scatter)[q][bins[i].at];
  }
};

const Columns<Folded>& folded_columns() {
  using Of = const Folded&;
  static const Columns<Folded> all{
      "folded.csv",
      [](Of f) { return f.bins.size(); },
      {{"run", "number of the measurement, from 1",
        [](Of f, std::size_t i) { return f.bins[i].run + 1; }},
       {"angle_deg", "middle of the bin",
        [](Of f, std::size_t i) {
          return f.folded[f.bins[i].run].angle[f.bins[i].at];
        }},
       {"*_N",
        "`Fx_mean_N`, `Fx_sd_N`, ...: mean and standard deviation of the measured "
        "force over one turn",
        [](Of f) {
          std::vector<std::string> names;
          for (const std::size_t q : f.axes) {
            names.push_back(fmt::format("{}_mean", axis_words[q]));
            names.push_back(fmt::format("{}_sd", axis_words[q]));
          }
          return names;
        },
        [](Of f, std::size_t i, std::size_t k) { return f.value(i, k); }}}};
  return all;
}

/// The whole records in few pieces.
struct Overviews {
  struct Piece {
    std::size_t run;
    std::size_t at;
  };
  std::span<const signal::Overview> overviews;
  std::vector<Piece> pieces = {};
  std::vector<std::size_t> channels = {};  ///< that all of them have

  explicit Overviews(std::span<const signal::Overview> of) : overviews(of) {
    for (std::size_t r = 0; r < overviews.size(); ++r) {
      for (std::size_t k = 0; k < overviews[r].turn.size(); ++k)
        pieces.push_back({r, k});
    }
    for (std::size_t c = 0; c < 3; ++c) {
      const auto there = [&](const signal::Overview& o) { return !o.low[c].empty(); };
      if (std::ranges::all_of(overviews, there)) channels.push_back(c);
    }
  }
  template <class Values>
  [[nodiscard]] double value(std::size_t i, const Values& of) const {
    return of(overviews[pieces[i].run])[pieces[i].at];
  }
};

const Columns<Overviews>& overview_columns() {
  using Of = const Overviews&;
  static const Columns<Overviews> all{
      "overview.csv",
      [](Of o) { return o.pieces.size(); },
      {{"run", "number of the measurement, from 1",
        [](Of o, std::size_t i) { return o.pieces[i].run + 1; }},
       {"time_s", "middle of the piece, where all records have times",
        [](Of o, std::size_t i) {
          return o.value(
              i, [](const auto& one) -> auto& { return one.time; });
        },
        [](Of o) {
          return std::ranges::none_of(o.overviews,
                                      [](const auto& one) { return one.time.empty(); });
        }},
       {"turn", "the same in turns of the spindle as stated",
        [](Of o, std::size_t i) {
          return o.value(
              i, [](const auto& one) -> auto& { return one.turn; });
        }},
       {"channel*_N",
        "`channel1_low_N`, `channel1_high_N`, ...: smallest and largest reading of each "
        "channel",
        [](Of o) {
          std::vector<std::string> names;
          for (const std::size_t c : o.channels) {
            names.push_back(fmt::format("{}_low", c + 1));
            names.push_back(fmt::format("{}_high", c + 1));
          }
          return names;
        },
        [](Of o, std::size_t i, std::size_t k) {
          return o.value(
              i, [&](const auto& one) -> auto& {
                return (k % 2 == 0 ? one.low : one.high)[o.channels[k / 2]];
              });
        }},
       {"used", "1: its middle is in the part that was used", [](Of o, std::size_t i) {
          return o.value(
              i, [](const auto& one) -> auto& { return one.used; });
        }}}};
  return all;
}

const Columns<OffsetSweep>& offset_sweep_columns() {
  using Of = const OffsetSweep&;
  static const Columns<OffsetSweep> all{
      "sweep.csv",
      [](Of s) { return s.offset.size(); },
      {{"offset_um", "of tooth 2",
        [](Of s, std::size_t i) { return given(s.offset[i]); }},
       {"rms_*_N", "left by each chip model of that name, coefficients fitted anew",
        [](Of s) {
          std::vector<std::string> names;
          for (const OffsetSweep::Curve& curve : s.curves) {
            names.emplace_back(chip::name_of(curve.model));
          }
          return names;
        },
        [](Of s, std::size_t i, std::size_t k) { return s.curves[k].rms[i]; }}}};
  return all;
}

std::vector<base::Table> tables_of(const IdentifyResult& r) {
  if (r.sensor) {
    std::vector<base::Table> tables{
        channel_columns_of_fit().table({r.fits[*r.chosen], *r.sensor})};
    if (!r.overviews.empty()) {
      tables.push_back(overview_columns().table(Overviews(r.overviews)));
    }
    return tables;
  }
  std::vector<ComputedForces> computed;
  for (const Fit& fit : r.fits) {
    if (fit.ok) {
      computed.push_back({std::string(chip::name_of(fit.chip.model)), fit.fitted});
    }
  }
  std::vector<base::Table> tables =
      whole(r) ? curve_tables(r.runs, computed)
               : curve_tables(mean_turns(r.runs, computed), computed);
  if (!r.overviews.empty()) {
    tables.push_back(overview_columns().table(Overviews(r.overviews)));
  }
  if (const Folded folded(r.folded, r.runs); !folded.bins.empty()) {
    tables.push_back(folded_columns().table(folded));
  }
  if (r.curve) {
    tables.push_back(chip_curve_table(*r.curve));
  }
  if (r.sweep && !r.sweep->curves.empty()) {
    tables.push_back(offset_sweep_columns().table(*r.sweep));
  }
  return tables;
}

}  // namespace

Answer answer_of(const IdentifyResult& r) {
  Answer answer{.command = "identify",
                .heading = r.heading,
                .result = identified_fields().object(Identified(r)),
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

Description description_of_identify() {
  Description all{.command = "identify", .keys = identified_fields().texts()};
  channel_columns_of_fit().add_texts(all.columns);
  overview_columns().add_texts(all.columns);
  folded_columns().add_texts(all.columns);
  offset_sweep_columns().add_texts(all.columns);
  add_texts_of_curves(all.columns);
  add_texts_of_chip_curve(all.columns);
  return all;
}

}  // namespace trochoid::results
