// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "io/importers/obj_file.h"

#include <limits>
#include <unordered_map>

#include "base/work.h"
#include "io/importers/text_lines.h"

namespace gable {
namespace {

constexpr uint32_t kNone = ObjCorner::kNone;

// Words to indices, in the order of first mention.
class NameTable {
 public:
  explicit NameTable(std::vector<std::string>& names) : names_(names) {}
  uint32_t of(std::string_view name) {
    const auto [at, isNew] = known_.try_emplace(std::string(name), names_.size());
    if (isNew) names_.emplace_back(name);
    return static_cast<uint32_t>(at->second);
  }

 private:
  std::vector<std::string>& names_;
  std::unordered_map<std::string, size_t> known_;
};

class ObjParser {
 public:
  explicit ObjParser(ObjFile& out)
      : out_(out),
        materials_(out.materials),
        objects_(out.objects),
        groups_(out.groups),
        materialFiles_(out.materialFiles) {}

  void line(LineWords words) {
    work();
    const std::string_view head = words.word();
    why_.clear();
    bool ok = true;
    if (head == "v") {
      ok = position(words);
    } else if (head == "vt") {
      Vec2 uv;
      ok = words.number(uv.x) && (words.atEnd() || words.number(uv.y));
      out_.uvs.push_back(ok ? uv : Vec2{});
    } else if (head == "vn") {
      Vec3 n;
      ok = words.number(n.x) && words.number(n.y) && words.number(n.z);
      out_.normals.push_back(ok ? n : Vec3{});
    } else if (head == "f") {
      ok = face(words);
    } else if (head == "usemtl") {
      state_.material = materials_.of(words.rest());
    } else if (head == "o") {
      state_.object = objects_.of(words.rest());
    } else if (head == "g") {
      state_.group = words.atEnd() ? kNone : groups_.of(words.word());
    } else if (head == "s") {
      const std::string_view how = words.word();
      state_.smooth = how != "off" && how != "0" && !how.empty();
    } else if (head == "mtllib") {
      materialFiles_.of(words.rest());
    }
    // Other statements (points, lines, free-form curves) are none of ours.
    out_.lines += head == "l" ? 1 : 0;
    if (ok || out_.badLines++ > 0) return;
    out_.firstBadLine = words.line;
    out_.firstBadReason = why_.empty() ? "'" + std::string(head) + "' needs numbers" : why_;
  }

 private:
  bool position(LineWords& words) {
    Vec3 p;
    const bool ok = words.number(p.x) && words.number(p.y) && words.number(p.z);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    out_.positions.push_back(ok ? p : Vec3{nan, nan, nan});
    return ok;
  }

  // "12" counts from the first, "-3" from the last so far. False when it names nothing.
  static bool index(const char*& p, const char* end, size_t count, uint32_t& out) {
    const bool negative = p < end && *p == '-';
    if (negative) ++p;
    const char* digits = p;
    uint64_t v = 0;
    for (; p < end && *p >= '0' && *p <= '9'; ++p) {
      if (v < (1ULL << 40)) v = v * 10 + static_cast<uint64_t>(*p - '0');
    }
    if (p == digits || v == 0 || v > count) return false;
    out = static_cast<uint32_t>(negative ? count - v : v - 1);
    return out != kNone;
  }

  // p, p/t, p//n or p/t/n.
  bool corner(std::string_view word, ObjCorner& c) const {
    const char* p = word.data();
    const char* const end = p + word.size();
    if (!index(p, end, out_.positions.size(), c.position)) return false;
    if (p == end) return true;
    if (*p++ != '/') return false;
    if (p < end && *p != '/' && !index(p, end, out_.uvs.size(), c.uv)) return false;
    if (p == end) return true;
    if (*p++ != '/') return false;
    return p == end || (index(p, end, out_.normals.size(), c.normal) && p == end);
  }

  bool face(LineWords& words) {
    ObjFace f = state_;
    f.firstCorner = static_cast<uint32_t>(out_.corners.size());
    while (!words.atEnd()) {
      work();
      ObjCorner c;
      const std::string_view word = words.word();
      if (!corner(word, c)) {
        constexpr size_t kShown = 40;
        why_ = "the corner '" + std::string(word.substr(0, kShown)) + "' names no vertex of the " +
               std::to_string(out_.positions.size()) + " before it";
        out_.corners.resize(f.firstCorner);
        return false;
      }
      out_.corners.push_back(c);
    }
    f.cornerCount = static_cast<uint32_t>(out_.corners.size()) - f.firstCorner;
    // Triangles of a concave face take quadratic time.
    constexpr uint32_t kMostCorners = 100'000;
    if (f.cornerCount < 3 || f.cornerCount > kMostCorners) {
      why_ = "a face has 3 to 100000 corners, not " + std::to_string(f.cornerCount);
      out_.corners.resize(f.firstCorner);
      return false;
    }
    out_.faces.push_back(f);
    return true;
  }

  ObjFile& out_;
  NameTable materials_, objects_, groups_, materialFiles_;
  ObjFace state_;
  // Why the line at hand cannot be read, where more is known than its statement.
  std::string why_;
};

}  // namespace

ObjFile parseObj(std::string_view text) {
  ObjFile out;
  ObjParser parser(out);
  forEachLine(text, [&](const LineWords& line) { parser.line(line); });
  return out;
}

}  // namespace gable
