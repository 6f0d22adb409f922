#include <trochoid/sweep/work.h>

#include <trochoid/numerics/parallel.h>
#include <trochoid/sweep/sweep.h>

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace trochoid::sweep {

namespace {

using results::SweepResult;
using results::SweepRow;

/// A part takes about as long: short for whoever stops it, long beside its writing.
constexpr std::chrono::duration<double> part_time{1.0};

constexpr std::size_t most_part = 1 << 16;

/// An interval of draws is that of those with a number: told where some have none.
void warn_of_missing_numbers(SweepResult& r) {
  for (std::size_t t = 0; r.draws > 0 && t < r.take.size(); ++t) {
    const std::size_t cell = r.keys.size() + r.drawn.size() + t;
    std::size_t missing = 0;
    for (std::size_t i = 0; i < r.rows.size() && !r.rows.has_texts(cell); ++i) {
      if (r.rows.status(i) == "ok" && std::isnan(r.rows.number(i, cell))) ++missing;
    }
    if (missing > 0) {
      r.heading.warnings.push_back(
          {"draws_without_number",
           fmt::format("{} of {} rows have no {}: the intervals are from the others",
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
  std::size_t failed = 0;
  std::size_t first = 0;
  for (std::size_t i = r.rows.size(); i-- > 0;) {
    if (r.rows.status(i) == "ok") continue;
    ++failed;
    first = i;
  }
  const std::size_t answered = r.rows.size() - failed;
  r.heading.ok = answered > 0;
  if (answered == 0) {
    r.heading.message = fmt::format("None of {} cases has an answer; the first: {}",
                                    r.rows.size(), r.rows.messages()[0]);
    return;
  }
  r.heading.message =
      fmt::format("{} cases answered.{}", answered, results::ranges_of(r));
  if (failed > 0) {
    r.heading.warnings.push_back(
        {"rows_without_answer",
         fmt::format("{} of {} cases have no answer; the first of them: {}", failed,
                     r.rows.size(), r.rows.messages()[first])});
  }
  warn_of_missing_numbers(r);
}

}  // namespace

std::filesystem::path part_file_of(const std::filesystem::path& folder) {
  std::filesystem::path part = std::filesystem::absolute(folder).lexically_normal();
  if (part.filename().empty()) {
    part = part.parent_path();
  }
  return part.replace_filename(fmt::format(".{}.part", part.filename().string()));
}

results::SweepResult sweep(const cases::CaseSource& source, const Request& request,
                           const run::Progress& progress, base::Stop stop) {
  Work work(source, request, progress);
  work.go_on(progress, stop, part_time);
  return work.take_result();
}

Work::Work(const cases::CaseSource& source, const Request& request,
           const run::Progress& progress)
    : prepared_(prepare(source, request, progress)),
      parts_(request.part_file, meaning_of(prepared_),
             prepared_.study.over.size() + prepared_.study.take.size()),
      rows_(parts_.take_done()) {
  rows_.cut(rows());
}

void Work::add(std::span<const SweepRow> part) {
  parts_.add(rows_.size(), part);
  for (const SweepRow& row : part) rows_.add(row);
}

void Work::go_on(const run::Progress& progress, base::Stop stop,
                 std::chrono::duration<double> part_time) {
  const Rows& all = prepared_.rows;
  const std::size_t least = numerics::thread_count();
  std::size_t size = least;
  const std::size_t before = done();
  // One part at least: every run gets on.
  while (done() < rows() && (done() == before || !stop.wanted())) {
    const std::size_t first = done();
    progress({"rows of the sweep",
              static_cast<double>(first) / static_cast<double>(rows())});
    const auto begun = std::chrono::steady_clock::now();
    add(sweep::rows(prepared_.study, std::min(size, rows() - first),
                    [&](std::size_t i) { return all.row(first + i); }));
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begun;
    // Only the size of the parts depends on the clock, nothing in them.
    size = took < part_time / 2   ? std::min(2 * size, most_part)
           : took > 2 * part_time ? std::max(size / 2, least)
                                  : size;
  }
}

SweepResult Work::take_result() {
  SweepResult result = prepared_.result;
  result.rows = std::exchange(rows_, {});
  conclude(result, rows());
  return result;
}

}  // namespace trochoid::sweep
