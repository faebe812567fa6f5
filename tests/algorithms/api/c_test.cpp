// The interface in C: its numbers are those of C++, and what is wrong is a number with words.
#include <gtest/gtest.h>
#include <touchstone/touchstone.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <touchstone/touchstone.hpp>
#include <vector>

#include "tests/algorithms/api/api.h"

namespace touchstone::api_test {
namespace {

constexpr touchstone_pose origin = {{1, 0, 0, 0, 1, 0, 0, 0, 1}, {0, 0, 0}};

touchstone_pose at(double x) { return {{1, 0, 0, 0, 1, 0, 0, 0, 1}, {x, 0, 0}}; }

std::string last_error() { return touchstone_last_error(); }

TEST(InterfaceInC, AsksAsInCpp) {
  EXPECT_STREQ(touchstone_version(), v1::version());
  touchstone_shape *cone = nullptr, *hull = nullptr;
  const std::vector<double> points = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
  ASSERT_EQ(touchstone_cone(1, 2, &cone), TOUCHSTONE_OK);
  ASSERT_EQ(touchstone_hull(points.data(), 4, &hull), TOUCHSTONE_OK);
  touchstone_solver* solver = nullptr;
  ASSERT_EQ(touchstone_solver_create(nullptr, &solver), TOUCHSTONE_OK);
  const touchstone_shape* both[] = {cone, hull};
  EXPECT_EQ(touchstone_solver_prepare(solver, both, 2), TOUCHSTONE_OK);
  const std::vector<v1::Vec3> corners = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const v1::Shape cone_in_cpp = v1::Shape::cone(1, 2), hull_in_cpp = v1::Shape::hull(corners);
  int separated = 0, overlapping = 0;
  for (double x = -4; x < 4; x += 0.37) {
    const double quarter = std::sqrt(0.5), place[] = {x, 0.1, 0.2};
    touchstone_pose turned;
    ASSERT_EQ(touchstone_pose_from_quaternion(quarter, 0, quarter, 0, place, &turned),
              TOUCHSTONE_OK);
    touchstone_result result = TOUCHSTONE_RESULT_INIT;
    const touchstone_pose beside = at(0.5);
    ASSERT_EQ(touchstone_solver_ask(solver, TOUCHSTONE_SIGNED_DISTANCE, cone, &turned, hull,
                                    &beside, &result),
              TOUCHSTONE_OK);
    const v1::Result expected = v1::signed_distance(
        {cone_in_cpp, v1::Pose::from_quaternion(quarter, 0, quarter, 0, {x, 0.1, 0.2})},
        {hull_in_cpp, v1::Pose::at({0.5, 0, 0})});
    EXPECT_EQ(result.distance, expected.distance);
    EXPECT_EQ(result.normal[1], expected.normal.y);
    EXPECT_EQ(result.on_b[2], expected.on_b.z);
    EXPECT_EQ(result.answer, static_cast<int>(expected.answer));
    separated += result.answer == TOUCHSTONE_SEPARATED;
    overlapping += result.answer == TOUCHSTONE_OVERLAPPING;
  }
  EXPECT_GT(separated, 2);
  EXPECT_GT(overlapping, 2);
  touchstone_shape_destroy(cone);
  touchstone_shape_destroy(hull);
  touchstone_solver_destroy(solver);
}

// The structure as the header had it before it counted.
struct FirstResult {
  std::size_t struct_size = sizeof(FirstResult);
  std::int32_t answer = 3, status = 4;
  double distance = 0, lower = 0, upper = 0, normal[3] = {}, on_a[3] = {}, on_b[3] = {};
  double behind[2] = {7, 7};  // not the library's
};

TEST(InterfaceInC, ServesProgramsOfTheFirstHeader) {
  touchstone_shape *cone = nullptr, *ball = nullptr;
  touchstone_solver* solver = nullptr;
  ASSERT_EQ(touchstone_cone(1, 2, &cone), TOUCHSTONE_OK);
  ASSERT_EQ(touchstone_sphere(1, &ball), TOUCHSTONE_OK);
  ASSERT_EQ(touchstone_solver_create(nullptr, &solver), TOUCHSTONE_OK);
  int separated = 0, overlapping = 0;
  for (double x = 0.5; x < 4; x += 0.25) {
    const touchstone_pose beside = at(x);
    FirstResult first;
    first.struct_size = offsetof(FirstResult, behind);
    touchstone_result result = TOUCHSTONE_RESULT_INIT;
    for (touchstone_result* const one : {&result, reinterpret_cast<touchstone_result*>(&first)}) {
      ASSERT_EQ(touchstone_solver_ask(solver, TOUCHSTONE_SIGNED_DISTANCE, cone, &origin, ball,
                                      &beside, one),
                TOUCHSTONE_OK);
    }
    EXPECT_EQ(first.answer, result.answer);
    EXPECT_EQ(first.status, TOUCHSTONE_STATUS_OK);
    EXPECT_EQ(first.distance, result.distance);
    EXPECT_EQ(first.normal[0], result.normal[0]);
    EXPECT_EQ(first.on_b[2], result.on_b[2]);
    EXPECT_EQ(first.behind[0], 7);
    EXPECT_EQ(first.behind[1], 7);
    EXPECT_GE(result.iterations, -1);
    separated += result.answer == TOUCHSTONE_SEPARATED;
    overlapping += result.answer == TOUCHSTONE_OVERLAPPING;
  }
  EXPECT_GT(separated, 2);
  EXPECT_GT(overlapping, 2);
  touchstone_shape_destroy(cone);
  touchstone_shape_destroy(ball);
  touchstone_solver_destroy(solver);
}

TEST(InterfaceInC, WritesCertificates) {
  touchstone_shape *box = nullptr, *cone = nullptr;
  ASSERT_EQ(touchstone_box(1, 1, 1, &box), TOUCHSTONE_OK);
  ASSERT_EQ(touchstone_cone(1, 0.1, &cone), TOUCHSTONE_OK);
  const touchstone_pose beside = at(3.1);
  char* text = nullptr;
  ASSERT_EQ(touchstone_certificate(box, &origin, cone, &beside, &text), TOUCHSTONE_OK);
  EXPECT_EQ(std::string(text),
            v1::certificate({v1::Shape::box({1, 1, 1}), {}},
                            {v1::Shape::cone(1, 0.1), v1::Pose::at({3.1, 0, 0})}));
  EXPECT_NE(std::string(text).find("\"answer\":\"separated\""), std::string::npos);
  EXPECT_EQ(std::string(text).find('\n'), std::string::npos);
  touchstone_text_destroy(text);
  touchstone_text_destroy(nullptr);
  const touchstone_pose wrong = at(nan);
  EXPECT_EQ(touchstone_certificate(box, &origin, cone, &wrong, &text), TOUCHSTONE_INVALID);
  EXPECT_EQ(touchstone_certificate(box, &origin, cone, &beside, nullptr), TOUCHSTONE_INVALID);
  touchstone_shape_destroy(box);
  touchstone_shape_destroy(cone);
}

TEST(InterfaceInC, HasWorlds) {
  touchstone_shape* ball = nullptr;
  touchstone_world* world = nullptr;
  touchstone_world_options options = TOUCHSTONE_WORLD_OPTIONS_INIT;
  options.broad_phase = "packed-rtree";
  ASSERT_EQ(touchstone_sphere(1, &ball), TOUCHSTONE_OK);
  ASSERT_EQ(touchstone_world_create(&options, &world), TOUCHSTONE_OK);
  touchstone_handle a, b, c;
  const double box[] = {-1, -1, -1, 1, 1, 1};
  const touchstone_pose beside = at(1.5), far = at(9);
  ASSERT_EQ(touchstone_world_insert(world, ball, &origin, &a), TOUCHSTONE_OK);
  ASSERT_EQ(touchstone_world_insert(world, ball, &beside, &b), TOUCHSTONE_OK);
  ASSERT_EQ(touchstone_world_insert_box(world, box, &c), TOUCHSTONE_OK);
  touchstone_shape_destroy(ball);  // the world goes on with it
  const auto count = [](void* context, touchstone_handle, touchstone_handle) {
    ++*static_cast<int*>(context);
    return 0;
  };
  const auto count_changes = [](void* context, int began, touchstone_handle, touchstone_handle) {
    ++static_cast<int*>(context)[began];
    return 0;
  };
  int pairs = 0, changes[2] = {0, 0};
  EXPECT_EQ(touchstone_world_update(world), TOUCHSTONE_OK);
  EXPECT_EQ(touchstone_world_for_each_pair(world, count, &pairs), TOUCHSTONE_OK);
  EXPECT_EQ(touchstone_world_for_each_change(world, count_changes, changes), TOUCHSTONE_OK);
  EXPECT_EQ(pairs, 3);
  EXPECT_EQ(changes[1], 3);
  EXPECT_EQ(touchstone_world_move(world, b, &far), TOUCHSTONE_OK);
  EXPECT_EQ(touchstone_world_move_box(world, c, box), TOUCHSTONE_OK);
  EXPECT_EQ(touchstone_world_update(world), TOUCHSTONE_OK);
  EXPECT_EQ(touchstone_world_for_each_change(world, count_changes, changes), TOUCHSTONE_OK);
  EXPECT_EQ(changes[0], 2);
  const double from[] = {-5, 0, 0}, way[] = {1, 0, 0};
  touchstone_ray_hit hit = TOUCHSTONE_RAY_HIT_INIT;
  EXPECT_EQ(touchstone_world_ray(world, from, way, std::numeric_limits<double>::infinity(), &hit),
            TOUCHSTONE_OK);
  EXPECT_EQ(hit.hit, 1);
  EXPECT_EQ(hit.body.slot, a.slot);
  EXPECT_NEAR(hit.t, 4, 1e-12);
  EXPECT_EQ(touchstone_world_remove(world, a), TOUCHSTONE_OK);
  EXPECT_EQ(touchstone_world_remove(world, a), TOUCHSTONE_INVALID);
  EXPECT_EQ(last_error(), "found a handle of no body: it was removed, or is of another world");
  touchstone_world_destroy(world);
}

TEST(InterfaceInC, RefusesWhatIsWrong) {
  touchstone_shape* shape = nullptr;
  EXPECT_EQ(touchstone_sphere(-1, &shape), TOUCHSTONE_INVALID);
  EXPECT_EQ(shape, nullptr);
  EXPECT_NE(last_error().find("as a radius; expected"), std::string::npos);
  EXPECT_EQ(touchstone_sphere(1, nullptr), TOUCHSTONE_INVALID);
  EXPECT_EQ(touchstone_hull(nullptr, 0, &shape), TOUCHSTONE_INVALID);
  EXPECT_EQ(touchstone_hull(nullptr, 1, &shape), TOUCHSTONE_INVALID);
  touchstone_solver* solver = nullptr;
  touchstone_solver_options options = TOUCHSTONE_SOLVER_OPTIONS_INIT;
  options.algorithm = "gkj";
  EXPECT_EQ(touchstone_solver_create(&options, &solver), TOUCHSTONE_INVALID);
  EXPECT_EQ(solver, nullptr);
  EXPECT_NE(last_error().find("expected a narrow phase: closed-form"), std::string::npos);
  options = TOUCHSTONE_SOLVER_OPTIONS_INIT;
  options.struct_size = 1;
  EXPECT_EQ(touchstone_solver_create(&options, &solver), TOUCHSTONE_INVALID);
  ASSERT_EQ(touchstone_solver_create(nullptr, &solver), TOUCHSTONE_OK);
  ASSERT_EQ(touchstone_box(1, 1, 1, &shape), TOUCHSTONE_OK);
  touchstone_result result = TOUCHSTONE_RESULT_INIT;
  touchstone_pose wrong = at(nan);
  EXPECT_EQ(touchstone_solver_ask(solver, 1, shape, &origin, shape, &wrong, &result),
            TOUCHSTONE_INVALID);
  EXPECT_EQ(result.answer, TOUCHSTONE_UNKNOWN);
  EXPECT_EQ(result.distance, 0) << "a call with a wrong argument writes nothing";
  for (double* const number : {&wrong.rotation[0], &wrong.rotation[5], &wrong.translation[2]}) {
    for (const double bad : {nan, std::numeric_limits<double>::infinity(), -HUGE_VAL}) {
      wrong = at(3);
      *number = bad;
      EXPECT_EQ(touchstone_solver_ask(solver, 1, shape, &wrong, shape, &origin, &result),
                TOUCHSTONE_INVALID);
    }
  }
  EXPECT_EQ(last_error(),
            "found a pose with a number that is infinite or NaN; expected finite ones");
  // A sum that overflows is no number that is infinite.
  touchstone_pose far = {{1, 0, 0, 0, 1, 0, 0, 0, 1}, {1.5e308, 0, 1.5e308}};
  EXPECT_EQ(touchstone_solver_ask(solver, 0, shape, &far, shape, &far, &result), TOUCHSTONE_OK);
  EXPECT_EQ(touchstone_solver_ask(solver, 7, shape, &origin, shape, &origin, &result),
            TOUCHSTONE_INVALID);
  EXPECT_EQ(touchstone_solver_ask(solver, 1, shape, &origin, nullptr, &origin, &result),
            TOUCHSTONE_INVALID);
  result.struct_size = 0;
  EXPECT_EQ(touchstone_solver_ask(solver, 1, shape, &origin, shape, &origin, &result),
            TOUCHSTONE_INVALID);
  // A program of a later version has a greater structure.
  struct {
    touchstone_result known = TOUCHSTONE_RESULT_INIT;
    double later = 7;
  } greater;
  greater.known.struct_size = sizeof greater;
  EXPECT_EQ(touchstone_solver_ask(solver, 1, shape, &origin, shape, &origin, &greater.known),
            TOUCHSTONE_OK);
  EXPECT_EQ(greater.later, 7);
  touchstone_shape_destroy(shape);
  touchstone_shape_destroy(nullptr);
  touchstone_solver_destroy(solver);
  touchstone_solver_destroy(nullptr);
  touchstone_world_destroy(nullptr);
}

}  // namespace
}  // namespace touchstone::api_test
