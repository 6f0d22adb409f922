#include <trochoid/report/report.h>

namespace trochoid::report {

namespace {

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '&') {
      out += "&amp;";
    } else if (c == '<') {
      out += "&lt;";
    } else if (c == '>') {
      out += "&gt;";
    } else {
      out += c;
    }
  }
  return out;
}

}  // namespace

std::string html(const base::Answer& answer, const std::string& summary) {
  return "<!doctype html>\n<html lang=\"en\"><meta charset=\"utf-8\"><title>" +
         escaped(answer.title) + "</title><h1>" + escaped(answer.title) + "</h1><p>" +
         escaped(answer.message) + "</p><pre>" + escaped(summary) + "</pre></html>\n";
}

}  // namespace trochoid::report
