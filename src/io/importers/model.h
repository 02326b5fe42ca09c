#pragma once
#include "base/result.h"
#include "scene/scene.h"
namespace gable {
struct Asset { MeshRef mesh; std::vector<Material> materials; std::vector<std::string> groups; Box3 bounds; };
inline Result<Asset> readAsset(const std::string&) { return Error{"x", "not yet", ""}; }
}
