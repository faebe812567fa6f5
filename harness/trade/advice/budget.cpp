// Holds errors against a budget, and draws scenes that test it.
#include "harness/trade/advice/budget.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/distributions/binomial.hpp>
#include <limits>
#include <optional>

#include "harness/base/clock.h"
#include "harness/base/error.h"
#include "harness/base/random.h"
#include "harness/base/reproducible_math.h"
#include "harness/files/toml_table.h"
#include "harness/scene/kinematics.h"
#include "harness/stats/statistics.h"

namespace touchstone::trade {
namespace {

constexpr std::size_t most_held_out_frames = 16;
constexpr std::size_t most_draws = 256, most_bytes = std::size_t{1} << 30;

// The seed of the scene as the request has it; 1 for a scene that is not generated.
std::int64_t own_seed(const TradeRequest& request) {
  if (request.overrides.seed != -1) return request.overrides.seed;
  if (request.scene.extension() != ".toml") return 1;
  return files::parse_toml(request.scene)["seed"].value<std::int64_t>().value_or(1);
}

// Returns nothing if the scene has no seeds.
std::optional<scene::Scene> with_seed(const TradeRequest& request, std::int64_t seed) {
  scene::SceneOverrides overrides = request.overrides;
  overrides.seed = seed;
  try {
    return scene::load_scene(request.scene, overrides);
  } catch (const base::InputError&) {
    return {};  // only this seed fails: the caller has loaded the scene without it
  }
}

// Moves each pose of a track by this part of its step to the next one. Returns whether one moves.
bool begin_tracks_later(double part, scene::Scene& scene) {
  scene::Tracks& tracks = scene.tracks;
  if (tracks.bodies.empty()) return false;
  const std::vector<scene::MotionStep> steps = scene::motion_steps(scene, scene.name);
  bool moves = false;
  for (std::size_t frame = 0; frame < std::min(tracks.frames(), steps.size()); ++frame) {
    for (std::size_t k = 0; k < tracks.bodies.size(); ++k) {
      const std::uint32_t body = tracks.bodies[k];
      const touchstone::Motion& motion = steps[frame].motions[body];
      Pose& pose = tracks.poses[frame * tracks.bodies.size() + k];
      moves = moves || motion.turns() || !motion.displacement.isZero(0);
      pose.translation += part * motion.displacement;
      pose.rotation =
          base::product(base::rotation_over(motion.rotation_vector, part), pose.rotation);
    }
  }
  for (std::size_t k = 0; k < tracks.bodies.size(); ++k) {
    scene.bodies[tracks.bodies[k]].pose = tracks.poses[k];
  }
  return moves;
}

// Returns nothing if nothing moves.
std::optional<scene::Scene> begun_later(const TradeRequest& request, int number) {
  scene::Scene scene = scene::load_scene(request.scene, request.overrides);
  base::Random random(static_cast<std::uint64_t>(number));
  scene::Scene step = scene;
  step.motion.time_step *= random.unit();
  bool moves = begin_tracks_later(step.motion.time_step / scene.motion.time_step, scene);
  step.tracks = {};
  scene::Kinematics kinematics(step);
  kinematics.next();
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    scene::Body& body = scene.bodies[i];
    if (std::ranges::binary_search(scene.tracks.bodies, i)) continue;
    const Pose& pose = kinematics.poses()[i];
    moves =
        moves || pose.translation != body.pose.translation || pose.rotation != body.pose.rotation;
    body.pose = pose;
    body.velocity = kinematics.velocities()[i];
  }
  if (!moves) return {};
  return scene;
}

// What may be wrong of all, where a share is allowed.
double testable(double most) { return most > 0 ? most : zero_is_below; }

}  // namespace

std::string to_string(const ErrorBudget& budget, ErrorMeasure measure) {
  return fmt::format("{} at most {}{}", to_string(measure), budget.most,
                     budget.no_false_negatives ? ", no contact missed" : "");
}

