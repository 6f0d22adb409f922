#include <trochoid/sweep/found.h>

#include <trochoid/base/error.h>
#include <trochoid/base/units.h>
#include <trochoid/cases/inches.h>
#include <trochoid/cases/read_value.h>
#include <trochoid/chip/model.h>
#include <trochoid/results/joint.h>
#include <trochoid/results/json.h>

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

namespace trochoid::sweep {

namespace {

using cases::DrawnFile;
using cases::Members;
using cases::Node;
using cases::SweptKey;
using results::ReadJoint;

/// A number of a table of a case, as it stands there; none: another value, or none.
std::optional<double> number_in(const Node& table, std::string_view key) {
  const Node* node = find(table, key);
  return node != nullptr ? cases::number_in(*node) : std::nullopt;
}

/// Whether a case states any mode.
bool has_modes(const Node& root) {
  const Node* modes = find(root, "mode");
  const auto* list =
      modes != nullptr ? std::get_if<cases::Array>(&modes->value) : nullptr;
  return list != nullptr && !list->empty();
}

/// Where modes come from.
struct ModesFile {
  cases::Location where;   ///< of what asks for them
  std::string file;        ///< that they are of, for messages
  bool takes_all = false;  ///< the case had no modes of its own: these are added to it
};

constexpr double near_enough = 0.05;  ///< of the frequency

Node text_node(const std::string& text, const cases::Location& where) {
  return {.value = text, .where = where};
}

std::string text_in(const Node& table, std::string_view key) {
  const Node* node = find(table, key);
  const auto* text = node != nullptr ? std::get_if<std::string>(&node->value) : nullptr;
  return text != nullptr ? *text : std::string();
}

/// Natural frequency of a mode of a case [Hz]; none where it is not said.
std::optional<double> frequency_of(const Node& mode) {
  if (const auto f = number_in(mode, "frequency_Hz")) {
    return f;
  }
  const auto m = number_in(mode, "mass_kg");
  const auto k = number_in(mode, "stiffness_N_per_m");
  return m && k && *m > 0 && *k > 0 ? std::optional(std::sqrt(*k / *m) / unit::turn)
                                    : std::nullopt;
}

/// The list of modes of a case; a new one where there is none.
cases::Array& modes_of(Node& root, const cases::Location& where) {
  auto& members = std::get<Members>(root.value);
  auto found = std::ranges::find(members, std::string("mode"), &cases::Member::key);
  if (found == members.end() ||
      !std::holds_alternative<cases::Array>(found->node.value)) {
    members.push_back({"mode", where, {.value = cases::Array{}, .where = where}});
    found = std::prev(members.end());
  }
  return std::get<cases::Array>(found->node.value);
}

double number_of(const results::Joint& joint, std::size_t mode, const char* what) {
  const auto name = fmt::format("mode[{}].{}", mode + 1, what);
  const auto at = std::ranges::find(joint.names, name);
  return at == joint.names.end()
             ? std::numeric_limits<double>::quiet_NaN()
             : joint.values[static_cast<std::size_t>(at - joint.names.begin())];
}

/// Only the numbers that are drawn say what the mode is.
void keep_direction(Node& mode) {
  std::erase_if(std::get<Members>(mode.value), [](const cases::Member& member) {
    constexpr std::string_view numbers[] = {"mass_kg", "stiffness_N_per_m",
                                            "damping_Ns_per_m", "frequency_Hz",
                                            "damping_ratio"};
    return std::ranges::find(numbers, member.key) != std::end(numbers);
  });
}

/// The mode of a case that a found one is, by its place; none: no one is near.
struct Nearest {
  std::optional<std::size_t> place;
  std::optional<double> frequency;  ///< of the nearest one along that axis [Hz]
};

Nearest nearest_to(const cases::Array& modes, const results::JointMode& wanted,
                   double frequency, const std::vector<std::size_t>& taken) {
  Nearest out;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < modes.size(); ++i) {
    if (!std::holds_alternative<Members>(modes[i].value) ||
        text_in(modes[i], "body") != wanted.body ||
        text_in(modes[i], "axis") != wanted.axis ||
        std::ranges::find(taken, i) != taken.end()) {
      continue;
    }
    const auto f = frequency_of(modes[i]);
    if (f && std::abs(*f - frequency) < least) {
      least = std::abs(*f - frequency);
      out.frequency = f;
      out.place = least < near_enough * frequency ? std::optional(i) : std::nullopt;
    }
  }
  return out;
}

void rename(results::Joint& joint, const std::vector<std::size_t>& place) {
  for (std::string& name : joint.names) {
    if (!name.starts_with("mode[")) continue;
    const std::size_t close = name.find(']');
    const auto i = static_cast<std::size_t>(std::stoul(name.substr(5, close - 5))) - 1;
    if (i < place.size()) {
      name = fmt::format("mode[{}]{}", place[i] + 1, name.substr(close + 1));
    }
  }
}

constexpr std::string_view e_x = "runout.e_x_mm";
constexpr std::string_view t_x = "runout.t_x";

/// The key of a case that a name stands for.
std::string key_of_name(const std::string& name) {
  if (name == e_x) return "runout.eccentricity_mm";
  if (name == "runout.e_y_mm") return "runout.angle_deg";
  if (name == t_x) return "runout.tilt_deg";
  if (name == "runout.t_y") return "runout.tilt_angle_deg";
  return name;
}

/// What of a key cannot be set twice: of a mode its numbers, as they hang together.
std::string whole_of(const std::string& key) {
  if (key.starts_with("mode[")) {
    return key.substr(0, key.find('.'));
  }
  return key.substr(0, key.find('['));
}

std::optional<double> number_at(const Node& root, const std::string& key) {
  const auto dot = key.find('.');
  const Node* table = find(root, key.substr(0, dot));
  return table != nullptr && std::holds_alternative<cases::Members>(table->value)
             ? number_in(*table, key.substr(dot + 1))
             : std::nullopt;
}

std::string text_at(const Node& root, std::string_view table, std::string_view key,
                    const char* otherwise) {
  const Node* at = find(root, table);
  const Node* node = at != nullptr && std::holds_alternative<cases::Members>(at->value)
                         ? find(*at, key)
                         : nullptr;
  const auto* text = node != nullptr ? std::get_if<std::string>(&node->value) : nullptr;
  return text != nullptr ? *text : otherwise;
}

/// Find the modes of a joint answer among those of a case: its names then are keys of that
/// case, whose modes have mass, frequency and damping ratio.
/// @param report  called with each problem
void put_modes(Node& root, results::Joint& joint, const ModesFile& from,
               const std::function<void(const std::string&)>& report) {
  if (joint.modes.empty()) {
    return;
  }
  const cases::Location& where = from.where;
  cases::Array& modes = modes_of(root, where);
  std::vector<std::size_t> place;
  for (std::size_t i = 0; i < joint.modes.size(); ++i) {
    const results::JointMode& wanted = joint.modes[i];
    const double frequency = number_of(joint, i, "frequency_Hz");
    if (from.takes_all) {
      modes.push_back({.value = Members{{"body", where, text_node(wanted.body, where)},
                                        {"axis", where, text_node(wanted.axis, where)}},
                       .where = where});
      place.push_back(modes.size() - 1);
      continue;
    }
    const Nearest near = nearest_to(modes, wanted, frequency, place);
    if (!near.place) {
      report(fmt::format(
          "{}: a mode of the {} along {} at {:.5g} Hz, but the case has {}; must be "
          "there, as by include of the modes.toml next to it",
          from.file, wanted.body, wanted.axis, frequency,
          near.frequency ? fmt::format("none nearer than {:.5g} Hz", *near.frequency)
                         : std::string("no such mode")));
      return;
    }
    keep_direction(modes[*near.place]);
    place.push_back(*near.place);
  }
  rename(joint, place);
}

/// One file at a time, with what is wrong of all.
class Putting {
 public:
  explicit Putting(const Node& root) : takes_all_(!has_modes(root)) {
    found_.root = root;
  }

