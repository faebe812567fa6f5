"""A stand-in for python-fcl, of spheres."""
from types import SimpleNamespace

from spheres_apart import spheres_apart


class Sphere:
    def __init__(self, radius):
        self.radius = radius


class Transform:
    def __init__(self, rotation, translation):
        assert rotation.shape == (3, 3)
        self.translation = translation


class CollisionObject:
    def __init__(self, geometry, transform):
        self.place = transform.translation, geometry.radius


class CollisionRequest:
    def __init__(self, num_max_contacts, enable_contact):
        assert enable_contact


class CollisionResult:
    contacts = ()


class DistanceRequest:
    def __init__(self, enable_nearest_points):
        assert enable_nearest_points


class DistanceResult:
    pass


def collide(a, b, request, result):
    found, normal, *_ = spheres_apart(*a.place, *b.place)
    if found > 0:
        return 0
    result.contacts = [SimpleNamespace(penetration_depth=-found, normal=normal)]
    return 1


def distance(a, b, request, result):
    found, _, *result.nearest_points = spheres_apart(*a.place, *b.place)
    return found
