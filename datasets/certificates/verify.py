#!/usr/bin/env python3
"""Verifies certificates of pairs in fractions: python3 verify.py proofs.jsonl

A second verifier beside the one in C++, written from results/certificates.md: it shares no code, no language
and no arithmetic with the program that makes the proofs. Every number is a Fraction, which Python makes of a
double without rounding, and no comparison is approximate. The one thing that is rounded is a root, upward.
It needs Python 3.8 and its standard library alone.

Prints the line and the reason of each certificate that proves nothing, then counts. The exit status is 0 if
all hold, 1 if one does not, 2 if a line is no certificate of a pair, there is none, or a file cannot be read.
"""
import json
import math
import re
import sys
from fractions import Fraction


class Fault(Exception):
    """Why a certificate proves nothing."""


class Malformed(Exception):
    """Why a line is no certificate of a pair."""


def require(holds, otherwise, error=Fault):
    if not holds:
        raise error(otherwise)


# --- numbers ---


def number(x):
    """A JSON number as an exact fraction."""
    good = isinstance(x, (int, float)) and not isinstance(x, bool) and math.isfinite(x)
    require(good, f"{x!r} is no finite number", Malformed)
    return Fraction(float(x))


def size(x):
    x = number(x)
    require(x >= 0, f"the length {float(x)} is negative", Malformed)
    return x


def hexadecimal(text):
    """A number such as "-0x1.8p-1", of at most 64 significant bits."""
    match = re.fullmatch(r"(-?)0x([0-9a-f]+)(?:\.([0-9a-f]*))?p([+-]?[0-9]{1,6})", str(text))
    require(match, f"{text!r} is no hexadecimal number", Malformed)
    sign, whole, part, power = match[1], match[2], match[3] or "", int(match[4]) - 4 * len(match[3] or "")
    digits = int(whole + part, 16)
    odd = digits // (digits & -digits) if digits else 0
    require(odd.bit_length() <= 64 and -16445 <= power <= 16383, f"{text!r} is no long double", Malformed)
    value = digits * (Fraction(2) ** power)
    return -value if sign else value


def integer(text):
    """A string of at most 100,000 digits."""
    require(isinstance(text, str) and len(text) <= 100_001, "no integer, or a longer one than any proof has", Malformed)
    require(re.fullmatch(r"0|-?[1-9][0-9]*", text), f"{text!r} is no integer", Malformed)
    return -natural(text[1:]) if text[0] == "-" else natural(text)


def natural(digits):
    """Python limits the digits that it reads at once, for a whole process: longer numbers are read in halves."""
    if len(digits) <= 500:
        return int(digits)
    half = len(digits) // 2
    return natural(digits[:-half]) * 10**half + natural(digits[-half:])


def root_above(x, bits):
    """An upper bound on the root of x >= 0; the root itself if that is a fraction."""
    square = (x.numerator * x.denominator) << (2 * bits)
    root = math.isqrt(square)
    if root * root != square:
        root += 1
    return Fraction(root, x.denominator << bits)


INFINITE = None  # in place of the square of a length


class Length:
    """A signed length, as its sign and its square, which are exact; the square may be INFINITE."""

    def __init__(self, sign, square):
        self.sign, self.square = sign, square

    @staticmethod
    def over(x, square):
        """x / sqrt(square)."""
        return Length((x > 0) - (x < 0), x * x / square)

    def __le__(self, other):
        if self.sign != other.sign:
            return self.sign < other.sign
        if self.sign == 0:
            return True
        small, large = (self, other) if self.sign > 0 else (other, self)
        return large.square is INFINITE or (small.square is not INFINITE and small.square <= large.square)

    def __lt__(self, other):
        return not other <= self


def claimed_length(root):
    sign = root["sign"]
    require(type(sign) is int and sign in (-1, 0, 1), "a sign is not -1, 0 or 1", Malformed)
    numerator, denominator = integer(root["numerator"]), integer(root["denominator"])
    good = numerator > 0 and denominator >= 0 if sign else numerator == 0 and denominator > 0
    require(good, "a claimed bound is not a number")
    if denominator == 0:
        return Length(sign, INFINITE)
    return Length(sign, Fraction(numerator, denominator))


# --- vectors ---


def vector(three, of=number):
    require(isinstance(three, list) and len(three) == 3, f"{three!r} are not three numbers", Malformed)
    return tuple(of(x) for x in three)


def dot(u, v):
    return u[0] * v[0] + u[1] * v[1] + u[2] * v[2]


def cross(u, v):
    return (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])


