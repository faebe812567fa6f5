// The beginnings and ends of tests in Python and JavaScript. They place bodies by the arithmetic of the adapters, since a wrong
// answer may hang on the last bit of a number.
#include "harness/kinds/pair/reproducer/script_tests.h"

#include <array>

namespace touchstone::kinds {
namespace {

constexpr std::string_view mujoco_python = R"test(import math
import sys

import mujoco
import numpy as np


def geom(shape, name):
    if shape["type"] == "hull":
        vertices = " ".join(str(x) for vertex in shape["vertices"] for x in vertex)
        return f'<mesh name="{name}" vertex="{vertices}"/>', f'<geom type="mesh" mesh="{name}"/>'
    size = {"box": shape.get("half_extents"), "ellipsoid": shape.get("radii")}.get(shape["type"])
    size = size or [shape["radius"], shape.get("half_length", 0)]
    return "", f'<geom type="{shape["type"]}" size="{" ".join(map(str, size))}"/>'


# Rotations are matrices, by rows.
def times(m, n):
    return [m[3 * i] * n[j] + m[3 * i + 1] * n[3 + j] + m[3 * i + 2] * n[6 + j] for i in range(3) for j in range(3)]


def signed_distance(a, b):
    assets, geoms = zip(geom(a["shape"], "a"), geom(b["shape"], "b"))
    model = mujoco.MjModel.from_xml_string(
        f'<mujoco><asset>{"".join(assets)}</asset><worldbody>{"".join(geoms)}</worldbody></mujoco>')
    data = mujoco.MjData(model)
    mujoco.mj_kinematics(model, data)
    for i, body in enumerate((a, b)):
        # A mesh has a frame of its own within its body.
        (x, y, z), (w, p, q, r), m = model.geom_pos[i].tolist(), model.geom_quat[i].tolist(), body["rotation"]
        own = [1 - 2 * (q * q + r * r), 2 * (p * q - w * r), 2 * (p * r + w * q), 2 * (p * q + w * r),
               1 - 2 * (p * p + r * r), 2 * (q * r - w * p), 2 * (p * r - w * q), 2 * (q * r + w * p), 1 - 2 * (p * p + q * q)]
        data.geom_xpos[i] = [t + (m[3 * k] * x + m[3 * k + 1] * y + m[3 * k + 2] * z)
                             for k, t in enumerate(body["translation"])]
        data.geom_xmat[i] = times(m, own)
    return mujoco.mj_geomDistance(model, data, 0, 1, 1e10, np.zeros(6))
)test";

constexpr std::string_view mujoco_javascript = R"test(import load from 'PACKAGE';

const mujoco = await load();
const points = new mujoco.DoubleBuffer(6);

function geom(shape, name) {
  if (shape.type === 'hull') {
    return [`<mesh name="${name}" vertex="${shape.vertices.flat().join(' ')}"/>`, `<geom type="mesh" mesh="${name}"/>`];
  }
  const size = shape.half_extents ?? shape.radii ?? [shape.radius, shape.half_length ?? 0];
  return ['', `<geom type="${shape.type}" size="${size.join(' ')}"/>`];
}

// Rotations are matrices, by rows.
const times = (m, n) =>
  [0, 1, 2].flatMap((i) => [0, 1, 2].map((j) => m[3 * i] * n[j] + m[3 * i + 1] * n[3 + j] + m[3 * i + 2] * n[6 + j]));

function signed_distance(a, b) {
  const [one, other] = [geom(a.shape, 'a'), geom(b.shape, 'b')];
  const model = mujoco.MjModel.from_xml_string(
    `<mujoco><asset>${one[0]}${other[0]}</asset><worldbody>${one[1]}${other[1]}</worldbody></mujoco>`);
  const data = new mujoco.MjData(model);
  mujoco.mj_kinematics(model, data);
  [a, b].forEach(({ translation, rotation: m }, i) => {
    // A mesh has a frame of its own within its body.
    const [x, y, z] = model.geom_pos.slice(3 * i, 3 * i + 3), [w, p, q, r] = model.geom_quat.slice(4 * i, 4 * i + 4);
    const own = [1 - 2 * (q * q + r * r), 2 * (p * q - w * r), 2 * (p * r + w * q), 2 * (p * q + w * r),
      1 - 2 * (p * p + r * r), 2 * (q * r - w * p), 2 * (p * r - w * q), 2 * (q * r + w * p), 1 - 2 * (p * p + q * q)];
    data.geom_xpos.set(translation.map((t, k) => t + (m[3 * k] * x + m[3 * k + 1] * y + m[3 * k + 2] * z)), 3 * i);
    data.geom_xmat.set(times(m, own), 9 * i);
  });
  return mujoco.mj_geomDistance(model, data, 0, 1, 1e10, points);
}
)test";

constexpr std::string_view rapier_javascript =
    R"test(// Some versions name a file that Node.js does not load.
