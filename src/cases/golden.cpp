// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Pictures are compared pixel by pixel with some tolerance, since libraries of other versions may
// round another way. The picture that differs is left beside the expected one, to look at.

#include "cases/golden.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>

#include "base/files.h"
#include "base/temporary_folder.h"
#include "gable/names.h"
#include "io/image/image.h"

namespace gable::cases {
namespace {

namespace fs = std::filesystem;

/// A pixel differs when a channel does by more than this.
constexpr int kChannel = 4;
/// The share of pixels that may differ.
constexpr double kShare = 0.001;
constexpr int kSamples = 16;

bool sizeNamed(const std::string& word, PictureSettings& settings) {
  int used = 0;
  if (std::sscanf(word.c_str(), "%dx%d%n", &settings.width, &settings.height, &used) != 2) {
    return false;
  }
  return static_cast<size_t>(used) == word.size() && settings.width > 0 && settings.height > 0 &&
         settings.width <= 4096 && settings.height <= 4096;
}

bool readSettings(const Statement& s, PictureSettings& settings) {
  settings.width = 480;
  settings.height = 270;
  settings.samples = kSamples;
  settings.jobs = 1;
  if (s.words.size() < 2 || s.words.size() > 4) return false;
  return std::all_of(s.words.begin() + 2, s.words.end(), [&](const std::string& word) {
    const std::optional<View> view = viewNamed(word);
    if (view) settings.view = *view;
    return view || sizeNamed(word, settings);
  });
}

double differingShare(const Image& a, const Image& b) {
  size_t differ = 0;
  const size_t pixels = a.rgba.size() / 4;
  for (size_t p = 0; p < pixels; ++p) {
    int most = 0;
    for (size_t c = 0; c < 4; ++c) {
      most = std::max(most, std::abs(int{a.rgba[4 * p + c]} - int{b.rgba[4 * p + c]}));
    }
    differ += most > kChannel ? 1 : 0;
  }
  return pixels == 0 ? 0 : static_cast<double>(differ) / static_cast<double>(pixels);
}

/// "12.3 %" of two decoded pictures, or why they cannot be compared; empty where they agree.
std::string difference(const std::string& expected, const std::string& found) {
  const Result<Image> a = decodeImage(expected), b = decodeImage(found);
  if (!a.ok()) return a.error().message;
  if (!b.ok()) return b.error().message;
  if (a.value().width != b.value().width || a.value().height != b.value().height) {
    return "the expected picture has " + std::to_string(a.value().width) + "x" +
           std::to_string(a.value().height) + " pixels";
  }
  const double share = differingShare(a.value(), b.value());
  if (share <= kShare) return {};
  char text[64];
  std::snprintf(text, sizeof text, "%.1f %% of the pixels differ", share * 100);
  return text;
}

/// The line where two texts part, from 1, with both.
std::string firstDifference(const std::string& expected, const std::string& found) {
  const auto a = linesOf(expected), b = linesOf(found);
  size_t line = 0;
  while (line < a.size() && line < b.size() && a[line] == b[line]) ++line;
  const auto text = [line](const std::vector<std::string_view>& lines) {
    return line < lines.size() ? "'" + std::string(lines[line]) + "'" : std::string("the end");
  };
  return "line " + std::to_string(line + 1) + " is " + text(b) + ", expected " + text(a);
}

}  // namespace

std::string GoldenFiles::write(const std::string& path, const std::string& bytes) {
  const Result<uint64_t> done = writeFile(path, bytes);
  if (!done.ok()) return done.error().message;
  written_.push_back(path);
  return {};
}

std::string GoldenFiles::checkScene(const Statement& s, const std::string& dump) {
  if (s.words.size() != 2) return "expected: scene FILE";
  const std::string path = (fs::path(folder_) / s.words[1]).string();
  const Result<std::string> expected = readFile(path);
  if (expected.ok() && expected.value() == dump) return {};
  if (update_) return write(path, dump);
  if (!expected.ok()) return expected.error().message + "; 'gable test --update' writes it";
  return firstDifference(expected.value(), dump);
}

std::string GoldenFiles::checkPicture(const Statement& s, const Model& model) {
  PictureSettings settings;
  if (!readSettings(s, settings)) return "expected: picture FILE [iso|top|front|street] [480x270]";
  settings.limits = limits_;
  const TemporaryFolder folder;
  const std::string drawn = folder.path() + "/picture.png";
  const WriteResult done = model.picture(drawn, settings);
  if (!done.ok) return done.diagnostics.empty() ? "no picture" : done.diagnostics.front().message;
  const Result<std::string> found = readFile(drawn);
  if (!found.ok()) return found.error().message;

  const fs::path path = fs::path(folder_) / s.words[1];
  const Result<std::string> expected = readFile(path.string());
  const std::string differs =
      expected.ok() ? difference(expected.value(), found.value()) : expected.error().message;
  fs::path beside = path;
  beside.replace_extension(".found.png");
  std::error_code ignored;
  if (differs.empty() || update_) fs::remove(beside, ignored);
  if (differs.empty()) return {};
  if (update_) return write(path.string(), found.value());
  if (!expected.ok()) return differs + "; 'gable test --update' writes it";
  const Result<uint64_t> left = writeFile(beside.string(), found.value());
  return differs + (left.ok() ? ", see " + beside.string() : "");
}

}  // namespace gable::cases
