#include <trochoid/base/error.h>
#include <trochoid/cases/sweep.h>
#include <trochoid/sweep/row.h>

#include <gtest/gtest.h>

namespace trochoid::sweep::row_test {

using results::Answer;
using results::Array;
using results::Object;

Answer some_answer() {
  return {
      .command = "simulate",
      .heading = {},
      .result = Object{{"peak_N", 3.5},
                       {"mean_N", Array{1.0, 2.0}},
                       {"fits", Array{Object{{"name", "radial"}, {"rms", nullptr}}}},
                       {"nested", Array{Array{1, 2}, Array{3, 4}}},
                       {"true", true}}};
}

TEST(Taken, IsWhatStandsAtThePath) {
  const Answer a = some_answer();
  EXPECT_EQ(taken(a, "result.peak_N"), results::Cell{3.5});
  EXPECT_EQ(taken(a, "result.mean_N[2]"), results::Cell{2.0});
  EXPECT_EQ(taken(a, "result.nested[2][1]"), results::Cell{3.0});
  EXPECT_EQ(taken(a, "result.fits[1].name"), results::Cell{std::string("radial")});
  EXPECT_EQ(taken(a, "result.true"), results::Cell{1.0});
  EXPECT_TRUE(taken(a, "result.fits[1].rms")) << "null is a cell without a value";
}

TEST(Taken, IsNothingElsewhere) {
  const Answer a = some_answer();
  for (const char* path :
       {"", "result", "result.", "result.peak", "result.mean_N", "result.mean_N[0]",
        "result.mean_N[3]", "result.mean_N[x]", "result.fits", "result.fits[1]",
        "result.peak_N[1]", "result.peak_N.x", "peak_N", "result.mean_N[2",
        "result.mean_N[2].", "result..peak_N"}) {
    EXPECT_FALSE(taken(a, path)) << path;
  }
}

TEST(Taken, CanBeAllThatThePathsSay) {
  const Answer a = some_answer();
  const auto paths = paths_of(a);
  EXPECT_EQ(paths.size(), 10U);
  for (const std::string& path : paths) {
    EXPECT_TRUE(taken(a, path)) << path;
  }
}

cases::Node table(cases::Members members) {
  return {.value = std::move(members), .where = {}};
}

cases::Node root() {
  cases::Array modes = {table({{"mass_kg", {}, {.value = 1.0, .where = {}}}}),
                        table({{"mass_kg", {}, {.value = 2.0, .where = {}}}})};
  return table({{"cut", {}, table({{"feed", {}, {.value = 1.0, .where = {}}}})},
                {"mode", {}, {.value = std::move(modes), .where = {}}}});
}

TEST(SetKey, ReplacesAddsAndGoesIntoLists) {
  cases::Node at = root();
  const auto set = [&](const char* key) {
    set_key(at, {.key = key, .where = {"case.toml", 3, 4}, .values = {}},
            {.value = 7.0, .where = {}});
  };
  set("cut.feed");
  set("cut.depth");
  set("new.key");
  set("mode[2].mass_kg");
  EXPECT_EQ(std::get<double>(find(*find(at, "cut"), "feed")->value), 7.0);
  EXPECT_EQ(find(*find(at, "cut"), "feed")->where.line, 3);
  EXPECT_EQ(std::get<double>(find(*find(at, "cut"), "depth")->value), 7.0);
  EXPECT_EQ(std::get<double>(find(*find(at, "new"), "key")->value), 7.0);
  const auto& modes = std::get<cases::Array>(find(at, "mode")->value);
  EXPECT_EQ(std::get<double>(find(modes[0], "mass_kg")->value), 1.0);
  EXPECT_EQ(std::get<double>(find(modes[1], "mass_kg")->value), 7.0);
}

TEST(SetKey, RefusesPathsThatLeadNowhere) {
  for (const char* key : {"", "cut.", "mode[3].mass_kg", "mode[0].mass_kg", "mode[x]",
                          "mode[1", "cut[1].feed", "cut.feed.more", "mode.mass_kg"}) {
    cases::Node at = root();
    EXPECT_THROW(set_key(at, {.key = key, .where = {}, .values = {}},
                         {.value = 7.0, .where = {}}),
                 base::InputError)
        << key;
  }
}

}  // namespace trochoid::sweep::row_test
