// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Exports: models as files for a page, with news of how far they are.
//
// Any thread may call.
#pragma once

#include <atomic>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <string>

#include "gable/gable.h"
#include "studio/session.h"

namespace gable::studio {

struct Exported {
  std::string bytes;
  /// "glb", or "obj.zip" where a format makes several files.
  std::string extension;
};

/// What a page says of a picture: `camera` as "[eye x, y, z, target x, y, z, horizontal angle]",
/// `size` as "[width, height]", `sun` as "[elevation, azimuth]"; the usual ones where they are
/// empty. Code: request-wrong.
Result<PictureSettings> pictureOf(const std::string& camera, const std::string& size,
                                  const std::string& sun = {});

/// What a page asks of the sun over a model: `day` as "[year, month, day]", `hour` of a clock by
/// the sun there, `place` as "[latitude, longitude]" or empty for that of the model's map. JSON,
/// {elevation, azimuth} in degrees; null for a model on no map. Codes: request-wrong,
/// place-unknown.
Result<std::string> sunJson(const Model& model, const std::string& day, const std::string& hour,
                            const std::string& place);

class Exports {
 public:
  /// `format` is an extension. Codes: format-unknown, model-too-large, file-unwritable, cancelled,
  /// and those of the writers. `picture`: how a picture is taken.
  Result<Exported> write(const Model& model, const std::string& format, const std::string& page,
                         const Session::Cancel& cancel, const PictureSettings& picture = {});
  /// Of the page's export under way: `done` of `total`, or `bytes` written where no total is known.
  std::string progressJson(const std::string& page) const;

 private:
  struct Work {
    std::atomic<uint64_t> done{0}, total{0};
    std::string folder;
  };
  mutable std::mutex mutex_;
  std::map<std::string, std::shared_ptr<Work>> works_;
};

}  // namespace gable::studio
