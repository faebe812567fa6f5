// Random draws, as families need them.
#pragma once

#include "algorithms/core/vec.h"
#include "harness/base/random.h"

namespace touchstone::families {

// What is drawn depends on the source: a check has one for each case, tests have others. Draw into variables, one after the
// other: g++ evaluates the arguments of a call, and operands, from the right, and clang from the left.
class Draws {
 public:
  virtual ~Draws() = default;
  virtual double uniform(double low, double high) = 0;
  virtual int below(int count) = 0;  // 0 to count - 1
  virtual Vec3d direction() = 0;     // unit length up to rounding
  virtual Mat3d rotation() = 0;

  Vec3d vector(double reach) {
    const double x = uniform(-reach, reach), y = uniform(-reach, reach);
    return {x, y, uniform(-reach, reach)};
  }
};

// Equal on every platform.
class RandomDraws final : public Draws {
 public:
  explicit RandomDraws(std::uint64_t seed, std::uint64_t stream = 0) : random_(seed, stream) {}

  double uniform(double low, double high) override { return random_.uniform(low, high); }
  int below(int count) override {
    return static_cast<int>(random_.below(static_cast<std::uint64_t>(count)));
  }
  Vec3d direction() override { return random_.on_sphere(); }
  Mat3d rotation() override { return random_.rotation(); }

 private:
  base::Random random_;
};

}  // namespace touchstone::families
