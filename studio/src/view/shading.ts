// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Materials of batches. Colour is data of each vertex or instance, and every fragment knows its
// leaf, so that marking and picking need no other geometry.

import * as THREE from 'three';
import type { Look } from '../lib/protocol';

/** Shared by all materials: setting one value marks everywhere. */
export interface Marks {
  /** Leaves from, to; empty where from is not below to. */
  selected: { value: THREE.Vector2 };
  accent: { value: THREE.Color };
  /** The share of rooms behind glass with light in them. */
  lit: { value: number };
  /** The step that is shown; only materials of a derivation in steps look at it. */
  guideStep: { value: number };
}

const HEAD = `
attribute vec4 tint;
attribute float leaf;
varying vec3 vTint;
flat varying float vLeaf;
`;
const LEAF = `
float leafOfMesh = leaf;
vLeaf = leafOfMesh;
vTint = pow(tint.rgb, vec3(2.2));
`;

/** Light in the room behind a pane, by its leaf. What lies flat is water; cars have theirs lean. */
const LIT_ROOM = `
#include <emissivemap_fragment>
float room = fract(mod(vLeaf, 1024.0) * 0.6180340 + floor(vLeaf / 1024.0) * 0.3770);
if (room < lit && abs(inverseTransformDirection(normal, viewMatrix).y) < 0.25)
  totalEmissiveRadiance += vec3(1.0, 0.69, 0.36) * (0.3 + 0.5 * fract(room * 57.0));
`;

/** A derivation in steps: each vertex or instance knows from and up to which step it is there. */
const STEPPED_HEAD = `
attribute vec2 life;
uniform float guideStep;
varying float vFresh;
`;
const STEPPED = `
vFresh = guideStep > 0.5 && abs(life.x - guideStep) < 0.5 ? 1.0 : 0.0;
if (guideStep + 0.5 < life.x || guideStep + 0.5 > life.y) gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
`;

/**
 * Three's look-up of hard shadows, with a second way for lights of a radius above zero: four by
 * four texels below a tent, so that the edge of a shadow is soft and shows no texels.
 */
export function softened(fragmentShader: string): string {
  const hard = 'shadow = texture2DCompare( shadowMap, shadowCoord.xy, shadowCoord.z );';
  return fragmentShader.replace(
    '#include <shadowmap_pars_fragment>',
    THREE.ShaderChunk.shadowmap_pars_fragment.replace(
      hard,
      `
    if (shadowRadius < 0.01) {
      ${hard}
    } else {
      vec2 place = shadowCoord.xy * shadowMapSize - 0.5;
      vec2 part = fract(place);
      vec2 corner = floor(place) - 0.5;
      shadow = 0.0;
      for (int y = 0; y < 4; ++y) {
        for (int x = 0; x < 4; ++x) {
          vec2 d = 2.0 - abs(vec2(float(x), float(y)) - 1.0 - part);
          vec2 w = clamp(d * 0.5, 0.0, 1.0);
          vec2 texel = (corner + vec2(float(x), float(y))) / shadowMapSize;
          shadow += w.x * w.y * texture2DCompare( shadowMap, texel, shadowCoord.z );
        }
      }
      shadow *= 0.25;
    }`,
    ),
  );
}

/** Casts the shadows of what is there at a step. */
export function steppedShadow(marks: Marks): THREE.MeshDepthMaterial {
  const material = new THREE.MeshDepthMaterial({
    depthPacking: THREE.RGBADepthPacking,
    side: THREE.DoubleSide,
  });
  material.onBeforeCompile = (shader) => {
    shader.uniforms.guideStep = marks.guideStep;
    shader.vertexShader =
      STEPPED_HEAD +
      shader.vertexShader.replace(
        '#include <project_vertex>',
        '#include <project_vertex>' + STEPPED,
      );
  };
  material.customProgramCacheKey = () => 'stepped shadow';
  return material;
}

