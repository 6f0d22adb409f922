#include <trochoid/base/error.h>
#include <trochoid/cases/case.h>
#include <trochoid/cases/document.h>
#include <trochoid/cases/read_value.h>

#include <fmt/core.h>

#include <algorithm>
#include <cstddef>
#include <system_error>
#include <utility>
#include <vector>

namespace trochoid::cases {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t longest_chain = 16;
/// Files that one case may read: two files that each include two, and so on, are as many
/// as a chain of all of them has ways.
constexpr std::size_t most_files = 256;

/// What has been read so far.
struct Including {
  std::vector<fs::path> open;  ///< outermost first: one of them again is a cycle
  std::size_t files = 0;       ///< included, in all
};

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

bool is_list_of_tables(const Node& node) {
  const auto* list = std::get_if<Array>(&node.value);
  return list != nullptr &&
         std::all_of(list->begin(), list->end(), [](const Node& one) {
           return std::holds_alternative<Members>(one.value);
         });
}

/// Two files included side by side: lists of tables are joined, so that each may bring
/// its modes; of anything else the later file wins.
Node joined(Node first, const Node& second) {
  Node both = merged(first, second);  // a copy of the first stays for its lists
  for (Member& member : std::get<Members>(both.value)) {
    const Node* before = find(first, member.key);
    if (before != nullptr && is_list_of_tables(*before) &&
        is_list_of_tables(member.node)) {
      auto& list = std::get<Array>(member.node.value);
      const auto& earlier = std::get<Array>(before->value);
      list.insert(list.begin(), earlier.begin(), earlier.end());
    }
  }
  return both;
}

Node complete(Node root, const fs::path& file, Including& reading);

/// @param include  one name, as the file that includes has it
Node load_included(const Node& include, const fs::path& file, Including& reading) {
  auto& open = reading.open;
  const auto* name = std::get_if<std::string>(&include.value);
  if (name == nullptr || name->empty()) {
    throw base::InputError({fmt::format(
        "{}: include = {}: not a file name; must be text, the case file whose tables "
        "this one builds on, or a list of such files",
        to_string(include.where), to_string(include))});
  }
  const fs::path included = (file.parent_path() / *name).lexically_normal();
  std::error_code error;
  if (!fs::is_regular_file(included, error)) {
    throw base::InputError({fmt::format(
        "{}: include = {}: there is no such file ({}); the name is relative "
        "to the file that includes",
        to_string(include.where), to_string(include), included.string())});
  }
  const fs::path canonical = fs::weakly_canonical(included, error);
  if (std::find(open.begin(), open.end(), canonical) != open.end()) {
    throw base::InputError(
        {fmt::format("{}: include = {}: a cycle; this file is being included already",
                     to_string(include.where), to_string(include))});
  }
  if (open.size() > longest_chain) {
    throw base::InputError(
        {fmt::format("{}: include = {}: a chain of more than {} files; let one file "
                     "include what several share",
                     to_string(include.where), to_string(include), longest_chain)});
  }
  if (++reading.files > most_files) {
    throw base::InputError({fmt::format(
        "{}: include = {}: more than {} files are included, those that are "
        "named twice counted twice; name each where it is needed first",
        to_string(include.where), to_string(include), most_files)});
  }
  open.push_back(canonical);
  Node base = complete(parse_file(included), included, reading);
  open.pop_back();
  return base;
}

/// Of another version nothing else would be judged rightly.
void refuse_other_versions(const Node& root) {
  const Node* version = find(root, "schema");
  if (version != nullptr && number_in(*version) != case_version) {
    throw base::InputError({fmt::format(
        "{}: schema = {}: no version of the case file that this program reads; must be {}, "
        "or left out (what a later Trochoid wrote, an earlier one may not read)",
        to_string(version->where), to_string(*version), case_version)});
  }
}

Node complete(Node root, const fs::path& file, Including& reading) {
  refuse_other_versions(root);
  const Node* include = find(root, "include");
  if (include == nullptr) {
    return root;
  }
  const auto* several = std::get_if<Array>(&include->value);
  Node base;
  if (several == nullptr || several->empty()) {
    base = load_included(*include, file, reading);
  } else {
    base = load_included(several->front(), file, reading);
    for (std::size_t i = 1; i < several->size(); ++i) {
      base = joined(std::move(base), load_included((*several)[i], file, reading));
    }
  }
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
  return with_includes(parse_file(file), file);
}

Node with_includes(Node root, const fs::path& file) {
  std::error_code error;
  Including reading{.open = {fs::weakly_canonical(file, error)}};
  return complete(std::move(root), file, reading);
}

}  // namespace trochoid::cases
