/* SPDX-License-Identifier: Apache-2.0
   SPDX-FileCopyrightText: The Gable authors

   Gable's C interface: for C programs, and for bindings of other languages.

     gable_rules* rules = NULL;
     gable_shapes* lot = NULL;
     gable_model* house = NULL;
     gable_rules_load("house.cga", NULL, &rules);
     gable_shapes_lot(20, 30, &lot);
     if (gable_derive(rules, lot, NULL, &house) == GABLE_OK)
       gable_model_write(house, "house.glb", NULL);
     gable_model_release(house);
     gable_shapes_release(lot);
     gable_rules_release(rules);

   Rules that hold for every function:

   1. It returns a status, and no exception leaves it. After a status other than GABLE_OK,
      gable_last_error says why, to the thread that made the call.
   2. A function that makes an object stores it where the caller says. With GABLE_ERROR_INPUT,
      GABLE_LIMIT and GABLE_CANCELLED there is an object too: it holds the diagnostics, and what was
      made until then. With any other failure NULL is stored. The caller releases each object once;
      objects do not depend on each other's life.
   3. Objects never change once they are made, so any number of threads may read one at the same
      time. No thread may use an object while or after another releases it.
   4. Text is UTF-8 and ends in a zero byte. Text and arrays go into buffers of the caller's:
      `length` (never NULL) receives what there is, in bytes without the zero or in elements. With
      a NULL buffer that is all. A buffer that is too small is left as it was, and the status is
      GABLE_ERROR_BUFFER; text needs room for length + 1 bytes.
   5. Structs begin with struct_size, which the caller sets to sizeof of the struct. Later versions
      may add fields at the end, and fill in or read only what the caller's struct has. Functions
      and fields are never removed or changed while GABLE_C_INTERFACE stays the same.
   6. A NULL settings pointer means the defaults; gable_*_settings_init fills them in.
   7. An argument that is NULL where it may not be, an object of another kind, and an index that is
      too large give GABLE_ERROR_ARGUMENT.

   Lengths are metres, angles degrees, the frame is right-handed with y up (+x east, -z north). */
#ifndef GABLE_C_H
#define GABLE_C_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* The version of this interface; gable_c_interface() gives that of the library at hand. */
#define GABLE_C_INTERFACE 1
uint32_t gable_c_interface(void);
/* The version of the library: "0.1.0". */
const char* gable_library_version(void);

typedef enum gable_status {
  GABLE_OK = 0,
  /* A limit ended the derivation; the model holds what was made until then. */
  GABLE_LIMIT = 1,
  GABLE_CANCELLED = 2,
  /* The rules, shapes, attributes or a file are wrong; the object has the diagnostics. */
  GABLE_ERROR_INPUT = 3,
  GABLE_ERROR_ARGUMENT = 4,
  GABLE_ERROR_BUFFER = 5,
  /* A file could not be written. */
  GABLE_ERROR_WRITE = 6,
  GABLE_ERROR_MEMORY = 7,
  GABLE_ERROR_INTERNAL = 8
} gable_status;

/* Why the last call of this thread failed; empty after a call that did not. Does not count as a
   call itself. */
gable_status gable_last_error(char* buffer, size_t capacity, size_t* length);

typedef struct gable_rules gable_rules;
typedef struct gable_shapes gable_shapes;
typedef struct gable_model gable_model;
typedef struct gable_geometry gable_geometry;
typedef struct gable_blob gable_blob;
typedef struct gable_cancel gable_cancel;

/* NULL is allowed. */
void gable_rules_release(gable_rules* rules);
void gable_shapes_release(gable_shapes* shapes);
void gable_model_release(gable_model* model);
void gable_geometry_release(gable_geometry* geometry);
void gable_blob_release(gable_blob* blob);
void gable_cancel_release(gable_cancel* cancel);

/* ---- Rules ---- */

