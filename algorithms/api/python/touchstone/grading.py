"""Grades algorithms that are written in Python, by Touchstone's program."""

import csv
import json
import math
import os
import re
import shutil
import subprocess
import tempfile
import traceback
from collections import Counter
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Dict, List, Optional, Sequence, Union

import numpy as np

from ._core import Body, Error, Result, Shape

# The methods of an algorithm, and the tasks of the program.
_TASKS = {
    "intersects": "intersect",
    "distance": "distance",
    "penetration": "penetration",
    "signed_distance": "signed",
}


@dataclass
class Grades:
    """What `check` found.

    rows: one for each question, the columns of Touchstone's grades.csv as texts.
    text: the summary, as the program prints it.
    errors: the traces of exceptions; each is an answer that was given up.
    """

    rows: List[Dict[str, str]]
    text: str
    errors: List[str]

    @property
    def counts(self) -> "Counter[str]":
        """How many answers have each grade: right, near, missed, false_hit, inexact, bound, gave_up or failed."""
        return Counter(row["grade"] for row in self.rows)

    @property
    def wrong(self) -> List[Dict[str, str]]:
        """The rows of wrong answers."""
        return [row for row in self.rows if row["grade"] not in ("right", "near", "bound", "gave_up")]

    def frame(self) -> Any:
        """The rows as a pandas.DataFrame, with numbers where all of a column are."""
        import pandas

        table = pandas.DataFrame(self.rows)
        for name in table:
            try:
                table[name] = pandas.to_numeric(table[name])
            except (TypeError, ValueError):
                pass
        return table

    def __str__(self) -> str:
        return self.text


def _program(given: Optional[str]) -> str:
    found = given or os.environ.get("TOUCHSTONE") or shutil.which("touchstone")
    if found:
        return str(found)
    raise Error("the program touchstone is not installed; expected it in PATH, in the variable TOUCHSTONE, or as `program`")


def _body(question: Dict[str, Any]) -> Body:
    shape, kind = question["shape"], question["shape"]["type"]
    if kind == "hull":
        made = Shape.hull(shape["vertices"])
    elif kind == "halfspace":
        made = Shape.halfspace(shape["normal"], shape["offset"])
    elif kind == "box":
        made = Shape.box(shape["half_extents"])
    elif kind == "ellipsoid":
        made = Shape.ellipsoid(shape["radii"])
    elif kind == "sphere":
        made = Shape.sphere(shape["radius"])
    else:
        made = getattr(Shape, kind)(shape["radius"], shape["half_length"])
    return Body(made, (np.reshape(question.get("rotation", np.eye(3)), (3, 3)), question.get("translation", [0, 0, 0])))


def _numbers(values: Any) -> Any:
    """JSON has no NaN: a number that is not known is null."""
    listed = np.asarray(values, dtype=float)
    if listed.ndim == 0:
        return float(listed) if math.isfinite(listed) else None
    return [_numbers(x) for x in listed]


def _answer(found: Any, task: str) -> Dict[str, Any]:
    """What a method returned, as an answer of the protocol."""
    if found is None or found is NotImplemented:
        return {"status": "unsupported"}
    if isinstance(found, dict):
        return found
    if isinstance(found, str):
        return {"answer": found}
    if isinstance(found, Result):
        answer = {"answer": found.answer, "status": found.status}
        for key, value in (("distance", found.distance), ("lower", found.lower), ("upper", found.upper),
                           ("normal", found.normal), ("a", found.on_a), ("b", found.on_b)):
            answer[key] = _numbers(value)
        return answer
    if isinstance(found, (bool, np.bool_)):
        if task != "intersect":
            raise Error(f"found {found} as an answer to {task}; expected a number of metres")
        return {"answer": "overlapping" if found else "separated"}
    number = float(found)
    if not math.isfinite(number):
        return {"answer": "unknown", "status": "degenerate"}
    apart = number > 0
    if (task == "distance" and not apart) or (task == "penetration" and apart):
        return {"answer": "separated" if apart else "overlapping" if number < 0 else "touching"}
    return {"distance": number}


def _plain(value: Any) -> Any:
    """NumPy's scalars and arrays, of which JSON knows nothing."""
    if isinstance(value, (np.generic, np.ndarray)):
        return value.tolist()
    raise TypeError(f"found {type(value).__name__} in an answer; expected what JSON has")


