// Bodies of many parts, and the check of their certificates, for tests.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "algorithms/oracle/certificates/parts/parts_certificate_check.h"
#include "algorithms/oracle/concave/exact_parts_proofs.h"
#include "tests/algorithms/concave/meshes.h"
#include "tests/algorithms/one_in.h"
#include "tests/algorithms/random.h"

namespace touchstone::reference {

using oracle::PartsCertificate;
using PartsClaim = PartsCertificate::Claim;

inline constexpr std::array all_claims = {PartsClaim::intersect, PartsClaim::distance,
                                          PartsClaim::contacts};

inline ConcaveTask task_of(PartsClaim claim) {
  if (claim == PartsClaim::intersect) return ConcaveTask::intersect;
  return claim == PartsClaim::distance ? ConcaveTask::distance : ConcaveTask::contacts;
}

struct ProvenPair {
  ConcaveBody a, b;
  Pose pose_a, pose_b;

  PartsCertificate prove(PartsClaim claim) const {
    return oracle::prove_parts(claim, a, pose_a, b, pose_b);
  }
  std::string fault(const PartsCertificate& certificate) const {
    return oracle::fault(certificate, {a, pose_a}, {b, pose_b});
  }
  Answered solve(PartsClaim claim) const {
    return ask("exact", task_of(claim), {a, b}, pose_a, pose_b);
  }
};

// The pairs of parts that a certificate of contacts names, in their order.
inline std::vector<IndexPair> met_pairs(const PartsCertificate& certificate) {
  std::vector<IndexPair> pairs;
  for (const auto& met : certificate.met) pairs.push_back(met.parts);
  std::ranges::sort(pairs);
  return pairs;
}

// A shape of each kind, about 1 in size.
inline std::vector<Shape> shapes_of_all_kinds() {
  return {make_sphere(0.5),
          make_capsule(0.25, 0.5),
          make_box(0.5, 0.25, 0.75),
          make_cylinder(0.5, 0.5),
          make_cone(0.5, 0.5),
          make_ellipsoid(0.75, 0.5, 0.25),
          hull_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}),
          make_halfspace({0.5, 0.25, 2}, -0.5)};
}

// A compound of some shapes, each in a place of its own; with `meshes`, a solid box among them.
inline ConcaveBody compound(Random& random, int parts, bool with_halfspace, bool with_mesh) {
  const std::vector<Shape> shapes = shapes_of_all_kinds();
  ConcaveBody body;
  for (int i = 0; i < parts; ++i) {
    Pose pose;
    if (random.below(3) > 0) pose.rotation = random.rotation();
    if (random.below(4) == 0) pose.rotation.col(1) *= 1.5;
    pose.translation = random.vector(1.5);
    body.parts.push_back({shapes[static_cast<std::size_t>(random.below(7))], pose, 0});
  }
  if (with_mesh) {
    reference::add_surface(body, box_mesh(1, 1.5, 0.5, true),
                           {random.rotation(), random.vector(1)});
  }
  if (with_halfspace) {
    Pose pose{random.rotation(), random.vector(0.5)};
    pose.rotation.col(0) *= 2;
    body.parts.push_back({shapes[7], pose, 0});
  }
  return body;
}

}  // namespace touchstone::reference
