// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Gable's public interface: rules and footprints in, places out.
//
//   gable::Rules rules = gable::Rules::load("town.cga");
//   gable::Shapes lots = gable::Shapes::load("lots.geojson");
//   gable::Model town = gable::derive(rules, lots, {});
//   town.write("town.glb", {});
//
// Nothing here throws, prints or exits. Everything that went wrong comes back as Messages beside
// the result; a result with errors is empty but safe to use. Lengths are metres, angles degrees,
// the frame is right-handed with y up (+x east, -z north). Objects are cheap to copy: copies share.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace gable {

enum class Level : uint8_t { Note, Warning, Error };

/// A remedy that can be carried out: `text` in place of what stands there.
struct Fix {
  std::string file;
  uint32_t line = 0, column = 0, endLine = 0, endColumn = 0;
  std::string text;
};

struct Message {
  Level level = Level::Error;
  /// Stable, kebab-case; listed in the reference.
  std::string code;
  /// Empty when no text is to blame. Lines and columns count from 1.
  std::string file;
  uint32_t line = 0, column = 0, endLine = 0, endColumn = 0;
  std::string text;
  std::string hint;
  /// What the hint says, as an edit, where it is one.
  std::optional<Fix> fix;
  /// The rules from the initial shape down to where it happened; empty before a derivation.
  std::string shapePath;
  /// The message with its place, the line of text and a caret, as a terminal shows it.
  std::string pretty;
};

using Messages = std::vector<Message>;
bool hasErrors(const Messages& messages);
/// The messages as a JSON array.
std::string messagesJson(const Messages& messages);

struct LoadOptions {
  /// The folder that rules may read from; empty: the nearest folder above the rule file that holds
  /// a `rules` or an `assets` folder, else the rule file's own.
  std::string project;
  /// Empty: by the file's extension.
  std::string dialect;
  /// A style that the rule file declares; empty: none.
  std::string style;
  /// Texts that stand for files of the project while they are being edited, by project path
  /// ("rules/windows.cga").
  std::vector<std::pair<std::string, std::string>> overlay;
  /// Rules of the same project as they were before: assets that they have read are not read again,
  /// nor are changes of their files seen, and models made by them are of use to
  /// DeriveSettings::before. May be null.
  const class Rules* before = nullptr;
};

struct AttributeInfo {
  std::string name;
  /// "float", "bool", "string", "float[]", ...
  std::string type;
  bool hidden = false;
  /// Annotations as name and arguments: {"Range", {{"min","0"},{"max","10"}}}.
  struct Annotation {
    std::string name;
    std::vector<std::pair<std::string, std::string>> arguments;
  };
  std::vector<Annotation> annotations;
};

struct RuleInfo {
  std::string name;
  size_t parameters = 0;
  bool start = false;
  std::string file;
  uint32_t line = 0;
};

/// A rule file with all it imports, compiled.
class Rules {
 public:
  /// Reads, parses, analyses and compiles. All messages of all stages are collected.
  static Rules load(const std::string& path, const LoadOptions& options = {});
  /// The same for text that is in memory; `path` names it in messages and places it in the project.
  static Rules parse(const std::string& text, const std::string& path,
                     const LoadOptions& options = {});

  /// No errors: the rules can be derived.
  bool ok() const;
  /// False when the file itself could not be read.
  bool found() const;
  const Messages& messages() const;
  std::vector<AttributeInfo> attributes() const;
  std::vector<RuleInfo> rules() const;
  /// The rule that a derivation starts with unless told otherwise; empty when there is none.
  std::string startRule() const;
  double parseSeconds() const;
  /// A listing of the compiled program.
  std::string disassembly() const;

  struct Impl;
  explicit Rules(std::shared_ptr<const Impl> impl) : impl_(std::move(impl)) {}
  const Impl& impl() const { return *impl_; }
  const std::shared_ptr<const Impl>& shared() const { return impl_; }

 private:
  std::shared_ptr<const Impl> impl_;
};

/// The initial shapes of a derivation: lots, footprints.
class Shapes {
 public:
  /// A rectangle: a corner at the origin, `width` along +x, `depth` along -z, facing up.
  static Shapes lot(double width, double depth);
  using Ring = std::vector<std::pair<double, double>>;
  /// A polygon in plan coordinates (x east, y north), counter-clockwise, with holes.
  static Shapes polygon(const Ring& outer, const std::vector<Ring>& holes = {});
  /// Faces over vertices in metres (y up). `holes` names holes by lists of face numbers: the first
  /// is the face that has them, the others are its holes.
  static Shapes mesh(const std::vector<std::array<double, 3>>& vertices,
                     const std::vector<std::vector<uint32_t>>& faces,
                     const std::vector<std::vector<uint32_t>>& holes = {});
  /// .obj .gltf .glb .geojson .json, by extension.
  static Shapes load(const std::string& path);
  /// The same for a file's content in memory; `name` gives the extension.
  static Shapes parse(const std::string& content, const std::string& name);

