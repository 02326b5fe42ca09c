// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Over libarchive, with its readers of 7z and zip alone and no filters around them.

#include "io/archive/archive_files.h"

#include <archive.h>
#include <archive_entry.h>

#include <algorithm>
#include <clocale>
#include <memory>

#include "base/work.h"

namespace gable {

namespace {

struct Free {
  void operator()(archive* a) const { archive_free(a); }
  void operator()(archive_entry* e) const { archive_entry_free(e); }
};
using Handle = std::unique_ptr<archive, Free>;

/// libarchive takes names to and from the encoding of the thread's locale, which must hold them
/// all.
class Utf8Names {
 public:
  Utf8Names() : utf8_(newlocale(LC_CTYPE_MASK, "C.UTF-8", nullptr)), before_(uselocale(utf8_)) {}
  ~Utf8Names() {
    uselocale(before_);
    if (utf8_) freelocale(utf8_);
  }
  Utf8Names(const Utf8Names&) = delete;
  Utf8Names& operator=(const Utf8Names&) = delete;

 private:
  locale_t utf8_, before_;
};

Error unreadable(const std::string& name, archive* a) {
  const char* why = archive_error_string(a);
  return {"archive-unreadable",
          "'" + name + "' cannot be read as an archive" + (why ? ": " + std::string(why) : ""),
          "it may be broken off; fetch it again, or make it again as .7z or .zip"};
}

// "a/b.txt" of "./a//b.txt"; empty for a path that leads elsewhere.
std::string innerPath(std::string path) {
  std::replace(path.begin(), path.end(), '\\', '/');
  const bool drive = path.size() > 1 && path[1] == ':';
  if (drive || path.find('\0') != std::string::npos) return {};
  std::string out;
  for (size_t from = 0; from < path.size();) {
    const size_t to = std::min(path.find('/', from), path.size());
    const std::string part = path.substr(from, to - from);
    from = to + 1;
    if (part == "..") return {};
    if (part.empty() || part == ".") continue;
    out += (out.empty() ? "" : "/") + part;
  }
  return path[0] == '/' ? std::string() : out;
}

struct Reader {
  archive* a;
  const std::string& name;
  const ArchiveLimits& limits;
  uint64_t packed;
  uint64_t total = 0;

  Error tooLarge(const std::string& what) const {
    return {"archive-too-large", "'" + name + "' unpacks to " + what,
            "if you trust it, unpack it and open the folder"};
  }

  std::string pathOf(archive_entry* entry) const {
    const char* path = archive_entry_pathname_utf8(entry);
    if (!path) path = archive_entry_pathname(entry);
    return path ? path : "";
  }

  // Nothing: the entry is a file that can be taken.
  std::optional<Error> refused(archive_entry* entry, const std::string& inner) const {
    const std::string path = pathOf(entry);
    if (archive_entry_is_data_encrypted(entry) != 0) {
      return Error{"archive-encrypted", "'" + path + "' in '" + name + "' is encrypted",
                   "make the archive without a password"};
    }
    const bool link = archive_entry_symlink(entry) || archive_entry_hardlink(entry) ||
                      archive_entry_filetype(entry) != AE_IFREG;
    if (!link && !inner.empty()) return std::nullopt;
    return Error{"archive-path",
                 "'" + path + "' in '" + name + "' " +
                     (link ? "is a link or a device" : "leads out of the archive"),
                 "make the archive with plain files and relative paths"};
  }

