#!/usr/bin/env python3
"""Makes the scenes of bodies that lean on, hang from and walk past each other.

    python3 datasets/make_scenes.py

brick_wall.toml, rock_pile.toml, crowd.toml, arch.toml, chain_net.toml, chain/*.obj, simulated/wall.toml and, from
home.toml, simulated/home.toml: the same files each time, from
Python's standard library alone.
"""
import itertools
import math
import pathlib
import random
import re

HERE = pathlib.Path(__file__).resolve().parent
FRAMES = 17
STEP = 1 / 60
TIME = (FRAMES - 1) * STEP  # seconds that a scene lasts


# --- vectors ---------------------------------------------------------------------------------------

def add(a, b):
    return tuple(x + y for x, y in zip(a, b))


def sub(a, b):
    return tuple(x - y for x, y in zip(a, b))


def mul(a, s):
    return tuple(x * s for x in a)


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def length(a):
    return math.sqrt(dot(a, a))


def turn_about(axis, angle):
    """The quaternion of a turn about a unit axis (radians)."""
    s = math.sin(angle / 2)
    return (math.cos(angle / 2), axis[0] * s, axis[1] * s, axis[2] * s)


def after(p, q):
    """The quaternion of q followed by p."""
    (a, *u), (b, *v) = p, q
    return (a * b - dot(u, v),) + add(add(mul(v, a), mul(u, b)), cross(u, v))


def rotate(q, v):
    w, u = q[0], q[1:]
    t = mul(cross(u, v), 2)
    return add(add(v, mul(t, w)), cross(u, t))


def velocity_between(q, r, time):
    """The angular velocity (world) that takes attitude q to r in that time."""
    d = after(r, (q[0], -q[1], -q[2], -q[3]))
    if d[0] < 0:
        d = mul(d, -1)
    s = length(d[1:])
    return mul(d[1:], 2 * math.atan2(s, d[0]) / (s * time)) if s > 1e-12 else (0, 0, 0)


# --- files -----------------------------------------------------------------------------------------

def number(x):
    text = f"{x:.6f}".rstrip("0").rstrip(".")
    return "0" if text in ("-0", "") else text


def vector(v):
    return "[" + ", ".join(number(x) for x in v) + "]"


def body(shape, at, turn=(1, 0, 0, 0), velocity=(0, 0, 0), spin=(0, 0, 0), moving=True):
    text = f"  {{{shape}, translation = {vector(at)}"
    if turn != (1, 0, 0, 0):
        text += f", quaternion_wxyz = {vector(turn)}"
    if any(velocity):
        text += f", velocity = {vector(velocity)}"
    if any(spin):
        text += f", angular_velocity = {vector(spin)}"
    return text + ("" if moving else ", moving = false") + "},\n"


def write_scene(name, words, bodies, shapes=()):
    with open(HERE / f"{name}.toml", "w", encoding="utf-8", newline="\n") as file:
        file.write("".join(f"# {line}\n" for line in words + ["Made by make_scenes.py."]))
        meshes = 'meshes = "hull"\n' if any("mesh = " in body for body in bodies) else ""
        file.write(f'name = "{name.split("/")[-1]}"\n{meshes}frames = {FRAMES}\ntime_step = {STEP!r}\n\n')
        file.write("body = [\n" + "".join(bodies) + "]\n")
        for key, vertices in shapes:
            rows = ", ".join(vector(v) for v in vertices)
            file.write(f'\n[shapes.{key}]\ntype = "hull"\nvertices = [{rows}]\n')


# --- rock pile -------------------------------------------------------------------------------------

def faces_of(points):
    """Triples of points with all others behind them."""
    for a, b, c in itertools.permutations(range(len(points)), 3):
        if a > b or a > c:
            continue
        n = cross(sub(points[b], points[a]), sub(points[c], points[a]))
        if all(dot(n, sub(p, points[a])) <= 1e-12 for p in points):
            yield a, b, c


