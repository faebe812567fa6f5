// Solver: finds the shapes of a pair among those that it knows, and asks the algorithm of their kinds.
#include <array>
#include <string>
#include <utility>

#include "algorithms/api/choice.h"
#include "algorithms/api/conversions.h"
#include "algorithms/api/shape_store.h"
#include "algorithms/pair_query.h"

namespace touchstone::v1 {
namespace {

constexpr std::size_t most_met = 64;

static_assert(static_cast<int>(Question::intersect) == static_cast<int>(Task::intersect) &&
              static_cast<int>(Question::distance) == static_cast<int>(Task::distance) &&
              static_cast<int>(Question::penetration) == static_cast<int>(Task::penetration) &&
              static_cast<int>(Question::signed_distance) ==
                  static_cast<int>(Task::signed_distance));
Task inner(Question question) { return static_cast<Task>(question); }

// The numbers of a result are those of an outcome, in its order.
static_assert(sizeof(Result) == sizeof(Outcome) &&
              offsetof(Result, distance) == offsetof(Outcome, distance) &&
              offsetof(Result, on_b) == offsetof(Outcome, witness_b) &&
              offsetof(Result, iterations) == offsetof(Outcome, iterations) &&
              static_cast<int>(Answer::unknown) == static_cast<int>(touchstone::Answer::unknown) &&
              offsetof(Result, status) == offsetof(Outcome, status) &&
              static_cast<int>(Status::unsupported) ==
                  static_cast<int>(touchstone::Status::unsupported));
// Writes what the question gives of an outcome that was new, with bounds whatever was asked, as only_given and
// swapped do; but once, for callers of one pair.
void write_outer(Question question, const Outcome& outcome, bool swap, Result& result) {
  std::memcpy(static_cast<void*>(&result), static_cast<const void*>(&outcome), sizeof result);
  if (!asks_for_number(inner(question), outcome.answer) ||
      outcome.answer == touchstone::Answer::unknown) {
    result.distance = Result::none;
    result.normal = result.on_a = result.on_b = {Result::none, Result::none, Result::none};
  } else if (swap) {
    result.normal = v1::outer(Vec3d(Vec3d::Zero() - outcome.normal));
    std::swap(result.on_a, result.on_b);
  }
}

void check_option(const std::optional<double>& value, const char* what) {
  if (!value || (std::isfinite(*value) && *value >= 0)) return;
  throw Error("found " + std::to_string(*value) + " as " + what +
              "; expected a finite number, at least 0");
}

}  // namespace

struct Solver::Parts {
  explicit Parts(const SolverOptions& options)
      : choice(chosen(options.algorithm, options.cast_algorithm)),
        prepared(choice, {.tolerance = options.tolerance, .margin = options.margin}),
        met(choice, {.tolerance = options.tolerance, .margin = options.margin}) {}

  Choice choice;
  ShapeStore prepared, met;

  // Scratch of batches.
  std::vector<std::uint32_t> shape_of, first, second, order;
  std::vector<touchstone::Pose> poses;
  std::vector<Outcome> outcomes;

  // Returns the store in which both shapes are, and their places.
  ShapeStore& store_of(const Shape& a, const Shape& b, std::array<std::uint32_t, 2>& places) {
    const std::uint64_t id_a = data_of(a).id, id_b = data_of(b).id;
    if (prepared.size() != 0) {
      places = {prepared.find(id_a), prepared.find(id_b)};
      if (places[0] != ShapeStore::none && places[1] != ShapeStore::none) return prepared;
    }
    places = {met.find(id_a), met.find(id_b)};
    if (places[0] == ShapeStore::none || places[1] == ShapeStore::none) [[unlikely]] {
      if (met.size() > most_met) met.forget();
      places = {met.add(a), met.add(b)};
    }
    return met;
  }
  ShapeStore& store_of(std::span<const Body> bodies);

