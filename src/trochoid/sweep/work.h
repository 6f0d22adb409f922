#pragma once

#include <trochoid/base/stop.h>
#include <trochoid/sweep/parts.h>
#include <trochoid/sweep/prepare.h>

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <span>

namespace trochoid::sweep {

/// @brief A sweep at work: rows that are done, in order, and kept as they come.
///
/// Rows are the same bits whoever answers them, and whether or not an earlier run was cut
/// short: what it had done is taken over from the file of parts.
class Work {
 public:
  /// @throws base::InputError where the case, a swept key or what is to be taken is wrong
  Work(const cases::CaseSource& source, const Request& request,
       const run::Progress& progress);

  [[nodiscard]] const Prepared& prepared() const noexcept { return prepared_; }
  [[nodiscard]] std::size_t rows() const noexcept { return prepared_.rows.size(); }
  [[nodiscard]] std::size_t done() const noexcept { return rows_.size(); }

  /// What outlives a kill; empty: nothing does.
  [[nodiscard]] const std::filesystem::path& part_file() const noexcept {
    return parts_.file();
  }

  /// @brief Keep the next rows, answered elsewhere.
  /// @throws base::InputError when the file of parts cannot be written
  void add(std::span<const results::SweepRow> part);

  /// @brief Answer what is left, on all threads.
  /// @param progress   told between parts; what it throws ends the work, rows are kept
  /// @param stop       from when on no part is begun but the first
  /// @param part_time  a part takes about as long
  void go_on(const run::Progress& progress, base::Stop stop,
             std::chrono::duration<double> part_time);

  /// @brief The table, whole or as far as it came. Takes the rows away.
  [[nodiscard]] results::SweepResult take_result();

 private:
  Prepared prepared_;
  Parts parts_;
  results::SweepRows rows_;
};

}  // namespace trochoid::sweep
