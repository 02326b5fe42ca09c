// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "builtins/selection.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/work.h"
#include "builtins/edge_sampling.h"

namespace gable {

namespace {

enum class Test : uint8_t {
  Nothing,
  All,
  // `a` has a bit for each side by Directions::side.
  Direction,
  // The same by streets, and as Direction where none is known.
  Street,
  // The angle to the ground plane.
  Horizontal,
  Vertical,
  Aslant,
  Nutant,
  NotHorizontal,
  Border,
  Inside,
  Roof,  // a: a RoofEdge
  Uv,    // a: a UvSide
};

struct WordRule {
  std::string_view word;
  Test test;
  uint8_t a = 0;
  Directions::Axes axes = Directions::Axes::Scope;
};

constexpr uint8_t kRight = 1, kUp = 2, kFront = 4, kLeft = 8, kDown = 16, kBack = 32;
constexpr uint8_t kSides = kRight | kLeft;
constexpr uint8_t kAround = kRight | kFront | kLeft | kBack;
constexpr uint8_t kNotFront = kRight | kUp | kLeft | kDown | kBack;
using enum Directions::Axes;

constexpr uint8_t of(RoofEdge e) { return static_cast<uint8_t>(e); }

// Sorted by word: `rules()` is searched.
constexpr WordRule kRules[] = {
    {"all", Test::All},
    {"aslant", Test::Aslant},
    {"back", Test::Direction, kBack},
    {"border", Test::Border},
    {"bottom", Test::Direction, kDown},
    {"eave", Test::Roof, of(RoofEdge::Eave)},
    {"front", Test::Direction, kFront},
    {"hip", Test::Roof, of(RoofEdge::Hip)},
    {"horizontal", Test::Horizontal},
    {"inside", Test::Inside},
    {"left", Test::Direction, kLeft},
    {"noStreetSide", Test::Street, kNotFront, Object},
    {"nutant", Test::Nutant},
    {"object.back", Test::Direction, kBack, Object},
    {"object.bottom", Test::Direction, kDown, Object},
    {"object.front", Test::Direction, kFront, Object},
    {"object.left", Test::Direction, kLeft, Object},
    {"object.right", Test::Direction, kRight, Object},
    {"object.side", Test::Direction, kAround, Object},
    {"object.top", Test::Direction, kUp, Object},
    {"ridge", Test::Roof, of(RoofEdge::Ridge)},
    {"right", Test::Direction, kRight},
    {"side", Test::NotHorizontal},
    {"street.back", Test::Street, kBack, Object},
    {"street.front", Test::Street, kFront, Object},
    {"street.left", Test::Street, kLeft, Object},
    {"street.right", Test::Street, kRight, Object},
    {"street.side", Test::Street, kSides, Object},
    {"streetSide", Test::Street, kFront, Object},
    {"top", Test::Direction, kUp},
    {"uv.bottom", Test::Uv, kUvBottom},
    {"uv.left", Test::Uv, kUvLeft},
    {"uv.right", Test::Uv, kUvRight},
    {"uv.top", Test::Uv, kUvTop},
    {"uv.uMax", Test::Uv, kUvMaxU},
    {"uv.uMin", Test::Uv, kUvMinU},
    {"uv.vMax", Test::Uv, kUvMaxV},
    {"uv.vMin", Test::Uv, kUvMinV},
    {"valley", Test::Roof, of(RoofEdge::Valley)},
    {"vertical", Test::Vertical},
    {"world.down", Test::Direction, kDown, World},
    {"world.east", Test::Direction, kRight, World},
    {"world.north", Test::Direction, kBack, World},
    {"world.side", Test::Direction, kAround, World},
    {"world.south", Test::Direction, kFront, World},
    {"world.up", Test::Direction, kUp, World},
    {"world.west", Test::Direction, kLeft, World},
};
constexpr uint8_t kNoWord = 255;

uint8_t ruleOf(std::string_view word) {
  const auto* at =
      std::lower_bound(std::begin(kRules), std::end(kRules), word,
                       [](const WordRule& r, std::string_view w) { return r.word < w; });
  return at != std::end(kRules) && at->word == word ? static_cast<uint8_t>(at - std::begin(kRules))
                                                    : kNoWord;
}

// The sines of 11.25 and 78.75 degrees. Rounding must not move a normal over a border that it lies
// on, so the closed side of each interval is a little wider.
constexpr double kSinLow = 0.19509032201612825, kSinHigh = 0.98078528040323043;
constexpr double kSlack = 1e-9;
// Parts of a unit vector that differ by less are equal.
constexpr double kTie = 1e-6;

bool inSteepness(Test test, const Vec3& normal) {
  const double l = length(normal);
  if (!(l > 0)) return false;
  const double sine = normal.y / l;
  const bool horizontal = sine > kSinHigh + kSlack || sine <= -kSinHigh + kSlack;
  const bool vertical = sine > -kSinLow + kSlack && sine <= kSinLow + kSlack;
  switch (test) {
    case Test::Horizontal: return horizontal;
    case Test::NotHorizontal: return !horizontal;
    case Test::Vertical: return vertical;
    case Test::Aslant: return !horizontal && !vertical && sine > 0;
    default: return !horizontal && !vertical && sine < 0;
  }
}

bool isOneOf(int side, uint8_t sides) { return side >= 0 && (sides >> side & 1) != 0; }

bool ruleHolds(const WordRule& rule, const Selectable& c, const ComponentSource& source,
               const Directions& directions) {
  switch (rule.test) {
    case Test::Nothing: return false;
    case Test::All: return true;
    case Test::Street:
      if (directions.knowsStreets()) return isOneOf(directions.streetSide(c, source), rule.a);
      // object.side takes in the front and the back.
      return isOneOf(directions.side(c.normal, rule.axes), rule.a == kSides ? kAround : rule.a);
    case Test::Direction: break;
    case Test::Border: return c.border && !c.borderless;
    case Test::Inside: return !c.border && !c.borderless;
    case Test::Roof: return of(c.roof) == rule.a;
    case Test::Uv: return (c.uvSides & rule.a) != 0;
    default: return inSteepness(rule.test, c.normal);
  }
  return isOneOf(directions.side(c.normal, rule.axes), rule.a);
}

// One component, of which all is known already.
class PlainSource : public ComponentSource {
 public:
  PlainSource(std::span<const Vec3> points, uint32_t tags) : points_(points), tags_(tags) {}
  void tagsOf(const Selectable&, Of, std::vector<uint32_t>& out) const override {
    out.push_back(tags_);
  }
  void pointsOf(const Selectable&, std::vector<Vec3>& out) const override {
    out.assign(points_.begin(), points_.end());
  }

