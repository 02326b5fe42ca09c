// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The server of a page: the router's answers over HTTP, and the language server over WebSockets.

#include <memory>
#include <optional>
#include <set>
#include <thread>

#include "gable/lsp.h"
#include "gable/studio.h"
#include "studio/address.h"
#include "studio/guard.h"
#include "studio/http.h"
#include "studio/router.h"

namespace gable {

namespace studio {
namespace {

bool takesLong(const HttpRequest& r) {
  static const std::set<std::string> kPaths = {"/api/derive",  "/api/tree",   "/api/export",
                                               "/api/convert", "/api/shapes", "/api/model",
                                               "/api/asset"};
  return kPaths.count(r.path) > 0;
}

// The language server for a page, over the files of its project.
class LanguageTalk final : public Conversation {
 public:
  LanguageTalk(const std::string& project, const SearchSettings& search)
      : server_({}, project, search) {}
  void receive(std::string_view message) override { server_.receive(message); }
  bool step() override { return server_.step(); }
  std::vector<std::string> take() override { return server_.take(); }
  std::optional<double> wait() const override { return server_.wait(); }

 private:
  LanguageServer server_;
};

StudioResult refusal(const Error& e) {
  Diagnostic d;
  d.code = e.code;
  d.message = e.message;
  d.hint = e.hint;
  d.rendered = "error: " + e.message + (e.hint.empty() ? "" : "\n  " + e.hint) + "\n";
  return {false, {d}};
}

}  // namespace
}  // namespace studio

StudioResult runStudio(const StudioSettings& settings, const std::atomic<bool>& stop,
                       const std::function<void(const std::string& url)>& ready) {
  using namespace studio;
  Router router(settings);
  if (!router.ok()) {
    return refusal({"folder-missing", "there is no folder '" + settings.project + "'",
                    "name the folder of your rules, or make it first"});
  }
  const ProjectFiles files(settings.project);
  const Address before = settings.token ? Address{} : addressBefore(files);
  std::optional<Guard> guard;
  const HttpServer::Admit admit = [&guard](const HttpRequest& r) { return guard->admit(r); };
  const HttpServer::Handler answer = [&router](const HttpRequest& r) { return router.answer(r); };
  const HttpServer::Slow slow = {takesLong, [&router](const HttpRequest& r) { router.arrived(r); }};
  const auto talk = [&](const HttpRequest& r) -> std::unique_ptr<Conversation> {
    if (r.path != "/api/language") return nullptr;
    return std::make_unique<LanguageTalk>(router.root(), settings.search);
  };
  const HttpServer::Talks talks = {talk, "gable-language"};
  HttpSettings http;
  http.address = settings.address;
  // Pages that are still open look for the studio where it was.
  const uint16_t wished = settings.port ? settings.port : before.port;
  std::optional<HttpServer> server;
  Result<uint16_t> port = uint16_t{0};
  for (const uint16_t tried : {wished, uint16_t{0}}) {
    http.port = tried;
    server.emplace(http, admit, answer, slow, talks);
    port = server->listen();
    if (port.ok() || settings.port) break;
  }
  if (!port.ok()) return refusal(port.error());
  std::optional<HttpServer> old;
  if (before.port && before.port != port.value()) {
    http.port = before.port;
    old.emplace(http, admit, answer, slow, talks);
    if (!old->listen().ok()) old.reset();
  }
  std::string token = settings.token.value_or(before.token);
  if (token.empty()) token = drawToken();
  if (!settings.token) keepAddress(files, {port.value(), token});
  std::vector<std::string> hosts;
  for (const uint16_t known : {port.value(), old ? before.port : port.value()}) {
    const std::string end = ":" + std::to_string(known);
    for (const std::string& name : {std::string("127.0.0.1"), std::string("localhost"),
                                    std::string("[::1]"), settings.address}) {
      hosts.push_back(name + end);
    }
  }
  guard.emplace(token, hosts);
  ready("http://" + settings.address + ":" + std::to_string(port.value()) + "/?token=" + token);
  std::thread beside([&] {
    if (old) old->run(stop);
  });
  server->run(stop);
  beside.join();
  return {true, {}};
}

}  // namespace gable
