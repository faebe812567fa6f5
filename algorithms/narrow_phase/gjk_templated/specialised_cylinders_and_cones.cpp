// Part of gjk-templated: compiles the loops for cylinders and cones.
#include "algorithms/narrow_phase/gjk_templated/specialised_gjk.inl"
#include "algorithms/narrow_phase/gjk_templated/specialised_parts.h"

namespace touchstone {
namespace {

template <class Scalar>
void add(CoreTable<Scalar>& table) {
  add_pairs<SupportCore::cylinder, SupportCore::cylinder, SupportCore::cone, SupportCore::ellipsoid,
            SupportCore::hull>(table);
  add_pairs<SupportCore::cone, SupportCore::cone, SupportCore::ellipsoid, SupportCore::hull>(table);
}

}  // namespace

void add_cylinders_and_cones(CoreTable<float>& table) { add(table); }
void add_cylinders_and_cones(CoreTable<double>& table) { add(table); }

}  // namespace touchstone
