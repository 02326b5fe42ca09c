// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "dialects/line_layout.h"

#include <algorithm>
#include <vector>

namespace gable {

namespace {

constexpr size_t kStep = 2;
/// Nobody reads what is indented further.
constexpr size_t kMostIndent = 40;

bool isBlank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\f' || c == '\v'; }

std::string_view withoutEnd(std::string_view line) {
  while (!line.empty() && isBlank(line.back())) line.remove_suffix(1);
  return line;
}

class LineLayout {
 public:
  explicit LineLayout(SignSpacing spacing) : even_(spacing == SignSpacing::Even) {}

  void add(std::string_view raw) {
    const std::string_view line = withoutEnd(raw);
    if (inComment_) {
      // The lines of a comment are its author's.
      out_ += line;
      walk(line, nullptr);
      out_ += '\n';
      empty_ = false;
      return;
    }
    const size_t begin = std::find_if_not(line.begin(), line.end(), isBlank) - line.begin();
    const std::string_view body = line.substr(begin);
    if (body.empty()) {
      if (!empty_ && !out_.empty()) out_ += '\n';
      empty_ = true;
      return;
    }
    empty_ = false;
    indent_ = indentOf(body, begin > 0);
    out_.append(indent_, ' ');
    std::string laid;
    walk(body, &laid);
    out_ += withoutEnd(laid);
    out_ += '\n';
  }

  std::string finish() {
    while (out_.ends_with("\n\n")) out_.pop_back();
    return std::move(out_);
  }

 private:
  static bool opens(char c) { return c == '(' || c == '[' || c == '{'; }
  static bool closes(char c) { return c == ')' || c == ']' || c == '}'; }

  size_t indentOf(std::string_view body, bool indented) const {
    if (open_.empty()) return indented ? kStep : 0;
    if (closes(body[0])) return open_.back();
    return std::min(open_.back() + kStep, kMostIndent);
  }

  // Follows the brackets and comments of a line, and writes it with even blanks to `laid`.
  void walk(std::string_view s, std::string* laid) {
    const auto put = [&](std::string_view piece) {
      if (laid) *laid += piece;
    };
    for (size_t at = 0; at < s.size();) {
      const char c = s[at], next = at + 1 < s.size() ? s[at + 1] : '\0';
      if (inComment_) {
        const size_t end = s.find("*/", at);
        inComment_ = end == s.npos;
        put(s.substr(at, inComment_ ? s.npos : end + 2 - at));
        at = inComment_ ? s.size() : end + 2;
      } else if (c == '#' || (c == '/' && next == '/')) {
        return put(s.substr(at));
      } else if (c == '/' && next == '*') {
        inComment_ = true;
        put("/*");
        at += 2;
      } else if (c == '"') {
        const size_t end = s.find('"', at + 1);
        const size_t length = end == s.npos ? s.size() - at : end + 1 - at;
        put(s.substr(at, length));
        at += length;
      } else if (isBlank(c)) {
        at = blanks(s, at, laid);
      } else {
        if (opens(c)) open_.push_back(indent_);
        if (closes(c) && !open_.empty()) open_.pop_back();
        at += sign(s, at, laid);
      }
    }
  }

  // The blanks before a comment at the end of a line align it, and stay.
  size_t blanks(std::string_view s, size_t at, std::string* laid) const {
    size_t end = at;
    while (end < s.size() && isBlank(s[end])) ++end;
    const std::string_view rest = s.substr(end);
    if (!laid) return end;
    if (rest.starts_with("#") || rest.starts_with("//")) {
      while (laid->ends_with(' ')) laid->pop_back();
      laid->append(s.substr(at, end - at));
    } else if (!(even_ && rest.starts_with(",")) && !laid->ends_with(' ')) {
      *laid += ' ';
    }
    return end;
  }

  size_t sign(std::string_view s, size_t at, std::string* laid) const {
    const bool arrow = s.substr(at).starts_with("->");
    const bool twice = s.substr(at).starts_with("||");
    const size_t length = arrow || twice ? 2 : 1;
    if (!laid) return length;
    const bool bar = s[at] == '|';
    if (even_ && (arrow || bar) && !laid->empty() && !laid->ends_with(' ')) *laid += ' ';
    laid->append(s.substr(at, length));
    if (even_ && (arrow || bar || s[at] == ',')) *laid += ' ';
    return length;
  }

  bool even_;
  bool inComment_ = false;
  bool empty_ = false;
  size_t indent_ = 0;
  /// For each open bracket the indent of its line.
  std::vector<size_t> open_;
  std::string out_;
};

}  // namespace

std::string withLaidOutLines(std::string_view text, SignSpacing spacing) {
  LineLayout layout(spacing);
  while (!text.empty()) {
    const size_t end = text.find('\n');
    layout.add(text.substr(0, end));
    text.remove_prefix(end == text.npos ? text.size() : end + 1);
  }
  return layout.finish();
}

}  // namespace gable
