// Embree's point query, with a callback that takes the closest point of a triangle.
// Paper:   Embree 3.13, rtcPointQuery; Ericson, "Real-time collision detection", 2005, 5.1.5, for the
//          triangle, as in Embree's tutorial on closest points.
// Departs: the scene is built in high quality (RTC_BUILD_QUALITY_HIGH). Embree walks the tree alone; the
//          triangle's closest point is calculated here, in floats, as its user has to.
// Fails:   numbers are rounded to floats, and so is the closest point. It drops what is beyond 1.84e18.
// Cost:    O(log n) a point near the surface, and a call of the callback for each triangle that is
//          looked at.
#include "algorithms/point_query.h"
#ifdef TOUCHSTONE_HAS_EMBREE
#include "algorithms/peers/rays/embree_mesh.h"

namespace touchstone {
namespace {

using Vec3f = Eigen::Vector3f;

// By the region of the triangle that the point lies over: a vertex's, an edge's or the face's.
Vec3f closest_in_floats(const Vec3f& p, const Vec3f& a, const Vec3f& b, const Vec3f& c) {
  const Vec3f ab = b - a, ac = c - a, ap = p - a;
  const float d1 = ab.dot(ap), d2 = ac.dot(ap);
  if (d1 <= 0 && d2 <= 0) return a;
  const Vec3f bp = p - b;
  const float d3 = ab.dot(bp), d4 = ac.dot(bp);
  if (d3 >= 0 && d4 <= d3) return b;
  const Vec3f cp = p - c;
  const float d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d6 >= 0 && d5 <= d6) return c;
  const float vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return a + d1 / (d1 - d3) * ab;
  const float vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return a + d2 / (d2 - d6) * ac;
  const float va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 >= d3 && d5 >= d6) {
    return b + (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (c - b);
  }
  const float sum = va + vb + vc;
  return a + vb / sum * ab + vc / sum * ac;
}

class EmbreePointQuery final : public PointQuery {
 public:
  EmbreePointQuery() : device_(rtcNewDevice("threads=1,set_affinity=0")) {}
  ~EmbreePointQuery() override {
    if (scene_ != nullptr) rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }
  EmbreePointQuery(const EmbreePointQuery&) = delete;
  EmbreePointQuery& operator=(const EmbreePointQuery&) = delete;

  void bind(const TriangleMesh& mesh) override {
    if (scene_ != nullptr) rtcReleaseScene(scene_);
    scene_ = rtcNewScene(device_);
    rtcSetSceneBuildQuality(scene_, RTC_BUILD_QUALITY_HIGH);
    vertices_.clear();
    for (const Vec3d& v : mesh.vertices) vertices_.push_back(v.cast<float>());
    triangles_ = &mesh.triangles;
    if (!mesh.triangles.empty()) attach_mesh(device_, scene_, mesh);
    rtcCommitScene(scene_);
  }

  void query(PointTask task, std::span<const Vec3d> points,
             std::span<PointAnswer> answers) override {
    for (std::size_t i = 0; i < points.size(); ++i) {
      PointAnswer& answer = answers[i];
      answer = {};
      if (task != PointTask::closest) continue;
      answer.status = points[i].allFinite() ? Status::not_reported : Status::degenerate;
      if (!points[i].allFinite()) continue;
      Search search{*this, points[i].cast<float>()};
      RTCPointQueryContext context;
      rtcInitPointQueryContext(&context);
      RTCPointQuery query;
      query.x = search.point.x();
      query.y = search.point.y();
      query.z = search.point.z();
      query.time = 0;
      query.radius = std::numeric_limits<float>::infinity();
      rtcPointQuery(scene_, &query, &context, take, &search);
      if (search.triangle == PointAnswer::no_triangle) continue;
      answer.triangle = search.triangle;
      answer.closest = search.closest.cast<double>();
      answer.distance = (answer.closest - points[i]).stableNorm();
    }
  }

 private:
  struct Search {
    const EmbreePointQuery& query;
    Vec3f point;
    std::uint32_t triangle = PointAnswer::no_triangle;
    Vec3f closest = Vec3f::Zero();
  };

  // Embree calls it for a triangle whose box is within the radius; true if the radius has shrunk.
  static bool take(RTCPointQueryFunctionArguments* arguments) {
    Search& search = *static_cast<Search*>(arguments->userPtr);
    const auto& [a, b, c] = (*search.query.triangles_)[arguments->primID];
    const std::vector<Vec3f>& vertices = search.query.vertices_;
    const Vec3f at = closest_in_floats(search.point, vertices[a], vertices[b], vertices[c]);
    const float distance = (search.point - at).norm();
    if (!(distance < arguments->query->radius)) return false;
    arguments->query->radius = distance;
    search.triangle = arguments->primID;
    search.closest = at;
    return true;
  }

  RTCDevice device_;
  RTCScene scene_ = nullptr;
  std::vector<Vec3f> vertices_;
  const std::vector<std::array<std::uint32_t, 3>>* triangles_ = nullptr;
};

std::unique_ptr<PointQuery> make_embree_points() { return std::make_unique<EmbreePointQuery>(); }

}  // namespace
}  // namespace touchstone
#else
#include "algorithms/peers/not_built.h"
using namespace touchstone::not_built;
#endif

namespace touchstone::entries {

std::vector<PointQueryEntry> peers_embree_point_query() {
  return {{.info = {.name = "embree",
                    .citation = "Embree 3.13, rtcPointQuery; Ericson 2005, 5.1.5, in the callback",
                    .origin = Origin::peer,
                    .known_defect = "rounds in floats"},
           .tasks = {PointTask::closest},
           .scalar = Precision::float32,
           .make = make_embree_points}};
}

}  // namespace touchstone::entries
