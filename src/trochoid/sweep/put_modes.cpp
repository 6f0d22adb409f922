#include <trochoid/sweep/put_modes.h>

#include <trochoid/base/units.h>
#include <trochoid/inputs/read_value.h>

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

namespace trochoid::sweep {

namespace {

using inputs::Members;
using inputs::Node;

constexpr double near_enough = 0.05;  ///< of the frequency

Node text_node(const std::string& text, const inputs::Location& where) {
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
inputs::Array& modes_of(Node& root, const inputs::Location& where) {
  auto& members = std::get<Members>(root.value);
  auto found = std::ranges::find(members, std::string("mode"), &inputs::Member::key);
  if (found == members.end() ||
      !std::holds_alternative<inputs::Array>(found->node.value)) {
    members.push_back({"mode", where, {.value = inputs::Array{}, .where = where}});
    found = std::prev(members.end());
  }
  return std::get<inputs::Array>(found->node.value);
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
  std::erase_if(std::get<Members>(mode.value), [](const inputs::Member& member) {
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

Nearest nearest_to(const inputs::Array& modes, const results::JointMode& wanted,
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

}  // namespace

std::optional<double> number_in(const Node& table, std::string_view key) {
  const Node* node = find(table, key);
  return node != nullptr ? inputs::number_in(*node) : std::nullopt;
}

bool has_modes(const Node& root) {
  const Node* modes = find(root, "mode");
  const auto* list =
      modes != nullptr ? std::get_if<inputs::Array>(&modes->value) : nullptr;
  return list != nullptr && !list->empty();
}

void put_modes(Node& root, results::Joint& joint, const ModesFile& from,
               const std::function<void(const std::string&)>& report) {
  if (joint.modes.empty()) {
    return;
  }
  const inputs::Location& where = from.where;
  inputs::Array& modes = modes_of(root, where);
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
          "there, as by include of the modes.toml beside it",
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

}  // namespace trochoid::sweep
