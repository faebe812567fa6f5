"""Answers frames of boxes, but has the fault that it is called with from the frame with a number on."""
import json
import os
import struct
import sys
import time

fault, first = sys.argv[1], int(sys.argv[2])
lines, answers = sys.stdin.buffer, sys.stdout.buffer


def say(line, packed=b""):
    answers.write(json.dumps(line).encode() + b"\n" + packed)
    answers.flush()


lines.readline()
say({"protocol": 1, "name": "hostile-" + fault, "kinds": {"box": {"tasks": ["pairs"]}}})
number = 0
while line := lines.readline():
    question = json.loads(line)
    boxes = list(struct.iter_unpack("<6f", lines.read(question["bytes"])))
    pairs = [(i, j) for j, b in enumerate(boxes) for i, a in enumerate(boxes[:j])
             if all(a[k] <= b[k + 3] and b[k] <= a[k + 3] for k in range(3))]
    head, packed = {"id": question["id"], "status": "ok", "pairs": len(pairs)}, None
    if number >= first:
        if fault == "missing":
            pairs, head["pairs"] = pairs[1:], len(pairs) - 1
        elif fault == "swapped":
            pairs = [(j, i) for i, j in pairs]
        elif fault == "absent-box":
            pairs[0] = (0, len(boxes))
        elif fault == "too-many":
            head["pairs"] = 10**18
        elif fault == "fraction":
            head["pairs"] = 0.5
        elif fault == "wrong-id":
            head["id"] = "x"
        elif fault == "no-json":
            packed = b"\0" * 100
        elif fault == "short":
            answers.write(json.dumps(head).encode() + b"\n" + b"\0" * 7)
            answers.flush()
            sys.exit(0)
        elif fault == "hang":
            answers.write(json.dumps(head).encode() + b"\n" + b"\0" * 7)
            answers.flush()
            time.sleep(600)
        elif fault == "endless":
            while True:
                answers.write(b"\1" * 65536)
        elif fault == "exit":
            os._exit(3)
        elif fault == "unsupported":
            head, pairs = {"id": question["id"], "status": "unsupported"}, []
    if packed is None:
        packed = b"".join(struct.pack("<2I", *pair) for pair in pairs)
        say(head, packed)
    else:
        answers.write(packed + b"\n")
        answers.flush()
    number += 1
