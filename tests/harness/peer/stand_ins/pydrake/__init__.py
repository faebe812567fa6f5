"""A stand-in for pydrake, of spheres."""
