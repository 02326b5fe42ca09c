// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "base/diagnostic.h"

#include <algorithm>
#include <tuple>

namespace gable {

Span Span::cover(Span a, Span b) {
  if (!a.valid()) return b;
  if (!b.valid()) return a;
  return {a.file, std::min(a.begin, b.begin), std::max(a.end, b.end)};
}

uint32_t Sources::add(std::string path, std::string text) {
  File f{std::move(path), std::move(text), {0}};
  for (uint32_t i = 0; i < f.text.size(); ++i) {
    if (f.text[i] == '\n') f.lineStarts.push_back(i + 1);
  }
  files_.push_back(std::move(f));
  return static_cast<uint32_t>(files_.size() - 1);
}

LineColumn Sources::locate(uint32_t file, uint32_t offset) const {
  const auto& starts = files_[file].lineStarts;
  const auto next = std::upper_bound(starts.begin(), starts.end(), offset);
  const auto line = static_cast<uint32_t>(next - starts.begin());
  return {line, offset - starts[line - 1] + 1};
}

std::string_view Sources::line(uint32_t file, uint32_t line) const {
  const File& f = files_[file];
  const uint32_t begin = f.lineStarts[line - 1];
  const uint32_t end =
      line < f.lineStarts.size() ? f.lineStarts[line] - 1 : static_cast<uint32_t>(f.text.size());
  std::string_view text = std::string_view(f.text).substr(begin, end - begin);
  if (!text.empty() && text.back() == '\r') text.remove_suffix(1);
  return text;
}

namespace {

// Messages quote what authors wrote, which may be megabytes.
void shorten(std::string& text) {
  constexpr size_t kMost = 2000, kEnd = 200;
  if (text.size() > kMost) text.replace(kMost - kEnd, text.size() - kMost, " ... ");
}

}  // namespace

void Diagnostics::add(Entry d) {
  shorten(d.message);
  shorten(d.hint);
  shorten(d.shapePath);
  if (d.severity == Severity::Error) ++errors_;
  all_.push_back(std::move(d));
}

void Diagnostics::error(std::string code, Span span, std::string message, std::string hint) {
  add({Severity::Error, std::move(code), span, std::move(message), std::move(hint), {}, {}});
}

void Diagnostics::warning(std::string code, Span span, std::string message, std::string hint) {
  add({Severity::Warning, std::move(code), span, std::move(message), std::move(hint), {}, {}});
}

void Diagnostics::fixLast(Span span, std::string text) {
  if (!all_.empty()) all_.back().fix = Replacement{span, std::move(text)};
}

void Diagnostics::append(const Diagnostics& other) {
  for (const Diagnostics::Entry& d : other.all_) add(d);
}

void Diagnostics::sortByPlace() {
  std::stable_sort(
      all_.begin(), all_.end(), [](const Diagnostics::Entry& a, const Diagnostics::Entry& b) {
        return std::tie(a.span.file, a.span.begin) < std::tie(b.span.file, b.span.begin);
      });
  const auto same = [](const Diagnostics::Entry& a, const Diagnostics::Entry& b) {
    return a.code == b.code && a.span.file == b.span.file && a.span.begin == b.span.begin &&
           a.message == b.message && a.shapePath == b.shapePath;
  };
  all_.erase(std::unique(all_.begin(), all_.end(), same), all_.end());
  errors_ =
      static_cast<size_t>(std::count_if(all_.begin(), all_.end(), [](const Diagnostics::Entry& d) {
        return d.severity == Severity::Error;
      }));
}

const char* severityName(Severity s) {
  switch (s) {
    case Severity::Note: return "note";
    case Severity::Warning: return "warning";
    case Severity::Error: break;
  }
  return "error";
}

namespace {

// The line with tabs as they are, then spaces and carets under the span, cut at the line's end.
// Very long lines are shown through a window around the place.
std::string excerpt(const Sources& sources, const Span& span, const LineColumn& at) {
  constexpr size_t kWindow = 120;
  std::string_view line = sources.line(span.file, at.line);
  size_t column = at.column - 1;
  std::string lead;
  if (line.size() > kWindow) {
    const size_t from = column > kWindow / 2 ? column - kWindow / 2 : 0;
    if (from > 0) lead = "...";
    line = line.substr(std::min(from, line.size()), kWindow);
    column -= from;
  }
  std::string out = "  " + lead + std::string(line) + "\n  " + std::string(lead.size(), ' ');
  // A character of several bytes takes one column.
  const auto begins = [&](size_t i) {
    return (static_cast<unsigned char>(line[i]) & 0xc0) != 0x80;
  };
  for (size_t i = 0; i < column && i < line.size(); ++i) {
    if (begins(i)) out += line[i] == '\t' ? '\t' : ' ';
  }
  const size_t length = span.end > span.begin ? span.end - span.begin : 1;
  size_t carets = 0;
  for (size_t i = column; i < line.size() && i - column < length; ++i) carets += begins(i) ? 1 : 0;
  return out + std::string(std::max<size_t>(1, carets), '^') + "\n";
}

// Signs that would move a terminal's cursor or change its colours become question marks.
void disarm(std::string& text) {
  for (char& c : text) {
    const auto u = static_cast<unsigned char>(c);
    if ((u < ' ' && c != '\n' && c != '\t') || u == 0x7f) c = '?';
  }
}

}  // namespace

std::string format(const Diagnostics::Entry& d, const Sources& sources) {
  std::string out;
  LineColumn at;
  if (d.span.valid()) {
    at = sources.locate(d.span.file, d.span.begin);
    out = sources.path(d.span.file) + ":" + std::to_string(at.line) + ":" +
          std::to_string(at.column) + ": ";
  }
  out += std::string(severityName(d.severity)) + ": " + d.message + " [" + d.code + "]\n";
  if (d.span.valid()) out += excerpt(sources, d.span, at);
  if (!d.shapePath.empty()) out += "  in " + d.shapePath + "\n";
  if (!d.hint.empty()) out += "  hint: " + d.hint + "\n";
  disarm(out);
  return out;
}

}  // namespace gable
