// Finds the exact answers of a scene's frames.
#include "harness/trade/pipeline/truth.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "algorithms/core/bounds.h"
#include "algorithms/registry.h"
#include "harness/base/clock.h"
#include "harness/grade/answer_check.h"
#include "harness/grade/pair_groups.h"
#include "harness/measure/block_input.h"
#include "harness/process/isolate.h"

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

namespace {

struct TrueAnswer {
  Answer answer = Answer::unknown;
  double gap = Outcome::none;
};

// The pairs to solve in a frame.
std::vector<IndexPair> near_pairs(const SceneFrames& frames, std::size_t number,
                                  std::span<const double> sizes) {
  const scene::Scene& scene = *frames.scene;
  if (!scene.pairs.empty()) return scene.pairs;
  const SceneFrame& frame = frames.frames[number];
  std::vector<Aabb> boxes(scene.bodies.size(), Aabb::empty());
  for (const auto& [body, box] : frame.halfspaces) boxes[body] = box;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const Shape& shape = scene.shapes[scene.bodies[i].shape];
    if (frame.present[i] == 0 || shape.kind == ShapeKind::halfspace) continue;
    boxes[i] = tight_box(shape, frame.poses[i]);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      boxes[i].min[axis] =
          round_down(static_cast<double>(boxes[i].min[axis]) - nearness * sizes[i]);
      boxes[i].max[axis] = round_up(static_cast<double>(boxes[i].max[axis]) + nearness * sizes[i]);
    }
  }
  std::vector<IndexPair> pairs = measure::overlapping_pairs(boxes);
  scene.filter.apply(pairs);
  if (number > 0) {
    std::erase_if(pairs, [&](const IndexPair& pair) {
      return frames.moves[pair.a] == 0 && frames.moves[pair.b] == 0;
    });
  }
  return pairs;
}

// Solves the pairs of a frame: convex bodies by the oracle, meshes triangle by triangle.
class TrueAnswers {
 public:
  TrueAnswers(const SceneFrames& frames, int threads)
      : frames_(&frames), executor_(threads), reference_(frames.scene->shapes, executor_) {
    for (const scene::Body& body : frames.scene->bodies) shape_of_.push_back(body.shape);
    if (std::ranges::any_of(frames.mesh_of,
                            [](const geometry::Mesh* mesh) { return mesh != nullptr; })) {
      meshes_ = std::make_unique<TrueMeshes>(frames, executor_);
    }
  }

  void solve(std::size_t frame, std::span<const IndexPair> pairs, std::span<TrueAnswer> answers) {
    const std::vector<Pose>& poses = frames_->frames[frame].poses;
    std::vector<IndexPair> convex;
    std::vector<std::size_t> places;
    std::vector<std::size_t> of_meshes;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      if (has_mesh(pairs[i].a) || has_mesh(pairs[i].b)) {
        of_meshes.push_back(i);
      } else {
        convex.push_back(pairs[i]);
        places.push_back(i);
      }
    }
    std::array<std::vector<std::size_t>, all_shape_kinds.size() * all_shape_kinds.size()> by_kind;
    const auto kind = [&](std::uint32_t body) {
      return static_cast<std::size_t>(frames_->scene->shapes[shape_of_[body]].kind);
    };
    for (std::size_t i = 0; i < convex.size(); ++i) {
      const auto [low, high] = std::minmax({kind(convex[i].a), kind(convex[i].b)});
      by_kind[low * all_shape_kinds.size() + high].push_back(places[i]);
    }
    // Groups keep the order of the pairs, and come in the order of the kinds.
    auto group = by_kind.begin();
    for (const grade::PairGroup& of_kind :
         grade::group_by_kind(convex, frames_->scene->shapes, shape_of_)) {
      while (group->empty()) ++group;
      const std::vector<grade::ReferenceOutcome> found =
          reference_.solve(of_kind, shape_of_, poses);
      for (std::size_t i = 0; i < found.size(); ++i) {
        answers[(*group)[i]] = {found[i].answer, found[i].distance};
      }
      ++group;
    }
    executor_.run(of_meshes.size(), [&](std::size_t i, int worker) {
      const IndexPair& pair = pairs[of_meshes[i]];
      const auto [answer, gap] = meshes_->solve(frame, pair, worker);
      answers[of_meshes[i]] = {answer, gap};
    });
  }

 private:
  bool has_mesh(std::uint32_t body) const { return frames_->mesh_of[shape_of_[body]] != nullptr; }

  const SceneFrames* frames_;
  Executor executor_;
  std::vector<std::uint32_t> shape_of_;
  grade::Reference reference_;
  std::unique_ptr<TrueMeshes> meshes_;
};

}  // namespace

