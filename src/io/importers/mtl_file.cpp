// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "io/importers/mtl_file.h"

#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "base/work.h"
#include "io/importers/asset.h"
#include "io/importers/text_lines.h"

namespace gable {
namespace {

struct MapStatement {
  const char* name;
  TextureLayer layer;
};
constexpr MapStatement kMaps[] = {
    {"map_kd", TextureLayer::Color},     {"map_bump", TextureLayer::Bump},
    {"bump", TextureLayer::Bump},        {"map_ks", TextureLayer::Specular},
    {"map_d", TextureLayer::Opacity},    {"norm", TextureLayer::Normal},
    {"map_kn", TextureLayer::Normal},    {"map_ke", TextureLayer::Emissive},
    {"map_pr", TextureLayer::Roughness}, {"map_pm", TextureLayer::Metallic},
    {"map_ka", TextureLayer::Occlusion}};

double unit(double v) { return std::min(std::max(v, 0.0), 1.0); }

// CIE XYZ under D65 to linear sRGB.
Vec3 fromXyz(const Vec3& c) {
  return {3.2406 * c.x - 1.5372 * c.y - 0.4986 * c.z, -0.9689 * c.x + 1.8758 * c.y + 0.0415 * c.z,
          0.0557 * c.x - 0.204 * c.y + 1.057 * c.z};
}

// Leaves `out` as it is where the numbers are wrong, and where a file of spectra is named. One
// number is a grey.
bool readColor(LineWords& words, Vec3& out) {
  Vec3 c;
  const LineWords before = words;
  const bool xyz = words.word() == "xyz";
  if (!xyz) words = before;
  if (!words.number(c.x)) return false;
  if (words.atEnd()) {
    c.y = c.z = c.x;
  } else if (!words.number(c.y) || !words.number(c.z)) {
    return false;
  }
  if (xyz) c = fromXyz(c);
  out = {unit(c.x), unit(c.y), unit(c.z)};
  return true;
}

// One option of a map statement; false when the word is none, so that it begins the file's name.
bool readOption(LineWords& words, TextureMap& t, double& bump) {
  words.skip();
  if (words.p >= words.end || *words.p != '-') return false;
  const LineWords before = words;
  const std::string option = lowerCase(words.word());
  double v[3] = {0, 0, 0};
  int n = 0;
  if (option == "-s" || option == "-o" || option == "-t") {
    while (n < 3 && words.number(v[n])) ++n;
    if (option == "-s" && n > 0) t.su = v[0], t.sv = n > 1 ? v[1] : 1;
    if (option == "-o" && n > 0) t.tu = v[0], t.tv = n > 1 ? v[1] : 0;
  } else if (option == "-mm") {
    words.number(v[0]);
    words.number(v[1]);
  } else if (option == "-bm") {
    words.number(bump);
  } else if (option == "-boost" || option == "-texres") {
    words.number(v[0]);
  } else if (option == "-blendu" || option == "-blendv" || option == "-clamp" || option == "-cc" ||
             option == "-imfchan" || option == "-type") {
    words.word();
  } else {
    words = before;
    return false;
  }
  return true;
}

// "-s 2 2 1 -o 0.5 0 0 -clamp on brick wall.png": options first, then the file's name.
bool readMap(LineWords& words, TextureMap& out, double& bump, const std::string& path) {
  TextureMap t;
  double factor = bump;
  while (readOption(words, t, factor)) {
  }
  const std::string_view name = words.rest();
  if (name.empty()) return false;
  t.path = relativeTo(path, name);
  out = t;
  bump = factor;
  return true;
}

enum class Outcome : uint8_t { Read, Broken, Unknown };

Outcome outcomeOf(bool read) { return read ? Outcome::Read : Outcome::Broken; }

// These say how light is to be computed, not what a surface is.
constexpr std::string_view kWaysOfLight[] = {"illum", "ni", "sharpness", "map_aat"};

Outcome readStatement(const std::string& head, LineWords& words, Material& m,
                      const std::string& path) {
  double v = 0;
  const auto number = [&](double& out, double most) {
    const bool ok = words.number(v);
    if (ok) out = std::min(std::max(v, 0.0), most);
    return outcomeOf(ok);
  };
  constexpr double kAny = 1e300;
  if (head == "kd") return outcomeOf(readColor(words, m.color));
  if (head == "ka") return outcomeOf(readColor(words, m.ambient));
  if (head == "ks") return outcomeOf(readColor(words, m.specular));
  if (head == "ke") return outcomeOf(readColor(words, m.emissive));
  if (head == "ns") return number(m.shininess, kAny);
  if (head == "pr") return number(m.roughness, 1);
  if (head == "pm") return number(m.metallic, 1);
  if (head == "d") {
    // The opacity at the middle of a body that is clearer at its border.
    const LineWords before = words;
    if (words.word() != "-halo") words = before;
    return number(m.opacity, 1);
  }
  if (head == "tr") {
    const Outcome outcome = number(v, 1);
    if (outcome == Outcome::Read) m.opacity = 1 - v;
    return outcome;
  }
  if (head == "tf") {
    // Light goes through unchanged where all is 1, which many programs write.
    Vec3 filter;
    const bool all = readColor(words, filter) && filter == Vec3{1, 1, 1};
    return all ? Outcome::Read : Outcome::Unknown;
  }
  for (const MapStatement& s : kMaps) {
    if (head != s.name) continue;
    double none = 0;
    double& bump = s.layer == TextureLayer::Bump ? m.bumpValue : none;
    return outcomeOf(readMap(words, m.map(s.layer), bump, path));
  }
  const bool light =
      std::find(std::begin(kWaysOfLight), std::end(kWaysOfLight), head) != std::end(kWaysOfLight);
  return light ? Outcome::Read : Outcome::Unknown;
}

// Statements of one kind that are lost: the first with its line, and the names of some others.
class Lost {
 public:
  void add(std::string_view head, uint64_t line) {
    constexpr size_t kShown = 40;
    const std::string name(head.substr(0, kShown));
    if (count_++ == 0) line_ = line;
    if (names_.size() <= kMostNames &&
        std::find(names_.begin(), names_.end(), name) == names_.end())
      names_.push_back(name);
  }
  void tell(const std::string& path, const char* what, std::vector<std::string>& out) const {
    if (count_ == 0) return;
    std::string text = path + ":" + std::to_string(line_) + ": '" + names_[0] + "' " + what;
    for (size_t i = 1; i < names_.size(); ++i) {
      text += i == kMostNames ? ", ..." : (i == 1 ? "; nor " : ", ") + ("'" + names_[i] + "'");
    }
    out.push_back(std::move(text));
  }

 private:
  static constexpr size_t kMostNames = 5;
  std::vector<std::string> names_;
  uint64_t count_ = 0, line_ = 0;
};

}  // namespace

std::vector<Material> parseMtl(std::string_view text, const std::string& path,
                               std::vector<std::string>& losses) {
  std::vector<Material> all;
  Material* m = nullptr;
  Lost unknown, broken;
  forEachLine(text, [&](LineWords words) {
    work();
    const std::string_view written = words.word();
    const std::string head = lowerCase(written);
    if (head == "newmtl") {
      m = &all.emplace_back();
      m->name = words.rest();
      return;
    }
    const Outcome outcome = m ? readStatement(head, words, *m, path) : Outcome::Broken;
    if (outcome == Outcome::Unknown) unknown.add(written, words.line);
    if (outcome == Outcome::Broken) broken.add(written, words.line);
  });
  unknown.tell(path, "has no counterpart", losses);
  broken.tell(path, "cannot be read", losses);
  return all;
}

}  // namespace gable