  // Returns whether the outcome is that of (b, a).
  bool ask_alone(Task task, const Shape& shape_a, const Pose& pose_a, const Shape& shape_b,
                 const Pose& pose_b, Outcome& outcome);
};

bool Solver::Parts::ask_alone(Task task, const Shape& shape_a, const Pose& pose_a,
                              const Shape& shape_b, const Pose& pose_b, Outcome& outcome) {
  static constexpr std::array<std::uint32_t, 2> bodies{0, 1};
  std::array<std::uint32_t, 2> places;
  ShapeStore& store = store_of(shape_a, shape_b, places);
  const ShapeKind kind_a = store.shape(places[0]).kind, kind_b = store.shape(places[1]).kind;
  const bool swap = needs_swap(kind_a, kind_b);
  std::array<touchstone::Pose, 2> placed;
  write_inner(pose_a, placed[0]);
  write_inner(pose_b, placed[1]);
  if (!is_finite(placed[0]) || !is_finite(placed[1])) [[unlikely]] {
    throw Error("found a pose with a number that is infinite or NaN; expected finite ones");
  }
  const PairBatch batch = {.kind_a = swap ? kind_b : kind_a,
                           .kind_b = swap ? kind_a : kind_b,
                           .pairs = {.first = std::span(&bodies[swap ? 1 : 0], 1),
                                     .second = std::span(&bodies[swap ? 0 : 1], 1),
                                     .shape_of = places,
                                     .poses = placed}};
  const std::uint8_t which =
      choice.alone[static_cast<std::size_t>(task)][static_cast<std::size_t>(batch.kind_a)]
                  [static_cast<std::size_t>(batch.kind_b)];
  if (which == Choice::none) return swap;
  store.narrow_phase(which).solve_alone(task, batch, 0, outcome);
  if (outcome.answer == touchstone::Answer::unknown && choice.where_open != Choice::none)
      [[unlikely]] {
    outcome = {};
    store.narrow_phase(choice.where_open).solve_alone(task, batch, 0, outcome);
  }
  return swap;
}

Solver::Solver(const SolverOptions& options) {
  check_option(options.tolerance, "a tolerance");
  check_option(options.margin, "a margin");
  parts_ = std::make_unique<Parts>(options);
}
Solver::~Solver() = default;
Solver::Solver(Solver&&) noexcept = default;
Solver& Solver::operator=(Solver&&) noexcept = default;

Solver::Parts& Solver::parts() {
  if (!parts_) [[unlikely]]
    throw Error("this solver was moved from; expected one that has a value");
  return *parts_;
}

void Solver::prepare(std::span<const Shape> shapes) {
  for (const Shape& shape : shapes) data_of(shape);
  Parts& parts = this->parts();
  parts.prepared.forget();
  for (const Shape& shape : shapes) parts.prepared.add(shape);
}

Result Solver::ask(Question question, const Shape& shape_a, const Pose& pose_a,
                   const Shape& shape_b, const Pose& pose_b) {
  Outcome outcome;
  const bool swap = parts().ask_alone(inner(question), shape_a, pose_a, shape_b, pose_b, outcome);
  Result result;
  write_outer(question, outcome, swap, result);
  return result;
}

bool Solver::intersects(const Body& a, const Body& b) {
  Outcome outcome;
  parts().ask_alone(Task::intersect, a.shape, a.pose, b.shape, b.pose, outcome);
  if (outcome.answer == touchstone::Answer::unknown) [[unlikely]] {
    throw Error("no algorithm could decide whether the bodies intersect: " +
                std::string(to_string(outcome.status)));
  }
  return outcome.answer != touchstone::Answer::separated;
}

// Returns a store that has the shapes of all bodies, and their places in shape_of.
ShapeStore& Solver::Parts::store_of(std::span<const Body> bodies) {
  shape_of.resize(bodies.size());
  bool all = prepared.size() != 0;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    shape_of[i] = prepared.find(data_of(bodies[i].shape).id);
    all = all && shape_of[i] != ShapeStore::none;
  }
  if (all) return prepared;
  if (met.size() > most_met) met.forget();
  for (std::size_t i = 0; i < bodies.size(); ++i) shape_of[i] = met.add(bodies[i].shape);
  return met;
}

void Solver::ask(Question question, std::span<const Body> bodies, std::span<const IndexPair> pairs,
                 std::span<Result> results) {
  Parts& parts = this->parts();
  if (results.size() != pairs.size()) {
    throw Error("found room for " + std::to_string(results.size()) +
                " results; expected as many as pairs, " + std::to_string(pairs.size()));
  }
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (pairs[i].a < bodies.size() && pairs[i].b < bodies.size()) continue;
    throw Error("found body " + std::to_string(std::max(pairs[i].a, pairs[i].b)) + " in pair " +
                std::to_string(i) + "; expected less than " + std::to_string(bodies.size()));
  }
  const Task task = inner(question);
  parts.poses.resize(bodies.size());
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    write_inner(bodies[i].pose, parts.poses[i]);
    if (is_finite(parts.poses[i])) continue;
    throw Error("found a number that is infinite or NaN in the pose of body " + std::to_string(i) +
                "; expected finite ones");
  }
  ShapeStore& store = parts.store_of(bodies);
  // The pairs of each two kinds, one behind the other, as a batch has them.
  const auto kind = [&](std::uint32_t body) { return store.shape(parts.shape_of[body]).kind; };
  const auto kinds = [&](const IndexPair& pair) {
    const ShapeKind a = kind(pair.a), b = kind(pair.b);
    return 8 * static_cast<std::size_t>(std::min(a, b)) + static_cast<std::size_t>(std::max(a, b));
  };
  std::array<std::size_t, 65> begins{};
  for (const IndexPair& pair : pairs) ++begins[kinds(pair) + 1];
  for (std::size_t i = 1; i < begins.size(); ++i) begins[i] += begins[i - 1];
  parts.order.resize(pairs.size());
  parts.first.resize(pairs.size());
  parts.second.resize(pairs.size());
  parts.outcomes.assign(pairs.size(), {});
  std::array<std::size_t, 65> ends = begins;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const IndexPair& pair = pairs[i];
    const std::size_t at = ends[kinds(pair)]++;
    const bool swap = needs_swap(kind(pair.a), kind(pair.b));
    parts.order[at] = static_cast<std::uint32_t>(i);
    parts.first[at] = swap ? pair.b : pair.a;
    parts.second[at] = swap ? pair.a : pair.b;
  }
  for (std::size_t both = 0; both < 64; ++both) {
    const std::size_t begin = begins[both], count = begins[both + 1] - begin;
    const std::uint8_t which =
        parts.choice.many[static_cast<std::size_t>(task)][both / 8][both % 8];
    if (count == 0 || which == Choice::none) continue;
    PairBatch batch = {.kind_a = static_cast<ShapeKind>(both / 8),
                       .kind_b = static_cast<ShapeKind>(both % 8),
                       .pairs = {.first = std::span(parts.first).subspan(begin, count),
                                 .second = std::span(parts.second).subspan(begin, count),
                                 .shape_of = parts.shape_of,
                                 .poses = parts.poses}};
    const std::span<Outcome> outcomes = std::span(parts.outcomes).subspan(begin, count);
    store.narrow_phase(which).solve(task, batch, outcomes);
    if (parts.choice.where_open == Choice::none) continue;
    for (std::size_t i = 0; i < count; ++i) {
      if (outcomes[i].answer != touchstone::Answer::unknown) continue;
      outcomes[i] = {};
      store.narrow_phase(parts.choice.where_open).solve_alone(task, batch, i, outcomes[i]);
    }
  }
  for (std::size_t at = 0; at < pairs.size(); ++at) {
    const IndexPair& pair = pairs[parts.order[at]];
    write_outer(question, parts.outcomes[at], needs_swap(kind(pair.a), kind(pair.b)),
                results[parts.order[at]]);
  }
}