  /// The same with footprints cut out of larger ones that they lie in or overlap, so that buildings
  /// in courts do not stand in their neighbours.
  Shapes withNestedCut() const;

  /// Some of the shapes, by index; their draws stay those that they have among all. Numbers that
  /// name no shape are left out.
  Shapes only(const std::vector<size_t>& indices) const;

  /// A shape in plan: the outer ring of its largest face, its name, the area of its faces.
  struct Outline {
    std::string name;
    Ring ring;
    double area = 0;
  };
  Outline outline(size_t shape) const;

  size_t size() const;
  bool ok() const;
  /// False when the file itself could not be read.
  bool found() const;
  const Messages& messages() const;

  struct Impl;
  explicit Shapes(std::shared_ptr<const Impl> impl) : impl_(std::move(impl)) {}
  const Impl& impl() const { return *impl_; }

 private:
  std::shared_ptr<const Impl> impl_;
};

/// What a derivation may use up. Beyond it the initial shape at work ends with a message; what was
/// made until then is kept.
struct Budget {
  uint32_t depth = 1024;
  uint32_t width = 100000;
  uint64_t shapes = 50'000'000;
  uint64_t vertices = 200'000'000;
  /// Operations and calls, each weighed by the size of what it works on.
  uint64_t steps = 4'000'000'000;
  /// By how many bytes the process may grow while deriving; 0: no limit.
  uint64_t bytes = uint64_t{4} << 30;
  /// 0: no limit.
  double seconds = 0;
};

struct DeriveSettings {
  /// Empty: the rules' own start rule.
  std::string startRule;
  double seed = 0;
  /// Seeds of single initial shapes, by index, in place of `seed`.
  std::vector<std::pair<size_t, double>> shapeSeeds;
  /// Names and values as text; arrays as [1,2;3,4]. Over the shapes' own attributes.
  std::vector<std::pair<std::string, std::string>> attributes;
  /// Derive equal parts once. Off gives the same model, flattened.
  bool sharing = true;
  /// Keep the derivation tree (turns sharing off).
  bool trace = false;
  /// With `trace`: the model also has the shapes that rules replace, each as they got it, so that a
  /// derivation can be shown step by step.
  bool traceShapes = false;
  /// 0: as many as the machine has processors.
  int jobs = 0;
  /// Keep in the model what a later derivation needs to take parts of it over.
  bool remember = false;
  /// A model that was made with `remember`, by rules that these came after (LoadOptions::before).
  /// Parts whose rules, attributes, seed and footprints are as they were are taken over from it;
  /// the result is the same as without. Implies `remember`. May be null.
  const class Model* before = nullptr;
  Budget budget;
  /// Called from any thread.
  std::function<void(size_t done, size_t total)> progress;
  std::atomic<bool>* cancel = nullptr;
};

enum class End : uint8_t { Done, LimitReached, Cancelled };

struct WriteSettings {
  /// glTF: instances as EXT_mesh_gpu_instancing instead of nodes.
  bool gpuInstancing = false;
};

struct WriteResult {
  bool ok = false;
  uint64_t triangles = 0;
  uint64_t bytes = 0;
  Messages messages;
};

enum class View : uint8_t { Iso, Top, Front, Street };

struct PictureSettings {
  View view = View::Iso;
  int width = 1600, height = 900;
  int samples = 48;
  /// Degrees; NaN-free "own value" is said by ownSun.
  bool ownSun = false;
  double sunElevation = 38, sunAzimuth = 45;
  /// The ground around the model, sRGB in [0, 1].
  bool ownGround = false;
  double ground[3] = {0, 0, 0};
  /// A camera of one's own: eye and target in metres.
  bool ownCamera = false;
  double eye[3] = {0, 0, 0}, target[3] = {0, 0, 0};
  /// Horizontal angle of view in degrees; 0 for the view's own.
  double fieldOfView = 0;
  int jobs = 0;
  std::function<void(size_t done, size_t total)> progress;
  std::atomic<bool>* cancel = nullptr;
};

/// How a model becomes an asset that fills scopes: its volume is mapped to the unit cube.
struct PrepareSettings {
  /// The point of the model that becomes the origin; without it the lower corner of its box.
  bool ownPivot = false;
  double pivot[3] = {0, 0, 0};
  /// Degrees about x, then y, then z, around the pivot.
  double rotate[3] = {0, 0, 0};
  /// What fills a scope, from the pivot to +x, +y and +z; without it the model's box.
  bool ownVolume = false;
  double volume[3] = {1, 1, 1};
  /// The file's up axis is z.
  bool zUp = false;
  std::string name;
};

