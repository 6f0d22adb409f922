#include <trochoid/results/modes.h>

#include <trochoid/base/units.h>
#include <trochoid/results/descriptions.h>
#include <trochoid/results/joint.h>
#include <trochoid/results/modes_parts.h>

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <complex>
#include <limits>
#include <utility>

namespace trochoid::results {

namespace {

using structure::FittedMode;
using structure::FittedResponse;
using structure::Known;
using structure::ModesFit;

constexpr std::array axis_names = {"x", "y"};

/// A mode, and whether its shape is told as a complex one.
struct ModeOf {
  const FittedMode& mode;
  bool complex_shapes = false;
};

std::vector<ModeOf> modes_of(const std::vector<FittedMode>& modes,
                             bool complex_shapes) {
  std::vector<ModeOf> out;
  for (const FittedMode& mode : modes) {
    out.push_back({mode, complex_shapes});
  }
  return out;
}

/// The numbers of a mode, or their standard errors under the same keys.
Fields<ModeOf> numbers_of_mode(double Known::*part) {
  const bool errors = part == &Known::se;
  const auto meaning = [=](const char* what) {
    return errors ? "of the same key" : what;
  };
  const auto of = [=](Known FittedMode::*known) {
    return [=](const ModeOf& m) { return (m.mode.*known).*part; };
  };
  return {
      {"frequency_Hz", meaning("natural frequency"),
       [=](const ModeOf& m) { return m.mode.omega.*part / unit::Hz; }},
      {"damping_ratio", meaning("of critical damping"), of(&FittedMode::zeta)},
      {"mass_kg",
       meaning("modal mass; of several responses: of motion along the shape"),
       of(&FittedMode::mass)},
      {"stiffness_N_per_m", meaning("modal stiffness, likewise"),
       of(&FittedMode::stiffness)},
      {"damping_Ns_per_m", meaning("modal damping, likewise"),
       of(&FittedMode::damping)},
      {"angle_deg",
       meaning(
           "angle of the shape from +x towards +y, where both directions were measured"),
       of(&FittedMode::angle), [](const ModeOf& m) { return m.mode.phi.size() > 1; }},
      {"imaginary_fraction",
       meaning("share of the imaginary part in a complex shape (M-33)"),
       of(&FittedMode::imaginary), [](const ModeOf& m) { return m.complex_shapes; }}};
}

/// A component of the shape of a mode.
struct Component {
  ModeOf of;
  std::size_t axis = 0;
};

std::vector<Component> components(const ModeOf& of) {
  std::vector<Component> out;
  for (std::size_t k = 0; k < of.mode.phi.size(); ++k) {
    out.push_back({of, k});
  }
  return out;
}

const Fields<Component>& component_fields() {
  using C = const Component&;
  const auto complex = [](C c) { return c.of.complex_shapes; };
  static const Fields<Component> all{
      {"axis", "of the component", [](C c) { return axis_names[c.axis]; }},
      {"re_per_sqrt_kg", "its real part, scaled to a modal mass of 1",
       [](C c) { return c.of.mode.phi[c.axis].real(); }},
      {"re_se", "standard error of it",
       [](C c) { return c.of.mode.phi_se[c.axis].real(); }},
      {"im_per_sqrt_kg", "its imaginary part, where shapes are complex",
       [](C c) { return c.of.mode.phi[c.axis].imag(); }, complex},
      {"im_se", "standard error of it",
       [](C c) { return c.of.mode.phi_se[c.axis].imag(); }, complex}};
  return all;
}

const Fields<ModeOf>& mode_fields() {
  using M = const ModeOf&;
  static const Fields<ModeOf> values = numbers_of_mode(&Known::value);
  static const Fields<ModeOf> errors = numbers_of_mode(&Known::se);
  static const Fields<ModeOf> all{
      {"", "", values, [](M m) { return &m; }},
      {"se", "standard errors", errors, [](M m) { return &m; }},
      {"shape",
       "of several responses: the component along each axis, the largest one with a real "
       "part above 0",
       component_fields(), components, [](M m) { return !m.mode.phi.empty(); }},
      {"lines_in_peak", "lines between its half-power points, where they are fewest",
       [](M m) { return m.mode.lines_in_peak; }}};
  return all;
}

/// What modes.toml holds, with its covariance.
Joint joint_of(const ModesResult& r) {
  Joint joint;
  std::vector<double> units;
  for (const FittedMode& m : r.fit.real_modes) {
    const NearAxis at = near_axis(r, m);
    joint.modes.push_back({std::string(name_of(r.body)), std::string(at.axis)});
    const auto add = [&](const char* what, double value, double unit) {
      add_found(joint, fmt::format("mode[{}].{}", joint.modes.size(), what), value);
      units.push_back(unit);
    };
    add("frequency_Hz", m.omega.value / unit::Hz, unit::Hz);
    add("damping_ratio", m.zeta.value, 1.0);
    add("mass_kg", m.mass.value, 1.0);
    if (m.phi.size() > 1) {
      add("angle_deg", at.angle, unit::deg);
    }
  }
  set_covariance(joint, r.fit.covariance, units);
  return joint;
}

/// A resonance that the fit holds and that is no answer.
struct Unresolved {
  std::optional<double> omega;  ///< of one response [rad/s]
  const std::string& why;
};

std::vector<Unresolved> unresolved_of(const ModesResult& r) {
  std::vector<Unresolved> out;
  for (std::size_t i = 0; i < r.fit.left_out.size(); ++i) {
    out.push_back(
        {r.shared ? std::nullopt : std::optional(r.fit.unresolved[i].omega.value),
         r.fit.left_out[i]});
  }
  return out;
}

const Fields<Unresolved>& unresolved_fields() {
  using U = const Unresolved&;
  static const Fields<Unresolved> all{
      {"frequency_Hz", "of one response: where it is",
       [](U u) { return hertz(*u.omega); }, [](U u) { return u.omega.has_value(); }},
      {"why", "why it is no answer", [](U u) { return u.why; }}};
  return all;
}

/// A fit that was tried, beside the best of them.
struct TriedOrder {
  const structure::ModesOrder& order;
  double above = 0.0;  ///< of the criterion
  bool shared = false;
};

std::vector<TriedOrder> orders_of(const ModesResult& r) {
  double least = std::numeric_limits<double>::infinity();
  for (const structure::ModesOrder& order : r.fit.orders) {
    least = std::min(least, order.criterion);
  }
  std::vector<TriedOrder> out;
  for (const structure::ModesOrder& order : r.fit.orders) {
    out.push_back({order, order.criterion - least, r.shared});
  }
  return out;
}

const Fields<TriedOrder>& order_fields() {
  using O = const TriedOrder&;
  static const Fields<TriedOrder> all{
      {"modes", "how many it would answer", [](O o) { return o.order.count; }},
      {"shapes", "of several responses: `real` or `complex`",
       [](O o) { return o.order.complex_shapes ? "complex" : "real"; },
       [](O o) { return o.shared; }},
      {"residual_terms", "whether it has them",
       [](O o) { return o.order.residual_terms; }},
      {"criterion", "above the criterion of the best fit: the less, the better",
       [](O o) { return o.above; }},
      {"frequencies_Hz", "of all its terms",
       [](O o) {
         Array out;
         for (const auto& [omega, zeta] : o.order.modes) out.emplace_back(hertz(omega));
         return out;
       }},
      {"damping_ratios", "of all its terms",
       [](O o) {
         Array out;
         for (const auto& [omega, zeta] : o.order.modes) out.emplace_back(zeta);
         return out;
       }},
      {"fault", "why it cannot be the answer, or `null`", [](O o) {
         return o.order.fault.empty() ? Value(nullptr) : Value(o.order.fault);
       }}};
  return all;
}

const Fields<FittedResponse>& band_fields() {
  using R = const FittedResponse&;
  static const Fields<FittedResponse> all{
      {"lines", "that were used", [](R one) { return one.omega.size(); }},
      {"band_Hz", "the first of them and the last",
       [](R one) {
         return Array{hertz(one.omega.front()), hertz(one.omega.back())};
       },
       [](R one) { return !one.omega.empty(); }}};
  return all;
}

/// A key whose name ends with the unit of the response.
template <class Get>
Field<FittedResponse> in_its_unit(std::string_view name, std::string_view meaning,
                                  Get get) {
  return Field<FittedResponse>{
      "", "",
      [=](const FittedResponse& one) {
        return Object{
            {fmt::format("{}_{}", name, unit_suffix(one.kind)), std::invoke(get, one)}};
      }}
      .with({{fmt::format(".{}_*", name), meaning}});
}

const Fields<FittedResponse>& explained_fields() {
  static const Fields<FittedResponse> all{
      {"explained",
       "1 less the sum of squares of the residual over the sum of squares of the "
       "response",
       &FittedResponse::explained},
      in_its_unit("rms",
                  "of what the fit leaves: `rms_m_per_N`, `rms_m_per_s_N` or "
                  "`rms_m_per_s2_N`",
                  &FittedResponse::rms)};
  return all;
}

const Fields<FittedResponse>& noise_fields() {
  using R = const FittedResponse&;
  static const Fields<FittedResponse> all{
      in_its_unit("floor", "of each line: `floor_m_per_N` ...",
                  [](R one) { return one.noise.floor; }),
      {"magnitude_percent", "in proportion to the response",
       [](R one) { return 100 * one.noise.magnitude; }},
      {"phase_deg", "of its phase", [](R one) { return given(one.noise.phase); }}};
  return all;
}

const Fields<FittedResponse>& residual_fields() {
  using R = const FittedResponse&;
  static const Fields<FittedResponse> all{
      {"above_m_per_N", "U: of modes above the band",
       [](R one) { return one.residual[0]; }},
      {"below_per_kg", "L: of modes below the band",
       [](R one) { return one.residual[1]; }}};
  return all;
}

const Fields<signal::TapHit>& hit_fields() {
  using H = const signal::TapHit&;
  static const Fields<signal::TapHit> all{
      {"time_s", "where its pulse begins", &signal::TapHit::time},
      {"peak_N", "of the force", &signal::TapHit::peak},
      {"left_out", "why it is not used, or `null`",
       [](H hit) { return hit.fault.empty() ? Value(nullptr) : Value(hit.fault); }}};
  return all;
}

const FittedResponse& first_response(const ModesResult& r) {
  return r.fit.responses.front();
}

bool found(const ModesResult& r) {
  return r.fit.ok;
}

Array terms_outside(const ModesResult& r) {
  Array out;
  for (const FittedMode& term : r.fit.outside) {
    out.emplace_back(hertz(term.omega.value));
  }
  return out;
}

Field<ModesResult> modes_field(bool shared) {
  return Field<ModesResult>{
      "modes",
      shared ? ""
             : "by frequency, of all responses together; `null` with status failed",
      [](const ModesResult& r) {
        return r.fit.ok
                   ? mode_fields().value(modes_of(r.fit.modes, r.fit.complex_shapes))
                   : Value();
      }}
      .with(mode_fields().texts("[]."));
}

/// What both forms of the answer end with.
const Fields<ModesResult>& search_fields() {
  static const Fields<ModesResult> all{
      {"unresolved", "resonances in the fit and not among the modes",
       unresolved_fields(), unresolved_of},
      {"orders", "every fit that was tried", order_fields(), orders_of}};
  return all;
}

const Fields<ModesResult>& tap_fields() {
  using R = const ModesResult&;
  static const Fields<ModesResult> all{
      {"hits", "each blow, where the record has hammer blows", hit_fields(),
       [](R r) -> const auto& {return r.tap->hits;
}
}  // namespace
, {"block_s", "length of what is taken of each blow", [](R r) { return r.tap->block; }},
    {"window_end",
     "value of the exponential window at the end of a block; 1: no window",
     [](R r) { return r.tap->window_end; }},
{
  "excited_to_Hz",
      "highest frequency at which the force is within 20 dB of its maximum",
      [](R r) { return hertz(r.tap->excited); }
}
};  // namespace trochoid::results
return all;
}

/// The answer about one response.
const Fields<ModesResult>& one_fields() {
  using R = const ModesResult&;
  static const Fields<ModesResult> all{
      {"kind", "`receptance`, `mobility` or `accelerance`",
       [](R r) { return name_of(first_response(r).kind); }},
      modes_field(false),
      {"", "", band_fields(), first_response},
      {"covariance", "what `[sweep] covariance` draws from", joint_fields(),
       [](R r) { return found_or_none(joint_of(r)); }, found},
      {"", "", explained_fields(), first_response, found},
      {"residual_terms", "M-6; `null` where none are needed", residual_fields(),
       [](R r) { return r.fit.residual_terms ? &first_response(r) : nullptr; }, found},
      {"terms_outside_Hz", "terms that stand for modes outside of the band",
       terms_outside, found},
      {"noise", "as standard deviations (M-15)", noise_fields(), first_response, found},
      {"", "", search_fields(), [](R r) { return &r; }, found},
      {"", "", tap_fields(), [](R r) { return &r; },
       [](R r) { return r.tap.has_value(); }},
      {"description", "what the file says of itself",
       [](R r) { return r.responses.front().description; },
       [](R r) { return !r.responses.front().description.empty(); }}};
  return all;
}

/// One of several responses.
struct ResponseOf {
  const MeasuredResponse& response;
  const FittedResponse& one;
  const ModesFit& all;
};

std::vector<ResponseOf> responses_of(const ModesResult& r) {
  std::vector<ResponseOf> out;
  for (std::size_t q = 0; q < r.responses.size(); ++q) {
    out.push_back({r.responses[q], r.fit.responses[q], r.fit});
  }
  return out;
}

/// phi_j phi_k of a mode in a response.
struct ResidueOf {
  const structure::ShapeResidue& residue;
  bool complex_shapes = false;
};

std::vector<ResidueOf> residues_of(const ResponseOf& of) {
  std::vector<ResidueOf> out;
  for (const structure::ShapeResidue& residue : of.one.residues) {
    out.push_back({residue, of.all.complex_shapes});
  }
  return out;
}

const Fields<ResidueOf>& residue_fields() {
  using Z = const ResidueOf&;
  const auto complex = [](Z z) { return z.complex_shapes; };
  static const Fields<ResidueOf> all{
      {"re_per_kg", "its real part", [](Z z) { return z.residue.value.real(); }},
      {"re_se", "standard error of it", [](Z z) { return z.residue.se.real(); }},
      {"im_per_kg", "its imaginary part, where shapes are complex",
       [](Z z) { return z.residue.value.imag(); }, complex},
      {"im_se", "standard error of it", [](Z z) { return z.residue.se.imag(); },
       complex}};
  return all;
}

const Fields<ResponseOf>& response_fields() {
  using Q = const ResponseOf&;
  const auto fitted = [](Q q) -> const auto& {
    return q.one;
  };
  const auto ok = [](Q q) { return q.all.ok; };
  static const Fields<ResponseOf> all{
      {"name", "motion, then force: `xy`", [](Q q) { return q.response.name; }},
      {"axis", "of the motion", [](Q q) { return name_of(q.response.motion); }},
      {"force_axis", "of the force", [](Q q) { return name_of(q.response.force); }},
      {"kind", "`receptance`, `mobility` or `accelerance`",
       [](Q q) { return name_of(q.one.kind); }},
      {"", "", band_fields(), fitted},
      {"description", "what the file says of it",
       [](Q q) { return q.response.description; },
       [](Q q) { return !q.response.description.empty(); }},
      {"", "", explained_fields(), fitted, ok},
      {"noise", "as standard deviations (M-15)", noise_fields(), fitted, ok},
      {"residues", "of each mode (M-30)", residue_fields(), residues_of, ok},
      {"residual_terms", "M-30, where they are needed", residual_fields(), fitted,
       [](Q q) { return q.all.ok && q.all.residual_terms; }}};
  return all;
}

/// A pair of cross responses.
struct CrossPair {
  const structure::Reciprocity& of;
  const ModesResult& all;
};

std::vector<CrossPair> cross_pairs(const ModesResult& r) {
  std::vector<CrossPair> out;
  for (const structure::Reciprocity& pair : r.fit.reciprocity) {
    out.push_back({pair, r});
  }
  return out;
}

const Fields<CrossPair>& reciprocity_fields() {
  using P = const CrossPair&;
  static const Fields<CrossPair> all{
      {"response", "one of the two",
       [](P p) { return p.all.responses[p.of.other].name; }},
      {"over", "the other", [](P p) { return p.all.responses[p.of.one].name; }},
      {"gain", "of the first over the second; 1 where they agree",
       [](P p) { return p.of.gain.value; }},
      {"se", "standard error of it", [](P p) { return p.of.gain.se; }}};
  return all;
}

/// The answer about several responses of one structure.
const Fields<ModesResult>& shared_fields() {
  using R = const ModesResult&;
  static const Fields<ModesResult> all{
      {"shapes", "of several responses: `real` or `complex`; `null` with status failed",
       [](R r) {
         return r.fit.ok ? Value(r.fit.complex_shapes ? "complex" : "real") : Value();
       }},
      modes_field(true),
      Field<ModesResult>{
          "real_modes",
          "where shapes are complex: the real modes that fit best, as in `modes.toml`",
          [](R r) { return mode_fields().value(modes_of(r.fit.real_modes, false)); },
          [](R r) { return r.fit.ok && r.fit.complex_shapes; }}
          .with(mode_fields().texts("[].")),
      {"responses", "of several: each of them", response_fields(), responses_of},
      {"covariance", "", joint_fields(), [](R r) { return found_or_none(joint_of(r)); },
       found},
      {"reciprocity", "of several responses, where xy and yx were measured (M-34)",
       reciprocity_fields(), cross_pairs, found},
      {"complex_evidence",
       "of several: criterion of the best real shapes less criterion of the best "
       "complex ones; `null` where not both were tried",
       [](R r) {
         return r.fit.complex_evidence ? Value(*r.fit.complex_evidence) : Value();
       },
       found},
      {"terms_outside_Hz", "", terms_outside, found},
      {"", "", search_fields(), [](R r) { return &r; }, found}};
  return all;
}

}  // namespace

Answer answer_of(const ModesResult& r) {
  Answer answer{.command = "modes",
                .heading = r.heading,
                .result = (r.shared ? shared_fields() : one_fields()).object(r),
                .tables = modes_tables(r)};
  if (r.fit.ok) {
    answer.short_table = short_table(r);
    answer.texts.push_back({"modes.toml", modes_toml(r)});
  }
  return answer;
}

Description description_of_modes() {
  Description all{.command = "modes", .keys = one_fields().texts()};
  for (const KeyText& text : shared_fields().texts()) {
    add_text(all.keys, text.path, text.meaning);
  }
  add_modes_columns(all.columns);
  return all;
}

}  // namespace trochoid::results
