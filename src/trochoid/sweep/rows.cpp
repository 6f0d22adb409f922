#include <trochoid/sweep/rows.h>

#include <trochoid/sweep/chance.h>

#include <random>
#include <utility>

namespace trochoid::sweep {

namespace {

/// Another stream than that of the swept keys, so that they do not go together.
constexpr std::uint64_t other_stream = 0x9e3779b97f4a7c15U;

}  // namespace

Rows::Rows(const inputs::Sweep& sweep, Found found)
    : samples_(sweep),
      found_(std::move(found)),
      draws_(found_.sets.empty() ? 0 : sweep.draws),
      of_each_row_(by_chance(sweep.method)) {
  std::mt19937_64 random(sweep.seed ^ other_stream);
  for (const FoundSet& set : found_.sets) {
    chance_.push_back(chances(random, set.distribution.chances(), draws_,
                              sweep.method == inputs::SweepMethod::latin_hypercube));
  }
}

std::size_t Rows::size() const noexcept {
  return draws_ == 0 || of_each_row_ ? samples_.rows() : draws_ * samples_.rows();
}

std::vector<inputs::Node> Rows::row(std::size_t i) const {
  if (draws_ == 0) {
    return samples_.row(i);
  }
  std::vector<inputs::Node> values = samples_.row(of_each_row_ ? i : i / draws_);
  const std::size_t draw = i % draws_;
  auto key = found_.keys.begin();
  for (std::size_t s = 0; s < found_.sets.size(); ++s) {
    const FoundSet& set = found_.sets[s];
    std::vector<double> chance;
    for (std::size_t c = 0; c < set.distribution.chances(); ++c) {
      chance.push_back(chance_[s][c * draws_ + draw]);
    }
    for (const double value : as_keys(set, drawn(set.distribution, chance))) {
      values.push_back({.value = value, .where = key->where});
      ++key;
    }
  }
  return values;
}

std::vector<inputs::Node> Rows::first() const {
  std::vector<inputs::Node> values = samples_.row(0);
  values.insert(values.end(), found_.values.begin(), found_.values.end());
  return values;
}

}  // namespace trochoid::sweep
