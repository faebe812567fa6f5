#!/usr/bin/env python3
"""Makes the pieces of furniture in datasets/home/.

    sudo apt-get install sweethome3d-furniture
    python3 datasets/home/make_home.py

Needs Debian's package sweethome3d-furniture (1.8) and Python's standard library alone, and gives the
same files each time. README.md says what is done to a piece.
"""
import math
import pathlib
import random
import re
import zipfile

ARCHIVE = "/usr/share/sweethome3d/furniture/BlendSwap-CC-0.sh3f"
HERE = pathlib.Path(__file__).resolve().parent
CATALOGUE = "PluginFurnitureCatalog.properties"

SMALLEST_PART = 0.02  # metres; a part's longest side
HIDDEN = 0.003  # metres; a part within another's box, widened by this, is left out
DIRECTIONS = 96  # a part keeps the vertices that are extreme in these directions
UNITS = 100_000  # a metre; coordinates are whole numbers of these

# name here: number in the catalogue
PIECES = {
    "armchair": 99, "basketball": 78, "bed": 3, "bedside_table": 4, "bench": 103, "bookcase": 6,
    "bread": 90, "coffee_cup": 9, "corner_couch": 112, "cupcake": 142, "desk": 152, "desk_lamp": 15,
    "dining_chair": 93, "dining_table": 134, "drawers": 144, "dustbin": 115, "glass": 89,
    "kitchen_cupboard": 153, "milk": 53, "oak_table": 27, "office_chair": 171, "phone": 70,
    "plant": 77, "puzzle": 18, "radiator": 36, "refrigerator": 128, "shelves": 39, "sink": 165,
    "slippers": 85, "sofa": 132, "speaker": 44, "stool": 168, "stove": 169, "teddy_bear": 51,
    "television": 22, "tall_shelves": 61, "toilet": 57, "toy": 175, "upper_cupboard": 172,
    "wardrobe": 68, "wall_shelves": 174, "yogurt": 64,
}


# --- pieces ----------------------------------------------------------------------------------------

def read_catalogue(archive):
    entries = {}
    for line in archive.read(CATALOGUE).decode("latin-1").splitlines():
        found = re.match(r"(\w+)#(\d+)=(.*)", line.strip())
        if found:
            entries.setdefault(int(found[2]), {})[found[1]] = found[3]
    return entries


def read_obj(text):
    vertices, faces = [], []
    for line in text.splitlines():
        words = line.split()
        if words[:1] == ["v"]:
            vertices.append(tuple(float(w) for w in words[1:4]))
        elif words[:1] == ["f"]:
            indices = [int(w.split("/")[0]) for w in words[1:]]
            faces.append([i - 1 if i > 0 else len(vertices) + i for i in indices])
    return vertices, faces


def to_metres(vertices, entry):
    """Turned as the catalogue says, z up, front to -y, true size, on the floor around the origin."""
    turn = [float(w) for w in entry.get("modelRotation", "1 0 0 0 1 0 0 0 1").split()]
    vertices = [tuple(sum(turn[3 * r + c] * v[c] for c in range(3)) for r in range(3))
                for v in vertices]
    vertices = [(x, -z, y) for x, y, z in vertices]
    low, high = box_of(vertices)
    size = [float(entry[key]) / 100 for key in ("width", "depth", "height")]
    scale = [size[k] / (high[k] - low[k]) for k in range(3)]
    base = ((low[0] + high[0]) / 2, (low[1] + high[1]) / 2, low[2])
    return [tuple((v[k] - base[k]) * scale[k] for k in range(3)) for v in vertices]


def box_of(points):
    return ([min(p[k] for p in points) for k in range(3)],
            [max(p[k] for p in points) for k in range(3)])


def connected_parts(vertices, faces):
    """Sets of points that hang together by faces; vertices at the same place are one."""
    index = {}
    welded = [index.setdefault(tuple(round(c, 6) for c in v), len(index)) for v in vertices]
    parent = list(range(len(index)))

    def root(i):
        while parent[i] != i:
            parent[i] = parent[parent[i]]
            i = parent[i]
        return i

    for face in faces:
        for i in face[1:]:
            parent[root(welded[i])] = root(welded[face[0]])
    points = list(index)
    parts = {}
    for i in sorted({welded[i] for face in faces for i in face}):
        parts.setdefault(root(i), []).append(points[i])
    return list(parts.values())


