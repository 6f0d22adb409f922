#include <trochoid/sweep/prepare.h>

#include <trochoid/base/error.h>
#include <trochoid/base/names.h>
#include <trochoid/cases/findings.h>
#include <trochoid/cases/inches.h>
#include <trochoid/results/hdf5_table.h>
#include <trochoid/results/provenance.h>
#include <trochoid/run/answer.h>

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>

namespace trochoid::sweep {

namespace {

using cases::Node;

base::Command command_of(const cases::CaseSource& source, const Request& request,
                         const cases::Sweep& sweep) {
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
                                   cases::suggestion(name, names)))});
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

/// The same key in inches and in millimetres is one key.
void check_once(const std::vector<cases::SweptKey>& over) {
  std::map<std::string, std::string> seen;
  for (const cases::SweptKey& key : over) {
    const auto [before, fresh] = seen.emplace(cases::path_in_mm(key.key), key.key);
    if (!fresh) {
      throw base::InputError(
          {fmt::format("{}: sweep.over.{}: {} is swept as well; either of them",
                       to_string(key.where), key.key, before->second)});
    }
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
                                     cases::suggestion(path, known)));
    }
  }
  if (!problems.empty()) {
    throw base::InputError(problems);
  }
}

/// The case of the first row, with everything that is drawn as found.
cases::Case first_case(const Study& study, const Rows& rows,
                       const std::filesystem::path& folder) {
  const Node root = root_of(study, rows.first());
  return cases::read_case(source_of(study, root), study.command, folder);
}

/// [sweep] with names of files as they count from the folder.
std::string sweep_toml(cases::Sweep plan, const std::filesystem::path& folder) {
  namespace fs = std::filesystem;
  for (cases::DrawnFile& drawn : plan.covariance) {
    if (!folder.empty()) {
      drawn.path =
          drawn.path.lexically_relative(fs::absolute(folder).lexically_normal());
    }
  }
  return cases::sweep_toml(plan);
}

/// What is known of the answer before the first row.
results::SweepResult empty_result(const cases::Sweep& plan, const Found& found,
                                  const cases::Case& first) {
  const bool drawn = !found.sets.empty();
  results::SweepResult r{
      .heading = {.title = first.title, .warnings = found.warnings},
      .command = plan.command,
      .method = std::string(name_of(plan.method)),
      .by_chance = by_chance(plan.method) || (drawn && plan.over.empty()),
      .draws = drawn ? plan.draws : 0,
      .take = plan.take,
      .hdf5 = plan.hdf5};
  r.heading.warnings.insert(r.heading.warnings.end(), first.notes.begin(),
                            first.notes.end());
  for (const cases::SweptKey& key : plan.over) {
    r.keys.push_back(key.key);
  }
  for (const cases::SweptKey& key : found.keys) {
    r.drawn.push_back(key.key);
  }
  return r;
}

Study study_of(const cases::CaseSource& source, const Request& request,
               const cases::Sweep& plan, const Found& found) {
  Study study{.command = command_of(source, request, plan),
              .root = found.root,
              .file = source.file,
              .over = {},
              .take = request.take.empty() ? plan.take : request.take,
              .data = source.data,
              .base = source.base};
  for (const std::vector<cases::SweptKey>* keys : {&plan.over, &found.keys}) {
    for (const cases::SweptKey& key : *keys) {
      study.over.push_back({.key = key.key, .where = key.where, .values = {}});
    }
  }
  return study;
}

}  // namespace

Prepared prepare(const cases::CaseSource& source, const Request& request,
                 const run::Progress& progress) {
  cases::Sweep plan = cases::read_sweep(source.root, source.file);
  if (plan.hdf5 && !results::has_hdf5()) {
    throw base::InputError(
        {source.file.string() +
         ": sweep.hdf5 = true: this program was built without HDF5"});
  }
  check_once(plan.over);
  const Found found = find_all(plan, cases::without_sweep(source.root));
  for (cases::DrawnFile& drawn : plan.covariance) {
    drawn.path = std::filesystem::absolute(drawn.path).lexically_normal();
  }
  Study study = study_of(source, request, plan, found);
  Rows rows(plan, found);
  check_keys(study, rows.first());
  const cases::Case first = first_case(study, rows, request.folder);
  progress("The first row");
  const results::Answer answered = run::answer(study.command, first);
  if (answered.heading.ok || study.take.empty()) {
    check_take(study, answered);
  }
  plan.command = name_of(study.command);
  plan.take = study.take;
  Prepared prepared{.study = std::move(study),
                    .rows = std::move(rows),
                    .result = empty_result(plan, found, first),
                    .plan = std::move(plan),
                    .meaning = found.meaning,
                    .as_understood = first.as_understood};
  prepared.result.heading.case_toml =
      first.as_understood + "\n" + sweep_toml(prepared.plan, request.folder);
  return prepared;
}

std::string case_toml(const Prepared& prepared, const std::filesystem::path& folder) {
  return first_case(prepared.study, prepared.rows, folder).as_understood + "\n" +
         sweep_toml(prepared.plan, folder);
}

std::string meaning_of(const Prepared& prepared) {
  cases::Sweep plan = prepared.plan;
  plan.hdf5 = false;  // the rows are the same
  for (cases::DrawnFile& drawn : plan.covariance) {
    drawn.path.clear();  // what is drawn is told by its numbers, wherever it lies
  }
  std::string meaning =
      fmt::format("{} {}\n{}\n{}{}", results::version(), results::commit(),
                  prepared.as_understood, cases::sweep_toml(plan), prepared.meaning);
  for (const auto& [name, table] : prepared.study.data.records) {
    for (std::size_t i = 0; i < table->columns.size(); ++i) {
      const std::vector<double> samples = table->values(i);
      meaning += table->columns[i].path;
      meaning.append(reinterpret_cast<const char*>(samples.data()),
                     samples.size() * sizeof(double));
    }
  }
  for (const auto& [name, text] : prepared.study.data.texts) meaning += name + *text;
  return meaning;
}

}  // namespace trochoid::sweep
