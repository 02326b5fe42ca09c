// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "c/object.h"
#include "gable/names.h"
#include "gable/writing.h"

using namespace gable::c;

namespace gable::c {

gable_derive_settings deriveDefaults() {
  const Limits limits;
  gable_derive_settings s{};
  s.struct_size = sizeof s;
  s.sharing = 1;
  s.max_depth = limits.depth;
  s.max_width = limits.width;
  s.max_shapes = limits.shapes;
  s.max_vertices = limits.vertices;
  s.max_steps = limits.steps;
  s.max_bytes = limits.bytes.value_or(0);
  s.max_seconds = limits.seconds.value_or(0);
  return s;
}

gable_write_settings writeDefaults() {
  gable_write_settings s{};
  s.struct_size = sizeof s;
  return s;
}

namespace {

// GABLE_OK where the settings can be used. The field `instancing` is an option like the others.
gable_status settingsOf(const gable_write_settings* given, WriteSettings& out) {
  gable_write_settings s = writeDefaults();
  if (!takeStruct(given, s)) return fail(GABLE_ERROR_ARGUMENT, "struct_size is not set");
  if (s.instancing < GABLE_INSTANCING_AUTO || s.instancing > GABLE_INSTANCING_SHAPES) {
    return fail(GABLE_ERROR_ARGUMENT, "there is no such instancing");
  }
  WriteChoices choices;
  if (s.instancing != GABLE_INSTANCING_AUTO) {
    // The enumerations are in the same order.
    const auto& names = instancingNames();
    choices.emplace_back("instancing", names[static_cast<size_t>(s.instancing)]);
  }
  if (s.option_count > 0 && (!s.option_names || !s.option_values)) return nullArgument();
  for (size_t i = 0; i < s.option_count; ++i) {
    if (!s.option_names[i] || !s.option_values[i]) return nullArgument();
    choices.emplace_back(s.option_names[i], s.option_values[i]);
  }
  const ChosenWriting chosen = chosenWriting(s.profile ? s.profile : "", choices);
  if (!chosen.ok) return fail(GABLE_ERROR_ARGUMENT, render(chosen.diagnostics));
  out = chosen.settings;
  return GABLE_OK;
}

void setLimits(const gable_derive_settings& s, Limits& limits) {
  limits.depth = s.max_depth;
  limits.width = s.max_width;
  limits.shapes = s.max_shapes;
  limits.vertices = s.max_vertices;
  limits.steps = s.max_steps;
  limits.bytes.reset();
  if (s.max_bytes > 0) limits.bytes = s.max_bytes;
  if (s.max_seconds > 0) limits.seconds = s.max_seconds;
}

// GABLE_OK where the settings can be used.
gable_status settingsOf(const gable_derive_settings* given, DeriveSettings& out,
                        std::atomic<bool>& own) {
  gable_derive_settings s = deriveDefaults();
  if (!takeStruct(given, s)) return fail(GABLE_ERROR_ARGUMENT, "struct_size is not set");
  if (s.start_rule) out.startRule = s.start_rule;
  out.seed = s.seed;
  if (s.attribute_count > 0 && (!s.attribute_names || !s.attribute_values)) return nullArgument();
  for (size_t i = 0; i < s.attribute_count; ++i) {
    if (!s.attribute_names[i] || !s.attribute_values[i]) return nullArgument();
    out.attributes.emplace_back(s.attribute_names[i], s.attribute_values[i]);
  }
  out.sharing = s.sharing != 0;
  if (s.jobs < 0) return fail(GABLE_ERROR_ARGUMENT, "the number of threads is below 0");
  if (s.jobs > 0) out.jobs = s.jobs;
  setLimits(s, out.limits);
  std::atomic<bool>* const cancel = s.cancel ? valueOf<CancelObject>(s.cancel) : &own;
  if (!cancel) return fail(GABLE_ERROR_ARGUMENT, "'cancel' is of another kind");
  out.cancel = cancel;
  if (s.progress) {
    out.progress = [progress = s.progress, user = s.progress_user, cancel](size_t done,
                                                                           size_t total) {
      if (progress(user, done, total) != 0) cancel->store(true);
    };
  }
  return GABLE_OK;
}

gable_status give(Model made, gable_model** model) {
  Statistics statistics = made.statistics();
  auto* object = new ModelObject{ModelObject::kMark, {std::move(made), std::move(statistics)}};
  *model = reinterpret_cast<gable_model*>(object);
  const Model& m = object->value.model;
  if (m.end() == End::Cancelled) return fail(GABLE_CANCELLED, "the derivation was cancelled");
  if (!m.ok()) return inputError(m.diagnostics());
  if (m.end() == End::LimitReached) return fail(GABLE_LIMIT, render(m.diagnostics()));
  return GABLE_OK;
}

template <class Work>
gable_status withReport(const gable_model* model, size_t index, Work&& work) {
  return with<ModelObject>(model, [&](const ModelValue& m) {
    const ReportSummary* r = at(m.statistics.reports, index);
    return r ? work(*r) : noSuchIndex();
  });
}

gable_status writeError(const DiagnosticList& diagnostics) {
  const gable_status status = inputError(diagnostics);
  return status == GABLE_ERROR_INPUT ? GABLE_ERROR_WRITE : status;
}

}  // namespace
}  // namespace gable::c

