"""Coal (once hpp-fcl): the signed distance of two shapes. The argument is the version."""
import pathlib
import sys

sys.path.append(str(pathlib.Path(__file__).parent.parent))
from lines import rows, serve, unit  # noqa: E402 (it keeps what the library prints from the answers)
import coal  # noqa: E402
import numpy  # noqa: E402


def shape_of(shape):
    kind = shape["type"]
    if kind == "sphere":
        return coal.Sphere(shape["radius"])
    if kind in ("capsule", "cylinder", "cone"):
        return getattr(coal, kind.capitalize())(shape["radius"], 2 * shape["half_length"])
    if kind == "box":
        return coal.Box(*[2 * x for x in shape["half_extents"]])
    if kind == "ellipsoid":
        return coal.Ellipsoid(*shape["radii"])
    if kind == "halfspace":
        return coal.Halfspace(numpy.array(shape["normal"]), shape["offset"])
    points = coal.StdVec_Vec3s()
    points.extend([numpy.array(vertex) for vertex in shape["vertices"]])
    return coal.Convex.convexHull(points, True, "Qt")


def pose_of(body):
    return coal.Transform3s(numpy.array(rows(body["rotation"])), numpy.array(body["translation"]))


def answer(question):
    try:
        a, b = (shape_of(question[body]["shape"]) for body in "ab")
    except RuntimeError as error:
        print(error, file=sys.stderr)
        return None  # a flat hull
    result = coal.DistanceResult()
    distance = coal.distance(a, pose_of(question["a"]), b, pose_of(question["b"]), coal.DistanceRequest(), result)
    return {"distance": float(distance), "normal": unit([float(x) for x in result.normal]),
            "a": [float(x) for x in result.getNearestPoint1()], "b": [float(x) for x in result.getNearestPoint2()]}


serve({"name": "coal", "version": sys.argv[1], "library": f"Coal {sys.argv[1]}, coal.distance",
       "kinds": {"pair": {"tasks": ["intersect", "distance", "penetration", "signed"]}}}, answer)
