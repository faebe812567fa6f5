// cannon-es: whether two convex polyhedra overlap, by its separating-axis test. The argument is the version.
import { quaternionOf, serve } from '../lines.mjs';

const version = process.argv[2];
const cannon = await import('cannon-' + version);

const boxFaces = [[3, 2, 1, 0], [4, 5, 6, 7], [5, 4, 0, 1], [2, 3, 7, 6], [0, 4, 7, 3], [1, 2, 6, 5]];

function polyhedronOf({ half_extents: [x, y, z] }) {
  const corners = [[-x, -y, -z], [x, -y, -z], [x, y, -z], [-x, y, -z], [-x, -y, z], [x, -y, z], [x, y, z], [-x, y, z]];
  return new cannon.ConvexPolyhedron({ vertices: corners.map((c) => new cannon.Vec3(...c)), faces: boxFaces });
}

function poseOf({ translation, rotation }) {
  const [w, x, y, z] = quaternionOf(rotation);
  return [new cannon.Vec3(...translation), new cannon.Quaternion(x, y, z, w)];
}

function answer({ a, b }) {
  const [positionA, quaternionA] = poseOf(a), [positionB, quaternionB] = poseOf(b);
  const axis = new cannon.Vec3();
  const meets = polyhedronOf(a.shape)
    .findSeparatingAxis(polyhedronOf(b.shape), positionA, quaternionA, positionB, quaternionB, axis);
  return { answer: meets ? 'overlapping' : 'separated' };
}

serve({
  name: 'cannon', version, library: `cannon-es ${version}, ConvexPolyhedron.findSeparatingAxis`,
  kinds: { pair: { tasks: ['intersect'], shapes: ['box'], scalars: ['double'], encoding: 'quaternion' } },
}, answer);