/** A material of a look; textures come later, by name. */
export function lookMaterial(look: Look, marks: Marks, stepped = false): THREE.MeshLambertMaterial {
  const opacity = look.opacity ?? 1;
  const material = new THREE.MeshLambertMaterial({
    side: THREE.DoubleSide,
    transparent: opacity < 1,
    opacity,
    depthWrite: opacity > 0.9,
    alphaTest: look.cutoff ?? 0,
  });
  if (look.emissive) material.emissive.setHex(swapRgb(look.emissive));
  const metal = look.metallic;
  // Smooth enough for a window, as the path tracer has it.
  const pane = look.roughness <= 0.2 && metal < 0.5 && !look.emissive;
  material.onBeforeCompile = (shader) => {
    shader.uniforms.selected = marks.selected;
    shader.uniforms.accent = marks.accent;
    shader.uniforms.lit = marks.lit;
    shader.vertexShader =
      HEAD + shader.vertexShader.replace('#include <uv_vertex>', LEAF + '#include <uv_vertex>');
    if (stepped) {
      shader.uniforms.guideStep = marks.guideStep;
      shader.vertexShader =
        STEPPED_HEAD +
        shader.vertexShader.replace(
          '#include <project_vertex>',
          '#include <project_vertex>' + STEPPED,
        );
    }
    shader.fragmentShader =
      (stepped ? 'varying float vFresh;\n' : '') +
      'varying vec3 vTint;\nflat varying float vLeaf;\n' +
      'uniform vec2 selected;\nuniform vec3 accent;\nuniform float lit;\n' +
      softened(shader.fragmentShader)
        .replace('#include <emissivemap_fragment>', pane ? LIT_ROOM : '$&')
        .replace(
          '#include <map_fragment>',
          `diffuseColor.rgb *= vTint;
         ${metal > 0.4 ? 'diffuseColor.rgb *= 0.82;' : ''}
         if (vLeaf + 0.5 > selected.x && vLeaf + 0.5 < selected.y)
           diffuseColor.rgb = mix(diffuseColor.rgb, accent, 0.06);
         ${stepped ? 'diffuseColor.rgb = mix(diffuseColor.rgb, accent, 0.75 * vFresh);' : ''}
         #include <map_fragment>`,
        );
  };
  const kind = (metal > 0.4 ? 'm' : '') + (stepped ? 's' : '') + (pane ? 'p' : '');
  material.customProgramCacheKey = () => `look${kind}`;
  return material;
}

/** Little-endian bytes r, g, b to 0xrrggbb. */
export function swapRgb(value: number): number {
  return ((value & 0xff) << 16) | (value & 0xff00) | ((value >> 16) & 0xff);
}

/**
 * Draws leaf numbers, from 1, as colours, and the direction of the face in alpha, so that edges
 * within a leaf show as well. Nothing is blended: a pixel belongs to one leaf. Nor are numbers
 * interpolated, which those of millions of leaves would not survive.
 */
export function leafMaterial(
  instanced: boolean,
  marks: Marks,
  stepped = false,
): THREE.ShaderMaterial {
  return new THREE.ShaderMaterial({
    side: THREE.DoubleSide,
    blending: THREE.NoBlending,
    uniforms: { guideStep: marks.guideStep },
    vertexShader: `
      ${stepped ? STEPPED_HEAD : ''}
      attribute float leaf;
      flat varying float vLeaf;
      varying vec3 vWorld;
      void main() {
        vLeaf = leaf + 1.0;
        vec4 p = vec4(position, 1.0);
        ${instanced ? 'p = instanceMatrix * p;' : ''}
        p = modelMatrix * p;
        // From the eye, so that far from the origin nothing is lost.
        vWorld = p.xyz - cameraPosition;
        gl_Position = projectionMatrix * viewMatrix * p;
        ${stepped ? STEPPED : ''}
      }`,
    fragmentShader: `
      flat varying float vLeaf;
      varying vec3 vWorld;
      void main() {
        float n = floor(vLeaf + 0.5);
        vec3 d = normalize(cross(dFdx(vWorld), dFdy(vWorld)));
        float face = (d.x * 0.31 + d.y * 0.43 + d.z * 0.57) * 0.35 + 0.6;
        vec3 bytes = vec3(mod(n, 256.0), mod(floor(n / 256.0), 256.0), floor(n / 65536.0));
        gl_FragColor = vec4(bytes / 255.0, face);
      }`,
  });
}

