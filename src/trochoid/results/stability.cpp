#include <trochoid/numerics/median.h>
#include <trochoid/results/better_speed.h>
#include <trochoid/results/descriptions.h>
#include <trochoid/results/process_damping.h>
#include <trochoid/results/stability.h>

#include <trochoid/base/units.h>

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <complex>

namespace trochoid::results {

namespace {

using dynamics::ChatterLine;
using dynamics::Stability;

/// What the multiplier is of: the time from one tooth to the next where all are alike.
std::string_view period_name(const Stability& s) {
  return s.period < 0.999 * unit::turn ? "tooth" : "revolution";
}

std::string_view type_of(const std::complex<double>& multiplier) {
  return name_of(dynamics::bifurcation_of(multiplier));
}

Array frequencies(const std::vector<ChatterLine>& lines) {
  Array list;
  for (const ChatterLine& line : lines) {
    list.emplace_back(line.frequency);
  }
  return list;
}

Array shares(const std::vector<ChatterLine>& lines) {
  Array list;
  for (const ChatterLine& line : lines) {
    list.emplace_back(line.share);
  }
  return list;
}

bool has_modes(const StabilityResult& r) {
  return r.no_modes.empty();
}

const Fields<BetterSpeed>& better_speed_fields() {
  static const Fields<BetterSpeed> all{
      {"spindle_rpm",
       "the speed of the diagram that allows the deepest cut, within 30 % of the speed "
       "of the case",
       [](const BetterSpeed& better) { return given(better.Omega); }},
      {"limit_depth_mm",
       "depth that it allows within 2 % of that speed, a range inside the diagram",
       &BetterSpeed::depth}};
  return all;
}

/// What damps, and the limit without it.
const Fields<StabilityResult>& damping_fields() {
  using R = const StabilityResult&;
  static const Fields<StabilityResult> all{
      {"", "", process_damping_fields(),
       [](R r) { return &r.problem.setup.process_damping; }},
      {"limit_depth_without_mm",
       "the limit depth with sharp edges, `null` where there is none",
       [](R r) {
         const auto& sharp = r.stability.sharp_limit;
         return sharp ? Value(sharp->depth) : Value();
       },
       has_modes}};
  return all;
}

const Fields<StabilityResult>& multiplier_fields() {
  using R = const StabilityResult&;
  static const Fields<StabilityResult> all{
      {"absolute", "of the Floquet multiplier",
       [](R r) { return std::abs(r.stability.multiplier.value); }},
      {"argument_deg", "of the same",
       [](R r) { return std::arg(r.stability.multiplier.value); }},
      {"type", "`hopf`, `period_doubling` or `period_one`",
       [](R r) { return type_of(r.stability.multiplier.value); }},
      {"chatter_frequencies_Hz",
       "of the vibration that fades or grows (D-12), strongest first",
       [](R r) { return frequencies(r.stability.lines); }},
      {"chatter_shares", "their amplitudes relative to the first",
       [](R r) { return shares(r.stability.lines); }},
      {"period",
       "that it belongs to: `tooth` where all teeth are alike, else "
       "`revolution`",
       [](R r) { return period_name(r.stability); }},
      {"period_s", "the same",
       [](R r) { return r.stability.period / r.problem.setup.cut.Omega; }},
      {"error", "estimated", [](R r) { return r.stability.multiplier.error; }}};
  return all;
}

const Fields<dynamics::ChipMode>& chip_mode_fields() {
  using Of = const dynamics::ChipMode&;
  const auto omega = [](Of mode) { return std::sqrt(mode.stiffness / mode.mass); };
  static const Fields<dynamics::ChipMode> all{
      {"direction", "along x and y, as the chip feels it",
       [](Of mode) {
         return Array{mode.x, mode.y};
       }},
      {"turned_deg", "by which the residue of a complex mode is turned (M-30)",
       [omega](Of m) {
         const double zeta = 0.5 * m.damping / (m.mass * omega(m));
         return std::atan2(m.lead * omega(m) * std::sqrt(1 - zeta * zeta),
                           m.in_phase - zeta * omega(m) * m.lead);
       },
       [](Of m) { return m.lead != 0; }},
      {"frequency_Hz", "natural frequency",
       [omega](Of mode) { return omega(mode) / unit::turn; }},
      {"damping_ratio", "of critical damping",
       [omega](Of mode) { return 0.5 * mode.damping / (mode.mass * omega(mode)); }},
      {"mass_kg", "modal mass", [](Of mode) { return mode.mass; }},
      {"stiffness_N_per_m", "modal stiffness", [](Of mode) { return mode.stiffness; }},
      {"damping_Ns_per_m", "modal damping", [](Of mode) { return mode.damping; }}};
  return all;
}

/// By how much a limit differs from that of the multiplier, in percent of it.
Value difference(const std::optional<dynamics::FrequencyLimit>& limit,
                 const StabilityResult& r) {
  if (!limit || !r.no_modes.empty() || !r.stability.limit) {
    return {};
  }
  return 100 * (limit->depth / r.stability.limit->limit.depth - 1);
}

/// The median of that over the speeds of the diagram, without sign.
Value median_difference(const std::vector<dynamics::FrequencyLimit>& curve,
                        const StabilityResult& r) {
  std::vector<double> sizes;
  for (const dynamics::FrequencyLimit& one : curve) {
    for (const dynamics::LimitPoint& other : r.stability.limit_curve) {
      if (other.limit.Omega == one.Omega) {
        sizes.push_back(100 * std::abs(one.depth / other.limit.depth - 1));
      }
    }
  }
  if (sizes.empty()) {
    return {};
  }
  return numerics::median(std::move(sizes));
}

/// A limit by the measured response, beside what else was found.
struct LimitByFrequency {
  const ByFrequency& found;
  const StabilityResult& r;
  bool several;  ///< harmonics of the force
};

const Fields<LimitByFrequency>& by_frequency_fields() {
  using Of = const LimitByFrequency&;
  static const Fields<LimitByFrequency> all{
      {"limit_depth_mm", "limit depth, `null` where there is none",
       [](Of l) { return l.found.limit ? Value(l.found.limit->depth) : Value(); }},
      {"chatter_frequency_Hz", "there",
       [](Of l) {
         return l.found.limit ? Value(l.found.limit->chatter_frequency) : Value();
       }},
      {"difference_percent", "from the limit of the multiplier",
       [](Of l) { return difference(l.found.limit, l.r); }},
      {"median_difference_percent",
       "median size of the same over the speeds of the diagram",
       [](Of l) { return median_difference(l.found.curve, l.r); }},
      {"harmonics", "of the force, in `multi_frequency`",
       [](Of l) { return l.r.measured->harmonics; }, [](Of l) { return l.several; }}};
  return all;
}

const Fields<StabilityResult>& measured_fields() {
  using R = const StabilityResult&;
  static const Fields<StabilityResult> all{
      {"band_Hz", "of the measured response",
       [](R r) {
         const auto& band = r.measured->band;
         return as_named(
             Array{unit::in(band.from, unit::Hz), unit::in(band.to, unit::Hz)});
       }},
      {"zeroth_order", "with the mean force (D-22)", by_frequency_fields(),
       [](R r) {
         return LimitByFrequency{r.measured->zeroth_order, r, false};
       }},
      {"multi_frequency", "with harmonics of it (D-22)", by_frequency_fields(),
       [](R r) {
         return LimitByFrequency{r.measured->multi_frequency, r, true};
       }},
      {"multiplier_limit_depth_mm",
       "limit depth by the Floquet multiplier of the modes, `null` where there is none",
       [](R r) {
         const auto& modes = r.stability.limit;
         return has_modes(r) && modes ? Value(modes->limit.depth) : Value();
       }},
      {"modes_fitted",
       "the modes of the multiplier are fitted to the response, and `modes.toml` has them",
       [](R r) { return r.measured->modes_fitted; }}};
  return all;
}

const Fields<StabilityResult>& stability_fields() {
  using R = const StabilityResult&;
  static const Fields<StabilityResult> floor{
      {"chip_floor_um", "of the power law",
       [](R r) { return given(r.problem.options.chip_floor); }},
      {"multiplier_at_half", "at half the floor",
       [](R r) { return r.stability.floor->at_half; }},
      {"multiplier_at_twice", "at twice the floor",
       [](R r) { return r.stability.floor->at_twice; }}};
  static const Fields<StabilityResult> limit{
      {"type", "as of the multiplier",
       [](R r) { return type_of(r.stability.limit->limit.multiplier); }},
      {"argument_deg", "as of the multiplier",
       [](R r) { return std::arg(r.stability.limit->limit.multiplier); }},
      {"chatter_frequencies_Hz", "strongest first",
       [](R r) { return frequencies(r.stability.limit->lines); }}};
  // With modes the measured response comes last; without, it is what there is.
  static const Fields<StabilityResult> damping{
      {"process_damping", "where a flank is worn", damping_fields(),
       [](R r) { return &r; },
       [](R r) { return r.problem.setup.process_damping.acts(); }}};
  static const Fields<StabilityResult> measured{
      {"measured_frf",
       "with `[[measured_frf]]`. Where no modes could be fitted, `multiplier` and `modes` "
       "are `null`",
       measured_fields(), [](R r) { return &r; },
       [](R r) { return r.measured.has_value(); }}};
  static const Fields<StabilityResult> all{
      {"multiplier", "Floquet multiplier of the case", multiplier_fields(),
       [](R r) { return has_modes(r) ? &r : nullptr; }},
      {"stable", "whether `absolute` is below 1, or as `judged_by` has it",
       [](R r) {
         return r.by_modes() ? std::abs(r.stability.multiplier.value) < 1
                             : judged_verdict(r) == dynamics::StabilityVerdict::stable;
       }},
      {"chip_floor",
       "in a power law: the Floquet multiplier at half and twice the floor", floor,
       [](R r) { return &r; }, [](R r) { return has_modes(r) && r.stability.floor; }},
      {"verdict",
       "`stable`, `unstable` or `marginal`: within `margin` of 1, or, in a power law, with "
       "another answer at half or twice `chip_floor_um`",
       [](R r) { return name_of(judged_verdict(r)); }},
      {"judged_by",
       "with `[[measured_frf]]`, what verdict, limit depth, better speed and limit.csv come "
       "from: `modes`, `complex_modes`, or the measured `response` itself, which modes do "
       "not describe (`multi_frequency`)",
       [](R r) { return name_of(r.judged_by); },
       [](R r) { return r.measured.has_value(); }},
      {"limit_depth_mm",
       "limit depth: least unstable axial depth at the speed of the case (D-13); `null` if "
       "there is none up to `greatest_depth_mm`",
       [](R r) {
         const auto depth = judged_limit(r);
         return depth ? Value(*depth) : Value();
       }},
      {"limit", "how stability is lost there", limit, [](R r) { return &r; },
       [](R r) { return has_modes(r) && r.stability.limit; }},
      {"better_speed",
       "`null` where what it allows is not 1.2 times the limit within 2 % of the speed of "
       "the case; no such key where the time was up before",
       better_speed_fields(), better_speed,
       [](R r) {
         return r.stability.whole && (has_modes(r) || !judged_curve(r).empty());
       }},
      {"greatest_depth_mm", "up to which was looked",
       [](R r) { return given(judged_to(r)); }},
      {"spindle_rpm", "of the case",
       [](R r) { return given(r.problem.setup.cut.Omega); }},
      {"axial_depth_mm", "of the case",
       [](R r) { return given(r.problem.setup.cut.a_p); }},
      {"modes", "as the chip feels them", chip_mode_fields(),
       [](R r) -> const auto& {return r.problem.system.modes;
}
, has_modes
}  // namespace
, {"modes", "", [](R) { return nullptr; }, [](R r) { return !has_modes(r); }},
    {"", "", measured, [](R r) { return &r; }, [](R r) { return !has_modes(r); }},
    {"", "", damping, [](R r) { return &r; }}, {
  "", "", measured, [](R r) { return &r; }, has_modes
}
};  // namespace trochoid::results
return all;
}

std::string limit_text(const ByFrequency& found) {
  return found.limit
             ? fmt::format("{:.5g} mm ({:.1f} Hz)", found.limit->depth / unit::mm,
                           found.limit->chatter_frequency)
             : "none";
}

std::string measured_table(const StabilityResult& r) {
  const MeasuredStability& m = *r.measured;
  return fmt::format(
      "limit by the measured response: {} with the mean force (zeroth order), {} with "
      "{} harmonics (multi-frequency)\n{}",
      limit_text(m.zeroth_order), limit_text(m.multi_frequency), m.harmonics,
      m.modes_fitted ? fmt::format("the multiplier is from {} {}mode{} fitted to it\n",
                                   r.problem.system.modes.size(),
                                   m.complex_modes ? "complex " : "",
                                   r.problem.system.modes.size() == 1 ? "" : "s")
                     : "");
}

/// Verdict, limit and better speed by the measured response.
std::string judged_table(const StabilityResult& r) {
  const geometry::Cut& cut = r.problem.setup.cut;
  const double speed = unit::in(cut.Omega, unit::rpm);
  const auto limit = judged_limit(r);
  std::string text =
      fmt::format("{}, by the measured response: ", name_of(judged_verdict(r)));
  text +=
      limit ? fmt::format(
                  "at {:g} rpm unstable from {:.5g} mm axial depth on; here {:g} mm\n",
                  speed, *limit / unit::mm, unit::in(cut.a_p, unit::mm))
            : fmt::format("at {:g} rpm no axial depth up to {:g} mm is unstable\n",
                          speed, unit::in(judged_to(r), unit::mm));
  if (const auto better = better_speed(r)) {
    text += fmt::format("near it, {:.5g} rpm allows {:.3g} mm\n",
                        better->Omega / unit::rpm, better->depth / unit::mm);
  }
  return text;
}

std::string multiplier_table(const StabilityResult& r) {
  const Stability& s = r.stability;
  const geometry::Cut& cut = r.problem.setup.cut;
  const double growth = std::abs(s.multiplier.value);
  const std::string_view verdict =
      r.by_modes() ? name_of(s.verdict) : "by the modes fitted";
  std::string text =
      fmt::format("{}: a small vibration {} to {:.6f} of itself in each {} ({})\n",
                  verdict, growth < 1 ? "fades" : "grows", growth, period_name(s),
                  type_of(s.multiplier.value));
  text += "frequencies [Hz], strongest first:";
  for (const ChatterLine& line : s.lines) {
    text += fmt::format(" {:.2f}", line.frequency);
  }
  text += '\n';
  if (!r.by_modes()) return text + judged_table(r);
  const double speed = unit::in(cut.Omega, unit::rpm);
  if (!s.limit) {
    return text + fmt::format("at {:g} rpm no axial depth up to {:g} mm is unstable\n",
                              speed, unit::in(s.greatest_depth, unit::mm));
  }
  const bool above = growth < 1 && cut.a_p > s.limit->limit.depth;
  text += fmt::format(
      "at {:g} rpm unstable from {:.5g} mm axial depth on; here {:g} mm{}\n", speed,
      s.limit->limit.depth / unit::mm, unit::in(cut.a_p, unit::mm),
      above ? ", where it is stable again" : "");
  if (const auto better = better_speed(r)) {
    text += fmt::format("near it, {:.5g} rpm allows {:.3g} mm\n",
                        better->Omega / unit::rpm, better->depth / unit::mm);
  }
  return text;
}

std::string damping_table(const StabilityResult& r) {
  const force::ProcessDamping& damping = r.problem.setup.process_damping;
  if (!damping.acts()) {
    return {};
  }
  const std::string with = "with " + process_damping_text(damping);
  if (!r.no_modes.empty()) {
    return with + '\n';
  }
  const auto& sharp = r.stability.sharp_limit;
  return with + (sharp ? fmt::format("; without it unstable from {:.5g} mm on\n",
                                     sharp->depth / unit::mm)
                       : "; without it stable as deep\n");
}

std::string short_table(const StabilityResult& r) {
  return (r.no_modes.empty() ? multiplier_table(r) : judged_table(r)) +
         damping_table(r) + (r.measured ? measured_table(r) : std::string());
}

/// The limit depth over the speed, by the measured response.
Columns<std::vector<dynamics::FrequencyLimit>> frequency_columns(
    std::string_view file) {
  using Of = const std::vector<dynamics::FrequencyLimit>&;
  return {file,
          [](Of curve) { return curve.size(); },
          {{"spindle_rpm", "each speed that has a limit",
            [](Of curve, std::size_t i) { return given(curve[i].Omega); }},
           {"limit_depth_mm", "by the measured response alone",
            [](Of curve, std::size_t i) { return given(curve[i].depth); }},
           {"chatter_frequency_Hz", "there",
            [](Of curve, std::size_t i) { return curve[i].chatter_frequency; }}}};
}

/// |mu| over speed and depth.
const Columns<dynamics::LobeGrid>& lobe_columns() {
  using Of = const dynamics::LobeGrid&;
  static const Columns<dynamics::LobeGrid> all{
      "lobes.csv",
      [](Of grid) { return grid.multiplier.size(); },
      {{"spindle_rpm", "of the stability lobe diagram",
        [](Of grid, std::size_t i) {
          return given(grid.Omega[i / grid.depth.size()]);
        }},
       {"axial_depth_mm", "at every speed",
        [](Of grid, std::size_t i) {
          return given(grid.depth[i % grid.depth.size()]);
        }},
       {"multiplier",
        "\\|mu\\|, the Floquet multiplier, good to 1e-5 at the greatest depth",
        [](Of grid, std::size_t i) { return std::abs(grid.multiplier[i]); }}}};
  return all;
}

/// The limit depth over the speed, and the strongest frequency of the vibration that
/// appears there.
const Columns<std::vector<dynamics::LimitPoint>>& limit_columns() {
  using Of = const std::vector<dynamics::LimitPoint>&;
  static const Columns<std::vector<dynamics::LimitPoint>> all{
      "limit.csv",
      [](Of curve) { return curve.size(); },
      {{"spindle_rpm",
        "each speed that has a limit; further speeds where the limit bends",
        [](Of curve, std::size_t i) { return given(curve[i].limit.Omega); }},
       {"limit_depth_mm", "the least unstable depth",
        [](Of curve, std::size_t i) { return given(curve[i].limit.depth); }},
       {"argument_deg", "of mu there",
        [](Of curve, std::size_t i) { return std::arg(curve[i].limit.multiplier); }},
       {"chatter_frequency_Hz", "the strongest there",
        [](Of curve, std::size_t i) { return curve[i].chatter_frequency; }}}};
  return all;
}

constexpr std::string_view zeroth_order_file = "zeroth_order.csv";
constexpr std::string_view multi_frequency_file = "multi_frequency.csv";

/// The modes of the multiplier, for other commands: of all directions together.
std::string modes_toml(const dynamics::System& system) {
  std::string text =
      "# Fitted by trochoid stability to the measured responses of the tool point. Use "
      "it in\n# another case with\n#   include = \"<this file>\"\n";
  for (const dynamics::ChipMode& m : system.modes) {
    const double omega = std::sqrt(m.stiffness / m.mass);
    const bool along_x = std::abs(m.x) >= std::abs(m.y);
    const double tangent = along_x ? m.y / m.x : -m.x / m.y;
    text += fmt::format(
        "\n[[mode]]  # {:.6g} Hz, damping ratio {:.4g}\n"
        "body = \"{}\"\naxis = \"{}\"\nangle_deg = {:.6g}\n"
        "mass_kg = {}\nstiffness_N_per_m = {}\ndamping_Ns_per_m = {}\n",
        omega / unit::turn, 0.5 * m.damping / (m.mass * omega),
        m.of_table ? "table" : "tool", along_x ? "x" : "y",
        std::atan(tangent) / unit::deg + 0.0, m.mass, m.stiffness, m.damping);
  }
  return text;
}

}  // namespace

std::optional<double> judged_limit(const StabilityResult& r) {
  if (!r.by_modes()) {
    const auto& limit = r.measured->multi_frequency.limit;
    return limit ? std::optional(limit->depth) : std::nullopt;
  }
  const auto& limit = r.stability.limit;
  return limit ? std::optional(limit->limit.depth) : std::nullopt;
}

dynamics::StabilityVerdict judged_verdict(const StabilityResult& r) {
  if (r.by_modes()) return r.stability.verdict;
  const auto limit = judged_limit(r);
  return limit && *limit < r.problem.setup.cut.a_p
             ? dynamics::StabilityVerdict::unstable
             : dynamics::StabilityVerdict::stable;
}

std::vector<dynamics::LimitPoint> judged_curve(const StabilityResult& r) {
  if (r.by_modes()) return r.stability.limit_curve;
  const geometry::Cutter& cutter = r.problem.setup.cutter;
  const double period =  // of the cut, if the modes did not tell
      r.stability.period > 0 ? r.stability.period
                             : unit::turn / static_cast<double>(cutter.pitch.size());
  std::vector<dynamics::LimitPoint> curve;
  for (const dynamics::FrequencyLimit& one : r.measured->multi_frequency.curve) {
    const double angle =
        unit::turn * one.chatter_frequency * period / one.Omega;  // D-12
    curve.push_back({.limit = {.Omega = one.Omega,
                               .depth = one.depth,
                               .multiplier = std::polar(
                                   1.0, std::abs(std::remainder(angle, unit::turn)))},
                     .chatter_frequency = one.chatter_frequency});
  }
  return curve;
}

double judged_to(const StabilityResult& r) {
  return r.by_modes() ? r.stability.greatest_depth : r.measured->greatest_depth;
}

Answer answer_of(const StabilityResult& r) {
  Answer answer{.command = "stability",
                .heading = r.heading,
                .result = stability_fields().object(r),
                .short_table = short_table(r)};
  if (r.no_modes.empty()) {
    answer.tables = {lobe_columns().table(r.stability.lobes)};
  }
  if (r.no_modes.empty() || !judged_curve(r).empty()) {
    answer.tables.push_back(limit_columns().table(judged_curve(r)));
  }
  if (r.measured) {
    answer.tables.push_back(
        frequency_columns(zeroth_order_file).table(r.measured->zeroth_order.curve));
    answer.tables.push_back(frequency_columns(multi_frequency_file)
                                .table(r.measured->multi_frequency.curve));
    if (r.measured->modes_fitted) {
      answer.texts.push_back({"modes.toml", modes_toml(r.measured->real_modes)});
    }
  }
  return answer;
}

Description description_of_stability() {
  Description all{.command = "stability", .keys = stability_fields().texts()};
  lobe_columns().add_texts(all.columns);
  limit_columns().add_texts(all.columns);
  frequency_columns(zeroth_order_file).add_texts(all.columns);
  frequency_columns(multi_frequency_file).add_texts(all.columns);
  return all;
}

}  // namespace trochoid::results
