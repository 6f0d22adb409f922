#pragma once

#include <bit>
#include <cstdint>
#include <string>
#include <utility>
#include <variant>
#include <vector>

/// TDMS files for tests, written from the format's description.
namespace trochoid::files::made {

struct Tdms {
  bool big = false;
  std::string bytes;

  template <class Whole>
  Tdms& whole(Whole value) {
    for (std::size_t i = 0; i < sizeof(Whole); ++i) {
      const std::size_t at = big ? sizeof(Whole) - 1 - i : i;
      bytes += static_cast<char>(value >> (8 * at) & 0xFFU);
    }
    return *this;
  }
  Tdms& u32(std::uint32_t value) { return whole(value); }
  Tdms& u64(std::uint64_t value) { return whole(value); }
  Tdms& f64(double value) { return whole(std::bit_cast<std::uint64_t>(value)); }
  Tdms& f32(float value) { return whole(std::bit_cast<std::uint32_t>(value)); }
  Tdms& text(const std::string& value) {
    u32(static_cast<std::uint32_t>(value.size()));
    bytes += value;
    return *this;
  }
  Tdms& property(const std::string& key, const std::string& value) {
    return text(key).u32(0x20).text(value);
  }
  Tdms& property(const std::string& key, double value) {
    return text(key).u32(10).f64(value);
  }
};

inline constexpr std::uint32_t metadata = 1U << 1U;
inline constexpr std::uint32_t new_list = 1U << 2U;
inline constexpr std::uint32_t raw_data = 1U << 3U;
inline constexpr std::uint32_t interleaved = 1U << 5U;
inline constexpr std::uint32_t daqmx = 1U << 7U;

inline std::string segment(std::uint32_t contents, const Tdms& head,
                           const std::string& data) {
  Tdms lead{.bytes = "TDSm"};
  lead.u32(contents | (head.big ? 1U << 6U : 0U));  // little-endian, whatever follows
  lead.big = head.big;
  lead.u32(4713).u64(head.bytes.size() + data.size()).u64(head.bytes.size());
  return lead.bytes + head.bytes + data;
}

/// One double channel of forces, 10 kHz from 0.5 s.
inline void force_channel(Tdms& head, const std::string& name, std::uint64_t values) {
  head.text("/'Cut'/'" + name + "'").u32(20).u32(10).u32(1).u64(values).u32(3);
  head.property("unit_string", std::string("N"));
  head.property("wf_increment", 1e-4).property("wf_start_offset", 0.5);
}

inline std::string numbers(const std::vector<double>& values, bool big = false) {
  Tdms data{.big = big};
  for (const double value : values) data.f64(value);
  return data.bytes;
}

/// Three forces, one after another: 3 samples, then 2 with everything as before.
inline std::string tdms_record(bool big = false) {
  Tdms head{.big = big};
  head.u32(4).text("/").u32(0xFFFFFFFF).u32(1).property("title", std::string("test"));
  for (const char* name : {"Fx", "Fy", "Fz"}) force_channel(head, name, 3);
  Tdms again{.big = big};
  again.u32(1).text("/'Cut'/'Fy'").u32(0).u32(0);
  return segment(metadata | new_list | raw_data, head,
                 numbers({1, 2, 3, 10, 20, 30, 100, 200, 300}, big)) +
         segment(metadata | raw_data, again,
                 numbers({4, 5, 6, 40, 50, 60, 400, 500, 600}, big)) +
         segment(raw_data, {.big = big},
                 numbers({7, 8, 9, 70, 80, 90, 700, 800, 900}, big));
}

}  // namespace trochoid::files::made
