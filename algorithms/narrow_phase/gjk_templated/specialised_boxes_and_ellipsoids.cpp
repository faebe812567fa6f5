// Part of gjk-templated: compiles the loops for boxes and ellipsoids.
#include "algorithms/narrow_phase/gjk_templated/specialised_gjk.inl"
#include "algorithms/narrow_phase/gjk_templated/specialised_parts.h"

namespace touchstone {
namespace {

template <class Scalar>
void add(CoreTable<Scalar>& table) {
  add_pairs<SupportCore::box, SupportCore::box, SupportCore::cylinder, SupportCore::cone,
            SupportCore::ellipsoid, SupportCore::hull>(table);
  add_pairs<SupportCore::ellipsoid, SupportCore::ellipsoid, SupportCore::hull>(table);
}

}  // namespace

void add_boxes_and_ellipsoids(CoreTable<float>& table) { add(table); }
void add_boxes_and_ellipsoids(CoreTable<double>& table) { add(table); }

}  // namespace touchstone
