// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Files of the project, models and images among them, and which of them fits the scope best.
//
// Ratios are compared by the logarithm of their quotient, so that twice as wide and half as wide
// are equally wrong; sizes by the greatest scale that they need, up or down.

#include <algorithm>
#include <cmath>
#include <set>

#include "base/elementary.h"
#include "base/files.h"
#include "builtins/lists.h"
#include "builtins/shared/arrays.h"
#include "builtins/shared/text_files.h"
#include "shape/file_query.h"
#include "shape/op_call.h"

namespace gable {

namespace {

enum class ModelMeasure : uint8_t { SizeX, SizeY, SizeZ, PlaceX, PlaceY, PlaceZ };
enum class ImageMeasure : uint8_t { Width, Height };
enum class Named : uint8_t { Groups, Materials };

}  // namespace

template <>
struct WordsOf<ModelMeasure> {
  static constexpr const char* text = "sx sy sz tx ty tz";
};
template <>
struct WordsOf<ImageMeasure> {
  static constexpr const char* text = "sx sy";
};
template <>
struct WordsOf<Named> {
  static constexpr const char* text = "g m";
};

namespace {

using Paths = std::vector<std::string>;

struct Query {
  std::string_view query;
  Paths search(const FunctionCall& call) const {
    if (const Result<FileQuery> parsed = FileQuery::parse(query); !parsed.ok()) {
      call.fail("bad-query", parsed.error().message, parsed.error().hint, {});
      return {};
    }
    return call.services().assets().search(query, call.file());
  }
};

struct Path {
  std::string_view path;
};

Value fileSearch(FunctionCall& call, const Query& args) {
  return call.result(listOf(args.search(call)));
}
Value filesSearch(FunctionCall& call, const Query& args) {
  return stringArray(args.search(call), call.services().pool());
}
// What operations and functions can take: models, pictures, materials, texts, tables.
constexpr std::string_view kUsableExtensions[] = {"obj", "gltf", "glb", "fbx",    "dae", "png",
                                                  "jpg", "jpeg", "tif", "tiff",   "bmp", "gif",
                                                  "tga", "webp", "mtl", "cgamat", "txt", "csv"};

Value fileExists(FunctionCall& call, const Path& args) {
  const std::string extension = extensionOf(std::string(args.path));
  const bool usable = std::find(std::begin(kUsableExtensions), std::end(kUsableExtensions),
                                extension) != std::end(kUsableExtensions);
  return Value::of(usable && call.services().assets().exists(args.path, call.file()));
}

const std::string& drawn(const FunctionCall& call, const Paths& paths, size_t among) {
  const auto n = static_cast<double>(std::min(among, paths.size()));
  const auto i = static_cast<size_t>(randomIn(call.randomAddress(0), 0, n));
  return paths[std::min(i, paths.size() - 1)];
}

Value fileRandom(FunctionCall& call, const Query& args) {
  const Paths paths = args.search(call);
  return call.result(paths.empty() ? "" : drawn(call, paths, paths.size()));
}

std::string_view nameOf(std::string_view path) {
  const size_t slash = path.rfind('/');
  return slash == std::string_view::npos ? path : path.substr(slash + 1);
}

Value fileName(FunctionCall& call, const Path& args) { return call.result(nameOf(args.path)); }
Value fileBasename(FunctionCall& call, const Path& args) {
  const std::string_view name = nameOf(args.path);
  return call.result(name.substr(0, name.rfind('.')));
}
Value fileDirectory(FunctionCall& call, const Path& args) {
  return call.result(args.path.substr(0, args.path.size() - nameOf(args.path).size()));
}
Value fileExtension(FunctionCall& call, const Path& args) {
  const std::string_view name = nameOf(args.path);
  const size_t dot = name.rfind('.');
  return call.result(dot == std::string_view::npos ? std::string_view() : name.substr(dot + 1));
}

// Empty, with a warning, when there is no such file.
std::string readText(const FunctionCall& call, const Path& args) {
  std::string bytes;
  if (call.services().assets().text(args.path, call.file(), bytes)) return decodedText(bytes);
  call.fail("missing-file", "there is no file '" + std::string(args.path) + "'", kWherePathsStart,
            {});
  return {};
}

Value readTextFile(FunctionCall& call, const Path& args) {
  return call.result(readText(call, args));
}

template <ValueType element>
Value readTable(FunctionCall& call, const Path& args) {
  const TextTable table = parseTable(readText(call, args));
  Array out;
  out.element = element;
  if (table.cells.size() > kMaxArraySize) {
    return call.fail("array-too-large", "'" + std::string(args.path) + "' has too many cells",
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

struct AssetInfo : Path {
  ModelMeasure measure;
};

Value assetInfo(FunctionCall& call, const AssetInfo& args) {
  const Ref<AssetModel> model = modelAt(call, args.path);
  if (!model) {
    return call.fail("missing-asset", "there is no model '" + std::string(args.path) + "'",
                     kWherePathsStart, Value::of(0.0));
  }
  const auto measure = static_cast<size_t>(args.measure);
  return Value::of(measure < 3 ? model->bounds.size()[measure] : model->bounds.min[measure - 3]);
}

struct NamingInfo : Path {
  Named named;
};

// In the order of the components that comp() makes: each material and each group once.
Paths namesIn(const FunctionCall& call, const NamingInfo& args) {
  Paths names;
  const Ref<AssetModel> model = modelAt(call, args.path);
  if (!model) {
    call.fail("missing-asset", "there is no model '" + std::string(args.path) + "'",
              kWherePathsStart, {});
    return names;
  }
  if (args.named == Named::Groups) {
    std::set<std::string_view> known;
    for (const std::string& name : model->groups) {
      if (known.insert(name).second) names.push_back(name);
    }
  } else {
    std::set<uint64_t> known;
    for (const Material& m : model->materials) {
      if (known.insert(contentHash(m)).second) names.push_back(m.name);
    }
  }
  return names;
}
Value assetNamingInfo(FunctionCall& call, const NamingInfo& args) {
  return call.result(listOf(namesIn(call, args)));
}
Value assetNamingInfos(FunctionCall& call, const NamingInfo& args) {
  return stringArray(namesIn(call, args), call.services().pool());
}

struct Metadata : Path {
  std::string_view key;
  Value otherwise;
};

// The property of that name and of the type of the default.
Value assetMetadata(FunctionCall& call, const Metadata& args) {
  const Ref<AssetModel> model = modelAt(call, args.path);
  if (!model) return args.otherwise;
  for (const Metadatum& m : model->metadata) {
    if (m.key != args.key || m.type != args.otherwise.type) continue;
    if (m.type == ValueType::String) return call.services().pool().string(m.text);
    return m.type == ValueType::Bool ? Value::of(m.number != 0) : Value::of(m.number);
  }
  return args.otherwise;
}

struct ImageMeasureOf : Path {
  ImageMeasure measure;
};

Value imageInfo(FunctionCall& call, const ImageMeasureOf& args) {
  const ImageInfo image = call.services().assets().image(args.path, call.file());
  if (!image.found) {
    return call.fail("missing-texture", "there is no image '" + std::string(args.path) + "'",
                     kWherePathsStart, Value::of(0.0));
  }
  const bool height = args.measure == ImageMeasure::Height;
  return Value::of(double{1} * (height ? image.height : image.width));
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

// The paths of those that fit within a limit; 0 allows all.
Paths within(double limit, std::vector<Ranked> all) {
  Paths paths;
  for (Ranked& r : all) {
    if (limit > 0 && !(r.misfit <= limit)) continue;
    paths.push_back(std::move(r.path));
  }
  return paths;
}

// The sort functions: a list gives a list, an array an array.
struct Sorted {
  std::string_view list;
  Strings array;
  Word axes;
  double maxError = 0;
};

template <Misfit misfit>
Value sorted(FunctionCall& call, const Sorted& args) {
  const Array* const array = args.array.array;
  ValuePool& pool = call.services().pool();
  const std::vector<std::string_view> items = itemsOf(args.list);
  const Paths given = array ? stringsOf(*array, pool) : Paths(items.begin(), items.end());
  const Paths out = within(args.maxError, ranked(call, given, args.axes.text, misfit));
  return array ? stringArray(out, pool) : call.result(listOf(out));
}

// Files that a search finds, by how well they fit along some axes.
struct Fitting : Query {
  std::string_view axes;
  double among = 1, maxError = 0;

  std::vector<Ranked> rankedBy(Misfit misfit, const FunctionCall& call) const {
    return ranked(call, search(call), axes, misfit);
  }
};

// The best file of a search, one of equals at random.
template <Misfit misfit>
Value best(FunctionCall& call, const Fitting& args) {
  const std::vector<Ranked> all = args.rankedBy(misfit, call);
  Paths equal;
  for (const Ranked& r : all) {
    if (r.misfit == all[0].misfit) equal.push_back(r.path);
  }
  return call.result(equal.empty() ? "" : drawn(call, equal, equal.size()));
}

// One of the best n files of a search.
template <Misfit misfit>
Value approximate(FunctionCall& call, const Fitting& args) {
  const Paths paths = within(0, args.rankedBy(misfit, call));
  const double n = args.among;
  const size_t among = n >= 1 ? static_cast<size_t>(std::min(n, 1e9)) : 1;
  return call.result(paths.empty() ? "" : drawn(call, paths, among));
}

Value assetFitSize(FunctionCall& call, const Fitting& args) {
  const Paths paths = within(args.maxError, args.rankedBy(assetSize, call));
  return call.result(paths.empty() ? "" : drawn(call, paths, paths.size()));
}

constexpr ValueType kString = ValueType::String, kFloat = ValueType::Float;
constexpr ParamSpec kQuery = param<&Query::query>(
    "searchQuery",
    "The files: a path in which * stands for any characters and ? for any one, or, after a $, a "
    "regular expression; or a property of theirs as in Name=door*. Blanks join what must all "
    "hold.");
constexpr ParamSpec kPath = param<&Path::path>("filePath", "The file, by its path in the project.");
constexpr ParamSpec kQueryParams[] = {kQuery};
constexpr ParamSpec kPathParams[] = {kPath};
// A path alone: whether there is such a file does not matter.
constexpr ParamSpec kAnyPathParams[] = {
    param<&Path::path>("path", "The path of a file in the project.")};
constexpr Signature kTextOfQuery[] = {{kQueryParams, kString}};
constexpr Signature kArrayOfQuery[] = {{kQueryParams, ValueType::StringArray}};
constexpr Signature kTruthOfPath[] = {{kAnyPathParams, ValueType::Bool}};
constexpr Signature kTextOfPath[] = {{kAnyPathParams, kString}};
constexpr Signature kTextOfFile[] = {{kPathParams, kString}};
constexpr Signature kStringTable[] = {{kPathParams, ValueType::StringArray}};
constexpr Signature kFloatTable[] = {{kPathParams, ValueType::FloatArray}};

constexpr ParamSpec kAssetInfoParams[] = {
    kPath, param<&AssetInfo::measure>("attribute", "Size or place of the model's bounding box.")};
constexpr Signature kAssetInfo[] = {{kAssetInfoParams, kFloat}};
constexpr ParamSpec kImageInfoParams[] = {
    kPath, param<&ImageMeasureOf::measure>("attribute", "Width or height in pixels.")};
constexpr Signature kImageInfo[] = {{kImageInfoParams, kFloat}};
constexpr ParamSpec kNamingParams[] = {
    kPath, param<&NamingInfo::named>("namingAttribute", "Groups or materials.")};
constexpr Signature kNamingInfo[] = {{kNamingParams, kString}};
constexpr Signature kNamingInfos[] = {{kNamingParams, ValueType::StringArray}};

template <ParamType type>
constexpr ParamSpec kMetadataParams[] = {
    kPath, param<&Metadata::key>("key", "The name of the property."),
    param<&Metadata::otherwise, type>("defaultValue",
                                      "What to give when there is no such property.")};
constexpr Signature kMetadata[] = {
    {kMetadataParams<ParamType::Float>, kFloat},
    {kMetadataParams<ParamType::Bool>, ValueType::Bool},
    {kMetadataParams<ParamType::String>, kString},
    {kMetadataParams<ParamType::FloatArray>, ValueType::FloatArray},
    {kMetadataParams<ParamType::BoolArray>, ValueType::BoolArray},
    {kMetadataParams<ParamType::StringArray>, ValueType::StringArray}};

constexpr ParamSpec kFileList =
    param<&Sorted::list>("filePathList", "Files, each ended by a semicolon.");
constexpr ParamSpec kFileArray = param<&Sorted::array>("filePaths", "Files.");
constexpr const char* kRatioDoc = "The axes of the scope whose ratio counts.";
constexpr ParamSpec kRatioAxes =
    param<&Sorted::axes>("axesRatio", kRatioDoc, nullptr, "xy xz yz xyz");
constexpr ParamSpec kImageAxes =
    param<&Sorted::axes>("axesRatio", kRatioDoc, nullptr, "xy xz yx yz zx zy");
constexpr ParamSpec kSizeAxes = param<&Sorted::axes>(
    "axisSize", "The axes of the scope whose sizes count.", nullptr, "x y z xy xz yz xyz");
constexpr ParamSpec kMaxError = param<&Sorted::maxError>(
    "maxScaleError",
    "Files that need more scaling are left out: 0.1 allows 10 percent up or down, 0 allows all.");
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
constexpr ParamSpec kRatioText =
    param<&Fitting::axes>("axesRatio", "The axes of the scope whose ratio counts, such as \"xz\".");
constexpr ParamSpec kSizeText =
    param<&Fitting::axes>("axisSize", "The axes of the scope whose sizes count, such as \"xz\".");
constexpr ParamSpec kAmong = param<&Fitting::among>("n", "How many of the best to draw from.");
constexpr ParamSpec kMostError = param<&Fitting::maxError>(kMaxError.name, kMaxError.doc);
constexpr ParamSpec kBestRatioParams[] = {kQuery, kRatioText};
constexpr ParamSpec kBestSizeParams[] = {kQuery, kSizeText};
constexpr ParamSpec kApproxRatioParams[] = {kQuery, kRatioText, kAmong};
constexpr ParamSpec kApproxSizeParams[] = {kQuery, kSizeText, kAmong};
constexpr ParamSpec kFitSizeParams[] = {kQuery, kSizeText, kMostError};
constexpr Signature kBestRatio[] = {{kBestRatioParams, kString}};
constexpr Signature kBestSize[] = {{kBestSizeParams, kString}};
constexpr Signature kApproxRatio[] = {{kApproxRatioParams, kString}};
constexpr Signature kApproxSize[] = {{kApproxSizeParams, kString}};
constexpr Signature kFitSize[] = {{kFitSizeParams, kString}};

constexpr const char* kFamily = "files";
constexpr FunctionSpec kFunctions[] = {
    {"fileSearch", kFamily, "All files that match, sorted, as a string list.", kTextOfQuery,
     typed<fileSearch>},
    {"filesSearch", kFamily, "All files that match, sorted, as an array.", kArrayOfQuery,
     typed<filesSearch>},
    {"fileExists", kFamily, "Whether there is such a file, of a format that can be used.",
     kTruthOfPath, typed<fileExists>},
    {"fileRandom", kFamily, "A random one of the files that match.", kTextOfQuery,
     typed<fileRandom>, kRandom},
    {"fileName", kFamily, "A path without its folders.", kTextOfPath, typed<fileName>},
    {"fileBasename", kFamily, "A path without its folders and its extension.", kTextOfPath,
     typed<fileBasename>},
    {"fileDirectory", kFamily, "The folders of a path, with a slash at the end.", kTextOfPath,
     typed<fileDirectory>},
    {"fileExtension", kFamily, "The extension of a path, without the dot.", kTextOfPath,
     typed<fileExtension>},
    {"readTextFile", kFamily, "The content of a text file.", kTextOfFile, typed<readTextFile>},
    {"readStringTable", kFamily, "The cells of a CSV file as texts.", kStringTable,
     typed<readTable<ValueType::String>>},
    {"readFloatTable", kFamily, "The cells of a CSV file as numbers; NaN where there is none.",
     kFloatTable, typed<readTable<ValueType::Float>>},
    {"assetInfo", kFamily, "A size or place of a model.", kAssetInfo, typed<assetInfo>},
    {"assetNamingInfo", kFamily, "The names of a model's groups or materials as a string list.",
     kNamingInfo, typed<assetNamingInfo>},
    {"assetNamingInfos", kFamily, "The names of a model's groups or materials as an array.",
     kNamingInfos, typed<assetNamingInfos>},
    {"assetMetadata", kFamily, "A property that a model's file carries.", kMetadata,
     typed<assetMetadata>},
    {"imageInfo", kFamily, "Width or height of an image in pixels.", kImageInfo, typed<imageInfo>},
    {"assetsSortRatio", kFamily, "Models sorted by how near their proportions are to the scope's.",
     kSortRatio, typed<sorted<assetRatio>>},
    {"assetsSortSize", kFamily, "Models sorted by how little they must be scaled to fit the scope.",
     kSortSize, typed<sorted<assetSize>>},
    {"imagesSortRatio", kFamily, "Images sorted by how near their proportions are to the scope's.",
     kSortImage, typed<sorted<imageRatio>>},
    {"assetBestRatio", kFamily, "The model with the proportions nearest to the scope's.",
     kBestRatio, typed<best<assetRatio>>, kRandom},
    {"assetApproxRatio", kFamily, "One of the models with the proportions nearest to the scope's.",
     kApproxRatio, typed<approximate<assetRatio>>, kRandom},
    {"assetBestSize", kFamily, "The model that must be scaled least to fit the scope.", kBestSize,
     typed<best<assetSize>>, kRandom},
    {"assetApproxSize", kFamily, "One of the models that must be scaled least to fit the scope.",
     kApproxSize, typed<approximate<assetSize>>, kRandom},
    {"assetFitSize", kFamily, "One of the models that fit the scope within a share of scaling.",
     kFitSize, typed<assetFitSize>, kRandom},
    {"imageBestRatio", kFamily, "The image with the proportions nearest to the scope's.",
     kBestRatio, typed<best<imageRatio>>, kRandom},
    {"imageApproxRatio", kFamily, "One of the images with the proportions nearest to the scope's.",
     kApproxRatio, typed<approximate<imageRatio>>, kRandom},
};

}  // namespace

extern const FunctionList kFunctions_files;
const FunctionList kFunctions_files = {kFunctions, {}};

}  // namespace gable
