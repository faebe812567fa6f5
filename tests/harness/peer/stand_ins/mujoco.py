"""A stand-in for mujoco, of spheres."""
import re

import numpy

from spheres_apart import spheres_apart


class MjModel:
    @classmethod
    def from_xml_string(cls, xml):
        model = cls()
        sizes = re.findall('<geom type="sphere" size="([^ "]*)', xml)
        if len(sizes) != 2:
            raise ValueError("expected two spheres")
        model.radii = [float(size) for size in sizes]
        model.geom_pos = numpy.zeros((2, 3))
        model.geom_quat = numpy.array([[1.0, 0, 0, 0]] * 2)
        return model


class MjData:
    def __init__(self, model):
        self.geom_xpos, self.geom_xmat = numpy.zeros((2, 3)), numpy.zeros((2, 9))


def mj_kinematics(model, data):
    pass


def mju_quat2Mat(matrix, quaternion):
    assert list(quaternion) == [1, 0, 0, 0]
    matrix[:] = [1, 0, 0, 0, 1, 0, 0, 0, 1]


def mj_geomDistance(model, data, a, b, farthest, points):
    found, _, on_a, on_b = spheres_apart(data.geom_xpos[a], model.radii[a], data.geom_xpos[b], model.radii[b])
    points[:] = on_a + on_b
    return found
