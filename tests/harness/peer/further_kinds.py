"""Answers rays and points at a mesh by all of its triangles, casts of two spheres that do not turn, meshes by exact signs of
volumes unless four corners are in a plane, and vertices that move against faces by bisection of the volume.
"""
import json
import math
import sys
from fractions import Fraction


def minus(a, b):
    return [x - y for x, y in zip(a, b)]


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def ray(question):
    best = {"hit": False, "status": "ok"}
    for number, (p, q, r) in enumerate(triangles):
        along, side, other = question["direction"], minus(q, p), minus(r, p)
        h = cross(along, other)
        det = dot(side, h)
        if det == 0:
            continue
        s = minus(question["origin"], p)
        u = dot(s, h) / det
        k = cross(s, side)
        v, t = dot(along, k) / det, dot(other, k) / det
        if min(u, v, 1 - u - v, t) >= 0 and t <= min(question.get("t_max", math.inf), best.get("t", math.inf)):
            best = {"t": t, "u": u, "v": v, "triangle": number, "status": "ok"}
    return best


def nearest_of_segment(x, p, q):
    way = minus(q, p)
    length = dot(way, way)
    t = 0 if length == 0 else min(max(dot(minus(x, p), way) / length, 0), 1)
    return [a + t * b for a, b in zip(p, way)]


def point(question):
    x, best = question["point"], None
    for number, (p, q, r) in enumerate(triangles):
        normal = cross(minus(q, p), minus(r, p))
        candidates = [nearest_of_segment(x, *ends) for ends in ((p, q), (q, r), (r, p))]
        if dot(normal, normal) > 0:
            foot = [a - b * dot(minus(x, p), normal) / dot(normal, normal) for a, b in zip(x, normal)]
            if all(dot(cross(minus(b, a), minus(foot, a)), normal) >= 0 for a, b in ((p, q), (q, r), (r, p))):
                candidates.append(foot)
        for found in candidates:
            if best is None or math.dist(x, found) < best["distance"]:
                best = {"distance": math.dist(x, found), "closest": found, "triangle": number, "status": "ok"}
    return best or {"status": "ok"}


def cast(question):
    a, b = question["a"], question["b"]
    radius = a["shape"]["radius"] + b["shape"]["radius"]
    d = minus(b["translation"], a["translation"])
    v = minus(b["displacement"], a["displacement"])
    if dot(d, d) <= radius ** 2:
        return {"toi": 0, "status": "ok"}
    square, half = dot(v, v), dot(d, v)
    root = half ** 2 - square * (dot(d, d) - radius ** 2)
    if half >= 0 or root < 0:
        return {"answer": "miss", "status": "ok"}
    t = (dot(d, d) - radius ** 2) / (-half + math.sqrt(root))
    if t > 1:
        return {"answer": "miss", "status": "ok"}
    normal = [(x + t * y) / radius for x, y in zip(d, v)]
    centre = [x + t * y for x, y in zip(a["translation"], a["displacement"])]
    return {"toi": t, "normal": normal, "point": [x + a["shape"]["radius"] * n for x, n in zip(centre, normal)],
            "status": "ok"}


def volume(a, b, c, d):
    return dot(cross(minus(b, a), minus(c, a)), minus(d, a))


def triangles_of(body):
    rotation, shift = body["rotation"], body["translation"]
    exact = [[Fraction(x) for x in vertex] for vertex in body["shape"]["vertices"]]
    placed = [[dot(map(Fraction, rotation[3 * i : 3 * i + 3]), v) + Fraction(shift[i]) for i in range(3)] for v in exact]
    return [[placed[i] for i in corners] for corners in body["shape"]["triangles"]]


def is_crossed(triangle, p, q):
    ends = volume(*triangle, p), volume(*triangle, q)
    if 0 in ends:
        raise ArithmeticError
    around = [volume(p, q, triangle[i], triangle[(i + 1) % 3]) for i in range(3)]
    return ends[0] * ends[1] < 0 and (min(around) >= 0 or max(around) <= 0)


def mesh(question):
    if question["a"]["shape"]["type"] != "mesh" or question["b"]["shape"]["type"] != "mesh":
        return {"status": "unsupported"}
    parts = []
    try:
        for i, one in enumerate(triangles_of(question["a"])):
            for j, other in enumerate(triangles_of(question["b"])):
                edges = [(x, y[k], y[(k + 1) % 3]) for x, y in ((one, other), (other, one)) for k in range(3)]
                if any([is_crossed(*edge) for edge in edges]):
                    parts.append([i, j])
    except ArithmeticError:
        return {"status": "degenerate"}
    return {"answer": "overlapping" if parts else "separated", "parts": parts, "status": "ok"}


def feature(question):
    def at(t):
        return [[a + t * (b - a) for a, b in zip(*ends)] for ends in zip(question["start"], question["end"])]

    for step in range(256):
        low, high = step / 256, (step + 1) / 256
        if volume(*at(low)) * volume(*at(high)) > 0:
            continue
        for _ in range(60):
            middle = (low + high) / 2
            low, high = (low, middle) if volume(*at(low)) * volume(*at(middle)) <= 0 else (middle, high)
        vertex, *corners = at(high)
        normal = cross(minus(corners[1], corners[0]), minus(corners[2], corners[0]))
        inside = [dot(cross(minus(corners[(i + 1) % 3], corners[i]), minus(vertex, corners[i])), normal) for i in range(3)]
        if min(inside) >= 0:
            return {"toi": high, "lower": low, "upper": high, "status": "ok"}
    return {"answer": "miss", "status": "ok"}


sys.stdin.readline()
print(json.dumps({"protocol": 1, "name": "further", "version": "1", "kinds": {
    "ray": {"tasks": ["closest", "any"]}, "point": {"tasks": ["closest"]}, "cast": {"shapes": ["sphere"]},
    "mesh": {"tasks": ["intersect", "contacts"]}, "feature": {"tasks": ["vertex-face"]}}}), flush=True)
triangles = []
for line in sys.stdin:
    message = json.loads(line)
    if "id" not in message:
        triangles = [[message["vertices"][i] for i in corners] for corners in message["triangles"]]
        continue
    given = {"ray": ray, "point": point, "cast": cast, "mesh": mesh, "feature": feature}[message["kind"]](message)
    print(json.dumps({"id": message["id"], **given}), flush=True)
