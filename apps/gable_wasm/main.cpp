// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The engine within a page: what the studio's server answers, as calls from JavaScript
// (engine.mjs). Texts and bytes come as an address and a length, and stay the
// caller's; what is answered stays the module's until the next call of the same name.
//
// The project is the folder /project of the module's own file system, the examples are /examples.
// One thread: whoever calls waits.
#include <algorithm>
#include <chrono>
#include <cstddef>
#include <deque>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "gable/lsp.h"
#include "gable/studio.h"

namespace {

constexpr const char* kProject = "/project";
constexpr const char* kExamples = "/examples";

struct Engine {
  std::unique_ptr<gable::StudioDesk> desk;
  gable::StudioAnswer answer;
  std::string head;
  std::unique_ptr<gable::LanguageServer> language;
  std::deque<std::string> said;
  std::string saying;
};

Engine& engine() {
  static Engine one;
  return one;
}

// The next of texts that end with a zero byte.
std::string take(std::string_view& rest) {
  const size_t end = std::min(rest.find('\0'), rest.size());
  std::string text(rest.substr(0, end));
  rest.remove_prefix(std::min(end + 1, rest.size()));
  return text;
}

}  // namespace

extern "C" {

/// Opens the project as it lies in the file system. False where the folder is missing.
int gable_open() {
  gable::StudioSettings settings;
  settings.project = kProject;
  settings.examples = kExamples;
  using std::chrono::milliseconds;
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  settings.derivationsBefore = std::chrono::duration_cast<milliseconds>(now).count();
  engine().desk = std::make_unique<gable::StudioDesk>(settings);
  return engine().desk->ok();
}

/// Answers a request. `head`: method, path, then names and values of the query, each with a zero
/// byte behind it. Gives the status; the rest of the answer is asked for below.
int gable_ask(const char* head, size_t headBytes, const char* body, size_t bodyBytes) {
  std::string_view rest(head, headBytes);
  gable::StudioRequest request;
  request.method = take(rest);
  request.path = take(rest);
  while (!rest.empty()) {
    std::string name = take(rest);
    request.query[std::move(name)] = take(rest);
  }
  request.body.assign(body, bodyBytes);
  Engine& e = engine();
  e.answer = e.desk->answer(std::move(request));
  e.head = "Content-Type\n" + e.answer.type + "\n";
  for (const auto& [name, value] : e.answer.headers) e.head += name + "\n" + value + "\n";
  return e.answer.status;
}

/// Names and values of the answer's headers, a line each.
const char* gable_head() { return engine().head.c_str(); }
const char* gable_body() { return engine().answer.body.data(); }
size_t gable_body_bytes() { return engine().answer.body.size(); }
/// The answer is not needed any more: a model may be large.
void gable_done() { engine().answer = {}; }

/// A session of the language server begins; the one before ends.
void gable_language_begin() {
  Engine& e = engine();
  e.language = std::make_unique<gable::LanguageServer>(nullptr, kProject);
  e.said.clear();
}

void gable_language_hear(const char* text, size_t bytes) {
  if (engine().language) engine().language->receive({text, bytes});
}

/// Does a piece of what there is to do; false when there is nothing now.
int gable_language_step() {
  Engine& e = engine();
  if (!e.language) return 0;
  const bool worked = e.language->step();
  for (std::string& message : e.language->take()) e.said.push_back(std::move(message));
  return worked;
}

/// Seconds until there is something to do without a message; below 0: never.
double gable_language_wait() {
  return engine().language ? engine().language->wait().value_or(-1) : -1;
}

/// The next message of the language server; null when there is none.
const char* gable_language_said() {
  Engine& e = engine();
  if (e.said.empty()) return nullptr;
  e.saying = std::move(e.said.front());
  e.said.pop_front();
  return e.saying.c_str();
}

}  // extern "C"
