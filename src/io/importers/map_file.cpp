// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "io/importers/map_file.h"

#include <vector>

#include "base/child_process.h"
#include "base/file_pieces.h"
#include "base/files.h"
#include "base/temporary_folder.h"

namespace gable {
namespace {

constexpr ChildLimits kLimits{300, size_t{4} << 30};
// Of maps that are written to a file: a country takes an hour.
constexpr ChildLimits kLongLimits{24 * 3600, size_t{1} << 20};

bool isCode(const Error& e, std::string_view code) { return e.code == code; }

Error failed(const Error& why, const std::string& path, const char* package) {
  if (isCode(why, "child-missing")) {
    return {"shapes-reader", "'" + path + "' cannot be read here: " + why.message,
            std::string("install ") + package};
  }
  if (isCode(why, "child-limit")) {
    return {"shapes-too-large", "'" + path + "' is too large: " + why.message,
            "cut out the part that you need"};
  }
  // GDAL's programs list all their formats; ours tells the reason in a line.
  const bool inALine = why.message.find('\n') == std::string::npos;
  return {"shapes-broken", "'" + path + "' cannot be read" + (inALine ? ": " + why.message : ""),
          "open it in a map program and save it again"};
}

Result<std::string> openStreetMap(std::string_view bytes, const std::string& path) {
  const std::string program = programBeside("gable-maps");
  if (program.empty()) {
    return Error{"shapes-reader",
                 "'" + path +
                     "' needs the program gable-maps, which is built where libosmium is "
                     "installed",
                 "install libosmium2-dev and build again, or convert the map to GeoJSON"};
  }
  Result<std::string> text = runChild(program, {extensionOf(path)}, bytes, kLimits);
  if (!text.ok()) return failed(text.error(), path, "libosmium2-dev and build again");
  return text;
}

// GDAL goes by the content: without this it would take what only has the name of one format for
// another, which may name files elsewhere.
bool isWhatItsNameSays(std::string_view bytes, const std::string& extension) {
  constexpr size_t kHead = 1024;
  const std::string_view head = bytes.substr(0, kHead);
  if (extension == "gpkg") return head.starts_with("SQLite format 3");
  if (extension == "fgb") return head.starts_with("fgb\x03");
  if (extension == "kml") return head.find("<kml") != std::string_view::npos;
  if (extension == "dxf") return head.find("SECTION") != std::string_view::npos;
  return head.starts_with(std::string_view("\x00\x00\x27\x0a", 4));
}

/// A file of GDAL's, as a copy in a folder of its own: the programs take files, not bytes.
class GdalFile {
 public:
  GdalFile(std::string_view bytes, const AssetOptions& options) : path_(options.path) {
    const std::string extension = extensionOf(path_);
    copy_ = folder_.path() + "/map." + extension;
    if (folder_.path().empty() || !writeFile(copy_, bytes).ok()) copy_.clear();
    if (extension != "shp" || !options.readFile) return;
    const std::string stem = path_.substr(0, path_.size() - extension.size());
    for (const char* part : {"shx", "dbf", "prj", "cpg"}) {
      Result<std::string> content = options.readFile(stem + part);
      if (content.ok()) writeFile(folder_.path() + "/map." + part, *content);
    }
  }

  /// As it lies on disk. Nothing is copied.
  explicit GdalFile(const std::string& path) : path_(path), copy_(path) {}

  /// Empty where the copy could not be made.
  const std::string& copy() const { return copy_; }

  Result<std::vector<std::string>> layers() const {
    Result<std::string> listed = run("ogrinfo", {"-ro", "-q", copy_});
    if (!listed.ok()) return listed.error();
    // A line each: "1: streets (Line String)".
    std::vector<std::string> out;
    for (size_t at = 0; at < listed->size();) {
      const size_t end = std::min(listed->find('\n', at), listed->size());
      const std::string line = listed->substr(at, end - at);
      at = end + 1;
      const size_t name = line.find(": "), kind = line.rfind(" (");
      if (name == std::string::npos) continue;
      out.push_back(line.substr(name + 2, kind == std::string::npos ? kind : kind - name - 2));
    }
    return out;
  }

