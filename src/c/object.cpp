// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "c/object.h"

namespace gable::c {

namespace {

// A thread's own, since the status of a call has no room for a sentence.
std::string& error() {
  thread_local std::string text;
  return text;
}

}  // namespace

gable_status fail(gable_status status, std::string_view why) noexcept {
  try {
    error() = why;
  } catch (...) {
    clearError();
  }
  return status;
}

const std::string& lastError() noexcept { return error(); }
void clearError() noexcept { error().clear(); }

gable_status noSuchIndex() noexcept {
  return fail(GABLE_ERROR_ARGUMENT, "there is no element of that index");
}

gable_status nullArgument() noexcept {
  return fail(GABLE_ERROR_ARGUMENT, "an argument is NULL that may not be");
}

gable_status giveText(std::string_view text, char* buffer, size_t capacity, size_t* length) {
  if (!length) return nullArgument();
  *length = text.size();
  if (!buffer) return GABLE_OK;
  if (capacity < text.size() + 1) return fail(GABLE_ERROR_BUFFER, "the buffer is too small");
  std::memcpy(buffer, text.data(), text.size());
  buffer[text.size()] = '\0';
  return GABLE_OK;
}

gable_status inputError(const DiagnosticList& diagnostics) {
  for (const Diagnostic& d : diagnostics) {
    if (!d.isError()) continue;
    return fail(d.code == "out-of-memory" ? GABLE_ERROR_MEMORY : GABLE_ERROR_INPUT, d.rendered);
  }
  return fail(GABLE_ERROR_INPUT, "the input is wrong");
}

}  // namespace gable::c

using namespace gable::c;

uint32_t gable_c_interface(void) { return GABLE_C_INTERFACE; }
const char* gable_library_version(void) { return gable::version(); }

gable_status gable_last_error(char* buffer, size_t capacity, size_t* length) {
  if (!length) return GABLE_ERROR_ARGUMENT;
  const std::string& text = lastError();
  *length = text.size();
  if (!buffer) return GABLE_OK;
  if (capacity < text.size() + 1) return GABLE_ERROR_BUFFER;
  std::memcpy(buffer, text.c_str(), text.size() + 1);
  return GABLE_OK;
}

void gable_rules_release(gable_rules* rules) { release<RulesObject>(rules); }
void gable_shapes_release(gable_shapes* shapes) { release<ShapesObject>(shapes); }
void gable_model_release(gable_model* model) { release<ModelObject>(model); }
void gable_geometry_release(gable_geometry* geometry) { release<GeometryObject>(geometry); }
void gable_blob_release(gable_blob* blob) { release<BlobObject>(blob); }
void gable_cancel_release(gable_cancel* cancel) { release<CancelObject>(cancel); }

namespace {

// The diagnostics of a handle of any kind that has them, or null.
const gable::DiagnosticList* diagnosticsOf(const void* object) {
  if (const auto* rules = valueOf<RulesObject>(object)) return &rules->rules.diagnostics();
  if (const auto* shapes = valueOf<ShapesObject>(object)) return &shapes->diagnostics();
  if (const auto* model = valueOf<ModelObject>(object)) return &model->model.diagnostics();
  return nullptr;
}

template <class Work>
gable_status withDiagnostic(const void* object, size_t index, Work&& work) {
  return call([&] {
    const gable::DiagnosticList* list = diagnosticsOf(object);
    if (!list) return fail(GABLE_ERROR_ARGUMENT, "the object has no diagnostics");
    const gable::Diagnostic* d = at(*list, index);
    return d ? work(*d) : noSuchIndex();
  });
}

}  // namespace

gable_status gable_diagnostic_count(const void* object, size_t* count) {
  return call([&] {
    const gable::DiagnosticList* list = diagnosticsOf(object);
    if (!list) return fail(GABLE_ERROR_ARGUMENT, "the object has no diagnostics");
    if (!count) return nullArgument();
    *count = list->size();
    return GABLE_OK;
  });
}

gable_status gable_diagnostic_get(const void* object, size_t index, gable_diagnostic* diagnostic) {
  return withDiagnostic(object, index, [&](const gable::Diagnostic& d) {
    const gable::TextRange at = d.range.value_or(gable::TextRange{});
    gable_diagnostic out{};
    out.severity = static_cast<gable_severity>(d.severity);
    out.line = at.line;
    out.column = at.column;
    out.end_line = at.endLine;
    out.end_column = at.endColumn;
    return giveStruct(out, diagnostic);
  });
}

gable_status gable_diagnostic_get_text(const void* object, size_t index,
                                       gable_diagnostic_text which, char* buffer, size_t capacity,
                                       size_t* length) {
  return withDiagnostic(object, index, [&](const gable::Diagnostic& d) {
    const std::string file = d.range ? d.range->file : std::string();
    const std::string* texts[] = {&d.code, &d.message, &d.hint, &file, &d.shapePath, &d.rendered};
    const auto text = static_cast<size_t>(which);
    return text < std::size(texts) ? giveText(*texts[text], buffer, capacity, length)
                                   : noSuchIndex();
  });
}
