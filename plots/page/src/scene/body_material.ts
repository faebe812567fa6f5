// Bodies have the colour of their states while a scene plays, and a pattern for readers who do not see the
// colours.
import * as THREE from "three";
import { texel_of } from "./texels";

const light_from = "const vec3 beside_the_eye = vec3(0.27, 0.53, 0.8);";

// A body has two texels: where it is and what state it has in each view; then its quaternion, or the size
// of an upright box. A body that is absent has a negative state, and is moved out of the picture.
const vertex_shader = `
${light_from}
attribute float body;
uniform highp sampler2D bodies;
uniform float view_scale;
uniform bool upright;
flat varying float state;
#ifdef ROUND
varying float light;
#else
varying vec3 seen;
#endif

vec3 turned(vec4 turn, vec3 way) {
  return way + 2.0 * cross(turn.xyz, cross(turn.xyz, way) + turn.w * way);
}

void main() {
  ivec2 texel = ${texel_of("int(body)")};
  vec4 place = texelFetch(bodies, texel, 0);
  vec4 turn = texelFetch(bodies, texel + ivec2(1, 0), 0);
  vec3 from = upright ? turn.xyz * position : turned(turn, position);
  vec4 at = modelViewMatrix * vec4(place.xyz + from, 1.0);
  gl_Position = place.w < 0.0 ? vec4(2.0, 2.0, 2.0, 1.0) : projectionMatrix * at;
#ifdef ROUND
  light = dot(mat3(modelViewMatrix) * turned(turn, normal), beside_the_eye);
#else
  seen = at.xyz;
#endif
  state = mod(floor(place.w / view_scale), 4.0);
}`;

// The shader does little, since without a graphics card the processor runs it for every point of the picture. A
// pattern has eight rows of eight points, a bit each.
const fragment_shader = `
${light_from}
flat varying float state;
#ifdef ROUND
varying float light;
#else
varying vec3 seen;
#endif
uniform vec3 colours[3];
uniform float grain;
void main() {
  bool contact = state > 1.5, near = state > 0.5;
  uvec2 pixel = uvec2(gl_FragCoord.xy / grain) & 7u;
  bool low = pixel.y < 4u;
  uint rows = contact ? (low ? 0x1c1c0800u : 0x00000008u) : near ? (low ? 0x180c0603u : 0x81c06030u) : 0u;
  bool marked = ((rows >> ((pixel.y & 3u) * 8u + pixel.x)) & 1u) == 1u;
  vec3 ground = contact ? colours[2] : near ? colours[1] : colours[0];
  vec3 mark = mix(ground, vec3(1.0), 0.4);
#ifndef ROUND
  float light = dot(normalize(cross(dFdx(seen), dFdy(seen))), beside_the_eye);
#endif
  gl_FragColor = vec4((marked ? mark : ground) * (0.5 + 0.55 * max(light, 0.0)), 1.0);
}`;

// A palette has the colours of the three states: apart, boxes that overlap, contact. `touchstone scene draw` has those of
// the first.
export interface Palette {
  name: string;
  colours: [number, number, number];
  words: [string, string, string];
}

export const palettes: Palette[] = [
  {
    name: "grey, amber, red",
    colours: [0x9aa0a6, 0xe8b04a, 0xd23c32],
    words: ["Grey", "Amber", "Red"],
  },
  {
    name: "red, green, blue",
    colours: [0xcc473d, 0x3da357, 0x426bdb],
    words: ["Red", "Green", "Blue"],
  },
];

// What the materials of all bodies share.
export class Look {
  readonly colours = { value: [0, 1, 2].map(() => new THREE.Color()) };
  readonly grain = { value: 1 }; // points of the picture for one of the pattern, on each axis

  constructor() {
    this.wear(palettes[0]!);
  }

  // The shader gives colours to the screen as they are.
  wear({ colours }: Palette): void {
    colours.forEach((colour, state) =>
      this.colours.value[state]!.setHex(colour, THREE.LinearSRGBColorSpace),
    );
  }
}

// One number in a body's texel says both of its states: that of the left view, and that of the right one.
export const packed_states = (left: number, right: number): number => left + 4 * right;

// Round bodies are lit at their vertices, and look smooth; all others are lit by their faces.
export const body_material = (
  bodies: THREE.DataTexture,
  view: number,
  { upright, round }: { upright: boolean; round: boolean },
  { colours, grain }: Look,
): THREE.Material =>
  new THREE.ShaderMaterial({
    defines: round ? { ROUND: "" } : {},
    vertexShader: vertex_shader,
    fragmentShader: fragment_shader,
    uniforms: {
      bodies: { value: bodies },
      view_scale: { value: view === 0 ? packed_states(1, 0) : packed_states(0, 1) },
      upright: { value: upright },
      colours,
      grain,
    },
  });