def plus(u, v):
    return tuple(x + y for x, y in zip(u, v))


def minus(u, v):
    return tuple(x - y for x, y in zip(u, v))


def times(s, v):
    return tuple(s * x for x in v)


# --- bodies ---


def rotation_rows(body):
    """The rows of the matrix, as it stands there; that of an exact quaternion is R(q) / |q|^2."""
    if "quaternion_exact" in body:
        require("rotation" not in body, "both a rotation and a quaternion", Malformed)
        w, x, y, z = (number(part) for part in body["quaternion_exact"])
        square = w * w + x * x + y * y + z * z
        require(square > 0, "the zero quaternion", Malformed)
        rows = (
            (w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y)),
            (2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x)),
            (2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z),
        )
        return tuple(times(1 / square, row) for row in rows)
    entries = [number(x) for x in body.get("rotation", [1, 0, 0, 0, 1, 0, 0, 0, 1])]
    require(len(entries) == 9, "a rotation has nine numbers", Malformed)
    return tuple(tuple(entries[k : k + 3]) for k in (0, 3, 6))


# The keys of a body, and of each shape. Others could change what the body is.
BODY_KEYS = {"shape", "translation", "rotation", "quaternion_exact"}
SHAPE_KEYS = {
    "sphere": {"radius"},
    "capsule": {"radius", "half_length", "axis"},
    "box": {"half_extents"},
    "cylinder": {"radius", "half_length", "axis"},
    "cone": {"radius", "half_length", "axis"},
    "ellipsoid": {"radii"},
    "hull": {"vertices"},
    "halfspace": {"normal", "offset"},
}


def require_keys(of, known):
    strange = set(of) - known
    require(not strange, f"the keys {sorted(strange)} of a body are not in the format", Malformed)


class Core:
    """A body without the ball around it, at its place in the world."""

    def __init__(self, body, bits):
        shape = body["shape"]
        require_keys(body, BODY_KEYS)
        require(shape["type"] in SHAPE_KEYS, f"the shape {shape['type']!r}", Malformed)
        require_keys(shape, SHAPE_KEYS[shape["type"]] | {"type"})
        self.bits = bits
        self.rows = rotation_rows(body)
        self.translation = vector(body.get("translation", [0, 0, 0]))
        self.radius = Fraction(0)
        self.vertices = None  # of a polytope, in the body's axes
        self.extents = None  # of a cylinder or cone: radius, radius, half length; of an ellipsoid: its semi-axes
        self.normal = None  # of a half-space, in the world, with the height of its plane
        self.kind = shape["type"]
        require(shape.get("axis", "z") == "z", "another axis than z", Malformed)
        if self.kind in ("sphere", "capsule"):
            self.radius = size(shape["radius"])
            half = size(shape["half_length"]) if self.kind == "capsule" else None
            self.vertices = [(0, 0, 0)] if half is None else [(0, 0, -half), (0, 0, half)]
        elif self.kind == "box":
            half = vector(shape["half_extents"], size)
            self.vertices = [tuple(h if i >> k & 1 else -h for k, h in enumerate(half)) for i in range(8)]
        elif self.kind == "hull":
            self.vertices = [vector(v) for v in shape["vertices"]]
            require(self.vertices, "a hull has no vertices", Malformed)
        elif self.kind in ("cylinder", "cone"):
            radius = size(shape["radius"])
            self.set_curved((radius, radius, size(shape["half_length"])), ends=(0, 0, 1))
        elif self.kind == "ellipsoid":
            self.set_curved(vector(shape["radii"], size), ends=(1, 1, 1))
        else:
            self.set_plane(vector(shape["normal"]), number(shape["offset"]))

    def set_curved(self, extents, ends):
        """What is a point or a segment is the polytope of its two ends."""
        self.extents = extents
        if sum(extent > 0 for extent in extents) < 2:
            top = tuple(e * x for e, x in zip(ends, extents))
            self.vertices = [times(-1, top), top]

    def set_plane(self, normal, offset):
        """The image of normal . x <= offset: normals go by the cofactors of the matrix."""
        require(any(normal), "the normal of a half-space is zero", Malformed)
        r = self.rows
        cofactors = (cross(r[1], r[2]), cross(r[2], r[0]), cross(r[0], r[1]))
        determinant = dot(r[0], cofactors[0])
        sign = (determinant > 0) - (determinant < 0)
        self.normal = tuple(sign * dot(row, normal) for row in cofactors)
        self.height = abs(determinant) * offset + dot(self.normal, self.translation)

    def require_plane(self):
        require(any(self.normal), "the matrix of a half-space is singular")

    def support(self, n):
        """An upper bound on n . x over the core; None if there is none."""
        if self.normal is not None:
            along = dot(n, self.normal)
            if any(cross(n, self.normal)) or along <= 0:
                return None
            return along / dot(self.normal, self.normal) * self.height
        u = tuple(sum(n[i] * self.rows[i][k] for i in range(3)) for k in range(3))
        return self.support_in_body(u) + dot(n, self.translation)

    def support_in_body(self, u):
        if self.vertices is not None:
            return max(dot(u, v) for v in self.vertices)
        if self.kind == "ellipsoid":
            scaled = tuple(e * x for e, x in zip(self.extents, u))
            return root_above(dot(scaled, scaled), self.bits)
        rim = self.extents[0] * root_above(u[0] * u[0] + u[1] * u[1], self.bits)
        end = self.extents[2] * u[2]
        return abs(end) + rim if self.kind == "cylinder" else max(end, rim - end)

    def holds(self, x):
        """Whether a curved core has the point, in its own axes."""
        if self.kind == "ellipsoid":
            flat = all(e > 0 or y == 0 for e, y in zip(self.extents, x))
            return flat and sum(y * y / (e * e) for e, y in zip(self.extents, x) if e > 0) <= 1
        radius, _, half = self.extents
        off_axis = x[0] * x[0] + x[1] * x[1]
        if abs(x[2]) > half or off_axis > radius * radius:
            return False
        return self.kind == "cylinder" or 4 * half * half * off_axis <= (radius * (half - x[2])) ** 2

    def points(self, generators):
        """The generators in the world, each of them a point of the core."""
        if self.normal is not None:
            self.require_plane()
            require(not generators, "a half-space has no generators")
            return [times(self.height / dot(self.normal, self.normal), self.normal)]
        return [self.in_world(self.generator(g)) for g in generators]

    def in_world(self, x):
        return plus(tuple(dot(row, x) for row in self.rows), self.translation)

    def generator(self, g):
        if self.vertices is not None:
            known = isinstance(g, int) and g < len(self.vertices)
            require(known, "a generator names no vertex of its polytope")
            return self.vertices[g]
        require(isinstance(g, list), "a generator names a vertex of a body that has none")
        x = vector(g, hexadecimal)
        require(self.holds(x), "a generator lies outside its body")
        return x