  void put(const DrawnFile& drawn) {
    at_ = &drawn;
    ReadJoint read;
    try {
      read = results::read_joint(drawn.path, drawn.group);
    } catch (const base::InputError& error) {
      for (const std::string& problem : error.problems()) {
        wrong(problem);
      }
      return;
    }
    file_ = read.file.string();
    auto distribution = distribution_of(read.joint);
    if (!distribution) {
      wrong(fmt::format("{}: `covariance` is none: a variance below zero", file_));
      return;
    }
    const std::size_t before = problems_.size();
    check_case(read.joint);
    put_modes(found_.root, read.joint, {drawn.where, file_, takes_all_},
              [&](const std::string& why) { wrong(why); });
    if (problems_.size() > before) {
      return;
    }
    warn(read);
    found_.meaning += json_text(joint_value(read.joint)) + "\n";
    found_.sets.push_back({read.joint.names, *std::move(distribution)});
    put_values(read.joint);
  }

  Found done(const std::vector<SweptKey>& over) {
    for (const SweptKey& key : over) {
      for (const SweptKey& other : found_.keys) {
        if (whole_of(cases::path_in_mm(key.key)) == whole_of(other.key)) {
          problems_.push_back(fmt::format(
              "{}: sweep.over.{}: {} is drawn from `covariance`; either of them",
              to_string(key.where), key.key, other.key));
        }
      }
    }
    if (!problems_.empty()) {
      throw base::InputError(problems_);
    }
    return std::move(found_);
  }

