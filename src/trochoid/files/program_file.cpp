#include <trochoid/base/error.h>
#include <trochoid/base/read_text.h>
#include <trochoid/files/program_file.h>

#include <fmt/core.h>

#include <utility>

namespace trochoid::files {

namespace {

std::string at(const std::string& file, program::Place place) {
  return fmt::format("{}:{}:{}: ", file, place.line, place.column);
}

/// @throws base::InputError where the disk does not give it
std::shared_ptr<const std::string> program_text(const FileRef& file) {
  if (file.bytes) return file.bytes;
  auto text = base::read_text(file.path);
  if (!text) {
    throw base::InputError({fmt::format("{}: cannot be read", file.path)});
  }
  return std::make_shared<const std::string>(*std::move(text));
}

}  // namespace

ProgramFile read_program(const FileRef& file, program::ReadOptions options) {
  ProgramFile out{.text = program_text(file), .program = {}, .notes = {}};
  options.name = file.name;
  program::ProgramText read = program::read_program(*out.text, options);
  std::vector<std::string> problems;
  problems.reserve(read.problems.size());
  for (const program::Problem& problem : read.problems) {
    problems.push_back(at(file.path, problem.place) + problem.text);
  }
  if (!problems.empty()) throw base::InputError(std::move(problems));
  // By the name in the case: an answer does not depend on where its folder is.
  for (const program::Remark& remark : read.remarks) {
    out.notes.push_back(
        {std::string(remark.code), at(file.name, remark.place) + remark.text});
  }
  out.program = std::move(read.program);
  return out;
}

}  // namespace trochoid::files
