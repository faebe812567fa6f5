// Answers of solvers, held against the oracle and against the algorithms themselves; and what is wrong input.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <thread>
#include <vector>

#include "algorithms/hull/convex_hull.h"
#include "algorithms/pair_query.h"
#include "algorithms/registry.h"
#include "tests/algorithms/api/api.h"
#include "tests/algorithms/narrow_phase/any_pairs.h"

namespace touchstone::api_test {
namespace {

using test::any_pairs;
using test::AnyPair;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr std::array questions{v1::Question::intersect, v1::Question::distance,
                               v1::Question::penetration, v1::Question::signed_distance};

v1::Body body_of(const Shape& shape, const Pose& pose) { return {outer(shape), outer(pose)}; }

// Hulls of the tests may have vertices alone; the interface's have faces.
Shape with_faces(const Shape& shape) {
  return shape.kind == ShapeKind::hull ? hull_of(shape.hull->vertices) : shape;
}

// Returns the words of the error that the function throws.
template <class Function>
std::string error_of(const Function& function) {
  try {
    function();
  } catch (const v1::Error& error) {
    return error.what();
  }
  return "no error";
}

// Returns false if the algorithm did not vouch for its answer.
bool expect_right(const AnyPair& pair, v1::Question question, const v1::Result& result) {
  const double truth = pair.truth.middle();
  EXPECT_EQ(result.answer, truth > 0 ? v1::Answer::separated : v1::Answer::overlapping);
  if (result.status != v1::Status::ok) {
    EXPECT_EQ(result.status, v1::Status::not_converged);
    return false;
  }
  const bool asked =
      truth > 0 ? question == v1::Question::distance : question == v1::Question::penetration;
  if (!asked && question != v1::Question::signed_distance) {
    EXPECT_TRUE(std::isnan(result.distance));
    return true;
  }
  EXPECT_NEAR(result.distance, truth, 1e-6 * pair.size());
  // The witness points lie along the normal, from a to b.
  const v1::Vec3 &a = result.on_a, &b = result.on_b, &n = result.normal;
  const double along = (b.x - a.x) * n.x + (b.y - a.y) * n.y + (b.z - a.z) * n.z;
  EXPECT_NEAR(along, truth, 1e-5 * pair.size());
  return true;
}

TEST(Pairs, AreAsTheOracleSays) {
  v1::Solver solver, certified({.algorithm = "certified"});
  std::map<v1::Answer, int> answers;
  int sure = 0, unsure = 0;
  for (const AnyPair& pair : any_pairs()) {
    if (!pair.is_bounded() || std::abs(pair.truth.middle()) < 1e-6) continue;
    SCOPED_TRACE(pair.name);
    const v1::Body a = body_of(pair.a, pair.pose_a), b = body_of(pair.b, pair.pose_b);
    for (const v1::Question question : questions) {
      ++(expect_right(pair, question, solver.ask(question, a, b)) ? sure : unsure);
      ++(expect_right(pair, question, solver.ask(question, b, a)) ? sure : unsure);
    }
    EXPECT_EQ(v1::intersects(a, b), pair.truth.middle() < 0);
    expect_right(pair, v1::Question::distance, v1::distance(a, b));
    expect_right(pair, v1::Question::penetration, v1::penetration(a, b));
    const v1::Result proven = certified.signed_distance(a, b);
    ++answers[proven.answer];
    if (proven.status != v1::Status::ok) continue;
    EXPECT_LE(proven.lower, pair.truth.upper);
    EXPECT_GE(proven.upper, pair.truth.lower);
  }
  EXPECT_LT(unsure, sure / 100);
  EXPECT_GT(answers[v1::Answer::separated], 50);
  EXPECT_GT(answers[v1::Answer::overlapping], 50);
}

// The interface adds nothing: the bits are those of the algorithm that was named.
TEST(Pairs, OfANamedAlgorithmAreItsOwn) {
  int answers = 0, unsupported = 0;
  for (const char* name : {"gjk", "closed-form", "exact"}) {
    const NarrowPhaseEntry& entry = *registry::find<NarrowPhaseEntry>(name);
    v1::Solver solver({.algorithm = name});
    for (std::size_t k = 0; k < any_pairs().size(); k += 7) {
      const AnyPair& pair = any_pairs()[k];
      const v1::Body a = body_of(pair.a, pair.pose_a), b = body_of(pair.b, pair.pose_b);
      const std::array<Shape, 2> shapes{with_faces(pair.a), with_faces(pair.b)};
      PairQuery query(entry.make({}), shapes);
      for (const Task task : all_tasks) {
        const v1::Result result = solver.ask(questions[static_cast<std::size_t>(task)], a, b);
        if (!offers(entry, pair.a.kind, pair.b.kind, task)) {
          EXPECT_EQ(result.status, v1::Status::unsupported);
          EXPECT_EQ(result.answer, v1::Answer::unknown);
          ++unsupported;
          continue;
        }
        const Outcome outcome = query.solve(task, {0, pair.pose_a, 1, pair.pose_b});
        EXPECT_EQ(static_cast<int>(result.answer), static_cast<int>(outcome.answer));
        EXPECT_EQ(static_cast<int>(result.status), static_cast<int>(outcome.status));
        EXPECT_TRUE(result.distance == outcome.distance || std::isnan(outcome.distance))
            << pair.name;
        ++answers;
      }
    }
  }
  EXPECT_GT(answers, 100);
  EXPECT_GT(unsupported, 10);
}

TEST(Pairs, InBatchesAreAsAlone) {
  std::vector<v1::Body> bodies;
  std::vector<v1::IndexPair> pairs;
  std::vector<const AnyPair*> whole;
  for (const AnyPair& pair : any_pairs()) {
    if (!pair.is_bounded() || std::abs(pair.truth.middle()) < 1e-6) continue;
    const auto at = static_cast<std::uint32_t>(bodies.size());
    bodies.push_back(body_of(pair.a, pair.pose_a));
    bodies.push_back(body_of(pair.b, pair.pose_b));
    pairs.push_back(pairs.size() % 2 == 0 ? v1::IndexPair{at, at + 1} : v1::IndexPair{at + 1, at});
    whole.push_back(&pair);
  }
  std::vector<v1::Shape> shapes;
  for (const v1::Body& body : bodies) shapes.push_back(body.shape);
  v1::Solver met, prepared;
  prepared.prepare(shapes);
  for (v1::Solver* solver : {&met, &prepared}) {
    for (const v1::Question question : questions) {
      std::vector<v1::Result> results(pairs.size());
      solver->ask(question, bodies, pairs, results);
      for (std::size_t i = 0; i < pairs.size(); ++i) {
        SCOPED_TRACE(whole[i]->name);
        expect_right(*whole[i], question, results[i]);
      }
    }
  }
}

TEST(Pairs, TakeMoreShapesThanASolverKeeps) {
  v1::Solver solver;
  const v1::Body ball = {v1::Shape::sphere(1), {}};
  for (int i = 0; i < 500; ++i) {
    const v1::Body other = {v1::Shape::sphere(0.001 * i), v1::Pose::at({5, 0, 0})};
    EXPECT_NEAR(solver.distance(ball, other).distance, 4 - 0.001 * i, 1e-12);
  }
}

TEST(Pairs, BeyondTheMarginHaveNoNumber) {
  v1::Solver solver({.margin = 1.5});
  const v1::Body ball = {v1::Shape::sphere(1), {}};
  const v1::Result near = solver.distance(ball, {v1::Shape::sphere(1), v1::Pose::at({3, 0, 0})});
  EXPECT_DOUBLE_EQ(near.distance, 1);
  const v1::Result far = solver.distance(ball, {v1::Shape::sphere(1), v1::Pose::at({4, 0, 0})});
  EXPECT_EQ(far.answer, v1::Answer::separated);
  EXPECT_TRUE(std::isnan(far.distance));
}

TEST(Pairs, OfTwoThreadsAreThoseOfOne) {
  const v1::Shape box = v1::Shape::box({1, 2, 3}), cone = v1::Shape::cone(1, 1);
  const auto sum = [&] {
    double all = 0;
    for (int i = 0; i < 2000; ++i) {
      all +=
          v1::signed_distance({box, {}}, {cone, v1::Pose::at({0.002 * i, 0.001 * i, 1})}).distance;
    }
    return all;
  };
  const double alone = sum();
  double one = 0, other = 0;
  std::thread thread([&] { one = sum(); });
  other = sum();
  thread.join();
  EXPECT_EQ(one, alone);
  EXPECT_EQ(other, alone);
}

TEST(Casts, FindTheTime) {
  v1::Solver solver;
  const v1::Shape box = v1::Shape::box({1, 1, 1}), ball = v1::Shape::sphere(1);
  const std::vector<v1::Vec3> corners = {{1, 1, 1},  {1, 1, -1},  {1, -1, 1},  {1, -1, -1},
                                         {-1, 1, 1}, {-1, 1, -1}, {-1, -1, 1}, {-1, -1, -1}};
  const v1::Shape hull = v1::Shape::hull(corners);
  for (const v1::Shape& a : {box, ball, hull}) {
    for (const v1::Shape& b : {box, ball, hull}) {
      for (const double turn : {0.0, 1e-9}) {
        const v1::Body other = {b, v1::Pose::at({4, 0, 0})};
        const v1::CastResult hit = solver.cast({a, {}}, {{4, 0, 0}, {0, 0, turn}}, other, {});
        EXPECT_EQ(hit.answer, v1::CastAnswer::hit);
        EXPECT_NEAR(hit.time, 0.5, 1e-6);
        EXPECT_NEAR(hit.normal.x, 1, 1e-3);
        const v1::CastResult miss = solver.cast({a, {}}, {{0, 4, 0}, {0, 0, turn}}, other, {});
        EXPECT_EQ(miss.answer, v1::CastAnswer::miss);
      }
    }
  }
}

TEST(Shapes, RefuseWhatIsWrong) {
  using v1::Shape;
  for (const double wrong : {-1.0, nan, infinity}) {
    EXPECT_THROW(Shape::sphere(wrong), v1::Error);
    EXPECT_THROW(Shape::capsule(1, wrong), v1::Error);
    EXPECT_THROW(Shape::cylinder(wrong, 1), v1::Error);
    EXPECT_THROW(Shape::cone(1, wrong), v1::Error);
    EXPECT_THROW(Shape::box({1, 1, wrong}), v1::Error);
    EXPECT_THROW(Shape::ellipsoid({1, wrong, 1}), v1::Error);
  }
  EXPECT_NE(error_of([] { Shape::sphere(-1); }).find("found -1.000000 as a radius"),
            std::string::npos);
  EXPECT_EQ(error_of([] { Shape::hull({}); }), "found a hull of no points; expected at least one");
  const std::vector<v1::Vec3> points = {{0, 0, 0}, {0, nan, 0}};
  EXPECT_NE(error_of([&] { Shape::hull(points); }).find("point 1"), std::string::npos);
  EXPECT_THROW(Shape::halfspace({0, 0, 0}, 1), v1::Error);
  EXPECT_THROW(Shape::halfspace({0, 0, 1}, infinity), v1::Error);
  EXPECT_THROW(v1::Pose::from_quaternion(0, 0, 0, 0, {}), v1::Error);
  const v1::Pose half = v1::Pose::from_quaternion(1e200, 0, 0, 1e200, {});
  EXPECT_NEAR(half.x_axis.y, 1, 1e-15);
}

TEST(Pairs, RefuseWhatIsWrong) {
  v1::Solver solver;
  v1::Body ball = {v1::Shape::sphere(1), {}};
  v1::Body off = ball;
  for (const double wrong : {nan, infinity, -infinity}) {
    off.pose.translation.y = wrong;
    EXPECT_THROW(solver.distance(ball, off), v1::Error);
    EXPECT_THROW(v1::intersects(off, ball), v1::Error);
    EXPECT_THROW(solver.cast(ball, {}, off, {}), v1::Error);
    EXPECT_THROW(solver.cast(ball, {{wrong, 0, 0}, {}}, ball, {}), v1::Error);
    EXPECT_THROW(v1::Solver({.tolerance = wrong}), v1::Error);
    EXPECT_THROW(v1::Solver({.margin = wrong}), v1::Error);
  }
  const std::string unknown = error_of([] { v1::Solver({.algorithm = "gkj"}); });
  EXPECT_NE(unknown.find("found 'gkj'; expected a narrow phase: closed-form, "), std::string::npos)
      << unknown;
  EXPECT_THROW(v1::Solver({.cast_algorithm = "gkj"}), v1::Error);
  EXPECT_THROW(v1::algorithm_names("pairs"), v1::Error);
  EXPECT_THAT(v1::algorithm_names("pair"), testing::Not(testing::Contains("fcl-libccd")));

  const std::vector<v1::Body> bodies = {ball, ball};
  const std::vector<v1::IndexPair> pairs = {{0, 1}, {0, 2}};
  std::vector<v1::Result> results(2);
  EXPECT_NE(error_of([&] {
              solver.ask(v1::Question::distance, bodies, pairs, results);
            }).find("body 2 in pair 1"),
            std::string::npos);
  results.resize(1);
  EXPECT_THROW(solver.ask(v1::Question::distance, bodies, pairs, results), v1::Error);

  const v1::Shape taken = std::move(ball.shape);
  EXPECT_THROW(solver.distance(ball, bodies[0]), v1::Error);
  EXPECT_THROW(ball.shape.kind(), v1::Error);
  EXPECT_EQ(taken.kind(), v1::Kind::sphere);
  v1::Solver other = std::move(solver);
  EXPECT_THROW(solver.distance(bodies[0], bodies[1]), v1::Error);
  EXPECT_EQ(other.distance(bodies[0], bodies[1]).answer, v1::Answer::overlapping);
}

}  // namespace
}  // namespace touchstone::api_test
