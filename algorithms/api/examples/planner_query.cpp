// A planner's query: how close does a robot's link come to obstacles on its way? What is further than 0.5 m away
// needs no number, so the search ends early there.
#include <cmath>
#include <cstdio>
#include <touchstone/touchstone.hpp>
#include <vector>

int main() {
  const touchstone::Body link = {touchstone::Shape::capsule(0.1, 0.4), {}};
  std::vector<touchstone::Body> obstacles;
  for (int i = 0; i < 8; ++i) {
    const double angle = 0.25 * std::acos(-1.0) * i;
    obstacles.push_back({touchstone::Shape::cylinder(0.2, 1),
                         touchstone::Pose::at({2 * std::cos(angle), 2 * std::sin(angle), 0})});
  }
  std::vector<touchstone::Shape> shapes = {link.shape};
  for (const touchstone::Body& obstacle : obstacles) shapes.push_back(obstacle.shape);

  touchstone::Solver solver({.margin = 0.5});
  solver.prepare(shapes);
  double least = 0.5;
  for (int step = 0; step <= 100; ++step) {
    const double angle = 0.01 * step;  // half of it, for the quaternion about z
    const touchstone::Body placed = {
        link.shape, touchstone::Pose::from_quaternion(
                        std::cos(angle), 0, 0, std::sin(angle),
                        {1.5 * std::cos(2 * angle), 1.5 * std::sin(2 * angle), 0})};
    for (const touchstone::Body& obstacle : obstacles) {
      const touchstone::Result result = solver.signed_distance(placed, obstacle);
      if (result.answer == touchstone::Answer::overlapping || result.distance < least)
        least = result.distance;
    }
  }
  std::printf("clearance %.3f m\n", least);  // 2 - 1.5 - 0.1 - 0.2
}
