#include <trochoid/sweep/found.h>

#include <trochoid/base/error.h>
#include <trochoid/base/units.h>
#include <trochoid/chip/model.h>
#include <trochoid/inputs/inches.h>
#include <trochoid/inputs/read_value.h>
#include <trochoid/results/joint.h>
#include <trochoid/results/json.h>
#include <trochoid/sweep/put_modes.h>

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace trochoid::sweep {

namespace {

using inputs::DrawnFile;
using inputs::Node;
using inputs::SweptKey;
using results::ReadJoint;

constexpr std::string_view e_x = "runout.e_x_mm";

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
  return table != nullptr && std::holds_alternative<inputs::Members>(table->value)
             ? number_in(*table, key.substr(dot + 1))
             : std::nullopt;
}

std::string text_at(const Node& root, std::string_view table, std::string_view key,
                    const char* otherwise) {
  const Node* at = find(root, table);
  const Node* node = at != nullptr && std::holds_alternative<inputs::Members>(at->value)
                         ? find(*at, key)
                         : nullptr;
  const auto* text = node != nullptr ? std::get_if<std::string>(&node->value) : nullptr;
  return text != nullptr ? *text : otherwise;
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
        if (whole_of(inputs::path_in_mm(key.key)) == whole_of(other.key)) {
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
                      "\"{}\"; must be the same, as in the material.toml beside it",
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
    Node zeros{.value = inputs::Array(joint.teeth, {.value = 0.0, .where = list.where}),
               .where = list.where};
    const Node* runout = find(found_.root, "runout");
    const Node* given =
        runout != nullptr && std::holds_alternative<inputs::Members>(runout->value)
            ? find(*runout, "radial_offsets_mm")
            : nullptr;
    const auto* entries =
        given != nullptr ? std::get_if<inputs::Array>(&given->value) : nullptr;
    if (entries == nullptr || entries->size() != joint.teeth) {
      set_key(found_.root, list, zeros);
      return;
    }
    // Found offsets are from tooth 1 on, and so must be those that stay.
    Node from_first{.value = *entries, .where = list.where};
    const double first = inputs::number_in(entries->front()).value_or(0.0);
    for (Node& entry : std::get<inputs::Array>(from_first.value)) {
      if (const auto own = inputs::number_in(entry)) {
        entry.value = *own - first;
      }
    }
    set_key(found_.root, list, from_first);
  }

  void put_values(const results::Joint& joint) {
    const FoundSet& set = found_.sets.back();
    const inputs::Location where = at_->where;
    const auto key_of = [&](std::string key) {
      return SweptKey{.key = std::move(key), .where = where, .values = {}};
    };
    if (!joint.law.empty()) {
      set_key(found_.root, key_of("force.law"), {.value = joint.law, .where = where});
    }
    if (std::ranges::any_of(set.names, [](const std::string& name) {
          return name.starts_with("runout.radial_offsets_mm");
        })) {
      make_offsets(joint, key_of("runout.radial_offsets_mm"));
    }
    const std::vector<double> values = as_keys(set, joint.values);
    std::size_t i = 0;
    for (const std::string& name : set.names) {
      const SweptKey key = key_of(name == e_x               ? "runout.eccentricity_mm"
                                  : name == "runout.e_y_mm" ? "runout.angle_deg"
                                                            : name);
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
    } else if (set.names[i].ends_with(".angle_deg")) {
      // The direction of a mode is a line; a case has it within a right angle.
      values[i] = std::remainder(numbers[i], 180.0);
    }
  }
  return values;
}

Found find_all(const inputs::Sweep& sweep, const Node& root) {
  Putting putting(root);
  for (const DrawnFile& drawn : sweep.covariance) {
    putting.put(drawn);
  }
  return putting.done(sweep.over);
}

}  // namespace trochoid::sweep
