// Writes a picture as a PNG file with a palette, which takes about a third of the bytes of a screenshot.
import { deflateSync } from "node:zlib";

const most_colours = 256;

const table = Array.from({ length: 256 }, (_, byte) => {
  let rest = byte;
  for (let bit = 0; bit < 8; ++bit) rest = rest & 1 ? (rest >>> 1) ^ 0xedb88320 : rest >>> 1;
  return rest;
});
const checksum = (bytes) =>
  ~bytes.reduce((rest, byte) => table[(rest ^ byte) & 255] ^ (rest >>> 8), ~0) >>> 0;

function chunk(type, data) {
  const named = Buffer.concat([Buffer.from(type, "latin1"), data]);
  const whole = Buffer.alloc(named.length + 8);
  whole.writeUInt32BE(data.length, 0);
  named.copy(whole, 4);
  whole.writeUInt32BE(checksum(named), named.length + 4);
  return whole;
}

// Colours that differ by less than eight steps of 256 become one, and rare ones become the nearest of the others.
function palette_of(pixels) {
  const coarse = (i) => ((pixels[i] >> 3) << 10) | ((pixels[i + 1] >> 3) << 5) | (pixels[i + 2] >> 3);
  const groups = new Map();
  for (let i = 0; i < pixels.length; i += 4) {
    const group = groups.get(coarse(i)) ?? { count: 0, exact: new Map() };
    const colour = pixels.readUIntBE(i, 3);
    group.exact.set(colour, (group.exact.get(colour) ?? 0) + 1);
    ++group.count;
    groups.set(coarse(i), group);
  }
  const commonest = (exact) => [...exact].reduce((a, b) => (b[1] > a[1] ? b : a))[0];
  const ordered = [...groups].sort(([, a], [, b]) => b.count - a.count);
  const colours = ordered.slice(0, most_colours).map(([, { exact }]) => commonest(exact));
  const parts = (colour) => [colour >> 16, (colour >> 8) & 255, colour & 255];
  const distance = (a, b) =>
    parts(a).reduce((sum, part, axis) => sum + (part - parts(b)[axis]) ** 2, 0);
  const place = new Map(
    ordered.map(([group, { exact }], i) => {
      const from = commonest(exact);
      const nearest = (best, colour, k) =>
        distance(colour, from) < distance(colours[best], from) ? k : best;
      return [group, i < most_colours ? i : colours.reduce(nearest, 0)];
    }),
  );
  return { colours: Buffer.from(colours.flatMap(parts)), place_of: (i) => place.get(coarse(i)) };
}

// `pixels` is a buffer with four bytes each, as a canvas has them.
export function small_png(width, height, pixels) {
  const { colours, place_of } = palette_of(pixels);
  const header = Buffer.alloc(13);
  header.writeUInt32BE(width, 0);
  header.writeUInt32BE(height, 4);
  header.set([8, 3, 0, 0, 0], 8);
  const rows = Buffer.alloc(height * (width + 1));
  for (let y = 0; y < height; ++y) {
    for (let x = 0; x < width; ++x) rows[y * (width + 1) + 1 + x] = place_of(4 * (y * width + x));
  }
  return Buffer.concat([
    Buffer.from([0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a]),
    chunk("IHDR", header),
    chunk("PLTE", colours),
    chunk("IDAT", deflateSync(rows, { level: 9, memLevel: 9 })),
    chunk("IEND", Buffer.alloc(0)),
  ]);
}
