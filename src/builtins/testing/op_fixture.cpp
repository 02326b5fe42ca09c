// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "builtins/testing/op_fixture.h"

#include <algorithm>
#include <cctype>

#include "base/check.h"
#include "builtins/catalogue.h"

namespace gable {

namespace {

bool matches(std::string_view pattern, std::string_view text) {
  if (pattern.empty()) return text.empty();
  if (pattern[0] == '*') {
    for (size_t skip = 0; skip <= text.size(); ++skip) {
      if (matches(pattern.substr(1), text.substr(skip))) return true;
    }
    return false;
  }
  return !text.empty() && pattern[0] == text[0] && matches(pattern.substr(1), text.substr(1));
}

// Reads a selector expression into postfix terms.
class SelectorReader {
 public:
  SelectorReader(std::string_view text, ValuePool& pool, std::vector<SelectorTerm>& out)
      : text_(text), pool_(pool), out_(out) {}

  SelectOperator read() {
    readOr();
    const std::string_view op = rest();
    if (op == "=") return SelectOperator::All;
    if (op == "=:") return SelectOperator::Connected;
    GABLE_CHECK(op.empty() || op == ":");
    return SelectOperator::Each;
  }

 private:
  std::string_view rest() {
    while (!text_.empty() && text_[0] == ' ') text_.remove_prefix(1);
    return text_;
  }
  bool take(std::string_view token) {
    if (rest().substr(0, token.size()) != token) return false;
    text_.remove_prefix(token.size());
    return true;
  }
  void add(SelectorTerm::Kind kind) {
    SelectorTerm t;
    t.kind = kind;
    out_.push_back(t);
  }
  void readOr() {
    readAnd();
    while (take("||")) {
      readAnd();
      add(SelectorTerm::Kind::Or);
    }
  }
  void readAnd() {
    readOne();
    while (take("&&")) {
      readOne();
      add(SelectorTerm::Kind::And);
    }
  }
  void readOne() {
    if (take("!")) {
      readOne();
      add(SelectorTerm::Kind::Not);
      return;
    }
    if (take("(")) {
      readOr();
      GABLE_CHECK(take(")"));
      return;
    }
    SelectorTerm term;
    if (take("isTagged(")) {
      const size_t end = text_.find(')');
      const size_t comma = std::min(text_.find(','), end);
      term.kind = SelectorTerm::Kind::Tagged;
      term.word = pool_.intern(text_.substr(0, comma));
      if (comma < end) term.number = text_[end - 1] == 'e' ? 1 : 2;
      text_.remove_prefix(end + 1);
      out_.push_back(term);
      return;
    }
    rest();
    size_t n = 0;
    while (n < text_.size() && (std::isalnum(static_cast<unsigned char>(text_[n])) ||
                                text_[n] == '.' || text_[n] == '_' || text_[n] == '-')) {
      ++n;
    }
    GABLE_CHECK(n > 0);
    const std::string token(text_.substr(0, n));
    text_.remove_prefix(n);
    const bool number =
        std::isdigit(static_cast<unsigned char>(token[0])) || (token[0] == '-' && n > 1);
    term.kind = number ? SelectorTerm::Kind::Index : SelectorTerm::Kind::Word;
    if (number)
      term.number = std::stod(token);
    else
      term.word = pool_.intern(token);
    out_.push_back(term);
  }