# --- proofs ---


class Difference:
    """Points of the difference of two cores, by the numbers of their generators."""

    def __init__(self, a, b):
        self.a, self.b = a, b

    def point(self, i, j):
        require(i < len(self.a) and j < len(self.b), "a point names no generator")
        return minus(self.a[i], self.b[j])

    def mean(self, terms):
        total, whole = (0, 0, 0), 0
        for i, j, text in terms:
            weight = integer(text)
            require(weight > 0, "a weight is not positive")
            total, whole = plus(total, times(weight, self.point(i, j))), whole + weight
        return times(Fraction(1, whole), total)


def gap_along(n, a, b):
    """How far apart the shadows of the cores on a line along n are: a lower bound."""
    reach_a, reach_b = a.support(n), b.support(times(-1, n))
    if reach_a is None or reach_b is None:
        return Length(-1, INFINITE)
    return Length.over(-reach_a - reach_b, dot(n, n))


def depth_of(surface, difference):
    """Minus the radius of a ball around the origin that is within a closed surface: an upper bound."""
    points = [difference.point(i, j) for i, j in surface["points"]]
    edges, least = set(), Length(-1, INFINITE)
    for corners in surface["triangles"]:
        require(all(c < len(points) for c in corners), "a triangle names no point")
        for k in range(3):
            edge = (corners[k], corners[(k + 1) % 3])
            require(edge not in edges, "an edge of the surface is there twice")
            edges.add(edge)
        p, q, r = (points[c] for c in corners)
        n = cross(minus(q, p), minus(r, p))
        height = dot(n, p)
        require(height > 0, "the origin is not on the inner side of each triangle")
        plane = Length.over(-height, dot(n, n))
        least = plane if least < plane else least
    require(all((head, tail) in edges for tail, head in edges), "the surface is not closed")
    return least


def distance_of(closest, difference, a, b):
    """How far from the origin a mean of points of the difference is: an upper bound."""
    z = difference.mean(closest)
    if a.normal is None and b.normal is None:
        return Length(1 if any(z) else 0, dot(z, z))
    n = a.normal if a.normal is not None else b.normal
    height = dot(n, z) if b.normal is not None and a.normal is None else -dot(n, z)
    return Length.over(height, dot(n, n))