bool meets(const ErrorBudget& budget, ErrorMeasure measure, const Evaluation& evaluation,
           const RepresentationSpread& representation) {
  if (!evaluation.ok()) return false;
  const PointErrors& errors = evaluation.errors;
  if (budget.no_false_negatives) {
    if (errors.false_negatives > 0) return false;
    for (std::size_t bin = 0; bin < errors.bins.size(); ++bin) {
      const bool contact = !(gap_range(bin).high > 0);
      if (contact && errors.bins[bin].failed > 0) return false;
    }
  }
  return error_of(errors, representation, measure) <= budget.most;
}

bool can_miss(const Representations& representations) {
  return std::ranges::any_of(representations.of, [](const auto& one) {
    if (!one || one->form == proxies::Form::as_given) return false;
    // Triangles have nothing inside.
    return one->form == proxies::Form::mesh || one->side != proxies::Side::outer;
  });
}

double greatest_share(std::int64_t wrong, std::int64_t of) {
  if (wrong >= of) return 1;
  return boost::math::binomial::find_upper_bound_on_p(
      static_cast<double>(of), static_cast<double>(wrong), 1 - stats::usual_confidence);
}

std::vector<Evidence> evidence_for(const ErrorBudget& budget, ErrorMeasure measure,
                                   const PointErrors& errors) {
  Evidence pairs = {
      .wrong = errors.false_positives + errors.false_negatives + errors.failed + errors.far,
      .of = errors.near + errors.far};
  Evidence contacts = {.wrong = errors.false_negatives, .of = errors.contacts, .what = "contacts"};
  Evidence values = {.of = errors.values, .what = "numbers"};
  std::vector<Evidence> all;
  const auto add = [&](Evidence& one, double allowed) {
    one.allowed = allowed;
    all.push_back(one);
  };
  switch (measure) {
    case ErrorMeasure::verdicts: add(pairs, testable(budget.most)); break;
    case ErrorMeasure::false_negatives: add(contacts, testable(budget.most)); break;
    case ErrorMeasure::mean:
    case ErrorMeasure::greatest: add(values, 0.05); break;
    case ErrorMeasure::p99: add(values, 0.01); break;
    case ErrorMeasure::volume:
    case ErrorMeasure::hausdorff: break;
  }
  if (budget.no_false_negatives && measure != ErrorMeasure::false_negatives) {
    add(contacts, zero_is_below);
  }
  return all;
}

std::string lack_of(std::span<const Evidence> evidence, bool is_drawn) {
  constexpr std::int64_t a_few = 20;
  for (const Evidence& one : evidence) {
    if (one.holds()) continue;
    const std::string_view single = one.what.substr(0, one.what.size() - 1);
    const std::string_view more =
        is_drawn ? "give more frames, bodies or --seconds" : "move the bodies, or give more frames";
    if (one.of == 0) return fmt::format("no {} was there to test it on: {}", single, more);
    if (one.of == 1) return fmt::format("1 {} tests nothing: {}", single, more);
    if (one.of < a_few) return fmt::format("{} {} test nothing: {}", one.of, one.what, more);
    return fmt::format(
        "{} of {} {} are wrong, so that at most {:.2g} % of all are (95 %), and {:.2g} % are "
        "allowed: {}",
        one.wrong, one.of, one.what, 100 * one.upper(), 100 * one.allowed, more);
  }
  return "";
}

HeldOutScenes::HeldOutScenes(const TradeRequest& request, const Representing& representing,
                             int first, int count, double seconds)
    : request_(request), representing_(representing), seed_(own_seed(request)), next_(first) {
  // The making of representations has no limit of time.
  request_.seconds = std::numeric_limits<double>::infinity();
  for (int i = 0; i < count && draw_one(seconds); ++i) {
  }
}

bool HeldOutScenes::draw(int count, double seconds) {
  const base::Stopwatch watch;
  for (int i = 0; i < count; ++i) {
    if (i > 0 && watch.seconds() > seconds) return true;
    if (!draw_one(seconds / count)) return i > 0;
  }
  return true;
}