 private:
  void wrong(const std::string& why) {
    problems_.push_back(
        fmt::format("{}: sweep.covariance: {}", to_string(at_->where), why));
  }

  void check_case(const results::Joint& joint) {
    const Node& root = found_.root;
    const std::string law = text_at(root, "force", "law", "");
    if (!joint.law.empty() && !law.empty() && law != joint.law) {
      wrong(
          fmt::format("{}: coefficients of the law {}, but the case has force.law = "
                      "\"{}\"; must be the same, as in the material.toml next to it",
                      file_, joint.law, law));
    }
    const auto teeth = number_at(root, "tool.teeth");
    if (joint.teeth > 0 && teeth && *teeth != static_cast<double>(joint.teeth)) {
      wrong(fmt::format("{}: the runout of {} teeth, but the case has tool.teeth = {}",
                        file_, joint.teeth, *teeth));
    }
  }

  void warn(const ReadJoint& read) {
    const auto add = [&](const char* code, std::string text) {
      found_.warnings.push_back({code, fmt::format("{}: {}", file_, text)});
    };
    if (read.do_not_use) {
      add("do_not_use",
          fmt::format("{} itself says not to use these numbers", read.command));
    }
    const std::string model = text_at(found_.root, "chip", "model",
                                      chip::name_of(chip::Model::trochoidal).data());
    if (model != read.joint.chip_model && !read.joint.chip_model.empty()) {
      add("other_chip_model",
          fmt::format("the coefficients were found with the chip model {}, the case "
                      "computes with {}: they do not belong together",
                      read.joint.chip_model, model));
    }
    for (const auto& [name, why] : read.joint.not_found) {
      add("not_drawn", fmt::format("{} stays as the case has it, without an "
                                   "uncertainty: {}",
                                   name, why));
    }
  }

