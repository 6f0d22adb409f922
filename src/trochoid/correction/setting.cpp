#include <trochoid/correction/setting.h>

#include <trochoid/base/units.h>

#include <fmt/core.h>

#include <cmath>

namespace trochoid::correction {

namespace {

/// A sample at the end of a turn belongs to the next one [turns, rad].
constexpr double turn_slack = 1e-6;
constexpr double angle_slack = 1e-9;

std::vector<double> values_of(const std::vector<Value>& estimates) {
  std::vector<double> values;
  values.reserve(estimates.size());
  for (const Value& estimate : estimates) {
    values.push_back(estimate.value);
  }
  return values;
}

void set_runout(force::Setup& setup, const std::vector<double>& rho) {
  setup.runout = {};
  setup.runout.radial_offsets = rho;
}

double span_of(const ForceRecord& record) {
  return record.angle.empty() ? 0.0
                              : std::abs(record.angle.back() - record.angle.front());
}

/// The turns that a record holds from its beginning; none where it holds no whole one.
ForceRecord whole_turns(const ForceRecord& record) {
  ForceRecord whole;
  const double span = span_of(record);
  const double spacing = span / static_cast<double>(record.angle.size() - 1);
  const double length =
      std::floor((span + spacing) / unit::turn + turn_slack) * unit::turn;
  for (std::size_t i = 0; length >= unit::turn && i < record.angle.size(); ++i) {
    if (std::abs(record.angle[i] - record.angle.front()) < length - angle_slack) {
      whole.angle.push_back(record.angle[i]);
      whole.force.push_back(record.force[i]);
    }
  }
  return whole;
}

/// Runout and law behind what was read, or else the reading itself.
void take_compliance_out(const StaticFitOptions& options, Setting& s) {
  s.behind = true_runout(s.cut, *s.fit, options);
  if (s.behind->ok) {
    s.rho = s.behind->rho;
    s.cut.law = s.behind->law;
  } else {
    s.rho = values_of(s.fit->rho);
    s.cut.law = s.fit->law;
  }
  set_runout(s.cut.setup, s.rho);
}

Setting designed(Setting s, RunoutEstimate estimate) {
  s.ok = true;
  s.designed_for =
      estimate == RunoutEstimate::static_fit ? values_of(s.fit->rho) : s.rho;
  return s;
}

}  // namespace

Setting known_setting(const MovingCut& cut, const ActuatorLimits& limits,
                      RunoutEstimate estimate) {
  Setting s{.cut = cut, .limits = limits};
  s.rho = RigidCut(cut.setup, cut.law, 1).offsets();
  const bool as_read = estimate == RunoutEstimate::static_fit;
  if (as_read || power_near(cut.law)) {
    s.fit = static_reading(s.cut, s.rho, {.fit_offset = false, .slices = s.cut.slices});
  }
  if (as_read && !s.fit->ok) {
    s.reason = "a static fit finds no runout in the forces: " + s.fit->reason;
    return s;
  }
  return designed(std::move(s), estimate);
}

Setting measured_setting(const MovingCut& cut, const ActuatorLimits& limits,
                         const ForceRecord& record, RunoutEstimate estimate) {
  Setting s{.cut = cut, .limits = limits};
  const ForceRecord turns = whole_turns(record);
  if (turns.angle.empty()) {
    s.reason = fmt::format(
        "the record is {:.0f} deg long; a correction needs a whole "
        "turn of the spindle at least",
        span_of(record) / unit::deg);
    return s;
  }
  const StaticFitOptions options{.slices = s.cut.slices};
  s.fit = static_fit(s.cut.setup, turns, options);
  if (!s.fit->ok) {
    s.reason = "runout was not found in the record: " + s.fit->reason;
    return s;
  }
  s.angle_offset = s.fit->offset.value;
  const RigidCut rigid(s.cut.setup, s.fit->law, s.cut.slices);
  s.ratio =
      ratio_estimate(peaks_of_turns(rigid, turns.angle, turns.force, s.angle_offset),
                     rigid.nominal_chip(), s.fit->m_t.value);
  take_compliance_out(options, s);
  return designed(std::move(s), estimate);
}

RigidCut designed_cut(const Setting& setting) {
  force::Setup setup = setting.cut.setup;
  set_runout(setup, setting.designed_for);
  return RigidCut(setup, setting.cut.law, setting.cut.slices);
}

}  // namespace trochoid::correction
