#include <trochoid/sweep/rows.h>

#include <trochoid/sweep/distribution.h>

#include <algorithm>
#include <random>
#include <utility>

namespace trochoid::sweep {

namespace {

using cases::EvenValues;
using cases::ListedValues;
using cases::NormalValues;
using cases::SweepMethod;
using cases::SweptKey;

cases::Node number(const SweptKey& key, double value) {
  return {.value = value, .where = key.where};
}

double between(const EvenValues& even, double share) {
  return even.from + share * (even.to - even.from);
}

/// The i-th value of a key that has values of its own.
cases::Node value_at(const SweptKey& key, std::size_t i) {
  if (const auto* list = std::get_if<ListedValues>(&key.values)) {
    return list->values[i];
  }
  const auto& even = std::get<EvenValues>(key.values);
  const int count = even.count.value_or(1);
  if (count == 1 || i == 0) {
    return number(key, even.from);
  }
  if (i + 1 == static_cast<std::size_t>(count)) {
    return number(key, even.to);
  }
  return number(key, between(even, static_cast<double>(i) / (count - 1)));
}

/// Where a share `p` of the distribution of a key lies below.
cases::Node value_of_chance(const SweptKey& key, double p) {
  if (const auto* list = std::get_if<ListedValues>(&key.values)) {
    const auto n = list->values.size();
    return list
        ->values[std::min(static_cast<std::size_t>(p * static_cast<double>(n)), n - 1)];
  }
  if (const auto* normal = std::get_if<NormalValues>(&key.values)) {
    return number(key, normal->mean + normal->sd * normal_quantile(p));
  }
  return number(key, between(std::get<EvenValues>(key.values), p));
}

std::size_t count_of(const SweptKey& key) {
  const auto* list = std::get_if<ListedValues>(&key.values);
  return list != nullptr ? list->values.size()
                         : static_cast<std::size_t>(
                               std::get<EvenValues>(key.values).count.value_or(1));
}

/// Another stream than that of the swept keys, so that they do not go together.
constexpr std::uint64_t other_stream = 0x9e3779b97f4a7c15U;

}  // namespace

Samples::Samples(const cases::Sweep& sweep) : sweep_(sweep) {
  std::mt19937_64 random(sweep.seed);
  if (by_chance(sweep.method)) {
    chance_ = chances(random, sweep.over.size(), sweep.rows,
                      sweep.method == SweepMethod::latin_hypercube);
  }
}

std::vector<std::size_t> Samples::places_in_grid(std::size_t row) const {
  std::vector<std::size_t> place(sweep_.over.size(), row);
  if (sweep_.method == SweepMethod::grid) {
    for (std::size_t k = place.size(); k-- > 0;) {
      const std::size_t count = count_of(sweep_.over[k]);
      place[k] = row % count;
      row /= count;
    }
  }
  return place;
}

std::vector<cases::Node> Samples::row(std::size_t row) const {
  std::vector<cases::Node> values;
  const std::size_t keys = sweep_.over.size();
  if (chance_.empty()) {
    const auto place = places_in_grid(row);
    for (std::size_t k = 0; k < keys; ++k) {
      values.push_back(value_at(sweep_.over[k], place[k]));
    }
    return values;
  }
  for (std::size_t k = 0; k < keys; ++k) {
    values.push_back(value_of_chance(sweep_.over[k], chance_[k * rows() + row]));
  }
  return values;
}

Rows::Rows(const cases::Sweep& sweep, Found found)
    : samples_(sweep),
      found_(std::move(found)),
      draws_(found_.sets.empty() ? 0 : sweep.draws),
      of_each_row_(by_chance(sweep.method)) {
  std::mt19937_64 random(sweep.seed ^ other_stream);
  for (const FoundSet& set : found_.sets) {
    chance_.push_back(chances(random, set.distribution.chances(), draws_,
                              sweep.method == cases::SweepMethod::latin_hypercube));
  }
}

std::size_t Rows::size() const noexcept {
  return draws_ == 0 || of_each_row_ ? samples_.rows() : draws_ * samples_.rows();
}

std::vector<cases::Node> Rows::row(std::size_t i) const {
  if (draws_ == 0) {
    return samples_.row(i);
  }
  std::vector<cases::Node> values = samples_.row(of_each_row_ ? i : i / draws_);
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

std::vector<cases::Node> Rows::first() const {
  std::vector<cases::Node> values = samples_.row(0);
  values.insert(values.end(), found_.values.begin(), found_.values.end());
  return values;
}

}  // namespace trochoid::sweep
