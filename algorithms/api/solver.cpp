// Solver: finds the shapes of a pair among those that it knows, and asks the algorithm of their kinds.
#include <array>
#include <cstdint>
#include <cstring>
#include <new>
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

// A result is an outcome, byte for byte, so that an algorithm writes it in place.
static_assert(sizeof(Result) == sizeof(Outcome) && alignof(Result) == alignof(Outcome) &&
              offsetof(Result, answer) == offsetof(Outcome, answer) &&
              offsetof(Result, status) == offsetof(Outcome, status) &&
              offsetof(Result, distance) == offsetof(Outcome, distance) &&
              offsetof(Result, upper) == offsetof(Outcome, upper) &&
              offsetof(Result, normal) == offsetof(Outcome, normal) &&
              offsetof(Result, on_b) == offsetof(Outcome, witness_b) &&
              offsetof(Result, iterations) == offsetof(Outcome, iterations) &&
              static_cast<int>(Answer::unknown) == static_cast<int>(touchstone::Answer::unknown) &&
              static_cast<int>(Status::unsupported) ==
                  static_cast<int>(touchstone::Status::unsupported));

// Writes with `write` a new outcome in the place of the result, which then has its bytes.
template <class Write>
void write_in_place(Result& result, const Write& write) {
  write(*::new (static_cast<void*>(&result)) Outcome);
  // No instruction. Without it a compiler may take what was written for an outcome, and never for a result.
  asm volatile("" : : "r"(&result) : "memory");
}

// Leaves what the question gives of an outcome that was new, with bounds whatever was asked, as only_given and
// swapped do; but once, and in place, for callers of one pair.
void keep_given(Task task, bool swap, Outcome& outcome) {
  if (!asks_for_number(task, outcome.answer) || outcome.answer == touchstone::Answer::unknown) {
    outcome.distance = Outcome::none;
    outcome.normal = outcome.witness_a = outcome.witness_b = Vec3d::Constant(Outcome::none);
  } else if (swap) {
    outcome.normal = Vec3d::Zero() - outcome.normal;  // 0 - n keeps a zero positive
    std::swap(outcome.witness_a, outcome.witness_b);
  }
}

void check_option(const std::optional<double>& value, const char* what) {
  if (!value || (std::isfinite(*value) && *value >= 0)) return;
  throw Error("found " + std::to_string(*value) + " as " + what +
              "; expected a finite number, at least 0");
}

}  // namespace

struct [[gnu::visibility("hidden")]] Solver::Parts {
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
  std::vector<std::uint8_t> swapped;

  // Returns the store in which both shapes are, and their places.
  ShapeStore& store_of(const Shape& a, const Shape& b, std::array<std::uint32_t, 2>& places) {
    const std::uint64_t id_a = data_of(a).id, id_b = data_of(b).id;
    if (prepared.size() != 0 && prepared.find(id_a, id_b, places)) return prepared;
    if (!met.find(id_a, id_b, places)) [[unlikely]]
      meet(a, b, places);
    return met;
  }
  [[gnu::noinline]] void meet(const Shape& a, const Shape& b,
                              std::array<std::uint32_t, 2>& places) {
    if (met.size() > most_met) met.forget();
    places = {met.add(a), met.add(b)};
  }
  ShapeStore& store_of(std::span<const Body> bodies);

  struct OnePair;
};

// One pair that is asked for alone, as a batch of one: its input was checked, and its algorithm is bound.
struct Solver::Parts::OnePair {
  [[gnu::always_inline]] OnePair(Parts& parts, Task asked, const Shape& shape_a, const Pose& pose_a,
                                 const Shape& shape_b, const Pose& pose_b)
      : store(parts.store_of(shape_a, shape_b, places)),
        where_open(parts.choice.where_open),
        task(asked),
        swap(needs_swap(shape_a.data()->shape.kind, shape_b.data()->shape.kind)),
        batch{.kind_a = (swap ? shape_b : shape_a).data()->shape.kind,
              .kind_b = (swap ? shape_a : shape_b).data()->shape.kind,
              .pairs = {.first = std::span(&bodies[swap ? 1 : 0], 1),
                        .second = std::span(&bodies[swap ? 0 : 1], 1),
                        .shape_of = places,
                        .poses = write_inner_checked(pose_a, pose_b, placed)}},
        algorithm(store.alone(task, batch.kind_a, batch.kind_b)) {}
  OnePair(const OnePair&) = delete;
  OnePair& operator=(const OnePair&) = delete;

