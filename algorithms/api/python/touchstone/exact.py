"""Exact answers about pairs of bodies, with proofs, and a verifier of proofs.

>>> import touchstone as ts
>>> corner = ts.Body(ts.Shape.box([1, 1, 1]))
>>> point = ts.Body(ts.Shape.sphere(0), ([[1, 0, 0], [0, 1, 0], [0, 0, 1]], [2, 2, 1]))
>>> found = ts.exact.distance(corner, point)  # the root of 2
>>> found.answer, found.is_exact, float(found)
('separated', False, 1.4142135623730951)
>>> 0 < found.upper - found.lower < 1e-30
True
"""

import json
import math
from dataclasses import dataclass, field
from fractions import Fraction
from typing import Union

from . import _verify
from ._core import Body, Error, certificate

_BITS = 128  # of a root that is no fraction


@dataclass(frozen=True)
class Exact:
    """The exact answer about two bodies.

    answer: 'separated', 'touching', 'overlapping', or 'unknown' where the bounds of curved bodies do not decide.
    lower, upper: bounds on the signed distance in metres, > 0 the gap, < 0 minus the depth. They are fractions, or
        infinite floats. Where the signed distance is known and a fraction, both are it.
    certificate: a line of JSON that proves them, in the format of Touchstone's page "Certificates of pairs".
    """

    answer: str
    lower: Union[Fraction, float]
    upper: Union[Fraction, float]
    certificate: str = field(repr=False)

    @property
    def is_exact(self) -> bool:
        """Whether the signed distance is `lower`, and `upper`."""
        return self.lower == self.upper

    def __float__(self) -> float:
        """The middle of the bounds, rounded, in metres."""
        if self.is_exact or math.inf in (abs(self.lower), abs(self.upper)):
            return float(self.lower)
        return float((self.lower + self.upper) / 2)


def _root(length, upward):
    """A fraction at most, or at least, the length sign * sqrt(numerator / denominator)."""
    sign, numerator, denominator = length["sign"], _verify.integer(length["numerator"]), _verify.integer(length["denominator"])
    if sign == 0:
        return Fraction(0)
    if denominator == 0:
        return sign * math.inf
    square = Fraction(numerator, denominator)
    top, bottom = math.isqrt(square.numerator), math.isqrt(square.denominator)
    if top * top == square.numerator and bottom * bottom == square.denominator:
        return sign * Fraction(top, bottom)
    shift = max(0, _BITS + (square.denominator.bit_length() - square.numerator.bit_length()) // 2)
    root = math.isqrt((square.numerator << 2 * shift) // square.denominator)
    if upward == (sign > 0):
        root += 1
    return sign * Fraction(root, 1 << shift)


def distance(a: Body, b: Body) -> Exact:
    """The signed distance of two bodies, exactly, with its proof.

    Tenths of a millisecond for simple bodies. Bounds of polytopes, balls and half-spaces meet, up to the root; those of
    cylinders, cones and ellipsoids enclose it.
    """
    text = certificate(a, b)
    proof = json.loads(text)
    radii = sum(Fraction(float(proof[body]["shape"].get("radius", 0))) for body in "ab"
                if proof[body]["shape"]["type"] in ("sphere", "capsule"))
    lower, upper = _root(proof["lower"], False), _root(proof["upper"], True)
    return Exact(proof["answer"], lower - radii, upper - radii, text)


def verify(certificate: str) -> bool:
    """Verifies a certificate of a pair, in fractions: the second verifier, in Python alone.

    Returns True if it proves its claim. Raises touchstone.Error, with the reason, if it proves nothing, and if it is no
    certificate. Verifies nothing but the line: whether its bodies are yours is for you to compare.
    """
    if not isinstance(certificate, str):
        raise Error(f"found {type(certificate).__name__} as a certificate; expected a line of JSON")
    why = _verify.judge(certificate)
    if why is not None:
        raise Error(why[0])
    return True
