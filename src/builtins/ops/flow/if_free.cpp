// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The runtime decides who has room (runtime/room.h). In the pass that finds out who asks, shapes go
// both ways.

#include "builtins/lists.h"
#include "builtins/shared/text_forms.h"
#include "shape/op_call.h"

namespace gable {

namespace {

enum class Space : uint8_t { Plan, Volume };

}  // namespace

template <>
struct WordsOf<Space> {
  static constexpr const char* text = "plan volume";
};

namespace {

struct IfFree {
  Text group;
  double clearance, rank;
  Space space;
};

Status applyIfFree(OpCall& call, const IfFree& args) {
  constexpr uint32_t kNoSlot = 0xffffffff;
  const ValuePool& pool = call.services().pool();
  RoomRequest request{args.group.id, args.clearance, args.rank, args.space == Space::Volume,
                      call.selectors().empty() ? 0 : kNoSlot};
  for (const SelectorItem& item : call.selectors()) {
    if (item.terms.empty()) request.slot = item.slot;
  }
  const Room room = call.services().room(request, call.shape());
  if (room != Room::Taken && request.slot != kNoSlot) call.emit(call.shape(), request.slot, 0);
  if (room == Room::Free) return {};
  for (const SelectorItem& item : call.selectors()) {
    if (!item.terms.empty() && selectsWord(item, "otherwise", pool)) {
      call.emit(call.shape(), item.slot, 0);
    }
  }
  return {};
}

constexpr ParamSpec kParams[] = {
    param<&IfFree::group>("group",
                          "Those who ask with the same name share the ground. Shapes labelled so "
                          "stand on it from the start.")
        .of(kNotEmptyText),
    param<&IfFree::clearance>("clearance",
                              "Metres to the others of the group, at least. Of two the larger "
                              "clearance counts. 0: they may touch.",
                              "0")
        .atLeast(0),
    param<&IfFree::rank>("rank",
                         "The lower it is, the earlier the shape gets its room. Among equals the "
                         "earlier in the derivation comes first.",
                         "0"),
    param<&IfFree::space>("space",
                          "plan compares what lies on the ground, whatever the height; volume "
                          "lets things stand above each other.",
                          "plan"),
};
constexpr Signature kSignatures[] = {{kParams}};
constexpr PartSpec kParts[] = {{"otherwise", "Gets the shape where there is no room for it."}};

constexpr OpSpec kSpecs[] = {
    {"ifFree", "flow", "Goes on where there is room for the shape among others.", kSignatures,
     typed<applyIfFree>, BlockKind::Operations, kAsksForRoom, kParts, false, true},
};

}  // namespace

extern const OpList kOps_if_free;
const OpList kOps_if_free = kSpecs;

}  // namespace gable
