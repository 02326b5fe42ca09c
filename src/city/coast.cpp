// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Lines that share an end are one chain. What of a chain lies in the area comes in and goes out at
// places of the border; with the water on the right, the border goes on clockwise from where a part
// goes out to where the next one comes in.
#include "city/coast.h"

#include <algorithm>
#include <map>
#include <utility>

#include "base/work.h"

namespace gable {
namespace {

using Chain = std::vector<Vec2>;

std::vector<Chain> chainsOf(const std::vector<Chain>& lines) {
  std::map<std::pair<double, double>, size_t> byBegin;
  std::vector<bool> follows(lines.size(), false), used(lines.size(), false);
  const auto key = [](Vec2 p) { return std::pair(p.x, p.y); };
  for (size_t i = 0; i < lines.size(); ++i) byBegin.emplace(key(lines[i].front()), i);
  for (const Chain& line : lines) {
    const auto next = byBegin.find(key(line.back()));
    if (next != byBegin.end()) follows[next->second] = true;
  }
  std::vector<Chain> out;
  for (const bool circles : {false, true}) {
    for (size_t first = 0; first < lines.size(); ++first) {
      if (used[first] || (follows[first] && !circles)) continue;
      Chain chain{lines[first].front()};
      for (size_t i = first; !used[i];) {
        work(lines[i].size());
        used[i] = true;
        chain.insert(chain.end(), lines[i].begin() + 1, lines[i].end());
        const auto next = byBegin.find(key(chain.back()));
        if (next == byBegin.end()) break;
        i = next->second;
      }
      out.push_back(std::move(chain));
    }
  }
  return out;
}

// The nearest place of the border.
Vec2 toBorder(Vec2 p, const Box2& b) {
  const double west = p.x - b.min.x, east = b.max.x - p.x, south = p.y - b.min.y,
               north = b.max.y - p.y;
  const double least = std::min({west, east, south, north});
  if (least == west) return {b.min.x, p.y};
  if (least == east) return {b.max.x, p.y};
  return {p.x, least == south ? b.min.y : b.max.y};
}

// Clockwise from the north-west corner: 0 to 4.
double placeOnBorder(Vec2 p, const Box2& b) {
  const Vec2 size = b.size();
  const double x = (p.x - b.min.x) / size.x, y = (p.y - b.min.y) / size.y;
  const double west = x, east = 1 - x, south = y, north = 1 - y;
  const double least = std::min({west, east, south, north});
  if (least == north) return x;
  if (least == east) return 1 + (1 - y);
  if (least == south) return 2 + (1 - x);
  return 3 + y;
}

Vec2 cornerOf(int number, const Box2& b) {
  switch (number % 4) {
    case 0: return {b.min.x, b.max.y};
    case 1: return b.max;
    case 2: return {b.max.x, b.min.y};
    default: return b.min;
  }
}

// The share of a segment within the box; false where there is none.
bool clip(Vec2 a, Vec2 b, const Box2& box, double& from, double& to) {
  from = 0;
  to = 1;
  const Vec2 d = b - a;
  const auto side = [&](double direction, double room) {
    if (direction == 0) return room >= 0;
    const double t = room / direction;
    if (direction < 0) {
      from = std::max(from, t);
    } else {
      to = std::min(to, t);
    }
    return from <= to;
  };
  return side(-d.x, a.x - box.min.x) && side(d.x, box.max.x - a.x) && side(-d.y, a.y - box.min.y) &&
         side(d.y, box.max.y - a.y);
}

// The parts of an open chain within the area, from border to border.
void partsOf(Chain chain, const Box2& area, std::vector<Chain>& out) {
  if (area.contains(chain.front())) chain.insert(chain.begin(), toBorder(chain.front(), area));
  if (area.contains(chain.back())) chain.push_back(toBorder(chain.back(), area));
  Chain part;
  const auto finish = [&] {
    if (part.size() > 1) out.push_back(part);
    part.clear();
  };
  for (size_t i = 1; i < chain.size(); ++i) {
    work();
    const Vec2 a = chain[i - 1], b = chain[i];
    double from = 0, to = 1;
    if (!clip(a, b, area, from, to)) {
      finish();
      continue;
    }
    if (from > 0) finish();
    if (part.empty()) part.push_back(a + (b - a) * from);
    part.push_back(to < 1 ? a + (b - a) * to : b);
    if (to < 1) finish();
  }
  finish();
}

// Closes parts along the border.
void closeParts(const std::vector<Chain>& parts, const Box2& area, std::vector<Ring>& out) {
  std::vector<std::pair<double, size_t>> entries;
  for (size_t i = 0; i < parts.size(); ++i) {
    entries.emplace_back(placeOnBorder(parts[i].front(), area), i);
  }
  std::sort(entries.begin(), entries.end());
  std::vector<bool> used(parts.size(), false);
  for (size_t first = 0; first < parts.size(); ++first) {
    Ring ring;
    for (size_t i = first; !used[i];) {
      work(parts[i].size());
      used[i] = true;
      ring.insert(ring.end(), parts[i].begin(), parts[i].end());
      const double exit = placeOnBorder(parts[i].back(), area);
      auto next = std::lower_bound(entries.begin(), entries.end(), std::pair(exit, size_t{0}));
      double entry = 4;
      if (next == entries.end()) {
        next = entries.begin();
        entry = 4 + next->first;
      } else {
        entry = next->first;
      }
      for (int corner = static_cast<int>(exit) + 1; corner < entry; ++corner) {
        ring.push_back(cornerOf(corner, area));
      }
      i = next->second;
    }
    if (ring.size() > 2) out.push_back(std::move(ring));
  }
}

}  // namespace

std::vector<Ring> seaOf(const std::vector<Chain>& coastlines, const Box2& area) {
  std::vector<Ring> islands, out;
  std::vector<Chain> parts;
  for (Chain& chain : chainsOf(coastlines)) {
    const bool closed = chain.size() > 3 && chain.front() == chain.back();
    if (!closed) {
      partsOf(std::move(chain), area, parts);
      continue;
    }
    const bool inside =
        std::all_of(chain.begin(), chain.end(), [&](Vec2 p) { return area.contains(p); });
    if (!inside) {
      // It begins outside, so that its parts run from border to border.
      const auto outside =
          std::find_if(chain.begin(), chain.end(), [&](Vec2 p) { return !area.contains(p); });
      chain.pop_back();
      std::rotate(chain.begin(), outside, chain.end());
      chain.push_back(chain.front());
      partsOf(std::move(chain), area, parts);
      continue;
    }
    chain.pop_back();
    if (signedArea(chain) > 0) {
      islands.push_back(std::move(chain));
    } else {
      out.push_back(std::move(chain));
    }
  }
  closeParts(parts, area, out);
  // Land with water around it, and no other coast in sight.
  if (out.empty() && !islands.empty()) {
    out.push_back({area.min, {area.max.x, area.min.y}, area.max, {area.min.x, area.max.y}});
  }
  out.insert(out.end(), islands.begin(), islands.end());
  return out;
}

}  // namespace gable
