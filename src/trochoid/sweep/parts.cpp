#include <trochoid/sweep/parts.h>

#include <trochoid/base/error.h>
#include <trochoid/results/csv_cells.h>
#include <trochoid/results/number.h>

#include <fmt/core.h>

#include <charconv>
#include <limits>
#include <sstream>
#include <system_error>

namespace trochoid::sweep {

namespace {

using results::Cell;
using results::SweepRow;

std::string line_of(const SweepRow& row) {
  std::string line;
  for (const Cell& cell : row.cells) {
    if (const auto* value = std::get_if<double>(&cell)) {
      results::append_number(line, *value);
    } else {
      results::append_quoted(line, std::get<std::string>(cell));
    }
    line += ',';
  }
  results::append_quoted(line, row.status);
  line += ',';
  results::append_quoted(line, row.message);
  return line + '\n';
}

Cell cell_of(std::string_view text) {
  if (text.starts_with('"')) {
    return results::unquoted(text);
  }
  double value = std::numeric_limits<double>::quiet_NaN();
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

SweepRow row_of(std::string_view line, std::size_t cells) {
  SweepRow row;
  for (std::size_t i = 0; i < cells; ++i) {
    row.cells.push_back(cell_of(results::cut_cell(line)));
  }
  row.status = results::unquoted(results::cut_cell(line));
  row.message = results::unquoted(results::cut_cell(line));
  return row;
}

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

std::uint64_t checksum(std::string_view text) noexcept {
  std::uint64_t sum = 0xcbf29ce484222325U;
  for (const char c : text) {
    sum = (sum ^ static_cast<unsigned char>(c)) * 0x100000001b3U;
  }
  return sum;
}

bool whole_line(std::istream& in, std::string& line) {
  return std::getline(in, line) && !in.eof();
}

std::string part_text(std::size_t first, std::span<const SweepRow> rows) {
  std::string text;
  for (const SweepRow& row : rows) {
    text += line_of(row);
  }
  return fmt::format("{} {} {:016x}\n", first, rows.size(), checksum(text)) + text;
}

std::optional<std::vector<SweepRow>> read_part(std::istream& in, std::size_t first,
                                               std::size_t cells) {
  std::size_t number = 0;
  std::size_t count = 0;
  std::string wanted;
  std::string line;
  if (!whole_line(in, line)) {
    return std::nullopt;
  }
  std::istringstream head(line);
  if (!(head >> number >> count >> wanted) || number != first || count == 0) {
    return std::nullopt;
  }
  std::string text;
  std::vector<SweepRow> rows;
  for (std::size_t i = 0; i < count && whole_line(in, line); ++i) {
    text += line + '\n';
    rows.push_back(row_of(line, cells));
  }
  return fmt::format("{:016x}", checksum(text)) == wanted ? std::optional(rows)
                                                          : std::nullopt;
}

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
