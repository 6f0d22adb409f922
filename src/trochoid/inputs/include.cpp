#include <trochoid/base/error.h>
#include <trochoid/inputs/document.h>

#include <fmt/core.h>

#include <algorithm>
#include <system_error>

namespace trochoid::inputs {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t longest_chain = 16;

void mark_inherited(Node& node) {
  node.inherited = true;
  if (auto* members = std::get_if<Members>(&node.value)) {
    for (Member& member : *members) {
      mark_inherited(member.node);
    }
  }
}

void erase(Node& table, std::string_view key) {
  auto& members = std::get<Members>(table.value);
  std::erase_if(members, [&](const Member& m) { return m.key == key; });
}

/// @param open  files being read, outermost first: one of them again is a cycle
Node load(const fs::path& file, std::vector<fs::path>& open) {
  Node root = parse_file(file);
  const Node* include = find(root, "include");
  if (include == nullptr) {
    return root;
  }
  const auto* name = std::get_if<std::string>(&include->value);
  if (name == nullptr || name->empty()) {
    throw base::InputError({fmt::format(
        "{}: include = {}: not a file name; must be text, the case file whose tables "
        "this one builds on",
        to_string(include->where), to_string(*include))});
  }
  const fs::path included = (file.parent_path() / *name).lexically_normal();
  std::error_code error;
  if (!fs::is_regular_file(included, error)) {
    throw base::InputError({fmt::format(
        "{}: include = {}: there is no such file ({}); the name is relative "
        "to the file that includes",
        to_string(include->where), to_string(*include), included.string())});
  }
  const fs::path canonical = fs::weakly_canonical(included, error);
  if (std::find(open.begin(), open.end(), canonical) != open.end()) {
    throw base::InputError(
        {fmt::format("{}: include = {}: a cycle; this file is being included already",
                     to_string(include->where), to_string(*include))});
  }
  if (open.size() > longest_chain) {
    throw base::InputError(
        {fmt::format("{}: include = {}: a chain of more than {} files; let one file "
                     "include what several share",
                     to_string(include->where), to_string(*include), longest_chain)});
  }
  open.push_back(canonical);
  Node base = load(included, open);
  open.pop_back();
  erase(root, "include");
  return merged(std::move(base), root);
}

}  // namespace

Node merged(Node base, const Node& over) {
  mark_inherited(base);
  auto& into = std::get<Members>(base.value);
  for (const Member& member : std::get<Members>(over.value)) {
    const auto old = std::find_if(into.begin(), into.end(),
                                  [&](const Member& m) { return m.key == member.key; });
    if (old == into.end()) {
      into.push_back(member);
    } else if (std::holds_alternative<Members>(old->node.value) &&
               std::holds_alternative<Members>(member.node.value)) {
      old->node = merged(std::move(old->node), member.node);
      old->where = member.where;
    } else {
      *old = member;
    }
  }
  base.where = over.where;
  base.inherited = over.inherited;
  return base;
}

Node load_document(const fs::path& file) {
  std::error_code error;
  std::vector<fs::path> open = {fs::weakly_canonical(file, error)};
  return load(file, open);
}

}  // namespace trochoid::inputs