  std::string_view text_;
  ValuePool& pool_;
  std::vector<SelectorTerm>& out_;
};

void flatten(const std::vector<Piece>& pieces, uint32_t& slot, std::vector<SplitItem>& out) {
  for (const Piece& p : pieces) {
    const size_t at = out.size();
    SplitItem item;
    item.repeat = p.repeat;
    item.group = !p.group.empty();
    if (!item.group) {
      item.size = p.size.number;
      item.unit = p.size.unit;
      item.slot = slot++;
    }
    out.push_back(item);
    flatten(p.group, slot, out);
    if (item.group) out[at].length = static_cast<uint32_t>(out.size() - at - 1);
  }
}

}  // namespace

void MemoryAssets::addModel(std::string path, Mesh mesh, std::vector<Material> list) {
  AssetModel m;
  m.mesh = makeRef<Mesh>(std::move(mesh));
  m.materials = std::move(list);
  fitModel(m);
  models[std::move(path)] = makeRef<AssetModel>(std::move(m));
}

void MemoryAssets::addImage(std::string path, uint32_t width, uint32_t height, bool hasAlpha) {
  images[std::move(path)] = {true, width, height, hasAlpha};
}

Ref<AssetModel> MemoryAssets::model(std::string_view path, std::string_view, bool zUp,
                                    std::string& why) {
  const auto at = models.find(path);
  if (at == models.end()) {
    why = "there is no file '" + std::string(path) + "'";
    return {};
  }
  if (!zUp) return at->second;
  AssetModel m = *at->second;
  m.mesh = makeRef<Mesh>(transformed(*m.mesh, {1, 1, 1}, rotationXyz(-90, 0, 0)));
  fitModel(m);
  return makeRef<AssetModel>(std::move(m));
}

ImageInfo MemoryAssets::image(std::string_view path, std::string_view) {
  const auto at = images.find(path);
  return at == images.end() ? ImageInfo{} : at->second;
}

Result<Material> MemoryAssets::material(std::string_view path, std::string_view) {
  const auto at = materials.find(path);
  if (at != materials.end()) return at->second;
  return Error{"missing-file", "there is no file '" + std::string(path) + "'", ""};
}

bool MemoryAssets::exists(std::string_view path, std::string_view) {
  return models.count(path) || images.count(path) || texts.count(path);
}

std::vector<std::string> MemoryAssets::search(std::string_view pattern, std::string_view) {
  std::vector<std::string> found;
  const auto take = [&](const auto& files) {
    for (const auto& [path, file] : files) {
      if (matches(pattern, path)) found.push_back(path);
    }
  };
  take(models);
  take(images);
  take(texts);
  std::sort(found.begin(), found.end());
  return found;
}

bool MemoryAssets::text(std::string_view path, std::string_view, std::string& out) {
  const auto at = texts.find(path);
  if (at == texts.end()) return false;
  out = at->second;
  return true;
}

std::string MemoryAssets::resolve(std::string_view path, std::string_view) {
  return std::string(path);
}

FakeServices::FakeServices() {
  pool_ = &ownPool_;
  materials_ = &ownMaterials_;
  attributes_ = &ownAttributes_;
  tags_ = &ownTags_;
  assets_ = &files;
  initial.name = "shape";
  initial.startRule = "Lot";
}

void FakeServices::takeReport(StringId key, const Value& value) {
  reports.push_back({std::string(pool().text(key)), value});
}

void FakeServices::takeMessage(Severity, const char* code, std::string message, std::string) {
  warnings.push_back({code, std::move(message)});
}

void FakeServices::takeLabel(StringId name, const Shape&) {
  labels.emplace_back(pool().text(name));
}

Value Arg::value(ValuePool& pool) const {
  switch (type) {
    case ValueType::Null: return {};
    case ValueType::Float:
    case ValueType::Bool: return {type, unit, 0, number};
    case ValueType::String:
    case ValueType::Selector: return {type, unit, pool.intern(text), 0};
    default: break;
  }
  Array a = array;
  for (const std::string& s : strings) a.strings.push_back(pool.intern(s));
  return pool.intern(std::move(a));
}

Arg word(std::string_view selector) {
  return {ValueType::Selector, Unit::Absolute, 0, std::string(selector)};
}
Arg relative(double share) { return {ValueType::Float, Unit::Relative, share, {}}; }
Arg floating(double weight) { return {ValueType::Float, Unit::Floating, weight, {}}; }

Arg floats(std::initializer_list<double> row) {
  Arg a(ValueType::FloatArray, 1, static_cast<uint32_t>(row.size()));
  a.array.numbers = row;
  return a;
}

Arg table(std::initializer_list<std::initializer_list<double>> rows) {
  Arg a(ValueType::FloatArray, static_cast<uint32_t>(rows.size()),
        static_cast<uint32_t>(rows.size() ? rows.begin()->size() : 0));
  for (const auto& row : rows) a.array.numbers.insert(a.array.numbers.end(), row);
  return a;
}

Arg bools(std::initializer_list<bool> row) {
  Arg a(ValueType::BoolArray, 1, static_cast<uint32_t>(row.size()));
  for (bool b : row) a.array.numbers.push_back(b ? 1 : 0);
  return a;
}

Arg strings(std::initializer_list<const char*> row) {
  Arg a(ValueType::StringArray, 1, static_cast<uint32_t>(row.size()));
  for (const char* s : row) a.strings.emplace_back(s);
  return a;
}

Shape emptyShape(const Vec3& size) {
  Shape s;
  s.size = size;
  return s;
}

Shape boxShape(const Vec3& size) {
  Shape s = emptyShape(size);
  s.geometry.kind = GeometryKind::Box;
  s.geometry.refSize = size;
  return s;
}

Shape quadShape(double w, double d) {
  Shape s = emptyShape({w, 0, d});
  s.geometry.kind = GeometryKind::QuadXz;
  s.geometry.refSize = s.size;
  return s;
}

Shape wallShape(double w, double h) {
  Shape s = emptyShape({w, h, 0});
  s.geometry.kind = GeometryKind::QuadXy;
  s.geometry.refSize = s.size;
  return s;
}

Shape polygonShape(const std::vector<std::vector<Vec2>>& rings) {
  MeshBuilder b;
  b.beginFace();
  bool outer = true;
  for (const auto& ring : rings) {
    b.beginLoop();
    for (size_t i = 0; i < ring.size(); ++i) {
      b.addCorner(b.addPosition(fromPlan(ring[outer ? i : (ring.size() - i) % ring.size()])));
    }
    outer = false;
  }
  return meshShape(b.take());
}

Shape meshShape(Mesh mesh) {
  Shape s;
  setMesh(s, std::move(mesh), ScopeFit::Refit);
  return s;
}

std::vector<Shape> Ran::of(uint32_t slot) const {
  std::vector<Shape> out;
  for (const BlockChild& c : children) {
    if (c.slot == slot) out.push_back(c.shape);
  }
  return out;
}

Op& Op::split(std::vector<Piece> pieces, bool repeat) {
  pieces_ = std::move(pieces);
  repeat_ = repeat;
  return *this;
}

Op& Op::select(std::vector<std::string> items) {
  selectors_ = std::move(items);
  return *this;
}

Op& Op::slots(uint32_t count) {
  slots_ = count;
  return *this;
}

Op& Op::previous(const Frame& scope, const Vec3& size) {
  hasPrevious_ = true;
  previousScope_ = scope;
  previousSize_ = size;
  return *this;
}

Ran Op::on(const Shape& shape, FakeServices& services) const {
  const OpSpec* spec = builtinCatalogue().operation(name_);
  GABLE_CHECK(spec != nullptr);
  ValuePool& pool = services.pool();
  std::vector<Value> values;
  for (const Arg& a : args_) values.push_back(a.value(pool));

  std::vector<SplitItem> items;
  uint32_t slotCount = slots_;
  flatten(pieces_, slotCount, items);

  // The terms are collected first: their storage must not move once an item points at them.
  std::vector<std::vector<SelectorTerm>> terms(selectors_.size());
  std::vector<SelectorItem> selectors;
  for (size_t i = 0; i < selectors_.size(); ++i) {
    SelectorItem item;
    item.op = SelectorReader(selectors_[i], pool, terms[i]).read();
    item.terms = terms[i];
    item.slot = slotCount++;
    selectors.push_back(item);
  }

  Ran ran;
  ran.shape = shape;
  BlockInput input;
  input.split = {items, repeat_};
  input.selectors = selectors;
  input.slotCount = slotCount;
  input.children = &ran.children;
  const CallPlace place{hasPrevious_ ? previousScope_ : shape.scope,
                        hasPrevious_ ? previousSize_ : shape.size, "rules/test.cga"};
  OpCall call(*spec, ran.shape, values, services, place, &input);
  ran.status = call.run();
  ran.dropped = call.dropped();
  return ran;
}

Value callFunction(std::string_view name, const std::vector<Arg>& args, FakeServices& services,
                   const Shape& shape, uint64_t site) {
  const FunctionSpec* spec = builtinCatalogue().function(name);
  GABLE_CHECK(spec != nullptr);
  std::vector<Value> values;
  for (const Arg& a : args) values.push_back(a.value(services.pool()));
  FunctionCall call(values, shape, services, spec);
  call.place("rules/test.cga", site);
  return call.run(spec->call, spec->effects);
}

std::string callText(std::string_view name, const std::vector<Arg>& args, FakeServices& services,
                     const Shape& shape) {
  const ValuePool& pool = services.pool();
  const Value v = callFunction(name, args, services, shape);
  if (!v.isArray() || pool.array(v).rows <= 1) return pool.str(v);
  // Tables on one line: (2x2)[1,2;3,4].
  const Array& a = pool.array(v);
  std::string out = "(" + std::to_string(a.rows) + "x" + std::to_string(a.columns) + ")[";
  for (size_t i = 0; i < a.size(); ++i) {
    if (i > 0) out += i % a.columns == 0 ? ';' : ',';
    const bool text = a.element == ValueType::String;
    out += pool.str({a.element, Unit::Absolute, text ? a.strings[i] : 0, text ? 0 : a.numbers[i]});
  }
  return out + "]";
}

double callNumber(std::string_view name, const std::vector<Arg>& args, FakeServices& services,
                  const Shape& shape) {
  return callFunction(name, args, services, shape).number;
}

Value getAttribute(std::string_view name, const Shape& shape, FakeServices& services) {
  const AttributeSpec* spec = builtinCatalogue().attribute(name);
  GABLE_CHECK(spec != nullptr);
  FunctionCall call({}, shape, services);
  return spec->get(call);
}

Status setAttribute(std::string_view name, const Arg& value, Shape& shape, FakeServices& services) {
  const AttributeSpec* spec = builtinCatalogue().attribute(name);
  GABLE_CHECK(spec != nullptr && spec->set != nullptr);
  const OpSpec* op = builtinCatalogue().operation("t");
  const Frame scope = shape.scope;
  const Vec3 size = shape.size;
  const CallPlace place{scope, size, "rules/test.cga"};
  OpCall call(*op, shape, {}, services, place);
  return spec->set(call, value.value(services.pool()));
}

double enclosedVolume(const Mesh& m) {
  double sum = 0;
  const Vec3 origin = m.positions.empty() ? Vec3{} : m.positions[0];
  for (const MeshLoop& loop : m.loops) {
    for (uint32_t i = 1; i + 1 < loop.cornerCount; ++i) {
      const Vec3 a = m.at(loop.firstCorner) - origin, b = m.at(loop.firstCorner + i) - origin,
                 c = m.at(loop.firstCorner + i + 1) - origin;
      sum += dot(a, cross(b, c));
    }
  }
  return sum / 6;
}

}  // namespace gable
