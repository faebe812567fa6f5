// The exact answers name a triangle. Its time or its squared distance is taken as a fraction.
#include "algorithms/oracle/rays/exact_mesh_proofs.h"

#include <algorithm>

#include "algorithms/oracle/concave/exact_winding.h"
#include "algorithms/oracle/numbers/dyadic.h"
#include "algorithms/oracle/rays/nearest_point.h"
#include "algorithms/oracle/rays/on_grid.h"
#include "algorithms/oracle/rays/ray_triangle.h"
#include "algorithms/point_query.h"
#include "algorithms/ray_cast.h"

namespace touchstone::entries {
std::vector<RayCastEntry> oracle_exact_ray_cast();
std::vector<PointQueryEntry> oracle_exact_point_query();
}  // namespace touchstone::entries

namespace touchstone::oracle {
namespace {

// Without common powers of two, of which grids have many.
TimeFraction without_twos(Integer top, Integer bottom) {
  if (top.is_zero()) return {0, 1};
  const auto twos = std::min(lsb(top), lsb(bottom));
  return {top >> twos, bottom >> twos};
}

}  // namespace

struct MeshProver::Solvers {
  std::unique_ptr<RayCast> rays =
      entries::oracle_exact_ray_cast().front().make({.scalar = Precision::float64});
  std::unique_ptr<PointQuery> points = entries::oracle_exact_point_query().front().make();

  std::optional<PointAnswer> ask(PointTask task, const Vec3d& point) {
    PointAnswer answer;
    points->query(task, {&point, 1}, {&answer, 1});
    if (answer.status != Status::ok) return {};
    return answer;
  }
};

MeshProver::MeshProver(const TriangleMesh& mesh)
    : mesh_(mesh), solvers_(std::make_unique<Solvers>()) {
  solvers_->rays->bind(mesh);
  solvers_->points->bind(mesh);
}

MeshProver::~MeshProver() = default;

std::array<Vec3d, 3> MeshProver::corners(std::uint32_t triangle) const {
  const auto& [a, b, c] = mesh_.triangles[triangle];
  return {mesh_.vertices[a], mesh_.vertices[b], mesh_.vertices[c]};
}

std::optional<RayCertificate> MeshProver::prove_ray(const Vec3d& origin, const Vec3d& direction,
                                                    double t_max, bool is_first) {
  const Ray ray = {origin, direction, t_max};
  RayHit hit;
  solvers_->rays->cast(is_first ? RayTask::closest : RayTask::any, {&ray, 1}, {&hit, 1});
  if (hit.status != Status::ok) return {};
  RayCertificate certificate{origin, direction, t_max, is_first, hit.hit, no_triangle, {}};
  if (!hit.hit) return certificate;
  certificate.triangle = hit.triangle;
  const auto point = first_point(origin, direction, corners(hit.triangle));
  certificate.t = without_twos(point->top, point->bottom);
  return certificate;
}

std::optional<PointCertificate> MeshProver::prove_side(const Vec3d& point) {
  const auto answer = solvers_->ask(PointTask::side, point);
  if (!answer) return {};
  std::optional<PointCertificate> certificate(std::in_place);
  certificate->point = point;
  certificate->claim = PointCertificate::Claim::surface;
  if (answer->side == PointSide::surface) return certificate;
  certificate->claim = answer->side == PointSide::inside ? PointCertificate::Claim::inside
                                                         : PointCertificate::Claim::outside;
  certificate->winding = exact_winding(mesh_, Pose{}, point, Pose{});
  return certificate;
}

std::optional<PointCertificate> MeshProver::prove_nearest(const Vec3d& point) {
  const auto answer = solvers_->ask(PointTask::closest, point);
  if (!answer) return {};
  std::optional<PointCertificate> certificate(std::in_place);
  certificate->point = point;
  if (answer->triangle == PointAnswer::no_triangle) return certificate;
  certificate->triangle = answer->triangle;
  const auto places = corners(answer->triangle);
  int exponent = least_exponent(point);
  for (const Vec3d& place : places) exponent = std::min(exponent, least_exponent(place));
  if (exponent == Dyadic::of_zero) exponent = 0;
  const IntegerVector from = on_grid(point, exponent);
  const NearestInTriangle nearest =
      nearest_of({on_grid(places[0], exponent) - from, on_grid(places[1], exponent) - from,
                  on_grid(places[2], exponent) - from});
  const int power = 2 * exponent;
  certificate->square =
      without_twos(power >= 0 ? Integer(nearest.top << power) : nearest.top,
                   power >= 0 ? nearest.bottom : Integer(nearest.bottom << -power));
  return certificate;
}

}  // namespace touchstone::oracle
