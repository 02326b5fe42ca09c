// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Line by line: `==` opens a case, an unindented `name:` a section, anything indented is text of
// the section that is open.

#include "cases/case_file.h"

#include <algorithm>
#include <array>

#include "base/text.h"

namespace gable::cases {

namespace {

constexpr std::array<std::string_view, 11> kSections = {"rule",   "rules",  "style", "file",
                                                        "shape",  "set",    "seed",  "start",
                                                        "limits", "values", "expect"};

size_t indentOf(std::string_view line) {
  const size_t first = line.find_first_not_of(' ');
  return first == std::string_view::npos ? line.size() : first;
}

/// Takes the indentation that all lines share away.
std::string dedented(const std::vector<std::string_view>& lines) {
  size_t common = std::string_view::npos;
  for (std::string_view line : lines) {
    if (!trimmed(line).empty()) common = std::min(common, indentOf(line));
  }
  std::string text;
  for (std::string_view line : lines) {
    if (line.size() > common) text += line.substr(common);
    text += '\n';
  }
  return text;
}

std::string sectionsText() {
  std::string text;
  for (std::string_view name : kSections) text += (text.empty() ? "" : ", ") + std::string(name);
  return text;
}

class Reader {
 public:
  CaseFile read(std::string_view text) {
    for (std::string_view line : linesOf(text)) {
      ++number_;
      take(line);
      if (isOther_) break;
    }
    closeSection();
    if (file_.cases.empty() && file_.errors.empty()) error("no case in this file");
    if (isOther_) file_.cases.clear();
    return std::move(file_);
  }

 private:
  // Of the case that is open, else of the file.
  void error(const std::string& what) {
    std::vector<CaseFailure>& errors =
        file_.cases.empty() ? file_.errors : file_.cases.back().errors;
    errors.push_back({static_cast<uint32_t>(number_), what});
  }

  void take(std::string_view line) {
    if (line.starts_with("== ")) {
      openCase(trimmed(line.substr(3)));
    } else if (line.empty() || line.front() == ' ') {
      if (open_)
        lines_.push_back(line);
      else if (!trimmed(line).empty() && !unknown_)
        error("text outside a section");
    } else if (line.front() != '#') {
      openSection(line);
    }
  }

  void openCase(std::string_view name) {
    closeSection();
    unknown_ = false;
    const bool isSecond = std::any_of(file_.cases.begin(), file_.cases.end(),
                                      [&](const Case& c) { return c.name == name; });
    file_.cases.push_back({std::string(name), number_, {}, {}});
    if (isSecond) error("a second case named " + std::string(name));
  }

  void openSection(std::string_view line) {
    closeSection();
    if (file_.cases.empty()) {
      isOther_ = true;
      error("a file of cases begins with '== name' and the sections of that case, not with '" +
            std::string(line) + "'; rules are named in a section, such as rules: tower.cga");
      return;
    }
    const size_t colon = line.find(':');
    const std::string_view head = line.substr(0, colon);
    const size_t blank = head.find(' ');
    const std::string_view name = head.substr(0, blank);
    if (colon == std::string_view::npos ||
        std::find(kSections.begin(), kSections.end(), name) == kSections.end()) {
      unknown_ = true;
      const std::string meant = didYouMean(name, {kSections.begin(), kSections.end()});
      error("expected a section of a case, not '" + std::string(line) + "'; " +
            (meant.empty() ? "there are " + sectionsText() : meant));
      return;
    }
    unknown_ = false;
    Section section;
    section.name = name;
    if (blank != std::string_view::npos) section.argument = trimmed(head.substr(blank));
    section.line = number_;
    const std::string_view rest = trimmed(line.substr(colon + 1));
    section.textLine = rest.empty() ? number_ + 1 : number_;
    if (name != "file" && file_.cases.back().find(name)) {
      error("a second section " + std::string(name));
    }
    file_.cases.back().sections.push_back(section);
    open_ = true;
    first_ = rest;
  }

  void closeSection() {
    if (!open_) return;
    while (!lines_.empty() && trimmed(lines_.back()).empty()) lines_.pop_back();
    Section& section = file_.cases.back().sections.back();
    if (!first_.empty()) section.text = std::string(first_) + "\n";
    section.text += dedented(lines_);
    lines_.clear();
    open_ = false;
  }

  CaseFile file_;
  size_t number_ = 0;
  bool open_ = false;
  // Within a section that there is not, whose text is not told as well.
  bool unknown_ = false;
  // No file of cases.
  bool isOther_ = false;
  std::string_view first_;
  std::vector<std::string_view> lines_;
};

Statement statementOf(std::string_view line, size_t number) {
  Statement s;
  s.line = number;
  size_t at = 0;
  while ((at = line.find_first_not_of(" \t\r", at)) != std::string_view::npos) {
    const bool quoted = line[at] == '"';
    const size_t begin = quoted ? at + 1 : at;
    const size_t end = quoted ? line.find('"', begin) : line.find_first_of(" \t\r", begin);
    s.quoted.push_back(quoted);
    s.words.emplace_back(line.substr(begin, end == std::string_view::npos ? end : end - begin));
    if (end == std::string_view::npos) break;
    at = end + 1;
  }
  return s;
}

}  // namespace

const Section* Case::find(std::string_view section) const {
  for (const Section& s : sections) {
    if (s.name == section) return &s;
  }
  return nullptr;
}

std::string_view Case::textOf(std::string_view section) const {
  const Section* s = find(section);
  return s ? std::string_view(s->text) : std::string_view();
}

std::string_view trimmed(std::string_view s) {
  const size_t first = s.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return s.substr(first, s.find_last_not_of(" \t\r") - first + 1);
}

CaseFile parseCases(std::string_view text) { return Reader().read(text); }

std::vector<Statement> statements(const Section& section) {
  std::vector<Statement> result;
  size_t number = section.textLine;
  for (std::string_view line : linesOf(section.text)) {
    const std::string_view words = trimmed(line);
    if (!result.empty() && line.starts_with(' ')) {
      result.back().block += std::string(line) + "\n";
    } else if (!words.empty() && words.front() != '#') {
      result.push_back(statementOf(words, number));
    }
    ++number;
  }
  return result;
}

std::string strayLines(const Statement& statement) {
  if (trimmed(statement.block).empty()) return {};
  return "the lines below '" + statement.words[0] +
         "' are indented further and belong to no statement; indent all statements alike";
}

std::vector<std::string_view> linesOf(std::string_view text) {
  std::vector<std::string_view> lines;
  while (!text.empty()) {
    const size_t end = text.find('\n');
    lines.push_back(text.substr(0, end));
    if (end == std::string_view::npos) break;
    text.remove_prefix(end + 1);
  }
  return lines;
}

}  // namespace gable::cases
