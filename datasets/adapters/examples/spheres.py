"""A peer that answers pairs of spheres by a closed form."""
import json
import math
import sys

shapes = {"tasks": ["intersect", "distance", "penetration", "signed"], "shapes": ["sphere"]}
sys.stdin.readline()  # what the program says of itself
print(json.dumps({"protocol": 1, "name": "spheres-in-python", "version": "1.0", "kinds": {"pair": shapes}}), flush=True)
for line in sys.stdin:
    question = json.loads(line)
    if {question[body]["shape"]["type"] for body in "ab"} != {"sphere"}:
        print(json.dumps({"id": question["id"], "status": "unsupported"}), flush=True)
        continue
    a, b = question["a"]["translation"], question["b"]["translation"]
    ra, rb = question["a"]["shape"]["radius"], question["b"]["shape"]["radius"]
    apart = math.dist(a, b)
    normal = [(y - x) / apart for x, y in zip(a, b)] if apart > 0 else [0, 0, 1]
    print(json.dumps({"id": question["id"], "status": "ok", "distance": apart - (ra + rb), "normal": normal,
                      "a": [x + ra * n for x, n in zip(a, normal)],
                      "b": [x - rb * n for x, n in zip(b, normal)]}), flush=True)
