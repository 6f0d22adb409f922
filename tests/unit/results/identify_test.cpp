#include <trochoid/results/identify.h>

#include "../identification/sound_fit.h"

#include <trochoid/base/units.h>
#include <trochoid/results/json.h>

#include <gtest/gtest.h>

#include <algorithm>

namespace trochoid::results::identify_test {

IdentifyResult made() {
  IdentifyResult r;
  r.fits = {identification::test::sound_fit()};
  r.fits[0].chip.model = chip::Model::trochoidal;
  r.chosen = 0;
  r.records = {{"record.csv", 3, 100 * unit::rpm, 0.01 * unit::rpm, 99 * unit::rpm}};
  r.channels = *signal::axes_matrix(std::array<std::string, 3>{"y", "-x", "z"});
  return r;
}

std::string result(const IdentifyResult& r) {
  return json_text(answer_of(r).result);
}

bool says(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(IdentifyAnswer, HasTheChosenFitAndWhatWasRead) {
  const std::string text = result(made());
  EXPECT_TRUE(says(text, R"("chosen": "trochoidal")")) << text;
  EXPECT_TRUE(says(text, R"("axes": ["y", "-x", "z"])")) << text;
  EXPECT_TRUE(says(text, R"("stated_rpm": 99)")) << text;
  EXPECT_TRUE(says(text, R"("do_not_use": [])")) << text;
  EXPECT_FALSE(says(text, "axes_rms_N")) << "the axes were given: " << text;
}

TEST(IdentifyAnswer, GivesTheMatrixThatIsNoSetOfAxes) {
  IdentifyResult r = made();
  r.channels[0] = {0.9, 0.1, 0.0};
  EXPECT_TRUE(says(result(r), R"("axes": null)")) << result(r);
  EXPECT_TRUE(says(result(r), R"("matrix": [)")) << result(r);
}

TEST(IdentifyAnswer, SaysFirstThatNumbersMustNotBeUsed) {
  IdentifyResult r = made();
  r.reasons_against = {"it explains nothing"};
  const Answer answer = answer_of(r);
  EXPECT_EQ(answer.short_table.find("Do not use"), 0U) << answer.short_table;
  EXPECT_TRUE(says(answer.short_table, "it explains nothing"));
  EXPECT_TRUE(says(answer.short_table, "record.csv: 100.00 rpm (stated 99)"));
}

TEST(IdentifyAnswer, BeginsWithAVerdict) {
  IdentifyResult r = made();
  EXPECT_EQ(answer_of(r).short_table.find("Usable.\n"), 0U);
  EXPECT_TRUE(says(result(r), R"("verdict": "usable")"));
  r.reasons_for_care = {"z may be reversed", "much of the force is not explained"};
  EXPECT_EQ(answer_of(r).short_table.find(
                "Usable with care: z may be reversed; much of the force is not "
                "explained.\n"),
            0U);
  EXPECT_TRUE(says(result(r), R"("verdict": "usable with care")"));
  EXPECT_TRUE(says(result(r), R"("with_care": ["z may be reversed")")) << result(r);
}

TEST(IdentifySentence, SaysNumbersAndWhatStaysUnexplained) {
  IdentifyResult r = made();
  r.fits[0].unexplained.in_band = 0.23;
  const std::string said = identification_sentence(r);
  EXPECT_TRUE(said.starts_with("Usable. K_tc = ")) << said;
  EXPECT_TRUE(says(said, " MPa and K_rc = ")) << said;
  EXPECT_TRUE(says(said, "Unexplained stays 23 % of the force (rms), ")) << said;
  EXPECT_TRUE(says(said, "3 samples of 1 record.")) << said;
  r.fits[0].options.band_harmonics = 2;
  EXPECT_TRUE(says(identification_sentence(r),
                   "of the force within its mean and first 2 harmonics (rms)"));
}

TEST(IdentifySentence, HoldsNoNumbersThatMustNotBeUsed) {
  IdentifyResult r = made();
  r.reasons_against = {"it explains nothing"};
  const std::string said = identification_sentence(r);
  EXPECT_TRUE(
      said.starts_with("Do not use these numbers: it explains nothing. Unexplained"))
      << said;
  EXPECT_FALSE(says(said, "K_tc")) << said;
}

TEST(IdentifyAnswer, IsNoMaterialWithoutAFit) {
  EXPECT_EQ(answer_of(made()).texts.at(0).file, "material.toml");
  IdentifyResult r = made();
  r.chosen.reset();
  r.heading.ok = false;
  r.heading.message = "the feed is zero";
  const Answer answer = answer_of(r);
  EXPECT_TRUE(answer.texts.empty());
  EXPECT_TRUE(answer.tables.empty());
  EXPECT_EQ(answer.short_table, "No answer: the feed is zero\n");
  EXPECT_TRUE(says(json_text(answer.result), R"("chosen": null)"));
}

/// Two groups of one record each, the second with twice the coefficients.
IdentifyResult grouped() {
  IdentifyResult r = made();
  identification::Fit& fit = r.fits[0];
  identification::Group sharp{"", {0}, fit.law, fit.coefficients};
  identification::Group blunt{"after 10 min", {1}, fit.law, fit.coefficients};
  for (auto& K : blunt.coefficients) {
    K->value *= 2;
  }
  fit.groups = {sharp, blunt};
  r.records.push_back({"worn.csv", 3, 100 * unit::rpm, 0.01 * unit::rpm, 0.0});
  r.runs.resize(2);
  r.runs[1].group = "after 10 min";
  for (auto& run : r.runs) {
    run.angle = {0.0};
    run.force = {{}};
  }
  fit.fitted.assign(2, {{}});
  return r;
}

TEST(IdentifyAnswer, HasACoefficientForEachGroup) {
  const Answer answer = answer_of(grouped());
  const Value* groups = find(answer.result, "groups");
  ASSERT_NE(groups, nullptr);
  const auto& list = std::get<Array>(groups->data);
  ASSERT_EQ(list.size(), 2U);
  EXPECT_EQ(json_text(*find(list[0], "group")), "null");
  EXPECT_EQ(json_text(*find(list[1], "group")), "\"after 10 min\"");
  EXPECT_EQ(json_text(*find(list[1], "files")), "[\"worn.csv\"]");
  const Value* K = find(*find(list[1], "coefficients"), "K_tc_MPa");
  EXPECT_EQ(json_text(*find(*K, "value")), "5200");
  EXPECT_TRUE(says(answer.short_table, "without a group    after 10 min\n"))
      << answer.short_table;
  EXPECT_TRUE(says(answer.short_table, "2600 +- 52")) << answer.short_table;
  EXPECT_EQ(answer.short_table.find("K_tc_MPa"), answer.short_table.rfind("K_tc_MPa"))
      << "the chip models side by side would show the first group alone";
  ASSERT_EQ(answer.texts.size(), 2U);
  EXPECT_EQ(answer.texts[1].file, "material_2.toml");
  EXPECT_TRUE(says(answer.texts[1].text, "# Of \"after 10 min\".\n"));
  EXPECT_TRUE(says(answer.texts[1].text, "K_tc_MPa = 5200 "));
  EXPECT_FALSE(says(result(made()), "groups"));
}

TEST(IdentifyAnswer, SaysWhatADialGaugeWouldRead) {
  IdentifyResult r = made();
  EXPECT_FALSE(says(result(r), "clocking"));
  r.clocking = Clocking{{{3e-6, 4e-6}, {1e-14, 0.0, 1e-14}}, 1e-3, 2, std::nullopt};
  const Answer answer = answer_of(r);
  const Value* clocking = find(answer.result, "clocking");
  ASSERT_NE(clocking, nullptr);
  const Value* reading = find(*clocking, "total_indicator_reading_um");
  EXPECT_NEAR(std::get<double>(find(*reading, "value")->data), 10.0, 1e-12);
  EXPECT_NEAR(std::get<double>(find(*reading, "high")->data), 10.4, 1e-12);
  EXPECT_EQ(find(*clocking, "tool"), nullptr);
  EXPECT_TRUE(says(answer.short_table, "would read 10.00 +- 0.40 um in all (TIR)"))
      << answer.short_table;
  EXPECT_TRUE(says(answer.short_table, "1 mm above the tip tooth 2 is the longest"));
  r.clocking->separation =
      identification::separate({{0.0, 9e-6}, {}}, {{3e-6, 4e-6}, {}}, 180 * unit::deg);
  // t = (e1 + e2)/2, h = (e1 - e2)/2
  const std::string text = result(r);
  EXPECT_TRUE(says(text, "\"tool\": {")) << text;
  EXPECT_NEAR(
      std::get<double>(find(*find(*find(*find(answer_of(r).result, "clocking"), "tool"),
                                  "eccentricity_mm"),
                            "value")
                           ->data),
      std::hypot(1.5, 6.5) * 1e-3, 1e-12);
  EXPECT_TRUE(says(answer_of(r).short_table, "of the tool itself 6.6"));
}

TEST(IdentifyAnswer, HasTheSweepByItsModel) {
  IdentifyResult r = made();
  r.sweep = OffsetSweep{.offset = {-1 * unit::um, 0.0},
                        .curves = {{chip::Model::feed, {3.0, 4.0}}}};
  const Answer answer = answer_of(r);
  const base::Table& sweep = answer.tables.back();
  ASSERT_EQ(sweep.file, "sweep.csv");
  EXPECT_EQ(sweep.columns.at(0).name, "offset_um");
  EXPECT_EQ(sweep.columns.at(1).name, "rms_feed_N");
  EXPECT_EQ(sweep.columns.at(1).values, (std::vector{3.0, 4.0}));
}

/// Bins that hold less than two samples have no scatter, and do not count.
TEST(IdentifyAnswer, FoldsWhatHoldsTwoTurns) {
  IdentifyResult r = made();
  signal::OneRevolution one;
  one.revolutions = 2;
  one.angle = {0.0, 1.0};
  one.count = {2, 1};
  for (auto& c : one.mean) {
    c = {5.0, 6.0};
  }
  for (auto& c : one.scatter) {
    c = {0.5, 0.6};
  }
  r.folded = {one};
  const auto tables = answer_of(r).tables;
  const auto folded =
      std::find_if(tables.begin(), tables.end(),
                   [](const base::Table& t) { return t.file == "folded.csv"; });
  ASSERT_NE(folded, tables.end());
  EXPECT_EQ(folded->columns.at(0).values, std::vector{1.0});
  EXPECT_EQ(folded->columns.back().name, "Fz_sd_N");
  EXPECT_EQ(folded->columns.back().values, std::vector{0.5});
}

}  // namespace trochoid::results::identify_test