  std::optional<Error> take(std::string& bytes) {
    const void* data = nullptr;
    size_t size = 0;
    la_int64_t offset = 0;
    for (;;) {
      const int status = archive_read_data_block(a, &data, &size, &offset);
      if (status == ARCHIVE_EOF) return std::nullopt;
      if (status != ARCHIVE_OK) return unreadable(name, a);
      work(1 + size / 64);
      // Holes of sparse files count as if they were there.
      const uint64_t end = static_cast<uint64_t>(offset) + size;
      if (end < bytes.size() || end > limits.bytes) return tooLarge("too much in one file");
      total += end - bytes.size();
      if (total > limits.bytes) {
        return tooLarge("more than " + std::to_string(limits.bytes >> 20) + " MiB");
      }
      if (total > limits.free && total / limits.ratio > packed) {
        return tooLarge("more than " + std::to_string(limits.ratio) + " times its size");
      }
      workMemory(end);
      bytes.resize(static_cast<size_t>(offset));
      bytes.append(static_cast<const char*>(data), size);
    }
  }
};

}  // namespace

Result<ArchiveFiles> readArchive(std::string_view bytes, const std::string& name,
                                 const ArchiveLimits& limits) {
  const Utf8Names names;
  const Handle handle(archive_read_new());
  archive* a = handle.get();
  archive_read_support_format_7zip(a);
  // With its table of contents alone: without it a zip that is broken off would pass as a shorter
  // one.
  archive_read_support_format_zip_seekable(a);
  if (archive_read_open_memory(a, bytes.data(), bytes.size()) != ARCHIVE_OK) {
    return unreadable(name, a);
  }
  Reader reader{a, name, limits, bytes.size()};
  ArchiveFiles files;
  uint64_t entries = 0;
  for (;;) {
    archive_entry* entry = nullptr;
    const int status = archive_read_next_header(a, &entry);
    if (status == ARCHIVE_EOF) break;
    if (status != ARCHIVE_OK && status != ARCHIVE_WARN) {
      if (archive_read_has_encrypted_entries(a) > 0) {
        return Error{"archive-encrypted", "'" + name + "' is encrypted",
                     "make the archive without a password"};
      }
      return unreadable(name, a);
    }
    work();
    if (++entries > limits.files) {
      return reader.tooLarge("more than " + std::to_string(limits.files) + " files");
    }
    const std::string inner = innerPath(reader.pathOf(entry));
    const bool folder = archive_entry_filetype(entry) == AE_IFDIR;
    if (folder) continue;
    if (const auto why = reader.refused(entry, inner)) return *why;
    std::string content;
    if (const auto why = reader.take(content)) return *why;
    files[inner] = std::move(content);
  }
  if (entries == 0) return unreadable(name, a);
  return files;
}

Result<std::string> writeArchive(const ArchiveFiles& files, ArchiveKind kind) {
  std::string out;
  const Utf8Names names;
  const Handle handle(archive_write_new());
  archive* a = handle.get();
  const auto failed = [&] {
    const char* why = archive_error_string(a);
    return Error{"archive-unwritable",
                 "the archive cannot be made" + (why ? ": " + std::string(why) : ""),
                 "see that there is room in the folder for temporary files"};
  };
  const auto append = [](archive*, void* to, const void* data, size_t size) -> la_ssize_t {
    static_cast<std::string*>(to)->append(static_cast<const char*>(data), size);
    return static_cast<la_ssize_t>(size);
  };
  const int format =
      kind == ArchiveKind::Zip ? archive_write_set_format_zip(a) : archive_write_set_format_7zip(a);
  if (format != ARCHIVE_OK || archive_write_set_bytes_in_last_block(a, 1) != ARCHIVE_OK ||
      archive_write_open(a, &out, nullptr, append, nullptr) != ARCHIVE_OK) {
    return failed();
  }
  // No times, owners or rights of this machine: the same files give the same bytes.
  for (const auto& [path, bytes] : files) {
    work(1 + bytes.size() / 16);
    const std::unique_ptr<archive_entry, Free> entry(archive_entry_new());
    archive_entry_update_pathname_utf8(entry.get(), path.c_str());
    archive_entry_set_filetype(entry.get(), AE_IFREG);
    archive_entry_set_perm(entry.get(), 0644);
    archive_entry_set_size(entry.get(), static_cast<la_int64_t>(bytes.size()));
    if (archive_write_header(a, entry.get()) < ARCHIVE_WARN ||
        archive_write_data(a, bytes.data(), bytes.size()) < static_cast<la_ssize_t>(bytes.size())) {
      return failed();
    }
  }
  if (archive_write_close(a) != ARCHIVE_OK) return failed();
  return out;
}

}  // namespace gable
