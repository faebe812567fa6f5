// Part of gjk-templated: compiles the loops for points.
#include "algorithms/narrow_phase/gjk_templated/specialised_gjk.inl"
#include "algorithms/narrow_phase/gjk_templated/specialised_parts.h"

namespace touchstone {
namespace {

template <class Scalar>
void add(CoreTable<Scalar>& table) {
  add_pairs<SupportCore::point, SupportCore::point, SupportCore::segment, SupportCore::box,
            SupportCore::cylinder, SupportCore::cone, SupportCore::ellipsoid, SupportCore::hull>(
      table);
}

}  // namespace

void add_points(CoreTable<float>& table) { add(table); }
void add_points(CoreTable<double>& table) { add(table); }

}  // namespace touchstone
