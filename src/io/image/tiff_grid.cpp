// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// libtiff undoes compression, predictors and byte order; blocks are read whole, one at a time. Tags
// that it does not know, as those of GeoTIFF, it gives out as they are.
#include "io/image/tiff_grid.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <string>

#include <tiffio.h>

#include "base/number.h"
#include "base/work.h"
#include "io/image/tiff_source.h"

namespace gable {
namespace {

// Of a strip or a tile, in bytes.
constexpr uint64_t kMostBlock = uint64_t{1} << 28;
// Values of a tag that are read; GeoTIFF has some dozens.
constexpr uint32_t kMostTagValues = 10'000;

Error broken(const char* why) {
  return {"heights-broken", std::string("the TIFF file cannot be read: ") + why, {}};
}

// Of tags with a count of 32 bits, as libtiff has for those that it does not know.
template <class T>
std::vector<T> tagValues(TIFF* tiff, uint32_t tag, TIFFDataType type) {
  const TIFFField* field = TIFFFindField(tiff, tag, TIFF_ANY);
  if (!field || !TIFFFieldPassCount(field) || TIFFFieldReadCount(field) != TIFF_VARIABLE2 ||
      TIFFFieldDataType(field) != type) {
    return {};
  }
  uint32_t count = 0;
  void* data = nullptr;
  if (!TIFFGetField(tiff, tag, &count, &data) || !data || count > kMostTagValues) return {};
  const T* values = static_cast<const T*>(data);
  return {values, values + count};
}

enum class Sample : uint8_t { U8, I8, U16, I16, U32, I32, F32, F64 };

std::optional<Sample> sampleOf(uint16_t bits, uint16_t format) {
  if (format == SAMPLEFORMAT_IEEEFP) {
    return bits == 32   ? std::optional(Sample::F32)
           : bits == 64 ? std::optional(Sample::F64)
                        : std::nullopt;
  }
  const bool isSigned = format == SAMPLEFORMAT_INT;
  if (!isSigned && format != SAMPLEFORMAT_UINT) return std::nullopt;
  switch (bits) {
    case 8: return isSigned ? Sample::I8 : Sample::U8;
    case 16: return isSigned ? Sample::I16 : Sample::U16;
    case 32: return isSigned ? Sample::I32 : Sample::U32;
    default: return std::nullopt;
  }
}

template <class T>
float valueAt(const uint8_t* p) {
  T v;
  std::memcpy(&v, p, sizeof v);
  return static_cast<float>(v);
}
float valueAt(const uint8_t* p, Sample s) {
  switch (s) {
    case Sample::U8: return valueAt<uint8_t>(p);
    case Sample::I8: return valueAt<int8_t>(p);
    case Sample::U16: return valueAt<uint16_t>(p);
    case Sample::I16: return valueAt<int16_t>(p);
    case Sample::U32: return valueAt<uint32_t>(p);
    case Sample::I32: return valueAt<int32_t>(p);
    case Sample::F32: return valueAt<float>(p);
    case Sample::F64: break;
  }
  double v;
  std::memcpy(&v, p, sizeof v);
  constexpr double kMost = std::numeric_limits<float>::max();
  return v > -kMost && v < kMost ? static_cast<float>(v) : std::numeric_limits<float>::quiet_NaN();
}

struct Blocks {
  uint32_t width = 0, height = 0;
  bool tiled = false;
  uint64_t bytes = 0;
};

Result<Blocks> blocksOf(TIFF* tiff, const TiffGrid& grid, uint64_t sampleBytes) {
  Blocks b;
  b.tiled = TIFFIsTiled(tiff) != 0;
  if (b.tiled) {
    TIFFGetField(tiff, TIFFTAG_TILEWIDTH, &b.width);
    TIFFGetField(tiff, TIFFTAG_TILELENGTH, &b.height);
  } else {
    b.width = grid.width;
    TIFFGetFieldDefaulted(tiff, TIFFTAG_ROWSPERSTRIP, &b.height);
    b.height = std::min(b.height, grid.height);
  }
  if (b.width == 0 || b.height == 0) return broken("its blocks have no size");
  b.bytes = sampleBytes * b.width;
  if (b.bytes > kMostBlock || b.bytes * b.height > kMostBlock) {
    return Error{"heights-large", "the TIFF file has strips or tiles of more than 256 MB",
                 "write it again in tiles: gdal_translate -co TILED=YES"};
  }
  b.bytes *= b.height;
  return b;
}

bool readBlocks(TIFF* tiff, const Blocks& b, Sample sample, uint64_t sampleBytes, TiffGrid& out) {
  std::vector<uint8_t> block(b.bytes);
  uint32_t number = 0;
  for (uint64_t y = 0; y < out.height; y += b.height) {
    const uint64_t rows = std::min<uint64_t>(b.height, out.height - y);
    for (uint64_t x = 0; x < out.width; x += b.width, ++number) {
      const uint64_t columns = std::min<uint64_t>(b.width, out.width - x);
      const auto want = static_cast<tmsize_t>(b.tiled ? b.bytes : sampleBytes * b.width * rows);
      const tmsize_t got = b.tiled ? TIFFReadEncodedTile(tiff, number, block.data(), want)
                                   : TIFFReadEncodedStrip(tiff, number, block.data(), want);
      if (got != want) return false;
      for (uint64_t r = 0; r < rows; ++r) {
        work(columns);
        const uint8_t* from = block.data() + r * b.width * sampleBytes;
        float* to = out.values.data() + (y + r) * out.width + x;
        for (uint64_t c = 0; c < columns; ++c) to[c] = valueAt(from + c * sampleBytes, sample);
      }
    }
  }
  return true;
}

void readTags(TIFF* tiff, TiffGrid& out) {
  out.pixelScale = tagValues<double>(tiff, 33550, TIFF_DOUBLE);
  out.tiepoints = tagValues<double>(tiff, 33922, TIFF_DOUBLE);
  out.transformation = tagValues<double>(tiff, 34264, TIFF_DOUBLE);
  out.geoKeys = tagValues<uint16_t>(tiff, 34735, TIFF_SHORT);
  out.geoDoubles = tagValues<double>(tiff, 34736, TIFF_DOUBLE);
  const std::vector<char> text = tagValues<char>(tiff, 42113, TIFF_ASCII);
  std::string word(text.begin(), std::find(text.begin(), text.end(), '\0'));
  while (!word.empty() && word.back() == ' ') word.pop_back();
  double value = 0;
  if (parseNumber(word, value)) out.noData = value;
}

}  // namespace

Result<TiffGrid> readTiffGrid(std::string_view bytes, uint64_t most) {
  TiffSource source{bytes};
  const Tiff tiff = openTiff(source);
  if (!tiff) return broken(source.why);
  TiffGrid out;
  if (!TIFFGetField(tiff.get(), TIFFTAG_IMAGEWIDTH, &out.width) ||
      !TIFFGetField(tiff.get(), TIFFTAG_IMAGELENGTH, &out.height) || out.width == 0 ||
      out.height == 0) {
    return broken(source.why);
  }
  const uint64_t count = uint64_t{out.width} * out.height;
  if (count > most) {
    return Error{"heights-large",
                 "the TIFF file has " + std::to_string(count) + " heights, of which " +
                     std::to_string(most) + " can be read",
                 "cut the place out of it: gdal_translate -projwin WEST NORTH EAST SOUTH"};
  }
  uint16_t bands = 1, bits = 1, format = SAMPLEFORMAT_UINT;
  TIFFGetFieldDefaulted(tiff.get(), TIFFTAG_SAMPLESPERPIXEL, &bands);
  TIFFGetFieldDefaulted(tiff.get(), TIFFTAG_BITSPERSAMPLE, &bits);
  TIFFGetFieldDefaulted(tiff.get(), TIFFTAG_SAMPLEFORMAT, &format);
  if (bands != 1) {
    return Error{"heights-kind",
                 "the TIFF file has " + std::to_string(bands) + " bands: it is no map of heights",
                 "take the band of heights: gdal_translate -b 1"};
  }
  const std::optional<Sample> sample = sampleOf(bits, format);
  if (!sample) {
    return Error{"heights-kind",
                 "the numbers of the TIFF file, of " + std::to_string(bits) +
                     " bits each, are of a kind that is not read",
                 "write them as floating point of 32 bits: gdal_translate -ot Float32"};
  }
  const uint64_t sampleBytes = bits / 8;
  const Result<Blocks> blocks = blocksOf(tiff.get(), out, sampleBytes);
  if (!blocks.ok()) return blocks.error();
  workMemory(count * sizeof(float) + blocks.value().bytes);
  out.values.resize(count);
  if (!readBlocks(tiff.get(), blocks.value(), *sample, sampleBytes, out)) return broken(source.why);
  readTags(tiff.get(), out);
  return out;
}

}  // namespace gable
