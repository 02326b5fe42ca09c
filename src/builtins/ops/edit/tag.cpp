// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include <algorithm>
#include <string>
#include <unordered_map>

#include "builtins/lists.h"
#include "builtins/ops/shared/edit_mesh.h"
#include "builtins/selection.h"
#include "shape/op_call.h"

namespace gable {

namespace {

// What takes tags. Auto is what has the most dimensions: faces, or the edges or vertices of a shape
// that has no faces.
enum class TagTarget : uint8_t { Auto, Faces, Edges, Vertices };
enum class TagScope : uint8_t { All, Faces, Edges, Vertices };

}  // namespace

template <>
struct WordsOf<TagTarget> {
  static constexpr const char* text = "auto faces edges vertices";
};
template <>
struct WordsOf<TagScope> {
  static constexpr const char* text = "all faces edges vertices";
};

namespace {

struct TagArguments {
  std::string_view name;
  TagTarget components = TagTarget::Auto;
};

struct DeleteTags {
  std::string_view query;
  TagScope components = TagScope::All;
};

uint32_t cornersOfOutline(const Mesh& m, size_t face) { return m.loopsOf(face)[0].cornerCount; }

TagTarget largestOf(const Mesh& m) {
  uint32_t corners = 0;
  for (size_t f = 0; f < m.faceCount(); ++f) corners = std::max(corners, cornersOfOutline(m, f));
  return corners > 2 ? TagTarget::Faces : corners == 2 ? TagTarget::Edges : TagTarget::Vertices;
}

void dropEmpty(std::vector<uint32_t>& sets) {
  if (std::ranges::all_of(sets, [](uint32_t set) { return set == 0; })) sets.clear();
}

// Gives each tag set of the chosen components to `change`. A face of two corners is an edge and one
// of one corner a vertex; neither has tags as a face.
template <class Change>
void changeTags(Mesh& m, TagScope of, const Change& change) {
  const auto takes = [&](TagScope s) { return of == TagScope::All || of == s; };
  if (takes(TagScope::Faces)) {
    for (size_t f = 0; f < m.faceCount(); ++f) {
      if (cornersOfOutline(m, f) > 2) m.faces[f].tags = change(m.faces[f].tags);
    }
  }
  if (takes(TagScope::Edges)) {
    m.edgeTags.resize(m.corners.size());
    for (const MeshLoop& loop : m.loops) {
      if (loop.cornerCount < 2) continue;
      for (uint32_t i = 0; i < loop.cornerCount; ++i) {
        uint32_t& set = m.edgeTags[loop.firstCorner + i];
        set = change(set);
      }
    }
    dropEmpty(m.edgeTags);
  }
  if (takes(TagScope::Vertices)) {
    m.vertexTags.resize(m.positions.size());
    for (uint32_t& set : m.vertexTags) set = change(set);
    dropEmpty(m.vertexTags);
  }
}

// The sides that a primitive has tags for; those of its vertices, and of a box's edges, it has not.
// False where the change needs a mesh.
template <class Change>
bool changePrimitive(Geometry& g, TagScope of, const Change& change) {
  const bool isBox = g.kind == GeometryKind::Box;
  if (of != TagScope::Faces && (isBox || of != TagScope::Edges)) return false;
  if (isBox) {
    for (uint32_t& set : g.tags) set = change(set);
  } else if (of == TagScope::Faces) {
    uint32_t& set = g.tags[g.kind == GeometryKind::QuadXy ? kSideFront : kSideTop];
    set = change(set);
  } else {
    for (const BoxSide side : quadEdges(g.kind)) g.tags[side] = change(g.tags[side]);
  }
  return true;
}

// Sets repeat: what came of each is kept.
template <class Change>
void change(Shape& s, TagScope of, const Change& make) {
  std::unordered_map<uint32_t, uint32_t> known;
  const auto changed = [&](uint32_t set) {
    const auto [at, isNew] = known.try_emplace(set, 0);
    if (isNew) at->second = make(set);
    return at->second;
  };
  Geometry& g = s.geometry;
  if (g.kind == GeometryKind::None) return;
  if (g.kind != GeometryKind::Mesh && changePrimitive(g, of, changed)) return;
  const MeshRef before = meshInScope(s);
  Mesh mesh = *before;
  changeTags(mesh, of, changed);
  // What has no tags that matter stays as it is, a primitive above all.
  if (mesh.contentHash() != before->contentHash()) setMesh(s, std::move(mesh), ScopeFit::Keep);
}

Status applyTag(OpCall& call, const TagArguments& args) {
  std::string name(args.name);
  std::erase_if(name, [](char c) { return c == '?' || c == '*'; });
  if (name.empty()) {
    return call.fail("tag-name", "the tag has no name",
                     "write a name such as tag(\"Facade.Front\"); ? and * stand for names in "
                     "queries and are left out");
  }
  Shape& s = call.shape();
  if (s.geometry.kind == GeometryKind::None) return {};
  TagTarget target = args.components;
  if (target == TagTarget::Auto) {
    const bool isMesh = s.geometry.kind == GeometryKind::Mesh;
    target = isMesh ? largestOf(*s.geometry.mesh) : TagTarget::Faces;
  }
  TagTable& tags = call.services().tags();
  change(s, static_cast<TagScope>(target), [&](uint32_t set) { return tags.with(set, name); });
  return {};
}

Status applyDeleteTags(OpCall& call, const DeleteTags& args) {
  TagTable& tags = call.services().tags();
  const ValuePool& pool = call.services().pool();
  change(call.shape(), args.components, [&](uint32_t set) {
    if (set == 0) return set;
    std::vector<StringId> names = tags.names(set);
    std::erase_if(names, [&](StringId n) {
      return args.query.empty() || tagMatches(args.query, pool.text(n));
    });
    return tags.withNames(set, std::move(names));
  });
  return {};
}

constexpr ParamSpec kName =
    param<&TagArguments::name>("name", "The tag; dots in it make groups: \"Facade.Front\".");
constexpr ParamSpec kTagParams[] = {
    kName,
    param<&TagArguments::components>(
        "components",
        "What gets the tag; auto: faces, and where there are none edges, or vertices.", "auto")};
constexpr Signature kTag[] = {{kTagParams}};

constexpr ParamSpec kDeleteParams[] = {
    param<&DeleteTags::query>(
        "tagQuery",
        "Tags to delete: a name or its beginning by dots; ? stands for one part, * for some.",
        "\"\""),
    param<&DeleteTags::components>("components", "Whose tags are deleted.", "all")};
constexpr Signature kDelete[] = {{kDeleteParams}};

constexpr OpSpec kSpecs[] = {
    {"tag", "edit", "Gives a tag to the faces, edges or vertices.", kTag, typed<applyTag>},
    {"deleteTags", "edit", "Takes tags away from the faces, edges and vertices.", kDelete,
     typed<applyDeleteTags>},
};

}  // namespace

extern const OpList kOps_tag;
const OpList kOps_tag = kSpecs;

}  // namespace gable
