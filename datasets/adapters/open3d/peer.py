"""Open3D: rays, closest points and sides of a mesh by its RaycastingScene. The argument is the version."""
import math
import pathlib
import sys

sys.path.append(str(pathlib.Path(__file__).parent.parent))
from lines import serve  # noqa: E402 (it keeps what Open3D prints from the answers)
import numpy  # noqa: E402
import open3d  # noqa: E402

core, scene = open3d.core, None


def tensor(numbers, kind=core.Dtype.Float32):
    return core.Tensor(numpy.asarray(numbers, dtype=numpy.float64), dtype=kind)


def mesh(line):
    global scene
    scene = None
    if not line["triangles"]:
        return
    scene = open3d.t.geometry.RaycastingScene()
    scene.add_triangles(tensor(line["vertices"]), core.Tensor(numpy.asarray(line["triangles"], dtype=numpy.uint32)))


def ray(question):
    most = question.get("t_max", math.inf)
    hit = scene.cast_rays(tensor([question["origin"] + question["direction"]]))
    t = hit["t_hit"].numpy()[0].item()
    if not t <= min(most, 3e38):
        return {"hit": False}
    u, v = hit["primitive_uvs"].numpy()[0].tolist()
    return {"hit": True, "t": t, "triangle": hit["primitive_ids"].numpy()[0].item(), "u": u, "v": v}


def point(question):
    asked = tensor([question["point"]])
    if question["task"] == "side":
        is_inside = scene.compute_occupancy(asked).numpy()[0] > 0
        return {"side": "inside" if is_inside else "outside"}
    found = scene.compute_closest_points(asked)
    closest = found["points"].numpy()[0].tolist()
    return {"distance": scene.compute_distance(asked).numpy()[0].item(), "closest": closest,
            "triangle": found["primitive_ids"].numpy()[0].item()}


def answer(question):
    if scene is None:
        return None
    return ray(question) if question["kind"] == "ray" else point(question)


serve({"name": "open3d", "version": sys.argv[1], "library": f"Open3D {sys.argv[1]}, RaycastingScene",
       "kinds": {"ray": {"tasks": ["closest", "any"], "scalars": ["float"]},
                 "point": {"tasks": ["closest", "side"], "scalars": ["float"]}}}, answer, mesh)