def rock(rng, count):
    size = [rng.uniform(0.12, 0.3), rng.uniform(0.1, 0.22), rng.uniform(0.07, 0.16)]
    points = []
    while len(points) < count:
        v = [rng.gauss(0, 1) for _ in range(3)]
        v = mul(v, 1 / length(v))
        # Rough, but with every point outside the hull of the others in the end.
        points.append(tuple(round(x * s * rng.uniform(0.85, 1), 4) for x, s in zip(v, size)))
    used = sorted({i for face in faces_of(points) for i in face})
    points = [points[i] for i in used]
    edges = {tuple(sorted(e)) for a, b, c in faces_of(points) for e in ((a, b), (b, c), (c, a))}
    return points, sorted(edges), list(faces_of(points))


def drop(upper, lower, edges, faces):
    """How far points in `upper` can fall before their hull meets that of `lower`."""
    least = math.inf
    for points, others, below in ((upper, lower, True), (lower, upper, False)):
        for x, y, z in points:  # a corner over or under a triangle
            for a, b, c in (faces[1] if below else faces[0]):
                p, q, r = others[a], others[b], others[c]
                area = (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])
                if (area > 0) != below or area == 0:
                    continue
                s = ((x - p[0]) * (r[1] - p[1]) - (y - p[1]) * (r[0] - p[0])) / area
                t = ((q[0] - p[0]) * (y - p[1]) - (q[1] - p[1]) * (x - p[0])) / area
                if s >= 0 and t >= 0 and s + t <= 1:
                    height = p[2] + s * (q[2] - p[2]) + t * (r[2] - p[2])
                    least = min(least, z - height if below else height - z)
    for a, b in edges[0]:  # an edge over an edge
        p, q = upper[a], upper[b]
        for c, d in edges[1]:
            r, s = lower[c], lower[d]
            ux, uy, vx, vy = q[0] - p[0], q[1] - p[1], s[0] - r[0], s[1] - r[1]
            area = ux * vy - uy * vx
            if abs(area) < 1e-12:
                continue
            t = ((r[0] - p[0]) * vy - (r[1] - p[1]) * vx) / area
            u = ((r[0] - p[0]) * uy - (r[1] - p[1]) * ux) / area
            if 0 <= t <= 1 and 0 <= u <= 1:
                least = min(least, p[2] + t * (q[2] - p[2]) - r[2] - u * (s[2] - r[2]))
    return least


def make_rock_pile(count=250, kinds=24, radius=1.1):
    rng = random.Random(1)
    rocks = [rock(rng, rng.choice((8, 10, 12, 14))) for _ in range(kinds)]
    placed, bodies = [], []
    for i in range(count):
        kind = rng.randrange(kinds)
        points, edges, faces = rocks[kind]
        best = None
        for _ in range(5):  # where it comes to lie lowest
            q = [rng.gauss(0, 1) for _ in range(4)]
            q = tuple(round(x / math.sqrt(dot(q, q)), 6) for x in q)
            where, far = rng.uniform(0, 2 * math.pi), radius * math.sqrt(rng.random())
            at = (far * math.cos(where), far * math.sin(where))
            unit = mul(q, 1 / math.sqrt(dot(q, q)))
            world = [add(rotate(unit, p), (*at, 0)) for p in points]
            reach = max(math.hypot(p[0] - at[0], p[1] - at[1]) for p in world)
            height = -min(p[2] for p in world)
            for other_at, other_reach, top, other, kind_below in placed:
                if math.dist(at, other_at) > reach + other_reach or top + 0.4 < height:
                    continue
                fall = drop(world, other, (edges, rocks[kind_below][1]), (faces, rocks[kind_below][2]))
                if fall < math.inf:
                    height = max(height, -fall)
            if best is None or height < best[0]:
                best = (height, at, reach, q, world)
        height, at, reach, q, world = best
        world = [add(p, (0, 0, height)) for p in world]
        placed.append((at, reach, max(p[2] for p in world), world, kind))
        shake = [rng.uniform(-0.05, 0.05) for _ in range(3)]
        spin = [rng.uniform(-0.3, 0.3) for _ in range(3)]
        bodies.append(body(f'shape = "rock{kind}"', (*at, height), q, shake, spin))
    ground = 'shape = {type = "halfspace", normal = [0, 0, 1], offset = 0}'
    write_scene("rock_pile", [f"A pile of {count} rocks of {kinds} kinds, each dropped on those before it until they touch, on the",
                              "ground; the pile is shaken a little."],
                [body(ground, (0, 0, 0), moving=False)] + bodies,
                [(f"rock{i}", points) for i, (points, _, _) in enumerate(rocks)])


