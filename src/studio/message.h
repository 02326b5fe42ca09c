// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// A request to the studio and its answer, whatever way they take.
#pragma once

#include <atomic>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace gable::studio {

struct HttpRequest {
  std::string method;
  /// Decoded, without the query.
  std::string path;
  /// Decoded; of a name that comes twice, the last.
  std::map<std::string, std::string> query;
  /// Names in lower case.
  std::map<std::string, std::string> headers;
  std::string body;
  std::shared_ptr<std::atomic<bool>> cancelled;

  /// Empty when there is none.
  std::string header(const std::string& name) const;
  std::string argument(const std::string& name) const;
};

struct HttpResponse {
  int status = 200;
  std::string type = "application/json";
  std::string body;
  std::vector<std::pair<std::string, std::string>> headers;
  /// Of the body, behind `body`: what is large comes in pieces and stays where it is.
  std::vector<std::string> rest = {};
  /// Gets `rest` back when it has been sent; may be empty.
  std::function<void(std::vector<std::string>)> sent = {};
  /// Called once the answer is on its way, by who made it; may be empty.
  std::function<void()> after = {};
};

/// What the handler answers. What it throws would end the program, and is told instead.
HttpResponse answered(const std::function<HttpResponse(const HttpRequest&)>& handler,
                      const HttpRequest& request);

}  // namespace gable::studio
