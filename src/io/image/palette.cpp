// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// A cut of the colours by variance, after Wan, Wong and Prusinkiewicz, "An algorithm for
// multidimensional data clustering" (1988): alpha counts as a fourth colour, so that what is clear
// and what is not are never mixed while colours are left.
#include "io/image/palette.h"

#include <algorithm>
#include <span>
#include <unordered_map>

#include "base/work.h"

namespace gable {
namespace {

using Color = std::array<uint8_t, 4>;

uint32_t keyOf(const uint8_t* p, bool opaque) {
  const uint32_t alpha = opaque ? 255 : p[3];
  return alpha << 24 | uint32_t{p[0]} << 16 | uint32_t{p[1]} << 8 | p[2];
}

Color colorOf(uint32_t key) {
  const auto byte = [key](int shift) { return static_cast<uint8_t>(key >> shift & 255); };
  return {byte(16), byte(8), byte(0), byte(24)};
}

struct Tone {
  uint32_t key = 0;
  Color color{};
  uint64_t pixels = 0;
};

/// Tones that become one.
struct Group {
  std::span<Tone> tones;
  uint64_t pixels = 0;
  std::array<uint64_t, 4> sums{};
  /// The channel in which they differ most, and by how much: squares over all pixels.
  size_t widest = 0;
  double spread = 0;

  explicit Group(std::span<Tone> of) : tones(of) {
    std::array<uint64_t, 4> squares{};
    for (const Tone& t : tones) {
      pixels += t.pixels;
      for (size_t c = 0; c < 4; ++c) {
        const uint64_t v = t.color[c];
        sums[c] += t.pixels * v;
        squares[c] += t.pixels * v * v;
      }
    }
    for (size_t c = 0; c < 4 && tones.size() > 1; ++c) {
      const auto sum = static_cast<double>(sums[c]);
      const double own = static_cast<double>(squares[c]) - sum * sum / static_cast<double>(pixels);
      if (own <= spread) continue;
      spread = own;
      widest = c;
    }
  }

  Color mean() const {
    Color out{};
    for (size_t c = 0; c < 4; ++c) {
      out[c] = static_cast<uint8_t>((sums[c] + pixels / 2) / pixels);
    }
    return out;
  }

  /// Where the tones above the mean begin, after they have been moved to the end.
  size_t cut() {
    const auto middle = std::stable_partition(tones.begin(), tones.end(), [&](const Tone& t) {
      return t.color[widest] * pixels <= sums[widest];
    });
    return static_cast<size_t>(middle - tones.begin());
  }
};

std::vector<Tone> tonesOf(const Image& image) {
  std::vector<uint32_t> keys;
  reserveWork(keys, static_cast<double>(image.rgba.size() / 4));
  for (size_t i = 0; i < image.rgba.size(); i += 4) keys.push_back(keyOf(&image.rgba[i], false));
  std::sort(keys.begin(), keys.end());
  std::vector<Tone> tones;
  for (const uint32_t k : keys) {
    if (tones.empty() || tones.back().key != k) tones.push_back({k, colorOf(k), 0});
    ++tones.back().pixels;
  }
  return tones;
}

std::vector<Group> groupsOf(std::vector<Tone>& tones, size_t most) {
  std::vector<Group> groups{Group(tones)};
  while (groups.size() < most) {
    work(kWorkBetweenLooks);
    const auto next =
        std::max_element(groups.begin(), groups.end(),
                         [](const Group& a, const Group& b) { return a.spread < b.spread; });
    if (next->spread <= 0) break;
    const std::span<Tone> all = next->tones;
    const size_t cut = next->cut();
    *next = Group(all.first(cut));
    groups.emplace_back(all.subspan(cut));
  }
  return groups;
}

}  // namespace

std::optional<Palette> paletteOf(const Image& image, int channels) {
  const bool opaque = channels == 3;
  std::unordered_map<uint32_t, uint8_t> numbers;
  std::vector<uint32_t> keys;
  for (size_t i = 0; i < image.rgba.size(); i += 4) {
    const uint32_t key = keyOf(&image.rgba[i], opaque);
    if ((!keys.empty() && keys.back() == key) || !numbers.try_emplace(key, 0).second) continue;
    if (keys.size() == kMostPaletteColors) return {};
    keys.push_back(key);
  }
  std::sort(keys.begin(), keys.end());
  Palette out;
  for (const uint32_t key : keys) {
    numbers[key] = static_cast<uint8_t>(out.colors.size());
    out.colors.push_back(colorOf(key));
  }
  reserveWork(out.numbers, static_cast<double>(image.rgba.size() / 4));
  for (size_t i = 0; i < image.rgba.size(); i += 4) {
    out.numbers.push_back(numbers.find(keyOf(&image.rgba[i], opaque))->second);
  }
  return out;
}

void reduceColors(Image& image, size_t most) {
  std::vector<Tone> tones = tonesOf(image);
  if (tones.size() <= most) return;
  std::unordered_map<uint32_t, Color> becomes;
  for (const Group& g : groupsOf(tones, std::max<size_t>(most, 1))) {
    const Color mean = g.mean();
    for (const Tone& t : g.tones) becomes[t.key] = mean;
  }
  for (size_t i = 0; i < image.rgba.size(); i += 4) {
    const Color& c = becomes.find(keyOf(&image.rgba[i], false))->second;
    std::copy(c.begin(), c.end(), image.rgba.begin() + static_cast<std::ptrdiff_t>(i));
  }
}

}  // namespace gable