# --- crowd -----------------------------------------------------------------------------------------

def figure(phase, height):
    """The parts of a walking figure, x ahead, z up, its lower foot on z = 0: shape, place, attitude.
    Sizes are shares of its height; phase in turns of a double step."""
    parts, soles = [], []
    down = (0, 0, -1)

    def bone(name, start, angle, span, radius):
        """A capsule from start, turned forward from straight down; returns its end."""
        q = turn_about((0, 1, 0), -angle)
        along = rotate(q, down)
        half = span * height / 2
        parts.append((f'shape = {{type = "capsule", radius = {number(radius * height)}, '
                      f'half_length = {number(half - radius * height)}}}',
                      add(start, mul(along, half)), q))
        return add(start, mul(along, 2 * half))

    def block(x, y, z, at, q=(1, 0, 0, 0)):
        parts.append((f'shape = {{type = "box", half_extents = {vector(mul((x, y, z), height))}}}', at, q))

    swing = math.sin(2 * math.pi * phase)
    hips = (0, 0, (0.515 - 0.008 * math.cos(4 * math.pi * phase)) * height)
    twist = turn_about((0, 0, 1), 0.12 * swing)
    block(0.055, 0.095, 0.05, hips)
    block(0.06, 0.11, 0.13, add(hips, (0, 0, 0.19 * height)), twist)
    neck = add(hips, (0, 0, 0.33 * height))
    bone("neck", add(neck, (0, 0, 0.05 * height)), 0, 0.07, 0.03)
    parts.append((f'shape = {{type = "sphere", radius = {number(0.07 * height)}}}',
                  add(neck, (0, 0, 0.115 * height)), (1, 0, 0, 0)))
    for side in (-1, 1):
        leg = math.sin(2 * math.pi * phase + (math.pi if side > 0 else 0))
        bend = 0.15 + 0.45 * max(0, math.cos(2 * math.pi * phase + (math.pi if side > 0 else 0)))
        knee = bone("thigh", add(hips, (0, side * 0.055 * height, -0.02 * height)), 0.42 * leg + 0.1, 0.245, 0.047)
        ankle = bone("shin", knee, 0.42 * leg + 0.1 - bend, 0.235, 0.035)
        tilt = turn_about((0, 1, 0), 0.25 * bend - 0.2 * leg)
        block(0.07, 0.026, 0.018, add(ankle, rotate(tilt, (0.04 * height, 0, -0.005 * height))), tilt)
        soles += [add(parts[-1][1], rotate(tilt, (x * height, 0, -0.018 * height)))[2] for x in (-0.07, 0.07)]
        shoulder = add(neck, rotate(twist, (0, side * 0.143 * height, -0.03 * height)))
        elbow = bone("arm", shoulder, -0.45 * leg, 0.17, 0.03)
        hand = bone("forearm", elbow, -0.45 * leg + 0.35, 0.15, 0.024)
        parts.append((f'shape = {{type = "sphere", radius = {number(0.028 * height)}}}', hand, (1, 0, 0, 0)))
    return [(shape, add(at, (0, 0, -min(soles))), q) for shape, at, q in parts]


def make_crowd(rows=8, columns=8, spacing=0.95):
    rng = random.Random(2)
    bodies = []
    for i, j in itertools.product(range(rows), range(columns)):
        height, speed = rng.uniform(1.55, 1.9), rng.uniform(1.0, 1.5)
        heading = rng.gauss(0, 0.15) + (math.pi if j % 2 else 0)  # in rows past each other
        start = (i * spacing + rng.uniform(-0.2, 0.2), j * spacing * 0.75 + rng.uniform(-0.1, 0.1), 0)
        phase = rng.random()
        first = figure(phase, height)
        last = figure(phase + speed * TIME / (0.83 * height), height)
        turn = turn_about((0, 0, 1), heading)
        ahead = rotate(turn, (speed * TIME, 0, 0))
        for (shape, at, q), (_, to, r) in zip(first, last):
            at, to = add(start, rotate(turn, at)), add(add(start, ahead), rotate(turn, to))
            q, r = after(turn, q), after(turn, r)
            bodies.append(body(shape, at, q, mul(sub(to, at), 1 / TIME), velocity_between(q, r, TIME)))
    ground = f'shape = {{type = "box", half_extents = {vector((6, 5, 0.1))}}}'
    write_scene("crowd", [f"{rows * columns} people of 16 parts (capsules, balls, boxes) who walk past each other in rows. Each part",
                          "moves evenly from its place in the first frame's pose to that in the last one's."],
                [body(ground, (3.3, 2.5, -0.1), moving=False)] + bodies)