CastResult Solver::cast(const Body& a, const Motion& motion_a, const Body& b,
                        const Motion& motion_b) {
  static constexpr std::array<std::uint32_t, 2> bodies{0, 1};
  for (const Vec3& v : {motion_a.displacement, motion_a.rotation_vector, motion_b.displacement,
                        motion_b.rotation_vector}) {
    if (!is_finite(v))
      throw Error("found a motion with a number that is infinite or NaN; expected finite ones");
  }
  check_pose(a.pose);
  check_pose(b.pose);
  std::array<std::uint32_t, 2> places;
  ShapeStore& store = parts().store_of(a.shape, b.shape, places);
  const ShapeKind kind_a = store.shape(places[0]).kind, kind_b = store.shape(places[1]).kind;
  const bool swap = needs_swap(kind_a, kind_b);
  std::array<touchstone::Pose, 2> placed;
  write_inner(a.pose, placed[0]);
  write_inner(b.pose, placed[1]);
  const std::array<touchstone::Motion, 2> motions = {
      touchstone::Motion{v1::inner(motion_a.displacement), v1::inner(motion_a.rotation_vector)},
      touchstone::Motion{v1::inner(motion_b.displacement), v1::inner(motion_b.rotation_vector)}};
  const CastBatch batch = {.kind_a = swap ? kind_b : kind_a,
                           .kind_b = swap ? kind_a : kind_b,
                           .pairs = {.first = std::span(&bodies[swap ? 1 : 0], 1),
                                     .second = std::span(&bodies[swap ? 0 : 1], 1),
                                     .shape_of = places,
                                     .poses = placed},
                           .motions = motions};
  const bool turns = motions[0].turns() || motions[1].turns();
  const std::uint8_t which =
      parts_->choice.casts[turns ? 1 : 0][static_cast<std::size_t>(batch.kind_a)]
                          [static_cast<std::size_t>(batch.kind_b)];
  CastResult result;
  if (which == Choice::none) return result;
  CastOutcome outcome;
  store.cast(which).solve(batch, {&outcome, 1});
  result.answer = outcome.answer == touchstone::CastAnswer::hit    ? CastAnswer::hit
                  : outcome.answer == touchstone::CastAnswer::miss ? CastAnswer::miss
                                                                   : CastAnswer::unknown;
  result.status = outer(outcome.status);
  result.time = outcome.toi;
  result.lower = outcome.lower;
  result.upper = outcome.upper;
  result.normal = v1::outer(swap ? Vec3d(Vec3d::Zero() - outcome.normal) : outcome.normal);
  result.point = v1::outer(outcome.point);
  return result;
}

namespace {

Solver& solver_of_thread() {
  thread_local Solver solver;
  return solver;
}

}  // namespace

bool intersects(const Body& a, const Body& b) { return solver_of_thread().intersects(a, b); }
Result distance(const Body& a, const Body& b) { return solver_of_thread().distance(a, b); }
Result penetration(const Body& a, const Body& b) { return solver_of_thread().penetration(a, b); }
Result signed_distance(const Body& a, const Body& b) {
  return solver_of_thread().signed_distance(a, b);
}
CastResult cast(const Body& a, const Motion& motion_a, const Body& b, const Motion& motion_b) {
  return solver_of_thread().cast(a, motion_a, b, motion_b);
}

}  // namespace touchstone::v1
