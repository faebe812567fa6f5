// Certificates of bodies of many parts are refused if anything in them is changed.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "tests/algorithms/certificates/bodies.h"

namespace touchstone {
namespace {

using reference::body_of;
using reference::moved_by;
using reference::PartsCertificate;
using reference::PartsClaim;
using reference::ProvenPair;
using Kind = PartsCertificate::Step::Kind;

// Counts the changes, and expects that each is refused.
class Forger {
 public:
  explicit Forger(const ProvenPair& pair, PartsClaim claim)
      : pair_(pair), proof_(pair.prove(claim)) {
    EXPECT_EQ(pair.fault(proof_), "");
  }
  const PartsCertificate& proof() const { return proof_; }

  void refused(const std::string& what, const std::function<void(PartsCertificate&)>& change) {
    PartsCertificate changed = proof_;
    change(changed);
    EXPECT_NE(pair_.fault(changed), "") << what;
    ++changes_;
  }
  int changes() const { return changes_; }

  void change_orders() {
    for (const auto order : {&PartsCertificate::order_a, &PartsCertificate::order_b}) {
      if ((proof_.*order).empty()) continue;
      refused("a part is missing", [&](auto& c) { (c.*order).pop_back(); });
      refused("a part is there twice", [&](auto& c) { (c.*order).push_back(0); });
      refused("a part is none",
              [&](auto& c) { (c.*order)[0] = static_cast<std::uint32_t>((c.*order).size()); });
      refused("no order", [&](auto& c) { (c.*order).clear(); });
      if ((proof_.*order).size() < 2) continue;
      refused("a part is there for another", [&](auto& c) { (c.*order)[0] = (c.*order)[1]; });
    }
  }
  void change_cover() {
    refused("more open pairs", [](auto& c) { ++c.undecided; });
    refused("a cover too long", [](auto& c) { c.cover.push_back({Kind::open, {}}); });
    for (std::size_t i = 0; i < proof_.cover.size(); ++i) {
      const std::string at = " at " + std::to_string(i);
      refused("a step is missing" + at,
              [&](auto& c) { c.cover.erase(c.cover.begin() + static_cast<std::ptrdiff_t>(i)); });
      for (const Kind kind : {Kind::own_plane, Kind::meet, Kind::open}) {
        if (kind == proof_.cover[i].kind) continue;
        refused("another step" + at, [&](auto& c) { c.cover[i].kind = kind; });
      }
      refused("no step" + at, [&](auto& c) { c.cover[i].kind = static_cast<Kind>(77); });
      if (proof_.cover[i].kind != Kind::plane) continue;
      refused("no direction" + at, [&](auto& c) { c.cover[i].direction = {}; });
      refused("the other way" + at, [&](auto& c) {
        for (auto& x : c.cover[i].direction) x = -x;
      });
    }
  }
  void change_answer() {
    for (const Answer answer :
         {Answer::separated, Answer::touching, Answer::overlapping, Answer::unknown}) {
      if (answer != proof_.answer) {
        refused("another answer", [&](auto& c) { c.answer = answer; });
      }
    }
  }
  void change_met() {
    for (std::size_t i = 0; i < proof_.met.size(); ++i) {
      const std::string at = " of " + std::to_string(i);
      refused("no part" + at, [&](auto& c) { c.met[i].parts.a = 1000000; });
      refused("no part" + at, [&](auto& c) { c.met[i].parts.b = 1000000; });
      refused("no points" + at, [&](auto& c) {
        c.met[i].closest.clear();
        c.met[i].surface = {};
      });
      refused("missing" + at,
              [&](auto& c) { c.met.erase(c.met.begin() + static_cast<std::ptrdiff_t>(i)); });
      refused("twice" + at, [&](auto& c) { c.met.push_back(c.met[i]); });
      for (std::size_t k = 0; k < proof_.met[i].closest.size(); ++k) {
        refused("a weight" + at, [&](auto& c) { c.met[i].closest[k].weight = 0; });
        refused("a generator" + at, [&](auto& c) { c.met[i].closest[k].point.a = 99; });
      }
      if (!proof_.met[i].surface.triangles.empty()) {
        refused("an open surface" + at, [&](auto& c) { c.met[i].surface.triangles.pop_back(); });
        refused("a turned triangle" + at, [&](auto& c) {
          std::swap(c.met[i].surface.triangles[0][0], c.met[i].surface.triangles[0][1]);
        });
      }
    }
  }
  void change_all() {
    change_answer();
    change_met();
    if (!proof_.cover.empty() || proof_.answer != Answer::overlapping) {
      change_orders();
      change_cover();
    } else {
      refused("a cover without need", [](auto& c) { c.cover.push_back({Kind::open, {}}); });
      refused("an order without need", [](auto& c) { c.order_a.push_back(0); });
      refused("an open pair without need", [](auto& c) { c.undecided = 1; });
    }
    if (!proof_.inside) {
      refused("an inside", [](auto& c) { c.inside.emplace(PartsCertificate::Inside{}); });
    } else {
      refused("no inside", [](auto& c) { c.inside.reset(); });
      refused("no part", [](auto& c) { c.inside->part = 1000000; });
      refused("no surface", [](auto& c) { c.inside->surface = 1; });
      refused("the other", [](auto& c) { c.inside->a_is_inside = !c.inside->a_is_inside; });
    }
    if (!proof_.bounds) {
      refused("bounds", [](auto& c) { c.bounds = {0, 1}; });
      return;
    }
    constexpr double huge = std::numeric_limits<double>::infinity();
    const auto [lower, upper] = *proof_.bounds;
    refused("no bounds", [](auto& c) { c.bounds.reset(); });
    for (const double x : {std::nextafter(upper, huge), huge, std::nan(""), -lower}) {
      refused("the lower bound", [&](auto& c) { c.bounds->lower = x; });
    }
    for (const double x : {std::nextafter(lower, 0.0), huge, std::nan(""), -upper}) {
      refused("the upper bound", [&](auto& c) { c.bounds->upper = x; });
    }
    refused("a higher distance", [&](auto& c) {
      c.bounds->lower = std::nextafter(upper, huge);
      c.bounds->upper = 2 * upper;
    });
  }

