// Embree's rays: single ones, plain and robust, and packets of sixteen.
// Paper:   Wald, Woop, Benthin, Johnson, Ernst, "Embree: a kernel framework for efficient CPU ray
//          tracing", SIGGRAPH 2014; Embree 3.13, rtcIntersect1, rtcOccluded1, rtcIntersect16 and
//          rtcOccluded16. `embree-robust` has RTC_SCENE_FLAG_ROBUST, `embree-packets` too, with
//          RTC_INTERSECT_CONTEXT_FLAG_COHERENT.
// Departs: the scene is built in high quality (RTC_BUILD_QUALITY_HIGH). rtcOccluded says whether there
//          is a hit, and not where: `any` has neither triangle nor t. Embree gets threads=1.
// Fails:   without the robust flag rays slip through at edges and vertices; with it, at vertices of
//          very many triangles. Degenerate triangles, and triangles seen edge-on, are never hit. It
//          drops what is beyond 1.84e18.
// Cost:    O(log n) a ray where triangles are small; 80 to 90 bytes a triangle.
#include "algorithms/ray_cast.h"
#ifdef TOUCHSTONE_HAS_EMBREE
#include <embree3/rtcore.h>

#include <algorithm>
#include <array>
#include <limits>
#include <string>

#include "algorithms/peers/rays/embree_mesh.h"

namespace touchstone {
namespace {

enum class RayForm { plain, robust, packets };

class EmbreeRayCast final : public RayCast {
 public:
  explicit EmbreeRayCast(RayForm form)
      : form_(form), device_(rtcNewDevice("threads=1,set_affinity=0")) {
    rtcInitIntersectContext(&context_);
    if (form == RayForm::packets) context_.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  }
  ~EmbreeRayCast() override {
    if (scene_ != nullptr) rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }
  EmbreeRayCast(const EmbreeRayCast&) = delete;
  EmbreeRayCast& operator=(const EmbreeRayCast&) = delete;

  void bind(const TriangleMesh& mesh) override {
    if (scene_ != nullptr) rtcReleaseScene(scene_);
    scene_ = rtcNewScene(device_);
    rtcSetSceneBuildQuality(scene_, RTC_BUILD_QUALITY_HIGH);
    rtcSetSceneFlags(scene_, form_ == RayForm::plain ? RTC_SCENE_FLAG_NONE : RTC_SCENE_FLAG_ROBUST);
    if (!mesh.triangles.empty()) attach_mesh(device_, scene_, mesh);
    rtcCommitScene(scene_);
  }

  void cast(RayTask task, std::span<const Ray> rays, std::span<RayHit> hits) override {
    if (form_ == RayForm::packets) return cast_packets(task, rays, hits);
    for (std::size_t i = 0; i < rays.size(); ++i) {
      RTCRayHit packed;
      write(rays[i], packed.ray);
      packed.hit.geomID = RTC_INVALID_GEOMETRY_ID;
      if (task == RayTask::closest) {
        rtcIntersect1(scene_, &context_, &packed);
        hits[i] = hit_of(packed.hit.geomID != RTC_INVALID_GEOMETRY_ID, packed.hit.primID,
                         packed.ray.tfar, packed.hit.u, packed.hit.v);
      } else {
        rtcOccluded1(scene_, &context_, &packed.ray);
        hits[i] = occluded(packed.ray.tfar);
      }
    }
  }

 private:
  static constexpr std::size_t wide = 16;

  static void write(const Ray& ray, RTCRay& to) {
    to.org_x = static_cast<float>(ray.origin[0]);
    to.org_y = static_cast<float>(ray.origin[1]);
    to.org_z = static_cast<float>(ray.origin[2]);
    to.dir_x = static_cast<float>(ray.direction[0]);
    to.dir_y = static_cast<float>(ray.direction[1]);
    to.dir_z = static_cast<float>(ray.direction[2]);
    to.tnear = 0;
    to.tfar = static_cast<float>(ray.t_max);
    to.time = 0;
    to.mask = 0xffffffff;
    to.flags = 0;
  }

  static RayHit hit_of(bool is_hit, unsigned triangle, float t, float u, float v) {
    RayHit hit;
    hit.status = Status::not_reported;
    if (!is_hit) return hit;
    hit.hit = true;
    hit.triangle = triangle;
    hit.t = static_cast<double>(t);
    hit.u = static_cast<double>(u);
    hit.v = static_cast<double>(v);
    return hit;
  }
  // Embree sets tfar to minus infinity on a hit.
  static RayHit occluded(float tfar) {
    RayHit hit;
    hit.status = Status::not_reported;
    hit.hit = tfar == -std::numeric_limits<float>::infinity();
    return hit;
  }

