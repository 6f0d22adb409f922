#include <trochoid/identification/readings.h>

#include <algorithm>

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

}  // namespace

std::vector<ReadingFamily> reading_families(const force::Setup& setup) {
  std::vector<ReadingFamily> out;
  if (force::keeps_radius(setup)) {
    for (const signal::AxesClass& c : signal::axes_classes()) {
      out.emplace_back(c.readings.begin(), c.readings.end());
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