const loaded = await import('PACKAGE').catch(() => import('./node_modules/PACKAGE/rapier.es.js'));
const rapier = loaded.default?.init ? loaded.default : loaded;
await rapier.init();

function shape_of(shape) {
  switch (shape.type) {
    case 'sphere': return new rapier.Ball(shape.radius);
    case 'capsule': return new rapier.Capsule(shape.half_length, shape.radius);
    case 'cylinder': return new rapier.Cylinder(shape.half_length, shape.radius);
    case 'cone': return new rapier.Cone(shape.half_length, shape.radius);
    case 'box': return new rapier.Cuboid(...shape.half_extents);
    default: return new rapier.ConvexPolyhedron(new Float32Array(shape.vertices.flat()), null);
  }
}

// Rotations are matrices, by rows.
function quaternion({ shape, rotation: r }) {
  // A capsule, cylinder or cone lies along z here, and along y there.
  const m = ['capsule', 'cylinder', 'cone'].includes(shape.type) ? [r[0], r[2], -r[1], r[3], r[5], -r[4], r[6], r[8], -r[7]] : r;
  const found = [[1 + m[0] + m[4] + m[8], m[7] - m[5], m[2] - m[6], m[3] - m[1]],
    [m[7] - m[5], 1 + m[0] - m[4] - m[8], m[1] + m[3], m[2] + m[6]],
    [m[2] - m[6], m[1] + m[3], 1 - m[0] + m[4] - m[8], m[5] + m[7]],
    [m[3] - m[1], m[2] + m[6], m[5] + m[7], 1 - m[0] - m[4] + m[8]]];
  const best = found.map((row, i) => row[i]).reduce((at, x, i, all) => (x > all[at] ? i : at), 0);
  const [w, x, y, z] = found[best].map((x) => x / Math.hypot(...found[best]));
  return { x, y, z, w };
}

function signed_distance(a, b) {
  const place = ({ translation: [x, y, z] }) => ({ x, y, z });
  const contact = shape_of(a.shape)
    .contactShape(place(a), quaternion(a), shape_of(b.shape), place(b), quaternion(b), 1e9);
  return contact === null ? NaN : contact.distance;
}
)test";

constexpr std::string_view jolt_javascript = R"test(import load from 'PACKAGE';

const jolt = await load();

// An interface registers the functions of pairs of shapes.
const layer = new jolt.BroadPhaseLayerInterfaceTable(1, 1), pairs = new jolt.ObjectLayerPairFilterTable(1);
layer.MapObjectToBroadPhaseLayer(0, new jolt.BroadPhaseLayer(0));
const world = new jolt.JoltSettings();
world.mObjectLayerPairFilter = pairs;
world.mBroadPhaseLayerInterface = layer;
world.mObjectVsBroadPhaseLayerFilter = new jolt.ObjectVsBroadPhaseLayerFilterTable(layer, 1, pairs, 1);
new jolt.JoltInterface(world);

const vec3 = (v) => new jolt.Vec3(...v);
const array = (v) => [v.GetX(), v.GetY(), v.GetZ()];

// Convex radii are 0.
function shape_of(shape) {
  switch (shape.type) {
    case 'sphere': return new jolt.SphereShape(shape.radius);
    case 'capsule': return new jolt.CapsuleShape(shape.half_length, shape.radius);
    case 'cylinder': return new jolt.CylinderShape(shape.half_length, shape.radius, 0);
    case 'box': return new jolt.BoxShape(vec3(shape.half_extents), 0);
    default: {
      const settings = new jolt.ConvexHullShapeSettings();
      settings.mMaxConvexRadius = 0;
      for (const vertex of shape.vertices) settings.mPoints.push_back(vec3(vertex));
      return settings.Create().Get();
    }
  }
}

// Rotations are matrices, by rows. Shapes and objects live to the end.
function placed({ shape, translation: t, rotation: r }) {
  const made = shape_of(shape);
  made.AddRef();
  // A capsule or cylinder lies along z here, and along y there.
  const m = ['capsule', 'cylinder'].includes(shape.type) ? [r[0], r[2], -r[1], r[3], r[5], -r[4], r[6], r[8], -r[7]] : r;
  const found = [[1 + m[0] + m[4] + m[8], m[7] - m[5], m[2] - m[6], m[3] - m[1]],
    [m[7] - m[5], 1 + m[0] - m[4] - m[8], m[1] + m[3], m[2] + m[6]],
    [m[2] - m[6], m[1] + m[3], 1 - m[0] + m[4] - m[8], m[5] + m[7]],
    [m[3] - m[1], m[2] + m[6], m[5] + m[7], 1 - m[0] - m[4] + m[8]]];
  const best = found.map((row, i) => row[i]).reduce((at, x, i, all) => (x > all[at] ? i : at), 0);
  const [w, x, y, z] = found[best].map((x) => x / Math.hypot(...found[best]));
  const c = array(made.GetCenterOfMass());
  const centre = t.map((x, k) => x + (m[3 * k] * c[0] + m[3 * k + 1] * c[1] + m[3 * k + 2] * c[2]));
  return { shape: made, rotation: new jolt.Quat(x, y, z, w), position: new jolt.RVec3(...t), centre: new jolt.RVec3(...centre) };
}

