// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "shape/file_query.h"

#include <algorithm>
#include <array>

#include "base/text.h"
#include "base/work.h"

namespace gable {

namespace {

constexpr std::string_view kBlanks = " \t\r\n";

// The next term, its quotes taken away; false at the end.
Result<bool> nextTerm(std::string_view& rest, std::string& out) {
  out.clear();
  rest.remove_prefix(std::min(rest.find_first_not_of(kBlanks), rest.size()));
  if (rest.empty()) return false;
  while (!rest.empty() && kBlanks.find(rest[0]) == std::string_view::npos) {
    work();
    if (rest[0] != '\'') {
      out += rest[0];
      rest.remove_prefix(1);
      continue;
    }
    const size_t end = rest.find('\'', 1);
    if (end == std::string_view::npos) {
      return Error{"bad-query", "a quote of the search is not closed",
                   "put a second ' where the name ends"};
    }
    out += rest.substr(1, end - 1);
    rest.remove_prefix(end + 1);
  }
  return true;
}

}  // namespace

bool matchesWildcards(std::string_view pattern, std::string_view text) {
  size_t p = 0, t = 0, star = std::string_view::npos, from = 0;
  while (t < text.size()) {
    work();
    if (p < pattern.size() && pattern[p] == '*') {
      star = p++;
      from = t;
    } else if (p < pattern.size() && (pattern[p] == '?' || pattern[p] == text[t])) {
      ++p, ++t;
    } else if (star != std::string_view::npos) {
      // The last star takes one more.
      p = star + 1;
      t = ++from;
    } else {
      return false;
    }
  }
  return pattern.find_first_not_of('*', p) == std::string_view::npos;
}

Result<FileQuery> FileQuery::parse(std::string_view text) {
  constexpr std::array<std::pair<std::string_view, Property>, 4> kProperties{
      {{"Name", Property::Name},
       {"Ext", Property::Extension},
       {"Path", Property::Path},
       {"Project", Property::Project}}};
  FileQuery query;
  std::string word;
  for (;;) {
    Result<bool> more = nextTerm(text, word);
    if (!more.ok()) return more.error();
    if (!*more) break;
    Term term;
    const size_t mark = word.find_first_of("=:");
    for (const auto& [name, property] : kProperties) {
      if (mark == std::string::npos || !equalButForCase(name, word.substr(0, mark))) continue;
      term.property = property;
      word.erase(0, mark + 1);
      break;
    }
    if (!word.empty() && word[0] == '$') {
      term.regex.emplace_back(std::string_view(word).substr(1));
      if (!term.regex[0].valid()) {
        return Error{"bad-query",
                     "the regular expression '" + word.substr(1) +
                         "' of the search cannot be read: " + term.regex[0].error(),
                     "without a $ in front * and ? are wildcards"};
      }
    }
    term.text = word;
    query.terms_.push_back(std::move(term));
  }
  return query;
}

bool FileQuery::Term::holds(std::string_view value) const {
  return regex.empty() ? matchesWildcards(text, value) : regex[0].matchesWhole(value);
}

bool FileQuery::leavesTheProject() const {
  return std::all_of(terms_.begin(), terms_.end(), [](const Term& t) {
    const bool path = t.property == Property::Any || t.property == Property::Path;
    return !path || t.text.find_first_of("/*?$") == 0;
  });
}

bool FileQuery::matches(std::string_view path, std::string_view project, bool own) const {
  constexpr std::string_view kAssets = "/assets/";
  const std::string whole = "/" + std::string(project) + std::string(path);
  const std::string_view name = path.substr(path.rfind('/') + 1);
  const size_t dot = name.rfind('.');
  const std::string_view extension =
      dot == std::string_view::npos ? std::string_view() : name.substr(dot + 1);
  const auto holds = [&](const Term& t) {
    switch (t.property) {
      case Property::Name: return t.holds(name);
      case Property::Extension: return t.holds(extension);
      case Property::Project: return t.holds(project);
      case Property::Any:
      case Property::Path: break;
    }
    // From the assets, from the project, with a slash from its root, and from the workspace.
    const bool inside =
        own && ((path.starts_with(kAssets) && t.holds(path.substr(kAssets.size()))) ||
                t.holds(path.substr(1)) || t.holds(path));
    return inside || t.holds(whole);
  };
  return !terms_.empty() && std::all_of(terms_.begin(), terms_.end(), holds);
}

}  // namespace gable
