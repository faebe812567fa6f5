// MuJoCo: mj_geomDistance of two geoms. The argument is the version.
import { matrixOf, plus, rotated, serve, times, unit } from '../lines.mjs';

const version = process.argv[2];
const mujoco = await (await import('mujoco-' + version)).default();
const isOld = mujoco.MjModel.from_xml_string === undefined; // the package mujoco-js
if (isOld) mujoco.FS.mkdir('/models');

const farthest = 1e10; // metres
const points = new mujoco.DoubleBuffer(6);

function geomOf(shape, name) {
  const sized = (type, ...size) => ({ geom: `type="${type}" size="${size.join(' ')}"` });
  switch (shape.type) {
    case 'sphere': return sized('sphere', shape.radius);
    case 'capsule': case 'cylinder': return sized(shape.type, shape.radius, shape.half_length);
    case 'box': return sized('box', ...shape.half_extents);
    case 'ellipsoid': return sized('ellipsoid', ...shape.radii);
    case 'halfspace': return { ...sized('plane', 0, 0, 1), normal: unit(shape.normal) };
    default:
      return {
        geom: `type="mesh" mesh="${name}"`,
        asset: `<mesh name="${name}" vertex="${shape.vertices.map((v) => v.join(' ')).join(' ')}"/>`,
      };
  }
}

const models = new Map(); // by their two shapes

function compile(a, b) {
  const geoms = [geomOf(a, 'a'), geomOf(b, 'b')];
  const xml = `<mujoco><asset>${geoms.map((g) => g.asset ?? '').join('')}</asset><worldbody>${
    geoms.map((g) => `<geom ${g.geom}/>`).join('')}</worldbody></mujoco>`;
  try {
    let model;
    if (isOld) {
      mujoco.FS.writeFile('/models/m.xml', xml);
      model = mujoco.MjModel.loadFromXML('/models/m.xml');
    } else {
      model = mujoco.MjModel.from_xml_string(xml);
    }
    const data = new mujoco.MjData(model);
    mujoco.mj_kinematics(model, data);
    return { model, data };
  } catch (error) {
    console.error(String(error?.message ?? error));
    return null; // a size of zero, or a flat mesh
  }
}

function modelOf(a, b) {
  const key = JSON.stringify([a, b]);
  let found = models.get(key);
  if (found === undefined) {
    found = compile(a, b);
    models.set(key, found);
    if (models.size > 20) {
      const [oldest, gone] = models.entries().next().value;
      models.delete(oldest);
      gone?.data.delete();
      gone?.model.delete();
    }
  }
  return found;
}

// Writes the pose of a geom where mj_kinematics would. A mesh has a frame of its own within its body.
function place({ model, data }, geom, body) {
  let position = body.translation, matrix = body.rotation;
  if (body.shape.type === 'halfspace') {
    // Its geom is the plane z = 0.
    const length = Math.hypot(...body.shape.normal), n = unit(body.shape.normal);
    const side = unit(Math.abs(n[0]) < 0.6 ? [0, n[2], -n[1]] : [-n[2], 0, n[0]]);
    const other = [n[1] * side[2] - n[2] * side[1], n[2] * side[0] - n[0] * side[2], n[0] * side[1] - n[1] * side[0]];
    position = plus(position, rotated(matrix, n), body.shape.offset / length);
    matrix = times(matrix, [0, 1, 2].flatMap((i) => [side[i], other[i], n[i]]));
  } else {
    position = plus(position, rotated(matrix, [...model.geom_pos.slice(3 * geom, 3 * geom + 3)]));
    matrix = times(matrix, matrixOf([...model.geom_quat.slice(4 * geom, 4 * geom + 4)]));
  }
  data.geom_xpos.set(position, 3 * geom);
  data.geom_xmat.set(matrix, 9 * geom);
}

function answer({ a, b }) {
  const at = modelOf(a.shape, b.shape);
  if (at === null) return null;
  place(at, 0, a);
  place(at, 1, b);
  const distance = mujoco.mj_geomDistance(at.model, at.data, 0, 1, farthest, points);
  if (distance === farthest) return { answer: 'unknown' };
  const fromTo = [...points.GetView()];
  const onA = fromTo.slice(0, 3), onB = fromTo.slice(3);
  const way = plus(onB, onA, -1);
  return { distance, normal: unit(distance < 0 ? way.map((x) => -x) : way), a: onA, b: onB };
}

serve({
  name: 'mujoco', version, library: `MuJoCo ${version}, mj_geomDistance, WebAssembly`,
  kinds: {
    pair: {
      tasks: ['intersect', 'distance', 'penetration', 'signed'], scalars: ['double'],
      shapes: ['sphere', 'capsule', 'box', 'cylinder', 'ellipsoid', 'hull', 'halfspace'],
    },
  },
}, answer);
