// Many boxes as lines, in one drawing: each has six numbers and a level that colours it.
import * as THREE from "three";

const corners = [0, 1, 2, 3, 4, 5, 6, 7, 0, 2, 1, 3, 4, 6, 5, 7, 0, 4, 1, 5, 2, 6, 3, 7];

// Empty and unbounded boxes are moved out of the picture.
const vertex_shader = `
attribute vec3 least;
attribute vec3 most;
attribute float level;
uniform float grow;
varying float level_of_line;
void main() {
  bool none = any(greaterThan(least, most)) || any(greaterThan(abs(most - least), vec3(1e30)));
  vec3 margin = grow * (most - least);
  vec3 place = mix(least - margin, most + margin, position);
  gl_Position = none ? vec4(2.0, 2.0, 2.0, 1.0) : projectionMatrix * viewMatrix * vec4(place, 1.0);
  level_of_line = level;
}`;

const fragment_shader = `
uniform vec3 colour;
uniform bool by_level;
varying float level_of_line;
void main() {
  vec3 of_level = 0.5 + 0.4 * cos(6.2832 * (0.17 * level_of_line + vec3(0.0, 0.33, 0.67)));
  gl_FragColor = vec4(by_level ? of_level : colour, 1.0);
}`;

export class Boxes {
  readonly object: THREE.LineSegments;
  private readonly geometry = new THREE.InstancedBufferGeometry();

  // `grow` draws boxes larger by that part of their size; without a colour they have that of their level.
  constructor(colour: number | null, grow = 0) {
    const points = corners.flatMap((corner) => [corner & 1, (corner >> 1) & 1, (corner >> 2) & 1]);
    this.geometry.setAttribute("position", new THREE.Float32BufferAttribute(points, 3));
    const material = new THREE.ShaderMaterial({
      vertexShader: vertex_shader,
      fragmentShader: fragment_shader,
      uniforms: {
        grow: { value: grow },
        colour: { value: new THREE.Color(colour ?? 0) },
        by_level: { value: colour === null },
      },
    });
    this.object = new THREE.LineSegments(this.geometry, material);
    this.object.frustumCulled = false;
    this.set(new Float32Array());
  }

  set(boxes: Float32Array, levels?: Uint8Array): void {
    const count = Math.floor(boxes.length / 6);
    const sides = new THREE.InstancedInterleavedBuffer(boxes, 6);
    this.geometry.dispose();
    this.geometry.setAttribute("least", new THREE.InterleavedBufferAttribute(sides, 3, 0));
    this.geometry.setAttribute("most", new THREE.InterleavedBufferAttribute(sides, 3, 3));
    const level = Float32Array.from({ length: count }, (_, i) => levels?.[i] ?? 0);
    this.geometry.setAttribute("level", new THREE.InstancedBufferAttribute(level, 1));
    this.geometry.instanceCount = count;
    this.object.visible = count > 0;
  }
}
