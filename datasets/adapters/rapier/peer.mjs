// Rapier: contactShape of two shapes, which is parry's contact query. The arguments are the version, and the name of the
// build where it is not the usual one: rapier-simd or rapier-deterministic.
import { plus, quaternionOf, rotated, serve, times, unit } from '../lines.mjs';

const [version, name = 'rapier'] = process.argv.slice(2);
// Some versions name a file as their main one that Node.js takes for another kind of module.
const loaded = await import(`${name}-${version}`)
  .catch(() => import(`./node_modules/${name}-${version}/rapier.es.js`));
const rapier = loaded.default?.init ? loaded.default : loaded;
await rapier.init();

const farthest = 1e9; // metres
const yToZ = [1, 0, 0, 0, 0, -1, 0, 1, 0]; // its capsules, cylinders and cones lie along y

function shapeOf(shape) {
  switch (shape.type) {
    case 'sphere': return new rapier.Ball(shape.radius);
    case 'capsule': return new rapier.Capsule(shape.half_length, shape.radius);
    case 'cylinder': return new rapier.Cylinder(shape.half_length, shape.radius);
    case 'cone': return new rapier.Cone(shape.half_length, shape.radius);
    case 'box': return new rapier.Cuboid(...shape.half_extents);
    case 'halfspace': {
      const [x, y, z] = unit(shape.normal);
      return new rapier.HalfSpace({ x, y, z });
    }
    default: return new rapier.ConvexPolyhedron(new Float32Array(shape.vertices.flat()), null);
  }
}

const vector = ([x, y, z]) => ({ x, y, z });
const array = ({ x, y, z }) => [x, y, z];

function poseOf({ shape, translation, rotation }) {
  let position = translation, matrix = rotation;
  if (['capsule', 'cylinder', 'cone'].includes(shape.type)) matrix = times(rotation, yToZ);
  if (shape.type === 'halfspace') {
    position = plus(position, rotated(rotation, unit(shape.normal)), shape.offset / Math.hypot(...shape.normal));
  }
  const [w, x, y, z] = quaternionOf(matrix);
  return [vector(position), { x, y, z, w }];
}

function answer({ a, b }) {
  try {
    // Of a half-space behind another shape it takes the wrong relative pose: see peer.toml.
    const isBehind = b.shape.type === 'halfspace';
    const [first, second] = isBehind ? [b, a] : [a, b];
    const contact = shapeOf(first.shape).contactShape(...poseOf(first), shapeOf(second.shape), ...poseOf(second), farthest);
    if (contact === null) return { answer: 'unknown' };
    const sides = [{ normal: array(contact.normal1), point: array(contact.point1) },
      { normal: array(contact.normal2), point: array(contact.point2) }];
    const [onA, onB] = isBehind ? sides.reverse() : sides;
    return { distance: contact.distance, normal: onA.normal, a: onA.point, b: onB.point };
  } catch (error) {
    console.error(String(error?.message ?? error));
    return null; // a flat hull, or a pair without such a query
  }
}

serve({
  name, version, library: `Rapier ${version}, contactShape, WebAssembly, ${name}`,
  kinds: {
    pair: {
      tasks: ['intersect', 'distance', 'penetration', 'signed'], scalars: ['float'], encoding: 'quaternion_float32',
      shapes: ['sphere', 'capsule', 'box', 'cylinder', 'cone', 'hull', 'halfspace'],
    },
  },
}, answer);
