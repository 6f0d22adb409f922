#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

/// A record of a pass: air, entry, cut, air; with noise, offsets and drift.
namespace trochoid::signal {

inline constexpr double turn = 2.0 * std::numbers::pi;
inline constexpr int a_turn = 100;

struct Made {
  int before = 20;   ///< idle revolutions
  int entering = 5;  ///< revolutions in which the force grows
  int cutting = 40;
  int after = 20;
  double noise = 1.0;
};

struct Samples {
  std::array<std::vector<double>, 3> channel;
  std::vector<double> angle;
};

inline Samples make(const Made& m) {
  std::mt19937 random(11);
  std::normal_distribution<double> white(0.0, 1.0);
  const int turns = m.before + m.entering + m.cutting + m.after;
  Samples s;
  for (int i = 0; i < turns * a_turn; ++i) {
    const double phi = i * turn / a_turn;
    const double number = phi / turn;
    double depth = 0.0;
    if (number >= m.before && number < turns - m.after) {
      depth = m.entering > 0 ? std::min(1.0, (number - m.before) / m.entering) : 1.0;
    }
    const double x = static_cast<double>(i) / (turns * a_turn - 1);
    s.angle.push_back(phi);
    const double force = depth * 200.0 * std::pow(std::sin(phi), 2);
    s.channel[0].push_back(force + 15.0 - 40.0 * x + m.noise * white(random));
    s.channel[1].push_back(-force + 7.0 + m.noise * white(random));
    s.channel[2].push_back(0.1 * force - 60.0 + 10.0 * x + m.noise * white(random));
  }
  return s;
}

}  // namespace trochoid::signal
