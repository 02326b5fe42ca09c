// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "c/object.h"

using namespace gable::c;

namespace gable::c {

gable_load_settings loadDefaults() {
  gable_load_settings s{};
  s.struct_size = sizeof s;
  return s;
}

namespace {

bool settingsOf(const gable_load_settings* given, LoadSettings& out) {
  gable_load_settings s = loadDefaults();
  if (!takeStruct(given, s)) return false;
  if (s.project) out.project = s.project;
  if (s.dialect) out.dialect = s.dialect;
  if (s.style) out.style = s.style;
  if (s.workspace) out.search.workspace = s.workspace;
  if (s.bundled) out.search.bundled = s.bundled;
  for (size_t i = 0; s.libraries && i < s.library_count; ++i) {
    if (s.libraries[i]) out.search.libraries.emplace_back(s.libraries[i]);
  }
  return true;
}

gable_status give(Rules made, gable_rules** rules) {
  std::vector<AttributeInfo> attributes = made.attributes();
  auto* object = new RulesObject{RulesObject::kMark, {std::move(made), std::move(attributes)}};
  *rules = reinterpret_cast<gable_rules*>(object);
  const Rules& r = object->value.rules;
  return r.ok() ? GABLE_OK : inputError(r.diagnostics());
}

template <class Work>
gable_status withAttribute(const gable_rules* rules, size_t index, Work&& work) {
  return with<RulesObject>(rules, [&](const RulesValue& r) {
    const AttributeInfo* a = at(r.attributes, index);
    return a ? work(*a) : noSuchIndex();
  });
}

template <class Work>
gable_status withAnnotation(const gable_rules* rules, size_t attribute, size_t index, Work&& work) {
  return withAttribute(rules, attribute, [&](const AttributeInfo& a) {
    const AttributeInfo::Annotation* n = at(a.annotations, index);
    return n ? work(*n) : noSuchIndex();
  });
}

}  // namespace
}  // namespace gable::c

gable_status gable_load_settings_init(gable_load_settings* settings) {
  return call([&] {
    if (!settings) return nullArgument();
    *settings = loadDefaults();
    return GABLE_OK;
  });
}

gable_status gable_rules_load(const char* path, const gable_load_settings* settings,
                              gable_rules** rules) {
  return call([&] {
    if (rules) *rules = nullptr;
    gable::LoadSettings s;
    if (!rules || !path) return nullArgument();
    if (!settingsOf(settings, s)) return fail(GABLE_ERROR_ARGUMENT, "struct_size is not set");
    return give(gable::Rules::load(path, s), rules);
  });
}

gable_status gable_rules_parse(const char* text, size_t text_length, const char* path,
                               const gable_load_settings* settings, gable_rules** rules) {
  return call([&] {
    if (rules) *rules = nullptr;
    gable::LoadSettings s;
    if (!rules || !path || (!text && text_length > 0)) return nullArgument();
    if (!settingsOf(settings, s)) return fail(GABLE_ERROR_ARGUMENT, "struct_size is not set");
    const std::string rule_text = text ? std::string(text, text_length) : std::string();
    return give(gable::Rules::parse(rule_text, path, s), rules);
  });
}

gable_status gable_rules_attribute_count(const gable_rules* rules, size_t* count) {
  return with<RulesObject>(rules, [&](const RulesValue& r) {
    if (!count) return nullArgument();
    *count = r.attributes.size();
    return GABLE_OK;
  });
}

gable_status gable_rules_attribute(const gable_rules* rules, size_t index,
                                   gable_attribute* attribute) {
  return withAttribute(rules, index, [&](const gable::AttributeInfo& a) {
    gable_attribute out{};
    out.hidden = a.hidden ? 1 : 0;
    out.annotation_count = a.annotations.size();
    return giveStruct(out, attribute);
  });
}

gable_status gable_rules_attribute_name(const gable_rules* rules, size_t index, char* buffer,
                                        size_t capacity, size_t* length) {
  return withAttribute(rules, index, [&](const gable::AttributeInfo& a) {
    return giveText(a.name, buffer, capacity, length);
  });
}

gable_status gable_rules_attribute_type(const gable_rules* rules, size_t index, char* buffer,
                                        size_t capacity, size_t* length) {
  return withAttribute(rules, index, [&](const gable::AttributeInfo& a) {
    return giveText(a.type, buffer, capacity, length);
  });
}

gable_status gable_rules_annotation(const gable_rules* rules, size_t attribute, size_t annotation,
                                    char* buffer, size_t capacity, size_t* length,
                                    size_t* argument_count) {
  return withAnnotation(rules, attribute, annotation,
                        [&](const gable::AttributeInfo::Annotation& n) {
                          if (!argument_count) return nullArgument();
                          *argument_count = n.arguments.size();
                          return giveText(n.name, buffer, capacity, length);
                        });
}

gable_status gable_rules_argument_name(const gable_rules* rules, size_t attribute,
                                       size_t annotation, size_t argument, char* buffer,
                                       size_t capacity, size_t* length) {
  return withAnnotation(rules, attribute, annotation,
                        [&](const gable::AttributeInfo::Annotation& n) {
                          const auto* a = at(n.arguments, argument);
                          return a ? giveText(a->first, buffer, capacity, length) : noSuchIndex();
                        });
}

gable_status gable_rules_argument_value(const gable_rules* rules, size_t attribute,
                                        size_t annotation, size_t argument, char* buffer,
                                        size_t capacity, size_t* length) {
  return withAnnotation(rules, attribute, annotation,
                        [&](const gable::AttributeInfo::Annotation& n) {
                          const auto* a = at(n.arguments, argument);
                          return a ? giveText(a->second, buffer, capacity, length) : noSuchIndex();
                        });
}
