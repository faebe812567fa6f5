// Proofs of every kind are changed at random, as text. One that is verified is still true: its claim is held against
// the exact answer to the question that the changed proof is of. The verifier in Python verifies the same.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <iostream>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "algorithms/oracle/cast/prove_cast.h"
#include "algorithms/oracle/certificates/cast_certificate_check.h"
#include "algorithms/oracle/certificates/certificate_check.h"
#include "algorithms/oracle/certificates/parts/mesh_certificate_check.h"
#include "algorithms/oracle/certificates/parts/scene_ray_check.h"
#include "algorithms/oracle/concave/exact_parts_proofs.h"
#include "algorithms/oracle/oracle.h"
#include "algorithms/oracle/rays/exact_mesh_proofs.h"
#include "algorithms/oracle/rays/exact_scene_ray_proofs.h"
#include "harness/base/error.h"
#include "harness/families/meshes.h"
#include "harness/files/certificates.h"
#include "harness/files/parts_certificates.h"
#include "harness/files/ray_certificates.h"
#include "tests/algorithms/one_in.h"
#include "tests/algorithms/random.h"
#include "tests/algorithms/shapes.h"
#include "tests/harness/run_shell.h"
#include "tests/harness/temporary_folder.h"
#include "tests/project_folder.h"

namespace touchstone {
namespace {

using files::Json;
using reference::Random;

// What became of a file: of its certificates, which were verified and claim something.
struct Judged {
  int verified = 0, refused = 0, malformed = 0;
};
using Judge = std::function<void(const std::filesystem::path&, Judged&)>;

struct ProofKind {
  std::string name;
  std::vector<std::vector<Json>> proofs;  // each the lines of a file, the certificate last
  Judge judge;
};

bool meets(double low, double high, double other_low, double other_high) {
  const double slack = 1e-9 * std::max({1.0, std::abs(low), std::abs(high)});
  return low <= other_high + slack && other_low <= high + slack;
}

double value_of(const oracle::TimeFraction& t) {
  return mpq_class(oracle::rational(t.numerator) / oracle::rational(t.denominator)).get_d();
}

bool is_singular_halfspace(const Shape& shape, const Mat3d& rotation) {
  return shape.kind == ShapeKind::halfspace &&
         oracle::RationalCore({oracle::Solid(shape), Pose{rotation, Vec3d::Zero()}}, 64)
             .is_singular_halfspace();
}

// --- pairs ---

void judge_pairs(const std::filesystem::path& file, Judged& judged) {
  files::read_certificates(file, [&](const files::StoredCertificate& stored, std::int64_t) {
    const oracle::Solid a(stored.shape_a), b(stored.shape_b);
    const auto body = [](const oracle::Solid& solid, const Pose& pose, const auto& quaternion) {
      return quaternion ? oracle::Body(solid, *quaternion, pose.translation)
                        : oracle::Body(solid, pose);
    };
    const oracle::Body at_a = body(a, stored.pose_a, stored.quaternion_a),
                       at_b = body(b, stored.pose_b, stored.quaternion_b);
    if (!oracle::fault(stored.certificate, at_a, at_b).empty()) {
      ++judged.refused;
      return;
    }
    ++judged.verified;
    if (stored.certificate.answer == Answer::unknown) return;
    if (!stored.quaternion_a) {
      EXPECT_FALSE(is_singular_halfspace(stored.shape_a, stored.pose_a.rotation));
    }
    if (!stored.quaternion_b) {
      EXPECT_FALSE(is_singular_halfspace(stored.shape_b, stored.pose_b.rotation));
    }
    const oracle::Measure truth = oracle::Oracle().measure(at_a, at_b);
    if (truth.answer == Answer::unknown) return;
    EXPECT_EQ(stored.certificate.answer, truth.answer) << to_json(stored);
  });
}

// --- casts ---

void judge_casts(const std::filesystem::path& file, Judged& judged) {
  files::read_cast_certificates(
      file, [&](const files::StoredCastCertificate& stored, std::int64_t) {
        const files::CastCase& of = stored.of;
        const oracle::CastCertificate& proof = stored.certificate;
        const oracle::Solid a(of.shape_a), b(of.shape_b);
        if (!oracle::fault(proof, {{a, of.pose_a}, of.motion_a}, {{b, of.pose_b}, of.motion_b})
                 .empty()) {
          ++judged.refused;
          return;
        }
        ++judged.verified;
        if (proof.answer == CastAnswer::unknown) return;
        EXPECT_FALSE(is_singular_halfspace(of.shape_a, of.pose_a.rotation)) << to_json(stored);
        EXPECT_FALSE(is_singular_halfspace(of.shape_b, of.pose_b.rotation)) << to_json(stored);
        for (const auto& [shape, motion] :
             {std::pair(&of.shape_a, &of.motion_a), std::pair(&of.shape_b, &of.motion_b)}) {
          EXPECT_FALSE(shape->kind == ShapeKind::halfspace && motion->turns()) << to_json(stored);
        }
        // The solver wants a half-space as the second body.
        const bool swap = of.shape_a.kind == ShapeKind::halfspace;
        if (swap && of.shape_b.kind == ShapeKind::halfspace) return;
        oracle::EnclosedBody first = enclosed(of.shape_a, a, of.pose_a, of.motion_a),
                             second = enclosed(of.shape_b, b, of.pose_b, of.motion_b);
        if (swap) std::swap(first, second);
        oracle::CastCertificate truth;
        oracle::Oracle solver;
        oracle::prove_cast(solver, first, second, oracle::default_tolerance(first, second), truth);
        if (truth.answer == CastAnswer::unknown) return;
        EXPECT_EQ(proof.answer, truth.answer) << to_json(stored);
        if (proof.answer != CastAnswer::hit || truth.answer != CastAnswer::hit) return;
        EXPECT_TRUE(meets(value_of(proof.lower), value_of(proof.upper), value_of(truth.lower),
                          value_of(truth.upper)))
            << to_json(stored);
      });
}

// --- bodies of parts ---

void judge_parts(const std::filesystem::path& file, Judged& judged) {
  files::read_parts_certificates(
      file, [&](const files::StoredPartsCertificate& stored, std::int64_t) {
        const files::ConcaveCase& of = stored.of;
        const oracle::PartsCertificate& proof = stored.certificate;
        if (!oracle::fault(proof, {of.a, of.pose_a}, {of.b, of.pose_b}).empty()) {
          ++judged.refused;
          return;
        }
        ++judged.verified;
        if (proof.answer == Answer::unknown) return;
        const oracle::PartsCertificate truth =
            oracle::prove_parts(proof.claim, of.a, of.pose_a, of.b, of.pose_b);
        if (truth.answer == Answer::unknown) return;
        EXPECT_EQ(proof.answer, truth.answer) << to_json(stored);
        if (!proof.bounds || !truth.bounds) return;
        EXPECT_TRUE(meets(proof.bounds->lower, proof.bounds->upper, truth.bounds->lower,
                          truth.bounds->upper))
            << to_json(stored);
      });
}

// --- rays and points ---

void judge_rays(const std::filesystem::path& file, Judged& judged) {
  std::optional<TriangleMesh> mesh;
  std::vector<files::PlacedConcave> bodies;
  const auto count = [&](const std::string& why) {
    ++(why.empty() ? judged.verified : judged.refused);
    return why.empty();
  };
  const auto take_ray = [&](const files::StoredRayCertificate& stored, std::int64_t) {
    const oracle::RayCertificate& proof = stored.certificate;
    if (!count(oracle::CheckedMesh(*mesh).fault(proof))) return;
    const auto truth = oracle::MeshProver(*mesh).prove_ray(proof.origin, proof.direction,
                                                           proof.t_max, proof.is_first);
    ASSERT_TRUE(truth) << to_json(stored);
    EXPECT_EQ(proof.hit, truth->hit) << to_json(stored);
    if (!proof.hit || !proof.is_first) return;
    EXPECT_EQ(proof.triangle, truth->triangle) << to_json(stored);
    EXPECT_EQ(value_of(proof.t), value_of(truth->t)) << to_json(stored);
  };
  const auto take_scene_ray = [&](const files::StoredSceneRayCertificate& stored, std::int64_t) {
    const oracle::SceneRayCertificate& proof = stored.certificate;
    std::vector<oracle::PlacedBody> placed;
    for (const auto& [body, pose] : bodies) placed.push_back({body, pose});
    if (!count(oracle::CheckedScene(placed).fault(proof))) return;
    if (proof.answer == CastAnswer::unknown) return;
    const auto truth = oracle::SceneRayProver(placed).prove(proof.origin, proof.direction,
                                                            proof.t_max, proof.is_first);
    ASSERT_TRUE(truth) << to_json(stored);
    if (truth->answer == CastAnswer::unknown) return;
    EXPECT_EQ(proof.answer, truth->answer) << to_json(stored);
    if (proof.answer != CastAnswer::hit || truth->answer != CastAnswer::hit || !proof.is_first) {
      return;
    }
    EXPECT_TRUE(meets(value_of(proof.lower), value_of(proof.upper), value_of(truth->lower),
                      value_of(truth->upper)))
        << to_json(stored);
    const bool is_same = proof.body == truth->body && proof.part == truth->part;
    if (is_same || !proof.is_ordered || !truth->is_ordered) return;
    // Two parts may be hit at one time.
    EXPECT_LE(value_of(proof.upper), value_of(truth->upper) * (1 + 1e-9)) << to_json(stored);
  };
  const auto take_mesh = [&](const TriangleMesh& read) { mesh = read; };
  const auto take_scene = [&](std::vector<files::PlacedConcave> read) { bodies = std::move(read); };
  files::read_ray_certificates(file, {take_mesh, take_ray, take_scene, take_scene_ray});
}

void judge_points(const std::filesystem::path& file, Judged& judged) {
  using PointClaim = oracle::PointCertificate::Claim;
  std::optional<TriangleMesh> mesh;
  files::read_point_certificates(
      file, [&](const TriangleMesh& read) { mesh = read; },
      [&](const files::StoredPointCertificate& stored, std::int64_t) {
        const oracle::PointCertificate& proof = stored.certificate;
        if (!oracle::CheckedMesh(*mesh).fault(proof).empty()) {
          ++judged.refused;
          return;
        }
        ++judged.verified;
        oracle::MeshProver prover(*mesh);
        const auto truth = proof.claim == PointClaim::nearest ? prover.prove_nearest(proof.point)
                                                              : prover.prove_side(proof.point);
        ASSERT_TRUE(truth) << to_json(stored);
        EXPECT_EQ(proof.claim, truth->claim) << to_json(stored);
        EXPECT_EQ(value_of(proof.square), value_of(truth->square)) << to_json(stored);
        EXPECT_EQ(proof.winding, truth->winding) << to_json(stored);
      });
}

// --- what is changed ---

std::vector<Shape> shapes() {
  using namespace reference;
  return {make_sphere(0.5),
          make_capsule(0.25, 0.5),
          make_box(0.5, 0.25, 0.75),
          make_cylinder(0.5, 0.5),
          make_cone(0.5, 0.5),
          make_ellipsoid(0.75, 0.5, 0.25),
          make_halfspace({0.5, 0.25, 2}, -0.5)};
}

Pose random_place(Random& random, double size) { return {random.rotation(), random.vector(size)}; }

ConcaveBody random_body(Random& random) {
  ConcaveBody body;
  if (random.below(2) == 0) {
    const bool solid = random.below(2) == 0;
    body.mesh = std::make_shared<const TriangleMesh>(families::box_mesh(0.5, 0.75, 0.5, solid));
    return body;
  }
  const auto all = shapes();
  for (int i = 0; i < 2; ++i) {
    body.parts.push_back(
        {all[static_cast<std::size_t>(random.below(6))], random_place(random, 0.75)});
  }
  return body;
}

std::vector<ProofKind> kinds_of_proofs() {
  Random random(21);
  ProofKind pairs{"pairs", {}, judge_pairs}, casts{"casts", {}, judge_casts},
      parts{"parts", {}, judge_parts}, rays{"rays", {}, judge_rays},
      scenes{"scenes", {}, judge_rays}, points{"points", {}, judge_points};
  const auto all = shapes();
  oracle::Oracle solver;
  const auto any = [&](int most) { return all[static_cast<std::size_t>(random.below(most))]; };
  // Pairs of hulls and of flat, thin and small bodies, with quaternions, and of two half-spaces.
  Random draws(23);
  const std::vector<Shape> odd = {
      reference::make_hull(
          std::vector<Vec3d>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}}),
      reference::make_hull(std::vector<Vec3d>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}),
      reference::make_sphere(0),
      reference::make_cylinder(0, 0.5),
      reference::make_cylinder(0.5, 0),
      reference::make_cone(0, 0),
      reference::make_ellipsoid(0.5, 0.25, 0),
      reference::make_ellipsoid(0, 0.5, 0)};
  for (int i = 0; i < 24; ++i) {
    const auto of_odd = [&] { return odd[static_cast<std::size_t>(draws.below(8))]; };
    files::StoredCertificate stored{
        "o",
        "as-given",
        of_odd(),
        draws.below(2) == 0 ? of_odd() : all[static_cast<std::size_t>(draws.below(7))],
        random_place(draws, 1),
        random_place(draws, 0.5),
        {},
        {},
        {}};
    if (i % 3 == 0) stored.shape_a = reference::make_halfspace({0.5, 0.25, 2}, -0.5);
    if (i % 6 == 0) {
      stored.shape_b = reference::make_halfspace({-0.5, -0.25, -2}, 0.25);
      stored.pose_b = stored.pose_a;
    }
    const oracle::Solid a(stored.shape_a), b(stored.shape_b);
    oracle::Body at_a(a, stored.pose_a), at_b(b, stored.pose_b);
    if (i % 2 == 1) {
      stored.quaternion_a = {draws.uniform(-1, 1), 0.5, draws.uniform(-1, 1), 0.25};
      at_a = oracle::Body(a, *stored.quaternion_a, stored.pose_a.translation);
    }
    solver.prove(at_a, at_b, stored.certificate);
    pairs.proofs.push_back({Json::parse(to_json(stored))});
  }
  for (int i = 0; i < 24; ++i) {
    files::StoredCertificate stored{
        "p", "as-given", any(6), any(7), random_place(random, 1), random_place(random, 1),
        {},  {},         {}};
    const oracle::Solid a(stored.shape_a), b(stored.shape_b);
    solver.prove({a, stored.pose_a}, {b, stored.pose_b}, stored.certificate);
    pairs.proofs.push_back({Json::parse(to_json(stored))});

    files::StoredCastCertificate cast;
    files::CastCase& of = cast.of;
    of.id = "c";
    of.shape_a = any(6);
    of.shape_b = any(7);
    of.pose_a = random_place(random, 0.5);
    of.pose_b = random_place(random, 3);
    of.motion_a.displacement = random.vector(1);
    of.motion_b.displacement = -of.pose_b.translation + random.vector(2);
    if (i % 3 == 0) of.motion_a.rotation_vector = random.vector(1);
    const oracle::Solid solid_a(of.shape_a), solid_b(of.shape_b);
    const auto first = enclosed(of.shape_a, solid_a, of.pose_a, of.motion_a),
               second = enclosed(of.shape_b, solid_b, of.pose_b, of.motion_b);
    oracle::prove_cast(solver, first, second, 1e-6, cast.certificate);
    casts.proofs.push_back({Json::parse(to_json(cast))});

    files::StoredPartsCertificate of_parts;
    files::ConcaveCase& pair = of_parts.of;
    pair.id = "m";
    pair.a = random_body(random);
    pair.b = random_body(random);
    pair.pose_b = random_place(random, 1.5);
    of_parts.certificate = oracle::prove_parts(static_cast<oracle::PartsCertificate::Claim>(i % 3),
                                               pair.a, pair.pose_a, pair.b, pair.pose_b);
    parts.proofs.push_back({Json::parse(to_json(of_parts))});

    const TriangleMesh mesh =
        i % 2 == 0 ? families::torus(5, 4, 1, 0.5, true) : families::box_mesh(0.5, 1, 0.75, true);
    const Json head = Json::parse(files::mesh_line(mesh));
    oracle::MeshProver prover(mesh);
    const Vec3d origin = 3 * random.direction();
    const double end = i % 5 == 0 ? 0.5 : HUGE_VAL;
    const auto ray = prover.prove_ray(origin, random.vector(1) - origin, end, i % 4 > 0);
    rays.proofs.push_back({head, Json::parse(to_json(files::StoredRayCertificate{0, *ray}))});
    const auto point =
        i % 3 == 0 ? prover.prove_nearest(random.vector(1)) : prover.prove_side(random.vector(1));
    points.proofs.push_back({head, Json::parse(to_json(files::StoredPointCertificate{0, *point}))});

    std::vector<files::PlacedConcave> bodies;
    for (int k = 0; k < 3; ++k) {
      bodies.push_back({random_body(random), random_place(random, 1.5)});
    }
    std::vector<oracle::PlacedBody> placed;
    for (const auto& [body, pose] : bodies) placed.push_back({body, pose});
    const auto take_scene_ray = oracle::SceneRayProver(placed).prove(
        2 * origin, random.vector(1) - 2 * origin, end, i % 4 > 0);
    scenes.proofs.push_back(
        {Json::parse(files::scene_line(bodies)),
         Json::parse(to_json(files::StoredSceneRayCertificate{0, *take_scene_ray}))});
  }
  return {pairs, casts, parts, rays, scenes, points};
}

