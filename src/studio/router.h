// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What each address of the studio answers; docs/dev/studio-protocol.md has the table. Requests come
// from a server (server.cpp) or from the page itself (desk.cpp).
//
// Any thread may call.
#pragma once

#include <functional>
#include <map>
#include <string>

#include "gable/studio.h"
#include "studio/export.h"
#include "studio/gallery.h"
#include "studio/message.h"
#include "studio/project_files.h"
#include "studio/session.h"

namespace gable::studio {

class Router {
 public:
  explicit Router(const StudioSettings& settings);

  bool ok() const { return files_.ok(); }
  const std::string& root() const { return files_.root(); }
  /// Of a derivation that has to wait, the one before ends at once.
  void arrived(const HttpRequest& r);
  HttpResponse answer(const HttpRequest& r);

 private:
  HttpResponse page(const HttpRequest& r) const;
  HttpResponse project() const;
  HttpResponse file(const HttpRequest& r) const;
  HttpResponse save(const HttpRequest& r);
  HttpResponse create(const HttpRequest& r);
  HttpResponse keepRecovery(const HttpRequest& r);
  HttpResponse derived(const HttpRequest& r, bool tree);
  HttpResponse progress(const HttpRequest& r) const;
  HttpResponse exported(const HttpRequest& r);
  HttpResponse sun(const HttpRequest& r) const;
  HttpResponse converted(const HttpRequest& r) const;
  HttpResponse shapes(const HttpRequest& r);
  HttpResponse asset(const HttpRequest& r);
  HttpResponse copied(const HttpRequest& r);

  ProjectFiles files_;
  ProjectFiles page_;
  Gallery gallery_;
  const SearchSettings search_;
  Session session_;
  Exports exports_;
  std::map<std::string, std::function<HttpResponse(const HttpRequest&)>> routes_;
};

}  // namespace gable::studio
