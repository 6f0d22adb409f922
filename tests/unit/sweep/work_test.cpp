#include <trochoid/cases/case.h>
#include <trochoid/cases/document.h>
#include <trochoid/numerics/parallel.h>
#include <trochoid/sweep/parts.h>
#include <trochoid/sweep/work.h>

#include <gtest/gtest.h>

#include <atomic>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <thread>

namespace trochoid::sweep::work_test {

namespace fs = std::filesystem;

constexpr const char* swept = R"(
[sweep]
command = "simulate"
take = ["result.peak_xy_N"]
[sweep.over]
"cut.spindle_rpm" = { from = 500, to = 900, count = 40 }
)";

struct WorkOfACase : testing::Test {
  WorkOfACase() {
    std::ofstream(file) << cases::new_case(base::Command::simulate) << swept;
    root = cases::load_document(file);
  }
  ~WorkOfACase() override { fs::remove(file); }
  WorkOfACase(const WorkOfACase&) = delete;
  WorkOfACase& operator=(const WorkOfACase&) = delete;

  [[nodiscard]] Work work() const {
    return {{root, file, {}}, Request{.part_file = {}}, run::Progress()};
  }

  fs::path file = fs::temp_directory_path() / "trochoid_work_test.toml";
  cases::Node root;
};

std::string all_of(const results::SweepResult& result) {
  std::vector<results::SweepRow> rows;
  for (std::size_t i = 0; i < result.rows.size(); ++i) {
    rows.push_back(result.rows.row(i));
  }
  return part_text(0, rows);
}

TEST_F(WorkOfACase, IsTheSameWhoeverAnswers) {
  Work here = work();
  here.go_on({}, {}, std::chrono::seconds(1));
  Work elsewhere = work();
  for (std::size_t first = 0; first < 24; first += 8) {
    const Prepared& prepared = elsewhere.prepared();
    const std::string sent = part_text(
        first, rows(prepared.study, 8,
                    [&](std::size_t i) { return prepared.rows.row(first + i); }));
    std::istringstream in(sent);
    elsewhere.add(*read_part(in, first, 2));
  }
  elsewhere.go_on({}, {}, std::chrono::seconds(1));
  const results::SweepResult whole = here.take_result();
  EXPECT_TRUE(whole.complete);
  EXPECT_EQ(all_of(whole), all_of(elsewhere.take_result()));
}

TEST_F(WorkOfACase, KeepsItsRowsWhereProgressThrows) {
  Work cut = work();
  const auto throws = [&](const run::Step&) {
    if (cut.done() > 10) throw std::runtime_error("Ctrl-C");
  };
  EXPECT_THROW(cut.go_on(throws, {}, std::chrono::seconds(1)), std::runtime_error);
  EXPECT_GT(cut.done(), 10U);
  cut.go_on({}, {}, std::chrono::seconds(1));
  EXPECT_EQ(cut.done(), cut.rows());
}

TEST(Ranges, AreToldOfTheFirstQuantities) {
  results::SweepResult r;
  r.take = {"result.a", "message", "result.b"};
  r.rows = results::SweepRows(
      {{.cells = {1.5, "x", 4.0}, .status = "ok", .message = {}},
       {.cells = {0.5, "y", 3.0}, .status = "ok", .message = {}},
       {.cells = {9.0, "z", 9.0}, .status = "failed", .message = {}}});
  EXPECT_EQ(results::ranges_of(r), " a goes from 0.5 to 1.5; b goes from 3 to 4.");
  r.take = {"message", "a", "b", "c", "d"};
  r.rows = results::SweepRows(
      {{.cells = {"x", 1.0, 2.0, 3.0, 4.0}, .status = "ok", .message = {}}});
  EXPECT_TRUE(results::ranges_of(r).ends_with("; c goes from 3 to 3; and more."));
  r.take = {"a"};
  r.rows = results::SweepRows({{.cells = {1.5}, .status = "ok", .message = {}},
                               {.cells = {0.5}, .status = "ok", .message = {}}});
  r.by_chance = true;
  EXPECT_EQ(results::ranges_of(r).substr(0, 15), " a is 1 (95 %: ");
  r.rows = {};
  EXPECT_EQ(results::ranges_of(r), "");
}

TEST(Part, OfOtherRowsOrCutShortIsNone) {
  const std::string text = part_text(
      3,
      std::vector<results::SweepRow>{{.cells = {1.5}, .status = "ok", .message = {}}});
  const auto read = [](const std::string& part, std::size_t first) {
    std::istringstream in(part);
    return read_part(in, first, 1).has_value();
  };
  EXPECT_TRUE(read(text, 3));
  EXPECT_FALSE(read(text, 0));
  EXPECT_FALSE(read(text.substr(0, text.size() - 1), 3));
  EXPECT_FALSE(read("", 3));
}

TEST(Threads, AreOneWhereThatIsAsked) {
  std::atomic<int> others = 0;
  const auto self = std::this_thread::get_id();
  numerics::on_one_thread([&] {
    EXPECT_EQ(numerics::thread_count(), 1U);
    numerics::for_each_index(1000, [&](std::size_t) {
      others += std::this_thread::get_id() == self ? 0 : 1;
      std::this_thread::yield();
    });
  });
  EXPECT_EQ(others, 0);
  EXPECT_GE(numerics::thread_count(), 1U);
}

}  // namespace trochoid::sweep::work_test
