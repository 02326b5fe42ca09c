// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include <algorithm>
#include <chrono>

#include "base/json.h"
#include "engine/impl.h"

namespace gable {

double now() {
  using Clock = std::chrono::steady_clock;
  return std::chrono::duration<double>(Clock::now().time_since_epoch()).count();
}

bool hasErrors(const Messages& messages) {
  return std::any_of(messages.begin(), messages.end(),
                     [](const Message& m) { return m.level == Level::Error; });
}

Message toMessage(const Diagnostic& d, const Sources& sources) {
  Message m;
  m.level = static_cast<Level>(d.severity);
  m.code = d.code;
  m.text = d.message;
  m.hint = d.hint;
  m.shapePath = d.shapePath;
  m.pretty = format(d, sources);
  if (d.span.valid() && d.span.file < sources.size()) {
    const LineColumn from = sources.locate(d.span.file, d.span.begin);
    const LineColumn to = sources.locate(d.span.file, d.span.end);
    m.file = sources.path(d.span.file);
    m.line = from.line;
    m.column = from.column;
    m.endLine = to.line;
    m.endColumn = to.column;
  }
  if (d.fix && d.fix->span.valid() && d.fix->span.file < sources.size()) {
    const LineColumn from = sources.locate(d.fix->span.file, d.fix->span.begin);
    const LineColumn to = sources.locate(d.fix->span.file, d.fix->span.end);
    m.fix = Fix{
        sources.path(d.fix->span.file), from.line, from.column, to.line, to.column, d.fix->text};
  }
  return m;
}

Messages toMessages(const Diagnostics& diagnostics, const Sources& sources) {
  Messages out;
  for (const Diagnostic& d : diagnostics.all()) out.push_back(toMessage(d, sources));
  return out;
}

Message errorMessage(const Error& e) {
  return toMessage({Severity::Error, e.code, Span{}, e.message, e.hint, {}}, Sources{});
}

std::string messagesJson(const Messages& messages) {
  std::string out;
  JsonWriter json(out);
  json.beginArray();
  for (const Message& m : messages) {
    json.beginObject();
    json.key("severity").value(severityName(static_cast<Severity>(m.level)));
    json.key("code").value(m.code);
    if (!m.file.empty()) {
      json.key("file").value(m.file).key("line").value(m.line).key("column").value(m.column);
      json.key("endLine").value(m.endLine).key("endColumn").value(m.endColumn);
    }
    json.key("message").value(m.text);
    if (!m.hint.empty()) json.key("hint").value(m.hint);
    if (m.fix) {
      json.key("fix").beginObject().key("file").value(m.fix->file);
      json.key("line").value(m.fix->line).key("column").value(m.fix->column);
      json.key("endLine").value(m.fix->endLine).key("endColumn").value(m.fix->endColumn);
      json.key("text").value(m.fix->text).endObject();
    }
    if (!m.shapePath.empty()) json.key("shapePath").value(m.shapePath);
    json.endObject();
  }
  json.endArray();
  return out;
}

}  // namespace gable