  /// Offsets need a list of the right length to go into.
  void make_offsets(const results::Joint& joint, const SweptKey& list) {
    Node zeros{.value = cases::Array(joint.teeth, {.value = 0.0, .where = list.where}),
               .where = list.where};
    const Node* runout = find(found_.root, "runout");
    const Node* given =
        runout != nullptr && std::holds_alternative<cases::Members>(runout->value)
            ? find(*runout, list.key.substr(list.key.find('.') + 1))
            : nullptr;
    const auto* entries =
        given != nullptr ? std::get_if<cases::Array>(&given->value) : nullptr;
    if (entries == nullptr || entries->size() != joint.teeth) {
      set_key(found_.root, list, zeros);
      return;
    }
    // Found offsets are from tooth 1 on, and so must be those that stay.
    Node from_first{.value = *entries, .where = list.where};
    const double first = cases::number_in(entries->front()).value_or(0.0);
    for (Node& entry : std::get<cases::Array>(from_first.value)) {
      if (const auto own = cases::number_in(entry)) {
        entry.value = *own - first;
      }
    }
    set_key(found_.root, list, from_first);
  }

  void put_values(const results::Joint& joint) {
    const FoundSet& set = found_.sets.back();
    const cases::Location where = at_->where;
    const auto key_of = [&](std::string key) {
      return SweptKey{.key = std::move(key), .where = where, .values = {}};
    };
    if (!joint.law.empty()) {
      set_key(found_.root, key_of("force.law"), {.value = joint.law, .where = where});
    }
    for (const char* list : {"runout.radial_offsets_mm", "runout.axial_offsets_mm"}) {
      if (std::ranges::any_of(set.names, [&](const std::string& name) {
            return name.starts_with(list);
          })) {
        make_offsets(joint, key_of(list));
      }
    }
    const std::vector<double> values = as_keys(set, joint.values);
    std::size_t i = 0;
    for (const std::string& name : set.names) {
      const SweptKey key = key_of(key_of_name(name));
      if (std::ranges::find(found_.keys, key.key, &SweptKey::key) !=
          found_.keys.end()) {
        wrong(fmt::format("{}: {} is drawn from another file too", file_, key.key));
      }
      compare(key.key, values[i], joint, i);
      const Node value{.value = values[i], .where = where};
      set_key(found_.root, key, value);
      found_.keys.push_back(key);
      found_.values.push_back(value);
      ++i;
    }
  }

  /// A case that says clearly something else was hardly meant so.
  void compare(const std::string& key, double value, const results::Joint& joint,
               std::size_t i) {
    const auto own = key.starts_with("force.") ? number_at(found_.root, key)
                                               : std::optional<double>();
    const std::size_t n = joint.names.size();
    const double half = joint.factors[i] * std::sqrt(joint.covariance[i * n + i]);
    if (own && std::abs(*own - value) > half) {
      found_.warnings.push_back(
          {"other_value",
           fmt::format("the case has {} = {:.6g}, {} found {:.6g} +- {:.2g} (95 %): "
                       "draws are about what was found",
                       key, *own, file_, value, half)});
    }
  }

  bool takes_all_ = false;  ///< a case without modes takes those of every file
  Found found_;
  std::vector<std::string> problems_;
  const DrawnFile* at_ = nullptr;
  std::string file_;
};

}  // namespace

std::vector<double> as_keys(const FoundSet& set, std::span<const double> numbers) {
  std::vector<double> values(numbers.begin(), numbers.end());
  for (std::size_t i = 0; i < set.names.size(); ++i) {
    if (set.names[i] == e_x) {
      values[i] = std::hypot(numbers[i], numbers[i + 1]);
      values[i + 1] = std::atan2(numbers[i + 1], numbers[i]) / unit::deg;
    } else if (set.names[i] == t_x) {
      values[i] = std::atan(std::hypot(numbers[i], numbers[i + 1])) / unit::deg;
      values[i + 1] = std::atan2(numbers[i + 1], numbers[i]) / unit::deg;
    } else if (set.names[i].ends_with(".angle_deg")) {
      // The direction of a mode is a line; a case has it within a right angle.
      values[i] = std::remainder(numbers[i], 180.0);
    }
  }
  return values;
}

Found find_all(const cases::Sweep& sweep, const Node& root) {
  Putting putting(root);
  for (const DrawnFile& drawn : sweep.covariance) {
    putting.put(drawn);
  }
  return putting.done(sweep.over);
}

}  // namespace trochoid::sweep
