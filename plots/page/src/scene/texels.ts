// A texture hands the shaders eight numbers for each body or box. Its rows are short, because a texture has a
// greatest width.
import * as THREE from "three";

export const in_a_row = 256; // bodies or boxes in a row

export const numbers_of = (texture: THREE.DataTexture): Float32Array =>
  texture.image.data as Float32Array;

export function texels_for(count: number): THREE.DataTexture {
  const rows = Math.max(1, Math.ceil(count / in_a_row));
  const numbers = new Float32Array(8 * in_a_row * rows);
  return new THREE.DataTexture(
    numbers,
    2 * in_a_row,
    rows,
    THREE.RGBAFormat,
    THREE.FloatType,
  );
}

// The two texels of a body or a box are at this place and right of it.
export const texel_of = (number: string): string =>
  `ivec2(2 * (${number} % ${in_a_row}), ${number} / ${in_a_row})`;
