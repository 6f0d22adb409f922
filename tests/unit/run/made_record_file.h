#pragma once

#include "../cases/case_text.h"
#include "../identification/made_record.h"

#include <fmt/core.h>

#include <string>

/// Case files with a record made by the program's own forces.
namespace trochoid::run::test {

using cases::test::CaseFolder;

/// What is told of a record beside its channels.
enum class Axis { angle, time };

/// The cutter and the cut of cases::test::slot.
inline force::Setup made_setup() {
  force::Setup setup = identification::slot_setup(2, 30.0, 2.0 * unit::mm);
  setup.runout.radial_offsets = {0.0, -8.0 * unit::um};
  return setup;
}

inline force::LinearEdge made_law() {
  return {2620e6, 1560e6, 331e6, 7e3, 3e3, 1e3};
}

/// Channels as text of a CSV file.
/// @param rpm  the true spindle speed, for the times
inline std::string csv_text(const identification::Record& record, Axis axis,
                            double rpm = 875.0) {
  std::string text = axis == Axis::angle ? "angle_deg" : "time_s";
  text += ",Fx_N,Fy_N,Fz_N\n";
  for (std::size_t i = 0; i < record.angle.size(); ++i) {
    const double at = axis == Axis::angle ? unit::deg : rpm * unit::rpm;
    const auto& F = record.force[i];
    text += fmt::format("{:.12g},{:.10g},{:.10g},{:.10g}\n", record.angle[i] / at, F[0],
                        F[1], F[2]);
  }
  return text;
}

/// A record of two turns with its phase and noise.
inline identification::Record two_turns(double phase = 0.3, double noise = 0.0) {
  return identification::made_record(
      made_setup(), made_law(),
      {.phase = phase, .per_turn = 180, .turns = 2.0, .noise = noise});
}

inline const std::string measurement = "[[measurement]]\nfile = \"record.csv\"\n";
inline const std::string runout = "[runout]\nradial_offsets_mm = [0.0, -0.008]\n";

}  // namespace trochoid::run::test
