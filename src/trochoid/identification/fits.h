#pragma once

#include <trochoid/identification/runout_form.h>
#include <trochoid/identification/views.h>

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

/// Fits with several chip models, of which one decides what is left open.
namespace trochoid::identification {

/// How records are fitted.
struct FitRequest {
  std::vector<chip::Model> chip_models;  ///< not empty
  /// Form of the runout that is asked for; nothing: the records decide.
  std::optional<RunoutUnknowns> runout;
  bool view_open = false;  ///< band and resonance are left to the records
  /// What holds for all models. `start`: where to search first, if known. `response`: of
  /// the dynamometer, if measured. `stop`: from when on nothing is begun any more but the
  /// first fit of the deciding model.
  Options options;
};

/// Fits of all chip models, and how the form of the runout and the view of the records
/// were decided.
struct Fits {
  std::vector<Fit> fits;  ///< in the order of the request
  std::vector<View> views;
  std::optional<RunoutForm> runout_form;
  std::vector<std::string> left_out;  ///< what there was no time for
};

/// @brief Fit every chip model. What is left to the records is decided with the most exact
/// one, and holds for the others.
///
/// @param runs  force on the tool
/// @param told  the part that is done, from 0 to 1, before every fit; may be empty
Fits all_fits(const force::Setup& setup, const force::Law& law,
              std::span<const Run> runs, const FitRequest& request,
              const std::function<void(double)>& told = {});

/// @brief The fit that counts: the exact model where it was asked for, else the one that
/// fits best; nothing where none stands.
std::optional<std::size_t> chosen_fit(std::span<const Fit> fits);

}  // namespace trochoid::identification