// --- changes ---

using Place = Json::json_pointer;

// The places of all values below one, some of each long array.
void add_places(const Json& value, const Place& here, Random& random, std::vector<Place>& all) {
  all.push_back(here);
  if (value.is_object()) {
    for (const auto& [key, inner] : value.items()) add_places(inner, here / key, random, all);
  } else if (value.is_array()) {
    for (std::size_t i = 0; i < value.size(); ++i) {
      if (i < 4 || random.below(8) == 0) add_places(value[i], here / i, random, all);
    }
  }
}

void change_number(Json& value, Random& random) {
  if (value.is_number_integer()) {
    const auto number = value.get<std::int64_t>();
    const std::int64_t others[] = {0, 1, number + 1, number > 0 ? number - 1 : 0, 1'000'000};
    value = others[static_cast<std::size_t>(random.below(5))];
    return;
  }
  const double number = value.get<double>();
  const double others[] = {0.0,           -number, 2 * number, number + 0.25, number * 1.001,
                           number - 1e-9, 1e-300,  1e100};
  value = others[static_cast<std::size_t>(random.below(8))];
}

void change_text(Json& value, const std::string& other, Random& random) {
  const std::string text = value.get<std::string>();
  const bool is_number = text.find_first_not_of("-0123456789") == std::string::npos;
  if (!is_number) {
    value = other;
    return;
  }
  const std::string positive = text.starts_with('-') ? text.substr(1) : text;
  const std::string others[] = {"0",        "1",
                                "-1",       text.starts_with('-') ? positive : "-" + text,
                                text + "0", positive.substr(0, (positive.size() + 1) / 2),
                                other};
  value = others[static_cast<std::size_t>(random.below(7))];
}

