#pragma once

#include <trochoid/force/setup.h>

#include <vector>

/// The slot of Riviere-Lorphevre and Filippi (2009), with which all timings are made.
namespace trochoid::benchmarks {

force::Setup paper_cut(chip::Model model = chip::Model::trochoidal);
force::Law paper_law();
/// Equally spaced spindle angles [rad].
std::vector<double> turns(int samples_per_turn, int count);

}  // namespace trochoid::benchmarks
