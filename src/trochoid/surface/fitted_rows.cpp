#include <trochoid/surface/fitted_rows.h>

#include <trochoid/surface/folded_readings.h>
#include <trochoid/surface/joint_model.h>

#include <cmath>

namespace trochoid::surface {

namespace {

std::vector<Datum> with_form(std::span<const Datum> datum, Form form) {
  std::vector<Datum> out(datum.begin(), datum.end());
  for (Datum& d : out) {
    d = decided(d, form);
  }
  return out;
}

/// A reading lies where the mean that it belongs to does.
std::vector<Spot> spots_of(std::span<const Nominal> nominal, std::size_t readings) {
  std::vector<Spot> spots(readings);
  for (const Nominal& n : nominal) {
    for (const std::size_t i : n.readings) {
      spots[i] = {n.x, n.height, n.set};
    }
  }
  return spots;
}

void add_row(const Reading& reading, double count, FittedRows& rows) {
  rows.readings.push_back(reading);
  rows.error.push_back(reading.error / error_scale);
  rows.count.push_back(count);
}

}  // namespace

DatumColumns add_form(const FittedRows& rows, std::span<const Datum> datum, Form form,
                      RowProblem& problem) {
  DatumColumns all = datum_columns(rows.spots, with_form(datum, form));
  const std::size_t n = all.count;
  problem.form = {n, std::vector<double>(rows.error.size() * n), all.parts};
  std::vector<double> readings(rows.error.size());
  for (const std::size_t row : rows.of) {
    readings[row] += 1.0;
  }
  for (std::size_t i = 0; i < rows.of.size(); ++i) {
    for (std::size_t k = 0; k < n; ++k) {
      problem.form.values[rows.of[i] * n + k] +=
          all.values[i * n + k] / readings[rows.of[i]];
    }
  }
  problem.prior.clear();
  for (const DatumPart& part : all.parts) {
    using Kind = DatumPart::Kind;
    const Datum& asked = datum[part.set];
    const bool open = !asked.decide || part.kind == Kind::lean ||
                      (part.kind == Kind::offset && asked.offset) ||
                      (part.kind == Kind::tilt && asked.tilt);
    const double usual = part.kind == Kind::offset ? usual_offset : usual_form;
    problem.prior.push_back(open ? 0.0
                                 : std::pow(part.largest * error_scale / usual, 2));
  }
  return all;
}

FittedRows folded_rows(const Setting& setting, std::span<const Reading> readings,
                       const ModelFits& found) {
  const ToothModel model(setting, readings, found.stations);
  FoldedReadings folded = fold_readings(setting, readings, model);
  FittedRows rows{.spots = spots_of(found.nominal, readings.size())};
  for (std::size_t i = 0; i < folded.means.size(); ++i) {
    add_row(folded.means[i], folded.count[i], rows);
  }
  for (std::size_t i = 0; i < readings.size(); ++i) {
    const double apart =
        (readings[i].error - folded.means[folded.of[i]].error) / error_scale;
    rows.within += apart * apart;
  }
  rows.of = std::move(folded.of);
  rows.independent = static_cast<double>(readings.size());
  return rows;
}

FittedRows mean_rows(std::span<const Nominal> nominal, std::size_t readings) {
  FittedRows rows{.of = std::vector<std::size_t>(readings),
                  .spots = spots_of(nominal, readings)};
  for (const Nominal& n : nominal) {
    for (const std::size_t i : n.readings) {
      rows.of[i] = rows.readings.size();
    }
    add_row({.x = n.x,
             .travel = n.travel,
             .height = n.height,
             .error = n.error,
             .set = n.set},
            static_cast<double>(n.readings.size()), rows);
  }
  rows.independent = static_cast<double>(nominal.size());
  return rows;
}

}  // namespace trochoid::surface
