#pragma once

#include <trochoid/base/estimate.h>
#include <trochoid/results/fields.h>

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace trochoid::results {

/// What a mode of modes.toml moves, and along which axis.
struct JointMode {
  std::string body;
  std::string axis;
};

/// @brief Numbers that one fit found together, in the units of files, with the covariance
/// that their intervals are of: `covariance` of a summary.json.
///
/// @eq U-1 half of the 95 % interval of x_i = w_i sqrt(C_ii)
/// @src definition
struct Joint {
  std::string law;         ///< of the coefficients; empty: there are none
  std::string chip_model;  ///< that they were found with; empty: not said
  std::size_t teeth = 0;   ///< of the runout; 0: there is none
  std::vector<JointMode> modes;
  /// Keys of a case, but for `runout.e_x_mm` and `runout.e_y_mm`: rho cos(lambda), rho
  /// sin(lambda) in place of amount and angle.
  std::vector<std::string> names;
  std::vector<double> values;
  std::vector<double> factors;     ///< w, of each interval
  std::vector<double> covariance;  ///< C, row-major
  /// What was looked for and has no error, and why.
  std::vector<std::pair<std::string, std::string>> not_found;
};

/// @brief Append a number that was found; its covariance is the caller's.
void add_found(Joint& joint, std::string name, double value,
               double factor = base::normal_interval);

/// @brief The covariance of all that was added, which was computed in other units.
/// @param covariance  row-major; empty: nothing is known, and all that was added goes
/// @param units       of the names, in those of the covariance
void set_covariance(Joint& joint, std::span<const double> covariance,
                    std::span<const double> units);

/// w of an estimate.
double interval_factor(const base::Estimate& estimate);

/// Its keys in summary.json.
const Fields<Joint>& joint_fields();

/// Nothing where nothing was found.
std::optional<Joint> found_or_none(Joint joint);

/// @brief As it stands there; null where nothing was found.
Value joint_value(const Joint& joint);

/// What was read from a summary.json.
struct ReadJoint {
  Joint joint = {};
  std::string command = {};
  std::filesystem::path file;
  bool do_not_use = false;  ///< the command itself said so
};

/// @brief What the command of a result folder found.
/// @param path   summary.json, or its folder
/// @param group  of records; empty: the first
/// @throws base::InputError where it is no summary.json of identify, modes or calibrate,
///         they had no answer, or an older version wrote it
ReadJoint read_joint(const std::filesystem::path& path, const std::string& group);

/// @brief The same of a summary.json that is in memory.
/// @param name  of it, for messages
ReadJoint joint_in_text(const std::string& text, const std::string& name);

}  // namespace trochoid::results
