// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Files of the project, models and images among them, and which of them fits the scope best.
//
// Ratios are compared by the logarithm of their quotient, so that twice as wide and half as wide
// are equally wrong; sizes by the greatest scale that they need, up or down.

#include <algorithm>
#include <cmath>

#include "base/elementary.h"
#include "builtins/lists.h"
#include "builtins/shared/arrays.h"
#include "builtins/shared/text_files.h"
#include "shape/op_call.h"

namespace gable {

namespace {

using Paths = std::vector<std::string>;

Paths search(const FunctionCall& call) {
  return call.services().assets().search(call.text(0), call.file());
}

Value fileSearch(FunctionCall& call) { return call.result(listOf(search(call))); }
Value filesSearch(FunctionCall& call) { return stringArray(search(call), call.services().pool()); }
Value fileExists(FunctionCall& call) {
  return Value::of(call.services().assets().exists(call.text(0), call.file()));
}

const std::string& drawn(const FunctionCall& call, const Paths& paths, size_t among) {
  const auto n = static_cast<double>(std::min(among, paths.size()));
  const auto i = static_cast<size_t>(randomIn(call.randomAddress(0), 0, n));
  return paths[std::min(i, paths.size() - 1)];
}

Value fileRandom(FunctionCall& call) {
  const Paths paths = search(call);
  return call.result(paths.empty() ? "" : drawn(call, paths, paths.size()));
}

std::string_view nameOf(std::string_view path) {
  const size_t slash = path.rfind('/');
  return slash == std::string_view::npos ? path : path.substr(slash + 1);
}

Value fileName(FunctionCall& call) { return call.result(nameOf(call.text(0))); }
Value fileBasename(FunctionCall& call) {
  const std::string_view name = nameOf(call.text(0));
  return call.result(name.substr(0, name.rfind('.')));
}
Value fileDirectory(FunctionCall& call) {
  const std::string_view path = call.text(0);
  return call.result(path.substr(0, path.size() - nameOf(path).size()));
}
Value fileExtension(FunctionCall& call) {
  const std::string_view name = nameOf(call.text(0));
  const size_t dot = name.rfind('.');
  return call.result(dot == std::string_view::npos ? std::string_view() : name.substr(dot + 1));
}

bool readText(const FunctionCall& call, std::string& text) {
  std::string bytes;
  if (!call.services().assets().text(call.text(0), call.file(), bytes)) {
    call.fail("missing-file", "there is no file '" + std::string(call.text(0)) + "'",
              "paths start at the assets folder or at the root of the project", {});
    return false;
  }
  text = decodedText(bytes);
  return true;
}

Value readTextFile(FunctionCall& call) {
  std::string text;
  readText(call, text);
  return call.result(text);
}

template <ValueType element>
Value readTable(FunctionCall& call) {
  std::string text;
  readText(call, text);
  const TextTable table = parseTable(text);
  Array out;
  out.element = element;
  if (table.cells.size() > kMaxArraySize) {
    return call.fail("array-too-large", "'" + std::string(call.text(0)) + "' has too many cells",
                     "arrays have up to 100000 elements", call.result(std::move(out)));
  }
  out.rows = static_cast<uint32_t>(table.rows);
  out.columns = static_cast<uint32_t>(table.columns);
  for (const std::string& cell : table.cells) {
    if constexpr (element == ValueType::String)
      out.strings.push_back(call.services().pool().intern(cell));
    else
      out.numbers.push_back(numberOf(cell));
  }
  return call.result(std::move(out));
}

Ref<AssetModel> modelAt(const FunctionCall& call, std::string_view path) {
  std::string why;
  return call.services().assets().model(path, call.file(), false, why);
}

Value assetInfo(FunctionCall& call) {
  const Ref<AssetModel> model = modelAt(call, call.text(0));
  if (!model) {
    return call.fail("missing-asset", "there is no model '" + std::string(call.text(0)) + "'",
                     "paths start at the assets folder or at the root of the project",
                     Value::of(0.0));
  }
  const std::string_view what = call.text(1);
  const size_t axis =
      what.size() == 2 && what[1] >= 'x' && what[1] <= 'z' ? static_cast<size_t>(what[1] - 'x') : 0;
  const Vec3 v = what.starts_with('t') ? model->bounds.min : model->bounds.size();
  return Value::of(v[axis]);
}

// Groups are not kept by readers; materials are.
Paths namesIn(const FunctionCall& call) {
  Paths names;
  const Ref<AssetModel> model = modelAt(call, call.text(0));
  if (model && call.text(1) == "m") {
    for (const Material& m : model->materials) names.push_back(m.name);
  }
  return names;
}
Value assetNamingInfo(FunctionCall& call) { return call.result(listOf(namesIn(call))); }
Value assetNamingInfos(FunctionCall& call) {
  return stringArray(namesIn(call), call.services().pool());
}

// Readers keep no metadata, so there is none of any key.
Value assetMetadata(FunctionCall& call) { return call.arg(2); }

Value imageInfo(FunctionCall& call) {
  const ImageInfo image = call.services().assets().image(call.text(0), call.file());
  if (!image.found) {
    return call.fail("missing-texture", "there is no image '" + std::string(call.text(0)) + "'",
                     "paths start at the assets folder or at the root of the project",
                     Value::of(0.0));
  }
  return Value::of(double{1} * (call.text(1) == "sy" ? image.height : image.width));
}

// How badly a file fits; NaN when it cannot be read.
using Misfit = double (*)(const FunctionCall&, const std::string& path, std::string_view axes);

double axisOf(const Vec3& v, char axis) {
  return axis >= 'x' && axis <= 'z' ? std::fabs(v[static_cast<size_t>(axis - 'x')]) : 0;
}

double ratioMisfit(double a, double b, double wantA, double wantB) {
  return std::fabs(logOf((a / b) / (wantA / wantB)));
}

double assetRatio(const FunctionCall& call, const std::string& path, std::string_view axes) {
  const Ref<AssetModel> model = modelAt(call, path);
  if (!model) return std::nan("");
  const Vec3 have = model->bounds.size(), want = call.shape().size;
  double sum = 0;
  for (size_t i = 0; i < axes.size(); ++i) {
    for (size_t j = i + 1; j < axes.size(); ++j) {
      sum += ratioMisfit(axisOf(have, axes[i]), axisOf(have, axes[j]), axisOf(want, axes[i]),
                         axisOf(want, axes[j]));
    }
  }
  return sum;
}

double assetSize(const FunctionCall& call, const std::string& path, std::string_view axes) {
  const Ref<AssetModel> model = modelAt(call, path);
  if (!model) return std::nan("");
  double worst = 0;
  for (const char axis : axes) {
    const double scale = axisOf(call.shape().size, axis) / axisOf(model->bounds.size(), axis);
    worst = std::max(worst, std::fabs(scale - 1));
  }
  return worst;
}

double imageRatio(const FunctionCall& call, const std::string& path, std::string_view axes) {
  const ImageInfo image = call.services().assets().image(path, call.file());
  if (!image.found || axes.size() < 2) return std::nan("");
  return ratioMisfit(image.width, image.height, axisOf(call.shape().size, axes[0]),
                     axisOf(call.shape().size, axes[1]));
}

struct Ranked {
  std::string path;
  double misfit;
};

// Best first, of equals the first; what does not fit at all (a flat scope, no file) comes last.
std::vector<Ranked> ranked(const FunctionCall& call, const Paths& paths, std::string_view axes,
                           Misfit misfit) {
  std::vector<Ranked> all;
  for (const std::string& path : paths) {
    const double m = misfit(call, path, axes);
    all.push_back({path, std::isnan(m) ? std::numeric_limits<double>::infinity() : m});
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const Ranked& a, const Ranked& b) { return a.misfit < b.misfit; });
  return all;
}

// The sort functions: a list gives a list, an array an array.
template <Misfit misfit>
Value sorted(FunctionCall& call) {
  const bool array = call.arg(0).isArray();
  ValuePool& pool = call.services().pool();
  const std::vector<std::string_view> items =
      array ? std::vector<std::string_view>() : itemsOf(call.text(0));
  const Paths given = array ? stringsOf(call.array(0), pool) : Paths(items.begin(), items.end());
  const double limit = call.number(2, 0);
  Paths out;
  for (Ranked& r : ranked(call, given, call.text(1), misfit)) {
    if (limit > 0 && !(r.misfit <= limit)) continue;
    out.push_back(std::move(r.path));
  }
  return array ? stringArray(out, pool) : call.result(listOf(out));
}

// The best file of a search, one of equals at random.
template <Misfit misfit>
Value best(FunctionCall& call) {
  const std::vector<Ranked> all = ranked(call, search(call), call.text(1), misfit);
  Paths equal;
  for (const Ranked& r : all) {
    if (r.misfit == all[0].misfit) equal.push_back(r.path);
  }
  return call.result(equal.empty() ? "" : drawn(call, equal, equal.size()));
}

// One of the best n files of a search.
template <Misfit misfit>
Value approximate(FunctionCall& call) {
  Paths paths;
  for (Ranked& r : ranked(call, search(call), call.text(1), misfit)) {
    paths.push_back(std::move(r.path));
  }
  const double n = call.number(2);
  const size_t among = n >= 1 ? static_cast<size_t>(std::min(n, 1e9)) : 1;
  return call.result(paths.empty() ? "" : drawn(call, paths, among));
}

Value assetFitSize(FunctionCall& call) {
  const double limit = call.number(2);
  Paths paths;
  for (Ranked& r : ranked(call, search(call), call.text(1), assetSize)) {
    if (limit > 0 && !(r.misfit <= limit)) continue;
    paths.push_back(std::move(r.path));
  }
  return call.result(paths.empty() ? "" : drawn(call, paths, paths.size()));
}

constexpr ValueType kString = ValueType::String, kFloat = ValueType::Float;
constexpr ParamSpec kQuery = {"searchQuery", ParamType::String,
                              "The files, by a path in which * stands for any characters and $ "
                              "for any characters within a folder."};
constexpr ParamSpec kPath = {"filePath", ParamType::String,
                             "The file, by its path in the project."};
constexpr ParamSpec kQueryParams[] = {kQuery};
constexpr ParamSpec kPathParams[] = {kPath};
constexpr Signature kTextOfQuery[] = {{kQueryParams, kString}};
constexpr Signature kArrayOfQuery[] = {{kQueryParams, ValueType::StringArray}};
constexpr Signature kTruthOfPath[] = {{kPathParams, ValueType::Bool}};
constexpr Signature kTextOfPath[] = {{kPathParams, kString}};
constexpr Signature kStringTable[] = {{kPathParams, ValueType::StringArray}};
constexpr Signature kFloatTable[] = {{kPathParams, ValueType::FloatArray}};

constexpr ParamSpec kAssetInfoParams[] = {
    kPath,
    {"attribute", ParamType::Selector, "Size or place of the model's bounding box.", nullptr,
     "sx sy sz tx ty tz"}};
constexpr Signature kAssetInfo[] = {{kAssetInfoParams, kFloat}};
constexpr ParamSpec kImageInfoParams[] = {
    kPath, {"attribute", ParamType::Selector, "Width or height in pixels.", nullptr, "sx sy"}};
constexpr Signature kImageInfo[] = {{kImageInfoParams, kFloat}};
constexpr ParamSpec kNamingParams[] = {
    kPath, {"namingAttribute", ParamType::Selector, "Groups or materials.", nullptr, "g m"}};
constexpr Signature kNamingInfo[] = {{kNamingParams, kString}};
constexpr Signature kNamingInfos[] = {{kNamingParams, ValueType::StringArray}};

constexpr ParamSpec kKey = {"key", ParamType::String, "The name of the property."};
constexpr const char* kDefaultDoc = "What to give when there is no such property.";
template <ParamType type>
constexpr ParamSpec kMetadataParams[] = {kPath, kKey, {"defaultValue", type, kDefaultDoc}};
constexpr Signature kMetadata[] = {
    {kMetadataParams<ParamType::Float>, kFloat},
    {kMetadataParams<ParamType::Bool>, ValueType::Bool},
    {kMetadataParams<ParamType::String>, kString},
    {kMetadataParams<ParamType::FloatArray>, ValueType::FloatArray},
    {kMetadataParams<ParamType::BoolArray>, ValueType::BoolArray},
    {kMetadataParams<ParamType::StringArray>, ValueType::StringArray}};

constexpr ParamSpec kFileList = {"filePathList", ParamType::String,
                                 "Files, each ended by a semicolon."};
constexpr ParamSpec kFileArray = {"filePaths", ParamType::StringArray, "Files."};
constexpr const char* kRatioDoc = "The axes of the scope whose ratio counts.";
constexpr ParamSpec kRatioAxes = {"axesRatio", ParamType::Selector, kRatioDoc, nullptr,
                                  "xy xz yz xyz"};
constexpr ParamSpec kImageAxes = {"axesRatio", ParamType::Selector, kRatioDoc, nullptr,
                                  "xy xz yx yz zx zy"};
constexpr ParamSpec kSizeAxes = {"axisSize", ParamType::Selector,
                                 "The axes of the scope whose sizes count.", nullptr,
                                 "x y z xy xz yz xyz"};
constexpr ParamSpec kMaxError = {"maxScaleError", ParamType::Float,
                                 "Files that need more scaling are left out: 0.1 allows 10 percent "
                                 "up or down, 0 allows all."};
constexpr ParamSpec kRatioList[] = {kFileList, kRatioAxes};
constexpr ParamSpec kRatioArray[] = {kFileArray, kRatioAxes};
constexpr ParamSpec kImageList[] = {kFileList, kImageAxes};
constexpr ParamSpec kImageArray[] = {kFileArray, kImageAxes};
constexpr ParamSpec kSizeList[] = {kFileList, kSizeAxes, kMaxError};
constexpr ParamSpec kSizeArray[] = {kFileArray, kSizeAxes, kMaxError};
constexpr Signature kSortRatio[] = {{kRatioList, kString}, {kRatioArray, ValueType::StringArray}};
constexpr Signature kSortImage[] = {{kImageList, kString}, {kImageArray, ValueType::StringArray}};
constexpr Signature kSortSize[] = {{kSizeList, kString}, {kSizeArray, ValueType::StringArray}};

// The finding functions take their axes as text.
constexpr ParamSpec kRatioText = {"axesRatio", ParamType::String,
                                  "The axes of the scope whose ratio counts, such as \"xz\"."};
constexpr ParamSpec kSizeText = {"axisSize", ParamType::String,
                                 "The axes of the scope whose sizes count, such as \"xz\"."};
constexpr ParamSpec kAmong = {"n", ParamType::Float, "How many of the best to draw from."};
constexpr ParamSpec kBestRatioParams[] = {kQuery, kRatioText};
constexpr ParamSpec kBestSizeParams[] = {kQuery, kSizeText};
constexpr ParamSpec kApproxRatioParams[] = {kQuery, kRatioText, kAmong};
constexpr ParamSpec kApproxSizeParams[] = {kQuery, kSizeText, kAmong};
constexpr ParamSpec kFitSizeParams[] = {kQuery, kSizeText, kMaxError};
constexpr Signature kBestRatio[] = {{kBestRatioParams, kString}};
constexpr Signature kBestSize[] = {{kBestSizeParams, kString}};
constexpr Signature kApproxRatio[] = {{kApproxRatioParams, kString}};
constexpr Signature kApproxSize[] = {{kApproxSizeParams, kString}};
constexpr Signature kFitSize[] = {{kFitSizeParams, kString}};

constexpr const char* kFamily = "files";
constexpr FunctionSpec kFunctions[] = {
    {"fileSearch", kFamily, "All files that match, sorted, as a string list.", kTextOfQuery,
     fileSearch},
    {"filesSearch", kFamily, "All files that match, sorted, as an array.", kArrayOfQuery,
     filesSearch},
    {"fileExists", kFamily, "Whether there is such a file.", kTruthOfPath, fileExists},
    {"fileRandom", kFamily, "A random one of the files that match.", kTextOfQuery, fileRandom,
     kRandom},
    {"fileName", kFamily, "A path without its folders.", kTextOfPath, fileName},
    {"fileBasename", kFamily, "A path without its folders and its extension.", kTextOfPath,
     fileBasename},
    {"fileDirectory", kFamily, "The folders of a path, with a slash at the end.", kTextOfPath,
     fileDirectory},
    {"fileExtension", kFamily, "The extension of a path, without the dot.", kTextOfPath,
     fileExtension},
    {"readTextFile", kFamily, "The content of a text file.", kTextOfPath, readTextFile},
    {"readStringTable", kFamily, "The cells of a CSV file as texts.", kStringTable,
     readTable<ValueType::String>},
    {"readFloatTable", kFamily, "The cells of a CSV file as numbers; NaN where there is none.",
     kFloatTable, readTable<ValueType::Float>},
    {"assetInfo", kFamily, "A size or place of a model.", kAssetInfo, assetInfo},
    {"assetNamingInfo", kFamily, "The names of a model's materials as a string list.", kNamingInfo,
     assetNamingInfo},
    {"assetNamingInfos", kFamily, "The names of a model's materials as an array.", kNamingInfos,
     assetNamingInfos},
    {"assetMetadata", kFamily, "A property that a model's file carries.", kMetadata, assetMetadata},
    {"imageInfo", kFamily, "Width or height of an image in pixels.", kImageInfo, imageInfo},
    {"assetsSortRatio", kFamily, "Models sorted by how near their proportions are to the scope's.",
     kSortRatio, sorted<assetRatio>},
    {"assetsSortSize", kFamily, "Models sorted by how little they must be scaled to fit the scope.",
     kSortSize, sorted<assetSize>},
    {"imagesSortRatio", kFamily, "Images sorted by how near their proportions are to the scope's.",
     kSortImage, sorted<imageRatio>},
    {"assetBestRatio", kFamily, "The model with the proportions nearest to the scope's.",
     kBestRatio, best<assetRatio>, kRandom},
    {"assetApproxRatio", kFamily, "One of the models with the proportions nearest to the scope's.",
     kApproxRatio, approximate<assetRatio>, kRandom},
    {"assetBestSize", kFamily, "The model that must be scaled least to fit the scope.", kBestSize,
     best<assetSize>, kRandom},
    {"assetApproxSize", kFamily, "One of the models that must be scaled least to fit the scope.",
     kApproxSize, approximate<assetSize>, kRandom},
    {"assetFitSize", kFamily, "One of the models that fit the scope within a share of scaling.",
     kFitSize, assetFitSize, kRandom},
    {"imageBestRatio", kFamily, "The image with the proportions nearest to the scope's.",
     kBestRatio, best<imageRatio>, kRandom},
    {"imageApproxRatio", kFamily, "One of the images with the proportions nearest to the scope's.",
     kApproxRatio, approximate<imageRatio>, kRandom},
};

}  // namespace

extern const FunctionList kFunctions_files;
const FunctionList kFunctions_files = {kFunctions, {}};

}  // namespace gable
