#include <trochoid/base/printable.h>

#include <cstddef>

namespace trochoid::base {

namespace {

void append_escaped(std::string& text, unsigned char code) {
  static constexpr std::string_view digits = "0123456789ABCDEF";
  text += "\\x";
  text += digits[code >> 4U];
  text += digits[code & 0xFU];
}

/// U+0080 to U+009F, in UTF-8: a lead byte and one of 80 to 9F.
bool is_c1(std::string_view text, std::size_t at) noexcept {
  return static_cast<unsigned char>(text[at]) == 0xC2U && at + 1 < text.size() &&
         (static_cast<unsigned char>(text[at + 1]) & 0xE0U) == 0x80U;
}

/// Bytes of the character that begins here, in UTF-8; 0: no such character is there.
std::size_t length_of(std::string_view text) noexcept {
  const auto lead = static_cast<unsigned char>(text.front());
  std::size_t length = 1;
  if (lead >= 0x80U) length = lead < 0xE0U ? 2 : (lead < 0xF0U ? 3 : 4);
  const bool begins = lead < 0x80U || (lead >= 0xC2U && lead < 0xF5U);
  if (!begins) return 0;
  if (length > text.size()) return 0;
  for (std::size_t i = 1; i < length; ++i) {
    if ((static_cast<unsigned char>(text[i]) & 0xC0U) != 0x80U) return 0;
  }
  return length;
}

}  // namespace

std::string printable(std::string_view text) {
  std::string out;
  out.reserve(text.size());
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto code = static_cast<unsigned char>(text[i]);
    if (is_c1(text, i)) {
      append_escaped(out, static_cast<unsigned char>(text[++i]));
      continue;
    }
    const bool control =
        (code < 0x20U && text[i] != '\n' && text[i] != '\t') || code == 0x7FU;
    const std::size_t length = control ? 0 : length_of(text.substr(i));
    if (length == 0) {  // or a byte of another encoding
      append_escaped(out, code);
      continue;
    }
    out += text.substr(i, length);
    i += length - 1;
  }
  return out;
}

std::string one_line(std::string_view text) {
  std::string out;
  for (const char c : printable(text)) {
    if (c == '\n') {
      out += "\\n";
    } else {
      out += c;
    }
  }
  return out;
}

}  // namespace trochoid::base
