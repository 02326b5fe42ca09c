// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Ambient: how much less light of the sky gets into corners, from the depths of a picture alone.
// Places too large to be drawn again and again from all parts of the sky get it, once they stand
// still. Half the pixels each way look around themselves (McGuire, Mara and Luebke, "Scalable
// Ambient Obscurance"); what they find is smoothed within surfaces and multiplied into the picture.

import * as THREE from 'three';

const SAMPLES = 14;
/** Metres within which something darkens a corner, at least, and pixels at least and at most. */
const LEAST_METRES = 2.5;
const LEAST_PIXELS = 9;
const MOST_PIXELS = 40;
const STRENGTH = 1.5;

const SCREEN =
  'varying vec2 vUv; void main() { vUv = uv; gl_Position = vec4(position.xy, 0.0, 1.0); }';

/** Metres in front of the camera, from what a depth buffer holds. */
const DISTANCE = `
  uniform vec2 range;
  float distanceAt(float depth) {
    return range.x * range.y / (range.y - depth * (range.y - range.x));
  }
`;

export class Ambient {
  private readonly target = new THREE.WebGLRenderTarget(1, 1, {
    type: THREE.HalfFloatType,
    minFilter: THREE.NearestFilter,
    magFilter: THREE.NearestFilter,
    depthBuffer: false,
  });
  private readonly flat = new THREE.OrthographicCamera(-1, 1, 1, -1, 0, 1);
  private readonly look: THREE.Mesh<THREE.PlaneGeometry, THREE.ShaderMaterial>;
  private readonly darken: THREE.Mesh<THREE.PlaneGeometry, THREE.ShaderMaterial>;

  constructor(private readonly renderer: THREE.WebGLRenderer) {
    const range = { value: new THREE.Vector2() };
    const depths = { value: null };
    const quad = (material: THREE.ShaderMaterial) => {
      const mesh = new THREE.Mesh(new THREE.PlaneGeometry(2, 2), material);
      mesh.frustumCulled = false;
      return mesh;
    };
    this.look = quad(lookMaterial(range, depths));
    this.darken = quad(darkenMaterial(this.target.texture, range, depths));
  }

  /** Reads the depths that a camera saw, on a picture of so many pixels. */
  read(depths: THREE.DepthTexture, camera: THREE.PerspectiveCamera, size: THREE.Vector2): void {
    const half = new THREE.Vector2(Math.ceil(size.x / 2), Math.ceil(size.y / 2));
    this.target.setSize(half.x, half.y);
    const tangent = Math.tan((camera.fov * Math.PI) / 360);
    const u = this.look.material.uniforms;
    u.depths!.value = depths;
    (u.range!.value as THREE.Vector2).set(camera.near, camera.far);
    (u.tangent!.value as THREE.Vector2).set(tangent * camera.aspect, tangent);
    (u.texel!.value as THREE.Vector2).set(1 / size.x, 1 / size.y);
    u.pixel!.value = (2 * tangent) / size.y;
    const d = this.darken.material.uniforms;
    (d.pixels!.value as THREE.Vector2).copy(half);
    this.renderer.setRenderTarget(this.target);
    this.renderer.render(this.look, this.flat);
    this.renderer.setRenderTarget(null);
  }

  /** Darkens what is on the canvas. */
  draw(): void {
    this.renderer.render(this.darken, this.flat);
  }

  dispose(): void {
    this.target.dispose();
    this.look.material.dispose();
    this.darken.material.dispose();
  }
}

