#include "algorithms/oracle/oracle.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <optional>
#include <string>

#include "algorithms/oracle/answer.h"
#include "algorithms/oracle/certificates/certificate_check.h"
#include "algorithms/oracle/exact_measure.h"
#include "tests/algorithms/oracle/reference.h"
#include "tests/algorithms/oracle/samples.h"

namespace touchstone::oracle {
namespace {

constexpr double inf = std::numeric_limits<double>::infinity();
constexpr float inf_float = std::numeric_limits<float>::infinity();

// The pair for a message, in numbers that lose nothing.
std::string describe(const Sample& sample) {
  std::string text;
  const auto number = [&](double x) {
    std::array<char, 40> digits;
    std::snprintf(digits.data(), digits.size(), "%a, ", x);
    text += digits.data();
  };
  for (const Placed* body : {&sample.a, &sample.b}) {
    const Solid& solid = *body->solid;
    text += "\nbody of core " + std::to_string(static_cast<int>(solid.core)) + ", radius ";
    number(solid.radius);
    text += "extents ";
    for (const double x : solid.extents) number(x);
    text += "plane ";
    for (const double x : solid.normal) number(x);
    number(solid.offset);
    text += "\n  vertices ";
    for (const Vec3d& vertex : solid.vertices) {
      text += "{";
      for (const double x : vertex) number(x);
      text += "}, ";
    }
    text += "\n  matrix by rows ";
    for (int row = 0; row < 3; ++row) {
      for (int column = 0; column < 3; ++column) number(body->pose.rotation(row, column));
    }
    text += "translation ";
    for (const double x : body->pose.translation) number(x);
    if (body->quaternion) {
      text += "quaternion ";
      for (const double x : *body->quaternion) number(x);
    }
  }
  return text;
}

// Returns true if x is no greater than the signed distance of the bodies with this signed square of
// their cores' distance.
bool is_below(double x, const mpq_class& cores, const mpq_class& radii) {
  if (std::isinf(x)) return x < 0;
  const mpq_class of_cores = mpq_class(x) + radii;
  return of_cores * abs(of_cores) <= cores;
}
bool is_above(double x, const mpq_class& cores, const mpq_class& radii) {
  if (std::isinf(x)) return x > 0;
  const mpq_class of_cores = mpq_class(x) + radii;
  return of_cores * abs(of_cores) >= cores;
}

// Checks every property of an answer that holds for all bodies. Returns the measure after checking
// its proof.
ExactMeasure expect_sound(Oracle& oracle, const Sample& sample) {
  const Body a = sample.a.body(), b = sample.b.body();
  Certificate certificate;
  const Measure proven = oracle.prove(a, b, certificate);
  EXPECT_EQ(fault(certificate, a, b), "");
  const ExactMeasure measure = oracle.measure_exactly(a, b);
  EXPECT_EQ(certificate.answer, measure.answer);
  EXPECT_EQ(certificate.lower, measure.core_lower);
  EXPECT_EQ(certificate.upper, measure.core_upper);
  EXPECT_LE(measure.core_lower, measure.core_upper);
  EXPECT_LE(measure.lower, measure.upper);
  for (const Measure& again : {proven, oracle.measure(a, b)}) {
    EXPECT_EQ(again.answer, measure.answer);
    EXPECT_EQ(again.exact, measure.exact);
    EXPECT_EQ(again.lower, measure.lower);
    EXPECT_EQ(again.upper, measure.upper);
    EXPECT_EQ(again.normal, measure.normal);
  }
  return measure;
}

class ExactRegime : public ::testing::TestWithParam<Regime> {};

TEST_P(ExactRegime, IsProvenAndAgreesWithTheReferences) {
  const Regime& regime = GetParam();
  Random random(17);
  Oracle oracle;
  std::array<int, 4> answers{};
  const int count = regime.count / one_in;
  for (int i = 0; i < count && !HasFailure(); ++i) {
    const Sample sample = regime.make(random, i);
    SCOPED_TRACE(std::to_string(i) + describe(sample));
    const Body a = sample.a.body(), b = sample.b.body();
    const ExactMeasure measure = expect_sound(oracle, sample);
    EXPECT_TRUE(measure.exact);
    EXPECT_EQ(measure.core_lower, measure.core_upper);
    EXPECT_EQ(oracle.verdict(a, b), measure.answer);
    EXPECT_EQ(oracle.verdict(b, a), measure.answer);
    EXPECT_EQ(oracle.measure_exactly(b, a).core_lower, measure.core_lower);
    ++answers[static_cast<std::size_t>(measure.answer)];

    const mpq_class cores = reference::signed_square(measure.core_lower);
    const mpq_class radii = mpq_class(sample.a.solid->radius) + mpq_class(sample.b.solid->radius);
    EXPECT_EQ(measure.answer, reference::answer_of(cores, radii));
    EXPECT_TRUE(is_below(measure.lower, cores, radii));
    EXPECT_TRUE(is_above(measure.upper, cores, radii));
    EXPECT_TRUE(measure.lower == measure.upper ||
                std::nextafter(measure.lower, inf) == measure.upper);

    if (i >= std::max(regime.by_axes, regime.by_cgal) / one_in) continue;
    const reference::IntegerPair pair = reference::integer_pair(a, b);
    if (i < regime.by_axes / one_in) {
      const reference::Separation separation = reference::separate(pair);
      EXPECT_EQ(separation.answer, reference::answer_of(cores, 0));
      if (cores <= 0) {
        EXPECT_EQ(separation.depth, cores);
      }
    }
#ifdef TOUCHSTONE_CGAL
    if (i < regime.by_cgal / one_in && cores >= 0) {
      EXPECT_EQ(reference::squared_distance(pair), cores);
    }
#endif
  }
  const auto percent = [&](Answer answer) {
    return 100 * answers[static_cast<std::size_t>(answer)] / count;
  };
  EXPECT_GE(percent(Answer::separated), regime.separated);
  EXPECT_GE(percent(Answer::touching), regime.touching);
  EXPECT_GE(percent(Answer::overlapping), regime.overlapping);
}

INSTANTIATE_TEST_SUITE_P(Oracle, ExactRegime, ::testing::ValuesIn(exact_regimes()),
                         [](const auto& regime) { return std::string(regime.param.name); });

// A length of about the pair's size, for widths.
double size_of(const Sample& sample) {
  double size = (sample.b.pose.translation - sample.a.pose.translation).norm();
  for (const Placed* body : {&sample.a, &sample.b}) {
    size = std::max({size, body->solid->radius, body->solid->extents.maxCoeff()});
  }
  return size;
}

TEST(Oracle, EnclosesCurvedBodies) {
  Random random(19);
  Oracle oracle;
  std::array<int, 4> answers{};
  constexpr int count = 1500 / one_in;
  int narrow = 0;
  for (int i = 0; i < count && !HasFailure(); ++i) {
    const Sample sample = curved_sample(random, i);
    SCOPED_TRACE(std::to_string(i) + describe(sample));
    const Body a = sample.a.body(), b = sample.b.body();
    const ExactMeasure measure = expect_sound(oracle, sample);
    EXPECT_EQ(oracle.verdict(a, b), measure.answer);
    ++answers[static_cast<std::size_t>(measure.answer)];
    const double width = (measure.upper - measure.lower) / size_of(sample);
    EXPECT_LT(width, 1e-6);
    narrow += width < 1e-10 ? 1 : 0;
    const ExactMeasure reverse = oracle.measure_exactly(b, a);
    EXPECT_LE(reverse.core_lower, measure.core_upper);
    EXPECT_LE(measure.core_lower, reverse.core_upper);
  }
  EXPECT_GT(narrow, count * 9 / 10);
  EXPECT_GT(answers[static_cast<std::size_t>(Answer::separated)], count / 5);
  EXPECT_GT(answers[static_cast<std::size_t>(Answer::overlapping)], count / 5);
}

TEST(Oracle, MeasuresHalfspaces) {
  Random random(23);
  Oracle oracle;
  std::array<int, 4> answers{};
  constexpr int count = 3000 / one_in;
  for (int i = 0; i < count && !HasFailure(); ++i) {
    const Sample sample = halfspace_sample(random, i);
    SCOPED_TRACE(std::to_string(i) + describe(sample));
    const ExactMeasure measure = expect_sound(oracle, sample);
    EXPECT_EQ(oracle.verdict(sample.a.body(), sample.b.body()), measure.answer);
    const bool curved = sample.a.solid->is_curved() || sample.b.solid->is_curved();
    EXPECT_TRUE(measure.exact || curved);
    if (std::isfinite(measure.lower)) {
      EXPECT_LT(measure.upper - measure.lower, 1e-15);
    }
    ++answers[static_cast<std::size_t>(measure.answer)];
  }
  EXPECT_GT(answers[static_cast<std::size_t>(Answer::separated)], count / 5);
  EXPECT_GT(answers[static_cast<std::size_t>(Answer::overlapping)], count / 5);
}

TEST(Oracle, NothingIsKnownOfASingularHalfspace) {
  Shape shape;
  shape.kind = ShapeKind::halfspace;
  const Solid halfspace(shape);
  Pose flat;
  flat.rotation.row(1).setZero();
  const Solid ball{Shape{}};
  Oracle oracle;
  Certificate certificate;
  const Body a(halfspace, flat), b(ball, Pose{});
  EXPECT_EQ(oracle.prove(a, b, certificate).answer, Answer::unknown);
  EXPECT_EQ(fault(certificate, a, b), "");
  EXPECT_EQ(oracle.prove(a, a, certificate).answer, Answer::unknown);
  EXPECT_EQ(fault(certificate, a, a), "");
}

// Bounds belong to `touching` and `unknown` whatever was asked.
TEST(OracleAnswer, OfAYesOrNoHasNoBoundsOfAnEarlierCall) {
  Shape block;
  block.kind = ShapeKind::box;
  block.half_extents = Vec3d::Constant(1);
  Shape plane;
  plane.kind = ShapeKind::halfspace;
  const Solid box(block), halfspace(plane);
  Pose beside, flat;
  beside.translation = Vec3d(2, 0.5, 0.25);
  flat.rotation.row(1).setZero();
  Oracle oracle;
  const auto expect = [&](const Body& a, const Body& b, Answer expected) {
    Outcome outcome;
    outcome.lower = -18;
    outcome.upper = 19;
    answer(oracle, a, b, Task::intersect, outcome);
    EXPECT_EQ(outcome.answer, expected);
    EXPECT_TRUE(std::isnan(outcome.lower) && std::isnan(outcome.upper));
  };
  expect({box, Pose{}}, {box, beside}, Answer::touching);
  expect({halfspace, flat}, {box, beside}, Answer::unknown);
}

// The support of the difference along n, as a signed square.
mpq_class exact_separation(const Body& a, const Body& b, const Vec3d& n) {
  const reference::IntegerPair pair = reference::integer_pair(a, b);
  const std::array<mpq_class, 3> along = {n[0], n[1], n[2]};
  const auto reach = [&](const std::vector<reference::Point>& points, int sign) {
    std::optional<mpq_class> greatest;
    for (const reference::Point& p : points) {
      const mpq_class value = sign * (along[0] * p[0] + along[1] * p[1] + along[2] * p[2]);
      if (!greatest || value > *greatest) greatest = value;
    }
    return *greatest;
  };
  const mpq_class height = (reach(pair.a, 1) + reach(pair.b, -1)) * pair.unit;
  return height * abs(height) / (along[0] * along[0] + along[1] * along[1] + along[2] * along[2]);
}

TEST(Oracle, SaysHowFarADirectionSeparates) {
  Random random(29);
  for (const Regime& regime : exact_regimes()) {
    for (int i = 0; i < 60 && !HasFailure(); ++i) {
      const Sample sample = regime.make(random, i);
      Vec3d n = random.direction();
      if (i % 3 == 0) n = Vec3d(random.below(3) - 1, random.below(3) - 1, 1);
      if (i % 7 == 0) n *= std::ldexp(1.0, random.below(1800) - 900);
      SCOPED_TRACE(std::string(regime.name) + describe(sample));
      const Body a = sample.a.body(), b = sample.b.body();
      const Enclosure enclosure = separation_along(a, b, n);
      const mpq_class exact = exact_separation(a, b, n);
      const mpq_class radii = mpq_class(a.solid->radius) + mpq_class(b.solid->radius);
      EXPECT_TRUE(is_below(enclosure.lower, exact, -radii));
      EXPECT_TRUE(is_above(enclosure.upper, exact, -radii));
      EXPECT_TRUE(enclosure.lower == enclosure.upper ||
                  std::nextafter(enclosure.lower, inf) == enclosure.upper);
    }
  }
}

TEST(Oracle, NoDirectionSeparatesLessThanTheDepth) {
  Random random(31);
  Oracle oracle;
  for (int i = 0; i < 300; ++i) {
    const Sample sample = curved_sample(random, i);
    const Body a = sample.a.body(), b = sample.b.body();
    const Measure measure = oracle.measure(a, b);
    EXPECT_GE(measure.upper, -separation_along(a, b, random.direction()).upper);
    const Enclosure best = separation_along(a, b, measure.normal);
    EXPECT_LE(best.lower, best.upper);
    EXPECT_NEAR(best.lower, -measure.lower, 1e-9);
    EXPECT_NEAR(best.upper, best.lower, 1e-15);
  }
}

TEST(Oracle, KnowsWhetherABoxHoldsABody) {
  Random random(37);
  const Solid origin{Shape{}};
  for (int i = 0; i < 300; ++i) {
    const Sample sample = exact_regimes()[i % 9].make(random, i);
    const Body body = sample.b.body();
    SCOPED_TRACE(describe(sample));
    Aabb box = Aabb::empty();
    for (int axis = 0; axis < 3; ++axis) {
      for (const int sign : {-1, 1}) {
        Vec3d n = Vec3d::Zero();
        n[axis] = sign;
        const mpq_class radius = body.solid->radius;
        const mpq_class reach = exact_separation(body, Body(origin, Pose{}), n);
        // The least float that is no less than the body's reach.
        const auto holds_side = [&](float x) {
          const mpq_class of_core = mpq_class(static_cast<double>(x)) - radius;
          return of_core * abs(of_core) >= reach;
        };
        float side = static_cast<float>(separation_along(body, Body(origin, Pose{}), n).upper);
        while (!holds_side(side)) side = std::nextafter(side, inf_float);
        while (holds_side(std::nextafter(side, -inf_float)))
          side = std::nextafter(side, -inf_float);
        (sign > 0 ? box.max : box.min)[static_cast<std::size_t>(axis)] = sign > 0 ? side : -side;
      }
    }
    EXPECT_TRUE(holds(box, body));
    for (std::size_t axis = 0; axis < 3; ++axis) {
      Aabb less = box;
      less.max[axis] = std::nextafter(less.max[axis], -inf_float);
      EXPECT_FALSE(holds(less, body));
      less = box;
      less.min[axis] = std::nextafter(less.min[axis], inf_float);
      EXPECT_FALSE(holds(less, body));
    }
  }
}

constexpr int noticed = 3, not_noticed = 4;

// Ends the process with whether one of the answers is wrong, and is found to be so by its
// certificate or by the verdict of an oracle that is sound. An answer may take two seconds.
[[noreturn]] void ask_with(const Filters& filters, int count) {
  Random random(41);
  Oracle sound, broken(filters);
  for (int i = 0; i < count; ++i) {
    const Sample sample = nearly_touching_sample(random, i);
    const Body a = sample.a.body(), b = sample.b.body();
    const Measure measure = sound.measure(a, b);
    alarm(2);
    if (broken.verdict(a, b) != measure.answer) std::_Exit(noticed);
    Certificate certificate;
    broken.prove(a, b, certificate);
    alarm(0);
    if (!fault(certificate, a, b).empty()) std::_Exit(noticed);
  }
  std::_Exit(not_noticed);
}

TEST(OracleDeathTest, ABrokenFilterIsNoticed) {
  constexpr int count = 2500;
  EXPECT_EXIT(ask_with({}, count / one_in), ::testing::ExitedWithCode(not_noticed), "");
  // A polytope whose faces disagree on what they see may also grow for ever.
  const auto is_noticed = [](int status) {
    return (WIFEXITED(status) && WEXITSTATUS(status) == noticed) ||
           (WIFSIGNALED(status) && WTERMSIG(status) == SIGALRM);
  };
  for (double Filters::*bound : {&Filters::plane, &Filters::tetrahedron, &Filters::radius,
                                 &Filters::support, &Filters::visibility, &Filters::nearest}) {
    Filters filters;
    filters.*bound = 0;
    EXPECT_EXIT(ask_with(filters, count), is_noticed, "");
  }
}

}  // namespace
}  // namespace touchstone::oracle
