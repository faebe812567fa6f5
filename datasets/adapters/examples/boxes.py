"""A peer that answers frames of boxes by testing all pairs. Boxes come and pairs go as packed numbers."""
import json
import struct
import sys

lines, answers = sys.stdin.buffer, sys.stdout.buffer


def say(line, packed=b""):
    answers.write(json.dumps(line).encode() + b"\n" + packed)
    answers.flush()


lines.readline()  # what the program says of itself
say({"protocol": 1, "name": "boxes-in-python", "version": "1.0", "kinds": {"box": {"tasks": ["pairs"]}}})
while line := lines.readline():
    question = json.loads(line)
    boxes = list(struct.iter_unpack("<6f", lines.read(question["bytes"])))
    pairs = [(i, j) for j, b in enumerate(boxes) for i, a in enumerate(boxes[:j])
             if all(a[k] <= b[k + 3] and b[k] <= a[k + 3] for k in range(3))]
    packed = b"".join(struct.pack("<2I", *pair) for pair in pairs)
    say({"id": question["id"], "status": "ok", "pairs": len(pairs)}, packed)
