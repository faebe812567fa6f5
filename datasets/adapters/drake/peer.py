"""Drake: the signed distance of two geometries of a SceneGraph. The argument is the version."""
import pathlib
import sys

sys.path.append(str(pathlib.Path(__file__).parent.parent))
from lines import plus, rotated, rows, serve, unit  # noqa: E402 (it keeps what the library prints from the answers)
import numpy  # noqa: E402
from pydrake import geometry  # noqa: E402
from pydrake.math import RigidTransform, RotationMatrix  # noqa: E402


def shape_of(shape):
    kind = shape["type"]
    if kind == "sphere":
        return geometry.Sphere(shape["radius"])
    if kind in ("capsule", "cylinder"):
        return getattr(geometry, kind.capitalize())(shape["radius"], 2 * shape["half_length"])
    if kind == "box":
        return geometry.Box(*[2 * x for x in shape["half_extents"]])
    return geometry.Ellipsoid(*shape["radii"])


def answer(question):
    bodies = question["a"], question["b"]
    try:
        graph = geometry.SceneGraph()
        source = graph.RegisterSource("pair")
        ids = []
        for name, body in zip("ab", bodies):
            pose = RigidTransform(RotationMatrix(numpy.array(rows(body["rotation"]))), body["translation"])
            instance = geometry.GeometryInstance(pose, shape_of(body["shape"]), name)
            instance.set_proximity_properties(geometry.ProximityProperties())
            ids.append(graph.RegisterAnchoredGeometry(source, instance))
        query = graph.get_query_output_port().Eval(graph.CreateDefaultContext())
        pair = query.ComputeSignedDistancePairClosestPoints(*ids)
    except RuntimeError as error:
        print(error, file=sys.stderr)
        return None  # a pair of kinds without such a query, or a rotation that is none
    if pair.id_A != ids[0]:
        bodies = bodies[::-1]
    # Its points are in the frames of the geometries, and its normal is from B to A.
    on_a, on_b = (plus(rotated(body["rotation"], [float(x) for x in point]), body["translation"])
                  for body, point in zip(bodies, (pair.p_ACa, pair.p_BCb)))
    normal = unit([-float(x) for x in pair.nhat_BA_W])
    if pair.id_A != ids[0]:
        on_a, on_b, normal = on_b, on_a, normal and [-x for x in normal]
    return {"distance": float(pair.distance), "normal": normal, "a": on_a, "b": on_b}


serve({"name": "drake", "version": sys.argv[1],
       "library": f"Drake {sys.argv[1]}, QueryObject.ComputeSignedDistancePairClosestPoints",
       "kinds": {"pair": {"tasks": ["intersect", "distance", "penetration", "signed"],
                          "shapes": ["sphere", "capsule", "box", "cylinder", "ellipsoid"]}}}, answer)
