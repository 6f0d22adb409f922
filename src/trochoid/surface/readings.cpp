#include <trochoid/surface/readings.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace trochoid::surface {

namespace {

/// Places closer than this part of a tooth feed are one place.
constexpr double same_place = 1e-3;
constexpr double same_height = 1e-9;  // [m]

/// travel within one tooth feed, from 0; just below the feed is 0 as well
double within_tooth(double travel, double f_z) {
  const double part = travel / f_z - std::floor(travel / f_z + same_place);
  return part * f_z;
}

struct Place {
  std::size_t set;
  double height;
  double along;  ///< what tells places of one height apart
  double x;
  std::size_t index;
};

std::vector<Place> places_of(std::span<const Reading> readings, Model model,
                             double f_z) {
  std::vector<Place> places;
  for (std::size_t i = 0; i < readings.size(); ++i) {
    const Reading& r = readings[i];
    const double along =
        model == Model::quasi_static ? within_tooth(r.travel, f_z) : r.x;
    places.push_back({r.set, r.height, along, r.x, i});
  }
  std::stable_sort(places.begin(), places.end(), [](const Place& a, const Place& b) {
    if (a.set != b.set) {
      return a.set < b.set;
    }
    if (std::abs(a.height - b.height) > same_height) {
      return a.height < b.height;
    }
    return a.along < b.along;
  });
  return places;
}

/// Has every tooth left the same number of readings?
bool teeth_balance(const Nominal& nominal, std::span<const Reading> readings,
                   int teeth) {
  std::vector<int> count(static_cast<std::size_t>(teeth));
  for (const std::size_t i : nominal.readings) {
    if (readings[i].tooth < 0) {
      return nominal.readings.size() % count.size() == 0;
    }
    ++count[static_cast<std::size_t>(readings[i].tooth)];
  }
  return std::all_of(count.begin(), count.end(),
                     [&](int c) { return c == count.front(); });
}

}  // namespace

std::vector<Nominal> nominal_errors(std::span<const Reading> readings, Model model,
                                    double f_z, int teeth) {
  const double reach =
      model == Model::quasi_static ? same_place * f_z : (teeth - same_place) * f_z;
  std::vector<Nominal> nominal;
  double from = 0.0;
  for (const Place& place : places_of(readings, model, f_z)) {
    const bool joins = !nominal.empty() && nominal.back().set == place.set &&
                       std::abs(nominal.back().height - place.height) <= same_height &&
                       place.along - from <= reach;
    if (!joins) {
      nominal.push_back(
          {.travel = place.along, .height = place.height, .set = place.set});
      from = place.along;
    }
    nominal.back().readings.push_back(place.index);
  }
  for (Nominal& n : nominal) {
    const auto count = static_cast<double>(n.readings.size());
    for (const std::size_t i : n.readings) {
      n.error += readings[i].error / count;
      n.x += readings[i].x / count;
    }
    n.whole = teeth_balance(n, readings, teeth);
  }
  return nominal;
}

}  // namespace trochoid::surface
