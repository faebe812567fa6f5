// What the entries of a peer name in place of its functions where its library is left out. The files of the peers that are
// left out can so be compiled together.
#pragma once

#include <cstddef>

#include "algorithms/core/outcome.h"

namespace touchstone::not_built {

inline constexpr Precision scalar = Precision::float64;  // of Debian's ODE
inline constexpr std::nullptr_t encoding = nullptr, make = nullptr, make_aabb = nullptr,
                                make_advancement = nullptr, make_axis_sweep = nullptr,
                                make_box_box = nullptr, make_box_contacts = nullptr,
                                make_cast = nullptr, make_cgal_points = nullptr,
                                make_continuous = nullptr, make_cubic = nullptr,
                                make_embree_points = nullptr, make_epa = nullptr,
                                make_gimpact = nullptr, make_gjk = nullptr, make_gjk_epa = nullptr,
                                make_hash = nullptr, make_hull_contacts = nullptr,
                                make_indep = nullptr, make_interval_tree = nullptr,
                                make_kdop = nullptr, make_libccd = nullptr, make_low = nullptr,
                                make_meshes = nullptr, make_mpr = nullptr, make_naive = nullptr,
                                make_naive_cast = nullptr, make_obbrss = nullptr,
                                make_ode = nullptr, make_packets = nullptr, make_plain = nullptr,
                                make_quadtree = nullptr, make_refit = nullptr,
                                make_robust = nullptr, make_sap = nullptr, make_sat = nullptr,
                                make_spatial_hash = nullptr, make_ssap = nullptr,
                                make_subsimplex = nullptr, make_sweep = nullptr,
                                make_tree = nullptr, make_tree_array = nullptr,
                                matrix_encoding = nullptr, quaternion_encoding = nullptr,
                                supports = nullptr;

}  // namespace touchstone::not_built

// Bullet's entries name its functions by this namespace.
#ifndef TOUCHSTONE_HAS_BULLET
namespace touchstone::bullet {
using namespace not_built;
}
#endif
