// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// For tests only: runs any built-in by its name, without a rule file and without the runtime.
//
//   FakeServices services;
//   Ran ran = Op("extrude").args(10).on(quadShape(4, 5), services);
//   ASSERT_TRUE(ran.status.ok()) << ran.status.message();
//   EXPECT_EQ(countsOf(ran.shape.geometry).faces, 6u);
//
//   Op("comp").args(word("f")).select({"top", "side || bottom", "all ="}).on(shape, services)
//   Op("split").args(word("x")).split({{2}, {floating(1)}}).on(...)
//
// Arguments are not checked against the signature: a test may show what a wrong one does.
#pragma once

#include <initializer_list>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "shape/op_call.h"

namespace gable {

/// Files that exist in the test only, by their whole path.
class MemoryAssets : public Assets {
 public:
  std::map<std::string, Ref<AssetModel>, std::less<>> models;
  std::map<std::string, ImageInfo, std::less<>> images;
  std::map<std::string, std::string, std::less<>> texts;
  std::map<std::string, Material, std::less<>> materials;

  void addModel(std::string path, Mesh mesh, std::vector<Material> materials = {});
  void addImage(std::string path, uint32_t width, uint32_t height, bool hasAlpha = false);

  /// With zUp the model is turned by -90 degrees about x, as the services do.
  Ref<AssetModel> model(std::string_view path, std::string_view fromFile, bool zUp,
                        std::string& why) override;
  ImageInfo image(std::string_view path, std::string_view fromFile) override;
  Result<Material> material(std::string_view path, std::string_view fromFile) override;
  bool exists(std::string_view path, std::string_view fromFile) override;
  /// A * in the pattern stands for any characters.
  std::vector<std::string> search(std::string_view pattern, std::string_view fromFile) override;
  bool text(std::string_view path, std::string_view fromFile, std::string& out) override;
  std::string resolve(std::string_view path, std::string_view fromFile) override;
};

/// Pools of its own, files in memory, and a record of all that was said.
class FakeServices : public Services {
 public:
  FakeServices();

  struct Reported {
    std::string key;
    Value value;
  };
  struct Warned {
    std::string code;
    std::string message;
  };
  MemoryAssets files;
  InitialShapeInfo initial;
  Frame worldFrame;
  std::vector<Reported> reports;
  std::vector<std::string> prints;
  std::vector<Warned> warnings;
  std::vector<std::string> labels;
  /// What context queries answer.
  bool queryAnswer = false;
  double distanceAnswer = 0, countAnswer = 0;
  /// What a shape that asks for room is told, and what it asked for last.
  Room roomAnswer = Room::Free;
  RoomRequest roomRequest;
  std::string treeKeyAnswer = "0;";
  /// How many leaves operations left on the way.
  size_t leaves = 0;

  const InitialShapeInfo& initialShapeAtWork() const override { return initial; }
  const Frame& worldAtWork() const override { return worldFrame; }
  void takeReport(StringId key, const Value& value) override;
  void takePrint(std::string text) override { prints.push_back(std::move(text)); }
  void takeMessage(Severity severity, const char* code, std::string message,
                   std::string hint) override;
  bool answerQuery(ContextTest, ContextScope, StringId, const Shape&) override {
    return queryAnswer;
  }
  double answerDistance(ContextScope, StringId, const Shape&) override { return distanceAnswer; }
  double answerCount(ContextScope, StringId) override { return countAnswer; }
  double answerRank(ContextScope, StringId, ContextOrder order, const Shape&) override {
    return static_cast<double>(order);
  }
  Room answerRoom(const RoomRequest& request, const Shape&) override {
    roomRequest = request;
    return roomAnswer;
  }
  void takeLabel(StringId name, const Shape& shape) override;
  std::string treeKeyAtWork() const override { return treeKeyAnswer; }
  void leaveLeaf() override { ++leaves; }

 private:
  ValuePool ownPool_;
  MaterialTable ownMaterials_;
  AttributePool ownAttributes_;
  TagTable ownTags_{ownPool_};
};

/// An argument, turned into a Value when the call is made.
struct Arg {
  ValueType type;
  Unit unit = Unit::Absolute;
  double number = 0;
  std::string text;
  Array array;
  std::vector<std::string> strings;