 private:
  std::span<const Vec3> points_;
  uint32_t tags_;
};

// The first part of a dotted name, and what is behind it.
std::string_view takePart(std::string_view& name) {
  const size_t dot = name.find('.');
  const std::string_view part = name.substr(0, dot);
  name = dot == std::string_view::npos ? std::string_view() : name.substr(dot + 1);
  return part;
}

// `done` tells an empty rest from an empty part.
bool partsMatch(std::string_view query, std::string_view tag) {
  while (!query.empty()) {
    if (tag.empty()) return false;
    const std::string_view wanted = takePart(query);
    if (wanted == "*") {
      // One part or more.
      for (takePart(tag);; takePart(tag)) {
        if (partsMatch(query, tag)) return true;
        if (tag.empty()) return false;
      }
    }
    const std::string_view part = takePart(tag);
    if (wanted != "?" && wanted != part) return false;
  }
  return true;
}

}  // namespace

bool tagMatches(std::string_view query, std::string_view tag) {
  return !query.empty() && partsMatch(query, tag);
}

int Directions::side(const Vec3& normal, Axes axes) const {
  Vec3 n = normalized(normal);
  if (axes != Axes::Scope) {
    n = services_.world().direction(shape_.scope.direction(n));
    if (axes == Axes::Object) n = services_.initialShape().origin.toLocalDirection(n);
  }
  const double x = std::fabs(n.x), y = std::fabs(n.y), z = std::fabs(n.z);
  if (!(x + y + z > 0)) return -1;
  if (y >= std::max(x, z) - kTie) return n.y > 0 ? 1 : 4;
  if (z >= x - kTie) return n.z > 0 ? 2 : 5;
  return n.x > 0 ? 0 : 3;
}

namespace {

constexpr std::string_view kStreet = "street";

// The sum of what looks to the street: of tagged faces by area, else of tagged edges by length.
// Where those cancel each other out, as around a block, it is the first of them that counts.
Vec3 directionOfStreets(const Mesh& m, const TagTable& tags) {
  Vec3 sum, first;
  double whole = 0;
  const auto add = [&](Vec3 outward) {
    outward.y = 0;
    sum += outward;
    whole += length(outward);
    if (first == Vec3{}) first = outward;
  };
  for (size_t f = 0; f < m.faceCount(); ++f) {
    work();
    if (tags.has(m.faces[f].tags, kStreet)) add(m.areaNormal(f));
  }
  for (size_t f = 0; f < m.faceCount() && !(whole > 0) && !m.edgeTags.empty(); ++f) {
    const Vec3 up = m.normal(f);
    for (const MeshLoop& loop : m.loopsOf(f)) {
      for (uint32_t i = 0; i < loop.cornerCount; ++i) {
        work();
        const uint32_t a = loop.firstCorner + i, b = loop.firstCorner + (i + 1) % loop.cornerCount;
        if (tags.has(m.edgeTags[a], kStreet)) add(cross(m.at(b) - m.at(a), up));
      }
    }
  }
  return normalized(length(sum) > kTie * whole ? sum : first);
}

}  // namespace

bool Directions::hasTaggedStreets() const {
  if (!looked_) street_ = directionOfStreets(*meshInScope(shape_), services_.tags());
  looked_ = true;
  return street_ != Vec3{};
}

bool Directions::knowsStreets() const {
  const EdgeAttributes* edges = services_.initialShape().edges.get();
  return hasTaggedStreets() || (edges && edges->hasStreets());
}

int Directions::streetSide(const Selectable& c, const ComponentSource& source) const {
  return hasTaggedStreets() ? sideByTags(c, source) : sideByEdges(c, source);
}

int Directions::sideByTags(const Selectable& c, const ComponentSource& source) const {
  const Vec3 n = normalized(c.normal);
  const double aside = std::sqrt(n.x * n.x + n.z * n.z);
  if (!(length(n) > 0)) return -1;
  if (std::fabs(n.y) >= aside - kTie) return n.y > 0 ? 1 : 4;
  std::vector<uint32_t> sets;
  source.tagsOf(c, ComponentSource::Of::Itself, sets);
  const TagTable& tags = services_.tags();
  if (std::ranges::any_of(sets, [&](uint32_t set) { return tags.has(set, kStreet); })) return 2;
  // As with edges of the initial shape, 45 degrees to the street is a side.
  const double ahead = dot(n, street_), right = dot(n, cross({0, 1, 0}, street_));
  if (-ahead > std::fabs(right) + kTie) return 5;
  return right > 0 ? 0 : 3;
}

int Directions::sideByEdges(const Selectable& c, const ComponentSource& source) const {
  const EdgeSampler sampler(services_, shape_);
  const EdgeAttributes& edges = *sampler.attributes();
  const Vec3 n = normalized(sampler.inObject(c.normal));
  const double up = dot(n, edges.up()), aside = length(n - edges.up() * up);
  if (!(length(n) > 0)) return -1;
  if (std::fabs(up) >= aside - kTie) return up > 0 ? 1 : 4;
  std::vector<Vec3> points;
  source.pointsOf(c, points);
  const int32_t edge = sampler.edgeAt(points, c.normal);
  if (edge < 0) return -1;
  switch (edges.sideOf(static_cast<size_t>(edge))) {
    case StreetSide::Front: return 2;
    case StreetSide::Back: return 5;
    case StreetSide::Left: return 3;
    case StreetSide::Right: break;
  }
  return 0;
}

bool selectsDirection(std::string_view word, const Vec3& normal, std::span<const Vec3> points,
                      uint32_t tags, const Directions& directions) {
  const uint8_t rule = ruleOf(word);
  if (rule == kNoWord) return false;
  Selectable c;
  c.normal = normal;
  c.borderless = true;
  return ruleHolds(kRules[rule], c, PlainSource(points, tags), directions);
}

Selector::Selector(const SelectorItem& item, const ValuePool& pool, const Directions& directions)
    : item_(item), pool_(pool), directions_(directions) {
  for (const SelectorTerm& t : item.terms) {
    work();
    words_.push_back(t.kind == SelectorTerm::Kind::Word ? ruleOf(pool.text(t.word)) : kNoWord);
  }
}

bool Selector::is(std::string_view word) const {
  return item_.terms.size() == 1 && item_.terms[0].kind == SelectorTerm::Kind::Word &&
         pool_.text(item_.terms[0].word) == word;
}

bool Selector::holds(size_t term, const Selectable& c, const ComponentSource& source,
                     const TagTable& table, uint32_t count) const {
  const SelectorTerm& t = item_.terms[term];
  switch (t.kind) {
    case SelectorTerm::Kind::Word:
      return words_[term] != kNoWord && ruleHolds(kRules[words_[term]], c, source, directions_);
    case SelectorTerm::Kind::Index: {
      double wanted = std::trunc(t.number);
      if (count > 0) {
        wanted = std::fmod(wanted, count);
        if (wanted < 0) wanted += count;
      }
      return wanted == c.index;
    }
    case SelectorTerm::Kind::Boolean: {
      if (t.word == 0) return t.number != 0;
      const Array& each = pool_.array(Value::array(ValueType::BoolArray, t.word - 1));
      return c.index < each.numbers.size() && each.numbers[c.index] != 0;
    }
    case SelectorTerm::Kind::Tagged: {
      std::vector<uint32_t> sets;
      source.tagsOf(c, static_cast<ComponentSource::Of>(static_cast<int>(t.number)), sets);
      for (const uint32_t set : sets) {
        for (const StringId name : table.names(set)) {
          if (tagMatches(pool_.text(t.word), pool_.text(name))) return true;
        }
      }
      return false;
    }
    default: return false;
  }
}

bool Selector::matches(const Selectable& c, const ComponentSource& source, const TagTable& table,
                       uint32_t count) const {
  if (item_.terms.size() == 1) return holds(0, c, source, table, count);
  SmallBuffer<uint8_t, 32> stack;
  size_t depth = 0;
  const auto push = [&](bool v) {
    if (depth == stack.size()) stack.push_back(v);
    stack[depth++] = v;
  };
  for (size_t i = 0; i < item_.terms.size(); ++i) {
    work();
    switch (item_.terms[i].kind) {
      case SelectorTerm::Kind::Not: stack[depth - 1] ^= 1; break;
      case SelectorTerm::Kind::And:
        --depth;
        stack[depth - 1] &= stack[depth];
        break;
      case SelectorTerm::Kind::Or:
        --depth;
        stack[depth - 1] |= stack[depth];
        break;
      default: push(holds(i, c, source, table, count)); break;
    }
  }
  return depth > 0 && stack[0];
}

std::string Selector::text() const {
  std::vector<std::string> stack;
  for (const SelectorTerm& t : item_.terms) {
    work();
    switch (t.kind) {
      case SelectorTerm::Kind::Word: stack.emplace_back(pool_.text(t.word)); break;
      case SelectorTerm::Kind::Index: stack.push_back(numberText(t.number)); break;
      case SelectorTerm::Kind::Boolean:
        stack.emplace_back(t.word != 0 ? "expression" : t.number != 0 ? "true" : "false");
        break;
      case SelectorTerm::Kind::Tagged:
        stack.push_back("isTagged(\"" + std::string(pool_.text(t.word)) + "\")");
        break;
      case SelectorTerm::Kind::Not: stack.back() = "!" + stack.back(); break;
      case SelectorTerm::Kind::And:
      case SelectorTerm::Kind::Or: {
        const std::string right = std::move(stack.back());
        stack.pop_back();
        stack.back() += (t.kind == SelectorTerm::Kind::And ? " && " : " || ") + right;
        break;
      }
    }
  }
  return stack.empty() ? std::string() : stack.back();
}

}  // namespace gable
