"""Answers pairs of spheres, but has the fault that it is called with from the question with a number on."""
import json
import math
import os
import signal
import sys
import time

fault, first = sys.argv[1], int(sys.argv[2])


def say(text):
    sys.stdout.write(text)
    sys.stdout.flush()


def answer(question):
    a, b = question["a"], question["b"]
    apart = math.dist(a["translation"], b["translation"])
    return {"id": question["id"], "status": "ok", "distance": apart - a["shape"]["radius"] - b["shape"]["radius"]}


def fork_bomb():
    for _ in range(50):
        if os.fork() == 0:
            os.setsid()  # leaves the process group
            time.sleep(600)
            os._exit(0)


sys.stdin.readline()
if fault == "silent-start":
    time.sleep(600)
if fault == "no-json":
    say("hello\n")
    sys.exit(0)
hello = {"protocol": 1, "name": "hostile-" + fault, "kinds": {"pair": {"tasks": ["distance"], "shapes": ["sphere"]}}}
if len(sys.argv) > 3:
    hello["name"], hello["version"] = sys.argv[3:]
say(json.dumps(hello) + "\n")
for number, line in enumerate(sys.stdin):
    reply = json.dumps(answer(json.loads(line))) + "\n"
    if number < first or fault == "none":
        say(reply)
    elif fault == "wrong-sign":
        reply = json.loads(reply)
        reply["distance"] *= -1
        say(json.dumps(reply) + "\n")
    elif fault == "exit":
        sys.stderr.write("the last words\n")
        sys.exit(3)
    elif fault == "signal":
        os.kill(os.getpid(), signal.SIGSEGV)
    elif fault == "hang":
        time.sleep(600)
    elif fault == "garbage":
        say("Traceback (most recent call last):\n")
    elif fault == "nan":
        say(json.dumps({"id": json.loads(line)["id"], "distance": math.nan}) + "\n")
    elif fault == "wrong-type":
        say(json.dumps({"id": json.loads(line)["id"], "distance": "1"}) + "\n")
    elif fault == "extra-line":
        say(reply + reply)
    elif fault == "no-line":
        continue
    elif fault == "closed-output":
        sys.stdout.flush()
        os.close(1)
        time.sleep(600)
    elif fault == "endless-line":
        while True:
            say("x" * 65536)
    elif fault == "endless-lines":
        while True:
            say("{}\n" * 16384)
    elif fault == "memory":
        kept = []
        while True:
            kept.append(b"x" * (1 << 24))
    elif fault == "fork-bomb":
        if number == first:
            fork_bomb()
        say(reply)
