// Ray casts and point queries of meshes that ask a peer. The mesh is sent once, before the first question about it.
#include <cmath>
#include <cstdint>

#include "algorithms/registry.h"
#include "harness/peer/offers.h"

namespace touchstone::peer {
namespace {

constexpr std::array all_ray_tasks = {RayTask::closest, RayTask::any};
constexpr std::array all_point_tasks = {PointTask::closest, PointTask::side};
constexpr std::array all_sides = {PointSide::outside, PointSide::surface, PointSide::inside,
                                  PointSide::unknown};
constexpr std::uint32_t no_triangle = RayHit::no_triangle;

files::OrderedJson to_array(const Vec3d& v) { return {v.x(), v.y(), v.z()}; }

// The number of a triangle; no_triangle if it is not known. Throws base::InputError if the mesh has no such one.
std::uint32_t known_triangle(const files::JsonNode& answer, std::size_t triangles) {
  const std::int32_t number = known_count(answer, "triangle");
  if (number < 0) return no_triangle;
  if (static_cast<std::size_t>(number) >= triangles) {
    answer.fail(fmt::format("triangle: found {}; expected one of {}", number, triangles));
  }
  return static_cast<std::uint32_t>(number);
}

// The mesh that questions are about, and where they go.
class MeshLink {
 public:
  explicit MeshLink(std::shared_ptr<Link> link) : link_(std::move(link)) {}

  void bind(const TriangleMesh& mesh) {
    files::OrderedJson line = {{"vertices", files::OrderedJson::array()},
                               {"triangles", mesh.triangles}};
    for (const Vec3d& vertex : mesh.vertices) line["vertices"].push_back(to_array(vertex));
    const std::string text = line.dump();
    id_ = id_of(text);
    line_ = "{\"mesh\":\"" + id_ + "\"," + text.substr(1) + "\n";
    triangles_ = mesh.triangles.size();
  }

  std::size_t triangles() const { return triangles_; }

  void ask(std::size_t count, const std::function<files::OrderedJson(std::size_t)>& question,
           const std::function<void(std::size_t, const files::JsonNode&)>& take) {
    const std::string before = std::exchange(line_, "");
    peer::ask(
        *link_, before, count,
        [&](std::size_t i) {
          files::OrderedJson one = question(i);
          one["mesh"] = id_;
          return one;
        },
        take);
  }

 private:
  std::shared_ptr<Link> link_;
  std::string id_, line_;  // the line is empty once it was sent
  std::size_t triangles_ = 0;
};

class RayPeer final : public RayCast {
 public:
  RayPeer(std::shared_ptr<Link> link, const RayCastSettings& settings)
      : link_(std::move(link)), settings_(settings) {}

  void bind(const TriangleMesh& mesh) override { link_.bind(mesh); }

  void cast(RayTask task, std::span<const Ray> rays, std::span<RayHit> hits) override {
    // JSON has no NaN and no infinity, and the answer to such a ray is fixed by the contract.
    std::vector<std::size_t> asked;
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const Ray& ray = rays[i];
      hits[i] = RayHit{.status = Status::degenerate};
      if (ray.origin.allFinite() && ray.direction.allFinite() && !std::isnan(ray.t_max)) {
        asked.push_back(i);
      }
    }
    link_.ask(
        asked.size(),
        [&](std::size_t item) {
          const Ray& ray = rays[asked[item]];
          files::OrderedJson question = {{"kind", "ray"},
                                         {"task", to_string(task)},
                                         {"scalar", to_string(settings_.scalar)},
                                         {"origin", to_array(ray.origin)},
                                         {"direction", to_array(ray.direction)}};
          if (std::isfinite(ray.t_max)) question["t_max"] = ray.t_max;
          return question;
        },
        [&](std::size_t item, const files::JsonNode& answer) {
          RayHit& hit = hits[asked[item]];
          hit.status = known_status(answer);
          hit.t = known_number(answer, "t");
          hit.u = known_number(answer, "u");
          hit.v = known_number(answer, "v");
          hit.triangle = known_triangle(answer, link_.triangles());
          hit.hit = answer.has("hit") ? offered_flag(answer, "hit") : !std::isnan(hit.t);
        });
  }

 private:
  MeshLink link_;
  RayCastSettings settings_;
};

class PointPeer final : public PointQuery {
 public:
  explicit PointPeer(std::shared_ptr<Link> link) : link_(std::move(link)) {}

  void bind(const TriangleMesh& mesh) override { link_.bind(mesh); }

  void query(PointTask task, std::span<const Vec3d> points,
             std::span<PointAnswer> answers) override {
    std::vector<std::size_t> asked;
    for (std::size_t i = 0; i < points.size(); ++i) {
      answers[i] = PointAnswer{.status = Status::degenerate};
      if (points[i].allFinite()) asked.push_back(i);
    }
    link_.ask(
        asked.size(),
        [&](std::size_t item) {
          return files::OrderedJson{{"kind", "point"},
                                    {"task", to_string(task)},
                                    {"point", to_array(points[asked[item]])}};
        },
        [&](std::size_t item, const files::JsonNode& answer) {
          PointAnswer& to = answers[asked[item]];
          to.status = known_status(answer);
          to.side = known_name<PointSide>(answer, "side", all_sides).value_or(PointSide::unknown);
          to.triangle = known_triangle(answer, link_.triangles());
          to.distance = known_number(answer, "distance");
          to.closest = known_vector(answer, "closest");
        });
  }

 private:
  MeshLink link_;
};

}  // namespace

void add_ray(const AlgorithmInfo& info, const files::JsonNode& offer,
             const std::shared_ptr<Link>& link) {
  registry::add(RayCastEntry{.info = info,
                             .tasks = offered<RayTask>(offer, "tasks", all_ray_tasks),
                             .scalars = offered_scalars(offer),
                             .make =
                                 [link](const RayCastSettings& settings) {
                                   return std::make_unique<RayPeer>(link, settings);
                                 }},
                registry::Timed::no);
}

void add_point(const AlgorithmInfo& info, const files::JsonNode& offer,
               const std::shared_ptr<Link>& link) {
  registry::add(PointQueryEntry{.info = info,
                                .tasks = offered<PointTask>(offer, "tasks", all_point_tasks),
                                .scalar = offered_scalars(offer).front(),
                                .make = [link] { return std::make_unique<PointPeer>(link); }},
                registry::Timed::no);
}

}  // namespace touchstone::peer
