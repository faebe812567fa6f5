// What the peers of CGAL that take meshes share: the kernel, triangles in a tree of boxes, and points of ours.
// Only for files that are built with CGAL.
#pragma once

#if defined(__GNUC__) && !defined(__clang__)
// This is a false alarm of g++ 12 about CGAL's counted references.
#pragma GCC diagnostic ignored "-Wuse-after-free"
#endif
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <vector>

#include "algorithms/core/vec.h"

namespace touchstone::cgal {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Triangles = std::vector<Kernel::Triangle_3>;
using Primitive = CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;

inline Point to_point(const Vec3d& v) { return {v[0], v[1], v[2]}; }

}  // namespace touchstone::cgal
