#include <trochoid/sweep/sweep.h>

#include <trochoid/base/error.h>
#include <trochoid/base/names.h>
#include <trochoid/inputs/case_source.h>
#include <trochoid/inputs/findings.h>
#include <trochoid/numerics/parallel.h>
#include <trochoid/results/provenance.h>
#include <trochoid/sweep/answer.h>
#include <trochoid/sweep/parts.h>
#include <trochoid/sweep/row.h>
#include <trochoid/sweep/rows.h>

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <cmath>

namespace trochoid::sweep {

namespace {

using inputs::Node;
using inputs::SweptKey;
using results::SweepResult;
using results::SweepRow;

/// A part takes about as long: short for whoever stops it, long beside its writing.
constexpr std::chrono::duration<double> part_time{1.0};
constexpr std::size_t least_part = 16;
constexpr std::size_t most_part = 1 << 16;

base::Command command_of(const Request& request, const inputs::Sweep& sweep) {
  const std::string& name = request.command.empty() ? sweep.command : request.command;
  const auto command = base::named<base::Command>(name);
  if (!command) {
    const std::vector<std::string> names(base::names<base::Command>.begin(),
                                         base::names<base::Command>.end());
    throw base::InputError({fmt::format(
        "{}: {}", request.file.string(),
        name.empty() ? fmt::format("which command? --command, or `command` of [sweep]: "
                                   "{}",
                                   fmt::join(names, ", "))
                     : fmt::format("command = \"{}\": there is no such command{}", name,
                                   inputs::suggestion(name, names)))});
  }
  return *command;
}

/// A key that no case has, or a value that none takes, is told before the work begins.
/// @return the case of the first row, as understood
inputs::Case check_keys(const Study& study, const std::vector<Node>& first,
                        const std::filesystem::path& folder) {
  std::vector<std::string> problems;
  for (std::size_t k = 0; k < first.size(); ++k) {
    Node root = study.root;
    try {
      set_key(root, study.over[k], first[k]);
      check_keys(inputs::CaseSource{root, study.file, {}});
    } catch (const base::InputError& error) {
      problems.insert(problems.end(), error.problems().begin(), error.problems().end());
    }
  }
  if (!problems.empty()) {
    std::ranges::sort(problems);
    problems.erase(std::ranges::unique(problems).begin(), problems.end());
    throw base::InputError(problems);
  }
  Node root = study.root;
  for (std::size_t k = 0; k < first.size(); ++k) {
    set_key(root, study.over[k], first[k]);
  }
  return inputs::read_case(inputs::CaseSource{root, study.file, {}}, study.command,
                           folder);
}

/// What is to be taken must be in the first answer that there is.
void check_take(const Study& study, const results::Answer& answer) {
  const std::vector<std::string> known = paths_of(answer);
  std::vector<std::string> problems;
  if (study.take.empty()) {
    problems.push_back(fmt::format(
        "{}: what shall be taken? --take, or `take` of [sweep]: {}",
        study.file.string(),
        fmt::join(known.begin(),
                  known.begin() + std::min<std::ptrdiff_t>(20, std::ssize(known)),
                  ", ")));
  }
  for (const std::string& path : study.take) {
    if (!taken(answer, path)) {
      problems.push_back(fmt::format("{}: take = \"{}\": not in the answer of {}{}",
                                     study.file.string(), path, name_of(study.command),
                                     inputs::suggestion(path, known)));
    }
  }
  if (!problems.empty()) {
    throw base::InputError(problems);
  }
}

/// All that the rows depend on: of another meaning nothing is taken over.
std::string meaning_of(const std::string& case_toml) {
  return fmt::format("{} {}\n{}", results::version(), results::commit(), case_toml);
}

std::vector<SweepRow> all_rows(const Study& study, const Rows& samples, Parts& parts,
                               const run::Progress& progress, base::Stop stop) {
  std::vector<SweepRow> rows = parts.take_done();
  rows.resize(std::min(rows.size(), samples.size()));
  std::size_t size = least_part;
  const std::size_t done = rows.size();
  // One part at least: every run gets on.
  while (rows.size() < samples.size() && (rows.size() == done || !stop.wanted())) {
    const std::size_t first = rows.size();
    const std::size_t count = std::min(size, samples.size() - first);
    progress({"rows of the sweep",
              static_cast<double>(first) / static_cast<double>(samples.size())});
    const auto begun = std::chrono::steady_clock::now();
    std::vector<SweepRow> part(count);
    numerics::for_each_index(
        count, [&](std::size_t i) { part[i] = row_of(study, samples.row(first + i)); });
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begun;
    parts.add(first, part);
    rows.insert(rows.end(), part.begin(), part.end());
    // Only the size of the parts depends on the clock, nothing in them.
    size = took < part_time / 2   ? std::min(2 * size, most_part)
           : took > 2 * part_time ? std::max(size / 2, least_part)
                                  : size;
  }
  return rows;
}

/// An interval of draws is that of those with a number: told where some have none.
void warn_of_missing_numbers(SweepResult& r) {
  for (std::size_t t = 0; r.draws > 0 && t < r.take.size(); ++t) {
    const std::size_t cell = r.keys.size() + r.drawn.size() + t;
    const auto missing = std::ranges::count_if(r.rows, [&](const SweepRow& row) {
      const auto* value = std::get_if<double>(&row.cells[cell]);
      return row.status == "ok" && value != nullptr && std::isnan(*value);
    });
    if (missing > 0) {
      r.heading.warnings.push_back(
          {"draws_without_number",
           fmt::format(
               "{} of {} rows have no {}: the intervals are those of the others",
               missing, r.rows.size(), r.take[t])});
    }
  }
}

void conclude(SweepResult& r, std::size_t wanted) {
  if (r.rows.size() < wanted) {
    r.heading.ok = false;
    r.complete = false;
    r.heading.message = fmt::format(
        "the time limit has passed after {} of {} rows; they are kept, and "
        "the same command goes on there",
        r.rows.size(), wanted);
    return;
  }
  const auto answered = static_cast<std::size_t>(
      std::ranges::count(r.rows, std::string("ok"), &SweepRow::status));
  const std::size_t failed = r.rows.size() - answered;
  r.heading.ok = answered > 0;
  if (answered == 0) {
    r.heading.message = fmt::format("None of {} cases has an answer; the first: {}",
                                    r.rows.size(), r.rows.front().message);
    return;
  }
  r.heading.message = fmt::format("{} cases answered.", answered);
  if (failed > 0) {
    const auto& why = *std::ranges::find_if(
        r.rows, [](const SweepRow& row) { return row.status != "ok"; });
    r.heading.warnings.push_back(
        {"rows_without_answer",
         fmt::format("{} of {} cases have no answer; the first of them: {}", failed,
                     r.rows.size(), why.message)});
  }
  warn_of_missing_numbers(r);
}

/// Names of files as the case in the result folder must have them.
void name_files_from(const std::filesystem::path& folder, inputs::Sweep& plan) {
  namespace fs = std::filesystem;
  for (inputs::DrawnFile& drawn : plan.covariance) {
    const fs::path whole = fs::absolute(drawn.path).lexically_normal();
    drawn.path =
        folder.empty()
            ? whole
            : whole.lexically_relative(fs::absolute(folder).lexically_normal());
  }
}

/// What is known of the answer before the first row.
SweepResult empty_result(const inputs::Sweep& plan, const Found& found,
                         const inputs::Case& first) {
  const bool drawn = !found.sets.empty();
  SweepResult r{.heading = {.title = first.title, .warnings = found.warnings},
                .command = plan.command,
                .method = std::string(name_of(plan.method)),
                .by_chance = by_chance(plan.method) || (drawn && plan.rows == 1),
                .draws = drawn ? plan.draws : 0,
                .take = plan.take};
  r.heading.warnings.insert(r.heading.warnings.end(), first.notes.begin(),
                            first.notes.end());
  for (const SweptKey& key : plan.over) {
    r.keys.push_back(key.key);
  }
  for (const SweptKey& key : found.keys) {
    r.drawn.push_back(key.key);
  }
  return r;
}

}  // namespace

SweepResult sweep(const Request& request, const run::Progress& progress,
                  base::Stop stop) {
  const Node root = inputs::load_document(request.file);
  inputs::Sweep plan = inputs::read_sweep(root, request.file);
  const Found found = find_all(plan, inputs::without_sweep(root));
  Study study{.command = command_of(request, plan),
              .root = found.root,
              .file = request.file,
              .over = plan.over,
              .take = request.take.empty() ? plan.take : request.take};
  study.over.insert(study.over.end(), found.keys.begin(), found.keys.end());
  const Rows samples(plan, found);
  const inputs::Case first = check_keys(study, samples.first(), request.folder);
  progress("The first row");
  const results::Answer answered = answer(study.command, first);
  if (answered.heading.ok || study.take.empty()) {
    check_take(study, answered);
  }
  plan.command = name_of(study.command);
  plan.take = study.take;
  name_files_from(request.folder, plan);
  const std::string case_toml = first.as_understood + "\n" + inputs::sweep_toml(plan);
  SweepResult r = empty_result(plan, found, first);
  r.heading.case_toml = case_toml;
  Parts parts(request.part_file, meaning_of(case_toml + found.meaning),
              study.over.size() + study.take.size());
  r.rows = all_rows(study, samples, parts, progress, stop);
  conclude(r, samples.size());
  return r;
}

}  // namespace trochoid::sweep
