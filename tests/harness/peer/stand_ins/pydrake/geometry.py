"""A stand-in for pydrake.geometry."""
from types import SimpleNamespace

from spheres_apart import spheres_apart


class Sphere:
    def __init__(self, radius):
        self.radius = radius


class ProximityProperties:
    pass


class GeometryInstance:
    def __init__(self, pose, shape, name):
        self.place = pose.translation, shape.radius

    def set_proximity_properties(self, properties):
        assert isinstance(properties, ProximityProperties)
        self.has_role = True


class SceneGraph:
    def __init__(self):
        self.geometries = []

    def RegisterSource(self, name):
        return name

    def RegisterAnchoredGeometry(self, source, instance):
        assert instance.has_role
        self.geometries.append(instance)
        return len(self.geometries)

    def CreateDefaultContext(self):
        return self

    def get_query_output_port(self):
        return SimpleNamespace(Eval=lambda context: self)

    def ComputeSignedDistancePairClosestPoints(self, one, other):
        a, b = other, one  # in any order, as Drake may
        (centre_a, radius_a), (centre_b, radius_b) = self.geometries[a - 1].place, self.geometries[b - 1].place
        found, normal, on_a, on_b = spheres_apart(centre_a, radius_a, centre_b, radius_b)
        return SimpleNamespace(id_A=a, id_B=b, distance=found, nhat_BA_W=[-x for x in normal],
                               p_ACa=[x - y for x, y in zip(on_a, centre_a)],
                               p_BCb=[x - y for x, y in zip(on_b, centre_b)])
