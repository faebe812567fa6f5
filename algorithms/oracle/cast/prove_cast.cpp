// Part of the oracle: turns what a search or an enclosure found into a certificate.
// Steps:   1. Of bodies that do not turn the last plane mostly parts them from the start on; then it is the
//             only one. Otherwise all planes are kept.
//          2. Without radii, the bodies meet where the gap of the last plane closes, which is a fraction. GJK
//             at that time confirms it.
//          3. With radii, the feature that is nearest at both ends of the bracket is so between them. Its
//             distance reaches the radii at the root of a quadratic.
//          4. An enclosure's planes and its contact are those of rounded poses, which is allowed for.
#include "algorithms/oracle/cast/prove_cast.h"

#include <algorithm>
#include <boost/multiprecision/integer.hpp>

#include "algorithms/oracle/cast/linear_search.h"
#include "algorithms/oracle/numbers/dyadic.h"

namespace touchstone::oracle {
namespace {

const Integer one_time = Integer(1) << MovingCores::time_bits;

IntegerVector primitive(const IntegerVector& n) {
  Integer common = 0;
  for (const Integer& part : n) common = gcd(common, part);
  if (common.is_zero()) return n;
  return {n[0] / common, n[1] / common, n[2] / common};
}

// An exact multiple of a vector of doubles.
IntegerVector integers(const Vec3d& v) {
  int exponent = Dyadic::of_zero;
  for (const double x : v) exponent = std::min(exponent, dyadic(x).exponent);
  IntegerVector n;
  for (int k = 0; k < 3; ++k) n[k] = dyadic(v[k]).over_power(exponent);
  return n;
}

TimeFraction fraction(double time) {
  const Dyadic x = dyadic(time);
  if (x.mantissa.is_zero()) return {};
  if (x.exponent >= 0) return {x.over_power(0), 1};
  return {x.mantissa, Integer(1) << -x.exponent};
}

std::vector<Generator> all_vertices(const Solid& solid) {
  std::vector<Generator> all(solid.vertices.size());
  for (std::size_t i = 0; i < all.size(); ++i) all[i].vertex = static_cast<std::int32_t>(i);
  return all;
}

class LinearProof {
 public:
  LinearProof(const EnclosedBody& a, const EnclosedBody& b, CastCertificate& certificate)
      : cores_({*a.solid, *a.pose}, *a.motion, {*b.solid, *b.pose}, *b.motion),
        certificate_(certificate) {
    certificate.a = all_vertices(*a.solid);
    certificate.b = all_vertices(*b.solid);
  }

  void write() {
    LinearSearch search(cores_, iterations_);
    const LinearImpact impact = find_impact(search);
    certificate_.answer = impact.answer;
    if (impact.answer == CastAnswer::hit) {
      certificate_.lower = {impact.lower, one_time};
      const LinearContact& contact = impact.contact;
      const bool at_start = contact.steps.is_zero();
      if (!at_start && cores_.radius().is_zero() && write_fraction(*impact.plane)) return;
      const Integer parts = contact.parts * one_time, common = gcd(contact.steps, parts);
      certificate_.upper = {contact.steps / common, parts / common};
      write(contact);
      if (impact.lower > 0 && parts_from_the_start(*impact.plane)) {
        add(*impact.plane, certificate_.lower);
      } else {
        add_all(impact);
      }
      if (!at_start) write_feature(impact);
      return;
    }
    if (!impact.parted.empty() && parts_from_the_start(impact.parted.back().plane)) {
      add(impact.parted.back().plane, {impact.parted.back().until, one_time});
    } else {
      add_all(impact);
    }
    if (impact.answer == CastAnswer::unknown && !impact.parted.empty()) {
      certificate_.lower = {impact.parted.back().until, one_time};
    }
  }

 private:
  void add(const IntegerVector& plane, const TimeFraction& until) {
    certificate_.planes.push_back({until, primitive(-plane)});
  }
  void add_all(const LinearImpact& impact) {
    for (const auto& [plane, until] : impact.parted) add(plane, {until, one_time});
  }
  bool parts_from_the_start(const IntegerVector& plane) const {
    const Integer gap = dot(plane, cores_.least(plane).difference);
    return gap > 0 && gap * gap > cores_.radius() * cores_.radius() * dot(plane, plane);
  }

  void write(const LinearContact& contact) {
    for (std::size_t i = 0; i < contact.feature.size(); ++i) {
      certificate_.closest.push_back({contact.feature[i], contact.weights[i]});
    }
  }

