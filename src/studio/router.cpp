// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "studio/router.h"

#include <algorithm>
#include <cstdlib>
#include <utility>

#include "base/files.h"
#include "base/json.h"
#include "json/answers.h"
#include "studio/workshop.h"

namespace gable::studio {

namespace {

constexpr const char* kBytes = "application/octet-stream";
/// The page may load and do what is its own, and nothing else.
constexpr const char* kPolicy =
    "default-src 'none'; script-src 'self'; style-src 'self' 'unsafe-inline'; font-src 'self'; "
    "img-src 'self' blob: data:; connect-src 'self' blob:; frame-ancestors 'none'; base-uri 'none'";

int statusFor(const std::string& code) {
  if (code == "path-outside" || code == "kind-refused") return 403;
  if (code == "version-differs") return 409;
  if (code == "file-missing" || code == "derivation-gone" || code == "leaf-missing" ||
      code == "texture-not-found")
    return 404;
  if (code == "file-too-large") return 413;
  if (code == "file-unwritable" || code == "file-unreadable") return 500;
  return 422;
}

HttpResponse failed(const Error& e) {
  std::string out;
  JsonWriter json(out);
  json.beginObject().key("code").value(e.code).key("message").value(e.message);
  json.key("hint").value(e.hint).endObject();
  return {statusFor(e.code), "application/json", out, {}};
}

HttpResponse bytesOf(Result<std::string> content, const char* type = kBytes) {
  if (!content.ok()) return failed(content.error());
  return {200, type, std::move(content.value()), {{"Cache-Control", "no-store"}}};
}

HttpResponse jsonOf(std::string json) { return {200, "application/json", std::move(json), {}}; }

HttpResponse missing() { return {404, "text/plain", "There is nothing here.\n", {}}; }

const char* typeOf(const std::string& path) {
  static const std::map<std::string, const char*> kTypes = {{"html", "text/html; charset=utf-8"},
                                                            {"js", "text/javascript"},
                                                            {"css", "text/css"},
                                                            {"svg", "image/svg+xml"},
                                                            {"png", "image/png"},
                                                            {"woff2", "font/woff2"},
                                                            {"json", "application/json"},
                                                            {"txt", "text/plain"}};
  const auto at = kTypes.find(extensionOf(path));
  return at == kTypes.end() ? kBytes : at->second;
}

/// A text becomes a tree that takes five times its room, and a page may ask for four at once.
constexpr size_t kLargestConverted = 8 << 20;

uint64_t numberOf(const std::string& text) {
  return static_cast<uint64_t>(std::strtoull(text.c_str(), nullptr, 10));
}

}  // namespace

Router::Router(const StudioSettings& settings)
    : files_(settings.project),
      page_(settings.page),
      gallery_(settings.examples.value_or(std::string())),
      search_(settings.search),
      session_(files_, settings.search, settings.derivationsBefore) {
  routes_["GET /api/project"] = [this](const HttpRequest&) { return project(); };
  routes_["GET /api/ops"] = [](const HttpRequest&) { return jsonOf(builtinsJson(builtins())); };
  routes_["GET /api/file"] = [this](const HttpRequest& r) { return file(r); };
  routes_["PUT /api/file"] = [this](const HttpRequest& r) { return save(r); };
  routes_["POST /api/files"] = [this](const HttpRequest& r) { return create(r); };
  routes_["GET /api/previous"] = [this](const HttpRequest& r) {
    return bytesOf(files_.previous(r.argument("path")));
  };
  routes_["GET /api/recovery"] = [this](const HttpRequest& r) {
    Result<std::string> kept = files_.recovery(r.argument("path"));
    // Nothing to recover is the usual case and no failure.
    if (!kept.ok() && kept.error().code == "file-missing") return HttpResponse{204, "", "", {}};
    return bytesOf(std::move(kept));
  };
  routes_["PUT /api/recovery"] = [this](const HttpRequest& r) { return keepRecovery(r); };
  routes_["DELETE /api/recovery"] = [this](const HttpRequest& r) {
    files_.dropRecovery(r.argument("path"));
    return jsonOf("{}");
  };
  routes_["POST /api/derive"] = [this](const HttpRequest& r) { return derived(r, false); };
  routes_["POST /api/tree"] = [this](const HttpRequest& r) { return derived(r, true); };
  routes_["GET /api/parts"] = [this](const HttpRequest& r) {
    return bytesOf(session_.parts(numberOf(r.argument("derivation")), numberOf(r.argument("leaf")),
                                  numberOf(r.argument("level"))),
                   "application/json");
  };
  routes_["GET /api/progress"] = [this](const HttpRequest& r) { return progress(r); };
  routes_["GET /api/export"] = [this](const HttpRequest& r) { return exported(r); };
  routes_["GET /api/export-progress"] = [this](const HttpRequest& r) {
    return jsonOf(exports_.progressJson(r.argument("page")));
  };
  routes_["GET /api/sun"] = [this](const HttpRequest& r) { return sun(r); };
  routes_["GET /api/leaf"] = [this](const HttpRequest& r) {
    return bytesOf(session_.leaf(numberOf(r.argument("derivation")), numberOf(r.argument("leaf"))),
                   "application/json");
  };
  routes_["POST /api/convert"] = [this](const HttpRequest& r) { return converted(r); };
  routes_["POST /api/shapes"] = [this](const HttpRequest& r) { return shapes(r); };
  routes_["GET /api/model"] = [this](const HttpRequest& r) {
    return bytesOf(modelPreview(files_, session_, r.argument("path")));
  };
  routes_["POST /api/asset"] = [this](const HttpRequest& r) { return asset(r); };
  routes_["GET /api/texture"] = [this](const HttpRequest& r) {
    return bytesOf(session_.texture(numberOf(r.argument("derivation")), r.argument("path")));
  };
  routes_["GET /api/examples"] = [this](const HttpRequest&) { return jsonOf(gallery_.list()); };
  routes_["GET /api/example-picture"] = [this](const HttpRequest& r) {
    return bytesOf(gallery_.picture(r.argument("name")), "image/png");
  };
  routes_["POST /api/example-copy"] = [this](const HttpRequest& r) { return copied(r); };
}

void Router::arrived(const HttpRequest& r) {
  if (r.path != "/api/derive" && r.path != "/api/tree") return;
  const Result<JsonValue> request = parseJson(r.body, {32, 1'000'000});
  if (request.ok()) session_.announce(request.value(), r.cancelled);
}

HttpResponse Router::answer(const HttpRequest& r) {
  if (r.path.compare(0, 5, "/api/") != 0) return page(r);
  const auto at = routes_.find(r.method + " " + r.path);
  return at == routes_.end() ? missing() : at->second(r);
}

HttpResponse Router::page(const HttpRequest& r) const {
  const std::string path = r.path == "/" ? "index.html" : r.path.substr(1);
  if (!page_.ok()) return missing();
  HttpResponse out = bytesOf(page_.read(path), typeOf(path));
  // Built files carry a hash of their content in their name; the page itself does not.
  const bool hashed = path.compare(0, 7, "assets/") == 0;
  out.headers = {{"Content-Security-Policy", kPolicy},
                 {"Referrer-Policy", "no-referrer"},
                 {"Cache-Control", hashed ? "max-age=31536000, immutable" : "no-store"}};
  return out;
}

HttpResponse Router::project() const {
  std::string out;
  JsonWriter json(out);
  json.beginObject().key("root").value(files_.root());
  json.key("name").value(fileNameOf(files_.root())).key("version").value(version());
  json.key("files").beginArray();
  for (const ProjectFile& f : files_.list()) {
    json.beginObject().key("path").value(f.path).key("bytes").value(f.bytes);
    json.key("stamp").value(f.stamp).endObject();
  }
  json.endArray().endObject();
  return jsonOf(out);
}

HttpResponse Router::file(const HttpRequest& r) const {
  Result<std::string> content = files_.read(r.argument("path"));
  if (!content.ok()) return failed(content.error());
  const std::string version = ProjectFiles::versionOf(content.value());
  HttpResponse out = bytesOf(std::move(content));
  out.headers.emplace_back("X-Gable-Version", version);
  return out;
}

HttpResponse Router::save(const HttpRequest& r) {
  const Result<std::string> version =
      files_.write(r.argument("path"), r.body, r.argument("expected"));
  if (!version.ok()) return failed(version.error());
  session_.forget();
  std::string out;
  JsonWriter(out).beginObject().key("version").value(version.value()).endObject();
  return jsonOf(out);
}

// A line of JSON, [[path, bytes], ...], and behind it the contents one after the other.
HttpResponse Router::create(const HttpRequest& r) {
  const size_t line = std::min(r.body.find('\n'), r.body.size());
  const Result<JsonValue> list = parseJson(r.body.substr(0, line), {4, 100'000});
  if (!list.ok()) return failed(list.error());
  std::vector<std::pair<std::string, std::string>> files;
  size_t at = line + 1;
  for (const JsonValue& each : list.value().items()) {
    const double bytes = each.at(1).number(-1);
    if (!(bytes >= 0) || at > r.body.size() || bytes > static_cast<double>(r.body.size() - at)) {
      return failed({"request-wrong", "the body ends before its files do", ""});
    }
    files.emplace_back(each.at(0).text(), r.body.substr(at, static_cast<size_t>(bytes)));
    at += static_cast<size_t>(bytes);
  }
  const Result<uint64_t> made = files_.create(files);
  if (!made.ok()) return failed(made.error());
  session_.forget();
  return jsonOf("{}");
}

HttpResponse Router::keepRecovery(const HttpRequest& r) {
  const auto kept = files_.keepRecovery(r.argument("path"), r.body);
  return kept.ok() ? jsonOf("{}") : failed(kept.error());
}

HttpResponse Router::derived(const HttpRequest& r, bool tree) {
  const Result<JsonValue> request = parseJson(r.body, {32, 1'000'000});
  if (!request.ok()) return failed(request.error());
  if (!plainPath(request.value()["file"].text())) {
    return failed({"path-outside", "'file' names no file of the project", ""});
  }
  if (tree) return bytesOf(session_.tree(request.value(), r.cancelled));
  Result<Session::Answer> made = session_.derive(request.value(), r.cancelled);
  if (!made.ok()) return failed(made.error());
  HttpResponse out = bytesOf(std::move(made->head));
  out.rest = std::move(made->list);
  out.sent = [this](std::vector<std::string> pieces) { session_.reuse(std::move(pieces)); };
  out.after = [this, page = request.value()["page"].text()] { session_.prepareNext(page); };
  return out;
}

HttpResponse Router::progress(const HttpRequest& r) const {
  const auto [done, total] = session_.progress(r.argument("page"));
  std::string out;
  JsonWriter json(out);
  json.beginObject().key("done").value(static_cast<uint64_t>(done));
  json.key("total").value(static_cast<uint64_t>(total)).endObject();
  return jsonOf(out);
}

HttpResponse Router::exported(const HttpRequest& r) {
  const Result<Model> model = session_.model(numberOf(r.argument("derivation")));
  if (!model.ok()) return failed(model.error());
  const Result<PictureSettings> picture =
      pictureOf(r.argument("camera"), r.argument("size"), r.argument("sun"));
  if (!picture.ok()) return failed(picture.error());
  Result<Exported> made = exports_.write(model.value(), r.argument("format"), r.argument("page"),
                                         r.cancelled, picture.value());
  if (!made.ok()) return failed(made.error());
  return {200,
          kBytes,
          std::move(made->bytes),
          {{"Cache-Control", "no-store"}, {"X-Gable-Extension", made->extension}}};
}

HttpResponse Router::sun(const HttpRequest& r) const {
  const Result<Model> model = session_.model(numberOf(r.argument("derivation")));
  if (!model.ok()) return failed(model.error());
  return bytesOf(sunJson(model.value(), r.argument("day"), r.argument("hour"), r.argument("place")),
                 "application/json");
}

HttpResponse Router::converted(const HttpRequest& r) const {
  const std::string path = r.argument("path");
  if (!plainPath(path)) return failed({"path-outside", "'path' names no file", ""});
  if (r.body.size() > kLargestConverted) {
    return failed({"file-too-large", "rules of more than 8 MB are not converted here",
                   "gable convert takes them"});
  }
  LoadSettings options;
  options.project = files_.root();
  options.search = search_;
  const Converted text = convert(r.body, files_.root() + "/" + path, options);
  std::string out;
  JsonWriter json(out);
  json.beginObject().key("text").value(text.text);
  json.key("diagnostics").raw(diagnosticsJson(text.diagnostics)).endObject();
  return jsonOf(out);
}

HttpResponse Router::shapes(const HttpRequest& r) {
  const Result<JsonValue> request = parseJson(r.body, {32, 1'000'000});
  if (!request.ok()) return failed(request.error());
  const auto found = session_.shapesOf(request.value());
  return found.ok() ? jsonOf(outlinesJson(*found.value())) : failed(found.error());
}

HttpResponse Router::asset(const HttpRequest& r) {
  const Result<JsonValue> request = parseJson(r.body, {8, 1000});
  if (!request.ok()) return failed(request.error());
  Result<std::string> made = prepareAsset(files_, request.value());
  if (!made.ok()) return failed(made.error());
  session_.forget();
  return jsonOf(std::move(made.value()));
}

HttpResponse Router::copied(const HttpRequest& r) {
  const Result<std::string> folder = gallery_.copyTo(files_, r.argument("name"));
  if (!folder.ok()) return failed(folder.error());
  session_.forget();
  std::string out;
  JsonWriter(out).beginObject().key("folder").value(folder.value()).endObject();
  return jsonOf(out);
}

}  // namespace gable::studio