def proven_upper(proof, a, b, upper):
    if upper.sign > 0 and upper.square is INFINITE:
        return upper
    difference = Difference(a.points(proof["generators_a"]), b.points(proof["generators_b"]))
    if a.normal is not None and b.normal is not None:
        facing = not any(cross(a.normal, b.normal)) and dot(a.normal, b.normal) < 0
        return gap_along(a.normal, a, b) if facing else Length(-1, INFINITE)
    closest, surface = proof["closest"], proof["surface"]
    require(closest or surface["triangles"], "nothing is there to prove the upper bound")
    best = Length(1, INFINITE)
    if closest:
        best = distance_of(closest, difference, a, b)
    if surface["triangles"]:
        require(a.normal is None and b.normal is None, "a half-space has no surface")
        depth = depth_of(surface, difference)
        best = depth if depth < best else best
    return best


def index(x):
    require(isinstance(x, int) and not isinstance(x, bool) and 0 <= x < 2**32, f"{x!r} is no index", Malformed)
    return x


def items(list_of, count, reads):
    """Reads a list of lists of `count` items, each by its own of `reads`."""
    require(isinstance(list_of, list), f"{list_of!r} is no list", Malformed)
    for one in list_of:
        require(isinstance(one, list) and len(one) == count, f"{one!r} has not {count} items", Malformed)
        for read, item in zip(reads, one):
            read(item)


def require_form(proof):
    """Raises Malformed unless every part is well formed, also what the claim does not need."""
    for key in ("id", "encoding"):
        require(isinstance(proof[key], str), f"{key} is no string", Malformed)
    answers = ("separated", "touching", "overlapping", "unknown")
    require(proof["answer"] in answers, f"the answer {proof['answer']!r}", Malformed)
    for key in ("generators_a", "generators_b"):
        require(isinstance(proof[key], list), f"{key} is no list", Malformed)
        for generator in proof[key]:
            vector(generator, hexadecimal) if isinstance(generator, list) else index(generator)
    items(proof["closest"], 3, (index, index, integer))
    items(proof["surface"]["points"], 2, (index, index))
    items(proof["surface"]["triangles"], 3, (index, index, index))


def check(proof):
    """Raises Fault unless the certificate proves its answer and bounds."""
    require_form(proof)
    lower, upper = claimed_length(proof["lower"]), claimed_length(proof["upper"])
    bits = 256 + 2 * max(len(proof["lower"][key]) for key in ("numerator", "denominator")) * 4
    a, b = Core(proof["a"], bits), Core(proof["b"], bits)
    n = vector(proof["direction"], integer)
    gap = gap_along(n, a, b) if any(n) else Length(-1, INFINITE)
    require(lower <= gap, "the direction does not prove the lower bound")
    require(proven_upper(proof, a, b, upper) <= upper, "the points do not prove the upper bound")
    radii = a.radius + b.radius
    contact = Length(1 if radii > 0 else 0, radii * radii)
    answer = "unknown"
    if contact < lower:
        answer = "separated"
    elif upper < contact:
        answer = "overlapping"
    elif contact <= lower and upper <= contact:
        answer = "touching"
    require(proof["answer"] == answer, "the answer does not follow from the bounds")


def judge(text):
    """Why a line proves nothing, and whether it is malformed; nothing if it proves its claim."""
    try:
        check(json.loads(text))
        return None
    except Fault as fault:
        return f"refused: {fault}", False
    except (Malformed, KeyError, TypeError, ValueError, AttributeError, OverflowError, RecursionError) as error:
        return f"no certificate of a pair: {error!r}", True


def main(files):
    proven, refused, malformed = 0, 0, 0
    for name in files:
        try:
            lines = sys.stdin.buffer if name == "-" else open(name, "rb")
        except OSError as error:
            print(f"{name}: {error.strerror}")
            malformed += 1
            continue
        with lines:
            for count, line in enumerate(lines, 1):
                text = line.decode("utf-8-sig" if count == 1 else "utf-8", errors="surrogateescape")
                if not text.strip():
                    continue
                why = judge(text)
                proven += why is None
                refused += why is not None and not why[1]
                malformed += why is not None and why[1]
                if why is not None:
                    print(f"{name}:{count}: {why[0]}")
    print(f"{proven} proven, {refused} refused, {malformed} malformed")
    return 2 if malformed or proven + refused == 0 else 1 if refused else 0


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit("usage: verify.py PROOFS.jsonl ... (- for standard input)")
    sys.exit(main(sys.argv[1:]))