/**
 * Draws heights over a base, in 65536ths of a metre up to 256 m, as three bytes; alpha tells of
 * any.
 */
export function heightMaterial(instanced: boolean): THREE.ShaderMaterial {
  return new THREE.ShaderMaterial({
    side: THREE.DoubleSide,
    blending: THREE.NoBlending,
    uniforms: { base: { value: 0 }, range: { value: 256 } },
    vertexShader: `
      varying float vHeight;
      void main() {
        vec4 p = vec4(position, 1.0);
        ${instanced ? 'p = instanceMatrix * p;' : ''}
        p = modelMatrix * p;
        vHeight = p.y;
        gl_Position = projectionMatrix * viewMatrix * p;
      }`,
    fragmentShader: `
      varying float vHeight;
      uniform float base;
      uniform float range;
      void main() {
        float h = clamp((vHeight - base) / range, 0.0, 0.999999) * 16777216.0;
        vec3 bytes = vec3(floor(h / 65536.0), mod(floor(h / 256.0), 256.0), mod(floor(h), 256.0));
        gl_FragColor = vec4(bytes / 255.0, 1.0);
      }`,
  });
}

/** A dome of sky: paler towards the horizon, brighter towards the sun. */
export function skyMaterial(): THREE.ShaderMaterial {
  return new THREE.ShaderMaterial({
    side: THREE.BackSide,
    depthWrite: false,
    depthTest: false,
    fog: false,
    uniforms: {
      horizon: { value: new THREE.Color() },
      zenith: { value: new THREE.Color() },
      sun: { value: new THREE.Vector3(0, 1, 0) },
      disc: { value: 1 },
    },
    vertexShader: `
      varying vec3 vAt;
      void main() {
        vAt = position;
        gl_Position = projectionMatrix * mat4(mat3(viewMatrix)) * vec4(position, 1.0);
        gl_Position.z = gl_Position.w * 0.99999;
      }`,
    fragmentShader: `
      uniform vec3 horizon;
      uniform vec3 zenith;
      uniform vec3 sun;
      uniform float disc;
      varying vec3 vAt;
      void main() {
        vec3 d = normalize(vAt);
        vec3 c = mix(horizon, zenith, smoothstep(0.0, 0.55, d.y));
        float near = max(0.0, dot(d, sun));
        float orb = 0.9 * smoothstep(0.9993, 0.9996, near);
        c += disc * vec3(1.0, 0.86, 0.62) * (0.16 * pow(near, 24.0) + orb);
        gl_FragColor = vec4(c, 1.0);
        #include <colorspace_fragment>
      }`,
  });
}

