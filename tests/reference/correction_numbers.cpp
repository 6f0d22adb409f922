// What the library says of the cases that compare_correction.py sends, as JSON.
#include <trochoid/base/units.h>
#include <trochoid/correction/command.h>
#include <trochoid/correction/equal_flutes.h>
#include <trochoid/correction/estimator_model.h>
#include <trochoid/correction/ratio.h>
#include <trochoid/correction/rigid_cut.h>
#include <trochoid/correction/shapes.h>
#include <trochoid/correction/spindle_speed.h>
#include <trochoid/correction/transition.h>

#include <nlohmann/json.hpp>

#include <iostream>
#include <numbers>

namespace {

using Json = nlohmann::json;
using namespace trochoid;

constexpr double turn = 2 * std::numbers::pi;

force::Setup setup_of(const Json& in) {
  force::Setup setup;
  setup.cutter = {.profile = geometry::cylinder(2 * in["R"].get<double>() * unit::mm),
                  .pitch = geometry::equal_pitch(static_cast<int>(in["rho"].size())),
                  .lag_diameter = 2 * in["R"].get<double>() * unit::mm};
  const double a_e = in["ae"].get<double>() * unit::mm;
  const std::string way = in["engagement"];
  geometry::Engagement engagement = geometry::Slot{};
  if (way == "up") {
    engagement = geometry::UpMilling{a_e};
  } else if (way == "down") {
    engagement = geometry::DownMilling{a_e};
  }
  setup.cut = {engagement, in["ap"].get<double>() * unit::mm,
               in["ft"].get<double>() * unit::mm, in["Omega"]};
  for (const double rho : in["rho"].get<std::vector<double>>()) {
    setup.runout.radial_offsets.push_back(rho * unit::mm);
  }
  setup.chip = {chip::Model::radial, in["marks"].get<std::size_t>() == 1
                                         ? chip::Lookback::previous
                                         : chip::Lookback::all};
  return setup;
}

force::Power law_of(const Json& law) {
  return {.K_t1 = law["kt"].get<double>() * unit::MPa,
          .K_r1 = law["kr"].get<double>() * unit::MPa,
          .K_a1 = law["ka"].get<double>() * unit::MPa,
          .m_t = law["mt"],
          .m_r = law["mr"],
          .m_a = law["ma"]};
}

correction::PeriodicMotion motion_of(const correction::RigidCut& cut, const Json& in) {
  using correction::Shape;
  const std::string name = in["shape"];
  if (name == "none") {
    return correction::Harmonics{};
  }
  const Shape shape = name == "square" ? Shape::square
                      : name == "sine" ? Shape::sine
                                       : Shape::quintic;
  return correction::scaled(table_motion(cut, shape, {.transition = in["width"]}),
                            in["factor"]);
}

Json complex_pair(const std::complex<double>& c) {
  return {c.real() / unit::mm, c.imag() / unit::mm};
}

/// What is compared of a few cases only.
void add_more(const Json& in, const correction::RigidCut& cut,
              const correction::PeriodicMotion& X, Json& out) {
  const correction::AxisLimits axes = axis_limits(cut, 3);
  for (const double value :
       {axes.one_axis, axes.one_axis_bound, axes.two_axes, axes.two_axes_bound}) {
    out["axes"].push_back(value / unit::mm);
  }
  for (const correction::Flute& f : cut.peaks(X)) {
    out["own"].push_back(f.own_peak_y);
  }
  if (in["shape"] != "sine") {
    return;
  }
  const double Omega = in["Omega"];
  const auto with = speed_modulation(cut, X, {1e-3, 1e6}, Omega);
  const auto without = speed_modulation(cut, X, {0.0, 1e6}, Omega);
  out["part"] = with.part;
  for (std::size_t i = 0; i < with.angle.size(); i += 12) {
    out["spindle"].push_back(
        {with.angle[i], with.speed[i], with.torque_at[i] - without.torque_at[i]});
  }
}

/// Waves that make the flutes alike, and how waves and teeth change them.
void add_flutes_alike(const force::Setup& setup, const force::Law& law,
                      const correction::Plant& plant, Json& out) {
  const correction::RigidCut cut(setup, law);
  const auto alike = equal_flutes(correction::Target::peak_force, cut,
                                  correction::Shape::harmonics, {.harmonics = 3});
  for (const auto& c : std::get<correction::Harmonics>(alike.motion).c) {
    out["alike"].push_back(complex_pair(c));
  }
  const correction::Setting setting{.ok = true,
                                    .cut = {.setup = setup, .law = law, .plant = plant},
                                    .rho = setup.runout.radial_offsets};
  const auto config = estimator_for(setting, correction::Harmonics{}).value();
  for (int j = 0; j < config.teeth; ++j) {
    Json waves;
    for (int k = 0; k < 2 * config.harmonics; ++k) {
      waves.push_back(config.wave_model[j][k] * unit::mm);
    }
    out["S"].push_back(waves);
    Json teeth;
    for (int i = 0; i < config.teeth; ++i) {
      teeth.push_back(config.runout_model[j][i] * unit::mm);
    }
    out["W"].push_back(teeth);
  }
}

/// Widths and harmonics to choose among, and what is chosen at each speed.
void add_transitions(const correction::RigidCut& cut, const correction::Plant& plant,
                     const std::vector<double>& rpm, Json& out) {
  const auto candidates = transition_candidates(cut, {});
  for (const auto& one : candidates) {
    out["candidates"].push_back(
        {one.width, one.harmonics, one.peak_difference, one.area_difference});
  }
  const correction::MapSetting setting{.model = plant, .real = plant};
  for (const double n : rpm) {
    const auto& best = chosen_transition(cut, candidates, correction::Method::inverse,
                                         setting, n * unit::rpm);
    out["chosen"].push_back({best.width, best.harmonics});
  }
}

Json numbers_of(const Json& in) {
  const force::Setup setup = setup_of(in);
  const correction::RigidCut cut(setup, law_of(in["law"]));
  const correction::PeriodicMotion X = motion_of(cut, in);
  Json out;
  for (const correction::Flute& f : cut.flutes(X)) {
    out["flutes"].push_back({f.peak_y, f.chip_area / unit::mm});
  }
  for (const double phi : in["phi"].get<std::vector<double>>()) {
    out["force"].push_back(cut.force(X, phi));
    out["table"].push_back(correction::place_at(X, phi) / unit::mm);
  }
  for (const auto& c : correction::harmonics_of(X, 9).c) {
    out["harmonics"].push_back(complex_pair(c));
  }
  const Json& act = in["act"];
  const Json& table = in["table"];
  const correction::Plant plant{
      structure::from_time_constants(act["K0"], act["T1"], act["T2"]),
      {.mass = table["m"], .stiffness = table["k"], .damping = table["c"]},
      in["ks"],
      in["cs"]};
  const double Omega = setup.cut.Omega;
  const correction::CommandOptions options{.sample_time = in["Ts"], .n_max = 9};
  const auto inverse =
      command_for(X, correction::Method::inverse, plant, Omega, options);
  for (const auto& c : std::get<correction::Harmonics>(inverse.wave).c) {
    out["inverse"].push_back(complex_pair(c));
  }
  out["lead"] = command_for(X, correction::Method::lead, plant, Omega, options).lead;
  const auto in_time =
      command_for(X, correction::Method::inverse_in_time, plant, Omega);
  if (in_time.ok) {
    for (const double phi : in["phi"].get<std::vector<double>>()) {
      out["in_time"].push_back(correction::place_at(in_time.wave, phi) / unit::mm);
    }
  }
  if (in["more"]) {
    add_more(in, cut, X, out);
  }
  if (in["alike"]) {
    add_flutes_alike(setup, law_of(in["law"]), plant, out);
  }
  if (!in["rpm"].empty()) {
    add_transitions(cut, plant, in["rpm"], out);
  }
  return out;
}

}  // namespace

int main() {
  Json out;
  for (const Json& in : Json::parse(std::cin)) {
    out.push_back(numbers_of(in));
  }
  std::cout << out.dump() << '\n';
}
