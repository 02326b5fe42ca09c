// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "shape/audit.h"

#include <algorithm>
#include <vector>

#include "base/check.h"
#include "base/hash.h"
#include "base/work.h"
#include "program/tag_effects.h"

namespace gable {

namespace {

// What takes longer is not run twice.
constexpr uint64_t kMostWork = 200'000;

class ShortMeter final : public WorkMeter {
 public:
  bool look(uint64_t units, uint64_t) override {
    done_ += units;
    return done_ < kMostWork;
  }

 private:
  uint64_t done_ = 0;
};

// Numbers are compared by their bits: what is no number equals itself.
bool same(double a, double b) { return hashDouble(a) == hashDouble(b); }
bool same(const Vec3& a, const Vec3& b) {
  return same(a.x, b.x) && same(a.y, b.y) && same(a.z, b.z);
}
bool same(const Frame& a, const Frame& b) {
  return same(a.origin, b.origin) && same(a.x, b.x) && same(a.y, b.y) && same(a.z, b.z);
}

bool same(const Affine& a, const Affine& b) {
  return same(a.x, b.x) && same(a.y, b.y) && same(a.z, b.z) && same(a.origin, b.origin);
}
bool same(const Deformation& a, const Deformation& b) {
  return same(a.near, b.near) && same(a.far, b.far) && same(a.front, b.front) && same(a.top, b.top);
}

Geometry withoutTags(Geometry g) {
  g.tags.fill(0);
  if (g.kind != GeometryKind::Mesh) return g;
  Mesh mesh = *g.mesh;
  for (MeshFace& f : mesh.faces) f.tags = 0;
  mesh.edgeTags.clear();
  mesh.vertexTags.clear();
  g.mesh = makeRef<Mesh>(std::move(mesh));
  return g;
}

bool same(const Geometry& a, const Geometry& b, uint32_t effects) {
  if ((effects & kIgnoresTags) == 0) return contentHash(a) == contentHash(b);
  return contentHash(withoutTags(a)) == contentHash(withoutTags(b));
}

// All that the audit does not change itself.
bool same(const Shape& a, const Shape& b, uint32_t effects) {
  const bool deformed = a.extra && a.extra->deformed;
  if (deformed != (b.extra && b.extra->deformed)) return false;
  if (deformed && !same(a.extra->deformation, b.extra->deformation)) return false;
  return same(a.scope, b.scope) && same(a.size, b.size) && a.material == b.material &&
         a.assetMaterials == b.assetMaterials && a.attributes == b.attributes &&
         a.locals == b.locals && a.geometry.kind == b.geometry.kind &&
         same(a.geometry, b.geometry, effects);
}

bool same(const OpOutcome& a, const OpOutcome& b, uint32_t effects) {
  if (a.status.ok() != b.status.ok()) return false;
  if (!a.status.ok()) return true;
  if (a.dropped != b.dropped || a.children.size() != b.children.size() ||
      a.pieces.size() != b.pieces.size() || !same(a.shape, b.shape, effects)) {
    return false;
  }
  for (size_t i = 0; i < a.children.size(); ++i) {
    if (a.children[i].slot != b.children[i].slot) return false;
    if (!same(a.children[i].shape, b.children[i].shape, effects)) return false;
  }
  for (size_t i = 0; i < a.pieces.size(); ++i) {
    const SplitPiece &p = a.pieces[i], &q = b.pieces[i];
    if (!same(p.start, q.start) || !same(p.size, q.size) || p.slot != q.slot) return false;
  }
  return true;
}

// An array that holds what is no number has another id each time.
bool same(const Value& a, const Value& b, const ValuePool& pool) {
  if (a.type != b.type || a.unit != b.unit || !same(a.number, b.number)) return false;
  if (a.id == b.id || !a.isArray()) return a.id == b.id;
  const Array &x = pool.array(a), &y = pool.array(b);
  return x.rows == y.rows && x.columns == y.columns && x.strings == y.strings &&
         std::equal(x.numbers.begin(), x.numbers.end(), y.numbers.begin(), y.numbers.end(),
                    [](double p, double q) { return same(p, q); });
}

bool isOutOfMemory(const Status& s) { return std::string_view(s.code()) == "out-of-memory"; }

// A run that was cut short says nothing.
bool wasCutShort(const Status& s) {
  return !s.ok() && (s.code() == kWorkStopped || isOutOfMemory(s));
}

bool selectsByTag(const BlockInput* block, const ValuePool& pool) {
  return block && std::ranges::any_of(block->selectors, [&](const SelectorItem& item) {
           return std::ranges::any_of(item.terms, [&](const SelectorTerm& t) {
             const bool word = t.kind == SelectorTerm::Kind::Word;
             return t.kind == SelectorTerm::Kind::Tagged ||
                    (word && asksForTags(pool.text(t.word)));
           });
         });
}

[[noreturn]] void stop(const char* name) {
  checkFailed(__FILE__, __LINE__, name, "depends on a field of the shape",
              "that its effects do not declare");
}

}  // namespace

Shape changedFields(const Shape& s, uint32_t effects) {
  Shape out = s;
  const auto hidden = [&](uint32_t effect) { return (effects & effect) == 0; };
  if (hidden(kReadsPivot)) out.pivot.origin += Vec3{3, -5, 7};
  if (hidden(kReadsPivot | kReadsPivotAxes)) {
    out.pivot = Frame::of(out.pivot.origin, s.pivot.y, s.pivot.z, s.pivot.x);
  }
  if (hidden(kReadsSplit)) out.split = {s.split.index + 5, s.split.total + 9};
  if (hidden(kReadsComp)) {
    out.comp = {s.comp.index + 5, s.comp.total + 9};
    out.compSelector = s.compSelector + 1;
  }
  if (hidden(kUsesTrim)) {
    out.trimVertical = !s.trimVertical;
    out.trimHorizontal = !s.trimHorizontal;
  }
  // A box whose edges or vertices have tags stays a mesh.
  const Geometry& g = s.geometry;
  const bool tagged =
      g.kind == GeometryKind::Mesh && (!g.mesh->edgeTags.empty() || !g.mesh->vertexTags.empty());
  if ((effects & kIgnoresTags) != 0 && !tagged) out.geometry = withoutTags(g);
  if (hidden(kRandom | kReadsPath)) out.path = hashCombine(s.path, 1);
  if (hidden(kReadsUvProjection)) {
    ShapeExtra extra = extraOf(s);
    UvProjection p;
    p.set = 9;
    p.width = 3;
    extra.setProjection(p);
    out.extra = makeRef<ShapeExtra>(std::move(extra));
  }
  return out;
}

void auditFields(const OpSpec& spec, const Shape& before, std::span<const Value> args,
                 Services& services, const CallPlace& place, const BlockInput* block,
                 const OpOutcome& outcome, Evaluations& evaluations) {
  uint32_t effects = spec.effects;
  if (selectsByTag(block, services.pool())) effects &= ~kIgnoresTags;
  Shape shape = changedFields(before, effects);
  std::vector<BlockChild> children;
  std::vector<SplitPiece> pieces;
  PartPlan plan;
  BlockInput again;
  if (block) {
    again = *block;
    again.children = &children;
    if (block->pieces) again.pieces = &pieces;
    if (block->plan) again.plan = &plan;
    // What is remembered of a division belongs to the first run.
    again.split.memo = nullptr;
    again.componentChild = nullptr;
  }
  OpCall call(spec, shape, args, services, place, block ? &again : nullptr);
  const Services::Muted muted(services);
  evaluations.again = true;
  const Services::Recording recording(services, &evaluations);
  ShortMeter meter;
  const WorkScope scope(meter);
  const Status status = guarded([&] { return spec.apply(call); });
  if (wasCutShort(status)) return;
  const OpOutcome second{status, shape, call.dropped(), children, pieces};
  if (evaluations.strayed || !same(outcome, second, effects)) stop(spec.name);
}

void auditFunction(const char* name, Value (*function)(FunctionCall&), FunctionCall& again,
                   const Value& first, Evaluations& evaluations) {
  const Services::Muted muted(again.services());
  evaluations.again = true;
  const Services::Recording recording(again.services(), &evaluations);
  ShortMeter meter;
  const WorkScope scope(meter);
  Value second;
  const Status status = guarded([&] {
    second = function(again);
    return Status();
  });
  if (!status.ok()) return;
  if (evaluations.strayed || !same(first, second, again.services().pool())) stop(name);
}

}  // namespace gable