bool HeldOutScenes::draw_one(double seconds) {
  if (!scenes_.empty()) {
    const TradeScene& last = *scenes_.back().scene;
    const std::size_t bytes =
        last.scene.bodies.size() * last.frames.frames.size() * sizeof(Pose) * scenes_.size();
    if (scenes_.size() == most_draws || bytes > most_bytes) return false;
  }
  const int number = next_;
  std::optional<scene::Scene> drawn = with_seed(request_, seed_ + number);
  kind_ = drawn ? "seed" : "start";
  const std::int64_t shown = drawn ? seed_ + number : number;
  if (!drawn) drawn = begun_later(request_, number);
  if (!drawn) return false;
  ++next_;
  One& one = scenes_.emplace_back();
  one.name = fmt::format("{} {}", kind_, shown);
  one.scene = std::make_unique<TradeScene>(std::move(*drawn), request_, representing_);
  std::vector<std::size_t> order = sampling_order(one.scene->frames.frames.size());
  order.resize(std::min(order.size(), most_held_out_frames));
  one.truth = find_truth(one.scene->frames, order, seconds, request_.threads);
  return true;
}

std::string HeldOutScenes::name() const {
  if (scenes_.empty()) return "nothing else: nothing moves";
  if (scenes_.size() == 1) return scenes_[0].name;
  return fmt::format("{}s {} to {}", kind_, scenes_.front().name.substr(kind_.size() + 1),
                     scenes_.back().name.substr(kind_.size() + 1));
}

std::vector<HeldOutGrade> HeldOutScenes::grade(const Configuration& configuration,
                                               const ErrorBudget& budget, std::size_t from) {
  std::vector<HeldOutGrade> grades;
  const TradeGrid grid = grid_of(configuration);
  for (std::size_t i = from; i < scenes_.size(); ++i) {
    One& one = scenes_[i];
    HeldOutGrade& grade = grades.emplace_back();
    grade.scene = one.name;
    TradeScene& scene = *one.scene;
    const GridPoints made = expand({&grid, 1}, scene.frames, scene.library, request_.task);
    if (made.points.size() != 1) continue;  // the configuration makes no sense there
    const Evaluation found = evaluate(scene.frames, made.points, one.truth, request_.task).front();
    if (!found.ok()) continue;
    const RepresentationSpread representation =
        spread_of(scene.library.errors(made.points[0].configuration.representations));
    grade.error = error_of(found.errors, representation, request_.measure);
    grade.errors = found.errors;
    grade.within = meets(budget, request_.measure, found, representation);
  }
  return grades;
}

bool within(const AdviceProblem& problem, const TradeOutcome& outcome) {
  return may_stand(problem.budget, outcome.point.configuration.representations) &&
         meets(problem.budget, problem.request.measure, outcome.evaluation, outcome.representation);
}

bool all_within(std::span<const HeldOutGrade> grades) {
  return std::ranges::all_of(grades, &HeldOutGrade::within);
}

PointErrors sum_of(std::span<const HeldOutGrade> grades) {
  PointErrors sum;
  for (const HeldOutGrade& grade : grades) {
    const PointErrors& one = grade.errors;
    sum.near += one.near;
    sum.contacts += one.contacts;
    sum.false_positives += one.false_positives;
    sum.false_negatives += one.false_negatives;
    sum.failed += one.failed;
    sum.far += one.far;
    for (std::size_t i = 0; i < sum.bins.size(); ++i) {
      sum.bins[i].pairs += one.bins[i].pairs;
      sum.bins[i].wrong += one.bins[i].wrong;
      sum.bins[i].failed += one.bins[i].failed;
    }
    sum.values += one.values;
    sum.value.mean = std::max(sum.value.mean, one.value.mean);
    sum.value.p99 = std::max(sum.value.p99, one.value.p99);
    sum.value.greatest = std::max(sum.value.greatest, one.value.greatest);
  }
  return sum;
}

}  // namespace touchstone::trade