  // `outcome` is new.
  void solve(Outcome& outcome) {
    if (algorithm == nullptr) [[unlikely]]
      return;
    algorithm->solve_alone(task, batch, 0, outcome);
    if (outcome.answer == touchstone::Answer::unknown && where_open != Choice::none) [[unlikely]] {
      outcome = {};
      store.narrow_phase(where_open).solve_alone(task, batch, 0, outcome);
    }
  }

  static constexpr std::array<std::uint32_t, 2> bodies{0, 1};
  std::array<double, 24> placed;
  std::array<std::uint32_t, 2> places;
  ShapeStore& store;
  std::uint8_t where_open;
  Task task;
  bool swap;  // the outcome is that of (b, a)
  PairBatch batch;
  NarrowPhase* algorithm;  // null: unsupported
};

inline Solver::Parts& Solver::parts() {
  if (!parts_) [[unlikely]]
    refuse_moved_solver();
  return *parts_;
}

Solver::Solver(const SolverOptions& options) {
  check_option(options.tolerance, "a tolerance");
  check_option(options.margin, "a margin");
  parts_ = std::make_unique<Parts>(options);
}
Solver::~Solver() = default;
Solver::Solver(Solver&&) noexcept = default;
Solver& Solver::operator=(Solver&&) noexcept = default;

void Solver::prepare(std::span<const Shape> shapes) {
  for (const Shape& shape : shapes) data_of(shape);
  Parts& parts = this->parts();
  parts.prepared.forget();
  for (const Shape& shape : shapes) parts.prepared.add(shape);
}

Result Solver::ask(Question question, const Shape& shape_a, const Pose& pose_a,
                   const Shape& shape_b, const Pose& pose_b) {
  Parts::OnePair pair(parts(), inner(question), shape_a, pose_a, shape_b, pose_b);
  Result result;
  write_in_place(result, [&](Outcome& outcome) {
    pair.solve(outcome);
    keep_given(pair.task, pair.swap, outcome);
  });
  return result;
}

bool Solver::intersects(const Body& a, const Body& b) {
  Outcome outcome;
  Parts::OnePair(parts(), Task::intersect, a.shape, a.pose, b.shape, b.pose).solve(outcome);
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
    if (is_finite(bodies[i].pose)) continue;
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
  parts.swapped.resize(pairs.size());
  parts.outcomes.assign(pairs.size(), {});
  std::array<std::size_t, 65> ends = begins;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const IndexPair& pair = pairs[i];
    const std::size_t at = ends[kinds(pair)]++;
    const bool swap = needs_swap(kind(pair.a), kind(pair.b));
    parts.order[at] = static_cast<std::uint32_t>(i);
    parts.swapped[at] = swap ? 1 : 0;
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
  // No pair is read from here on: results may overwrite them.
  for (std::size_t at = 0; at < results.size(); ++at) {
    Outcome& outcome = parts.outcomes[at];
    keep_given(task, parts.swapped[at] != 0, outcome);
    std::memcpy(static_cast<void*>(&results[parts.order[at]]), &outcome, sizeof outcome);
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

// A pointer needs no test whether the thread has made it.
thread_local Solver* of_thread = nullptr;

Solver& make_solver_of_thread() {
  struct Owner {
    Solver solver;
    Owner() { of_thread = &solver; }
    ~Owner() { of_thread = nullptr; }
  };
  thread_local Owner owner;
  return owner.solver;
}
Solver& solver_of_thread() {
  if (of_thread == nullptr) [[unlikely]]
    return make_solver_of_thread();
  return *of_thread;
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
