#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

/// Whatever a fuzzer has found once is tried in every test run.
TEST(Fuzz, FindingsStayRepaired) {
  int tried = 0;
  for (const auto& entry : std::filesystem::directory_iterator(FINDINGS)) {
    SCOPED_TRACE(entry.path().string());
    std::ifstream in(entry.path(), std::ios::binary);
    const std::vector<char> bytes{std::istreambuf_iterator<char>(in), {}};
    EXPECT_EQ(LLVMFuzzerTestOneInput(
                  reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()),
              0);
    ++tried;
  }
  EXPECT_GT(tried, 0);
}

}  // namespace
