#include <trochoid/cases/findings.h>

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <numeric>
#include <tuple>

namespace trochoid::cases {

namespace {

/// Letters to insert, delete, replace or swap with their neighbour.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::vector<std::size_t>> d(a.size() + 1,
                                          std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) {
    d[i][0] = i;
  }
  std::iota(d[0].begin(), d[0].end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t change = d[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0U : 1U);
      d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, change});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
        d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
      }
    }
  }
  return d[a.size()][b.size()];
}

std::string in_lower_case(std::string_view text) {
  std::string lower{text};
  for (char& c : lower) {
    c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  }
  return lower;
}

std::string parent(const std::string& path) {
  const auto dot = path.rfind('.');
  return dot == std::string::npos ? std::string{} : path.substr(0, dot);
}

}  // namespace

void report(Findings& findings, const std::string& path, const Location& where,
            std::string text) {
  findings.wrong.insert(path);
  findings.problems.push_back({where, std::move(text)});
}

void report(Findings& findings, const std::string& path, std::string text) {
  report(findings, path, place_of(findings, path), std::move(text));
}

bool sound(const Findings& findings, std::initializer_list<std::string> paths) {
  return std::all_of(paths.begin(), paths.end(), [&](const std::string& path) {
    for (std::string p{path}; !p.empty(); p = parent(p)) {
      if (findings.wrong.count(p) > 0) {
        return false;
      }
    }
    return true;
  });
}

Location place_of(const Findings& findings, const std::string& path) {
  for (std::string p = path; !p.empty(); p = parent(p)) {
    const auto found = findings.places.find(p);
    if (found != findings.places.end()) {
      return found->second;
    }
  }
  return {findings.file, findings.first_line};
}

std::vector<std::string> lines(const Findings& findings) {
  auto problems = findings.problems;
  const auto order = [&](const Findings::Problem& p) {
    // The case file itself first, what it includes after it.
    return std::tuple(p.where.file != findings.file, p.where.file, p.where.line,
                      p.where.column);
  };
  std::stable_sort(problems.begin(), problems.end(),
                   [&](const auto& a, const auto& b) { return order(a) < order(b); });
  std::vector<std::string> all;
  all.reserve(problems.size());
  for (const auto& p : problems) {
    all.push_back(to_string(p.where) + ": " + p.text);
  }
  return all;
}

std::string nearest(std::string_view wrong, const std::vector<std::string>& names) {
  constexpr std::size_t longest_name = 64;
  if (wrong.size() > longest_name) {
    return {};
  }
  const std::string lower = in_lower_case(wrong);
  std::string best;
  std::size_t smallest = 1 + wrong.size() / 3;
  for (const std::string& name : names) {
    // A name without its unit, or the beginning of one, is near as well.
    const bool begins = wrong.size() >= 3 && in_lower_case(name).starts_with(lower);
    const std::size_t distance = begins ? 1 : edit_distance(lower, in_lower_case(name));
    if (distance < smallest || (best.empty() && distance == smallest)) {
      smallest = distance;
      best = name;
    }
  }
  return best;
}

std::string suggestion(std::string_view wrong, const std::vector<std::string>& names) {
  const std::string near = nearest(wrong, names);
  if (!near.empty()) {
    return fmt::format("; did you mean {}?", near);
  }
  return fmt::format("; there are {}", fmt::join(names, ", "));
}

std::string shown_key(std::string_view key) {
  constexpr std::size_t longest = 60;
  const bool plain = !key.empty() && key.size() <= longest &&
                     std::all_of(key.begin(), key.end(), [](char c) {
                       return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
                              (c >= '0' && c <= '9') || c == '_' || c == '-';
                     });
  return plain ? std::string(key) : to_string(Node{std::string(key), {}});
}

}  // namespace trochoid::cases
