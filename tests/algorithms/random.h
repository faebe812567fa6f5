// Random numbers, directions and rotations, for tests.
#pragma once

#include <numbers>
#include <random>

#include "algorithms/core/vec.h"

namespace touchstone::reference {

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine_);
  }
  int below(int count) { return std::uniform_int_distribution<int>(0, count - 1)(engine_); }
  Vec3d direction() {
    std::normal_distribution<double> normal;
    Vec3d v;
    do {
      v = {normal(engine_), normal(engine_), normal(engine_)};
    } while (v.norm() < 1e-3);
    return v.normalized();
  }
  Mat3d rotation() {
    const Vec3d axis = direction();
    return Eigen::AngleAxisd(uniform(0, std::numbers::pi), axis).toRotationMatrix();
  }
  Vec3d vector(double reach) {
    return {uniform(-reach, reach), uniform(-reach, reach), uniform(-reach, reach)};
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace touchstone::reference
