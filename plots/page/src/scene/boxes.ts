// Many boxes are drawn as lines by one call. The shader makes the lines from a texture, which has two texels for
// each box: its least corner with a level that colours it, and its greatest corner.
import * as THREE from "three";
import { numbers_of, texel_of, texels_for } from "./texels";

const ends_of_a_box = 24; // ends of its twelve edges

// Each axis has four edges. Empty and unbounded boxes are moved out of the picture.
const vertex_shader = `
uniform highp sampler2D boxes;
uniform float grow;
flat varying float level;
void main() {
  int box = gl_VertexID / ${ends_of_a_box}, end = gl_VertexID % ${ends_of_a_box};
  ivec2 texel = ${texel_of("box")};
  vec4 least = texelFetch(boxes, texel, 0), most = texelFetch(boxes, texel + ivec2(1, 0), 0);
  int axis = end / 8;
  vec3 corner = vec3(end & 1, (end >> 1) & 1, (end >> 2) & 1);
  corner = axis == 0 ? corner : axis == 1 ? corner.zxy : corner.yzx;
  bool none = any(greaterThan(least.xyz, most.xyz)) || any(greaterThan(abs(most.xyz - least.xyz), vec3(1e30)));
  vec3 margin = grow * (most.xyz - least.xyz);
  vec3 place = mix(least.xyz - margin, most.xyz + margin, corner);
  gl_Position = none ? vec4(2.0, 2.0, 2.0, 1.0) : projectionMatrix * viewMatrix * vec4(place, 1.0);
  level = least.w;
}`;

const fragment_shader = `
uniform vec3 colour;
uniform bool by_level;
flat varying float level;
void main() {
  // No level has the magenta of marks.
  float hue = 1.0 - 0.6 * fract(0.17 * level + 0.2);
  vec3 of_level = 0.5 + 0.4 * cos(6.2832 * (hue + vec3(0.0, 0.33, 0.67)));
  gl_FragColor = vec4(by_level ? of_level : colour, 1.0);
}`;

export class Boxes {
  readonly object: THREE.LineSegments<THREE.BufferGeometry, THREE.ShaderMaterial>;
  private texture: THREE.DataTexture | null = null;

  // `grow` draws boxes larger by that part of their size. Without a colour they have that of their level. Marks are
  // seen through what is before them.
  constructor(colour: number | null, grow = 0, is_mark = false) {
    const material = new THREE.ShaderMaterial({
      vertexShader: vertex_shader,
      fragmentShader: fragment_shader,
      depthTest: !is_mark,
      uniforms: {
        boxes: { value: null },
        grow: { value: grow },
        // The shader gives colours to the screen as they are.
        colour: { value: new THREE.Color().setHex(colour ?? 0, THREE.LinearSRGBColorSpace) },
        by_level: { value: colour === null },
      },
    });
    this.object = new THREE.LineSegments(new THREE.BufferGeometry(), material);
    this.object.frustumCulled = false;
    this.object.renderOrder = is_mark ? 1 : 0;
    this.object.visible = false;
  }

  set(boxes: Float32Array, levels?: Uint8Array): void {
    const count = Math.floor(boxes.length / 6);
    this.object.visible = count > 0;
    if (count === 0) return;
    const texture = this.texture_for(count);
    const numbers = numbers_of(texture);
    for (let box = 0; box < count; ++box) {
      for (let axis = 0; axis < 3; ++axis) {
        numbers[8 * box + axis] = boxes[6 * box + axis]!;
        numbers[8 * box + 4 + axis] = boxes[6 * box + 3 + axis]!;
      }
      numbers[8 * box + 3] = levels?.[box] ?? 0;
    }
    texture.needsUpdate = true;
    this.object.geometry.setDrawRange(0, ends_of_a_box * count);
  }

  // A structure has other numbers of boxes in other frames. The texture grows, and does not shrink.
  private texture_for(count: number): THREE.DataTexture {
    if (this.texture && numbers_of(this.texture).length >= 8 * count) return this.texture;
    this.texture?.dispose();
    this.texture = texels_for(count);
    this.object.material.uniforms["boxes"]!.value = this.texture;
    return this.texture;
  }
}
