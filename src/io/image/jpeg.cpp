// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// libjpeg's default error handler leaves the program; ours jumps back. As with PNG, what lives
// across the jump belongs to the caller. Progressive files with an absurd number of scans are
// stopped.
#include "io/image/jpeg.h"

#include <csetjmp>
#include <cstdio>
// jpeglib.h needs size_t and FILE to be declared before it.
#include <jpeglib.h>

#include <jerror.h>

namespace gable {
namespace {

constexpr int kMostScans = 500;

struct JpegReading {
  jpeg_decompress_struct jpeg{};
  jpeg_error_mgr errors{};
  jpeg_progress_mgr progress{};
  std::jmp_buf back;
  char why[JMSG_LENGTH_MAX] = "";
  std::string_view bytes;
  uint64_t maxPixels = 0;
  bool tooLarge = false;
  ImageHeader header;
  Image image;
  std::vector<uint8_t> row;
};

[[noreturn]] void onError(j_common_ptr common) {
  auto* r = static_cast<JpegReading*>(common->client_data);
  common->err->format_message(common, r->why);
  std::longjmp(r->back, 1);
}

// Data that ends in the middle is an error: half a picture is worse than a message. Other warnings
// are about bytes that every reader passes over.
void onMessage(j_common_ptr common, int level) {
  const int code = common->err->msg_code;
  if (level < 0 && (code == JWRN_JPEG_EOF || code == JWRN_HIT_MARKER)) onError(common);
}

void onProgress(j_common_ptr common) {
  auto* r = static_cast<JpegReading*>(common->client_data);
  if (r->jpeg.input_scan_number <= kMostScans) return;
  std::snprintf(r->why, sizeof r->why, "too many scans");
  std::longjmp(r->back, 1);
}

void readHeader(JpegReading& r) {
  jpeg_mem_src(&r.jpeg, reinterpret_cast<const unsigned char*>(r.bytes.data()), r.bytes.size());
  jpeg_read_header(&r.jpeg, TRUE);
  r.header = {ImageFormat::Jpeg, r.jpeg.image_width, r.jpeg.image_height, false};
}

void readPixels(JpegReading& r) {
  if (static_cast<uint64_t>(r.header.width) * r.header.height > r.maxPixels) {
    r.tooLarge = true;
    return;
  }
  const bool cmyk = r.jpeg.jpeg_color_space == JCS_CMYK || r.jpeg.jpeg_color_space == JCS_YCCK;
  r.jpeg.out_color_space = cmyk ? JCS_CMYK : JCS_RGB;
  // The reference inverse transform, which is the same on every machine.
  r.jpeg.dct_method = JDCT_ISLOW;
  jpeg_start_decompress(&r.jpeg);
  r.image.width = r.header.width;
  r.image.height = r.header.height;
  r.image.rgba.resize(static_cast<size_t>(r.header.width) * r.header.height * 4);
  r.row.resize(static_cast<size_t>(r.jpeg.output_width) *
               static_cast<size_t>(r.jpeg.output_components));
  uint8_t* out = r.image.rgba.data();
  while (r.jpeg.output_scanline < r.jpeg.output_height) {
    uint8_t* row = r.row.data();
    jpeg_read_scanlines(&r.jpeg, &row, 1);
    for (uint32_t x = 0; x < r.header.width; ++x, out += 4) {
      // CMYK files store inverted inks, so that ink times black is the light.
      for (int c = 0; c < 3; ++c) {
        out[c] = cmyk ? static_cast<uint8_t>(row[c] * row[3] / 255) : row[c];
      }
      out[3] = 255;
      row += r.jpeg.output_components;
    }
  }
}

bool guarded(JpegReading& r, void (*step)(JpegReading&)) {
  if (setjmp(r.back)) return false;
  step(r);
  return true;
}

void create(JpegReading& r) {
  jpeg_create_decompress(&r.jpeg);
  r.jpeg.progress = &r.progress;
  r.progress.progress_monitor = onProgress;
}

bool read(JpegReading& r, bool pixels) {
  r.jpeg.err = jpeg_std_error(&r.errors);
  r.errors.error_exit = onError;
  r.errors.emit_message = onMessage;
  r.jpeg.client_data = &r;
  const bool ok =
      guarded(r, create) && guarded(r, readHeader) && (!pixels || guarded(r, readPixels));
  jpeg_destroy_decompress(&r.jpeg);
  return ok;
}

Error broken(const char* why) {
  return {"image-broken", std::string("the JPEG picture cannot be read: ") + why, {}};
}

}  // namespace

Result<ImageHeader> readJpegHeader(std::string_view bytes) {
  JpegReading r;
  r.bytes = bytes;
  if (!read(r, false)) return broken(r.why);
  return r.header;
}

Result<Image> decodeJpeg(std::string_view bytes, uint64_t maxPixels) {
  JpegReading r;
  r.bytes = bytes;
  r.maxPixels = maxPixels;
  if (!read(r, true)) return broken(r.why);
  if (r.tooLarge) return Error{"image-too-large", "the JPEG picture has too many pixels", {}};
  return std::move(r.image);
}

}  // namespace gable
