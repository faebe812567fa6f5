"""A stand-in for pydrake.math."""


class RotationMatrix:
    def __init__(self, matrix):
        assert matrix.shape == (3, 3)


class RigidTransform:
    def __init__(self, rotation, translation):
        assert isinstance(rotation, RotationMatrix)
        self.translation = translation