# --- arch ------------------------------------------------------------------------------------------

def make_arch(arches=4, stones=23, inner=2.0, depth=0.6, thickness=0.45):
    rng = random.Random(3)
    bodies, shapes = [], []
    pitch = 2 * (inner + thickness)
    wedge = math.pi / stones
    middle = inner + thickness / 2
    profile = []
    for r, sign in ((inner, -1), (inner + thickness, -1), (inner + thickness, 1), (inner, 1)):
        profile.append((r * math.sin(sign * wedge / 2), r * math.cos(wedge / 2) - middle))
    shapes.append(("voussoir", [(x, y, z) for x, z in profile for y in (-depth / 2, depth / 2)]))
    pier = (thickness, depth / 2, 0.25)
    for k in range(arches):
        for i in range(stones):
            angle = math.pi / 2 - (i + 0.5) * wedge
            at = (k * pitch + middle * math.sin(angle), 0, 2.5 + middle * math.cos(angle))
            sink = 0.02 * math.cos(angle) ** 2
            bodies.append(body('shape = "voussoir"', at, turn_about((0, 1, 0), angle),
                               (rng.uniform(-0.002, 0.002), rng.uniform(-0.005, 0.005), -sink)))
    for k in range(arches + 1):
        for i in range(5):
            bodies.append(body(f'shape = {{type = "box", half_extents = {vector(pier)}}}',
                               ((k - 0.5) * pitch, 0, 0.25 + 0.5 * i), moving=False))
    ground = f'shape = {{type = "box", half_extents = {vector((arches * pitch / 2 + 2, 2, 0.2))}}}'
    bodies.append(body(ground, ((arches - 1) * pitch / 2, 0, -0.2), moving=False))
    write_scene("arch", [f"{arches} round arches of {stones} stones each, which rest on each other face to face and on piers of blocks;",
                         "they sink a little, the crown most."], bodies, shapes)


# --- chain net -------------------------------------------------------------------------------------

def write_ring(name, ring, tube, segments=10, sides=6):
    """A ring of convex segments, each closed, that share their end faces; about z."""
    lines = [f"# A ring of radius {ring} and a tube of {tube} (metres), of {segments} convex parts. Made by make_scenes.py.\n"]
    for s in range(segments):
        for end in (s, s + 1):
            u = 2 * math.pi * end / segments
            for k in range(sides):
                v = 2 * math.pi * (k + 0.5) / sides
                r = ring + tube * math.cos(v)
                lines.append(f"v {r * math.cos(u):.7f} {r * math.sin(u):.7f} {tube * math.sin(v):.7f}\n")
        first, second = 1 + 2 * sides * s, 1 + 2 * sides * s + sides
        lines.append("f " + " ".join(str(first + k) for k in range(sides)) + "\n")
        lines.append("f " + " ".join(str(second + sides - 1 - k) for k in range(sides)) + "\n")
        for k in range(sides):
            n = (k + 1) % sides
            lines.append(f"f {first + k} {second + k} {second + n} {first + n}\n")
    (HERE / "chain" / f"{name}.obj").write_text("".join(lines), encoding="utf-8")