def _line(found: Any, question: Dict[str, Any]) -> str:
    """The answer as a line of the protocol. Raises ValueError for infinite numbers and NaN in a dictionary."""
    return json.dumps({**_answer(found, question["task"]), "id": question["id"]}, allow_nan=False, default=_plain)


def _run(words: Sequence[str]) -> str:
    try:
        done = subprocess.run(words, capture_output=True, text=True)
    except OSError as error:
        raise Error(f"{words[0]}: {error.strerror}; expected the program touchstone") from error
    if done.returncode in (0, 1):
        return done.stdout
    lines = done.stderr.strip().splitlines()
    raise Error(lines[-1] if lines else f"{words[0]} ended with status {done.returncode}")


def check(
    mine: Any,
    *,
    cases: int = 20,
    groups: Optional[Sequence[str]] = None,
    seed: int = 1,
    shapes: Optional[Sequence[str]] = None,
    out: Union[None, str, "os.PathLike[str]"] = None,
    program: Optional[str] = None,
) -> Grades:
    """Grades an algorithm on Touchstone's hard cases against exact arithmetic.

    mine: an object with one or more of the methods intersects(a, b), distance(a, b), penetration(a, b) and
        signed_distance(a, b), which take touchstone.Body. Body.shape.parameters has the sizes, Body.pose the matrix.
        A method returns a touchstone.Result; a signed number of metres, > 0 for a gap; an answer such as 'separated'; of
        intersects a bool; a dictionary of the peer protocol; or None for what it does not take. An exception counts as
        an answer that was given up, and so does a number that is infinite or NaN.
    cases: how many of each family of cases.
    groups: such as ['gap', 'depth']; without it all.
    shapes: the kinds that it takes, such as ['sphere', 'box']; without it all.
    out: a folder for the tables and the wrong pairs; without it nothing is kept.
    program: the path of the program touchstone.

    It is asked in this process, and graded by the program, `touchstone check --answers`.
    """
    words = [_program(program), "check", "--kind", "pair", "--cases", str(cases), "--seed", str(seed), "--scalar", "double"]
    if groups is not None:
        words += ["--groups", ",".join(groups)]
    methods = {task: getattr(mine, method) for method, task in _TASKS.items() if callable(getattr(mine, method, None))}
    if not methods:
        raise Error(f"found an algorithm without methods; expected one of {', '.join(_TASKS)}")
    name = re.sub("[^a-z0-9]+", "-", str(getattr(mine, "name", type(mine).__name__)).lower()).strip("-")[:60] or "mine"
    errors: List[str] = []
    with tempfile.TemporaryDirectory() as folder:
        questions, answers = Path(folder, "questions.jsonl"), Path(folder, "answers.jsonl")
        _run([*words, "--export", str(questions)])
        kind: Dict[str, Any] = {"tasks": list(methods)}
        if shapes is not None:
            kind["shapes"] = list(shapes)
        first = {"protocol": 1, "name": name, "version": "1", "library": "Python", "kinds": {"pair": kind}}
        with open(questions, encoding="utf-8") as asked, open(answers, "w", encoding="utf-8") as told:
            told.write(json.dumps(first) + "\n")
            for line in asked:
                question = json.loads(line)
                method = methods.get(question.get("task"))
                takes = shapes is None or all(question[body]["shape"]["type"] in shapes for body in "ab" if body in question)
                if method is None or not takes:
                    continue
                try:
                    answer = _line(method(_body(question["a"]), _body(question["b"])), question)
                except Exception:  # of the algorithm: a row, and the next question
                    errors.append(traceback.format_exc())
                    answer = _line({"answer": "unknown", "status": "degenerate"}, question)
                told.write(answer + "\n")
        results = Path(out) if out is not None else Path(folder, "out")
        text = _run([*words, "--answers", str(answers), "--out", str(results)])
        with open(results / "grades.csv", encoding="utf-8", newline="") as table:
            rows = list(csv.DictReader(table))
        if out is None:  # it ends with the files, which are gone
            text = text.split("\nRows in ")[0]
    return Grades(rows, text, errors)
