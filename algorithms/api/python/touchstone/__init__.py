"""Collision queries of convex bodies in 3D, by the algorithms that Touchstone measures.

Lengths are metres and angles radians; answers are in the world's frame. A pose is None, a matrix (4, 4), or a tuple of
a rotation (3, 3) and a translation (3,). Wrong arguments raise touchstone.Error, a ValueError.

>>> import numpy as np, touchstone as ts
>>> box, ball = ts.Shape.box([1, 1, 1]), ts.Shape.sphere(0.5)
>>> pose = np.eye(4)
>>> pose[:3, 3] = 3, 0, 0
>>> ts.distance(ts.Body(box), ts.Body(ball, pose)).distance
1.5

Many pairs at once, as an array with fields:

>>> bodies = ts.Bodies([box, ball], shape_of=[0, 1, 1], poses=np.stack([np.eye(4), pose, pose]))
>>> answers = ts.Solver().ask("distance", bodies, pairs=[[0, 1], [0, 2], [1, 2]])
>>> answers["distance"][:2], ts.ANSWERS[answers["answer"][2]]
(array([1.5, 1.5]), 'overlapping')

The exact answer with its proof, and the verifier:

>>> proven = ts.exact.distance(ts.Body(box), ts.Body(ball, pose))
>>> proven.lower
Fraction(3, 2)
>>> ts.verify(proven.certificate)
True
"""

from . import exact
from ._core import (
    ANSWERS,
    STATUSES,
    Bodies,
    Body,
    CastResult,
    Error,
    Result,
    Shape,
    Solver,
    World,
    __version__,
    algorithm_names,
    distance,
    intersects,
    penetration,
    signed_distance,
)
from .exact import verify
from .grading import Grades, check

__all__ = [
    "ANSWERS",
    "STATUSES",
    "Bodies",
    "Body",
    "CastResult",
    "Error",
    "Grades",
    "Result",
    "Shape",
    "Solver",
    "World",
    "algorithm_names",
    "check",
    "distance",
    "exact",
    "intersects",
    "penetration",
    "signed_distance",
    "verify",
]
