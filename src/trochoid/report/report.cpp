#include <trochoid/report/report.h>

#include <trochoid/base/command.h>
#include <trochoid/base/estimate.h>
#include <trochoid/base/names.h>
#include <trochoid/results/json.h>

#include <fmt/core.h>

#include <algorithm>
#include <string_view>

#include <trochoid/report/digest.h>
#include <trochoid/report/drawn.h>
#include <trochoid/report/page.h>

namespace trochoid::report {

namespace {

std::string escaped(std::string_view text) {
  std::string out;
  out.reserve(text.size());
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

/// JSON inside <script>: no text in it may look like the end of the script.
std::string in_script(std::string_view json) {
  std::string out;
  out.reserve(json.size());
  for (const char c : json) {
    if (c == '<') {
      out += "\\u003c";
    } else {
      out += c;
    }
  }
  return out;
}

std::string warnings_html(const results::Answer& answer) {
  if (answer.heading.warnings.empty()) return {};
  std::string text =
      "<section class=\"warnings\" id=\"warnings\" "
      "data-short=\"Warnings\"><h2>Please note</h2><ul>";
  for (const auto& warning : answer.heading.warnings) {
    text += "<li data-code=\"" + escaped(warning.code) + "\">" +
            escaped(warning.message) + "</li>";
  }
  return text + "</ul></section>";
}

std::string without_script(const results::Answer& answer) {
  std::string text = "<p>The curves of this page need JavaScript.</p>";
  if (!answer.short_table.empty()) {
    text += "<pre>" + escaped(answer.short_table) + "</pre>";
  }
  return text;
}

/// The page of each command: a function of its script, named after it; not all have one.
std::string pages_js() {
  std::string text = "const pages = {";
  for (const std::string_view name : base::names<base::Command>) {
    text += fmt::format("{0}: typeof {0}Page === 'function' && {0}Page, ", name);
  }
  return text + "sweep: sweepPage, compare: comparePage};\n";
}

std::string page_scripts() {
  std::string text = fmt::format("const normalInterval = {};\n", base::normal_interval);
  for (const auto part : {text_js(),        band_js(),
                          svg_js(),         save_js(),
                          drawing_js(),     touch_js(),
                          charts_js(),      parts_js(),
                          measured_js(),    simulate_js(),
                          groups_js(),      channels_js(),
                          identify_js(),    cutter_js(),
                          tool_js(),        map_js(),
                          bent_js(),        surface_js(),
                          wall_map_js(),    ellipse_js(),
                          calibrate_js(),   calibrate_words_js(),
                          finish_js(),      stability_js(),
                          modes_js(),       dynamics_js(),
                          moving_js(),      correct_js(),
                          plan_js(),        plan_wall_js(),
                          plan_finish_js(), program_js(),
                          sweep_js(),       any_js(),
                          compare_js()}) {
    text += part;
  }
  return "\n(() => {\n'use strict';\n" + text + pages_js() + std::string(main_js()) +
         "\n})();\n";
}

/// No other script runs, whatever text of a file would ever stand in the page as one.
std::string scripts_allowed() {
  static const std::string allowed =
      fmt::format("'sha256-{}' 'sha256-{}' 'sha256-{}'", sha256_base64(uplot_js()),
                  sha256_base64(excel_js()), sha256_base64(page_scripts()));
  return allowed;
}

std::string data_json(const results::Answer& answer, const std::string& summary) {
  return in_script("{\"summary\":" + summary +
                   ",\"words\":" + results::json_text(results::words_of(answer)) +
                   ",\"tables\":" + tables_json(answer.tables) + "}");
}

/// `version` or `commit` of the program that made the summary; it may be an older one.
std::string provenance(const std::string& summary, std::string_view key) {
  const results::Value read = results::json_value(summary);
  const results::Value* made_by = results::find(read, "trochoid");
  const results::Value* value =
      made_by == nullptr ? nullptr : results::find(*made_by, key);
  const auto* text =
      value == nullptr ? nullptr : std::get_if<std::string>(&value->data);
  return text == nullptr ? "unknown" : *text;
}

/// Failed, or answered with numbers that must not be used, or ok.
std::string status(const results::Answer& answer) {
  if (!answer.heading.ok) return "failed";
  const bool doubtful =
      std::any_of(answer.heading.warnings.begin(), answer.heading.warnings.end(),
                  [](const auto& warning) { return warning.code == "do_not_use"; });
  return doubtful ? "doubtful" : "ok";
}

std::string value_of(std::string_view name, const results::Answer& answer,
                     const std::string& summary) {
  if (name == "title") {
    return escaped(answer.heading.title.empty() ? answer.command
                                                : answer.heading.title);
  }
  if (name == "command") return escaped(answer.command);
  if (name == "status") return status(answer);
  if (name == "verdict") return answer.heading.ok ? "" : "No good answer";
  if (name == "message") return escaped(answer.heading.message);
  if (name == "warnings") return warnings_html(answer);
  if (name == "without_script") return without_script(answer);
  if (name == "case") return escaped(answer.heading.case_toml);
  if (name == "summary") return escaped(summary);
  if (name == "version") return escaped(provenance(summary, "version"));
  if (name == "commit") return escaped(provenance(summary, "commit"));
  if (name == "style") return std::string(uplot_css()) + std::string(page_css());
  if (name == "data") return data_json(answer, summary);
  if (name == "uplot") return std::string(uplot_js());
  if (name == "uplot_licence") return std::string(uplot_licence());
  if (name == "excel") return std::string(excel_js());
  if (name == "excel_licence") return std::string(excel_licence());
  if (name == "fflate_licence") return std::string(fflate_licence());
  if (name == "script") return page_scripts();
  if (name == "scripts_allowed") return scripts_allowed();
  return {};
}

}  // namespace

std::string html(const results::Answer& answer, const std::string& summary) {
  std::string page;
  std::string_view rest = page_html();
  for (std::size_t mark = rest.find("{{"); mark != std::string_view::npos;
       mark = rest.find("{{")) {
    const std::size_t end = rest.find("}}", mark);
    page += rest.substr(0, mark);
    page += value_of(rest.substr(mark + 2, end - mark - 2), answer, summary);
    rest = rest.substr(end + 2);
  }
  page += rest;
  return page;
}

}  // namespace trochoid::report
