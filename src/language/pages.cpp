// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The pages of the reference, which the build puts into the program as they are under
// docs/reference. The lists of operations, functions and attributes there say which page has a
// name; a page of several names has a heading for each.

#include <map>

#include "language/service.h"

namespace gable::language {

struct PageFile {
  const char* path;
  const char* text;
};

// Made by cmake/pages.cmake.
extern const PageFile kPageFiles[];
extern const size_t kPageFileCount;

namespace {

std::string_view fileNamed(std::string_view path) {
  for (size_t i = 0; i < kPageFileCount; ++i) {
    if (path == kPageFiles[i].path) return kPageFiles[i].text;
  }
  return {};
}

// Rows such as "| [`split`](operations/split.md) | ...": name to page.
std::map<std::string_view, std::string_view> makeIndex() {
  std::map<std::string_view, std::string_view> out;
  for (const char* list : {"attributes.md", "functions.md", "operations.md"}) {
    std::string_view rest = fileNamed(list);
    for (size_t at = rest.find("\n| [`"); at != std::string_view::npos; at = rest.find("\n| [`")) {
      rest.remove_prefix(at + 5);
      const size_t name = rest.find("`](");
      const size_t end = rest.find(')');
      if (name == std::string_view::npos || end == std::string_view::npos || end < name) break;
      out[rest.substr(0, name)] = rest.substr(name + 3, end - name - 3);
    }
  }
  return out;
}

// Links lead to files that a reader of this text does not have, and so do pictures.
std::string withoutLinks(std::string_view text) {
  std::string out;
  for (size_t at = 0; at < text.size();) {
    const bool picture = text.substr(at, 2) == "![";
    const size_t open = picture ? at + 1 : at;
    if (text[open] != '[') {
      out += text[at++];
      continue;
    }
    const size_t close = text.find(']', open);
    const bool link = close != std::string_view::npos && text.substr(close, 2) == "](";
    const size_t end = link ? text.find(')', close) : std::string_view::npos;
    if (end == std::string_view::npos ||
        text.substr(open, close - open).find('\n') != std::string_view::npos) {
      out += text[at++];
      continue;
    }
    if (!picture) out += text.substr(open + 1, close - open - 1);
    at = end + 1;
  }
  return out;
}

}  // namespace

std::string pageOf(std::string_view name) {
  static const std::map<std::string_view, std::string_view> kIndex = makeIndex();
  const auto at = kIndex.find(name);
  if (at == kIndex.end()) return {};
  std::string_view page = fileNamed(at->second);
  // The note of the generator.
  if (page.starts_with("<!--")) page.remove_prefix(std::min(page.find("# "), page.size()));
  const std::string heading = "\n## " + std::string(name) + "\n";
  const size_t own = page.find(heading);
  if (own != std::string_view::npos) {
    page.remove_prefix(own + 1);
    page = page.substr(0, page.find("\n## ", 1));
  } else if (const std::string row = "| `" + std::string(name) + "` |";
             page.find(row) != std::string_view::npos && at->second.starts_with("functions/")) {
    // An attribute of the shape: its row of the table.
    page.remove_prefix(page.find(row));
    page = page.substr(0, page.find('\n'));
    return withoutLinks(page.substr(1));
  }
  return withoutLinks(page);
}

std::string referencePage(const std::string& name) { return pageOf(name); }

}  // namespace gable::language
