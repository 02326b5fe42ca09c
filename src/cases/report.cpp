// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Results for build servers. TAP: testanything.org, version 13. JUnit: the XML that Jenkins, GitLab
// and GitHub's reporters read. Neither has a place for mistakes of a file, so these are cases too.

#include <cstdio>

#include "gable/cases.h"

namespace gable {
namespace {

/// A name in TAP must not look like a directive or end its line.
std::string tapName(const std::string& text) {
  std::string out;
  for (char c : text) out += c == '#' || c == '\n' || c == '\r' ? ' ' : c;
  return out;
}

std::string xmlText(const std::string& text) {
  std::string out;
  for (char c : text) {
    switch (c) {
      case '&': out += "&amp;"; break;
      case '<': out += "&lt;"; break;
      case '>': out += "&gt;"; break;
      case '"': out += "&quot;"; break;
      // XML 1.0 has no other control characters.
      default: out += static_cast<unsigned char>(c) < 32 && c != '\n' && c != '\t' ? ' ' : c;
    }
  }
  return out;
}

std::string secondsText(double seconds) {
  char text[40];
  std::snprintf(text, sizeof text, "%.3f", seconds);
  return text;
}

/// The mistakes of a file as a case of their own.
CaseResult caseOfErrors(const CaseFileResult& file) {
  return {"the file is read", 0, 0, file.errors};
}

/// All cases of a result, mistakes of the file included.
std::vector<CaseResult> casesOf(const CaseFileResult& file) {
  std::vector<CaseResult> all = file.cases;
  if (!file.errors.empty()) all.push_back(caseOfErrors(file));
  return all;
}

std::string placed(const CaseFileResult& file, const CaseFailure& f) {
  return file.file + ":" + std::to_string(f.line) + ": " + f.message;
}

std::string suiteText(const CaseFileResult& file) {
  const std::vector<CaseResult> all = casesOf(file);
  size_t failed = 0;
  double seconds = 0;
  for (const CaseResult& c : all) {
    failed += c.failures.empty() ? 0 : 1;
    seconds += c.seconds;
  }
  std::string out = "  <testsuite name=\"" + xmlText(file.file) + "\" tests=\"" +
                    std::to_string(all.size()) + "\" failures=\"" + std::to_string(failed) +
                    "\" errors=\"0\" time=\"" + secondsText(seconds) + "\">\n";
  for (const CaseResult& c : all) {
    out += "    <testcase name=\"" + xmlText(c.name) + "\" classname=\"" + xmlText(file.file) +
           "\" time=\"" + secondsText(c.seconds) + "\"";
    if (c.failures.empty()) {
      out += "/>\n";
      continue;
    }
    std::string text;
    for (const CaseFailure& f : c.failures) text += placed(file, f) + "\n";
    out += ">\n      <failure message=\"" + xmlText(c.failures.front().message) + "\">" +
           xmlText(text) + "</failure>\n    </testcase>\n";
  }
  return out + "  </testsuite>\n";
}

}  // namespace

std::string tapText(const std::vector<CaseFileResult>& results) {
  size_t count = 0;
  for (const CaseFileResult& file : results) count += casesOf(file).size();
  std::string out = "TAP version 13\n1.." + std::to_string(count) + "\n";
  size_t number = 0;
  for (const CaseFileResult& file : results) {
    for (const CaseResult& c : casesOf(file)) {
      out += (c.failures.empty() ? "ok " : "not ok ") + std::to_string(++number) + " - " +
             tapName(file.file + ": " + c.name) + "\n";
      for (const CaseFailure& f : c.failures) out += "# " + tapName(placed(file, f)) + "\n";
    }
  }
  return out;
}

std::string junitText(const std::vector<CaseFileResult>& results) {
  std::string out = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites>\n";
  for (const CaseFileResult& file : results) out += suiteText(file);
  return out + "</testsuites>\n";
}

}  // namespace gable
