"""MuJoCo by its Python package: mj_geomDistance of two geoms. The argument is the version."""
import pathlib
import sys

sys.path.append(str(pathlib.Path(__file__).parent.parent))
from lines import serve, unit  # noqa: E402 (it keeps what the library prints from the answers)
import mujoco  # noqa: E402
import numpy  # noqa: E402

farthest = 1e10  # metres


def geom_of(shape, name):
    """What stands among the assets, and the geom."""
    kind = shape["type"]
    if kind == "hull":
        vertices = " ".join(repr(x) for vertex in shape["vertices"] for x in vertex)
        return f'<mesh name="{name}" vertex="{vertices}"/>', f'<geom type="mesh" mesh="{name}"/>'
    size = {"box": shape.get("half_extents"), "ellipsoid": shape.get("radii")}.get(kind)
    size = size or [shape["radius"], shape.get("half_length", 0)]
    return "", f'<geom type="{kind}" size="{" ".join(map(repr, size))}"/>'


def answer(question):
    bodies = question["a"], question["b"]
    assets, geoms = zip(*[geom_of(body["shape"], name) for body, name in zip(bodies, "ab")])
    try:
        model = mujoco.MjModel.from_xml_string(
            f'<mujoco><asset>{"".join(assets)}</asset><worldbody>{"".join(geoms)}</worldbody></mujoco>')
    except ValueError as error:
        print(error, file=sys.stderr)
        return None  # a size of zero, or a flat mesh
    data = mujoco.MjData(model)
    mujoco.mj_kinematics(model, data)
    for i, body in enumerate(bodies):
        own = numpy.zeros(9)  # a mesh has a frame of its own within its body
        mujoco.mju_quat2Mat(own, model.geom_quat[i])
        rotation = numpy.reshape(body["rotation"], (3, 3))
        data.geom_xpos[i] = body["translation"] + rotation @ model.geom_pos[i]
        data.geom_xmat[i] = (rotation @ own.reshape(3, 3)).ravel()
    points = numpy.zeros(6)
    distance = float(mujoco.mj_geomDistance(model, data, 0, 1, farthest, points))
    if distance == farthest:
        return {"answer": "unknown"}
    on_a, on_b = points[:3].tolist(), points[3:].tolist()
    sign = -1 if distance < 0 else 1
    return {"distance": distance, "normal": unit([sign * (y - x) for x, y in zip(on_a, on_b)]), "a": on_a, "b": on_b}


serve({"name": "mujoco-python", "version": sys.argv[1], "library": f"MuJoCo {sys.argv[1]}, mj_geomDistance, Python",
       "kinds": {"pair": {"tasks": ["intersect", "distance", "penetration", "signed"],
                          "shapes": ["sphere", "capsule", "box", "cylinder", "ellipsoid", "hull"]}}}, answer)
