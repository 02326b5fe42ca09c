// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "studio/address.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>

#include "base/files.h"
#include "base/json.h"
#include "studio/guard.h"

namespace gable::studio {

namespace fs = std::filesystem;

namespace {

constexpr const char* kName = "address.json";

// A regular file of this user that nobody else can read or write.
bool isOurs(const std::string& path) {
  struct stat is = {};
  return lstat(path.c_str(), &is) == 0 && S_ISREG(is.st_mode) && is.st_uid == geteuid() &&
         (is.st_mode & 077) == 0;
}

}  // namespace

Address addressBefore(const ProjectFiles& files) {
  const Result<std::string> place = files.ownPlace(kName);
  if (!place.ok() || !isOurs(place.value())) return {};
  const Result<std::string> text = readFile(place.value(), 1000);
  if (!text.ok()) return {};
  const Result<JsonValue> json = parseJson(text.value(), {4, 10});
  if (!json.ok()) return {};
  const double port = json.value()["port"].number(0);
  const std::string& token = json.value()["token"].text();
  if (!(port >= 1 && port <= 65535) || !isToken(token)) return {};
  return {static_cast<uint16_t>(port), token};
}

void keepAddress(const ProjectFiles& files, const Address& address) {
  const Result<std::string> place = files.ownPlace(kName);
  if (!place.ok()) return;
  std::error_code ignored;
  const fs::path folder = fs::path(place.value()).parent_path();
  fs::create_directories(folder, ignored);
  // What the studio keeps for itself is nothing for a repository.
  if (!fs::exists(folder / ".gitignore", ignored))
    writeFile((folder / ".gitignore").string(), "*\n");
  fs::remove(place.value(), ignored);
  std::string text;
  JsonWriter json(text);
  json.beginObject().key("port").value(static_cast<uint64_t>(address.port));
  json.key("token").value(address.token).endObject();
  const int file =
      ::open(place.value().c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0600);
  if (file < 0) return;
  const bool written = ::write(file, text.data(), text.size()) == static_cast<ssize_t>(text.size());
  ::close(file);
  if (!written) fs::remove(place.value(), ignored);
}

}  // namespace gable::studio
