// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "c/object.h"

using namespace gable::c;

namespace gable::c {
namespace {

gable_status give(Shapes made, gable_shapes** shapes) {
  auto* object = new ShapesObject{ShapesObject::kMark, std::move(made)};
  *shapes = reinterpret_cast<gable_shapes*>(object);
  const Shapes& s = object->value;
  return s.ok() ? GABLE_OK : inputError(s.diagnostics());
}

}  // namespace
}  // namespace gable::c

gable_status gable_shapes_lot(double width, double depth, gable_shapes** shapes) {
  return call([&] {
    if (!shapes) return nullArgument();
    *shapes = nullptr;
    return give(gable::Shapes::lot(width, depth), shapes);
  });
}

gable_status gable_shapes_polygon(const double* coordinates, const size_t* ring_sizes,
                                  size_t ring_count, gable_shapes** shapes) {
  return call([&] {
    if (shapes) *shapes = nullptr;
    if (!shapes || !coordinates || !ring_sizes) return nullArgument();
    if (ring_count == 0) return fail(GABLE_ERROR_ARGUMENT, "a polygon has an outer ring");
    std::vector<gable::Shapes::Ring> rings;
    const double* next = coordinates;
    for (size_t r = 0; r < ring_count; ++r) {
      if (ring_sizes[r] < 3) return fail(GABLE_ERROR_ARGUMENT, "a ring has three points or more");
      gable::Shapes::Ring ring;
      for (size_t i = 0; i < ring_sizes[r]; ++i, next += 2) ring.emplace_back(next[0], next[1]);
      rings.push_back(std::move(ring));
    }
    const gable::Shapes::Ring outer = std::move(rings.front());
    rings.erase(rings.begin());
    return give(gable::Shapes::polygon(outer, rings), shapes);
  });
}

gable_status gable_shapes_load(const char* path, gable_shapes** shapes) {
  return call([&] {
    if (shapes) *shapes = nullptr;
    if (!shapes || !path) return nullArgument();
    return give(gable::Shapes::load(path), shapes);
  });
}

gable_status gable_shapes_parse(const void* content, size_t size, const char* name,
                                gable_shapes** shapes) {
  return call([&] {
    if (shapes) *shapes = nullptr;
    if (!shapes || !name || (!content && size > 0)) return nullArgument();
    const auto* bytes = static_cast<const char*>(content);
    return give(gable::Shapes::parse(size > 0 ? std::string(bytes, size) : std::string(), name),
                shapes);
  });
}

gable_status gable_shapes_count(const gable_shapes* shapes, size_t* count) {
  return with<ShapesObject>(shapes, [&](const gable::Shapes& s) {
    if (!count) return nullArgument();
    *count = s.size();
    return GABLE_OK;
  });
}
