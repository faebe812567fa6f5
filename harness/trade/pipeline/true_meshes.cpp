// Solves pairs with a mesh exactly.
#include "harness/trade/pipeline/true_meshes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <utility>

#include "algorithms/registry.h"
#include "harness/grade/pair_groups.h"

namespace touchstone::trade {
namespace {

Representing triangles_for_meshes() {
  return {[](const Shape&, const geometry::Mesh* mesh, const proxies::Representation&) {
            return triangle_parts(*mesh);
          },
          {}};
}

Representations meshes_as_they_are() {
  Representations representations;
  representations.of[mesh_body] =
      proxies::Representation{proxies::Form::mesh, proxies::Side::outer, 0};
  return representations;
}

}  // namespace

std::vector<proxies::Part> triangle_parts(const geometry::Mesh& mesh) {
  std::vector<proxies::Part> parts;
  parts.reserve(mesh.triangles.size());
  for (const auto& triangle : mesh.triangles) {
    auto hull = std::make_shared<Hull>();
    for (const std::uint32_t vertex : triangle) hull->vertices.push_back(mesh.vertices[vertex]);
    hull->dimension = 2;
    proxies::Part part;
    part.shape.kind = ShapeKind::hull;
    part.shape.hull = std::move(hull);
    parts.push_back(std::move(part));
  }
  return parts;
}

std::optional<double> winding_number(const geometry::Mesh& mesh, const Vec3d& point) {
  constexpr double near_a_corner = 1e-9, in_the_plane = 1e-12;  // relative to the lengths
  double angle = 0;
  for (const auto& triangle : mesh.triangles) {
    const Vec3d a = mesh.vertices[triangle[0]] - point, b = mesh.vertices[triangle[1]] - point,
                c = mesh.vertices[triangle[2]] - point;
    const double x = a.norm(), y = b.norm(), z = c.norm();
    const double volume = a.dot(b.cross(c)), lengths = x * y * z;
    const double rest = lengths + a.dot(b) * z + b.dot(c) * x + c.dot(a) * y;
    const auto [least, most] = std::minmax({x, y, z});
    if (!(least > near_a_corner * most) ||
        (std::abs(volume) <= in_the_plane * lengths && rest <= in_the_plane * lengths)) {
      return std::nullopt;
    }
    angle += 2 * std::atan2(volume, rest);
  }
  return std::abs(angle) / (4 * std::numbers::pi);
}

TrueMeshes::TrueMeshes(const SceneFrames& frames, Executor& executor)
    : frames_(&frames),
      library_(frames, triangles_for_meshes()),
      solids_(library_.get(library_.complete(meshes_as_they_are()))) {
  for (int worker = 0; worker < executor.width(); ++worker) {
    certified_.push_back(registry::find<NarrowPhaseEntry>("certified")->make({}));
    certified_.back()->bind(solids_->shapes);
  }
}

// The surfaces share no point, so all points of the other body are on one side. One that is clear of
// this body's surface decides.
bool TrueMeshes::has_inside(std::uint32_t body, const Pose& pose, const StandIn& other,
                            const Pose& pose_of_other) const {
  const geometry::Mesh* mesh = frames_->mesh_of[frames_->scene->bodies[body].shape];
  if (mesh == nullptr) return false;
  for (std::uint32_t i = 0; i < other.parts.size(); ++i) {
    const Vec3d point = pose_of_other(other.tree.point(i));
    const auto winding =
        winding_number(*mesh, pose.rotation.inverse() * (point - pose.translation));
    if (winding) return *winding > 0.5;
  }
  return false;
}

std::pair<Answer, double> TrueMeshes::solve(std::size_t frame, const IndexPair& pair, int worker) {
  const std::vector<Pose>& poses = frames_->frames[frame].poses;
  const Pose &pose_a = poses[pair.a], &pose_b = poses[pair.b];
  const StandIn &a = *solids_->of[pair.a], &b = *solids_->of[pair.b];
  std::vector<PartPair> found;
  nearest_parts(a.tree, pose_a, b.tree, pose_b, found);
  // The parts that occur, numbered anew.
  std::vector<Pose> part_poses;
  std::vector<std::uint32_t> shape_of;
  std::map<std::uint32_t, std::uint32_t> numbers;
  const auto number = [&](std::uint32_t body, const StandIn& stand_in, std::uint32_t part) {
    const std::uint32_t all = solids_->first[body] + part;
    const auto [place, fresh] =
        numbers.try_emplace(all, static_cast<std::uint32_t>(numbers.size()));
    if (fresh) {
      part_poses.push_back(placed(poses[body], stand_in.parts[part].pose));
      shape_of.push_back(solids_->shape_of[all]);
    }
    return place->second;
  };
  grade::PairGrouping batches;
  for (const auto& [i, j] : found) {
    const std::uint32_t first = number(pair.a, a, i), second = number(pair.b, b, j);
    batches.add(first, a.parts[i].shape.kind, second, b.parts[j].shape.kind);
  }
  double gap = std::numeric_limits<double>::infinity();
  for (const grade::PairGroup& batch : batches.groups()) {
    if (batch.size() == 0) continue;
    std::vector<Outcome> outcomes(batch.size());
    certified_[static_cast<std::size_t>(worker)]->solve(
        Task::distance, batch.batch(shape_of, part_poses, 0, batch.size()), outcomes);
    for (const Outcome& outcome : outcomes) {
      if (outcome.answer == Answer::touching || outcome.answer == Answer::overlapping) {
        return {outcome.answer, Outcome::none};
      }
      if (outcome.answer == Answer::unknown) return {Answer::unknown, Outcome::none};
      gap = std::min(gap, outcome.distance);
    }
  }
  if (has_inside(pair.a, pose_a, b, pose_b) || has_inside(pair.b, pose_b, a, pose_a)) {
    return {Answer::overlapping, Outcome::none};
  }
  return {Answer::separated, gap};
}

}  // namespace touchstone::trade