function collide(a, b, separation) {
  const target = new jolt.TransformedShape(), one = vec3([1, 1, 1]);
  target.mShape = b.shape;
  target.SetWorldTransform(b.position, b.rotation, one);
  const settings = new jolt.CollideShapeSettings();
  settings.mMaxSeparationDistance = separation;
  const collector = new jolt.CollideShapeClosestHitCollisionCollector();
  target.CollideShape(a.shape, one, jolt.RMat44.prototype.sRotationTranslation(a.rotation, a.centre), settings,
    new jolt.RVec3(0, 0, 0), collector, new jolt.ShapeFilter());
  return collector.HadHit() ? -collector.mHit.mPenetrationDepth : NaN;
}

function signed_distance(a, b) {
  const [one, other] = [placed(a), placed(b)];
  const depth = collide(one, other, 0);
  // Bodies that do not meet are asked with a separation that reaches from one to the other.
  const reach = ({ shape, translation }) => Math.hypot(...translation) +
    Math.max(0, ...(shape.vertices ?? []).map((v) => Math.hypot(...v)),
      1.5 * Math.hypot(...(shape.half_extents ?? [shape.radius ?? 0, shape.half_length ?? 0])));
  return Number.isNaN(depth) ? collide(one, other, reach(a) + reach(b)) : depth;
}
)test";

constexpr std::string_view python_end = R"test(

failures = 0
for case in cases:
    found, exact = signed_distance(case["a"], case["b"]), case["number"]
    # No number at all is that of bodies that are apart.
    apart = exact > 0 if math.isnan(found) else found > 0
    is_asked = case["has_distance"] if apart else case["has_depth"]
    what = ""
    if case["side"] and (found <= 0) != (exact < 0):
        what = "no contact of bodies that overlap" if exact < 0 else "contact of bodies that are apart"
    elif is_asked and not abs(found - exact) <= case["tolerance"]:
        what = "wrong distance" if exact > 0 else "wrong depth"
    if what:
        failures += 1
        print(f'{case["id"]}: {what}; found {found!r}, exact {exact!r}')
sys.exit(1 if failures else 0)
)test";

constexpr std::string_view javascript_end = R"test(
let failures = 0;
for (const { id, a, b, side, number: exact, tolerance, has_distance, has_depth } of cases) {
  const found = signed_distance(a, b);
  // No number at all is that of bodies that are apart.
  const is_apart = Number.isNaN(found) ? exact > 0 : found > 0;
  const is_asked = is_apart ? has_distance : has_depth;
  let what = '';
  if (side !== 0 && (found <= 0) !== (exact < 0)) {
    what = exact < 0 ? 'no contact of bodies that overlap' : 'contact of bodies that are apart';
  } else if (is_asked && !(Math.abs(found - exact) <= tolerance)) {
    what = exact > 0 ? 'wrong distance' : 'wrong depth';
  }
  if (what === '') continue;
  ++failures;
  console.log(`${id}: ${what}; found ${found}, exact ${exact}`);
}
process.exit(failures > 0 ? 1 : 0);
)test";

constexpr std::string_view of_mujoco = " sphere capsule cylinder box ellipsoid hull ";
constexpr std::string_view of_rapier = " sphere capsule cylinder cone box hull ";

constexpr std::array<ScriptTest, 6> tests = {
    {{"mujoco", ".py", "mj_geomDistance", "mujoco", mujoco_python, of_mujoco, false},
     {"mujoco", ".mjs", "mj_geomDistance", "@mujoco/mujoco", mujoco_javascript, of_mujoco, false,
      "3.3.8"},
     {"rapier", ".mjs", "contactShape", "@dimforge/rapier3d-compat", rapier_javascript, of_rapier,
      true},
     {"rapier-simd", ".mjs", "contactShape", "@dimforge/rapier3d-simd-compat", rapier_javascript,
      of_rapier, true},
     {"rapier-deterministic", ".mjs", "contactShape", "@dimforge/rapier3d-deterministic-compat",
      rapier_javascript, of_rapier, true},
     {"jolt", ".mjs", "TransformedShape.CollideShape", "jolt-physics", jolt_javascript,
      " sphere capsule cylinder box hull ", true}}};

}  // namespace

std::span<const ScriptTest> script_tests() { return tests; }

std::string_view script_end(const ScriptTest& test) {
  return test.is_python() ? python_end : javascript_end;
}

}  // namespace touchstone::kinds