// Changes one thing. `other` is another proof of the kind.
void change(Json& proof, const Json& other, Random& random) {
  static const std::vector<std::string> words = {
      "hit",      "miss", "unknown", "separated", "touching",  "overlapping",
      "closest",  "any",  "inside",  "outside",   "surface",   "nearest",
      "halve",    "body", "own",     "triangle",  "intersect", "distance",
      "contacts", "open", "meet",    "a",         "b",         "inf"};
  std::vector<Place> places;
  add_places(proof, Place(), random, places);
  const Place at = places[static_cast<std::size_t>(random.below(static_cast<int>(places.size())))];
  Json& value = proof[at];
  if (random.below(6) == 0 && other.contains(at)) {
    value = other[at];
    return;
  }
  const auto within = [&] {
    return static_cast<std::size_t>(random.below(static_cast<int>(value.size())));
  };
  if (value.is_boolean()) {
    value = !value.get<bool>();
  } else if (value.is_number()) {
    change_number(value, random);
  } else if (value.is_string()) {
    change_text(value, words[static_cast<std::size_t>(random.below(24))], random);
  } else if (value.is_array() && !value.empty()) {
    const std::size_t i = within(), k = within();
    switch (random.below(5)) {
      case 0: value.erase(i); break;
      case 1: value.push_back(Json(value[i])); break;
      case 2: value = Json::array(); break;
      case 3:
        // A matrix with a row of zeros, or a vector of zeros.
        for (std::size_t n = value.size() >= 9 ? 6 : 0; n < value.size(); ++n) {
          if (value[n].is_number_float()) value[n] = 0.0;
        }
        break;
      default: std::swap(value[i], value[k]); break;
    }
  }
}

