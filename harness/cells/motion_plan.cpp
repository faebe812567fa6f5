// Makes cells of motion, and grades them.
#include "harness/cells/motion.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <span>
#include <utility>

#include "harness/base/hash.h"
#include "harness/kinds/selection.h"
#include "harness/measure/motion.h"

namespace touchstone::cells {
namespace {

using measure::StepAnswer;

// A scene's steps with the exact answers, which are found once for all its cells.
struct MotionScene {
  measure::MotionInput input;
  std::vector<StepAnswer> truth;

  void find_truth(int threads) {
    if (!truth.empty()) return;
    Executor executor(threads);
    measure::ContinuousSteps exact(
        input,
        {registry::find<BroadPhaseEntry>("naive"), {registry::find<CastEntry>("exact")}, {}, 1},
        executor);
    exact.play();
    truth = exact.answers();
  }
};

// The pairs of `from` that are in neither list. All are sorted.
std::size_t count_outside(std::span<const IndexPair> from, std::span<const IndexPair> one,
                          std::span<const IndexPair> other) {
  return static_cast<std::size_t>(std::ranges::count_if(from, [&](const IndexPair& pair) {
    return !std::ranges::binary_search(one, pair) && !std::ranges::binary_search(other, pair);
  }));
}

kinds::TimedGrade grade_steps(std::span<const StepAnswer> truth,
                              std::span<const StepAnswer> found) {
  kinds::TimedGrade grade;
  grade.hits = grade.true_hits = 0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const StepAnswer &right = truth[i], &answer = found[i];
    grade.missed +=
        static_cast<std::int64_t>(count_outside(right.hits, answer.hits, answer.unknown));
    grade.false_hits +=
        static_cast<std::int64_t>(count_outside(answer.hits, right.hits, right.unknown));
    grade.gave_up += std::ssize(answer.unknown);
    grade.hits += std::ssize(answer.hits);
    grade.true_hits += std::ssize(right.hits);
    grade.hit_hash += base::mix(base::pair_hash(answer.hits) + i);
  }
  return grade;
}

// Plays a method. It is made in the process that plays it, since threads do not survive a fork.
class MethodPlayer {
 public:
  MethodPlayer(std::shared_ptr<const MotionScene> scene, MotionMethod method,
               std::optional<double> tolerance, int parts)
      : scene_(std::move(scene)),
        method_(std::move(method)),
        tolerance_(tolerance),
        parts_(parts) {}

  void prepare(int threads) {
    players_.reset();
    players_ = std::make_unique<Players>(threads);
    if (method_.substeps > 0) {
      const NarrowPhaseSettings settings{.scalar = method_.scalar};
      players_->discrete = std::make_unique<measure::DiscreteSteps>(
          scene_->input,
          measure::DiscreteChoice{method_.broad, method_.narrow, settings, method_.substeps},
          players_->executor);
    } else {
      const CastSettings settings{.tolerance = tolerance_};
      players_->continuous = std::make_unique<measure::ContinuousSteps>(
          scene_->input, measure::ContinuousChoice{method_.broad, method_.casts, settings, parts_},
          players_->executor);
    }
  }
  void play() {
    if (players_->discrete != nullptr) {
      players_->discrete->play();
    } else {
      players_->continuous->play();
    }
  }
  std::vector<StepAnswer> answers() const {
    return players_->discrete != nullptr ? players_->discrete->answers()
                                         : players_->continuous->answers();
  }

  std::uint64_t hash() const {
    std::uint64_t sum = 0;
    for (const StepAnswer& step : answers()) {
      for (const auto* pairs : {&step.hits, &step.unknown})
        sum = base::mix(sum ^ base::pair_hash(*pairs));
    }
    return sum;
  }

  // Judges the answers of the last play, and plays once more alone: as many steps as differ then are
  // wrong in another way.
  kinds::TimedGrade grade(int threads) {
    const std::vector<StepAnswer> found = answers();
    kinds::TimedGrade grade = grade_steps(scene_->truth, found);
    if (threads == 1) return grade;
    prepare(1);
    play();
    const std::vector<StepAnswer> alone = answers();
    for (std::size_t i = 0; i < found.size(); ++i) {
      const bool is_equal = found[i].hits == alone[i].hits && found[i].unknown == alone[i].unknown;
      grade.inexact += is_equal ? 0 : 1;
    }
    return grade;
  }

 private:
  struct Players {
    explicit Players(int threads) : executor(threads) {}
    Executor executor;
    std::unique_ptr<measure::ContinuousSteps> continuous;
    std::unique_ptr<measure::DiscreteSteps> discrete;
  };

