#include <gtest/gtest.h>
#include <trochoid/report/digest.h>
#include <trochoid/report/page.h>
#include <trochoid/report/report.h>
#include <trochoid/results/json.h>

#include <nlohmann/json.hpp>
#include <string>

namespace trochoid::report::page_test {

const std::string hostile =
    "</script><script>alert(1)</script> & \"x\" \xC2\xB5 {{case}}";

results::Answer sample() {
  results::Answer answer;
  answer.command = "simulate";
  answer.heading.title = hostile;
  answer.heading.message = hostile;
  answer.heading.warnings = {{"code\"", hostile}};
  answer.result = results::json_value("{}");
  answer.heading.case_toml = hostile;
  answer.short_table = hostile;
  answer.tables = {{"forces.csv", {{"angle_deg", {0, 1}}, {hostile, {1, 2}}}}};
  return answer;
}

std::string summary_of(const results::Answer& answer) {
  const nlohmann::json summary = {
      {"trochoid", {{"version", "1.2.3"}, {"commit", "abc" + hostile}}},
      {"message", answer.heading.message},
      {"result", nlohmann::json::object()}};
  return summary.dump();
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (auto at = text.find(part); at != std::string::npos;
       at = text.find(part, at + 1)) {
    ++found;
  }
  return found;
}

/// What stands between two marks.
std::string between(const std::string& text, const std::string& from,
                    const std::string& to) {
  const auto begin = text.find(from) + from.size();
  return text.substr(begin, text.find(to, begin) - begin);
}

TEST(Page, RequestsNothingFromANetwork) {
  const std::string page = html(sample(), summary_of(sample()));
  for (const std::string place : {"src=", "href=", "action=", "url("}) {
    for (const std::string quote : {"", "'", "\""}) {
      for (const std::string address : {"http:", "https:", "//"}) {
        const std::string fetch = place + quote + address;
        EXPECT_EQ(page.find(fetch), std::string::npos) << fetch;
      }
    }
  }
  for (const std::string call :
       {"@import", "fetch(", "XMLHttpRequest", "WebSocket", "sendBeacon"}) {
    EXPECT_EQ(page.find(call), std::string::npos) << call;
  }
  EXPECT_NE(page.find("default-src 'none'"), std::string::npos)
      << "the browser itself must be told to refuse requests";
}

/// The text between the last tag of that kind and its end.
std::string last_script(const std::string& page) {
  const std::size_t from = page.rfind("<script>") + 8;
  return page.substr(from, page.find("</script>", from) - from);
}

TEST(Page, AllowsItsOwnScriptsAndNoOther) {
  const std::string page = html(sample(), summary_of(sample()));
  const std::size_t from = page.find("script-src ");
  ASSERT_NE(from, std::string::npos);
  const std::string allowed = page.substr(from, page.find(';', from) - from);
  EXPECT_EQ(count(allowed, "'sha256-"), 3U);
  EXPECT_NE(allowed.find(sha256_base64(last_script(page))), std::string::npos);
  EXPECT_EQ(allowed.find("unsafe"), std::string::npos);
}

TEST(Page, HoldsNoTextThatBecomesMarkup) {
  const std::string page = html(sample(), summary_of(sample()));
  EXPECT_EQ(page.find("<script>alert"), std::string::npos);
  EXPECT_EQ(count(page, "</script>"), 4U)
      << "data, uPlot, write-excel-file and the page's own";
  EXPECT_NE(page.find("&lt;/script&gt;&lt;script&gt;alert(1)&lt;/script&gt; &amp; "
                      "&quot;x&quot; \xC2\xB5 {{case}}</h1>"),
            std::string::npos);
}

TEST(Page, CarriesItsDataAsJson) {
  const std::string summary = summary_of(sample());
  const std::string page = html(sample(), summary);
  const auto data = nlohmann::json::parse(
      between(page, "<script type=\"application/json\" id=\"data\">", "</script>"));
  EXPECT_EQ(data.at("summary"), nlohmann::json::parse(summary));
  EXPECT_EQ(data.at("tables")[0].at("columns")[1].at("name"), hostile);
}

TEST(Page, NamesTheProgramThatMadeTheAnswer) {
  const std::string page = html(sample(), summary_of(sample()));
  EXPECT_NE(page.find("version 1.2.3"), std::string::npos);
  EXPECT_NE(page.find("<code>abc&lt;/script&gt;"), std::string::npos);
}

TEST(Page, SaysProminentlyThatThereIsNoAnswer) {
  results::Answer answer = sample();
  EXPECT_EQ(html(answer, summary_of(answer)).find("No good answer"), std::string::npos);
  answer.heading.ok = false;
  const std::string page = html(answer, summary_of(answer));
  EXPECT_NE(page.find("<body class=\"failed\">"), std::string::npos);
  EXPECT_NE(page.find("No good answer</strong>"), std::string::npos);
}

TEST(Page, HasNoListOfWarningsWithoutAny) {
  results::Answer answer = sample();
  EXPECT_NE(html(answer, summary_of(answer)).find("id=\"warnings\""),
            std::string::npos);
  answer.heading.warnings.clear();
  EXPECT_EQ(html(answer, summary_of(answer)).find("id=\"warnings\""),
            std::string::npos);
}

TEST(Page, TakesItsHeadingFromTheCommandWithoutATitle) {
  results::Answer answer = sample();
  answer.heading.title.clear();
  EXPECT_NE(html(answer, summary_of(answer)).find("<h1>simulate</h1>"),
            std::string::npos);
}

TEST(Page, HasAPlaceForEachOfItsParts) {
  for (const auto* name :
       {"title", "message", "verdict", "warnings", "case", "summary", "style", "data",
        "uplot", "excel", "script", "version", "commit"}) {
    EXPECT_NE(page_html().find("{{" + std::string(name) + "}}"), std::string::npos)
        << name;
  }
  EXPECT_EQ(html({}, "{}").find("{{"), std::string::npos) << "a place was not filled";
}

}  // namespace trochoid::report::page_test
