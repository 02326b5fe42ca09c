// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "io/image/tiff_source.h"

#include <algorithm>
#include <cstdarg>
#include <cstdio>
#include <cstring>

#include <tiffio.h>

namespace gable {
namespace {

int onError(TIFF*, void* user, const char*, const char* format, va_list arguments) {
  auto* source = static_cast<TiffSource*>(user);
  std::vsnprintf(source->why, sizeof source->why, format, arguments);
  // With numbers of rows that say nothing, such as 4294967295.
  if (std::strncmp(source->why, "Read error", 10) == 0) {
    std::snprintf(source->why, sizeof source->why, "its data end too early");
  }
  return 1;
}
int onWarning(TIFF*, void*, const char*, const char*, va_list) { return 1; }

tmsize_t readBytes(thandle_t handle, void* to, tmsize_t size) {
  auto* s = static_cast<TiffSource*>(handle);
  const size_t n = std::min(static_cast<size_t>(std::max<tmsize_t>(size, 0)),
                            s->bytes.size() - std::min(s->at, s->bytes.size()));
  if (n > 0) std::memcpy(to, s->bytes.data() + s->at, n);
  s->at += n;
  return static_cast<tmsize_t>(n);
}
tmsize_t writeBytes(thandle_t, void*, tmsize_t) { return 0; }
toff_t seekTo(thandle_t handle, toff_t offset, int from) {
  auto* s = static_cast<TiffSource*>(handle);
  const toff_t base = from == SEEK_CUR ? s->at : from == SEEK_END ? s->bytes.size() : 0;
  s->at = static_cast<size_t>(base + offset);
  return s->at;
}
int closeSource(thandle_t) { return 0; }
toff_t sizeOf(thandle_t handle) { return static_cast<TiffSource*>(handle)->bytes.size(); }
int mapFile(thandle_t, void**, toff_t*) { return 0; }
void unmapFile(thandle_t, void*, toff_t) {}

}  // namespace

Tiff openTiff(TiffSource& source) {
  TIFFOpenOptions* options = TIFFOpenOptionsAlloc();
  if (!options) return {nullptr, TIFFClose};
  TIFFOpenOptionsSetMaxSingleMemAlloc(options, kMostTiffMemory);
  TIFFOpenOptionsSetErrorHandlerExtR(options, onError, &source);
  TIFFOpenOptionsSetWarningHandlerExtR(options, onWarning, nullptr);
  // Read only, without mapping, and only the first directory.
  Tiff tiff(TIFFClientOpenExt("picture", "rm", &source, readBytes, writeBytes, seekTo, closeSource,
                              sizeOf, mapFile, unmapFile, options),
            TIFFClose);
  TIFFOpenOptionsFree(options);
  return tiff;
}

}  // namespace gable
