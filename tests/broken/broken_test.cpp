#include <gtest/gtest.h>
#include <trochoid/base/error.h>
#include <trochoid/base/names.h>
#include <trochoid/cases/case.h>
#include <trochoid/files/program_file.h>
#include <trochoid/files/record_file.h>
#include <trochoid/files/surface_file.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <vector>

/// Every file that broken.py writes from the tables is wrong in one way, and is refused in
/// the words that lie beside it.
namespace trochoid::cases {
namespace {

namespace fs = std::filesystem;

struct BrokenFile {
  std::string kind;
  std::string file;
};

void PrintTo(const BrokenFile& broken, std::ostream* out) {
  *out << broken.file;
}

std::string content(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::vector<BrokenFile> broken_files(const std::string& kind) {
  std::vector<BrokenFile> found;
  for (const auto& entry : fs::directory_iterator(fs::path(BROKEN_FILES) / kind)) {
    if (entry.is_regular_file() && entry.path().extension() != ".expected") {
      found.push_back({kind, entry.path().filename().string()});
    }
  }
  std::ranges::sort(found, {}, &BrokenFile::file);
  return found;
}

/// `# command: identify` in the first line, none for `check`; else simulate.
std::optional<Command> command_of(const std::string& text) {
  const std::string_view head = "# command: ";
  if (!text.starts_with(head)) return Command::simulate;
  const std::string name = text.substr(head.size(), text.find('\n') - head.size());
  return base::named<Command>(name);
}

void read(const BrokenFile& broken) {
  constexpr int teeth = 3;
  if (broken.kind == "case") {
    static_cast<void>(read_case(broken.file, command_of(content(broken.file))));
  } else if (broken.kind == "program") {
    static_cast<void>(files::read_program(files::file_at(broken.file), {}));
  } else if (broken.kind == "record") {
    static_cast<void>(files::read_record({.file = files::file_at(broken.file)}));
  } else {
    static_cast<void>(
        files::read_surface({.file = files::file_at(broken.file)}, teeth));
  }
}

std::string said_of(const BrokenFile& broken) {
  try {
    read(broken);
  } catch (const base::InputError& error) {
    return error.what();
  }
  return "(nothing: the file was accepted)";
}

class Broken : public testing::TestWithParam<BrokenFile> {};

TEST_P(Broken, IsRefusedInTheseWords) {
  const auto& [kind, file] = GetParam();
  if (!WITH_HDF5 && file.ends_with(".h5")) GTEST_SKIP() << "built without HDF5";
  const fs::path before = fs::current_path();
  fs::current_path(fs::path(BROKEN_FILES) / kind);  // messages name files as given
  const std::string said = said_of(GetParam());
  EXPECT_EQ(said, content(fs::path(file).replace_extension(".expected")));
  fs::current_path(before);
  RecordProperty("kind", kind);  // broken.py --renew takes the words from here
  RecordProperty("said", said);
}

std::string name_of(const testing::TestParamInfo<BrokenFile>& broken) {
  return fs::path(broken.param.file).stem().string();
}

INSTANTIATE_TEST_SUITE_P(Case, Broken, testing::ValuesIn(broken_files("case")),
                         name_of);
INSTANTIATE_TEST_SUITE_P(Program, Broken, testing::ValuesIn(broken_files("program")),
                         name_of);
INSTANTIATE_TEST_SUITE_P(Record, Broken, testing::ValuesIn(broken_files("record")),
                         name_of);
INSTANTIATE_TEST_SUITE_P(Surface, Broken, testing::ValuesIn(broken_files("surface")),
                         name_of);

TEST(BrokenFiles, AreThere) {
  EXPECT_GE(broken_files("case").size(), 250u);
  EXPECT_GE(broken_files("program").size(), 30u);
  EXPECT_GE(broken_files("record").size(), 100u);
  EXPECT_GE(broken_files("surface").size(), 30u);
}

}  // namespace
}  // namespace trochoid::cases