  /// To `target`, or as the result.
  Result<std::string> geoJson(const std::string& layer,
                              const std::string& target = "/vsistdout/") const {
    const auto written = [&](std::vector<std::string> arguments) {
      for (const std::string& a :
           {std::string("-lco"), std::string("COORDINATE_PRECISION=9"), target, copy_, layer}) {
        arguments.push_back(a);
      }
      return run("ogr2ogr", arguments);
    };
    // A drawing has no coordinate system; any in metres says so. Its lots are closed lines.
    if (extensionOf(path_) == "dxf") {
      return written({"-nlt", "POLYGON", "-f", "GeoJSON", "-a_srs", "EPSG:3857"});
    }
    Result<std::string> text = written({"-f", "GeoJSON", "-t_srs", "EPSG:4326"});
    // A file that does not name its coordinate system cannot be converted.
    if (text.ok() || !isCode(text.error(), "shapes-broken")) return text;
    std::vector<std::string> arguments{"-f", "GeoJSON"};
    if (target.starts_with("/vsi")) return written(arguments);
    arguments.emplace_back("-overwrite");
    return written(arguments);
  }

 private:
  Result<std::string> run(const char* name, const std::vector<std::string>& arguments) const {
    const std::string program = programBeside(name);
    if (program.empty()) {
      return Error{"shapes-reader",
                   "'" + path_ + "' needs the program " + name + " of GDAL, which is not installed",
                   "install gdal-bin, or convert the map to GeoJSON"};
    }
    Result<std::string> out =
        runChild(program, arguments, {}, copy_ == path_ ? kLongLimits : kLimits);
    if (!out.ok()) return failed(out.error(), path_, "gdal-bin");
    return out;
  }

  TemporaryFolder folder_;
  std::string path_, copy_;
};

std::string listOf(const std::vector<std::string>& names) {
  std::string out;
  for (const std::string& n : names) out += (out.empty() ? "" : ", ") + n;
  return out;
}

// The layer to read: the one that is asked for, or the only one.
Result<std::string> layerOf(const GdalFile& file, const std::string& path,
                            const std::string& wanted) {
  Result<std::vector<std::string>> layers = file.layers();
  if (!layers.ok()) return layers.error();
  if (layers->empty()) return Error{"shapes-empty", "'" + path + "' has no layer", {}};
  if (wanted.empty() && layers->size() == 1) return layers->front();
  for (const std::string& layer : *layers) {
    if (layer == wanted) return layer;
  }
  if (wanted.empty()) {
    return Error{"shapes-layer", "'" + path + "' has several layers: " + listOf(*layers),
                 "choose one with --layer"};
  }
  return Error{"shapes-layer", "'" + path + "' has no layer '" + wanted + "'",
               "its layers are " + listOf(*layers)};
}

}  // namespace

bool isOpenStreetMap(const std::string& path) {
  const std::string extension = extensionOf(path);
  return extension == "osm" || extension == "pbf";
}

bool isMap(const std::string& path) {
  const std::string extension = extensionOf(path);
  return isOpenStreetMap(path) || extension == "gpkg" || extension == "fgb" || extension == "shp" ||
         extension == "kml" || extension == "dxf";
}

Result<std::string> mapAsGeoJson(std::string_view bytes, const AssetOptions& options,
                                 const std::string& layer) {
  const std::string& path = options.path;
  if (isOpenStreetMap(path)) return openStreetMap(bytes, path);
  if (!isWhatItsNameSays(bytes, extensionOf(path))) {
    return Error{"shapes-broken", "'" + path + "' is not what its name says",
                 "open it in a map program and save it again"};
  }
  const GdalFile file(bytes, options);
  if (file.copy().empty()) {
    return Error{"shapes-broken", "'" + path + "' needs room for a copy in the temporary folder",
                 "free some disk space, or set TMPDIR to another folder"};
  }
  Result<std::string> chosen = layerOf(file, path, layer);
  return chosen.ok() ? file.geoJson(*chosen) : chosen.error();
}

Result<std::string> mapAsGeoJsonFile(const std::string& path, const std::string& layer,
                                     const std::string& folder) {
  FilePieces head;
  const Result<uint64_t> size = head.open(path);
  if (!size.ok()) return size.error();
  std::string begin(1024, '\0');
  const Result<size_t> got = head.read(begin.data(), begin.size());
  if (!got.ok()) return got.error();
  if (!isWhatItsNameSays(std::string_view(begin).substr(0, got.value()), extensionOf(path))) {
    return Error{"shapes-broken", "'" + path + "' is not what its name says",
                 "open it in a map program and save it again"};
  }
  const GdalFile file(path);
  const Result<std::string> chosen = layerOf(file, path, layer);
  if (!chosen.ok()) return chosen.error();
  const std::string target = folder + "/map.geojson";
  const Result<std::string> written = file.geoJson(chosen.value(), target);
  if (!written.ok()) return written.error();
  return target;
}

}  // namespace gable
