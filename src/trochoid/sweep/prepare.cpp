#include <trochoid/sweep/prepare.h>

#include <trochoid/base/error.h>
#include <trochoid/base/names.h>
#include <trochoid/inputs/findings.h>
#include <trochoid/results/provenance.h>
#include <trochoid/sweep/answer.h>

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace trochoid::sweep {

namespace {

using inputs::Node;

base::Command command_of(const inputs::CaseSource& source, const Request& request,
                         const inputs::Sweep& sweep) {
  const std::string& name = request.command.empty() ? sweep.command : request.command;
  const auto command = base::named<base::Command>(name);
  if (!command) {
    const std::vector<std::string> names(base::names<base::Command>.begin(),
                                         base::names<base::Command>.end());
    throw base::InputError({fmt::format(
        "{}: {}", source.file.string(),
        name.empty() ? fmt::format("which command? --command, or `command` of [sweep]: "
                                   "{}",
                                   fmt::join(names, ", "))
                     : fmt::format("command = \"{}\": there is no such command{}", name,
                                   inputs::suggestion(name, names)))});
  }
  return *command;
}

/// A key that no case has, or a value that none takes, is told before the work begins.
void check_keys(const Study& study, const std::vector<Node>& first) {
  std::vector<std::string> problems;
  for (std::size_t k = 0; k < first.size(); ++k) {
    Node root = study.root;
    try {
      set_key(root, study.over[k], first[k]);
      check_keys(source_of(study, root));
    } catch (const base::InputError& error) {
      problems.insert(problems.end(), error.problems().begin(), error.problems().end());
    }
  }
  if (!problems.empty()) {
    std::ranges::sort(problems);
    problems.erase(std::ranges::unique(problems).begin(), problems.end());
    throw base::InputError(problems);
  }
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

/// The case of the first row.
inputs::Case first_case(const Study& study, const Samples& samples,
                        const std::filesystem::path& folder) {
  const Node root = root_of(study, samples.row(0));
  return inputs::read_case(source_of(study, root), study.command, folder);
}

std::string joined(const inputs::Case& first, const std::string& sweep_toml) {
  return first.as_understood + "\n" + sweep_toml;
}

Study study_of(const inputs::CaseSource& source, const Request& request,
               const inputs::Sweep& plan) {
  Study study{.command = command_of(source, request, plan),
              .root = inputs::without_sweep(source.root),
              .file = source.file,
              .over = {},
              .take = request.take.empty() ? plan.take : request.take,
              .records = source.records,
              .base = source.base};
  for (const inputs::SweptKey& key : plan.over) {
    study.over.push_back({.key = key.key, .where = key.where, .values = {}});
  }
  return study;
}

}  // namespace

Prepared prepare(const inputs::CaseSource& source, const Request& request,
                 const run::Progress& progress) {
  inputs::Sweep plan = inputs::read_sweep(source.root, source.file);
  Study study = study_of(source, request, plan);
  Samples samples(plan);
  check_keys(study, samples.row(0));
  const inputs::Case first = first_case(study, samples, request.folder);
  progress("The first row");
  const results::Answer answered = answer(study.command, first);
  if (answered.heading.ok || study.take.empty()) {
    check_take(study, answered);
  }
  plan.command = name_of(study.command);
  plan.take = study.take;
  std::string toml = inputs::sweep_toml(plan);
  results::SweepResult result{
      .heading = {.title = first.title,
                  .warnings = first.notes,
                  .case_toml = joined(first, toml)},
      .command = std::string(name_of(study.command)),
      .method = std::string(name_of(plan.method)),
      .by_chance = plan.method == inputs::SweepMethod::random ||
                   plan.method == inputs::SweepMethod::latin_hypercube,
      .take = study.take};
  for (const inputs::SweptKey& key : study.over) {
    result.keys.push_back(key.key);
  }
  return {.study = std::move(study),
          .samples = std::move(samples),
          .result = std::move(result),
          .sweep_toml = std::move(toml)};
}

std::string case_toml(const Prepared& prepared, const std::filesystem::path& folder) {
  return joined(first_case(prepared.study, prepared.samples, folder),
                prepared.sweep_toml);
}

std::string meaning_of(const Prepared& prepared) {
  std::string meaning = fmt::format("{} {}\n{}", results::version(), results::commit(),
                                    prepared.result.heading.case_toml);
  for (const auto& [name, table] : prepared.study.records) {
    for (std::size_t i = 0; i < table->columns.size(); ++i) {
      const std::vector<double> samples = table->values(i);
      meaning += table->columns[i].path;
      meaning.append(reinterpret_cast<const char*>(samples.data()),
                     samples.size() * sizeof(double));
    }
  }
  return meaning;
}

}  // namespace trochoid::sweep
