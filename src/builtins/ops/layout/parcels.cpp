// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "geom/plan/parcels.h"

#include <cmath>

#include "builtins/lists.h"
#include "builtins/ops/layout/shared/ground.h"
#include "shape/op_call.h"

namespace gable {

namespace {

// The longest edge along a street; of none the longest.
uint32_t frontOf(const Parcel& p) {
  const Ring& r = p.polygon.outer;
  uint32_t best = 0;
  double longest = -1;
  for (uint32_t i = 0; i < r.size(); ++i) {
    double l = length(r[(i + 1) % r.size()] - r[i]);
    if (p.street[i] != Parcel::kNoStreet) l += 1e9;
    if (l > longest) {
      longest = l;
      best = i;
    }
  }
  return best;
}

enum class Method : uint8_t { Box, Skeleton };

}  // namespace

template <>
struct WordsOf<Method> {
  static constexpr const char* text = "box skeleton";
};

namespace {

constexpr double kMostParcels = 100000;

struct Parcels {
  Method method;
  double area;
  std::optional<double> minWidth, minArea;
  double irregularity;
};

ParcelOptions optionsOf(const Parcels& args) {
  ParcelOptions o;
  o.targetArea = args.area;
  o.minWidth = args.minWidth.value_or(std::sqrt(o.targetArea) / 3);
  o.minArea = args.minArea.value_or(o.targetArea / 3);
  o.minFrontage = o.minWidth / 2;
  o.irregularity = args.irregularity;
  return o;
}

// The first item that takes the parcel; corner takes those at a corner of two streets.
const SelectorItem* itemForParcel(const OpCall& call, bool corner) {
  for (const SelectorItem& item : call.selectors()) {
    if (item.terms.size() != 1 || item.terms[0].kind != SelectorTerm::Kind::Word) continue;
    const std::string_view word = call.services().pool().text(item.terms[0].word);
    if (word == "all" || word == "lot" || (word == "corner" && corner)) return &item;
  }
  return nullptr;
}

Status applyParcels(OpCall& call, const Parcels& args) {
  ParcelOptions options = optionsOf(args);
  std::vector<Ground> grounds;
  if (Status bad = groundsOf(call, grounds); !bad) return bad;
  const double lot = std::max(options.targetArea, options.minArea);
  double lots = 0;
  for (const Ground& g : grounds) lots += area(g.polygon) / lot;
  if (lots > kMostParcels) {
    return call.fail("parcels-too-many", "parcels would make more than 100000 lots",
                     "write a larger area, or divide a smaller block");
  }
  const bool bySkeleton = args.method == Method::Skeleton;
  uint32_t number = 0;
  for (size_t g = 0; g < grounds.size(); ++g) {
    options.address = call.randomAddress(g);
    const auto divide = bySkeleton ? parcelsBySkeleton : parcelsByBox;
    for (const Parcel& p : divide(grounds[g].polygon, grounds[g].street, options)) {
      const uint32_t piece = number++;
      const SelectorItem* item = itemForParcel(call, p.corner);
      if (!item) continue;
      std::vector<bool> street;
      for (uint32_t e : p.street) street.push_back(e != Parcel::kNoStreet);
      call.emit(groundPart(call, grounds[g], p.polygon, frontOf(p), street), item->slot, piece);
    }
  }
  return {};
}

constexpr ParamSpec kParams[] = {
    param<&Parcels::method>(
        "method",
        "box cuts halves off halves, across the longer side; skeleton lays lots in rows along the "
        "streets."),
    param<&Parcels::area>("area", "About how large a lot is to be, in square metres.").above(0),
    param<&Parcels::minWidth>(
        "minWidth", "No lot is narrower; a third of the side of a square lot.", "sqrt(area) / 3")
        .atLeast(0),
    param<&Parcels::minArea>("minArea", "No lot is smaller.", "area / 3").atLeast(0),
    param<&Parcels::irregularity>(
        "irregularity", "How far a border may lie from its regular place, 0 to 0.4 of the length.",
        "0.1")
        .atLeast(0),
};
constexpr Signature kSignatures[] = {{kParams}};

constexpr PartSpec kParts[] = {{"lot", "A lot with one street, or none."},
                               {"corner", "A lot at a corner: streets on two sides or more."}};
constexpr OpSpec kSpecs[] = {
    {"parcels", "layout", "Divides a block into lots, each with a side on a street.", kSignatures,
     typed<applyParcels>, BlockKind::Selectors, kRandom, kParts, false, true},
};

}  // namespace

extern const OpList kOps_parcels;
const OpList kOps_parcels = kSpecs;

}  // namespace gable
