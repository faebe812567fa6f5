// Makes the block of a family's kind.
#include "harness/check/kinds/case_block.h"

namespace touchstone::check {

std::unique_ptr<CaseBlock> make_case_block(const CaseFamily& family, const BlockRange& range) {
  switch (family.kind) {
    case CaseKind::concave: return make_concave_block(family.number, range);
    case CaseKind::rays: return make_ray_block(family.number, range);
    case CaseKind::points: return make_point_block(family.number, range);
    case CaseKind::cast: return make_cast_block(family.number, range);
    case CaseKind::ccd: return make_ccd_block(family.number, range);
    case CaseKind::scene_rays: break;
  }
  return make_scene_ray_block(family.number, range);
}

}  // namespace touchstone::check
