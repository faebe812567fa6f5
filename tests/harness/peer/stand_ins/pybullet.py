"""A stand-in for pybullet, of spheres."""
from spheres_apart import spheres_apart

DIRECT, GEOM_SPHERE = 2, 2
_bodies, _radii = [], []


def connect(way):
    assert way == DIRECT


def createCollisionShape(kind, radius):
    assert kind == GEOM_SPHERE
    _radii.append(radius)
    return len(_radii) - 1


def createMultiBody(mass, shape, visual, position, orientation):
    assert mass == 0 and visual == -1 and len(orientation) == 4
    _bodies.append((position, _radii[shape]))
    return len(_bodies) - 1


def getClosestPoints(a, b, distance):
    found, normal, on_a, on_b = spheres_apart(*_bodies[a], *_bodies[b])
    return [(0, a, b, -1, -1, tuple(on_a), tuple(on_b), tuple(-x for x in normal), found, 0.0)] if found < distance else []


def resetSimulation():
    _bodies.clear()
    _radii.clear()