void write_lines(const TemporaryFolder& folder, const std::vector<Json>& lines) {
  std::string text;
  for (const Json& line : lines) text += line.dump() + "\n";
  folder.write("proof.jsonl", text);
}

// Expects the verifier in Python to prove the same certificates of pairs, and no others.
void expect_the_same_of_python(const TemporaryFolder& folder, const std::vector<Json>& proofs,
                               const std::vector<bool>& verified) {
  if (run_shell("python3 --version").status != 0) {
    std::cout << "python3 is not there: its verifier was not run\n";
    return;
  }
  std::string text;
  for (const Json& proof : proofs) text += proof.dump() + "\n";
  const auto file = folder.write("all.jsonl", text);
  const std::string verifier = std::string(project_folder) + "/datasets/certificates/verify.py";
  const Ran ran = run_shell("python3 '" + verifier + "' '" + file.string() + "'");
  std::vector<bool> proven(proofs.size(), true);
  std::istringstream lines(ran.text);
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with(file.string() + ":")) continue;
    const auto number = static_cast<std::size_t>(std::stoi(line.substr(file.string().size() + 1)));
    ASSERT_TRUE(number >= 1 && number <= proven.size()) << line;
    proven[number - 1] = false;
  }
  for (std::size_t i = 0; i < proofs.size(); ++i) {
    ASSERT_EQ(proven[i], verified[i]) << proofs[i].dump();
  }
  const auto count = std::ranges::count(verified, true);
  EXPECT_NE(ran.text.find(std::to_string(count) + " proven"), std::string::npos) << ran.text;
}

