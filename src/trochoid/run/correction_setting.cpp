#include <trochoid/run/correction_setting.h>

#include <trochoid/base/units.h>
#include <trochoid/run/shared/machine.h>
#include <trochoid/run/shared/records.h>

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace trochoid::run {

namespace {

/// Part of the variance that a model must explain to be believed.
constexpr double explains_enough = 0.9;
constexpr int slices_of_helix = 20;

correction::MovingCut moving_cut(const inputs::Case& given) {
  correction::MovingCut cut{.setup = given.setup, .law = given.law};
  for (const dynamics::ChipMode& mode : chip_modes(given.machine.modes).modes) {
    if (mode.x > 0 || mode.y > 0) {
      cut.tool.push_back(mode);
    }
  }
  cut.plant = plant_of(given.machine);
  cut.slices = given.setup.cutter.helix > 0 ? slices_of_helix : 1;
  cut.revolutions = static_cast<int>(given.sampling.revolutions);
  cut.samples_per_rev = given.sampling.samples_per_rev;
  return cut;
}

void set_runout(force::Setup& setup, const std::vector<double>& rho) {
  setup.runout = {};
  setup.runout.radial_offsets = rho;
}

/// The largest |F_y| while each tooth is the one nearest to the middle of its arc.
std::vector<double> peaks_of(const correction::ForceRecord& record,
                             const correction::RigidCut& cut, double offset) {
  const double middle = (cut.arc().from + cut.arc().to) / 2;
  std::vector<double> peaks(cut.psi().size(), 0.0);
  for (std::size_t i = 0; i < record.angle.size(); ++i) {
    std::size_t nearest = 0;
    double least = unit::turn;
    for (std::size_t j = 0; j < peaks.size(); ++j) {
      const double off = std::abs(
          std::remainder(record.angle[i] + offset - cut.psi()[j] - middle, unit::turn));
      if (off < least) {
        least = off;
        nearest = j;
      }
    }
    peaks[nearest] = std::max(peaks[nearest], std::abs(record.force[i][1]));
  }
  return peaks;
}

std::optional<correction::ForceRecord> record_of(const inputs::Case& given,
                                                 std::vector<base::Warning>& warnings,
                                                 std::string& message) {
  const auto runs = measured_runs(given, warnings);
  const auto M = given.dynamometer.value_or(inputs::Dynamometer{}).matrix;
  const identification::Run run = identification::on_tool(channels_of(runs), M).front();
  correction::ForceRecord record;
  const double first = run.angle.front();
  const double span = std::abs(run.angle.back() - first);
  const double spacing = span / static_cast<double>(run.angle.size() - 1);
  const double whole = std::floor((span + spacing) / unit::turn + 1e-6) * unit::turn;
  if (whole < unit::turn) {
    message = fmt::format(
        "the record is {:.0f} deg long; a correction needs a whole "
        "turn of the spindle at least",
        span / unit::deg);
    return std::nullopt;
  }
  for (std::size_t i = 0; i < run.angle.size(); ++i) {
    if (std::abs(run.angle[i] - first) < whole - 1e-9) {
      record.angle.push_back(run.angle[i]);
      record.force.push_back(run.force[i]);
    }
  }
  return record;
}

bool find_in_record(const inputs::Case& given, CorrectionSetting& s,
                    std::vector<base::Warning>& warnings, std::string& message) {
  s.cut.setup.cut = given.measurements.front().cut;
  const auto record = record_of(given, warnings, message);
  if (!record) {
    return false;
  }
  const correction::StaticFitOptions options{.slices = s.cut.slices};
  s.fit = correction::static_fit(s.cut.setup, *record, options);
  if (!s.fit->ok) {
    message = "runout was not found in the record: " + s.fit->reason;
    return false;
  }
  if (s.fit->explained < explains_enough) {
    warnings.push_back(
        {"poor_fit",
         fmt::format("The model explains {:.0f} % of the measured forces: look at "
                     "identify before using this command.",
                     100 * s.fit->explained)});
  }
  s.angle_offset = s.fit->offset.value;
  const correction::RigidCut rigid(s.cut.setup, s.fit->law, s.cut.slices);
  s.ratio = correction::ratio_estimate(peaks_of(*record, rigid, s.angle_offset),
                                       rigid.nominal_chip(), s.fit->m_t.value);
  s.behind = correction::true_runout(s.cut, *s.fit, options);
  if (s.behind->ok) {
    s.rho = s.behind->rho;
    s.cut.law = s.behind->law;
  } else {
    warnings.push_back(
        {"compliance_not_removed",
         "What tool and table give way was not taken out of the estimate: " +
             s.behind->reason});
    s.cut.law = s.fit->law;
    for (const correction::Value& value : s.fit->rho) {
      s.rho.push_back(value.value);
    }
  }
  set_runout(s.cut.setup, s.rho);
  return true;
}

}  // namespace

std::optional<CorrectionSetting> correction_setting(
    const inputs::Case& given, const Progress& progress,
    std::vector<base::Warning>& warnings, std::string& message) {
  CorrectionSetting s{.cut = moving_cut(given),
                      .limits = limits_of(*given.machine.actuator)};
  const bool as_read =
      given.machine.correct->estimate == inputs::RunoutEstimate::static_fit;
  if (progress) {
    progress("Looking for the runout");
  }
  if (!given.measurements.empty()) {
    if (!find_in_record(given, s, warnings, message)) {
      return std::nullopt;
    }
  } else {
    s.rho = correction::RigidCut(given.setup, given.law, 1).offsets();
    if (as_read || correction::power_near(given.law)) {
      s.fit = correction::static_reading(s.cut, s.rho,
                                         {.fit_offset = false, .slices = s.cut.slices});
    }
    if (as_read && !s.fit->ok) {
      message = "a static fit finds no runout in the forces: " + s.fit->reason;
      return std::nullopt;
    }
  }
  s.designed_for = s.rho;
  if (as_read) {
    s.designed_for.clear();
    for (const correction::Value& value : s.fit->rho) {
      s.designed_for.push_back(value.value);
    }
  }
  return s;
}

}  // namespace trochoid::run
