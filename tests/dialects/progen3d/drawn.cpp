// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "drawn.h"

#include <cmath>
#include <cstdlib>
#include <sstream>

#include "base/files.h"
#include "geom/mesh/topology.h"
#include "material/builtin_textures.h"
#include "scene/scene.h"

namespace gable::progen3d_test {

namespace {

int numberOfTexture(const std::string& path) {
  for (size_t i = 0; i < kBuiltinTextures.size(); ++i) {
    if (path == builtinTexturePath(i)) return static_cast<int>(i);
  }
  return -1;
}

Drawn drawn(Rules rules, const DrawOptions& options) {
  DeriveSettings settings;
  settings.seed = options.seed;
  settings.sharing = options.sharing;
  settings.limits = options.limits;
  settings.jobs = 1;
  Drawn out{derive(rules, Shapes::lot(20, 20), settings), rules, {}, {}};
  const Scene& scene = out.model.impl().result.scene;
  forEachLeaf(scene, [&](const Leaf& leaf, const Frame& world) {
    Body b;
    b.rule = scene.names[leaf.name];
    b.mesh = leaf.mesh;
    const Mesh& mesh = *scene.meshes[leaf.mesh];
    for (const Vec3& p : mesh.positions) b.box.include(world.point(scaled(p, leaf.scale)));
    const Material& material = scene.materials[scene.materialLists[leaf.materials][0]];
    const TextureMap& map = material.map(TextureLayer::Color);
    b.texture = numberOfTexture(map.path);
    b.quarters = static_cast<int>(map.rw / 90);
    b.scale = map.su / 2;
    if (options.surfaces) {
      const Mesh placed = transformed(mesh, leaf.scale, world);
      b.volume = volume(placed);
      b.closed = Topology(placed).closed();
    }
    out.bounds.include(b.box.min);
    out.bounds.include(b.box.max);
    out.bodies.push_back(b);
  });
  return out;
}

}  // namespace

DiagnosticList Drawn::messages() const {
  DiagnosticList all = rules.diagnostics();
  all.insert(all.end(), model.diagnostics().begin(), model.diagnostics().end());
  return all;
}

std::vector<std::string> Drawn::codes() const {
  std::vector<std::string> out;
  for (const Diagnostic& m : messages()) {
    const TextRange at = m.range.value_or(TextRange{});
    out.push_back(m.code + " " + std::to_string(at.line) + ":" + std::to_string(at.column));
  }
  return out;
}

bool Drawn::has(const std::string& code) const {
  for (const Diagnostic& m : messages()) {
    if (m.code == code) return true;
  }
  return false;
}

std::map<int, int> Drawn::textures() const {
  std::map<int, int> out;
  for (const Body& b : bodies) ++out[b.texture];
  return out;
}

Drawn draw(const std::string& grammar, const DrawOptions& options, const std::string& name) {
  return drawn(Rules::parse(grammar, name), options);
}

Drawn drawConverted(const std::string& cga, const DrawOptions& options) {
  return drawn(Rules::parse(cga, "test.cga"), options);
}

std::string dataFolder() {
  const char* given = std::getenv("GABLE_SHARED");
  const std::string folder =
      (given ? std::string(given) : std::string(GABLE_SOURCE_DIR) + "/../shared") +
      "/data/progen3d";
  return readFile(folder + "/fence.grammar").ok() ? folder : std::string();
}

std::string dataText(const std::string& path) {
  const Result<std::string> text = readFile(dataFolder() + "/" + path);
  return text.ok() ? text.value() : std::string();
}

std::vector<Truth> truthOf(const std::string& name) {
  std::string all = dataText("micro-truth/" + name + ".b.seed1.txt");
  if (all.empty()) all = dataText("micro-truth/" + name + ".a.seed1.txt");
  std::vector<Truth> out;
  std::istringstream lines(all);
  for (std::string line; std::getline(lines, line);) {
    Truth t;
    char type[16] = {};
    Vec3 &a = t.box.min, &b = t.box.max;
    if (std::sscanf(line.c_str(), "%15s tex=%d rot=%d texscale=%lf bbox %lf %lf %lf %lf %lf %lf",
                    type, &t.texture, &t.quarters, &t.scale, &a.x, &a.y, &a.z, &b.x, &b.y,
                    &b.z) == 10) {
      t.type = type;
      out.push_back(t);
    }
  }
  return out;
}

std::string text(const Box3& box) {
  std::ostringstream out;
  out << "[" << box.min.x << " " << box.min.y << " " << box.min.z << " .. " << box.max.x << " "
      << box.max.y << " " << box.max.z << "]";
  return out.str();
}

// Relative for large numbers: the truth has six digits.
bool near(const Box3& a, const Box3& b, double tolerance) {
  for (size_t i = 0; i < 3; ++i) {
    for (const auto& [x, y] : {std::pair{a.min[i], b.min[i]}, std::pair{a.max[i], b.max[i]}}) {
      if (!(std::fabs(x - y) <= tolerance * std::max(1.0, std::fabs(y)))) return false;
    }
  }
  return true;
}

}  // namespace gable::progen3d_test
