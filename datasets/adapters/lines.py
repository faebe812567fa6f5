"""What the adapters in Python share: the lines of results/peer_protocol.md, and a little algebra."""
import json
import math
import os
import sys
import time

# Standard output is for answers; what a library prints goes to standard error.
_answers = os.fdopen(os.dup(1), "w")
os.dup2(2, 1)


def serve(hello, answer, mesh=None):
    """Writes the first line, and answers every question: answer(question) returns the keys of one, or None for
    `unsupported`. mesh(line), if there is one, gets the meshes. Where repeats are asked for, the answer has their time."""

    def say(line):
        _answers.write(json.dumps(line) + "\n")
        _answers.flush()

    def timed(question):
        if not question.get("repeat"):
            return {}
        start = time.perf_counter()
        for _ in range(question["repeat"]):
            answer(question)
        return {"seconds": time.perf_counter() - start}

    sys.stdin.readline()  # what the program says of itself
    say({"protocol": 1, **hello})
    for line in sys.stdin:
        question = json.loads(line)
        if "id" in question:
            say({"id": question["id"], **(answer(question) or {"status": "unsupported"}), **timed(question)})
        elif mesh:
            mesh(question)


def rows(matrix):
    """The rows of a matrix, of its nine numbers."""
    return [matrix[0:3], matrix[3:6], matrix[6:9]]


def rotated(matrix, v):
    return [sum(m * x for m, x in zip(row, v)) for row in rows(matrix)]


def plus(a, b, factor=1):
    return [x + factor * y for x, y in zip(a, b)]


def unit(v):
    """None if it has no length."""
    length = math.hypot(*v)
    return [x / length for x in v] if length > 0 else None


def quaternion_of(m):
    """The unit quaternion w, x, y, z of a rotation, from its greatest component."""
    a, b, c = m[0], m[4], m[8]
    found = [[1 + a + b + c, m[7] - m[5], m[2] - m[6], m[3] - m[1]],
             [m[7] - m[5], 1 + a - b - c, m[1] + m[3], m[2] + m[6]],
             [m[2] - m[6], m[1] + m[3], 1 - a + b - c, m[5] + m[7]],
             [m[3] - m[1], m[2] + m[6], m[5] + m[7], 1 - a - b + c]]
    return unit(max(enumerate(found), key=lambda one: one[1][one[0]])[1])
