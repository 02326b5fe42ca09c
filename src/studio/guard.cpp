// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "studio/guard.h"

#include <algorithm>
#include <cstdio>
#include <random>

namespace gable::studio {

namespace {

HttpResponse refuse(int status, const char* why) { return {status, "text/plain", why, {}}; }

// Takes as long for a wrong first letter as for a wrong last one.
bool sameText(const std::string& a, const std::string& b) {
  if (a.size() != b.size()) return false;
  unsigned difference = 0;
  for (size_t i = 0; i < a.size(); ++i) difference |= static_cast<unsigned>(a[i] ^ b[i]);
  return difference == 0;
}

// A page cannot give a WebSocket headers of its own: its token is the last of the protocols that it
// asks for.
std::string tokenOf(const HttpRequest& r) {
  const std::string given = r.header("x-gable-token");
  if (!given.empty() || r.header("upgrade").empty()) return given;
  const std::string asked = r.header("sec-websocket-protocol");
  const size_t comma = asked.find_last_of(", ");
  return comma == std::string::npos ? std::string() : asked.substr(comma + 1);
}

}  // namespace

bool Guard::knownHost(const std::string& host) const {
  return std::find(hosts_.begin(), hosts_.end(), host) != hosts_.end();
}

HttpResponse Guard::admit(const HttpRequest& r) const {
  if (!knownHost(r.header("host"))) return refuse(403, "This host is not the studio.\n");
  const std::string origin = r.header("origin");
  const std::string scheme = "http://";
  if (!origin.empty() &&
      (origin.compare(0, scheme.size(), scheme) != 0 || !knownHost(origin.substr(scheme.size())))) {
    return refuse(403, "Other pages have no access.\n");
  }
  const bool reads = r.method == "GET" || r.method == "HEAD";
  if (r.path.compare(0, 5, "/api/") != 0) {
    return reads ? HttpResponse{} : refuse(405, "Pages are read only.\n");
  }
  if (!sameText(tokenOf(r), token_)) {
    return refuse(401, "Open the address that gable studio printed.\n");
  }
  if (!reads && r.method != "POST" && r.method != "PUT" && r.method != "DELETE") {
    return refuse(405, "There is no such method.\n");
  }
  return {};
}

bool isToken(const std::string& text) {
  return text.size() == 32 && text.find_first_not_of("0123456789abcdef") == std::string::npos;
}

std::string drawToken() {
  std::random_device source;
  std::string out;
  for (int i = 0; i < 4; ++i) {
    char part[9];
    std::snprintf(part, sizeof part, "%08x", static_cast<unsigned>(source()));
    out += part;
  }
  return out;
}

}  // namespace gable::studio
