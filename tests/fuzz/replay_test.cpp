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

int try_all(const char* folder) {
  int tried = 0;
  std::error_code absent;
  for (const auto& entry : std::filesystem::directory_iterator(folder, absent)) {
    SCOPED_TRACE(entry.path().string());
    EXPECT_EQ(try_one(bytes_of(entry.path())), 0);
    ++tried;
  }
  return tried;
}

/// Whatever a fuzzer has found once is tried in every test run.
TEST(Fuzz, FindingsStayRepaired) {
  EXPECT_GT(try_all(FINDINGS), 0);
}

/// The smallest files by which a fuzzer has reached all that it reached.
TEST(Fuzz, CorpusIsBorne) {
  EXPECT_GT(try_all(CORPUS), 0);
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