def make_chain_net(nodes=10):
    ring, small, tube = 0.05, 0.022, 0.006
    spacing = 2 * ring + 0.014
    write_ring("ring", ring, tube)
    write_ring("link", small, tube)
    bodies = []
    bend = 1 / 1.5  # a metre, of the sheet, which hangs as part of a cylinder

    def place(i, j):
        """Where a point of the sheet is, and its slope."""
        s = (i - (nodes - 1) / 2) * spacing
        return (math.sin(s * bend) / bend, j * spacing, (1 - math.cos(s * bend)) / bend), -s * bend

    def hang(mesh, i, j, upright):
        at, slope = place(i, j)
        swing = (0.15 * math.cos(math.pi * j / nodes), 0, 0.1 * math.sin(2 * math.pi * i / nodes))
        turn = turn_about((0, 1, 0), slope)
        bodies.append(body(f'mesh = "chain/{mesh}.obj", parts = true', at, after(turn, upright), swing))

    flat = (1, 0, 0, 0)
    across, along = turn_about((1, 0, 0), math.pi / 2), turn_about((0, 1, 0), math.pi / 2)
    for i, j in itertools.product(range(nodes), range(nodes)):
        hang("ring", i, j, flat)
        if i + 1 < nodes:
            hang("link", i + 0.5, j, across)
        if j + 1 < nodes:
            hang("link", i, j + 0.5, along)
    write_scene("chain_net", [f"A net of {nodes} by {nodes} rings, each linked to its neighbours by smaller ones, that hangs in a bow and swings.",
                              "Each ring is ten convex bodies."], bodies)


def make_brick_wall(name, words, moving, others=(), courses=16, bricks=12):
    """Sizes are binary fractions, so that faces touch exactly."""
    length, width, height = 0.25, 0.125, 0.0625
    bodies = [body('shape = {type = "halfspace", normal = [0, 0, 1], offset = 0}', (0, 0, 0), moving=False)]
    for course in range(courses):
        # Every second course begins and ends with half a brick.
        sizes = [length] * bricks if course % 2 == 0 else [length / 2] + [length] * (bricks - 1) + [length / 2]
        x = 0
        for size in sizes:
            shape = f'shape = {{type = "box", half_extents = {vector((size / 2, width / 2, height / 2))}}}'
            bodies.append(body(shape, (x + size / 2, 0, (course + 0.5) * height), moving=moving))
            x += size
    write_scene(name, [f"A wall of {courses} courses of bricks on the ground, each brick half over the next, {words[0]}:", *words[1:]],
                bodies + list(others))


# --- home ------------------------------------------------------------------------------------------

def make_shaken_home(speed=1.0, spin=1.0):
    """Walls, floor and doors stay; each piece of furniture is one body."""
    rng = random.Random(1)
    lines = (HERE / "home.toml").read_text(encoding="utf-8").split("\n")
    first = next(i for i, line in enumerate(lines) if line.endswith("Living room."))
    last = lines.index("]")
    for i, line in enumerate(lines[:last]):
        if i < first and 'shape = "door"' in line and "moving" not in line:
            lines[i] = re.sub(r"angular_velocity = \[[^]]*\]", "moving = false", line)
        elif i >= first and line.startswith("  {"):
            kept = re.sub(r", (parts = true|moving = false|(angular_)?velocity = \[[^]]*\])", "", line.removesuffix("},"))
            pushed = [vector([rng.uniform(-most, most) for _ in range(3)]) for most in (speed, spin)]
            lines[i] = f"{kept}, velocity = {pushed[0]}, angular_velocity = {pushed[1]}}},".replace("home/", "../home/")
    head = ["# The furnished flat of home.toml, in which each piece is one body that was pushed: for `touchstone scene simulate`.",
            "# Made by make_scenes.py.", 'name = "home"', 'meshes = "compound"', ""]
    text = "\n".join(head + lines[lines.index("body = ["):])
    (HERE / "simulated/home.toml").write_text(text, encoding="utf-8", newline="\n")


if __name__ == "__main__":
    make_brick_wall("brick_wall", ["at rest", "faces touch exactly."], False)
    ball = body('shape = {type = "sphere", radius = 0.2}', (1.5, -3, 0.6), velocity=(0, 15, 1))
    make_brick_wall("simulated/wall", ["before a ball hits it", "for `touchstone scene simulate`."], True, [ball])
    make_rock_pile()
    make_crowd()
    make_arch()
    make_chain_net()
    make_shaken_home()