// What it does not know could change what a body is.
TEST(PythonVerifier, RefusesWhatIsNotInTheFormat) {
  if (run_shell("python3 --version").status != 0) GTEST_SKIP() << "python3 is not there";
  const TemporaryFolder folder;
  const Json proof = kinds_of_proofs()[0].proofs[30][0];
  const auto verify = [&](const std::string& text) {
    const auto file = folder.write("proof.jsonl", text);
    return run_shell("python3 '" + std::string(project_folder) +
                     "/datasets/certificates/verify.py' '" + file.string() + "'");
  };
  const auto changed = [&](const std::function<void(Json&)>& change) {
    Json other = proof;
    change(other);
    return verify(other.dump() + "\n").status;
  };
  EXPECT_EQ(verify(proof.dump() + "\n").status, 0);
  EXPECT_EQ(verify("\xef\xbb\xbf" + proof.dump() + "\r\n").status, 0);
  for (const char* key : {"quaternion_wxyz", "displacement", "rotation_vector"}) {
    EXPECT_EQ(changed([&](Json& of) { of["b"][key] = {1, 0, 0, 0}; }), 2) << key;
  }
  EXPECT_EQ(changed([](Json& of) { of["a"]["shape"]["margin"] = 1; }), 2);
  EXPECT_EQ(changed([](Json& of) { of["answer"] = "unknown"; }), 1);
  EXPECT_EQ(verify("").status, 2);
  EXPECT_EQ(verify("\n\n").status, 2);
  const auto counts = [&](const std::string& text) {
    const std::string all = verify(text).text;
    return all.substr(std::min(all.size(), all.rfind('\n', all.size() - 2) + 1));
  };
  const std::string line = proof.dump() + "\n", last = "1 proven, 0 refused, 1 malformed\n";
  EXPECT_EQ(counts("\xff\n" + line), last);
  Json huge = proof;
  huge["a"]["translation"][0] = "HUGE";
  std::string text = huge.dump() + "\n";
  text.replace(text.find("\"HUGE\""), 6, "1" + std::string(400, '0'));
  EXPECT_EQ(counts(text + line), last);
  EXPECT_EQ(run_shell("python3 '" + std::string(project_folder) +
                      "/datasets/certificates/verify.py' /nowhere.jsonl")
                .status,
            2);
}