  Arg(double v) : type(ValueType::Float), number(v) {}
  Arg(int v) : type(ValueType::Float), number(v) {}
  Arg(bool v) : type(ValueType::Bool), number(v ? 1 : 0) {}
  Arg(const char* v) : type(ValueType::String), text(v) {}
  Arg(std::string v) : type(ValueType::String), text(std::move(v)) {}
  Arg(ValueType t, Unit u, double v, std::string s)
      : type(t), unit(u), number(v), text(std::move(s)) {}
  Arg(ValueType t, uint32_t rows, uint32_t columns) : type(t) {
    array.element = elementType(t);
    array.rows = rows;
    array.columns = columns;
  }
  Value value(ValuePool& pool) const;
};
Arg word(std::string_view selector);
/// Written with ' and with ~.
Arg relative(double share);
Arg floating(double weight);
Arg floats(std::initializer_list<double> row);
/// Rows of equal length.
Arg table(std::initializer_list<std::initializer_list<double>> rows);
Arg bools(std::initializer_list<bool> row);
Arg strings(std::initializer_list<const char*> row);

/// Scope at the origin with axes as the frame, pivot there too.
Shape boxShape(const Vec3& size);
/// A rectangle in the ground plane, facing up, and one in the xy plane, facing +z.
Shape quadShape(double w, double d);
Shape wallShape(double w, double h);
/// A polygon with holes in the ground plane, facing up: rings of plan coordinates (x, -z),
/// counter-clockwise all; the scope is its bounding box.
Shape polygonShape(const std::vector<std::vector<Vec2>>& rings);
/// The scope becomes the bounding box.
Shape meshShape(Mesh mesh);
/// A scope without geometry.
Shape emptyShape(const Vec3& size);

/// What is left when an operation has run.
struct Ran {
  Status status;
  Shape shape;
  std::vector<BlockChild> children;
  bool dropped = false;

  /// The children of a slot, in order.
  std::vector<Shape> of(uint32_t slot) const;
};

/// An element of a split block: a size, or a group of elements, perhaps repeated.
struct Piece {
  Arg size = 0;
  std::vector<Piece> group;
  bool repeat = false;

  Piece(Arg s) : size(std::move(s)) {}
  Piece(double s) : size(s) {}
  static Piece of(std::vector<Piece> group, bool repeated) {
    Piece p(0.0);
    p.group = std::move(group);
    p.repeat = repeated;
    return p;
  }
};

class Op {
 public:
  explicit Op(std::string_view name) : name_(name) {}

  template <class... A>
  Op& args(A&&... a) {
    (args_.emplace_back(std::forward<A>(a)), ...);
    return *this;
  }
  /// Slots are numbered in the order of writing.
  Op& split(std::vector<Piece> pieces, bool repeat = false);
  /// Selector items: an expression of words, numbers, isTagged(x) or
  /// isTagged(x, e), ! && || and brackets, then
  /// nothing for `:`, or `=` or `=:`. The slot is the place in the list.
  Op& select(std::vector<std::string> items);
  Op& slots(uint32_t count);
  Op& previous(const Frame& scope, const Vec3& size);

  Ran on(const Shape& shape, FakeServices& services) const;

 private:
  std::string name_;
  std::vector<Arg> args_;
  std::vector<Piece> pieces_;
  bool repeat_ = false;
  std::vector<std::string> selectors_;
  uint32_t slots_ = 0;
  bool hasPrevious_ = false;
  Frame previousScope_;
  Vec3 previousSize_;
};

/// Calls a function by name; `site` is part of the address of random draws.
Value callFunction(std::string_view name, const std::vector<Arg>& args, FakeServices& services,
                   const Shape& shape = {}, uint64_t site = 0);
/// The result as str() prints it, but tables on one line: (2x2)[1,2;3,4].
std::string callText(std::string_view name, const std::vector<Arg>& args, FakeServices& services,
                     const Shape& shape = {});
double callNumber(std::string_view name, const std::vector<Arg>& args, FakeServices& services,
                  const Shape& shape = {});
Value getAttribute(std::string_view name, const Shape& shape, FakeServices& services);
Status setAttribute(std::string_view name, const Arg& value, Shape& shape, FakeServices& services);

/// The volume that the faces of a closed mesh enclose, by the divergence theorem: positive when
/// they look outward.
double enclosedVolume(const Mesh& m);

}  // namespace gable
