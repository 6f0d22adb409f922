#pragma once

#include <trochoid/base/table.h>
#include <trochoid/results/columns.h>
#include <trochoid/results/correct.h>

#include <string>

/// The files and the printed table of `correct`.
namespace trochoid::results {

/// command.csv: over a turn, what the actuator is told and the motion wanted.
base::Table command_table(const correction::Plan& plan);

/// forces.csv: forces and table over the last turn, before and after.
base::Table before_after_table(const correction::Correction& c);

/// speeds.csv: difference of the peaks and range of the command over the spindle speed.
base::Table speeds_table(const correction::SpeedMap& map);

/// spindle.csv: speed and torque of the spindle over a turn, in place of the table.
base::Table spindle_table(const correction::SpeedModulation& m);

/// estimator.csv: how waves of the command and teeth change the flutes, for the machine.
base::Table estimator_table(const TrochoidEstimatorConfig& model);

/// controller.csv: the controller at each of its steps.
base::Table controller_table(const correction::ControllerInLoop& run);

/// What all these columns mean.
void add_texts_of_correct_tables(std::vector<ColumnText>& out);

/// command.h: the command for a program in C.
std::string command_header(const correction::Correction& c, const std::string& title);

/// The printed table, the line of the controller included.
std::string correct_text(const CorrectResult& r);

}  // namespace trochoid::results
