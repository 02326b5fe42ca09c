// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "studio/message.h"

#include <exception>
#include <new>

#include "base/json.h"

namespace gable::studio {
namespace {

HttpResponse failure(const char* code, const char* message, const char* hint) {
  std::string out;
  JsonWriter json(out);
  json.beginObject().key("code").value(code).key("message").value(message);
  json.key("hint").value(hint).endObject();
  return {500, "application/json", out, {}};
}

}  // namespace

std::string HttpRequest::header(const std::string& name) const {
  const auto at = headers.find(name);
  return at == headers.end() ? std::string() : at->second;
}

std::string HttpRequest::argument(const std::string& name) const {
  const auto at = query.find(name);
  return at == query.end() ? std::string() : at->second;
}

HttpResponse answered(const std::function<HttpResponse(const HttpRequest&)>& handler,
                      const HttpRequest& request) {
  try {
    return handler(request);
  } catch (const std::bad_alloc&) {
    return failure("out-of-memory", "there is too little memory for the answer",
                   "derive fewer shapes at a time, or close other programs");
  } catch (const std::exception&) {
    return failure("internal-error", "the answer could not be made",
                   "what you have typed is safe; please report what led to this");
  }
}

}  // namespace gable::studio
