"""PyBullet: the closest points of two bodies. The argument is the version."""
import math
import pathlib
import sys

sys.path.append(str(pathlib.Path(__file__).parent.parent))
from lines import quaternion_of, serve, unit  # noqa: E402 (it keeps what the library prints from the answers)
import pybullet  # noqa: E402

pybullet.connect(pybullet.DIRECT)


def shape_of(shape):
    kind = shape["type"]
    if kind == "sphere":
        return pybullet.createCollisionShape(pybullet.GEOM_SPHERE, radius=shape["radius"])
    if kind in ("capsule", "cylinder"):
        return pybullet.createCollisionShape(getattr(pybullet, "GEOM_" + kind.upper()), radius=shape["radius"],
                                             height=2 * shape["half_length"])
    if kind == "box":
        return pybullet.createCollisionShape(pybullet.GEOM_BOX, halfExtents=shape["half_extents"])
    return pybullet.createCollisionShape(pybullet.GEOM_MESH, vertices=shape["vertices"])


def body_of(body):
    w, x, y, z = quaternion_of(body["rotation"])
    return pybullet.createMultiBody(0, shape_of(body["shape"]), -1, body["translation"], [x, y, z, w])


def answer(question):
    a, b = question["a"], question["b"]
    first, second = body_of(a), body_of(b)
    far = 10 * (math.dist(a["translation"], b["translation"]) + 1e3)
    found = min(pybullet.getClosestPoints(first, second, far) or (), key=lambda point: point[8], default=None)
    pybullet.resetSimulation()
    if found is None:
        return {"answer": "unknown"}
    # Its normal is on B, towards A.
    return {"distance": found[8], "normal": unit([-x for x in found[7]]), "a": list(found[5]), "b": list(found[6])}


serve({"name": "pybullet", "version": sys.argv[1], "library": f"PyBullet {sys.argv[1]}, getClosestPoints",
       "kinds": {"pair": {"tasks": ["intersect", "distance", "penetration", "signed"], "encoding": "quaternion",
                          "shapes": ["sphere", "capsule", "box", "cylinder", "hull"]}}}, answer)
