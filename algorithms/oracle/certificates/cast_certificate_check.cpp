// Derives what the planes, the points and the feature of a cast's certificate prove, in rationals.
#include "algorithms/oracle/certificates/cast_certificate_check.h"

#include <algorithm>

#include "algorithms/oracle/certificates/difference.h"
#include "algorithms/oracle/certificates/exact_time_check.h"
#include "algorithms/oracle/certificates/turning.h"

namespace touchstone::oracle {
namespace {

constexpr mp_bitcnt_t cast_root_bits = 256;

mpq_class rational(const TimeFraction& time) {
  require(time.denominator > 0, "the denominator of a time is not positive");
  return oracle::rational(time.numerator) / oracle::rational(time.denominator);
}

// A core that moves, at any time.
class Track {
 public:
  explicit Track(const MovingBody& moving)
      : start_(moving.body, cast_root_bits),
        turns_(moving.motion.turns()),
        displacement_(rational_vector(moving.motion.displacement)),
        turn_(rational_vector(moving.motion.rotation_vector)),
        reach_(turns_ ? start_.reach() : mpq_class(0)) {}

  struct Placed {
    RationalCore core;
    mpq_class doubt;  // greatest distance of a point from where it is placed
  };
  Placed at(const mpq_class& time) const {
    Placed placed{start_, 0};
    if (turns_ && time != 0) {
      const EnclosedRotation rotation = rotation_by(time * turn_);
      placed.core.turn(rotation.rows);
      // A row of three entries that are off by the error.
      placed.doubt = 3 * rotation.error * reach_;
    }
    placed.core.displace(time * displacement_);
    return placed;
  }
  const RationalVector& displacement() const { return displacement_; }
  bool turns() const { return turns_; }
  // The greatest speed along n at which turning moves a point.
  mpq_class turning_speed(const RationalVector& n) const {
    if (!turns_) return 0;
    const RationalVector across = cross(n, turn_);
    return root_above(dot(across, across), cast_root_bits) * reach_;
  }

 private:
  RationalCore start_;
  bool turns_;
  RationalVector displacement_, turn_;
  mpq_class reach_;
};

class CheckedPair {
 public:
  CheckedPair(const MovingBody& a, const MovingBody& b)
      : a_(a),
        b_(b),
        velocity_(b_.displacement() - a_.displacement()),
        radius_(oracle::rational(a.body.solid->radius) + oracle::rational(b.body.solid->radius)) {
    require(a.body.solid->radius >= 0 && b.body.solid->radius >= 0, "a radius is negative");
  }

  // Throws Fault unless the planes part the bodies at all times in [0, end), or in [0, 1] if it is a miss.
  void require_free(const std::vector<CastCertificate::Plane>& planes, const mpq_class& end,
                    bool is_miss) const {
    mpq_class begin = 0;
    for (const CastCertificate::Plane& plane : planes) {
      const mpq_class until = rational(plane.until);
      require(until > begin, "the planes are not in order of time");
      require_parted(rational_vector(plane.direction), begin, until,
                     is_miss && &plane == &planes.back());
      begin = until;
    }
    require(begin >= end, "the planes end too early");
  }

  void require_contact(const CastCertificate& certificate, const mpq_class& time) const {
    const Track::Placed a = a_.at(time), b = b_.at(time);
    const mpq_class doubt = a.doubt + b.doubt;
    if (a.core.is_halfspace() && b.core.is_halfspace()) {
      require(distance_of_halfspaces(a.core, b.core) <= SignedSquare{},
              "the half-spaces are apart");
      return;
    }
    const Difference difference(a.core.points(certificate.a), b.core.points(certificate.b));
    if (!certificate.surface.triangles.empty()) {
      require(!a.core.is_halfspace() && !b.core.is_halfspace(), "a half-space has no surface");
      // No point of the surface is off by more than the doubt, so that it still winds around 0, or comes
      // within the radii of it.
      require(surface_depth(certificate.surface, difference) < SignedSquare{0, -doubt * doubt} ||
                  doubt <= radius_,
              "the surface is too near to 0");
      return;
    }
    require(!certificate.closest.empty(), "nothing is there to prove contact");
    const mpq_class within = radius_ - doubt;
    require(within >= 0 && distance_of(certificate.closest, difference, a.core, b.core) <=
                               SignedSquare{0, within * within},
            "the points do not prove contact");
  }

  void require_exact(const CastCertificate& certificate, const mpq_class& lower,
                     const mpq_class& upper) const {
    require(!a_.turns() && !b_.turns(), "a body turns, and has no exact time");
    const RationalCore a = a_.at(0).core, b = b_.at(0).core;
    require(a.is_polytope() && b.is_polytope(), "only polytopes have an exact time");
    require_exact_time(certificate, {a.vertices(), b.vertices(), velocity_, radius_, lower, upper},
                       Difference(a.points(certificate.a), b.points(certificate.b)));
  }

 private:
  void require_parted(const RationalVector& n, const mpq_class& begin, const mpq_class& until,
                      bool is_last) const {
    require(!is_zero(n), "a plane has no direction");
    const Track::Placed a = a_.at(begin), b = b_.at(begin);
    const auto reach_a = a.core.support(n), reach_b = b.core.support(mpq_class(-1) * n);
    require(reach_a && reach_b, "a half-space is not parted by the plane");
    const mpq_class gap = -*reach_a - *reach_b;
    const mpq_class reach = radius_ + a.doubt + b.doubt;
    const mpq_class closing = a_.turning_speed(n) + b_.turning_speed(n) - dot(n, velocity_);
    const mpq_class at_end = gap - (until - begin) * closing;
    require(exceeds(gap, n, reach) > 0, "a plane does not part the bodies where it begins");
    const int left = exceeds(at_end, n, reach);
    require(is_last ? left > 0 : left >= 0, "a plane does not part the bodies until it ends");
  }

  // The sign of gap / |n| - reach.
  static int exceeds(const mpq_class& gap, const RationalVector& n, const mpq_class& reach) {
    if (gap < 0) return -1;
    return cmp(mpq_class(gap * gap), mpq_class(reach * reach * dot(n, n)));
  }

  Track a_, b_;
  RationalVector velocity_;
  mpq_class radius_;
};

}  // namespace

std::string fault(const CastCertificate& certificate, const MovingBody& a, const MovingBody& b) {
  try {
    const CheckedPair pair(a, b);
    const bool is_miss = certificate.answer == CastAnswer::miss;
    const mpq_class lower = is_miss ? mpq_class(1) : rational(certificate.lower);
    require(lower >= 0 && lower <= 1, "the lower bound is no time of the motion");
    pair.require_free(certificate.planes, lower, is_miss);
    if (certificate.answer != CastAnswer::hit) {
      require(certificate.feature.empty(), "there is an exact time without a hit");
      if (is_miss) require(!certificate.planes.empty(), "nothing is there to prove the miss");
      return {};
    }
    const mpq_class upper = rational(certificate.upper);
    require(upper >= lower && upper <= 1,
            "the upper bound is no time of the motion behind the lower one");
    pair.require_contact(certificate, upper);
    if (!certificate.feature.empty()) pair.require_exact(certificate, lower, upper);
  } catch (const Fault& found) {
    return found.what();
  }
  return {};
}

}  // namespace touchstone::oracle
