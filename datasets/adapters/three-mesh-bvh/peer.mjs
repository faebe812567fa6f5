// three-mesh-bvh: rays at a mesh, and its closest point. The argument is the version.
import * as three from 'three';
import { serve } from '../lines.mjs';

const version = process.argv[2];
const { MeshBVH } = await import('three-mesh-bvh-' + version);

let geometry, tree;

function mesh({ vertices, triangles }) {
  geometry = new three.BufferGeometry();
  geometry.setAttribute('position', new three.BufferAttribute(new Float64Array(vertices.flat()), 3));
  geometry.setIndex(new three.BufferAttribute(new Uint32Array(triangles.flat()), 1));
  tree = triangles.length > 0 ? new MeshBVH(geometry, { indirect: true }) : null; // indirect: triangles keep their numbers
}

function ray({ origin, direction, t_max: most = Infinity }) {
  const length = Math.hypot(...direction);
  const cast = new three.Ray(new three.Vector3(...origin), new three.Vector3(...direction).divideScalar(length));
  const hit = tree && tree.raycastFirst(cast, three.DoubleSide, 0, most * length);
  if (!hit) return { hit: false, status: 'not_reported' };
  return { hit: true, t: hit.distance / length, triangle: hit.faceIndex };
}

function point({ task, point: asked }) {
  if (task !== 'closest') return null;
  const found = tree && tree.closestPointToPoint(new three.Vector3(...asked));
  if (!found) return {};
  return { distance: found.distance, closest: found.point.toArray(), triangle: found.faceIndex };
}

serve({
  name: 'three-mesh-bvh', version, library: `three-mesh-bvh ${version}, raycastFirst and closestPointToPoint`,
  kinds: {
    ray: { tasks: ['closest', 'any'], scalars: ['double'] },
    point: { tasks: ['closest'], scalars: ['double'] },
  },
}, (question) => (question.kind === 'ray' ? ray(question) : point(question)), mesh);
