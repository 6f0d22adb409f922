#include <trochoid/sweep/parts.h>

#include <trochoid/base/error.h>
#include <trochoid/sweep/part_text.h>

#include <fmt/core.h>

#include <system_error>

namespace trochoid::sweep {

namespace {

namespace fs = std::filesystem;
using results::SweepRow;

std::string head_of(std::string_view meaning, std::size_t cells) {
  return fmt::format("trochoid sweep {:016x} {}\n", checksum(meaning), cells);
}

[[noreturn]] void cannot_write(const fs::path& file) {
  throw base::InputError(
      {file.string() + ": cannot be written; what is done so far would be lost"});
}

}  // namespace

Parts::Parts(fs::path file, std::string_view meaning, std::size_t cells)
    : file_(std::move(file)) {
  if (file_.empty()) {
    return;
  }
  const std::string head = head_of(meaning, cells);
  std::size_t whole = 0;
  std::error_code absent;
  if (fs::is_regular_file(fs::symlink_status(file_, absent))) {
    std::ifstream in(file_, std::ios::binary);
    std::string line;
    if (whole_line(in, line) && line + '\n' == head) {
      whole = head.size();
      while (const auto part = read_part(in, done_.size(), cells)) {
        for (const SweepRow& row : *part) done_.add(row);
        whole = static_cast<std::size_t>(in.tellg());
      }
    }
  }
  std::error_code error;
  if (whole > 0) {
    fs::resize_file(file_, whole, error);
    out_.open(file_, std::ios::binary | std::ios::app);
  } else {
    out_.open(file_, std::ios::binary | std::ios::trunc);
    out_ << head << std::flush;
  }
  if (error || !out_) {
    cannot_write(file_);
  }
}

void Parts::add(std::size_t first, std::span<const SweepRow> rows) {
  if (file_.empty()) {
    return;
  }
  out_ << part_text(first, rows) << std::flush;
  if (!out_) {
    cannot_write(file_);
  }
}

}  // namespace trochoid::sweep
