#pragma once

#include <trochoid/base/stop.h>
#include <trochoid/inputs/case.h>
#include <trochoid/results/identify.h>
#include <trochoid/run/shared/progress.h>

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace trochoid::run {

/// Fits of all chip models, and how the form of the runout and the view of the records
/// were decided.
struct Fits {
  std::vector<identification::Fit> fits;  ///< in the order of the case
  std::vector<identification::View> views;
  std::optional<results::RunoutForm> runout_form;
  std::vector<std::string> left_out;  ///< what there was no time for
};

/// What is known before anything is fitted.
struct Known {
  std::optional<identification::Start> start;
  std::vector<identification::Response> response;  ///< one a run; empty: none measured
};

/// @brief Fit every chip model. What the case leaves to the records is decided with the
/// most exact one, and holds for the others.
/// @param known  where to search first, and the response of the dynamometer, as far as
///               known
/// @param stop   then nothing is begun any more but the first fit of the most exact model
Fits all_fits(const inputs::Case& given, std::span<const identification::Run> runs,
              const Known& known, const Progress& progress, base::Stop stop);

/// Why no more is begun, in words.
std::string why_ended(const base::Stop& stop);

/// The fit that counts: the exact model where it was asked for, else the one that fits
/// best; none where none stands.
std::optional<std::size_t> chosen_fit(const std::vector<identification::Fit>& fits);

}  // namespace trochoid::run
