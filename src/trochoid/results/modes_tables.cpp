#include <trochoid/results/modes_parts.h>

#include <fmt/core.h>

#include <cstddef>
#include <string>
#include <utility>

namespace trochoid::results {

namespace {

using structure::FittedResponse;

/// A response, the fit through it and, of a single one, its mode indicator.
struct FittedCurve {
  const FittedResponse& one;
  std::vector<double> indicator;
};

std::vector<std::string> its_unit(const FittedCurve& of) {
  return {std::string(unit_suffix(of.one.kind))};
}

std::vector<std::string> unit_of_fit(const FittedCurve& of) {
  return of.one.fitted.empty() ? std::vector<std::string>{} : its_unit(of);
}

const Columns<FittedCurve>& fitted_columns() {
  using C = const FittedCurve&;
  using Row = std::size_t;
  static const Columns<FittedCurve> all{
      "fitted.csv",
      [](C c) { return c.one.omega.size(); },
      {{"frequency_Hz", "of the line",
        [](C c, Row i) { return hertz(c.one.omega[i]); }},
       {"re_*",
        "real part as measured: `re_m_per_N`, of a mobility `re_m_per_s_N`, of an "
        "accelerance `re_m_per_s2_N`",
        its_unit, [](C c, Row i, Row) { return c.one.H[i].real(); }},
       {"im_*", "imaginary part as measured", its_unit,
        [](C c, Row i, Row) { return c.one.H[i].imag(); }},
       {"fitted_re_*", "real part by the fit", unit_of_fit,
        [](C c, Row i, Row) { return c.one.fitted[i].real(); }},
       {"fitted_im_*", "imaginary part by the fit", unit_of_fit,
        [](C c, Row i, Row) { return c.one.fitted[i].imag(); }},
       {"mode_indicator", "M-19, of a single response",
        [](C c, Row i) { return c.indicator[i]; },
        [](C c) { return !c.indicator.empty(); }}}};
  return all;
}

/// What the blows gave, with its coherence.
const Columns<ModesResult>& response_columns() {
  using R = const ModesResult&;
  using Row = std::size_t;
  const auto its_kind = [](R r) {
    return std::vector{std::string(unit_suffix(r.fit.responses.front().kind))};
  };
  static const Columns<ModesResult> all{
      "response.csv",
      [](R r) { return r.tap->omega.size(); },
      {{"frequency_Hz", "of the line",
        [](R r, Row i) { return hertz(r.tap->omega[i]); }},
       {"re_*", "real part: `re_m_per_N` ...", its_kind,
        [](R r, Row i, Row) { return r.tap->H[i].real(); }},
       {"im_*", "imaginary part", its_kind,
        [](R r, Row i, Row) { return r.tap->H[i].imag(); }},
       {"coherence", "of two hits and more (M-20)",
        [](R r, Row i) { return r.tap->coherence[i]; },
        [](R r) { return !r.tap->coherence.empty(); }}}};
  return all;
}

/// Poles of rising order, and how they stand.
const Columns<ModesResult>& stabilisation_columns() {
  using R = const ModesResult&;
  using Row = std::size_t;
  static const Columns<ModesResult> all{
      "stabilisation.csv",
      [](R r) { return r.poles.size(); },
      {{"order", "of the rational fit", [](R r, Row i) { return r.poles[i].order; }},
       {"frequency_Hz", "of the pole",
        [](R r, Row i) { return hertz(r.poles[i].omega); }},
       {"damping_ratio", "of the pole", [](R r, Row i) { return r.poles[i].zeta; }},
       {"standing",
        "0: new, 1: the frequency of one of the order before, 2: its damping too (M-18)",
        [](R r, Row i) { return static_cast<int>(r.poles[i].standing); }}}};
  return all;
}

std::vector<base::Table> tables_of_one(const ModesResult& r) {
  const FittedResponse& one = r.fit.responses.front();
  std::vector<base::Table> tables = {fitted_columns().table(
      {one,
       structure::mode_indicator({.kind = one.kind, .omega = one.omega, .H = one.H})})};
  if (r.tap && !r.tap->omega.empty()) {
    tables.push_back(response_columns().table(r));
  }
  if (!r.poles.empty()) {
    tables.push_back(stabilisation_columns().table(r));
  }
  return tables;
}

std::vector<base::Table> tables_of_shared(const ModesResult& r) {
  std::vector<base::Table> tables;
  for (std::size_t q = 0; q < r.responses.size(); ++q) {
    tables.push_back(fitted_columns().table({r.fit.responses[q], {}}));
    tables.back().file = fmt::format("fitted_{}.csv", r.responses[q].name);
  }
  return tables;
}

}  // namespace

std::vector<base::Table> modes_tables(const ModesResult& r) {
  return r.shared ? tables_of_shared(r) : tables_of_one(r);
}

void add_modes_columns(std::vector<ColumnText>& to) {
  std::vector<ColumnText> fitted;
  fitted_columns().add_texts(fitted);
  to.insert(to.end(), fitted.begin(), fitted.end());
  for (ColumnText& column : fitted) {  // the same of each of several
    column.file = "fitted_*.csv";
    if (column.name != "mode_indicator") to.push_back(std::move(column));
  }
  response_columns().add_texts(to);
  stabilisation_columns().add_texts(to);
}

}  // namespace trochoid::results