typedef struct gable_load_settings {
  size_t struct_size;
  /* The folder that rules may read from; NULL: found from the rule file. */
  const char* project;
  /* The notation; NULL: by the file's extension. */
  const char* dialect;
  /* A style that the rule file declares; NULL: none. */
  const char* style;
  /* A folder of projects, whose files rules may read; NULL: none. */
  const char* workspace;
  /* Folders of further projects, each a folder or NAME=FOLDER. */
  const char* const* libraries;
  size_t library_count;
  /* The folder of the rules that are called "/gable/rules/trees.cga"; NULL: none. */
  const char* bundled;
} gable_load_settings;
gable_status gable_load_settings_init(gable_load_settings* settings);

gable_status gable_rules_load(const char* path, const gable_load_settings* settings,
                              gable_rules** rules);
/* Rule text in memory; `path` names it in diagnostics and places it in the project. */
gable_status gable_rules_parse(const char* text, size_t text_length, const char* path,
                               const gable_load_settings* settings, gable_rules** rules);

/* Attributes that the rules declare, in the order of the file. */
typedef struct gable_attribute {
  size_t struct_size;
  int32_t hidden;
  size_t annotation_count;
} gable_attribute;
gable_status gable_rules_attribute_count(const gable_rules* rules, size_t* count);
gable_status gable_rules_attribute(const gable_rules* rules, size_t index,
                                   gable_attribute* attribute);
gable_status gable_rules_attribute_name(const gable_rules* rules, size_t index, char* buffer,
                                        size_t capacity, size_t* length);
/* "float", "bool", "string", "float[]", ... */
gable_status gable_rules_attribute_type(const gable_rules* rules, size_t index, char* buffer,
                                        size_t capacity, size_t* length);
/* The name of an annotation, such as Range, and how many arguments it has. */
gable_status gable_rules_annotation(const gable_rules* rules, size_t attribute, size_t annotation,
                                    char* buffer, size_t capacity, size_t* length,
                                    size_t* argument_count);
/* The name of an argument, which may be empty, and its value as text. */
gable_status gable_rules_argument_name(const gable_rules* rules, size_t attribute,
                                       size_t annotation, size_t argument, char* buffer,
                                       size_t capacity, size_t* length);
gable_status gable_rules_argument_value(const gable_rules* rules, size_t attribute,
                                        size_t annotation, size_t argument, char* buffer,
                                        size_t capacity, size_t* length);

/* ---- Initial shapes ---- */

/* A rectangle: a corner at the origin, `width` along +x, `depth` along -z, facing up. */
gable_status gable_shapes_lot(double width, double depth, gable_shapes** shapes);
/* A polygon in plan coordinates (x east, y north): `coordinates` holds x and y of all points, ring
   after ring, the outer ring first and then the holes; `ring_sizes` counts points. */
gable_status gable_shapes_polygon(const double* coordinates, const size_t* ring_sizes,
                                  size_t ring_count, gable_shapes** shapes);
/* By extension: .obj .gltf .glb .geojson .json, and the formats of maps and models that
   Shapes::load in gable/shapes.h names. */
gable_status gable_shapes_load(const char* path, gable_shapes** shapes);
/* The same for a file's content; `name` gives the extension, and the folder of what it names. */
gable_status gable_shapes_parse(const void* content, size_t size, const char* name,
                                gable_shapes** shapes);
gable_status gable_shapes_count(const gable_shapes* shapes, size_t* count);

/* ---- Derivation ---- */

/* Ends the derivations that it was given to soon after gable_cancel_request, which any thread may
   call. Keep it until they have returned. */
gable_status gable_cancel_create(gable_cancel** cancel);
gable_status gable_cancel_request(gable_cancel* cancel);

/* Called from any thread with the number of initial shapes done. Other than 0 cancels. Must not
   throw, nor jump out. */
typedef int (*gable_progress)(void* user, size_t done, size_t total);

typedef struct gable_derive_settings {
  size_t struct_size;
  /* NULL: the rules' own. */
  const char* start_rule;
  double seed;
  /* Names and values as text, arrays as [1,2;3,4]; NULL where attribute_count is 0. */
  const char* const* attribute_names;
  const char* const* attribute_values;
  size_t attribute_count;
  /* Derive equal parts once; 0 gives the same model, flattened. */
  int32_t sharing;
  /* Threads; 0: one a processor. */
  int32_t jobs;
  /* Limits; see Limits in gable/limits.h. */
  uint32_t max_depth, max_width;
  uint64_t max_shapes, max_vertices, max_steps;
  /* 0: no limit. */
  uint64_t max_bytes;
  double max_seconds;
  /* May be NULL. */
  gable_cancel* cancel;
  gable_progress progress;
  void* progress_user;
} gable_derive_settings;
gable_status gable_derive_settings_init(gable_derive_settings* settings);

