// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Rules are compiled to direct writes; this runs where the name is known only when it is too late
// for that, and tells the reference what set is.

#include <string>

#include "builtins/catalogue.h"
#include "builtins/lists.h"
#include "program/tag_effects.h"
#include "shape/op_call.h"

namespace gable {

namespace {

struct Set {
  Word attribute;
  Value value;
};

Status applySet(OpCall& call, const Set& args) {
  const std::string name(args.attribute.text);
  const AttributeSpec* attribute = builtinCatalogue().attribute(name);
  if (!attribute) {
    return call.fail("unknown-attribute", "there is no shape attribute '" + name + "'",
                     "declare it with attr, or see the list of shape attributes");
  }
  if (!attribute->set) {
    return call.fail("read-only-attribute", "'" + name + "' can only be read",
                     "set the attributes of scope, pivot, material and trim instead");
  }
  if (args.value.type != attribute->type) {
    return call.fail("type-mismatch",
                     "'" + name + "' takes a " + typeName(attribute->type) + ", not a " +
                         typeName(args.value.type),
                     "convert the value with float(), str() or bool()");
  }
  return attribute->set(call, args.value);
}

constexpr ParamSpec kParams[] = {
    param<&Set::attribute>("attribute", "A shape attribute that can be written, or an attr."),
    param<&Set::value>("value", "The new value, of the attribute's type."),
};
constexpr Signature kSignatures[] = {{kParams}};

constexpr OpSpec kSpecs[] = {
    {"set", "material", "Gives an attribute of the shape a new value, for it and all that follows.",
     kSignatures, typed<applySet>, BlockKind::None,
     kReadsWorld | kReadsInitialShape | kReadsPivot | kIgnoresTags},
};

}  // namespace

extern const OpList kOps_set;
const OpList kOps_set = kSpecs;

}  // namespace gable
