// A referee in a unit test: one's own function is held against proven bounds.
#include <cmath>
#include <cstdio>
#include <random>
#include <touchstone/touchstone.hpp>

// The function under test: the distance of two spheres. It is wrong where they overlap.
double my_distance(const touchstone::Vec3& a, double radius_a, const touchstone::Vec3& b,
                   double radius_b) {
  return std::fabs(std::hypot(a.x - b.x, a.y - b.y, a.z - b.z) - radius_a - radius_b);
}

int main() {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> place(-2, 2);
  touchstone::Solver referee({.algorithm = "certified"});
  int right = 0, wrong = 0;
  for (int i = 0; i < 1000; ++i) {
    const touchstone::Vec3 at = {place(random), place(random), place(random)};
    const touchstone::Result proven =
        referee.signed_distance({touchstone::Shape::sphere(1), {}},
                                {touchstone::Shape::sphere(0.5), touchstone::Pose::at(at)});
    const double mine = my_distance({}, 1, at, 0.5);
    const bool holds = proven.lower - 1e-12 <= mine && mine <= proven.upper + 1e-12;
    ++(holds ? right : wrong);
    if (!holds && wrong == 1) {
      std::printf("first wrong answer: %g, proven %g to %g\n", mine, proven.lower, proven.upper);
    }
  }
  std::printf("%d right, %d wrong\n", right, wrong);
  return right > 0 && wrong > 0 ? 0 : 1;  // a real test would ask for no wrong one
}
