// Jolt: CollideShape of two shapes, with a separation where they are apart. The argument is the version.
import { plus, quaternionOf, rotated, serve, times, unit } from '../lines.mjs';

const version = process.argv[2];
const jolt = await (await import('jolt-' + version)).default();

// An interface registers the functions of pairs of shapes. It has one layer, and nothing in it.
function registerShapes() {
  const layer = new jolt.BroadPhaseLayerInterfaceTable(1, 1), pairs = new jolt.ObjectLayerPairFilterTable(1);
  layer.MapObjectToBroadPhaseLayer(0, new jolt.BroadPhaseLayer(0));
  const settings = new jolt.JoltSettings();
  settings.mObjectLayerPairFilter = pairs;
  settings.mBroadPhaseLayerInterface = layer;
  settings.mObjectVsBroadPhaseLayerFilter = new jolt.ObjectVsBroadPhaseLayerFilterTable(layer, 1, pairs, 1);
  return new jolt.JoltInterface(settings);
}
registerShapes();

const yToZ = [1, 0, 0, 0, 0, -1, 0, 1, 0]; // its capsules and cylinders lie along y
const vec3 = (v) => new jolt.Vec3(...v);
const array = (v) => [v.GetX(), v.GetY(), v.GetZ()];

function shapeOf(shape) {
  switch (shape.type) {
    case 'sphere': return new jolt.SphereShape(shape.radius);
    case 'capsule': return new jolt.CapsuleShape(shape.half_length, shape.radius);
    case 'cylinder': return new jolt.CylinderShape(shape.half_length, shape.radius, 0);
    case 'box': {
      const half = vec3(shape.half_extents);
      const box = new jolt.BoxShape(half, 0);
      jolt.destroy(half);
      return box;
    }
    default: {
      const settings = new jolt.ConvexHullShapeSettings();
      settings.mMaxConvexRadius = 0;
      for (const vertex of shape.vertices) {
        const point = vec3(vertex);
        settings.mPoints.push_back(point);
        jolt.destroy(point);
      }
      const result = settings.Create();
      const hull = result.IsValid() ? result.Get() : null;
      hull?.AddRef();
      settings.Release?.();
      return hull;
    }
  }
}

// How far a point of the shape is from its origin, at most.
function reachOf(shape) {
  if (shape.vertices) return Math.max(...shape.vertices.map((v) => Math.hypot(...v)));
  return Math.hypot(...(shape.half_extents ?? [shape.radius + (shape.half_length ?? 0)])) * 1.5;
}

class Placed {
  constructor({ shape, translation, rotation }) {
    this.shape = shapeOf(shape);
    if (this.shape === null) return;
    if (shape.vertices === undefined) this.shape.AddRef();
    const matrix = ['capsule', 'cylinder'].includes(shape.type) ? times(rotation, yToZ) : rotation;
    const [w, x, y, z] = quaternionOf(matrix);
    this.rotation = new jolt.Quat(x, y, z, w);
    this.position = translation;
    this.centre = plus(translation, rotated(matrix, array(this.shape.GetCenterOfMass())));
  }
  free() {
    if (this.shape === null) return;
    this.shape.Release();
    jolt.destroy(this.rotation);
  }
}

const one = vec3([1, 1, 1]), origin = new jolt.RVec3(0, 0, 0), filter = new jolt.ShapeFilter();
const settings = new jolt.CollideShapeSettings();

function collide(a, b, separation) {
  const position = new jolt.RVec3(...b.position), centre = new jolt.RVec3(...a.centre);
  const target = new jolt.TransformedShape();
  target.mShape = b.shape;
  target.SetWorldTransform(position, b.rotation, one);
  const transform = jolt.RMat44.prototype.sRotationTranslation(a.rotation, centre);
  const collector = new jolt.CollideShapeClosestHitCollisionCollector();
  settings.mMaxSeparationDistance = separation;
  target.CollideShape(a.shape, one, transform, settings, origin, collector, filter);
  const hit = collector.mHit;
  const found = collector.HadHit()
    ? { distance: -hit.mPenetrationDepth, normal: unit(array(hit.mPenetrationAxis)),
      a: array(hit.mContactPointOn1), b: array(hit.mContactPointOn2) }
    : null;
  for (const object of [position, centre, target, collector]) jolt.destroy(object);
  return found;
}

function answer({ task, a, b }) {
  const first = new Placed(a), second = new Placed(b);
  try {
    if (first.shape === null || second.shape === null) return null; // a flat hull, or a size of zero
    const hit = collide(first, second, 0);
    if (hit !== null) return { answer: hit.distance < 0 ? 'overlapping' : 'touching', ...hit };
    if (task === 'intersect' || task === 'penetration') return { answer: 'separated' };
    const farthest = Math.hypot(...plus(b.translation, a.translation, -1)) + reachOf(a.shape) + reachOf(b.shape);
    return collide(first, second, farthest) ?? { answer: 'separated', status: 'not_converged' };
  } finally {
    first.free();
    second.free();
  }
}

serve({
  name: 'jolt', version, library: `JoltPhysics.js ${version}, TransformedShape.CollideShape`,
  kinds: {
    pair: {
      tasks: ['intersect', 'distance', 'penetration', 'signed'], scalars: ['float'], encoding: 'quaternion_float32',
      shapes: ['sphere', 'capsule', 'box', 'cylinder', 'hull'],
    },
  },
}, answer);
