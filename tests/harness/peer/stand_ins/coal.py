"""A stand-in for coal, of spheres."""
from spheres_apart import spheres_apart


class Sphere:
    def __init__(self, radius):
        self.radius = radius


class StdVec_Vec3s(list):
    pass


class Convex:
    @staticmethod
    def convexHull(points, keep_triangles, command):
        raise RuntimeError("no hull")


class Transform3s:
    def __init__(self, rotation, translation):
        assert rotation.shape == (3, 3)
        self.translation = translation


class DistanceRequest:
    pass


class DistanceResult:
    def getNearestPoint1(self):
        return self.points[0]

    def getNearestPoint2(self):
        return self.points[1]


def distance(a, pose_a, b, pose_b, request, result):
    assert isinstance(request, DistanceRequest)
    found, result.normal, *result.points = spheres_apart(pose_a.translation, a.radius, pose_b.translation, b.radius)
    return found