def directions():
    """Spread evenly over the sphere on a spiral, and the six axes."""
    result = [(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)]
    for i in range(DIRECTIONS):
        z = 1 - (2 * i + 1) / DIRECTIONS
        angle = i * math.pi * (3 - math.sqrt(5))
        r = math.sqrt(1 - z * z)
        result.append((r * math.cos(angle), r * math.sin(angle), z))
    return result


def extreme_points(points, spread):
    """Directions are those of the part drawn out to a cube, so that flat parts keep their rims."""
    low, high = box_of(points)
    scale = [1 / max(high[k] - low[k], 1e-9) for k in range(3)]
    drawn = [tuple(p[k] * scale[k] for k in range(3)) for p in points]
    kept = {max(range(len(points)), key=lambda i: (sum(a * b for a, b in zip(d, drawn[i])), -i))
            for d in spread}
    return sorted({tuple(round(c * UNITS) for c in points[i]) for i in kept})


def hull_triangles(points):
    """Triangles of the hull, anticlockwise from outside: incremental, in whole numbers, of points
    moved by less than a millionth of a unit, so that no four are in a plane."""
    jitter = random.Random(1)
    moved = [tuple((c << 24) + jitter.randrange(16) for c in p) for p in points]

    def volume(a, b, c, d):
        u, v, w = ([moved[i][k] - moved[a][k] for k in range(3)] for i in (b, c, d))
        return (u[0] * (v[1] * w[2] - v[2] * w[1]) + u[1] * (v[2] * w[0] - v[0] * w[2])
                + u[2] * (v[0] * w[1] - v[1] * w[0]))

    # volume > 0: d is on the side from which a, b, c is anticlockwise.
    first = (0, 1, 2) if volume(0, 1, 2, 3) < 0 else (0, 2, 1)
    a, b, c = first
    triangles = {first, (a, 3, b), (b, 3, c), (c, 3, a)}
    for p in range(4, len(points)):
        seen = {t for t in triangles if volume(*t, p) > 0}
        edges = {(t[k], t[(k + 1) % 3]) for t in seen for k in range(3)}
        triangles -= seen
        triangles |= {(i, j, p) for i, j in edges if (j, i) not in edges}
    return sorted(triangles)


def parts_of(archive, entry, spread):
    """The points to keep of a piece's parts, the largest part first."""
    vertices, faces = read_obj(archive.read(entry["model"].lstrip("/")).decode("latin-1"))
    parts = connected_parts(to_metres(vertices, entry), faces)
    boxes = sorted(((box_of(p), p) for p in parts),
                   key=lambda bp: -math.prod(h - l + 0.001 for l, h in zip(*bp[0])))
    kept, result = [], []
    for (low, high), points in boxes:
        if max(h - l for l, h in zip(low, high)) < SMALLEST_PART:
            continue
        if any(all(low[k] >= other[0][k] - HIDDEN and high[k] <= other[1][k] + HIDDEN
                   for k in range(3)) for other in kept):
            continue
        corners = extreme_points(points, spread)
        if len(corners) >= 4:
            kept.append((low, high))
            result.append(corners)
    return result


def main():
    archive = zipfile.ZipFile(ARCHIVE)
    catalogue = read_catalogue(archive)
    spread = directions()
    for name, number in PIECES.items():
        entry = catalogue[number]
        size = " x ".join(f"{float(entry[k]) / 100:g}" for k in ("width", "depth", "height"))
        lines = [f"# {entry['name']} by {entry['creator']}, {size} m: number {number} of Sweet Home 3D's",
                 "# Blend Swap CC-0 catalogue, reduced. Public domain (CC0 1.0)."]
        parts = parts_of(archive, entry, spread)
        count = 0
        for number_of_part, points in enumerate(parts, 1):
            lines.append(f"o {number_of_part}")
            triangles = hull_triangles(points)
            used = sorted({i for t in triangles for i in t})
            place = {i: count + k + 1 for k, i in enumerate(used)}
            lines += ["v " + " ".join(f"{c / UNITS:g}" for c in points[i]) for i in used]
            lines += ["f " + " ".join(str(place[i]) for i in t) for t in triangles]
            count += len(used)
        (HERE / f"{name}.obj").write_text("\n".join(lines) + "\n")
        print(f"| {name} | {number} | {entry['name']} | {entry['creator']} | {size} | {len(parts)} |")


if __name__ == "__main__":
    main()
