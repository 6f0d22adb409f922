#include <trochoid/files/time_stamp.h>

#include <trochoid/files/csv.h>

#include <array>
#include <charconv>
#include <chrono>

namespace trochoid::files {

namespace {

constexpr int epoch_year = 2000;

std::optional<int> whole_number(std::string_view text) {
  int out = 0;
  const auto [end, error] =
      std::from_chars(text.data(), text.data() + text.size(), out);
  if (error != std::errc{} || end != text.data() + text.size() || out < 0) {
    return std::nullopt;
  }
  return out;
}

/// Three numbers with a mark between them.
std::optional<std::array<int, 3>> three(std::string_view text, char mark) {
  std::array<int, 3> out{};
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t end = i < 2 ? text.find(mark) : text.size();
    if (end == std::string_view::npos) return std::nullopt;
    const auto one = whole_number(text.substr(0, end));
    if (!one) return std::nullopt;
    out[i] = *one;
    if (i < 2) text.remove_prefix(end + 1);
  }
  return out;
}

/// Days since the first of 2000.
std::optional<double> days_of(std::string_view text) {
  for (const char mark : {'-', '.', '/'}) {
    const auto parts = three(text, mark);
    if (!parts) continue;
    auto [a, b, c] = *parts;
    if (a > 31) std::swap(a, c);  // the year first: then month and day
    int month = b;
    int day = a;
    if (mark == '/' && (*parts)[0] <= 31 && a <= 12) std::swap(month, day);
    const std::chrono::year_month_day date{
        std::chrono::year{c}, std::chrono::month{static_cast<unsigned>(month)},
        std::chrono::day{static_cast<unsigned>(day)}};
    if (!date.ok()) return std::nullopt;
    const std::chrono::sys_days epoch{std::chrono::year{epoch_year} /
                                      std::chrono::January / 1};
    return static_cast<double>((std::chrono::sys_days{date} - epoch).count());
  }
  return std::nullopt;
}

}  // namespace

std::optional<TimeStamp> time_of_stamp(std::string_view text) {
  TimeStamp out;
  if (const auto at = text.find_first_of(" T"); at != std::string_view::npos) {
    const auto days = days_of(text.substr(0, at));
    if (!days) return std::nullopt;
    out.days = *days;
    text = trimmed(text.substr(at + 1));
  }
  const auto first = text.find(':');
  const auto last = text.rfind(':');
  if (first == std::string_view::npos || first == last) return std::nullopt;
  const auto hours = whole_number(text.substr(0, first));
  const auto minutes = whole_number(text.substr(first + 1, last - first - 1));
  const Number seconds = parse_number(text.substr(last + 1));
  if (!hours || !minutes || seconds.fault != NumberFault::none || *minutes > 59 ||
      !(seconds.value >= 0.0 && seconds.value <= 61.0)) {
    return std::nullopt;
  }
  out.seconds = 3600.0 * *hours + 60.0 * *minutes + seconds.value;
  return out;
}

}  // namespace trochoid::files
