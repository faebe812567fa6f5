"""What the stand-ins answer: two spheres by a closed form."""
import math


def spheres_apart(centre_a, radius_a, centre_b, radius_b):
    """The signed distance, the unit vector from a to b, and the nearest points."""
    length = math.dist(centre_a, centre_b)
    normal = [(y - x) / length for x, y in zip(centre_a, centre_b)]
    on_a = [x + radius_a * n for x, n in zip(centre_a, normal)]
    on_b = [x - radius_b * n for x, n in zip(centre_b, normal)]
    return length - radius_a - radius_b, normal, on_a, on_b
