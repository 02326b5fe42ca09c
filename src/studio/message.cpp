// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "studio/message.h"

namespace gable::studio {

std::string HttpRequest::header(const std::string& name) const {
  const auto at = headers.find(name);
  return at == headers.end() ? std::string() : at->second;
}

std::string HttpRequest::argument(const std::string& name) const {
  const auto at = query.find(name);
  return at == query.end() ? std::string() : at->second;
}

}  // namespace gable::studio
