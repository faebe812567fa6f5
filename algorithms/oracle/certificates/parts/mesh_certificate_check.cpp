// Each claim is derived again from all triangles but those whose boxes, which are exact, are out of reach.
#include "algorithms/oracle/certificates/parts/mesh_certificate_check.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "algorithms/oracle/certificates/parts/triangle_tests.h"

namespace touchstone::oracle {
namespace {

using Claim = PointCertificate::Claim;

RationalBox box_of(const RationalTriangle& t) {
  return around(around({t[0], t[0]}, {t[1], t[1]}), {t[2], t[2]});
}

mpq_class value_of(const TimeFraction& fraction) {
  require(fraction.denominator > 0, "the denominator of a fraction is not positive");
  return oracle::rational(fraction.numerator) / oracle::rational(fraction.denominator);
}

// Calls `each` for every triangle of which no box around it is refused by `may_matter`.
template <class MayMatter, class Each>
void visit(const PartTree& tree, const PartNode& node, const MayMatter& may_matter,
           const Each& each) {
  if (!may_matter(*tree.box(node))) return;
  if (node.is_leaf()) return each(tree.part(node));
  visit(tree, node.first_half(), may_matter, each);
  visit(tree, node.second_half(), may_matter, each);
}

// True if the box has a point of the ray with 0 <= t, and t <= end if there is an end.
bool meets(const RationalBox& box, const RationalVector& origin, const RationalVector& direction,
           const std::optional<mpq_class>& end) {
  mpq_class first = 0;
  std::optional<mpq_class> last = end;
  for (std::size_t k = 0; k < 3; ++k) {
    if (direction[k] == 0) {
      if (origin[k] < box.low[k] || origin[k] > box.high[k]) return false;
      continue;
    }
    mpq_class in = (box.low[k] - origin[k]) / direction[k];
    mpq_class out = (box.high[k] - origin[k]) / direction[k];
    if (in > out) std::swap(in, out);
    first = std::max(first, in);
    if (!last || out < *last) last = out;
  }
  return !last || first <= *last;
}

mpq_class squared_distance(const RationalVector& point, const RationalBox& box) {
  mpq_class sum = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const mpq_class away = point[k] - std::clamp(point[k], box.low[k], box.high[k]);
    sum += away * away;
  }
  return sum;
}

template <class Require>
std::string reason(const Require& check) {
  try {
    check();
  } catch (const Fault& found) {
    return found.what();
  }
  return {};
}

}  // namespace

CheckedMesh::CheckedMesh(const TriangleMesh& mesh) {
  invalid_ = reason([&] {
    mesh_.emplace(mesh);
    std::vector<std::optional<RationalBox>> boxes;
    for (std::size_t i = 0; i < mesh_->size(); ++i) boxes.emplace_back(box_of(mesh_->triangle(i)));
    tree_.emplace(spatial_order(boxes), boxes);
  });
  if (invalid_.empty()) open_ = reason([&] { mesh_->require_closed(); });
}

std::string CheckedMesh::fault(const RayCertificate& certificate) const {
  if (!invalid_.empty()) return invalid_;
  return reason([&] { require_proven(certificate); });
}

std::string CheckedMesh::fault(const PointCertificate& certificate) const {
  if (!invalid_.empty()) return invalid_;
  return reason([&] {
    if (certificate.claim == Claim::nearest) {
      require_closest(certificate);
    } else {
      require_side(certificate);
    }
  });
}

void CheckedMesh::require_proven(const RayCertificate& certificate) const {
  const RationalVector origin = rational_vector(certificate.origin),
                       direction = rational_vector(certificate.direction);
  require(!is_zero(direction), "the direction of the ray is zero");
  require(!std::isnan(certificate.t_max) && certificate.t_max > -HUGE_VAL,
          "the end of the ray is no number");
  std::optional<mpq_class> end;
  if (std::isfinite(certificate.t_max)) end = oracle::rational(certificate.t_max);
  if (certificate.hit) {
    require(certificate.triangle < mesh_->size(), "the hit names no triangle");
    const mpq_class claimed = value_of(certificate.t);
    require(!end || claimed <= *end, "the hit is beyond the end of the ray");
    const auto first = first_time(origin, direction, mesh_->triangle(certificate.triangle));
    require(first && *first == claimed, "the ray is not first in the triangle at that time");
    if (!certificate.is_first) return;
    end = claimed;
  } else {
    require(certificate.triangle == no_triangle && certificate.t.numerator == 0 &&
                certificate.t.denominator == 1,
            "a miss names a triangle or a time");
  }
  if (mesh_->size() == 0 || (end && *end < 0)) return;
  visit(
      *tree_, tree_->root(),
      [&](const RationalBox& box) { return meets(box, origin, direction, end); },
      [&](std::uint32_t triangle) {
        const auto first = first_time(origin, direction, mesh_->triangle(triangle));
        if (!first || (end && *first > *end)) return;
        require(certificate.hit, "a triangle has a point of the ray");
        require(*first == *end, "a triangle is hit before");
        require(triangle >= certificate.triangle, "a triangle with a lower number is hit then");
      });
}

void CheckedMesh::require_closest(const PointCertificate& certificate) const {
  require(certificate.winding == 0, "the side was not asked");
  const RationalVector point = rational_vector(certificate.point);
  const mpq_class square = value_of(certificate.square);
  if (certificate.triangle == no_triangle) {
    require(mesh_->size() == 0, "the mesh has triangles");
    require(square == 0, "no triangle has a distance");
    return;
  }
  require(certificate.triangle < mesh_->size(), "the answer names no triangle");
  require(squared_distance(point, mesh_->triangle(certificate.triangle)) == square,
          "the triangle's distance is not the claimed one");
  visit(
      *tree_, tree_->root(),
      [&](const RationalBox& box) { return squared_distance(point, box) < square; },
      [&](std::uint32_t triangle) {
        require(squared_distance(point, mesh_->triangle(triangle)) >= square,
                "a triangle is nearer");
      });
}

void CheckedMesh::require_side(const PointCertificate& certificate) const {
  require(certificate.triangle == no_triangle && certificate.square.numerator == 0 &&
              certificate.square.denominator == 1,
          "the distance was not asked");
  if (!open_.empty()) throw Fault{open_};
  const RationalVector point = rational_vector(certificate.point);
  bool is_on_surface = false;
  if (mesh_->size() > 0) {
    visit(
        *tree_, tree_->root(),
        [&](const RationalBox& box) { return squared_distance(point, box) == 0; },
        [&](std::uint32_t triangle) {
          is_on_surface = is_on_surface || squared_distance(point, mesh_->triangle(triangle)) == 0;
        });
  }
  if (is_on_surface) {
    require(certificate.claim == Claim::surface, "the point is on the surface");
    require(certificate.winding == 0, "a point on the surface has no winding number");
    return;
  }
  require(certificate.claim != Claim::surface, "the point is not on the surface");
  require(mesh_->winding(point) == certificate.winding,
          "the surface does not wind that often around the point");
  require((certificate.claim == Claim::inside) == (certificate.winding != 0),
          "the side does not follow from the winding number");
}

}  // namespace touchstone::oracle