std::vector<std::size_t> sampling_order(std::size_t frames) {
  std::vector<std::size_t> order = {0};
  std::vector<char> taken(frames, 0);
  taken[0] = 1;
  // Van der Corput's sequence orders the other frames.
  for (std::size_t i = 1; order.size() < frames; ++i) {
    double place = 0, part = 0.5;
    for (std::size_t rest = i; rest > 0; rest /= 2, part /= 2) {
      if (rest % 2 == 1) place += part;
    }
    const std::size_t frame = 1 + static_cast<std::size_t>(place * static_cast<double>(frames - 1));
    if (taken[frame] != 0) continue;
    taken[frame] = 1;
    order.push_back(frame);
  }
  return order;
}

std::vector<double> body_sizes(const SceneFrames& frames) {
  std::vector<double> of_shape;
  for (const Shape& shape : frames.scene->shapes) {
    double longest = 0;
    if (shape.kind != ShapeKind::halfspace) {
      const Aabb box = tight_box(shape, {});
      for (std::size_t axis = 0; axis < 3; ++axis) {
        longest = std::max(longest,
                           static_cast<double>(box.max[axis]) - static_cast<double>(box.min[axis]));
      }
    }
    of_shape.push_back(longest);
  }
  std::vector<double> sizes;
  for (const scene::Body& body : frames.scene->bodies) sizes.push_back(of_shape[body.shape]);
  return sizes;
}

std::vector<FrameTruth> find_truth(const SceneFrames& frames, std::span<const std::size_t> wanted,
                                   double seconds, int threads) {
  const std::vector<double> sizes = body_sizes(frames);
  std::vector<FrameTruth> truth;
  std::vector<std::size_t> first = {0};  // the first answer of each frame
  std::vector<std::vector<IndexPair>> pairs;
  for (const std::size_t frame : wanted) {
    pairs.push_back(near_pairs(frames, frame, sizes));
    first.push_back(first.back() + pairs.back().size());
  }
  process::SharedArray<TrueAnswer> answers(first.back());
  process::SharedArray<char> answered(wanted.size());
  const base::Stopwatch watch;
  process::IsolationLimits limits;
  limits.item_seconds = std::max(600.0, 10 * seconds);
  limits.failures = 1;
  const process::IsolationReport report =
      process::isolate(wanted.size(), limits, [&]() -> process::ItemWork {
        auto solver = std::make_shared<TrueAnswers>(frames, threads);
        return [&, solver](std::size_t i) {
          if (i > 0 && watch.seconds() > seconds) return;
          solver->solve(wanted[i], pairs[i],
                        answers.span().subspan(first[i], first[i + 1] - first[i]));
          answered[i] = 1;
        };
      });
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    if (report.states[i] != process::ItemState::done || answered[i] == 0) break;
    FrameTruth& frame = truth.emplace_back();
    frame.frame = wanted[i];
    for (std::size_t k = 0; k < pairs[i].size(); ++k) {
      const IndexPair& pair = pairs[i][k];
      double size = std::min(sizes[pair.a], sizes[pair.b]);
      if (!(size > 0)) size = std::max(sizes[pair.a], sizes[pair.b]);
      const TrueAnswer& answer = answers[first[i] + k];
      frame.pairs.push_back({pair, answer.answer, answer.gap, size > 0 ? size : 1});
    }
  }
  if (truth.empty()) {
    throw std::runtime_error(
        "the exact answers for the scene's first frame are not to be had: " +
        (report.failures.empty() ? std::string("no answer in time") : report.failures[0].reason()));
  }
  return truth;
}

}  // namespace touchstone::trade
