#include "algorithms/oracle/oracle.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "algorithms/oracle/certificate_check.h"
#include "tests/algorithms/oracle/reference.h"
#include "tests/algorithms/oracle/samples.h"

namespace touchstone::oracle {
namespace {

constexpr double inf = std::numeric_limits<double>::infinity();

// For a message: the pair, in numbers that lose nothing.
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

// Whether x is no greater than the signed distance of the bodies, whose cores' signed square this
// is.
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

// What holds of every answer, whatever the bodies. Returns the measure with its proof.
Measure expect_sound(Oracle& oracle, const Sample& sample) {
  const Body a = sample.a.body(), b = sample.b.body();
  Certificate certificate;
  const Measure measure = oracle.prove(a, b, certificate);
  EXPECT_EQ(fault(certificate, a, b), "");
  EXPECT_EQ(certificate.answer, measure.answer);
  EXPECT_EQ(certificate.lower, measure.core_lower);
  EXPECT_EQ(certificate.upper, measure.core_upper);
  EXPECT_LE(measure.core_lower, measure.core_upper);
  EXPECT_LE(measure.lower, measure.upper);
  const Measure again = oracle.measure(a, b);
  EXPECT_EQ(again.core_lower, measure.core_lower);
  EXPECT_EQ(again.core_upper, measure.core_upper);
  EXPECT_EQ(again.answer, measure.answer);
  EXPECT_EQ(again.lower, measure.lower);
  EXPECT_EQ(again.upper, measure.upper);
  EXPECT_EQ(again.normal, measure.normal);
  return measure;
}

class ExactRegime : public ::testing::TestWithParam<Regime> {};

TEST_P(ExactRegime, IsProvenAndAgreesWithTheReferences) {
  const Regime& regime = GetParam();
  Random random(17);
  Oracle oracle;
  std::array<int, 4> answers{};
  for (int i = 0; i < regime.count && !HasFailure(); ++i) {
    const Sample sample = regime.make(random, i);
    SCOPED_TRACE(std::to_string(i) + describe(sample));
    const Body a = sample.a.body(), b = sample.b.body();
    const Measure measure = expect_sound(oracle, sample);
    EXPECT_TRUE(measure.exact);
    EXPECT_EQ(measure.core_lower, measure.core_upper);
    EXPECT_EQ(oracle.verdict(a, b), measure.answer);
    EXPECT_EQ(oracle.verdict(b, a), measure.answer);
    EXPECT_EQ(oracle.measure(b, a).core_lower, measure.core_lower);
    ++answers[static_cast<std::size_t>(measure.answer)];

    const mpq_class cores = reference::signed_square(measure.core_lower);
    const mpq_class radii = mpq_class(sample.a.solid->radius) + mpq_class(sample.b.solid->radius);
    EXPECT_EQ(measure.answer, reference::answer_of(cores, radii));
    EXPECT_TRUE(is_below(measure.lower, cores, radii));
    EXPECT_TRUE(is_above(measure.upper, cores, radii));
    EXPECT_TRUE(measure.lower == measure.upper ||
                std::nextafter(measure.lower, inf) == measure.upper);

    if (i >= std::max(regime.by_axes, regime.by_cgal)) continue;
    const reference::IntegerPair pair = reference::integer_pair(a, b);
    if (i < regime.by_axes) {
      const reference::Separation separation = reference::separate(pair);
      EXPECT_EQ(separation.answer, reference::answer_of(cores, 0));
      if (cores <= 0) {
        EXPECT_EQ(separation.depth, cores);
      }
    }
    if (i < regime.by_cgal && cores >= 0) {
      EXPECT_EQ(reference::squared_distance(pair), cores);
    }
  }
  const auto percent = [&](Answer answer) {
    return 100 * answers[static_cast<std::size_t>(answer)] / regime.count;
  };
  std::printf("%d %d %d\n", percent(Answer::separated),percent(Answer::touching),percent(Answer::overlapping));
  EXPECT_GE(percent(Answer::separated), regime.separated);
  EXPECT_GE(percent(Answer::touching), regime.touching);
  EXPECT_GE(percent(Answer::overlapping), regime.overlapping);
}

INSTANTIATE_TEST_SUITE_P(Oracle, ExactRegime, ::testing::ValuesIn(exact_regimes()),
                         [](const auto& regime) { return std::string(regime.param.name); });

}  // namespace
}  // namespace touchstone::oracle
