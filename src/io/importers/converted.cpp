// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "io/importers/converted.h"

#include "base/child_process.h"
#include "base/files.h"
#include "base/number.h"

namespace gable {

Error converterFailed(const Error& why, const std::string& path) {
  const bool notBuilt = why.message.find("is built without") != std::string::npos;
  if (why.code == std::string_view("child-missing") || notBuilt) {
    return {"asset-converter", "'" + path + "' needs the program gable-convert: " + why.message,
            notBuilt ? "install the package and build again, or convert the model to glTF or OBJ"
                     : "install libassimp5, libdraco7 and libmeshoptimizer2d"};
  }
  if (why.code == std::string_view("child-limit")) {
    return {"asset-too-large", "'" + path + "' takes too long to read: " + why.message,
            "convert it to glTF or OBJ"};
  }
  return {"asset-broken", "'" + path + "' cannot be read: " + why.message,
          "open it in the program that made it, and save it as glTF or OBJ"};
}

bool isConvertible(const std::string& path) {
  const std::string extension = extensionOf(path);
  return extension == "fbx" || extension == "dae";
}

Result<ConvertedModel> convertModel(std::string_view bytes, const AssetOptions& options) {
  const std::string program = programBeside("gable-convert");
  if (program.empty()) {
    return Error{"asset-converter",
                 "'" + options.path +
                     "' needs the program gable-convert, which is built where libassimp-dev is "
                     "installed",
                 "install libassimp-dev and build again, or convert the model to glTF or OBJ"};
  }
  Result<std::string> out = runChild(program, {extensionOf(options.path)}, bytes, {});
  if (!out.ok()) return converterFailed(out.error(), options.path);
  // The size of the materials, these, and the model.
  const std::string_view all = *out;
  const size_t line = all.find('\n');
  double size = -1;
  if (line == std::string_view::npos || !parseNumber(all.substr(0, line), size) || !(size >= 0) ||
      size > static_cast<double>(all.size() - line - 1)) {
    return Error{"asset-broken", "'" + options.path + "' cannot be read: the reader broke off", {}};
  }
  ConvertedModel model;
  model.mtl = all.substr(line + 1, static_cast<size_t>(size));
  model.obj = all.substr(line + 1 + static_cast<size_t>(size));
  model.options = options;
  model.options.readFile = [mtl = model.mtl](const std::string&) -> Result<std::string> {
    return mtl;
  };
  return model;
}

}  // namespace gable
