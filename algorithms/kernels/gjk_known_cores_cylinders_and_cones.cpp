#include "algorithms/kernels/gjk_known_cores.inl"
#include "algorithms/kernels/gjk_known_cores_parts.h"

namespace touchstone {
namespace {

template <class Scalar>
void add(ApproachTable<Scalar>& table) {
  add_pairs<SupportCore::cylinder, SupportCore::cylinder, SupportCore::cone, SupportCore::ellipsoid,
            SupportCore::hull>(table);
  add_pairs<SupportCore::cone, SupportCore::cone, SupportCore::ellipsoid, SupportCore::hull>(table);
}

}  // namespace

void add_cylinders_and_cones(ApproachTable<float>& table) { add(table); }
void add_cylinders_and_cones(ApproachTable<double>& table) { add(table); }

}  // namespace touchstone
