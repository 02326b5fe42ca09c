// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "shape/op_call.h"

namespace gable {

double component(const Vec3& v, Axis a) { return v[static_cast<size_t>(a)]; }

void OpCall::emit(Shape child, uint32_t slot, uint32_t piece) {
  child.path = hashCombine(hashCombine(shape_.path, site_), uint64_t{slot} << 32 | piece);
  children_->push_back({std::move(child), slot});
}

Shape& OpCall::emitCopy(uint32_t slot, uint32_t piece) {
  Child& child = children_->emplace_back();
  child.shape = shape_;
  child.slot = slot;
  child.shape.path = hashCombine(hashCombine(shape_.path, site_), uint64_t{slot} << 32 | piece);
  return child.shape;
}

Value FunctionCall::fail(const char* code, std::string message, std::string hint,
                         Value otherwise) const {
  services_.warn(code, std::move(message), std::move(hint));
  return otherwise;
}

}  // namespace gable
