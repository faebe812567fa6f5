#include "algorithms/kernels/gjk_known_cores.inl"
#include "algorithms/kernels/gjk_known_cores_parts.h"

namespace touchstone {
namespace {

template <class Scalar>
void add(ApproachTable<Scalar>& table) {
  add_pairs<SupportCore::segment, SupportCore::segment, SupportCore::box, SupportCore::cylinder,
            SupportCore::cone, SupportCore::ellipsoid, SupportCore::hull>(table);
  add_pairs<SupportCore::hull, SupportCore::hull>(table);
}

}  // namespace

void add_segments_and_hulls(ApproachTable<float>& table) { add(table); }
void add_segments_and_hulls(ApproachTable<double>& table) { add(table); }

}  // namespace touchstone
