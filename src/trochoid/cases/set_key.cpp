#include <trochoid/base/error.h>
#include <trochoid/cases/findings.h>
#include <trochoid/cases/inches.h>
#include <trochoid/cases/settings.h>
#include <trochoid/cases/sweep.h>

#include <fmt/core.h>

#include <algorithm>
#include <charconv>

namespace trochoid::cases {

namespace {

[[noreturn]] void refuse(const KeyToSet& key, std::string_view why) {
  throw base::InputError({fmt::format("{}: {}{}: {}", to_string(key.where), key.table,
                                      shown_key(key.key), why)});
}

/// `mode[2]` -> `mode` and 2; without brackets 0.
struct Part {
  std::string name;
  std::size_t entry = 0;
};

Part part_of(std::string_view text, const KeyToSet& key) {
  const std::size_t open = text.find('[');
  if (open == std::string_view::npos) {
    return {std::string(text), 0};
  }
  Part part{std::string(text.substr(0, open)), 0};
  const char* end = text.data() + text.size();
  const auto read = std::from_chars(text.data() + open + 1, end, part.entry);
  if (read.ec != std::errc{} || part.entry == 0 || read.ptr + 1 != end ||
      *read.ptr != ']') {
    refuse(key, "an entry of a list is written name[1], name[2], ...");
  }
  return part;
}

Node& child_of(Node& table, const std::string& name, const KeyToSet& key) {
  if (name.empty()) {
    refuse(key, "must be a path such as cut.spindle_rpm");
  }
  auto* members = std::get_if<Members>(&table.value);
  if (members == nullptr) {
    refuse(key, fmt::format("what is above {} is no table", name));
  }
  const auto found =
      std::ranges::find(*members, name, [](const Member& m) { return m.key; });
  if (found != members->end()) {
    return found->node;
  }
  members->push_back({name, key.where, {.value = Members{}, .where = key.where}});
  return members->back().node;
}

}  // namespace

void set_key(Node& root, const KeyToSet& key, const Node& value) {
  if (key.key.empty() || key.key.ends_with('.')) {
    refuse(key, "must be a path such as cut.spindle_rpm");
  }
  const std::string path = path_in_mm(key.key);
  Node* at = &root;
  for (std::string_view rest = path; !rest.empty();) {
    const std::size_t end = rest.find('.');
    const Part part = part_of(rest.substr(0, end), key);
    rest = end == std::string_view::npos ? std::string_view{} : rest.substr(end + 1);
    at = &child_of(*at, part.name, key);
    if (part.entry > 0) {
      auto* list = std::get_if<Array>(&at->value);
      if (list == nullptr || part.entry > list->size()) {
        refuse(key, fmt::format("the case has {} [[{}]]",
                                list == nullptr ? 0 : list->size(), part.name));
      }
      at = &(*list)[part.entry - 1];
    }
  }
  *at = value_in_mm(key.key, value);
  at->where = key.where;
}

void set_key(Node& root, const SweptKey& key, const Node& value) {
  set_key(root, {key.key, key.where, "sweep.over."}, value);
}

}  // namespace trochoid::cases
