"""DART: whether two shapes touch, and how deep, by its own collision detector. The argument is the version."""
import pathlib
import sys

sys.path.append(str(pathlib.Path(__file__).parent.parent))
import dartpy  # noqa: E402
from lines import rows, serve, unit  # noqa: E402

detector = dartpy.collision.DARTCollisionDetector()
option = dartpy.collision.CollisionOption(True, 100)


def shape_of(shape):
    if shape["type"] == "sphere":
        return dartpy.dynamics.SphereShape(shape["radius"])
    return dartpy.dynamics.BoxShape([2 * x for x in shape["half_extents"]])


def group_of(body):
    pose = dartpy.math.Isometry3()
    pose.set_rotation(rows(body["rotation"]))
    pose.set_translation(body["translation"])
    frame = dartpy.dynamics.SimpleFrame(dartpy.dynamics.Frame.World(), "", pose)
    frame.setShape(shape_of(body["shape"]))
    group = detector.createCollisionGroup()
    group.addShapeFrame(frame)
    return group, frame


def answer(question):
    (a, frame_a), (b, frame_b) = group_of(question["a"]), group_of(question["b"])
    result = dartpy.collision.CollisionResult()
    if not a.collide(b, option, result):
        return {"answer": "separated"}
    deepest = max(result.getContacts(), key=lambda contact: contact.penetrationDepth, default=None)
    if deepest is None:
        return {"answer": "overlapping", "status": "not_converged"}
    # Its normal is from the second body to the first.
    return {"answer": "overlapping", "distance": -deepest.penetrationDepth, "normal": unit([-x for x in deepest.normal])}


serve({"name": "dart", "version": sys.argv[1], "library": f"DART {sys.argv[1]}, DARTCollisionDetector",
       "kinds": {"pair": {"tasks": ["intersect", "penetration"], "shapes": ["sphere", "box"]}}}, answer)
