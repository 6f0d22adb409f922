#include <trochoid/base/nesting.h>
#include <trochoid/base/printable.h>
#include <trochoid/base/read_text.h>

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

/// Texts that would end a parser or steer a terminal.
namespace trochoid::base::hostile_text_test {

std::string repeated(const std::string& text, int times) {
  std::string all;
  for (int i = 0; i < times; ++i) all += text;
  return all;
}

TEST(TooDeep, OrdinaryTextsAreNot) {
  EXPECT_FALSE(too_deep(""));
  EXPECT_FALSE(too_deep("[tool]\nteeth = 2\npitch_deg = [180.0, 180.0] # [[[\n"));
  EXPECT_FALSE(too_deep(R"({"a": {"b": [1.5, {"c": "[[[["}]}})"));
  EXPECT_FALSE(too_deep(repeated("a = [1.0, 2.0, 3.0]\n", 1000)));
}

TEST(TooDeep, BracketsWithinBrackets) {
  EXPECT_FALSE(too_deep("a = " + repeated("[", 64) + repeated("]", 64)));
  const auto deep = too_deep("x = 1\na = " + repeated("[", 65));
  ASSERT_TRUE(deep);
  EXPECT_EQ(deep->line, 2);
  EXPECT_EQ(deep->column, 4 + 65);
  EXPECT_TRUE(too_deep("a = " + repeated("{ b = ", 65)));
}

TEST(TooDeep, PartsOfAKey) {
  EXPECT_FALSE(too_deep("a" + repeated(".a", 31) + " = 1"));
  EXPECT_TRUE(too_deep("a" + repeated(".a", 32) + " = 1"));
  EXPECT_TRUE(too_deep("a" + repeated(" . 'b'", 32) + " = 1"));
  EXPECT_TRUE(too_deep("[" + repeated("\"a\".", 40) + "b]"));
}

TEST(TooDeep, WhatStandsInStringsAndCommentsDoesNotCount) {
  const std::string many = repeated("[", 100);
  EXPECT_FALSE(too_deep("a = \"" + many + "\\\"" + many + "\""));
  EXPECT_FALSE(too_deep("a = '" + many + "'"));
  EXPECT_FALSE(too_deep("a = \"\"\"\n" + many + "\n" + many + "\"\"\""));
  EXPECT_FALSE(too_deep("a = '''\n" + many + "'''"));
  EXPECT_FALSE(too_deep("# " + many + "\n"));
  EXPECT_TRUE(too_deep("a = \"never closed\n" + many));  // ends with its line
  EXPECT_TRUE(too_deep("a = \"\"\" \"\"\" " + many));
}

TEST(Printable, NothingThatATerminalObeys) {
  EXPECT_EQ(printable("K_tc\t2620\n"), "K_tc\t2620\n");
  EXPECT_EQ(printable("\x1b[31mred\x7f"), "\\x1B[31mred\\x7F");
  EXPECT_EQ(printable("\xc2\x9b"
                      "2J"),
            "\\x9B2J");                            // C1 in UTF-8
  EXPECT_EQ(printable("\xc2\xb5m"), "\xc2\xb5m");  // micro
  EXPECT_EQ(printable("gr\xc3\xbc\xc3\x9f"), "gr\xc3\xbc\xc3\x9f");
  EXPECT_EQ(printable("\xe2\x82\xac \xf0\x9f\x94\xa7"),
            "\xe2\x82\xac \xf0\x9f\x94\xa7");
  EXPECT_EQ(one_line("a\nb"), "a\\nb");
}

TEST(Printable, BytesOfAnotherEncoding) {
  EXPECT_EQ(printable("\xca\xb1\xbc\xe4"), "\xca\xb1\\xBC\\xE4");  // GBK
  EXPECT_EQ(printable("Kr\xe4"
                      "fte \xe2\x82"),
            "Kr\\xE4fte \\xE2\\x82");  // Latin-1, and a character cut off
}

TEST(ReadText, WhatTheDiskDoesNotGive) {
  EXPECT_FALSE(read_text("/proc/self/mem"));  // address 0 cannot be read
  EXPECT_FALSE(read_text("/nowhere"));
  const auto file = std::filesystem::path(testing::TempDir()) / "trochoid_read_text";
  const std::string text(200000, 'x');
  std::ofstream(file) << text;
  EXPECT_EQ(read_text(file), text);
  std::ofstream(file).close();
  EXPECT_EQ(read_text(file), "");
  std::filesystem::remove(file);
}

}  // namespace trochoid::base::hostile_text_test
