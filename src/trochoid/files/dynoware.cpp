#include <trochoid/files/dynoware.h>

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace trochoid::files {

namespace {

constexpr std::size_t header_lines_at_most = 200;

/// A key `Key:` and the value beside it, as number.
void take(DynoWareHeader& header, const std::vector<Field>& fields, std::size_t line,
          Problems& problems) {
  const auto key = fields[0].text;
  const bool rate = key == "Sampling rate [Hz]:";
  const bool samples = key == "Samples per channel:";
  const bool delay = key == "Delay time [s]:";
  if (!rate && !samples && !delay) return;
  const auto value = fields.size() > 1 ? parse_number(fields[1].text) : Number{};
  const bool number = fields.size() > 1 && value.fault == NumberFault::none;
  constexpr double lowest = 1e-3;  // [Hz]
  constexpr double highest = 1e9;  // [Hz]
  if (!number || (rate && !(value.value >= lowest && value.value <= highest)) ||
      (samples && value.value < 1.0)) {
    const auto text = fields.size() > 1 ? fields[1].text : std::string_view{};
    problems.add(line, fields.size() > 1 ? fields[1].column : 1,
                 fmt::format("{} {}: {} is needed here", key, excerpt(text),
                             rate      ? "a number from 0.001 to 1e9"
                             : samples ? "a number from 1 on"
                                       : "a number"));
    return;
  }
  if (rate) {
    header.sample_rate = value.value;
    header.rate_line = line;
  } else if (samples) {
    header.samples = value.value;
    header.samples_line = line;
  } else {
    header.delay = value.value;
  }
}

}  // namespace

bool is_dynoware(std::string_view head) {
  constexpr std::string_view mark = "DynoWare";
  constexpr std::string_view byte_order = "\xEF\xBB\xBF";
  if (head.starts_with(byte_order)) head.remove_prefix(byte_order.size());
  // As in every table, lines that are empty or a comment count for nothing.
  while (!head.empty()) {
    const std::string_view line = head.substr(0, head.find('\n'));
    const auto first = line.find_first_not_of(" \t\r");
    if (first != std::string_view::npos && line[first] != '#') {
      return line.starts_with(mark) &&
             (line.size() == mark.size() ||
              std::string_view(",;\t\r").find(line[mark.size()]) !=
                  std::string_view::npos);
    }
    head.remove_prefix(std::min(head.size(), line.size() + 1));
  }
  return false;
}

DynoWareHeader read_dynoware_header(std::string_view first_line, LineReader& lines,
                                    Problems& problems) {
  DynoWareHeader header;
  if (first_line.size() > 8) header.separator = first_line[8];
  std::vector<Field> fields;
  while (const auto line = lines.next()) {
    if (lines.number() > header_lines_at_most) break;
    split(*line, header.separator, fields);
    if (fields[0].text.empty() && fields.size() == 1) continue;
    if (fields[0].text.empty() || fields[0].text.back() != ':') {
      header.names = std::string(*line);
      return header;
    }
    take(header, fields, lines.number(), problems);
  }
  if (!lines.too_long()) {
    problems.add(lines.number(), 1,
                 "the header of this DynoWare export has no end: a row of names, for "
                 "example Time,Fx,Fy,Fz, must follow its lines `Key:,value`");
  }
  return header;
}

std::string check_sample_count(const DynoWareHeader& header,
                               const DynoWareExport& found, Problems& problems) {
  if (!header.samples) return {};
  const double promised = *header.samples;
  const auto rows = static_cast<double>(found.rows);
  if (rows > promised) {
    problems.add(
        header.samples_line, 1,
        fmt::format("the header says {:.0f} samples, but {} rows follow: export "
                    "the record again",
                    promised, found.rows));
    return {};
  }
  if (rows == promised) return {};
  const double step = header.sample_rate > 0.0 ? 1.0 / header.sample_rate : 0.0;
  const bool from_the_start =
      found.first_time && *found.first_time <= header.delay + 0.5 * step;
  return fmt::format("The export is a part of its record: {}{} of {:.0f} samples{}.",
                     from_the_start ? "the first " : "", found.rows, promised,
                     from_the_start ? " (or the file was cut off)" : "");
}

}  // namespace trochoid::files
