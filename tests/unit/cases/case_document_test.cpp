#include "case_text.h"

#include <trochoid/base/unit_of_key.h>
#include <trochoid/cases/document.h>
#include <trochoid/cases/findings.h>
#include <trochoid/cases/schema.h>

#include <sys/stat.h>

#include <gtest/gtest.h>

namespace trochoid::cases::case_document_test {

using test::CaseFolder;

std::string refusal(const std::filesystem::path& file) {
  try {
    static_cast<void>(read_case(file, std::nullopt));
  } catch (const base::InputError& error) {
    const std::string text = error.what();
    return text.substr(file.string().size());
  }
  return "";
}

TEST(CaseDocument, AFileThatIsNotThere) {
  EXPECT_EQ(
      refusal(CaseFolder().path() / "no.toml"),
      ":1:1: there is no such file; `trochoid new simulate` writes a case file\n");
}

TEST(CaseDocument, AFolder) {
  const CaseFolder folder;
  EXPECT_EQ(refusal(folder.path()),
            ":1:1: this is a folder; a case file (TOML) is expected\n");
}

TEST(CaseDocument, APipeIsNotOpened) {
  const CaseFolder folder;
  const auto pipe = folder.path() / "pipe.toml";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_EQ(refusal(pipe),
            ":1:1: this is not a regular file; a case file (TOML) is expected\n");
}

TEST(CaseDocument, AHugeFileIsNotRead) {
  const CaseFolder folder;
  const auto file = folder.write("huge.toml", "");
  std::filesystem::resize_file(file, std::uintmax_t{1} << 30U);
  EXPECT_EQ(refusal(file), ":1:1: larger than 16 MiB; this cannot be a case file\n");
}

TEST(CaseDocument, KeysKeepTheirOrderAndPlace) {
  const CaseFolder folder;
  const Node root =
      parse_file(folder.write("a.toml", "b = 1\n\n[t]\n  z = [2, 30]\na = 4\n"));
  const Node* t = find(root, "t");
  ASSERT_NE(t, nullptr);
  const auto& members = std::get<Members>(t->value);
  ASSERT_EQ(members.size(), 2U);
  EXPECT_EQ(members[0].key, "z");
  EXPECT_EQ(members[0].where.line, 4);
  EXPECT_EQ(members[0].where.column, 3);
  const auto& entries = std::get<Array>(members[0].node.value);
  EXPECT_EQ(entries[1].where.line, 4);
  EXPECT_EQ(entries[1].where.column, 11);
}

TEST(CaseDocument, WindowsLineEndsAndByteOrderMark) {
  std::string text = "\xEF\xBB\xBF" + test::slot;
  for (auto at = text.find('\n'); at != std::string::npos;
       at = text.find('\n', at + 2)) {
    text.insert(at, "\r");
  }
  EXPECT_EQ(CaseFolder().problems(text), "");
}

TEST(CaseDocument, ATextWithoutQuotes) {
  const CaseFolder folder;
  const std::string said =
      refusal(folder.write("a.toml", "[tool]\nshape = cylinder\n"));
  EXPECT_TRUE(said.starts_with(":2:9: not valid TOML: ")) << said;
  EXPECT_TRUE(said.ends_with("; a text needs quotes: key = \"value\"\n")) << said;
}

TEST(CaseFindings, NearNames) {
  const std::vector<std::string> names = {"helix_deg", "diameter_mm", "teeth"};
  EXPECT_EQ(nearest("helx_deg", names), "helix_deg");
  EXPECT_EQ(nearest("tehet", names), "teeth");
  EXPECT_EQ(nearest("diameter", names), "diameter_mm");
  EXPECT_EQ(nearest("HELIX_DEG", names), "helix_deg");
  EXPECT_EQ(nearest("colour", names), "");
  EXPECT_EQ(nearest(std::string(1000000, 'x'), names), "");
}

TEST(CaseSchema, TheEndOfAKeyIsItsUnit) {
  EXPECT_EQ(unit::of_key("feed_rate_mm_per_min").symbol, "mm/min");
  EXPECT_EQ(unit::of_key("K_te_N_per_mm").factor, 1e3);
  EXPECT_EQ(unit::of_key("stiffness_N_per_m").factor, 1.0);
  EXPECT_EQ(unit::of_key("slew_um_per_s").symbol, "um/s");
  EXPECT_EQ(unit::of_key("channel_offsets").symbol, "");
  EXPECT_EQ(unit::of_key("samples_per_rev").symbol, "");
}

}  // namespace trochoid::cases::case_document_test
