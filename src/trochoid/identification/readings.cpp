#include <trochoid/identification/readings.h>

#include <algorithm>
#include <cmath>

namespace trochoid::identification {
namespace {

using Vector3 = std::array<double, 3>;

constexpr signal::Matrix3 identity = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
constexpr signal::Matrix3 reversed = {{{-1, 0, 0}, {0, -1, 0}, {0, 0, -1}}};

/// Q^T channels.
Vector3 turned_back(const signal::Matrix3& Q, const Vector3& channels) {
  Vector3 out{};
  for (std::size_t c = 0; c < 3; ++c) {
    for (std::size_t q = 0; q < 3; ++q) out[q] += Q[c][q] * channels[c];
  }
  return out;
}

signal::Matrix3 negative(signal::Matrix3 Q) {
  for (Vector3& row : Q) {
    for (double& value : row) value = 0.0 - value;
  }
  return Q;
}

/// Whether the edges stand at one lead angle all along: kappa = 90 deg - beta.
bool has_one_lead_angle(const geometry::Cutter& cutter) {
  return cutter.profile.R == 0.0 && cutter.profile.alpha == 0.0 && !cutter.serration;
}

signal::Matrix3 product(const signal::Matrix3& A, const signal::Matrix3& B) {
  signal::Matrix3 out{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      for (std::size_t k = 0; k < 3; ++k) out[i][j] += A[i][k] * B[k][j];
    }
  }
  return out;
}

/// @brief What a turn of the coefficients of a cylinder is at another lead angle: forces
/// across and along the axis are K_r sin(kappa) + K_a cos(kappa) and
/// K_a sin(kappa) - K_r cos(kappa).
signal::Matrix3 at_lead_angle(const signal::Matrix3& turn, double beta) {
  const double s = std::cos(beta);  // of kappa
  const double c = std::sin(beta);
  const signal::Matrix3 across = {{{1, 0, 0}, {0, s, c}, {0, -c, s}}};
  const signal::Matrix3 back = {{{1, 0, 0}, {0, s, -c}, {0, c, s}}};
  return product(back, product(turn, across));
}

}  // namespace

std::vector<ReadingFamily> reading_families(const force::Setup& setup) {
  std::vector<ReadingFamily> out;
  if (has_one_lead_angle(setup.cutter)) {
    for (const signal::AxesClass& c : signal::axes_classes()) {
      ReadingFamily& family = out.emplace_back(c.readings.begin(), c.readings.end());
      for (signal::AxesReading& reading : family) {
        reading.turn = at_lead_angle(reading.turn, setup.cutter.profile.beta);
      }
    }
    return out;
  }
  for (const signal::Matrix3& Q : signal::axes_candidates()) {
    const auto known = [&](const ReadingFamily& family) {
      return family.back().Q == Q;
    };
    if (std::ranges::none_of(out, known)) {
      out.push_back({{Q, identity}, {negative(Q), reversed}});
    }
  }
  return out;
}

Problem read_by(Problem channels, const signal::Matrix3& Q) {
  for (FoldedRun& run : channels.runs) {
    for (Vector3& F : run.force) F = turned_back(Q, F);
    for (std::size_t i = 0; i + 2 < run.b.size(); i += 3) {
      const Vector3 F = turned_back(Q, {run.b[i], run.b[i + 1], run.b[i + 2]});
      std::ranges::copy(F, run.b.begin() + static_cast<std::ptrdiff_t>(i));
    }
  }
  return channels;
}

}  // namespace trochoid::identification