gable_status gable_cancel_create(gable_cancel** cancel) {
  return call([&] {
    if (!cancel) return nullArgument();
    *cancel = nullptr;
    *cancel = reinterpret_cast<gable_cancel*>(new CancelObject{CancelObject::kMark, false});
    return GABLE_OK;
  });
}

gable_status gable_cancel_request(gable_cancel* cancel) {
  return with<CancelObject>(cancel, [](std::atomic<bool>& flag) {
    flag.store(true);
    return GABLE_OK;
  });
}

gable_status gable_derive_settings_init(gable_derive_settings* settings) {
  return call([&] {
    if (!settings) return nullArgument();
    *settings = deriveDefaults();
    return GABLE_OK;
  });
}

gable_status gable_derive(const gable_rules* rules, const gable_shapes* shapes,
                          const gable_derive_settings* settings, gable_model** model) {
  return call([&] {
    if (!model) return nullArgument();
    *model = nullptr;
    const RulesValue* r = valueOf<RulesObject>(rules);
    const gable::Shapes* s = valueOf<ShapesObject>(shapes);
    if (!r || !s) return fail(GABLE_ERROR_ARGUMENT, "rules or shapes are of another kind");
    std::atomic<bool> own{false};
    gable::DeriveSettings derive;
    const gable_status status = settingsOf(settings, derive, own);
    if (status != GABLE_OK) return status;
    if (!r->rules.ok()) return inputError(r->rules.diagnostics());
    return give(gable::derive(r->rules, *s, derive), model);
  });
}

gable_status gable_model_statistics(const gable_model* model, gable_statistics* statistics) {
  return with<ModelObject>(model, [&](const ModelValue& m) {
    const gable::Statistics& s = m.statistics;
    gable_statistics out{};
    out.shapes = s.shapes;
    out.leaves = s.leaves;
    out.faces = s.faces;
    out.vertices = s.vertices;
    out.triangles = s.triangles;
    out.instances = s.instances;
    out.prototypes = s.prototypes;
    out.materials = s.materials;
    out.has_bounds = s.bounds ? 1 : 0;
    for (size_t i = 0; s.bounds && i < 3; ++i) {
      out.bounds_min[i] = s.bounds->min[i];
      out.bounds_max[i] = s.bounds->max[i];
    }
    out.report_count = s.reports.size();
    out.print_count = m.model.prints().size();
    return giveStruct(out, statistics);
  });
}

gable_status gable_model_report(const gable_model* model, size_t index, gable_report* report) {
  return withReport(model, index, [&](const gable::ReportSummary& r) {
    gable_report out{};
    out.count = r.count;
    out.value_count = r.values.size();
    if (r.numbers) {
      out.numbers = 1;
      out.sum = r.numbers->sum;
      out.min = r.numbers->min;
      out.max = r.numbers->max;
    }
    return giveStruct(out, report);
  });
}

gable_status gable_model_report_key(const gable_model* model, size_t index, char* buffer,
                                    size_t capacity, size_t* length) {
  return withReport(model, index, [&](const gable::ReportSummary& r) {
    return giveText(r.key, buffer, capacity, length);
  });
}

gable_status gable_model_report_value(const gable_model* model, size_t index, size_t value,
                                      char* buffer, size_t capacity, size_t* length,
                                      uint64_t* count) {
  return withReport(model, index, [&](const gable::ReportSummary& r) {
    const auto* v = at(r.values, value);
    if (!v) return noSuchIndex();
    if (!count) return nullArgument();
    *count = v->second;
    return giveText(v->first, buffer, capacity, length);
  });
}

gable_status gable_model_print(const gable_model* model, size_t index, char* buffer,
                               size_t capacity, size_t* length) {
  return with<ModelObject>(model, [&](const ModelValue& m) {
    const std::string* line = at(m.model.prints(), index);
    return line ? giveText(*line, buffer, capacity, length) : noSuchIndex();
  });
}

gable_status gable_write_settings_init(gable_write_settings* settings) {
  return call([&] {
    if (!settings) return nullArgument();
    *settings = writeDefaults();
    return GABLE_OK;
  });
}

gable_status gable_model_write(const gable_model* model, const char* path,
                               const gable_write_settings* settings) {
  return with<ModelObject>(model, [&](const ModelValue& m) {
    if (!path) return nullArgument();
    gable::WriteSettings s;
    if (const gable_status status = settingsOf(settings, s); status != GABLE_OK) return status;
    const gable::WriteResult written = m.model.write(path, s);
    return written.ok ? GABLE_OK : writeError(written.diagnostics);
  });
}

gable_status gable_model_encode(const gable_model* model, const char* format,
                                const gable_write_settings* settings, gable_blob** blob) {
  if (blob) *blob = nullptr;
  return with<ModelObject>(model, [&](const ModelValue& m) {
    if (!format || !blob) return nullArgument();
    gable::WriteSettings s;
    if (const gable_status status = settingsOf(settings, s); status != GABLE_OK) return status;
    gable::EncodeResult encoded = m.model.encode(format, s);
    if (!encoded.ok) return writeError(encoded.diagnostics);
    *blob =
        reinterpret_cast<gable_blob*>(new BlobObject{BlobObject::kMark, std::move(encoded.bytes)});
    return GABLE_OK;
  });
}

gable_status gable_blob_read(const gable_blob* blob, void* buffer, size_t capacity,
                             size_t* length) {
  return with<BlobObject>(blob, [&](const std::string& bytes) {
    return giveArray(bytes.data(), bytes.size(), static_cast<char*>(buffer), capacity, length);
  });
}