/** Writes how open each point is, and its distance. */
function lookMaterial(range: THREE.IUniform, depths: THREE.IUniform): THREE.ShaderMaterial {
  return new THREE.ShaderMaterial({
    depthTest: false,
    depthWrite: false,
    blending: THREE.NoBlending,
    uniforms: {
      range,
      depths,
      tangent: { value: new THREE.Vector2() },
      texel: { value: new THREE.Vector2() },
      pixel: { value: 0 },
    },
    vertexShader: SCREEN,
    fragmentShader: `
      uniform sampler2D depths;
      uniform vec2 tangent;
      uniform vec2 texel;
      uniform float pixel;
      varying vec2 vUv;
      ${DISTANCE}
      vec3 at(vec2 uv) {
        float z = distanceAt(texture2D(depths, uv).r);
        return vec3((uv * 2.0 - 1.0) * tangent * z, -z);
      }
      vec3 nearer(vec3 a, vec3 b) { return abs(a.z) < abs(b.z) ? a : b; }
      void main() {
        float depth = texture2D(depths, vUv).r;
        vec3 p = at(vUv);
        if (depth > 0.999999) { gl_FragColor = vec4(1.0, range.y, 0.0, 1.0); return; }
        // The normal of the side on which the surface goes on.
        vec3 across = nearer(at(vUv + vec2(texel.x, 0.0)) - p, p - at(vUv - vec2(texel.x, 0.0)));
        vec3 up = nearer(at(vUv + vec2(0.0, texel.y)) - p, p - at(vUv - vec2(0.0, texel.y)));
        vec3 n = normalize(cross(across, up));
        float metre = 1.0 / (pixel * -p.z);
        float least = ${LEAST_PIXELS.toFixed(1)}, most = ${MOST_PIXELS.toFixed(1)};
        float reach = clamp(${LEAST_METRES.toFixed(1)} * metre, least, most);
        float radius = reach / metre;
        vec2 cell = mod(gl_FragCoord.xy, 4.0);
        float turn = (cell.x + 4.0 * cell.y) * 2.399963;
        float sum = 0.0;
        for (int i = 0; i < ${SAMPLES}; ++i) {
          float share = (float(i) + 0.5) / ${SAMPLES.toFixed(1)};
          float angle = share * 43.98 + turn;
          vec3 v = at(vUv + vec2(cos(angle), sin(angle)) * share * reach * texel) - p;
          float vv = dot(v, v);
          // What is far in front of the surface hides nothing of its sky.
          float fall = max(0.0, 1.0 - vv / (radius * radius * 2.0));
          sum += max(0.0, dot(v, n) - 0.012 * radius) * inversesqrt(vv + 1e-4) * fall;
        }
        float open = max(0.0, 1.0 - sum * ${STRENGTH.toFixed(2)} / ${SAMPLES.toFixed(1)});
        gl_FragColor = vec4(open, -p.z, 0.0, 1.0);
      }`,
  });
}

/** Multiplies the openness, smoothed over four by four pixels of about the same distance. */
function darkenMaterial(
  open: THREE.Texture,
  range: THREE.IUniform,
  depths: THREE.IUniform,
): THREE.ShaderMaterial {
  return new THREE.ShaderMaterial({
    depthTest: false,
    depthWrite: false,
    transparent: true,
    blending: THREE.CustomBlending,
    blendSrc: THREE.ZeroFactor,
    blendDst: THREE.SrcColorFactor,
    uniforms: { open: { value: open }, range, depths, pixels: { value: new THREE.Vector2(1, 1) } },
    vertexShader: SCREEN,
    fragmentShader: `
      uniform sampler2D open;
      uniform sampler2D depths;
      uniform vec2 pixels;
      varying vec2 vUv;
      ${DISTANCE}
      void main() {
        float depth = texture2D(depths, vUv).r;
        if (depth > 0.999999) discard;
        float here = distanceAt(depth);
        // As much as the surface itself falls away over these pixels is no other surface.
        float same = here * 0.003 + 4.0 * min(fwidth(here), here * 0.02);
        vec2 base = floor(vUv * pixels - 1.5) + 0.5;
        float sum = 0.0, weights = 0.0;
        for (int i = 0; i < 16; ++i) {
          vec2 aside = vec2(mod(float(i), 4.0), floor(float(i) / 4.0));
          vec2 there = texture2D(open, (base + aside) / pixels).rg;
          float w = min(1.0, same / (1e-4 + 2.0 * abs(there.y - here)));
          sum += there.x * w;
          weights += w;
        }
        // The picture is in sRGB by now.
        gl_FragColor = vec4(vec3(pow(weights > 0.0 ? sum / weights : 1.0, 0.4545)), 1.0);
      }`,
  });
}
