// Part of gjk-templated: compiles the loops for segments and hulls.
#include "algorithms/narrow_phase/gjk_templated/specialised_gjk.inl"
#include "algorithms/narrow_phase/gjk_templated/specialised_parts.h"

namespace touchstone {
namespace {

template <class Scalar>
void add(CoreTable<Scalar>& table) {
  add_pairs<SupportCore::segment, SupportCore::segment, SupportCore::box, SupportCore::cylinder,
            SupportCore::cone, SupportCore::ellipsoid, SupportCore::hull>(table);
  add_pairs<SupportCore::hull, SupportCore::hull>(table);
}

}  // namespace

void add_segments_and_hulls(CoreTable<float>& table) { add(table); }
void add_segments_and_hulls(CoreTable<double>& table) { add(table); }

}  // namespace touchstone