gable_status gable_derive(const gable_rules* rules, const gable_shapes* shapes,
                          const gable_derive_settings* settings, gable_model** model);

/* ---- Diagnostics of rules, shapes and models ---- */

typedef enum gable_severity { GABLE_NOTE = 0, GABLE_WARNING = 1, GABLE_ERROR = 2 } gable_severity;

typedef struct gable_diagnostic {
  size_t struct_size;
  gable_severity severity;
  /* From 1; all 0 when no text is to blame. */
  uint32_t line, column, end_line, end_column;
} gable_diagnostic;

typedef enum gable_diagnostic_text {
  GABLE_TEXT_CODE = 0,
  GABLE_TEXT_MESSAGE = 1,
  GABLE_TEXT_HINT = 2,
  GABLE_TEXT_FILE = 3,
  /* The rules from the initial shape down to where it happened. */
  GABLE_TEXT_SHAPE_PATH = 4,
  /* All of it with the line of text and a caret, as a terminal shows it. */
  GABLE_TEXT_RENDERED = 5
} gable_diagnostic_text;

/* `object` is a gable_rules, gable_shapes or gable_model. */
gable_status gable_diagnostic_count(const void* object, size_t* count);
gable_status gable_diagnostic_get(const void* object, size_t index, gable_diagnostic* diagnostic);
gable_status gable_diagnostic_get_text(const void* object, size_t index,
                                       gable_diagnostic_text which, char* buffer, size_t capacity,
                                       size_t* length);

/* ---- Models ---- */

typedef struct gable_statistics {
  size_t struct_size;
  /* Instances expanded. */
  uint64_t shapes, leaves, faces, vertices, triangles;
  uint64_t instances, prototypes, materials;
  /* 0 when the model is empty; the bounds are zero then. */
  int32_t has_bounds;
  double bounds_min[3], bounds_max[3];
  size_t report_count, print_count;
} gable_statistics;
gable_status gable_model_statistics(const gable_model* model, gable_statistics* statistics);

/* All values that rules reported under one key. */
typedef struct gable_report {
  size_t struct_size;
  uint64_t count;
  /* Other than 0 where values are numbers. */
  int32_t numbers;
  double sum, min, max;
  /* Different texts and bools; see gable_model_report_value. */
  size_t value_count;
} gable_report;
gable_status gable_model_report(const gable_model* model, size_t index, gable_report* report);
gable_status gable_model_report_key(const gable_model* model, size_t index, char* buffer,
                                    size_t capacity, size_t* length);
/* A text and how often it was reported. */
gable_status gable_model_report_value(const gable_model* model, size_t index, size_t value,
                                      char* buffer, size_t capacity, size_t* length,
                                      uint64_t* count);
/* What the rules printed, line by line. */
gable_status gable_model_print(const gable_model* model, size_t index, char* buffer,
                               size_t capacity, size_t* length);

/* How glTF files show parts that occur several times: by nodes, at most 20,000 of them, by a node
   each, by EXT_mesh_gpu_instancing, not at all, or by a mesh for each initial shape. */
typedef enum gable_instancing {
  GABLE_INSTANCING_AUTO = 0,
  GABLE_INSTANCING_NODES = 1,
  GABLE_INSTANCING_GPU = 2,
  GABLE_INSTANCING_NONE = 3,
  GABLE_INSTANCING_SHAPES = 4
} gable_instancing;

typedef struct gable_write_settings {
  size_t struct_size;
  /* A gable_instancing. */
  int32_t instancing;
  /* "godot": the choices for a program that opens the model (docs/guide/games.md). NULL: none. */
  const char* profile;
  /* Options of `gable generate` by name, over the profile: "collision" and "hull". */
  size_t option_count;
  const char* const* option_names;
  const char* const* option_values;
} gable_write_settings;
gable_status gable_write_settings_init(gable_write_settings* settings);
/* Writes .glb .gltf .obj .usda .usdz .ply .stl .city.json .city.jsonl .ifc, and .png for a picture,
   by extension. */