TEST(MutatedProofs, OfEveryKindThatAreVerifiedAreTrue) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "proof.jsonl";
  for (const ProofKind& kind : kinds_of_proofs()) {
    SCOPED_TRACE(kind.name);
    Judged whole;
    std::vector<Json> proofs;  // the certificates alone
    std::vector<bool> verified;
    for (const auto& lines : kind.proofs) {
      write_lines(folder, lines);
      kind.judge(file, whole);
      proofs.push_back(lines.back());
      verified.push_back(true);
    }
    EXPECT_EQ(whole.verified, static_cast<int>(kind.proofs.size()));
    Random random(22);
    Judged judged;
    for (int i = 0; i < drawn(2000, 100); ++i) {
      const auto pick = [&] {
        return kind
            .proofs[static_cast<std::size_t>(random.below(static_cast<int>(kind.proofs.size())))];
      };
      std::vector<Json> lines = pick();
      const std::vector<Json> other = pick();
      // Mostly the proof is changed, seldom what it is at, and both for a step of several.
      for (int k = 0; k <= random.below(3); ++k) {
        const std::size_t line = random.below(5) == 0 ? 0 : lines.size() - 1;
        change(lines[line], other[line], random);
      }
      write_lines(folder, lines);
      const int before = judged.verified;
      try {
        kind.judge(file, judged);
      } catch (const base::InputError&) {
        ++judged.malformed;
      }
      if (testing::Test::HasFailure()) return;
      proofs.push_back(lines.back());
      verified.push_back(judged.verified > before);
    }
    if (kind.name == "pairs") expect_the_same_of_python(folder, proofs, verified);
    EXPECT_GT(judged.verified, 100 / one_in);
    EXPECT_GT(judged.refused, 200 / one_in);
    RecordProperty(kind.name + "_verified", judged.verified);
  }
}

