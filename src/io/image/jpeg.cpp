// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// libjpeg's default error handler leaves the program; ours jumps back. As with PNG, what lives
// across the jump belongs to the caller. Progressive files with an absurd number of scans are
// stopped.
#include "io/image/jpeg.h"

#include <algorithm>
#include <csetjmp>
#include <cstdio>
#include <cstdlib>
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

struct JpegWriting {
  jpeg_compress_struct jpeg{};
  jpeg_error_mgr errors{};
  std::jmp_buf back;
  char why[JMSG_LENGTH_MAX] = "";
  const Image* image = nullptr;
  int quality = 80;
  bool thinColor = false;
  unsigned char* bytes = nullptr;
  unsigned long size = 0;
  std::vector<uint8_t> row;
};

[[noreturn]] void onWriteError(j_common_ptr common) {
  auto* w = static_cast<JpegWriting*>(common->client_data);
  common->err->format_message(common, w->why);
  std::longjmp(w->back, 1);
}

bool write(JpegWriting& w) {
  if (setjmp(w.back)) return false;
  jpeg_create_compress(&w.jpeg);
  jpeg_mem_dest(&w.jpeg, &w.bytes, &w.size);
  w.jpeg.image_width = w.image->width;
  w.jpeg.image_height = w.image->height;
  w.jpeg.input_components = 3;
  w.jpeg.in_color_space = JCS_RGB;
  jpeg_set_defaults(&w.jpeg);
  jpeg_set_quality(&w.jpeg, w.quality, TRUE);
  // The reference transform, which is the same on every machine.
  w.jpeg.dct_method = JDCT_ISLOW;
  w.jpeg.optimize_coding = TRUE;
  // The same pixels in fewer bytes.
  jpeg_simple_progression(&w.jpeg);
  if (!w.thinColor) {
    for (int c = 0; c < 3; ++c) {
      w.jpeg.comp_info[c].h_samp_factor = w.jpeg.comp_info[c].v_samp_factor = 1;
    }
  }
  jpeg_start_compress(&w.jpeg, TRUE);
  for (uint32_t y = 0; y < w.image->height; ++y) {
    for (uint32_t x = 0; x < w.image->width; ++x) {
      std::copy_n(w.image->at(x, y), 3, w.row.data() + 3 * size_t{x});
    }
    uint8_t* row = w.row.data();
    jpeg_write_scanlines(&w.jpeg, &row, 1);
  }
  jpeg_finish_compress(&w.jpeg);
  return true;
}

}  // namespace

Result<std::string> encodeJpeg(const Image& image, int quality, bool thinColor) {
  constexpr uint32_t kLongestSide = 65500;
  if (image.width == 0 || image.height == 0 || image.width > kLongestSide ||
      image.height > kLongestSide) {
    return Error{"image-too-large", "a JPEG picture has 1 to 65500 pixels each way", {}};
  }
  JpegWriting w;
  w.image = &image;
  w.quality = quality;
  w.thinColor = thinColor;
  w.row.resize(3 * size_t{image.width});
  w.jpeg.err = jpeg_std_error(&w.errors);
  w.errors.error_exit = onWriteError;
  w.jpeg.client_data = &w;
  const bool ok = write(w);
  std::string out;
  if (ok) out.assign(reinterpret_cast<const char*>(w.bytes), w.size);
  jpeg_destroy_compress(&w.jpeg);
  std::free(w.bytes);
  if (!ok)
    return Error{"image-broken", std::string("the JPEG picture cannot be made: ") + w.why, {}};
  return out;
}

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