/// A shape of the derivation tree. Nodes are in the order of the derivation, a parent before its
/// children, so the index of a node is its step.
struct TreeNode {
  static constexpr uint32_t kNone = 0xffffffff;
  uint32_t parent = kNone;
  /// The initial shape that it belongs to.
  uint32_t shape = 0;
  /// Indices into Tree::names and Tree::files.
  uint32_t name = 0, file = 0;
  /// The operation that made the shape; from 1.
  uint32_t line = 0, column = 0, endLine = 0, endColumn = 0;
  /// The scope in the world: an origin, three unit axes, a size.
  std::array<double, 12> frame{};
  std::array<double, 3> size{};
  bool leaf = false, dropped = false;
  /// Made by a rule call, so that a step of the derivation replaces it.
  bool ruleCall = false;
  /// The place of a leaf's geometry among all leaves in path order, as draw lists count them; of
  /// other shapes the first leaf below them. Leaves below are firstLeaf up to endLeaf; kNone: none.
  uint32_t firstLeaf = 0, endLeaf = 0;
  /// Its own places among the leaves: as its rule got it (with DeriveSettings::traceShapes), and as
  /// it stays where it is a leaf; kNone: none.
  uint32_t before = kNone, after = kNone;
};

/// What a step drew or saw, in that order.
struct TreeNote {
  enum class Kind : uint8_t { Choice, Draw, Attribute, Parameter } kind = Kind::Draw;
  uint32_t node = 0;
  /// The name of an attribute or a parameter; the text of a draw.
  std::string name;
  /// As JSON; "null" for a choice.
  std::string value;
  /// Where a draw or the alternatives of a choice stand; an index into Tree::files, and from 1.
  uint32_t file = 0, line = 0;
  /// Of a choice: what was drawn from 0 to 1, which alternative that is, from 0, among how many,
  /// and how likely it was. The alternative behind the last is `else`.
  double draw = 0, chance = 0;
  uint32_t chosen = 0, choices = 0;
};

struct Tree {
  std::vector<TreeNode> nodes;
  std::vector<std::string> names, files;
  /// With DeriveSettings::traceShapes.
  std::vector<TreeNote> notes;
};

/// What a derivation made, or a model file that was read.
class Model {
 public:
  /// Reads .obj, .gltf or .glb as it is, for pictures.
  static Model load(const std::string& path);
  /// Of a model that was read: the same as an asset, for i(.., unitCube) and post-process tables.
  Model prepared(const PrepareSettings& settings) const;
  /// Of a model that was read: minimum, then maximum.
  std::array<double, 6> bounds() const;

  bool ok() const;
  /// False when a model file could not be read.
  bool found() const;
  End end() const;
  const Messages& messages() const;
  double deriveSeconds() const;
  /// Counts, bounds, reports, prints and messages as one JSON object; see the reference. Seconds
  /// and peak memory are added where given (negative: left out).
  struct Times {
    double parse = -1, derive = -1, write = -1, total = -1;
    int64_t peakBytes = -1;
    uint64_t triangles = 0;
  };
  std::string statsJson(const Times& times) const;
  /// The evaluated attributes of an initial shape as a JSON object.
  std::string attributesJson(size_t shape) const;
  const std::vector<std::string>& prints() const;
  /// A readable list of the leaves, the same for any number of jobs.
  std::string dump() const;
  /// The derivation tree as JSON; empty unless it was asked for.
  std::string traceJson() const;
  /// The same as data; empty unless it was asked for.
  Tree tree() const;
  /// Leaves, instances expanded; the largest number when there are more.
  uint64_t leafCount() const;
  /// The model for a graphics card: batches of instances and of merged triangles; the bytes are
  /// described in docs/dev/studio-protocol.md.
  std::string drawList() const;
  /// JSON of one leaf by its number in draw lists: name, rule, place, material, attributes; empty
  /// when there is none.
  std::string leafJson(uint64_t number) const;
  /// The bytes of a texture by the path that a draw list names; empty when there is none.
  std::string texture(const std::string& path) const;
  /// By extension: .glb .gltf .obj .ply .stl, and .png for a picture with default settings.
  WriteResult write(const std::string& path, const WriteSettings& settings) const;
  WriteResult picture(const std::string& path, const PictureSettings& settings) const;

  struct Impl;
  explicit Model(std::shared_ptr<const Impl> impl) : impl_(std::move(impl)) {}
  const Impl& impl() const { return *impl_; }

 private:
  std::shared_ptr<const Impl> impl_;
};

Model derive(const Rules& rules, const Shapes& shapes, const DeriveSettings& settings);

/// Rule text in canonical form. Text with mistakes comes back unchanged, with messages.
struct Formatted {
  std::string text;
  Messages messages;
};
Formatted format(const std::string& text, const std::string& path);

/// Rule text of another notation as text of Gable's own language. Both derive to the same model.
/// Text of Gable's own language comes back formatted; with mistakes the text is empty.
struct Converted {
  std::string text;
  Messages messages;
};
Converted convert(const std::string& text, const std::string& path,
                  const LoadOptions& options = {});

/// All operations, functions, attributes and selectors with their documentation, as JSON; or of one
/// name alone (empty when there is none).
std::string builtinsJson(const std::string& name = {});
/// The same as readable text.
std::string builtinsText(const std::string& name = {});

const char* version();

}  // namespace gable
