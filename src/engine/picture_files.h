// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// A picture and its layers as files of a folder. What a program reads back exactly is a float map
// (PFM) or has whole numbers; what a person looks at is a PNG.
#pragma once

#include <string>
#include <vector>

#include "base/json.h"
#include "base/result.h"
#include "gable/model.h"

namespace gable {

/// The first failure is kept, and later calls do nothing.
class PictureFiles {
 public:
  /// `folder` is there, and ends in a slash, or is empty. `level`: zlib's, of layers.
  PictureFiles(const PictureData& picture, std::string folder, int level = 6)
      : picture_(picture), folder_(std::move(folder)), level_(level) {}

  void write(const std::string& name, const Result<std::string>& bytes);
  /// The picture itself.
  void writeColors(const std::string& name);
  void writeAlbedo(const std::string& name);
  void writeNormals(const std::string& name);
  /// One float a pixel, rows from below, the low byte first.
  void writeFloats(const std::string& name, const std::vector<float>& values);
  /// Centimetres in 16 bits.
  void writeCentimetres(const std::string& name, const std::vector<float>& metres);
  /// As red + 256 green + 65536 blue.
  void writeNumbers(const std::string& name, const std::vector<uint32_t>& numbers);

  /// With the bytes of all files.
  WriteResult result() const;

 private:
  size_t pixels() const;
  struct NumberImage image(int channels, int bits) const;

  const PictureData& picture_;
  std::string folder_;
  int level_;
  WriteResult out_;
};

/// Members of an object: "width", "height", "camera", "sun".
void writeCamera(JsonWriter& w, const PictureData& picture);

}  // namespace gable