  void cast_packets(RayTask task, std::span<const Ray> rays, std::span<RayHit> hits) {
    alignas(64) RTCRayHit16 packed;
    alignas(64) std::array<int, wide> valid;
    for (std::size_t first = 0; first < rays.size(); first += wide) {
      const std::size_t count = std::min(wide, rays.size() - first);
      for (std::size_t k = 0; k < wide; ++k) {
        valid[k] = k < count ? -1 : 0;
        RTCRay ray;
        write(rays[first + std::min(k, count - 1)], ray);
        packed.ray.org_x[k] = ray.org_x;
        packed.ray.org_y[k] = ray.org_y;
        packed.ray.org_z[k] = ray.org_z;
        packed.ray.dir_x[k] = ray.dir_x;
        packed.ray.dir_y[k] = ray.dir_y;
        packed.ray.dir_z[k] = ray.dir_z;
        packed.ray.tnear[k] = ray.tnear;
        packed.ray.tfar[k] = ray.tfar;
        packed.ray.time[k] = 0;
        packed.ray.mask[k] = ray.mask;
        packed.ray.flags[k] = 0;
        packed.hit.geomID[k] = RTC_INVALID_GEOMETRY_ID;
      }
      if (task == RayTask::closest) {
        rtcIntersect16(valid.data(), scene_, &context_, &packed);
      } else {
        rtcOccluded16(valid.data(), scene_, &context_, &packed.ray);
      }
      for (std::size_t k = 0; k < count; ++k) {
        hits[first + k] =
            task == RayTask::closest
                ? hit_of(packed.hit.geomID[k] != RTC_INVALID_GEOMETRY_ID, packed.hit.primID[k],
                         packed.ray.tfar[k], packed.hit.u[k], packed.hit.v[k])
                : occluded(packed.ray.tfar[k]);
      }
    }
  }

  RayForm form_;
  RTCDevice device_;
  RTCScene scene_ = nullptr;
  RTCIntersectContext context_;
};

template <RayForm form>
std::unique_ptr<RayCast> make_cast(const RayCastSettings&) {
  return std::make_unique<EmbreeRayCast>(form);
}
constexpr auto make_plain = make_cast<RayForm::plain>;
constexpr auto make_robust = make_cast<RayForm::robust>;
constexpr auto make_packets = make_cast<RayForm::packets>;

}  // namespace
}  // namespace touchstone
#else
#include "algorithms/peers/not_built.h"
using namespace touchstone::not_built;
#endif

namespace touchstone::entries {

std::vector<RayCastEntry> peers_embree_ray_cast() {
  const std::string paper = " (Wald, Woop, Benthin, Johnson, Ernst, SIGGRAPH 2014)";
  const std::string degenerate =
      "misses degenerate triangles, triangles seen edge-on, and zero t_max; rounds in floats; ";
  return {{.info = {.name = "embree",
                    .citation = "Embree 3.13, rtcIntersect1 and rtcOccluded1" + paper,
                    .origin = Origin::peer,
                    .known_defect = degenerate + "rays slip through at edges and vertices"},
           .tasks = {RayTask::closest, RayTask::any},
           .scalars = {Precision::float32},
           .make = make_plain},
          {.info = {.name = "embree-robust",
                    .citation = "Embree 3.13, rtcIntersect1 and rtcOccluded1, "
                                "RTC_SCENE_FLAG_ROBUST" +
                                paper,
                    .origin = Origin::peer,
                    .known_defect = degenerate + "rays slip through at vertices of many triangles"},
           .tasks = {RayTask::closest, RayTask::any},
           .scalars = {Precision::float32},
           .make = make_robust},
          {.info = {.name = "embree-packets",
                    .citation = "Embree 3.13, rtcIntersect16 and rtcOccluded16, coherent, "
                                "RTC_SCENE_FLAG_ROBUST" +
                                paper,
                    .origin = Origin::peer,
                    .known_defect = degenerate + "rays slip through at vertices of many triangles"},
           .tasks = {RayTask::closest, RayTask::any},
           .scalars = {Precision::float32},
           .make = make_packets}};
}

}  // namespace touchstone::entries