gable_status gable_model_write(const gable_model* model, const char* path,
                               const gable_write_settings* settings);
/* The same into memory, for formats of one file: "glb", "ply", "stl", "png". */
gable_status gable_model_encode(const gable_model* model, const char* format,
                                const gable_write_settings* settings, gable_blob** blob);
gable_status gable_blob_read(const gable_blob* blob, void* buffer, size_t capacity, size_t* length);

/* ---- Geometry: meshes, materials and placed leaves ---- */

/* At most `most_leaves` of the leaves, in path order, instances expanded. */
gable_status gable_model_geometry(const gable_model* model, uint64_t most_leaves,
                                  gable_geometry** geometry);

typedef struct gable_geometry_counts {
  size_t struct_size;
  size_t meshes, materials, leaves;
} gable_geometry_counts;
gable_status gable_geometry_count(const gable_geometry* geometry, gable_geometry_counts* counts);

typedef struct gable_mesh {
  size_t struct_size;
  size_t vertices, triangles, parts;
  int32_t has_uvs;
} gable_mesh;
gable_status gable_geometry_mesh(const gable_geometry* geometry, size_t mesh, gable_mesh* info);
/* Three numbers a vertex; uvs two, or none. In the mesh's own frame. */
gable_status gable_mesh_positions(const gable_geometry* geometry, size_t mesh, double* buffer,
                                  size_t capacity, size_t* length);
gable_status gable_mesh_normals(const gable_geometry* geometry, size_t mesh, float* buffer,
                                size_t capacity, size_t* length);
gable_status gable_mesh_uvs(const gable_geometry* geometry, size_t mesh, float* buffer,
                            size_t capacity, size_t* length);
/* Three vertices a triangle, counter-clockwise from outside. */
gable_status gable_mesh_triangles(const gable_geometry* geometry, size_t mesh, uint32_t* buffer,
                                  size_t capacity, size_t* length);
/* Three numbers a part: material slot, first triangle, number of triangles. */
gable_status gable_mesh_parts(const gable_geometry* geometry, size_t mesh, uint32_t* buffer,
                              size_t capacity, size_t* length);

typedef struct gable_leaf {
  size_t struct_size;
  size_t mesh;
  /* A point p of the mesh lies at origin + x p.x + y p.y + z p.z: origin, x, y, z. May mirror. */
  double transform[12];
} gable_leaf;
gable_status gable_geometry_leaf(const gable_geometry* geometry, size_t leaf, gable_leaf* info);
gable_status gable_leaf_name(const gable_geometry* geometry, size_t leaf, char* buffer,
                             size_t capacity, size_t* length);
/* Material numbers by slot; a slot beyond the end has the first. */
gable_status gable_leaf_materials(const gable_geometry* geometry, size_t leaf, uint32_t* buffer,
                                  size_t capacity, size_t* length);

typedef struct gable_material {
  size_t struct_size;
  double opacity, roughness, metallic;
  size_t textures;
} gable_material;
gable_status gable_geometry_material(const gable_geometry* geometry, size_t material,
                                     gable_material* info);
gable_status gable_material_name(const gable_geometry* geometry, size_t material, char* buffer,
                                 size_t capacity, size_t* length);
/* "#rrggbb", sRGB. */
gable_status gable_material_color(const gable_geometry* geometry, size_t material, char* buffer,
                                  size_t capacity, size_t* length);
/* The layer of a texture ("colormap", ...) and its path in the project. */
gable_status gable_material_texture_layer(const gable_geometry* geometry, size_t material,
                                          size_t texture, char* buffer, size_t capacity,
                                          size_t* length);
gable_status gable_material_texture_path(const gable_geometry* geometry, size_t material,
                                         size_t texture, char* buffer, size_t capacity,
                                         size_t* length);

#ifdef __cplusplus
}
#endif

#endif
