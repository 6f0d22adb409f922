#include <trochoid/report/digest.h>

#include <gtest/gtest.h>

#include <string>

namespace trochoid::report::digest_test {

/// Of `printf TEXT | openssl dgst -sha256 -binary | base64`.
TEST(Digest, IsThatOfOtherPrograms) {
  EXPECT_EQ(sha256_base64(""), "47DEQpj8HBSa+/TImW+5JCeuQeRkm5NMpJWZG3hSuFU=");
  EXPECT_EQ(sha256_base64("abc"), "ungWv48Bz+pBQUDeXa4iI7ADYaOWF3qctBD/YfIAFa0=");
  EXPECT_EQ(sha256_base64(std::string(55, 'x')),
            "1eKFaDzU78AtAhpcYgFGlJWJAQBdb3HongmJ+sd+QHI=");
  EXPECT_EQ(sha256_base64(std::string(56, 'x')),
            "BMJiYTcO51QVSdFt7jIMcj4/0UZx5moJmv4KN3wWiI4=");
  EXPECT_EQ(sha256_base64(std::string(64, 'x')),
            "fOEAlx9k5wAej+WlGXPs3+HO1Cvv5+6NX9YhlQa1OTw=");
  EXPECT_EQ(sha256_base64(std::string(100'000, 'a') + "\xC2\xB5"),
            "AiotlNlTUvI6WX+Jh0HCqTrIxj5cESuT/zwr2dzbFqg=");
}

}  // namespace trochoid::report::digest_test