// Whether the claim does not hold: its answer is not the exact one, or a bound is on the wrong side of it.
bool is_false(const files::StoredCertificate& stored) {
  const oracle::Certificate& claim = stored.certificate;
  for (const oracle::SignedRoot* root : {&claim.lower, &claim.upper}) {
    if (root->sign != 0 && (root->numerator <= 0 || root->denominator < 0)) return false;
  }
  const oracle::Solid a(stored.shape_a), b(stored.shape_b);
  const oracle::Measure truth = oracle::Oracle().measure({a, stored.pose_a}, {b, stored.pose_b});
  if (claim.answer != Answer::unknown && truth.answer != Answer::unknown &&
      claim.answer != truth.answer) {
    return true;
  }
  return oracle::round_less(claim.lower, a.radius, b.radius).low > truth.upper ||
         oracle::round_less(claim.upper, a.radius, b.radius).high < truth.lower;
}

// --gtest_random_seed draws other changes.
TEST(MutatedProofs, OfTheCorpusThatAreFalseAreRefused) {
  const TemporaryFolder folder;
  std::vector<Json> whole;
  files::for_each_json_line(
      std::filesystem::path(project_folder) / "datasets/corpus/2026/proofs.jsonl.zst", "proof",
      [&](const files::JsonNode& line) { whole.push_back(line.value()); });
  Random random(25 + static_cast<unsigned>(GTEST_FLAG_GET(random_seed)));
  const auto pick = [&] {
    return whole[static_cast<std::size_t>(random.below(static_cast<int>(whole.size())))];
  };
  std::vector<Json> proofs;
  std::vector<bool> verified;
  int false_ones = 0;
  for (int i = 0; i < drawn(600, 60); ++i) {
    const Json original = pick();
    Json proof = original;
    for (int k = 0; k <= random.below(3); ++k) change(proof, pick(), random);
    // Another type may leave keys that the verifier in Python alone refuses.
    const auto has_other_type = [&](const Place& type) {
      return proof.contains(type) && proof[type] != original[type];
    };
    if (has_other_type(Place("/a/shape/type")) || has_other_type(Place("/b/shape/type"))) continue;
    write_lines(folder, {proof});
    Judged judged;
    bool is_wrong = false;
    try {
      const auto file = folder.path() / "proof.jsonl";
      judge_pairs(file, judged);
      files::read_certificates(file, [&](const files::StoredCertificate& stored, std::int64_t) {
        is_wrong = is_false(stored);
      });
    } catch (const base::InputError&) {
      ++judged.malformed;
    }
    false_ones += is_wrong ? 1 : 0;
    EXPECT_FALSE(is_wrong && judged.verified > 0) << proof.dump();
    proofs.push_back(std::move(proof));
    verified.push_back(judged.verified > 0);
  }
  expect_the_same_of_python(folder, proofs, verified);
  std::cout << false_ones << " false proofs of " << proofs.size() << " are refused\n";
  EXPECT_GT(false_ones, 100 / one_in);
  EXPECT_GT(std::ranges::count(verified, true), 50 / one_in);
}

}  // namespace
}  // namespace touchstone
