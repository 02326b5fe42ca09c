// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "io/importers/mtl_file.h"

#include <algorithm>
#include <cmath>

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

std::string lowered(std::string_view s) {
  std::string out(s);
  for (char& c : out) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return out;
}

double unit(double v) { return std::min(std::max(v, 0.0), 1.0); }

// CIE XYZ under D65 to linear sRGB.
Vec3 fromXyz(const Vec3& c) {
  return {3.2406 * c.x - 1.5372 * c.y - 0.4986 * c.z, -0.9689 * c.x + 1.8758 * c.y + 0.0415 * c.z,
          0.0557 * c.x - 0.204 * c.y + 1.057 * c.z};
}

// Leaves `out` as it is where the numbers are wrong, and where a file of spectra is named. One
// number is a grey.
void readColor(LineWords& words, Vec3& out) {
  Vec3 c;
  const LineWords before = words;
  const bool xyz = words.word() == "xyz";
  if (!xyz) words = before;
  if (!words.number(c.x)) return;
  if (words.atEnd()) {
    c.y = c.z = c.x;
  } else if (!words.number(c.y) || !words.number(c.z)) {
    return;
  }
  if (xyz) c = fromXyz(c);
  out = {unit(c.x), unit(c.y), unit(c.z)};
}

// One option of a map statement; false when the word is none, so that it begins the file's name.
bool readOption(LineWords& words, TextureMap& t, double& bump) {
  words.skip();
  if (words.p >= words.end || *words.p != '-') return false;
  const LineWords before = words;
  const std::string option = lowered(words.word());
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
void readMap(LineWords& words, TextureMap& out, double& bump, const std::string& path) {
  TextureMap t;
  double factor = bump;
  while (readOption(words, t, factor)) {
  }
  const std::string_view name = words.rest();
  if (name.empty()) return;
  t.path = relativeTo(path, name);
  out = t;
  bump = factor;
}

void readStatement(const std::string& head, LineWords& words, Material& m,
                   const std::string& path) {
  double v = 0;
  if (head == "kd") {
    readColor(words, m.color);
  } else if (head == "ka") {
    readColor(words, m.ambient);
  } else if (head == "ks") {
    readColor(words, m.specular);
  } else if (head == "ke") {
    readColor(words, m.emissive);
  } else if (head == "ns") {
    if (words.number(v)) m.shininess = std::max(v, 0.0);
  } else if (head == "d") {
    // The opacity at the middle of a body that is clearer at its border.
    const LineWords before = words;
    if (words.word() != "-halo") words = before;
    if (words.number(v)) m.opacity = unit(v);
  } else if (head == "tr") {
    if (words.number(v)) m.opacity = unit(1 - v);
  } else if (head == "pr") {
    if (words.number(v)) m.roughness = unit(v);
  } else if (head == "pm") {
    if (words.number(v)) m.metallic = unit(v);
  }
  for (const MapStatement& s : kMaps) {
    double none = 0;
    double& bump = s.layer == TextureLayer::Bump ? m.bumpValue : none;
    if (head == s.name) readMap(words, m.map(s.layer), bump, path);
  }
}

}  // namespace

std::vector<Material> parseMtl(std::string_view text, const std::string& path) {
  std::vector<Material> all;
  Material* m = nullptr;
  forEachLine(text, [&](LineWords words) {
    work();
    const std::string head = lowered(words.word());
    if (head == "newmtl") {
      m = &all.emplace_back();
      m->name = words.rest();
    } else if (m) {
      readStatement(head, words, *m, path);
    }
  });
  return all;
}

}  // namespace gable
