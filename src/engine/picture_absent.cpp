// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// In place of picture.cpp where Embree is not: in a browser. Every picture fails, and says why.
#include "engine/picture.h"

namespace gable {
namespace {

template <class T>
T notDrawn() {
  return failed<T>(Error{"picture-settings",
                         "pictures cannot be drawn here: Embree is not built in",
                         "use the program gable"});
}

}  // namespace

WriteResult drawnPicture(const Model::Impl&, const std::string&, const PictureSettings&, Task&) {
  return notDrawn<WriteResult>();
}

struct PictureMaker::Impl {
  DiagnosticList diagnostics = notDrawn<WriteResult>().diagnostics;
};

PictureMaker::PictureMaker(const Model&, const FileLimits&) : impl_(std::make_shared<Impl>()) {}
bool PictureMaker::ok() const { return false; }
const DiagnosticList& PictureMaker::diagnostics() const { return impl_->diagnostics; }

PictureData PictureMaker::draw(const PictureSettings&) const { return notDrawn<PictureData>(); }

std::optional<PictureData::Pose> PictureMaker::pose(const PictureSettings&) const {
  return std::nullopt;
}

WriteResult PictureMaker::write(const std::string&, const PictureSettings&) const {
  return notDrawn<WriteResult>();
}

}  // namespace gable