  std::shared_ptr<const MotionScene> scene_;
  MotionMethod method_;
  std::optional<double> tolerance_;
  int parts_;
  std::unique_ptr<Players> players_;
};

// True if casts take every pair of a step that comes near, or narrow phases do.
bool takes_all(const MotionScene& scene, const MotionMethod& method) {
  if (method.substeps > 0) {
    return std::ranges::all_of(scene.input.shapes, [&](const Shape& a) {
      return std::ranges::all_of(scene.input.shapes, [&](const Shape& b) {
        if (a.kind == ShapeKind::halfspace && b.kind == ShapeKind::halfspace) return true;
        return std::ranges::any_of(method.narrow, [&](const NarrowPhaseEntry* entry) {
          return offers(*entry, a.kind, b.kind, Task::intersect);
        });
      });
    });
  }
  const auto takes = [&](const scene::MotionStep& step, const IndexPair& pair) {
    const bool turns = step.motions[pair.a].turns() || step.motions[pair.b].turns();
    return std::ranges::any_of(method.casts, [&](const CastEntry* entry) {
      return offers(*entry, scene.input.kind_of(pair.a), scene.input.kind_of(pair.b), turns);
    });
  };
  for (std::size_t i = 0; i < scene.truth.size(); ++i) {
    for (const auto* pairs : {&scene.truth[i].hits, &scene.truth[i].misses}) {
      if (!std::ranges::all_of(
              *pairs, [&](const IndexPair& pair) { return takes(scene.input.steps[i], pair); }))
        return false;
    }
  }
  return true;
}

kinds::TimedSet make_motion_cell(const std::shared_ptr<MotionScene>& scene,
                                 const MotionRequest& request, int threads, int most_threads) {
  scene->find_truth(most_threads);
  kinds::TimedSet cell;
  cell.queries = static_cast<std::int64_t>(scene->input.bodies() * scene->input.steps.size());
  for (const StepAnswer& answer : scene->truth)
    cell.graded += static_cast<std::int64_t>(answer.pairs - answer.unknown.size());
  for (const MotionMethod& method : methods_of(request)) {
    if (!takes_all(*scene, method)) {
      cell.left_out.push_back({method.name, method.origin()});
      continue;
    }
    const auto player =
        std::make_shared<MethodPlayer>(scene, method, request.tolerance, request.parts);
    kinds::TimedContestant contestant;
    contestant.name = method.name;
    contestant.origin = method.origin();
    contestant.approximate =
        method.substeps > 0 || std::ranges::any_of(method.casts, [](const CastEntry* entry) {
          return !entry->info.known_defect.empty();
        });
    contestant.prepare = [=] { player->prepare(threads); };
    contestant.answer = [=] { player->play(); };
    contestant.grade = [=] { return player->grade(threads); };
    contestant.hash = [=] { return player->hash(); };
    cell.contestants.push_back(std::move(contestant));
  }
  return cell;
}

template <class Entry>
std::string joined_names(const std::vector<const Entry*>& entries) {
  std::string name;
  for (const Entry* entry : entries) name += (name.empty() ? "" : "+") + entry->info.name;
  return name;
}

template <class Entry>
std::vector<const Entry*> chain(const std::string& names, std::span<const Entry> entries,
                                std::string_view what) {
  std::vector<const Entry*> found;
  std::string rest = names;
  for (;;) {
    const std::size_t plus = rest.find('+');
    const std::vector<const Entry*> one = kinds::select(entries, {rest.substr(0, plus)}, what);
    if (one.size() != 1) {
      throw base::InputError(fmt::format("found '{}' in '{}'; expected the name of one {}",
                                         rest.substr(0, plus), names, what));
    }
    found.push_back(one.front());
    if (plus == std::string::npos) return found;
    rest.erase(0, plus + 1);
  }
}

}  // namespace

std::string MotionMethod::chain_name() const {
  return substeps > 0 ? joined_names(narrow) : joined_names(casts);
}

Origin MotionMethod::origin() const {
  return substeps > 0 ? narrow.front()->info.origin : casts.front()->info.origin;
}

std::vector<MotionMethod> methods_of(const MotionRequest& request) {
  std::vector<MotionMethod> methods;
  const auto add = [&](MotionMethod method, const std::string& name) {
    method.name = request.broad.size() > 1 ? name + " on " + method.broad->info.name : name;
    methods.push_back(std::move(method));
  };
  for (const BroadPhaseEntry* broad : request.broad) {
    for (const CastChain& casts : request.casts) {
      const MotionMethod method = {.broad = broad, .casts = casts};
      add(method, method.chain_name());
    }
    for (const NarrowChain& narrow : request.narrow) {
      for (const Precision scalar : request.scalars) {
        if (!std::ranges::all_of(narrow, [&](const auto* entry) { return offers(*entry, scalar); }))
          continue;
        for (const int substeps : request.substeps) {
          const MotionMethod method = {
              .broad = broad, .narrow = narrow, .substeps = substeps, .scalar = scalar};
          add(method,
              fmt::format("{} substep{} of {}{}", substeps, substeps == 1 ? "" : "s",
                          method.chain_name(),
                          request.scalars.size() > 1 ? fmt::format(" {}", to_string(scalar)) : ""));
        }
      }
    }
  }
  return methods;
}

std::vector<kinds::PlannedSet> plan_motion(const MotionRequest& request) {
  std::vector<kinds::PlannedSet> cells;
  const int most_threads = *std::ranges::max_element(request.threads);
  for (const std::filesystem::path& file : request.scenes) {
    for (const scene::SceneOverrides& overrides : request.overrides) {
      const scene::Scene read = scene::load_scene(file, overrides);
      const auto scene = std::make_shared<MotionScene>();
      scene->input = measure::motion_input(read, file, request.is_linear);
      std::string group = read.name;
      if (overrides.count != -1) group += fmt::format(", {} bodies", overrides.count);
      if (overrides.seed != -1) group += fmt::format(", seed {}", overrides.seed);
      for (const int threads : request.threads) {
        cells.push_back({group, fmt::format("{} thread{}", threads, threads == 1 ? "" : "s"),
                         [=] { return make_motion_cell(scene, request, threads, most_threads); },
                         threads != request.threads.front(), threads});
      }
    }
  }
  return cells;
}

CastChain cast_chain(const std::string& names) {
  return chain(names, registry::entries<CastEntry>(), "cast");
}
NarrowChain narrow_chain(const std::string& names) {
  return chain(names, registry::entries<NarrowPhaseEntry>(), "narrow phase");
}

}  // namespace touchstone::cells
