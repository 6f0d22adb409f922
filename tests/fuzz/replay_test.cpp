#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

std::vector<char> bytes_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

int try_one(const std::vector<char>& bytes) {
  return LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(bytes.data()),
                                bytes.size());
}

/// Whatever a fuzzer has found once is tried in every test run.
TEST(Fuzz, FindingsStayRepaired) {
  int tried = 0;
  for (const auto& entry : std::filesystem::directory_iterator(FINDINGS)) {
    SCOPED_TRACE(entry.path().string());
    EXPECT_EQ(try_one(bytes_of(entry.path())), 0);
    ++tried;
  }
  EXPECT_GT(tried, 0);
}

/// Small sound files, where there are any: cut off anywhere, and with each byte wrong; of
/// the longer ones a sample.
TEST(Fuzz, SeedsBearAnyDamage) {
  std::error_code absent;
  for (const auto& entry : std::filesystem::directory_iterator(SEEDS, absent)) {
    SCOPED_TRACE(entry.path().string());
    const auto sound = bytes_of(entry.path());
    const std::size_t step = sound.size() > 1000 ? sound.size() / 100 : 1;
    for (std::size_t at = 1; at < sound.size(); at += step) {
      const auto end = sound.begin() + static_cast<std::ptrdiff_t>(at);
      EXPECT_EQ(try_one({sound.begin(), end}), 0);
      for (const int flip : {0x01, 0x20, 0x80, 0xFF}) {
        auto bytes = sound;
        bytes[at] = static_cast<char>(bytes[at] ^ flip);
        EXPECT_EQ(try_one(bytes), 0);
      }
    }
  }
}

}  // namespace
