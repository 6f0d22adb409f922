#include <trochoid/base/error.h>
#include <trochoid/base/read_text.h>
#include <trochoid/results/file_names.h>
#include <trochoid/results/joint.h>
#include <trochoid/results/json.h>

#include <fmt/core.h>

#include <charconv>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace trochoid::results {

namespace {

namespace fs = std::filesystem;

constexpr double none = std::numeric_limits<double>::quiet_NaN();

[[noreturn]] void refuse_summary(const fs::path& file, const std::string& why) {
  throw base::InputError({fmt::format("{}: {}", file.string(), why)});
}

Value summary_in(const std::optional<std::string>& text, const fs::path& file) {
  if (!text || !is_our_summary(*text)) {
    refuse_summary(
        file,
        "not a summary.json of trochoid; must be one from identify, modes or "
        "calibrate, or its folder");
  }
  return json_value(*text);
}

Value summary_of(const fs::path& file) {
  std::error_code error;
  if (!fs::is_regular_file(file, error)) {
    refuse_summary(
        file,
        "there is no such file; must be a summary.json of identify, modes or "
        "calibrate, or its folder");
  }
  return summary_in(base::read_text(file), file);
}

std::string text_of(const Value* value) {
  const auto* text =
      value != nullptr ? std::get_if<std::string>(&value->data) : nullptr;
  return text != nullptr ? *text : std::string();
}

double number_of(const Value& value) {
  if (const auto* whole = std::get_if<std::int64_t>(&value.data)) {
    return static_cast<double>(*whole);
  }
  const auto* real = std::get_if<double>(&value.data);
  return real != nullptr ? *real : none;
}

const Array& list_of(const Value* value) {
  static const Array empty;
  const auto* list = value != nullptr ? std::get_if<Array>(&value->data) : nullptr;
  return list != nullptr ? *list : empty;
}

std::vector<double> numbers_of(const Value* value) {
  std::vector<double> numbers;
  for (const Value& entry : list_of(value)) {
    numbers.push_back(number_of(entry));
  }
  return numbers;
}

/// The covariance of a group; of the first one where none is named.
const Value* covariance_in(const Value& result, const std::string& group,
                           const fs::path& file) {
  if (group.empty()) {
    return find(result, "covariance");
  }
  std::string names;
  for (const Value& one : list_of(find(result, "groups"))) {
    const std::string name = text_of(find(one, "group"));
    if (name == group) {
      return find(one, "covariance");
    }
    names += fmt::format("{}\"{}\"", names.empty() ? "" : ", ", name);
  }
  refuse_summary(file, fmt::format("there is no group \"{}\"; there {}", group,
                                   names.empty() ? "are none" : "are " + names));
}

/// k of `before[k]after`, `after` beginning what follows; 0: it is another name.
std::size_t entry_in(std::string_view name, std::string_view before,
                     std::string_view after) {
  if (!name.starts_with(before)) {
    return 0;
  }
  std::size_t k = 0;
  name.remove_prefix(before.size());
  const auto read = std::from_chars(name.data(), name.data() + name.size(), k);
  name.remove_prefix(static_cast<std::size_t>(read.ptr - name.data()));
  return read.ec == std::errc{} && name.starts_with(after) ? k : 0;
}

/// Whether every name is one of those that a command writes: the file may be anyone's.
bool known_names(const Joint& joint) {
  constexpr std::size_t most_teeth = 64;
  for (std::size_t i = 0; i < joint.names.size(); ++i) {
    const std::string& name = joint.names[i];
    const std::size_t tooth = std::max(entry_in(name, "runout.radial_offsets_mm[", "]"),
                                       entry_in(name, "runout.axial_offsets_mm[", "]"));
    const std::size_t mode = entry_in(name, "mode[", "].");
    const auto of_pair = [&](std::string_view x, std::string_view y) {
      return name == x ? i + 1 < joint.names.size() && joint.names[i + 1] == y
                       : name == y && i > 0 && joint.names[i - 1] == x;
    };
    const bool pair = of_pair("runout.e_x_mm", "runout.e_y_mm") ||
                      of_pair("runout.t_x", "runout.t_y");
    const bool law = name.starts_with("force.") && !joint.law.empty() &&
                     name.find_first_of(".[", 6) == std::string::npos;
    const bool offset = tooth > 0 && tooth <= joint.teeth && joint.teeth <= most_teeth;
    if (!pair && !law && !offset && (mode == 0 || mode > joint.modes.size())) {
      return false;
    }
  }
  return true;
}

bool whole(const Joint& joint) {
  const std::size_t n = joint.names.size();
  bool finite = n > 0 && joint.values.size() == n && joint.factors.size() == n &&
                joint.covariance.size() == n * n && known_names(joint);
  for (const auto* list : {&joint.values, &joint.factors, &joint.covariance}) {
    for (const double value : *list) {
      finite = finite && std::isfinite(value);
    }
  }
  return finite;
}

Joint joint_in(const Value& value) {
  Joint joint{.law = text_of(find(value, "law")),
              .chip_model = text_of(find(value, "chip_model"))};
  if (const Value* teeth = find(value, "teeth")) {
    const double count = number_of(*teeth);
    joint.teeth = count > 0 ? static_cast<std::size_t>(count) : 0;
  }
  for (const Value& mode : list_of(find(value, "modes"))) {
    joint.modes.push_back({text_of(find(mode, "body")), text_of(find(mode, "axis"))});
  }
  for (const Value& name : list_of(find(value, "names"))) {
    joint.names.push_back(text_of(&name));
  }
  joint.values = numbers_of(find(value, "found"));
  joint.factors = numbers_of(find(value, "interval_factors"));
  for (const Value& row : list_of(find(value, "matrix"))) {
    const std::vector<double> numbers = numbers_of(&row);
    joint.covariance.insert(joint.covariance.end(), numbers.begin(), numbers.end());
  }
  for (const Value& one : list_of(find(value, "not_found"))) {
    joint.not_found.emplace_back(text_of(find(one, "name")), text_of(find(one, "why")));
  }
  return joint;
}

ReadJoint joint_of_summary(const Value& summary, const fs::path& file,
                           const std::string& group) {
  ReadJoint out{.file = file};
  out.command = text_of(find(summary, "command"));
  if (out.command != "identify" && out.command != "modes" &&
      out.command != "calibrate") {
    refuse_summary(out.file,
                   fmt::format("of the command {}, which finds nothing to draw; must "
                               "be of identify, modes or calibrate",
                               out.command));
  }
  if (text_of(find(summary, "status")) != "ok") {
    refuse_summary(out.file,
                   fmt::format("{} had no answer there ({}), so there is nothing to "
                               "draw",
                               out.command, text_of(find(summary, "message"))));
  }
  const Value* result = find(summary, "result");
  const Value* covariance =
      result != nullptr ? covariance_in(*result, group, out.file) : nullptr;
  if (covariance == nullptr) {
    refuse_summary(out.file,
                   fmt::format("no `covariance` in it, as versions before it left it "
                               "out; run {} again",
                               out.command));
  }
  out.joint = joint_in(*covariance);
  if (!whole(out.joint)) {
    refuse_summary(
        out.file,
        "`covariance` names nothing, or something else than what the command finds, "
        "or has not one finite number for each name");
  }
  out.do_not_use = text_of(find(*result, "verdict")) == "do not use";
  return out;
}

}  // namespace

ReadJoint read_joint(const fs::path& path, const std::string& group) {
  std::error_code error;
  const fs::path file = fs::is_directory(path, error) ? path / "summary.json" : path;
  return joint_of_summary(summary_of(file), file, group);
}

ReadJoint joint_in_text(const std::string& text, const std::string& name) {
  return joint_of_summary(summary_in(text, name), name, "");
}

}  // namespace trochoid::results
