// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "base/json_copy.h"

namespace gable {

// The parser bounds the depth.
void copy(JsonWriter& to, const JsonValue& value) {
  switch (value.kind()) {
    case JsonValue::Kind::Null: to.null(); return;
    case JsonValue::Kind::Bool: to.value(value.boolean(false)); return;
    case JsonValue::Kind::Number: to.value(value.number(0)); return;
    case JsonValue::Kind::Text: to.value(value.text()); return;
    case JsonValue::Kind::Array:
      to.beginArray();
      for (const JsonValue& each : value.items()) copy(to, each);
      to.endArray();
      return;
    case JsonValue::Kind::Object:
      to.beginObject();
      for (const auto& [name, member] : value.members()) copy(to.key(name), member);
      to.endObject();
      return;
  }
}

}  // namespace gable
