// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// City models and building models, read by programs of others: CityJSON by the parser of cityjson-threejs-loader,
// which triangulates what it reads, IFC by web-ifc. validate.mjs asks for whether they are clean, figures.mjs for what
// is in them.
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { join } from "node:path";
import { pathToFileURL } from "node:url";

/** Twice the area of a triangle. */
function twiceArea(a, b, c) {
  const u = [0, 1, 2].map((i) => b[i] - a[i]);
  const v = [0, 1, 2].map((i) => c[i] - a[i]);
  return Math.hypot(u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]);
}

/** Square metres of a list of surfaces, by the vector areas of their rings. */
function areaOf(surface, vertices, scale) {
  let sum = 0;
  for (const [r, ring] of surface.entries()) {
    const at = (i) => vertices[ring[i]].map((c, k) => c * scale[k]);
    const total = [0, 0, 0];
    const o = at(0);
    for (let i = 2; i < ring.length; i++) {
      const p = at(i - 1).map((c, k) => c - o[k]);
      const q = at(i).map((c, k) => c - o[k]);
      total[0] += p[1] * q[2] - p[2] * q[1];
      total[1] += p[2] * q[0] - p[0] * q[2];
      total[2] += p[0] * q[1] - p[1] * q[0];
    }
    sum += (r ? -1 : 1) * (Math.hypot(...total) / 2);
  }
  return sum;
}

/** What the parser makes of a model: objects, triangles, and square metres by semantic surface and level of detail. */
export async function readCity(home, path) {
  const folder = join(home, "node_modules/cityjson-threejs-loader/src/parsers/geometry");
  const { TriangleParser } = await import(pathToFileURL(join(folder, "TriangleParser.js")));
  const model = JSON.parse(readFileSync(path, "utf8"));
  const scale = model.transform.scale;
  const metres = (v) => v.map((c, k) => c * scale[k]);
  const out = { objects: {}, triangles: 0, area: 0, areas: {}, wrong: [] };
  for (const [id, object] of Object.entries(model.CityObjects)) {
    out.objects[object.type] = (out.objects[object.type] ?? 0) + 1;
    for (const [index, geometry] of (object.geometry ?? []).entries()) {
      if (geometry.type === "GeometryInstance") continue;
      const parser = new TriangleParser(model, Object.keys(model.CityObjects), {});
      parser.lods = [];
      parser.parseGeometry(geometry, id, index);
      const { vertexIds, semanticSurfaces } = parser.geomData;
      let area = 0;
      for (let i = 0; i < vertexIds.length; i += 3) {
        const own = twiceArea(...[0, 1, 2].map((k) => metres(model.vertices[vertexIds[i + k]]))) / 2;
        const surface = Object.keys(parser.surfaceColors ?? {})[semanticSurfaces[i]];
        const key = `${surface ?? "none"} ${geometry.lod}`;
        out.areas[key] = (out.areas[key] ?? 0) + own;
        area += own;
      }
      out.triangles += vertexIds.length / 3;
      out.area += area;
      const deep = { Solid: 1, MultiSolid: 2 }[geometry.type] ?? 0;
      const surfaces = geometry.boundaries.flat(deep);
      const said = surfaces.reduce((sum, s) => sum + areaOf(s, model.vertices, scale), 0);
      if (!(Math.abs(area - said) <= 1e-3 * said + 1e-2)) {
        out.wrong.push(`${id} lod ${geometry.lod}: ${area.toFixed(3)} m2 as triangles, ${said.toFixed(3)} as polygons`);
      }
    }
  }
  return out;
}

/** What web-ifc finds in a model: elements by class, triangles, the box of all, in metres, z up. */
export async function readIfc(home, path) {
  const WebIFC = createRequire(join(home, "package.json"))("web-ifc");
  const api = new WebIFC.IfcAPI();
  await api.Init();
  api.SetLogLevel(WebIFC.LogLevel.LOG_LEVEL_OFF);
  const model = api.OpenModel(new Uint8Array(readFileSync(path)), { COORDINATE_TO_ORIGIN: false });
  const out = { schema: api.GetModelSchema(model), elements: {}, triangles: 0, wrong: [] };
  const classes = ["IFCPROJECT", "IFCSITE", "IFCBUILDING", "IFCBUILDINGSTOREY", "IFCWALL", "IFCSLAB", "IFCROOF"];
  classes.push("IFCWINDOW", "IFCDOOR", "IFCSTAIR", "IFCRAILING", "IFCCOLUMN", "IFCBEAM", "IFCCOVERING", "IFCCHIMNEY");
  classes.push("IFCFURNITURE", "IFCGEOGRAPHICELEMENT", "IFCCIVILELEMENT", "IFCBUILDINGELEMENTPROXY", "IFCMATERIAL");
  classes.push("IFCPROPERTYSET", "IFCMAPPEDITEM");
  for (const name of classes) {
    const found = api.GetLineIDsWithType(model, WebIFC[name]);
    if (found.size() > 0) out.elements[name] = found.size();
    // Reading a line holds it against the schema: its references are there and of the right kind.
    for (let i = 0; i < Math.min(found.size(), 2000); i++) {
      const line = api.GetLine(model, found.get(i));
      if (line.GlobalId && !/^[0-3][0-9A-Za-z_$]{21}$/.test(line.GlobalId.value)) out.wrong.push(`${name}: GlobalId`);
    }
  }
  const guids = new Set();
  const low = [Infinity, Infinity, Infinity];
  const high = [-Infinity, -Infinity, -Infinity];
  api.StreamAllMeshes(model, (mesh) => {
    const id = api.GetLine(model, mesh.expressID).GlobalId.value;
    if (guids.has(id)) out.wrong.push(`two elements are ${id}`);
    guids.add(id);
    for (let g = 0; g < mesh.geometries.size(); g++) {
      const placed = mesh.geometries.get(g);
      const shape = api.GetGeometry(model, placed.geometryExpressID);
      const vertices = api.GetVertexArray(shape.GetVertexData(), shape.GetVertexDataSize());
      const indices = api.GetIndexArray(shape.GetIndexData(), shape.GetIndexDataSize());
      out.triangles += indices.length / 3;
      const m = placed.flatTransformation;
      for (const i of indices) {
        const p = [0, 1, 2].map((k) => vertices[6 * i + k]);
        // web-ifc turns models so that y points up.
        const at = [0, 1, 2].map((r) => m[r] * p[0] + m[4 + r] * p[1] + m[8 + r] * p[2] + m[12 + r]);
        for (let k = 0; k < 3; k++) {
          low[k] = Math.min(low[k], at[k]);
          high[k] = Math.max(high[k], at[k]);
        }
      }
      shape.delete();
    }
  });
  out.box = { min: low, max: high };
  out.withShape = guids.size;
  api.CloseModel(model);
  if (!out.schema.startsWith("IFC4")) out.wrong.push(`the schema is ${out.schema}`);
  if (out.elements.IFCPROJECT !== 1 || out.elements.IFCSITE !== 1) out.wrong.push("a project and a site");
  return out;
}