/** Lays outlines of marked leaves and thin edges between leaves over a picture. */
export function outlineMaterial(): THREE.ShaderMaterial {
  return new THREE.ShaderMaterial({
    transparent: true,
    depthTest: false,
    depthWrite: false,
    uniforms: {
      leaves: { value: null },
      texel: { value: new THREE.Vector2() },
      selected: { value: new THREE.Vector2() },
      hovered: { value: new THREE.Vector2() },
      accent: { value: new THREE.Color() },
      text: { value: new THREE.Color() },
      edges: { value: 0.0 },
    },
    vertexShader:
      'varying vec2 vUv; void main() { vUv = uv; gl_Position = vec4(position.xy, 0.0, 1.0); }',
    fragmentShader: `
      uniform sampler2D leaves;
      uniform vec2 texel;
      uniform vec2 selected;
      uniform vec2 hovered;
      uniform vec3 accent;
      uniform vec3 text;
      uniform float edges;
      varying vec2 vUv;
      float number(vec4 c) {
        return dot(floor(c.rgb * 255.0 + 0.5), vec3(1.0, 256.0, 65536.0)) - 1.0;
      }
      float within(float n, vec2 range) { return step(range.x, n) * (1.0 - step(range.y, n)); }
      void main() {
        vec4 here = texture2D(leaves, vUv);
        float n = number(here);
        float s = within(n, selected), h = within(n, hovered);
        float sEdge = 0.0, hEdge = 0.0, fold = 0.0;
        for (int i = 0; i < 8; ++i) {
          float a = float(i) * 0.7853982;
          vec4 there = texture2D(leaves, vUv + vec2(cos(a), sin(a)) * texel * 1.5);
          float m = number(there);
          sEdge += abs(s - within(m, selected));
          hEdge += abs(h - within(m, hovered));
        }
        if (edges > 0.0) {
          vec4 right = texture2D(leaves, vUv + vec2(texel.x, 0.0));
          vec4 up = texture2D(leaves, vUv + vec2(0.0, texel.y));
          fold = step(0.5, abs(number(right) - n)) + step(0.5, abs(number(up) - n));
          fold += step(0.03, abs(right.a - here.a)) + step(0.03, abs(up.a - here.a));
          fold = min(fold, 1.0) * (n < 0.0 ? 0.0 : 1.0);
        }
        float selectedLine = smoothstep(0.0, 2.5, sEdge), hoveredLine = smoothstep(0.0, 4.0, hEdge);
        if (selectedLine > 0.0) gl_FragColor = vec4(accent, selectedLine);
        else if (hoveredLine > 0.0) gl_FragColor = vec4(text, hoveredLine * 0.9);
        else gl_FragColor = vec4(0.03, 0.035, 0.04, fold * edges);
        #include <colorspace_fragment>
      }`,
  });
}

/** Ground with a grid of `step` metres that fades out from a centre. */
export function groundMaterial(): THREE.ShaderMaterial {
  return new THREE.ShaderMaterial({
    transparent: true,
    depthWrite: false,
    uniforms: {
      line: { value: new THREE.Color() },
      centre: { value: new THREE.Vector2() },
      reach: { value: 50 },
      cell: { value: 10 },
    },
    vertexShader: `
      varying vec3 vWorld;
      void main() {
        vec4 p = modelMatrix * vec4(position, 1.0);
        vWorld = p.xyz;
        gl_Position = projectionMatrix * viewMatrix * p;
      }`,
    fragmentShader: `
      uniform vec3 line;
      uniform vec2 centre;
      uniform float reach;
      uniform float cell;
      varying vec3 vWorld;
      void main() {
        vec2 at = vWorld.xz / cell;
        vec2 width = fwidth(at);
        vec2 d = abs(fract(at - 0.5) - 0.5) / max(width, vec2(1e-5));
        float on = 1.0 - smoothstep(0.3, 1.1, min(d.x, d.y));
        on *= 1.0 - smoothstep(0.25, 0.6, max(width.x, width.y));
        float fade = 1.0 - smoothstep(reach * 0.45, reach, distance(vWorld.xz, centre));
        gl_FragColor = vec4(line, on * fade * 0.5);
        #include <colorspace_fragment>
      }`,
  });
}

/** Writes the depth that a depth texture has at a place, as three bytes. */
export function depthMaterial(): THREE.ShaderMaterial {
  return new THREE.ShaderMaterial({
    depthTest: false,
    depthWrite: false,
    blending: THREE.NoBlending,
    uniforms: { depths: { value: null }, place: { value: new THREE.Vector2() } },
    vertexShader: 'void main() { gl_Position = vec4(position.xy, 0.0, 1.0); }',
    fragmentShader: `
      uniform sampler2D depths;
      uniform vec2 place;
      void main() {
        float d = clamp(texture2D(depths, place).r, 0.0, 0.9999999) * 16777216.0;
        vec3 bytes = vec3(floor(d / 65536.0), mod(floor(d / 256.0), 256.0), mod(floor(d), 256.0));
        gl_FragColor = vec4(bytes / 255.0, 1.0);
      }`,
  });
}
