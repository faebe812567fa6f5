"""python-fcl: FCL's distance of two shapes, and its contact where they overlap. The argument is the version."""
import pathlib
import sys

sys.path.append(str(pathlib.Path(__file__).parent.parent))
from lines import rows, serve, unit  # noqa: E402 (it keeps what the library prints from the answers)
import fcl  # noqa: E402
import numpy  # noqa: E402


def shape_of(shape):
    kind = shape["type"]
    if kind == "sphere":
        return fcl.Sphere(shape["radius"])
    if kind in ("capsule", "cylinder", "cone"):
        return getattr(fcl, kind.capitalize())(shape["radius"], 2 * shape["half_length"])
    if kind == "box":
        return fcl.Box(*[2 * x for x in shape["half_extents"]])
    return fcl.Ellipsoid(*shape["radii"])


def object_of(body):
    pose = fcl.Transform(numpy.array(rows(body["rotation"])), numpy.array(body["translation"]))
    return fcl.CollisionObject(shape_of(body["shape"]), pose)


def floats(vector):
    return [float(x) for x in vector]


def answer(question):
    a, b = object_of(question["a"]), object_of(question["b"])
    contacts = fcl.CollisionResult()
    if fcl.collide(a, b, fcl.CollisionRequest(num_max_contacts=100, enable_contact=True), contacts) > 0:
        deepest = max(contacts.contacts, key=lambda contact: contact.penetration_depth)
        return {"answer": "overlapping", "distance": -float(deepest.penetration_depth), "normal": unit(floats(deepest.normal))}
    if question["task"] in ("intersect", "penetration"):
        return {"answer": "separated"}
    nearest = fcl.DistanceResult()
    distance = fcl.distance(a, b, fcl.DistanceRequest(enable_nearest_points=True), nearest)
    on_a, on_b = (floats(point) for point in nearest.nearest_points)
    return {"answer": "separated", "distance": float(distance), "a": on_a, "b": on_b}


serve({"name": "python-fcl", "version": sys.argv[1], "library": f"python-fcl {sys.argv[1]}, fcl.distance and fcl.collide",
       "kinds": {"pair": {"tasks": ["intersect", "distance", "penetration", "signed"],
                          "shapes": ["sphere", "capsule", "box", "cylinder", "cone", "ellipsoid"]}}}, answer)
