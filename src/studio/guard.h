// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Who may ask the studio for what. Other pages in the same browser, and names that lead here from
// elsewhere, are strangers: they know no token, and their Host or Origin tells.
#pragma once

#include <string>
#include <vector>

#include "studio/http.h"

namespace gable::studio {

class Guard {
 public:
  /// `hosts`: the names with port under which the studio is reached.
  Guard(std::string token, std::vector<std::string> hosts)
      : token_(std::move(token)), hosts_(std::move(hosts)) {}
  /// Status 200, or the answer that refuses.
  HttpResponse admit(const HttpRequest& request) const;

 private:
  bool knownHost(const std::string& host) const;
  std::string token_;
  std::vector<std::string> hosts_;
};

/// 32 hexadecimal digits from the system's source of chance.
std::string drawToken();
/// Whether a text looks like one.
bool isToken(const std::string& text);

}  // namespace gable::studio
