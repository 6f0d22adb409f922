// Text as UTF-8 and UTF-16, in place of what mingw's C library says of them, which knows
// single bytes only: by these two std::filesystem makes a path of a name and back.
#include <cerrno>
#include <cstddef>
#include <cwchar>

namespace {

constexpr auto wrong = static_cast<std::size_t>(-1);
constexpr auto cut_short = static_cast<std::size_t>(-2);

constexpr unsigned first_high = 0xD800;
constexpr unsigned first_low = 0xDC00;
constexpr unsigned behind_low = 0xE000;
constexpr unsigned first_pair = 0x10000;  ///< what takes two units of UTF-16
constexpr unsigned behind_last = 0x110000;

std::size_t refuse() {
  errno = EILSEQ;
  return wrong;
}

/// How many bytes a letter has that begins with this one; 0: none begins so.
std::size_t bytes_of(unsigned char first) {
  if (first < 0x80) return 1;
  if (first >= 0xC2 && first < 0xE0) return 2;
  if (first >= 0xE0 && first < 0xF0) return 3;
  return first >= 0xF0 && first < 0xF5 ? 4 : 0;
}

}  // namespace

extern "C" {

/// @param state  of a pair: its second half, which the last byte is still to bring
std::size_t mbrtowc(wchar_t* to, const char* from, std::size_t size, mbstate_t* state) {
  if (from == nullptr) return 0;
  if (size == 0) return cut_short;
  if (state != nullptr && *state != 0) {
    if (to != nullptr) *to = static_cast<wchar_t>(*state);
    *state = 0;
    return 1;
  }
  const auto* bytes = reinterpret_cast<const unsigned char*>(from);
  const std::size_t count = bytes_of(bytes[0]);
  if (count == 0) return refuse();
  if (size < count) return cut_short;
  unsigned letter = count == 1 ? bytes[0] : bytes[0] & (0x7FU >> count);
  for (std::size_t i = 1; i < count; ++i) {
    if ((bytes[i] & 0xC0U) != 0x80U) return refuse();
    letter = letter << 6U | (bytes[i] & 0x3FU);
  }
  const bool longer_than_needed =
      (count == 3 && letter < 0x800) || (count == 4 && letter < first_pair);
  const bool half_of_pair = letter >= first_high && letter < behind_low;
  if (longer_than_needed || half_of_pair || letter >= behind_last) return refuse();
  if (letter < first_pair) {
    if (to != nullptr) *to = static_cast<wchar_t>(letter);
    return letter == 0 ? 0 : count;
  }
  if (state == nullptr) return refuse();
  const unsigned rest = letter - first_pair;
  if (to != nullptr) *to = static_cast<wchar_t>(first_high + (rest >> 10U));
  *state = static_cast<mbstate_t>(first_low + (rest & 0x3FFU));
  return count - 1;
}

/// @param state  of a pair: its first half, of which nothing is written yet
std::size_t wcrtomb(char* to, wchar_t unit, mbstate_t* state) {
  if (to == nullptr) return 1;
  unsigned letter = static_cast<unsigned>(unit);
  if (letter >= first_high && letter < first_low) {
    if (state == nullptr || *state != 0) return refuse();
    *state = static_cast<mbstate_t>(letter);
    return 0;
  }
  if (letter >= first_low && letter < behind_low) {
    if (state == nullptr || *state == 0) return refuse();
    letter = first_pair + ((static_cast<unsigned>(*state) - first_high) << 10U) +
             (letter - first_low);
    *state = 0;
  } else if (state != nullptr && *state != 0) {
    return refuse();
  }
  const std::size_t count = letter < 0x80         ? 1
                            : letter < 0x800      ? 2
                            : letter < first_pair ? 3
                                                  : 4;
  for (std::size_t i = count; i-- > 1; letter >>= 6U) {
    to[i] = static_cast<char>(0x80U | (letter & 0x3FU));
  }
  const unsigned lead = count == 1 ? 0 : 0xF00U >> count & 0xFFU;
  to[0] = static_cast<char>(lead | letter);
  return count;
}

}
