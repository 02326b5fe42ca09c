// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// gable asset prepare: a model made ready to fill the scopes of terminal shapes.

#include <cstdio>

#include "commands.h"

namespace {

bool setTriple(const std::string& text, const char* option, double (&out)[3]) {
  if (parseNumbers(text, ',', kMetres, out, 3)) return true;
  wrongOption(option, "three numbers, such as 8,9,8", text);
  return false;
}

}  // namespace

int runAssetPrepare(const AssetArguments& a) {
  gable::PrepareSettings s;
  s.ownPivot = !a.pivot.empty();
  s.ownVolume = !a.volume.empty();
  s.zUp = a.zUp;
  s.name = a.name;
  if (s.ownPivot && !setTriple(a.pivot, "--pivot", s.pivot)) return kExitUsage;
  if (s.ownVolume && !setTriple(a.volume, "--size", s.volume)) return kExitUsage;
  if (!a.rotate.empty() && !setTriple(a.rotate, "--rotate", s.rotate)) return kExitUsage;
  if (const int status = checkExtension(a.output, {"glb", "gltf", "obj"})) return status;
  const gable::Model model = gable::Model::load(a.model);
  printMessages(model.messages());
  if (!model.found()) return kExitFile;
  const gable::Model ready = model.prepared(s);
  if (gable::hasErrors(ready.messages())) {
    printMessages(ready.messages());
    return kExitWrong;
  }
  const gable::WriteResult written = ready.write(a.output, {});
  printMessages(written.messages);
  if (!written.ok) return kExitFile;
  const std::array<double, 6> box = ready.bounds();
  std::printf("%s: the model covers %.3g..%.3g, %.3g..%.3g, %.3g..%.3g of the volume\n",
              a.output.c_str(), box[0], box[3], box[1], box[4], box[2], box[5]);
  return kExitDone;
}