 private:
  ProvenPair pair_;
  PartsCertificate proof_;
  int changes_ = 0;
};

std::vector<ProvenPair> honest_pairs() {
  reference::Random random(3);
  std::vector<ProvenPair> pairs;
  // Meshes that are apart, that cross, that touch at a corner, and one in the other.
  const ConcaveBody box = body_of(families::box_mesh(1, 1, 1, true));
  const ConcaveBody small = body_of(families::box_mesh(0.25, 0.25, 0.25));
  pairs.push_back({box, small, {random.rotation(), Vec3d::Zero()}, moved_by({2, 1, 0.5})});
  pairs.push_back({box, small, {random.rotation(), Vec3d::Zero()}, moved_by({1, 0.5, 0.25})});
  pairs.push_back({box, small, {}, moved_by({1.25, 1.25, -1.25})});
  pairs.push_back({box, small, {}, moved_by({0.25, 0.25, -0.25})});
  pairs.push_back({small, box, {}, {}});
  // Compounds: with a half-space apart and not, with curved parts, and with balls that touch.
  for (int i = 0; i < 6; ++i) {
    pairs.push_back({reference::compound(random, 3, i % 2 == 0, i % 3 == 0),
                     reference::compound(random, 2, false, false),
                     {random.rotation(), Vec3d::Zero()},
                     {random.rotation(), random.vector(i < 3 ? 5 : 2)}});
  }
  pairs.push_back({body_of(reference::make_sphere(1)),
                   body_of(reference::make_sphere(2)),
                   {},
                   moved_by({0, 3, 0})});
  return pairs;
}

TEST(ForgedPartsCertificates, EveryChangeIsRefused) {
  int changes = 0, next = 0;
  std::array<int, 4> answers{};
  for (const ProvenPair& pair : honest_pairs()) {
    for (const PartsClaim claim : reference::all_claims) {
      if (next++ % std::min(one_in, 8) != 0) continue;
      Forger forger(pair, claim);
      ++answers[static_cast<std::size_t>(forger.proof().answer)];
      forger.change_all();
      changes += forger.changes();
    }
  }
  EXPECT_GT(changes, 1000 / one_in);
  EXPECT_GT(answers[static_cast<std::size_t>(Answer::separated)], 6 / one_in);
  EXPECT_GT(answers[static_cast<std::size_t>(Answer::overlapping)], 12 / one_in);
}

// A certificate of one place proves nothing of another.
TEST(ForgedPartsCertificates, ProveNothingOfOtherPlaces) {
  reference::Random random(5);
  const ConcaveBody box = body_of(families::box_mesh(1, 1, 1, true));
  const ConcaveBody ball = body_of(reference::make_sphere(0.5));
  const ProvenPair apart{box, ball, {random.rotation(), Vec3d::Zero()}, moved_by({3, 0, 0})};
  for (const PartsClaim claim : reference::all_claims) {
    const PartsCertificate proof = apart.prove(claim);
    for (const double x : {1.0, 0.25, 0.0, -1.5}) {
      ProvenPair moved = apart;
      moved.pose_b.translation[0] = x;
      EXPECT_NE(moved.fault(proof), "");
    }
    ProvenPair opened = apart;
    TriangleMesh mesh = *box.mesh;
    mesh.triangles.pop_back();
    opened.a = body_of(mesh);
    EXPECT_NE(opened.fault(proof), "") << "another number of parts";
    mesh = *box.mesh;
    std::swap(mesh.triangles[3][0], mesh.triangles[3][1]);
    opened.a = body_of(mesh);
    EXPECT_EQ(opened.fault(proof), "the surface is open");
    mesh.vertices[0][1] = std::nan("");
    opened.a = body_of(mesh);
    EXPECT_NE(opened.fault(proof), "");
    mesh.triangles[3][0] = 99;
    opened.a = body_of(mesh);
    EXPECT_NE(opened.fault(proof), "");
  }
}

// What is inside shares no point with any part, so that planes alone would not do.
TEST(ForgedPartsCertificates, PlanesAloneDoNotPartSolids) {
  const ConcaveBody solid = body_of(families::box_mesh(2, 2, 2, true));
  const ConcaveBody hollow = body_of(families::box_mesh(2, 2, 2));
  const ConcaveBody ball = body_of(reference::make_sphere(0.5));
  for (const PartsClaim claim : reference::all_claims) {
    const PartsCertificate parted = ProvenPair{hollow, ball, {}, {}}.prove(claim);
    EXPECT_EQ(parted.answer, Answer::separated);
    EXPECT_EQ((ProvenPair{hollow, ball, {}, {}}.fault(parted)), "");
    EXPECT_EQ((ProvenPair{solid, ball, {}, {}}.fault(parted)), "a surface winds around a part");
    PartsCertificate within = ProvenPair{solid, ball, {}, {}}.prove(claim);
    ASSERT_TRUE(within.inside);
    EXPECT_EQ((ProvenPair{hollow, ball, {}, {}}.fault(within)),
              "what it is inside of is not solid");
  }
}

}  // namespace
}  // namespace touchstone