  // Returns true if the bodies meet where the gap of the plane closes.
  bool write_fraction(const IntegerVector& plane) {
    const IntegerVector n = primitive(plane);
    const Integer gap = dot(n, cores_.least(n).difference), speed = dot(n, cores_.velocity());
    if (!(gap > 0 && speed > 0 && gap <= speed * one_time)) return false;
    LinearSearch search(cores_, iterations_, speed);
    search.go_to(gap);
    if (!search.in_contact()) return false;
    write(search.contact());
    const Integer common = gcd(gap, Integer(speed * one_time));
    certificate_.lower = certificate_.upper = {gap / common, speed * one_time / common};
    add(n, certificate_.upper);
    return true;
  }

  void write_feature(const LinearImpact& impact) {
    LinearSearch search(cores_, iterations_);
    search.go_to(impact.lower);
    const std::vector<DifferencePoint> feature = search.feature();
    const IntegerVector before = search.nearest().numerator;
    if (impact.contact.parts != 1) return;
    search.go_to(impact.contact.steps);
    const IntegerVector& v = cores_.velocity();
    const bool closes = dot(before, v) > 0 && dot(search.nearest().numerator, v) > 0;
    if (!closes || feature.size() > 3 || search.feature() != feature) return;
    std::vector<IntegerVector> points;
    for (const DifferencePoint& point : feature) points.push_back(cores_.difference(point));
    const Integer square = cores_.radius() * cores_.radius();
    // The square of start - t * rate, less that of a length.
    const auto polynomial = [](const IntegerVector& start, const IntegerVector& rate,
                               const Integer& length) {
      return std::array<Integer, 3>{dot(start, start) - length, -2 * dot(start, rate),
                                    dot(rate, rate)};
    };
    std::array<Integer, 3> in_steps;
    if (points.size() == 1) {
      in_steps = polynomial(points[0], v, square);
    } else if (points.size() == 2) {
      const IntegerVector edge = points[1] - points[0];
      in_steps = polynomial(cross(points[0], edge), cross(v, edge), square * dot(edge, edge));
    } else {
      const IntegerVector n = cross(points[1] - points[0], points[2] - points[0]);
      in_steps = polynomial({dot(n, points[0]), 0, 0}, {dot(n, v), 0, 0}, square * dot(n, n));
    }
    certificate_.feature = feature;
    Integer common = 0;
    for (int k = 0; k < 3; ++k) {
      certificate_.polynomial[k] = in_steps[k] << k * MovingCores::time_bits;
      common = gcd(common, certificate_.polynomial[k]);
    }
    for (Integer& coefficient : certificate_.polynomial) coefficient /= common;
  }

  MovingCores cores_;
  CastCertificate& certificate_;
  int iterations_ = 0;
};

}  // namespace

double default_tolerance(const EnclosedBody& a, const EnclosedBody& b) {
  return 1e-9 * std::max(a.reach, b.reach);
}

void prove_cast(Oracle& oracle, const EnclosedBody& a, const EnclosedBody& b, double tolerance,
                CastCertificate& certificate) {
  certificate = {};
  const auto is_polytope = [](const EnclosedBody& body) {
    return body.solid->core == Solid::Core::polytope && !body.motion->turns();
  };
  if (is_polytope(a) && is_polytope(b)) {
    LinearProof(a, b, certificate).write();
    return;
  }
  CastOutcome outcome;
  std::vector<PartedUntil> planes;
  enclose(oracle, a, b, {tolerance}, outcome, &planes);
  certificate.answer = outcome.answer;
  const auto prove_at = [&](double time) {
    Certificate there;
    // The poses at the start are given, and not rounded.
    const bool is_given = !(time > 0);
    const Pose pose_a = is_given ? *a.pose : rounded_pose(a, a, time);
    const Pose pose_b = is_given ? *b.pose : rounded_pose(b, a, time);
    oracle.prove({*a.solid, pose_a}, {*b.solid, pose_b}, there);
    return there;
  };
  // A half-space, which does not turn, has a gap along its own normal alone, which may be no vector of
  // doubles.
  const bool of_plane = b.solid->core == Solid::Core::halfspace;
  const IntegerVector normal = of_plane ? prove_at(0).direction : IntegerVector{};
  for (const auto& [direction, until] : planes) {
    certificate.planes.push_back({fraction(until), of_plane ? normal : integers(direction)});
  }
  if (outcome.answer != CastAnswer::miss) certificate.lower = fraction(outcome.lower);
  if (outcome.answer != CastAnswer::hit) return;
  certificate.upper = fraction(outcome.upper);
  Certificate contact = prove_at(outcome.upper);
  certificate.a = std::move(contact.a);
  certificate.b = std::move(contact.b);
  certificate.closest = std::move(contact.closest);
  certificate.surface = std::move(contact.surface);
}

}  // namespace touchstone::oracle
