// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What stands behind the handles of the C interface, and the wall that every call goes through.
//
// A handle points to a struct that begins with a mark of its kind, so that an object of another
// kind is told apart and refused. Releasing wipes the mark.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstring>
#include <exception>
#include <new>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "gable/c.h"
#include "gable/gable.h"

namespace gable::c {

enum Mark : uint64_t {
  kRulesMark = 0x67626c2d72756c65,
  kShapesMark = 0x67626c2d73686170,
  kModelMark = 0x67626c2d6d6f646c,
  kGeometryMark = 0x67626c2d67656f6d,
  kBlobMark = 0x67626c2d626c6f62,
  kCancelMark = 0x67626c2d73746f70,
};

/// What a handle points to; the C names are declared, never defined.
template <class T, Mark kKind>
struct Object {
  using Value = T;
  static constexpr uint64_t kMark = kKind;
  uint64_t mark = kMark;
  Value value;
};

struct RulesValue {
  Rules rules;
  /// Read once, since callers go through them by index.
  std::vector<AttributeInfo> attributes;
};
struct ModelValue {
  Model model;
  Statistics statistics;
};

using RulesObject = Object<RulesValue, kRulesMark>;
using ShapesObject = Object<Shapes, kShapesMark>;
using ModelObject = Object<ModelValue, kModelMark>;
using GeometryObject = Object<ModelGeometry, kGeometryMark>;
using BlobObject = Object<std::string, kBlobMark>;
using CancelObject = Object<std::atomic<bool>, kCancelMark>;

/// Notes why the call at hand failed, for gable_last_error, and gives the status back.
gable_status fail(gable_status status, std::string_view why) noexcept;
/// The last error of this thread.
const std::string& lastError() noexcept;
void clearError() noexcept;

/// Runs a call: exceptions become statuses.
template <class Work>
gable_status call(Work&& work) noexcept {
  clearError();
  try {
    return work();
  } catch (const std::bad_alloc&) {
    return fail(GABLE_ERROR_MEMORY, "there is not enough memory for this");
  } catch (const std::exception& e) {
    return fail(GABLE_ERROR_INTERNAL, e.what());
  } catch (...) {
    return fail(GABLE_ERROR_INTERNAL, "the library failed");
  }
}

/// The value behind a handle, or null when it is of another kind.
template <class Obj>
typename Obj::Value* valueOf(const void* handle) noexcept {
  uint64_t mark = 0;
  if (handle) std::memcpy(&mark, handle, sizeof mark);
  if (mark != Obj::kMark) return nullptr;
  return &static_cast<Obj*>(const_cast<void*>(handle))->value;
}

/// Ends an object; what is none is left alone.
template <class Obj>
void release(void* handle) noexcept {
  if (!valueOf<Obj>(handle)) return;
  auto* object = static_cast<Obj*>(handle);
  object->mark = 0;
  delete object;
}

/// Runs `work` on the value behind a handle.
template <class Obj, class Work>
gable_status with(const void* handle, Work&& work) noexcept {
  return call([&] {
    auto* value = valueOf<Obj>(handle);
    return value ? work(*value) : fail(GABLE_ERROR_ARGUMENT, "the object is of another kind");
  });
}

/// The element of an index, or null.
template <class List>
auto* at(List& list, size_t index) {
  return index < list.size() ? &list[index] : nullptr;
}

gable_status noSuchIndex() noexcept;
gable_status nullArgument() noexcept;
gable_status giveText(std::string_view text, char* buffer, size_t capacity, size_t* length);

/// Elements into the caller's buffer.
template <class T>
gable_status giveArray(const T* data, size_t count, T* buffer, size_t capacity, size_t* length) {
  if (!length) return nullArgument();
  *length = count;
  if (!buffer) return GABLE_OK;
  if (capacity < count) return fail(GABLE_ERROR_BUFFER, "the buffer is too small");
  if (count > 0) std::memcpy(buffer, data, count * sizeof(T));
  return GABLE_OK;
}

/// Fills in what the caller's struct has; the fields that it has not stay ours.
template <class Struct>
gable_status giveStruct(Struct made, Struct* out) {
  if (!out) return nullArgument();
  const size_t size = out->struct_size;
  if (size < sizeof(size_t)) return fail(GABLE_ERROR_ARGUMENT, "struct_size is not set");
  made.struct_size = size;
  std::memcpy(static_cast<void*>(out), &made, std::min(size, sizeof made));
  return GABLE_OK;
}

/// The caller's settings over the defaults; false where its struct_size is not set.
template <class Struct>
bool takeStruct(const Struct* given, Struct& out) {
  if (!given) return true;
  if (given->struct_size < sizeof(size_t)) return false;
  std::memcpy(static_cast<void*>(&out), given, std::min(given->struct_size, sizeof out));
  return true;
}

/// Settings with the defaults.
gable_load_settings loadDefaults();
gable_derive_settings deriveDefaults();
gable_write_settings writeDefaults();

/// The first error of a list, for gable_last_error.
gable_status inputError(const DiagnosticList& diagnostics);

}  // namespace gable::c
