// Finds the exact answers of a scene's frames.
#include "harness/trade/pipeline/truth.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>

#include "algorithms/core/bounds.h"
#include "harness/base/clock.h"
#include "harness/grade/outcome_check.h"
#include "harness/measure/phases/overlapping_pairs.h"
#include "harness/process/isolate.h"
#include "harness/trade/pipeline/true_meshes.h"

namespace touchstone::trade {
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
