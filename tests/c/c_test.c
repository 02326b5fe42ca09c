/* SPDX-License-Identifier: Apache-2.0
   SPDX-FileCopyrightText: The Gable authors

   The C interface as a C program uses it, and misuses it: c_test FOLDER. */
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "gable/c.h"

static int failures = 0;

#define EXPECT(condition)                                              \
  do {                                                                 \
    if (!(condition)) {                                                \
      char why[400] = "";                                              \
      size_t size = 0;                                                 \
      gable_last_error(why, sizeof why, &size);                        \
      printf("%s:%d: %s\n%s\n", __FILE__, __LINE__, #condition, why);  \
      ++failures;                                                      \
    }                                                                  \
  } while (0)

static const char kHouse[] =
    "@Range(min=2, max=40)\n"
    "attr height = 9\n"
    "Lot --> extrude(height) report(\"height\", height) report(\"kind\", \"house\") print(height)\n"
    "        comp(f) { side : color(\"#ff0000\") Wall. | top : Roof. }\n";

static gable_rules* parsed(const char* text) {
  gable_rules* rules = NULL;
  EXPECT(gable_rules_parse(text, strlen(text), "test.cga", NULL, &rules) == GABLE_OK);
  return rules;
}

static gable_shapes* lot(void) {
  gable_shapes* shapes = NULL;
  EXPECT(gable_shapes_lot(4, 3, &shapes) == GABLE_OK);
  return shapes;
}

static gable_model* derived(const char* text) {
  gable_rules* rules = parsed(text);
  gable_shapes* shapes = lot();
  gable_model* model = NULL;
  EXPECT(gable_derive(rules, shapes, NULL, &model) == GABLE_OK);
  gable_shapes_release(shapes);
  gable_rules_release(rules);
  return model;
}

static void readsAttributesWithAnnotations(void) {
  gable_rules* rules = parsed(kHouse);
  gable_attribute attribute = {sizeof attribute};
  char text[32];
  size_t length = 0, count = 0, i, found = 0;
  EXPECT(gable_rules_attribute_count(rules, &count) == GABLE_OK && count == 1);
  EXPECT(gable_rules_attribute(rules, 0, &attribute) == GABLE_OK);
  EXPECT(attribute.hidden == 0 && attribute.annotation_count == 1);
  EXPECT(gable_rules_attribute_name(rules, 0, text, sizeof text, &length) == GABLE_OK);
  EXPECT(strcmp(text, "height") == 0 && length == 6);
  EXPECT(gable_rules_attribute_type(rules, 0, text, sizeof text, &length) == GABLE_OK);
  EXPECT(strcmp(text, "float") == 0);
  EXPECT(gable_rules_annotation(rules, 0, 0, text, sizeof text, &length, &count) == GABLE_OK);
  EXPECT(strcmp(text, "Range") == 0 && count >= 2);
  for (i = 0; i < count; ++i) {
    EXPECT(gable_rules_argument_name(rules, 0, 0, i, text, sizeof text, &length) == GABLE_OK);
    if (strcmp(text, "max") != 0) continue;
    EXPECT(gable_rules_argument_value(rules, 0, 0, i, text, sizeof text, &length) == GABLE_OK);
    EXPECT(strcmp(text, "40") == 0);
    ++found;
  }
  EXPECT(found == 1);
  gable_rules_release(rules);
}

static void tellsMistakesOfRules(void) {
  const char text[] = "Lot --> extrude(\n";
  gable_rules* rules = NULL;
  gable_model* model = NULL;
  gable_shapes* shapes = lot();
  gable_diagnostic d = {sizeof d};
  char code[64];
  size_t length = 0, count = 0;
  EXPECT(gable_rules_parse(text, strlen(text), "test.cga", NULL, &rules) == GABLE_ERROR_INPUT);
  EXPECT(rules != NULL);
  EXPECT(gable_diagnostic_count(rules, &count) == GABLE_OK && count > 0);
  EXPECT(gable_diagnostic_get(rules, 0, &d) == GABLE_OK);
  EXPECT(d.severity == GABLE_ERROR && d.line > 0 && d.column > 0);
  EXPECT(gable_diagnostic_get_text(rules, 0, GABLE_TEXT_CODE, code, sizeof code, &length) ==
         GABLE_OK);
  EXPECT(length > 0 && strlen(code) == length);
  EXPECT(gable_diagnostic_get_text(rules, 0, GABLE_TEXT_FILE, code, sizeof code, &length) ==
         GABLE_OK);
  EXPECT(strcmp(code, "test.cga") == 0);
  EXPECT(gable_derive(rules, shapes, NULL, &model) == GABLE_ERROR_INPUT && model == NULL);
  gable_rules_release(rules);
  EXPECT(gable_rules_load("missing.cga", NULL, &rules) == GABLE_ERROR_INPUT);
  gable_rules_release(rules);
  gable_shapes_release(shapes);
}

/* A file of another project is missing unless the settings say where it is. */
static void readsOtherProjects(const char* folder) {
  const char text[] = "import roof : \"/bundle/roof.cga\"\n@StartRule Lot --> roof.Top\n";
  const char* libraries[1];
  char bundle[1024], roof[1100];
  snprintf(bundle, sizeof bundle, "%s/bundle", folder);
  EXPECT(mkdir(bundle, 0777) == 0 || errno == EEXIST);
  snprintf(roof, sizeof roof, "%s/roof.cga", bundle);
  FILE* file = fopen(roof, "w");
  EXPECT(file != NULL && fputs("Top --> extrude(3) Roof.\n", file) >= 0);
  if (file) fclose(file);
  for (int known = 0; known < 2; ++known) {
    gable_load_settings settings;
    gable_rules* rules = NULL;
    size_t count = 0;
    EXPECT(gable_load_settings_init(&settings) == GABLE_OK);
    libraries[0] = bundle;
    settings.libraries = libraries;
    settings.library_count = (size_t)known;
    EXPECT(gable_rules_parse(text, strlen(text), "a.cga", &settings, &rules) == GABLE_OK);
    EXPECT(gable_diagnostic_count(rules, &count) == GABLE_OK && (count == 0) == (known == 1));
    gable_rules_release(rules);
  }
}

static void makesShapesOfAllKinds(const char* folder) {
  const double corners[] = {0, 0, 10, 0, 10, 10, 0, 10, 4, 4, 4, 6, 6, 6, 6, 4};
  const size_t rings[] = {4, 4};
  const char geojson[] =
      "{\"type\":\"FeatureCollection\",\"features\":[{\"type\":\"Feature\",\"properties\":{},"
      "\"geometry\":{\"type\":\"Polygon\",\"coordinates\":[[[7,43],[7.001,43],[7.001,43.001],"
      "[7,43]]]}}]}";
  const char obj[] = "v 0 0 0\nv 1 0 0\nv 1 0 -1\nf 1 2 3\n";
  gable_shapes* shapes = NULL;
  char path[600];
  size_t count = 0;
  FILE* file;
  EXPECT(gable_shapes_polygon(corners, rings, 2, &shapes) == GABLE_OK);
  EXPECT(gable_shapes_count(shapes, &count) == GABLE_OK && count == 1);
  gable_shapes_release(shapes);
  EXPECT(gable_shapes_parse(geojson, strlen(geojson), "a.geojson", &shapes) == GABLE_OK);
  gable_shapes_release(shapes);
  snprintf(path, sizeof path, "%s/a.obj", folder);
  file = fopen(path, "wb");
  EXPECT(file != NULL);
  if (file) {
    fwrite(obj, 1, strlen(obj), file);
    fclose(file);
  }
  EXPECT(gable_shapes_load(path, &shapes) == GABLE_OK);
  gable_shapes_release(shapes);
  EXPECT(gable_shapes_parse("{", 1, "a.geojson", &shapes) == GABLE_ERROR_INPUT);
  gable_shapes_release(shapes);
  EXPECT(gable_shapes_lot(1e300, 1, &shapes) == GABLE_ERROR_INPUT);
  gable_shapes_release(shapes);
}

static void readsReportsAndPrints(void) {
  gable_model* model = derived(kHouse);
  gable_statistics s = {sizeof s};
  gable_report report = {sizeof report};
  char text[32];
  size_t length = 0;
  uint64_t times = 0;
  EXPECT(gable_model_statistics(model, &s) == GABLE_OK);
  EXPECT(s.leaves == 5 && s.has_bounds && s.bounds_max[1] == 9);
  EXPECT(s.report_count == 2 && s.print_count == 1);
  EXPECT(gable_model_report_key(model, 0, text, sizeof text, &length) == GABLE_OK);
  EXPECT(strcmp(text, "height") == 0);
  EXPECT(gable_model_report(model, 0, &report) == GABLE_OK);
  EXPECT(report.numbers && report.count == 1 && report.sum == 9);
  EXPECT(gable_model_report(model, 1, &report) == GABLE_OK);
  EXPECT(!report.numbers && report.value_count == 1);
  EXPECT(gable_model_report_value(model, 1, 0, text, sizeof text, &length, &times) == GABLE_OK);
  EXPECT(strcmp(text, "house") == 0 && times == 1);
  EXPECT(gable_model_print(model, 0, text, sizeof text, &length) == GABLE_OK);
  EXPECT(strstr(text, "9") != NULL);
  gable_model_release(model);
}

static void readsGeometry(void) {
  gable_model* model = derived(kHouse);
  gable_geometry* geometry = NULL;
  gable_geometry_counts counts = {sizeof counts};
  gable_leaf leaf = {sizeof leaf};
  gable_mesh mesh = {sizeof mesh};
  gable_material material = {sizeof material};
  double positions[64];
  float normals[64];
  uint32_t triangles[64], parts[8], materials[8];
  char text[32];
  size_t length = 0, i;
  EXPECT(gable_model_geometry(model, UINT64_MAX, &geometry) == GABLE_OK);
  /* The geometry outlives its model. */
  gable_model_release(model);
  EXPECT(gable_geometry_count(geometry, &counts) == GABLE_OK);
  EXPECT(counts.leaves == 5 && counts.meshes > 0);
  EXPECT(gable_geometry_leaf(geometry, 0, &leaf) == GABLE_OK);
  EXPECT(gable_leaf_name(geometry, 0, text, sizeof text, &length) == GABLE_OK);
  EXPECT(strcmp(text, "Wall") == 0);
  EXPECT(gable_geometry_mesh(geometry, leaf.mesh, &mesh) == GABLE_OK);
  EXPECT(mesh.vertices == 4 && mesh.triangles == 2 && mesh.parts == 1);
  EXPECT(gable_mesh_positions(geometry, leaf.mesh, positions, 64, &length) == GABLE_OK);
  EXPECT(length == 12);
  EXPECT(gable_mesh_normals(geometry, leaf.mesh, normals, 64, &length) == GABLE_OK && length == 12);
  EXPECT(gable_mesh_triangles(geometry, leaf.mesh, triangles, 64, &length) == GABLE_OK);
  EXPECT(length == 6);
  for (i = 0; i < length; ++i) EXPECT(triangles[i] < mesh.vertices);
  EXPECT(gable_mesh_parts(geometry, leaf.mesh, parts, 8, &length) == GABLE_OK && length == 3);
  EXPECT(parts[1] == 0 && parts[2] == 2);
  EXPECT(gable_mesh_uvs(geometry, leaf.mesh, NULL, 0, &length) == GABLE_OK);
  EXPECT(length == (mesh.has_uvs ? 8u : 0u));
  EXPECT(gable_leaf_materials(geometry, 0, materials, 8, &length) == GABLE_OK && length == 1);
  EXPECT(gable_geometry_material(geometry, materials[0], &material) == GABLE_OK);
  EXPECT(material.opacity == 1 && material.textures == 0);
  EXPECT(gable_material_color(geometry, materials[0], text, sizeof text, &length) == GABLE_OK);
  EXPECT(strcmp(text, "#ff0000") == 0);
  EXPECT(gable_leaf_name(geometry, 5, text, sizeof text, &length) == GABLE_ERROR_ARGUMENT);
  gable_geometry_release(geometry);
}

static void writesFilesAndMemory(const char* folder) {
  gable_model* model = derived(kHouse);
  gable_blob* blob = NULL;
  char path[600];
  size_t length = 0;
  char* bytes;
  snprintf(path, sizeof path, "%s/house.obj", folder);
  EXPECT(gable_model_write(model, path, NULL) == GABLE_OK);
  EXPECT(gable_model_write(model, "/nonexistent/house.glb", NULL) == GABLE_ERROR_WRITE);
  EXPECT(gable_model_encode(model, "glb", NULL, &blob) == GABLE_OK);
  EXPECT(gable_blob_read(blob, NULL, 0, &length) == GABLE_OK && length > 100);
  bytes = malloc(length);
  EXPECT(gable_blob_read(blob, bytes, length - 1, &length) == GABLE_ERROR_BUFFER);
  EXPECT(gable_blob_read(blob, bytes, length, &length) == GABLE_OK);
  EXPECT(memcmp(bytes, "glTF", 4) == 0);
  free(bytes);
  gable_blob_release(blob);
  EXPECT(gable_model_encode(model, "obj", NULL, &blob) == GABLE_ERROR_WRITE && blob == NULL);
  EXPECT(gable_model_encode(model, "../x", NULL, &blob) == GABLE_ERROR_WRITE && blob == NULL);
  gable_model_release(model);
}

static void writesAsAProgramWantsIt(void) {
  static const char* const names[] = {"collision"};
  static const char* const values[] = {"hull"};
  static const char* const unknown[] = {"hul"};
  gable_model* model = derived(kHouse);
  gable_blob* blob = NULL;
  gable_write_settings settings;
  char text[2000];
  size_t length = 0, at;
  int marked = 0;
  char* bytes;
  EXPECT(gable_write_settings_init(&settings) == GABLE_OK);
  settings.profile = "godot";
  settings.option_count = 1;
  settings.option_names = names;
  settings.option_values = values;
  EXPECT(gable_model_encode(model, "glb", &settings, &blob) == GABLE_OK);
  EXPECT(gable_blob_read(blob, NULL, 0, &length) == GABLE_OK);
  bytes = malloc(length);
  EXPECT(gable_blob_read(blob, bytes, length, &length) == GABLE_OK);
  for (at = 0; at + 12 < length; ++at) marked |= memcmp(bytes + at, "-convcolonly", 12) == 0;
  EXPECT(marked);
  free(bytes);
  gable_blob_release(blob);
  settings.option_values = unknown;
  EXPECT(gable_model_encode(model, "glb", &settings, &blob) == GABLE_ERROR_ARGUMENT);
  EXPECT(gable_last_error(text, sizeof text, &length) == GABLE_OK && strstr(text, "'hull'"));
  settings.option_count = 0;
  settings.profile = "quake";
  EXPECT(gable_model_encode(model, "glb", &settings, &blob) == GABLE_ERROR_ARGUMENT);
  EXPECT(gable_last_error(text, sizeof text, &length) == GABLE_OK && strstr(text, "unreal"));
  gable_model_release(model);
}

static int stopAtOnce(void* user, size_t done, size_t total) {
  (void)done;
  (void)total;
  ++*(int*)user;
  return 1;
}

static void keepsLimitsAndCancels(void) {
  gable_rules* rules = parsed("Lot --> split(x) { ~0.001 : Slice. }*\n");
  gable_shapes* shapes = lot();
  gable_model* model = NULL;
  gable_cancel* cancel = NULL;
  gable_derive_settings settings;
  int calls = 0;
  EXPECT(gable_derive_settings_init(&settings) == GABLE_OK);
  settings.max_shapes = 100;
  EXPECT(gable_derive(rules, shapes, &settings, &model) == GABLE_LIMIT && model != NULL);
  gable_model_release(model);
  gable_derive_settings_init(&settings);
  EXPECT(gable_cancel_create(&cancel) == GABLE_OK);
  EXPECT(gable_cancel_request(cancel) == GABLE_OK);
  settings.cancel = cancel;
  EXPECT(gable_derive(rules, shapes, &settings, &model) == GABLE_CANCELLED && model != NULL);
  gable_model_release(model);
  gable_cancel_release(cancel);
  gable_derive_settings_init(&settings);
  settings.progress = stopAtOnce;
  settings.progress_user = &calls;
  gable_derive(rules, shapes, &settings, &model);
  EXPECT(calls > 0);
  gable_model_release(model);
  gable_derive_settings_init(&settings);
  settings.start_rule = "Nothing";
  EXPECT(gable_derive(rules, shapes, &settings, &model) == GABLE_ERROR_INPUT);
  gable_model_release(model);
  gable_shapes_release(shapes);
  gable_rules_release(rules);
}

static void refusesMisuse(void) {
  gable_rules* rules = parsed(kHouse);
  gable_shapes* shapes = lot();
  gable_rules* noRules = NULL;
  gable_shapes* noShapes = NULL;
  gable_model* model = NULL;
  gable_derive_settings settings;
  gable_load_settings unset = {0};
  gable_statistics statistics = {0};
  gable_diagnostic diagnostic = {sizeof diagnostic};
  char text[4] = "abc";
  size_t length = 0, count = 0;
  const size_t tooFew[] = {2};
  const double corners[] = {0, 0, 1, 1};
  /* NULL. */
  EXPECT(gable_rules_parse(NULL, 5, "a.cga", NULL, &noRules) == GABLE_ERROR_ARGUMENT);
  EXPECT(noRules == NULL);
  EXPECT(gable_rules_load(NULL, NULL, &noRules) == GABLE_ERROR_ARGUMENT);
  EXPECT(gable_rules_parse(kHouse, 1, "a.cga", NULL, NULL) == GABLE_ERROR_ARGUMENT);
  EXPECT(gable_derive(NULL, shapes, NULL, &model) == GABLE_ERROR_ARGUMENT);
  EXPECT(gable_derive(rules, shapes, NULL, NULL) == GABLE_ERROR_ARGUMENT);
  EXPECT(gable_rules_attribute_count(NULL, &count) == GABLE_ERROR_ARGUMENT);
  EXPECT(gable_rules_attribute_count(rules, NULL) == GABLE_ERROR_ARGUMENT);
  EXPECT(gable_rules_attribute_name(rules, 0, text, 4, NULL) == GABLE_ERROR_ARGUMENT);
  EXPECT(gable_shapes_polygon(NULL, tooFew, 1, &noShapes) == GABLE_ERROR_ARGUMENT);
  EXPECT(gable_shapes_polygon(corners, tooFew, 1, &noShapes) == GABLE_ERROR_ARGUMENT);
  EXPECT(noShapes == NULL);
  /* Objects of another kind. */
  EXPECT(gable_derive((gable_rules*)(void*)shapes, shapes, NULL, &model) == GABLE_ERROR_ARGUMENT);
  EXPECT(gable_derive(rules, (gable_shapes*)(void*)rules, NULL, &model) == GABLE_ERROR_ARGUMENT);
  EXPECT(gable_shapes_count((gable_shapes*)(void*)rules, &count) == GABLE_ERROR_ARGUMENT);
  EXPECT(gable_last_error(NULL, 0, &length) == GABLE_OK && length > 0);
  gable_shapes_release((gable_shapes*)(void*)rules);
  EXPECT(gable_rules_attribute_count(rules, &count) == GABLE_OK && count == 1);
  EXPECT(gable_last_error(NULL, 0, &length) == GABLE_OK && length == 0);
  gable_derive_settings_init(&settings);
  settings.cancel = (gable_cancel*)(void*)rules;
  EXPECT(gable_derive(rules, shapes, &settings, &model) == GABLE_ERROR_ARGUMENT);
  /* Small buffers stay as they are, wrong indices and structs are refused. */
  EXPECT(gable_rules_attribute_name(rules, 0, text, 4, &length) == GABLE_ERROR_BUFFER);
  EXPECT(length == 6 && strcmp(text, "abc") == 0);
  EXPECT(gable_rules_attribute_name(rules, 0, NULL, 0, &length) == GABLE_OK && length == 6);
  EXPECT(gable_rules_attribute_name(rules, 1, text, 4, &length) == GABLE_ERROR_ARGUMENT);
  EXPECT(gable_diagnostic_get(rules, 99, &diagnostic) == GABLE_ERROR_ARGUMENT);
  EXPECT(gable_rules_load("a.cga", &unset, &noRules) == GABLE_ERROR_ARGUMENT && noRules == NULL);
  gable_derive_settings_init(&settings);
  settings.attribute_count = 1;
  EXPECT(gable_derive(rules, shapes, &settings, &model) == GABLE_ERROR_ARGUMENT);
  EXPECT(gable_derive(rules, shapes, NULL, &model) == GABLE_OK);
  EXPECT(gable_model_statistics(model, &statistics) == GABLE_ERROR_ARGUMENT);
  /* A caller of an older version has a shorter struct: no more is written. */
  statistics.struct_size = offsetof(gable_statistics, faces);
  statistics.faces = 77;
  EXPECT(gable_model_statistics(model, &statistics) == GABLE_OK);
  EXPECT(statistics.leaves == 5 && statistics.faces == 77);
  gable_model_release(model);
  gable_shapes_release(shapes);
  gable_rules_release(rules);
  gable_rules_release(NULL);
}

int main(int argc, char** argv) {
  /* This is no googletest program: `--gtest_list_tests` is not the name of a folder. */
  if (argc != 2 || argv[1][0] == '-') {
    fprintf(stderr, "usage: c_test FOLDER\n");
    return 2;
  }
  if (mkdir(argv[1], 0777) != 0 && errno != EEXIST) return 2;
  EXPECT(gable_c_interface() == GABLE_C_INTERFACE);
  EXPECT(strlen(gable_library_version()) > 0);
  readsAttributesWithAnnotations();
  tellsMistakesOfRules();
  readsOtherProjects(argv[1]);
  makesShapesOfAllKinds(argv[1]);
  readsReportsAndPrints();
  readsGeometry();
  writesFilesAndMemory(argv[1]);
  writesAsAProgramWantsIt();
  keepsLimitsAndCancels();
  refusesMisuse();
  printf("%d failures\n", failures);
  return failures == 0 ? 0 : 1;
}
