// Tests the proxies of meshes: outer parts contain the solid, inner ones are inside it, exactly.
#include <gtest/gtest.h>

#include "harness/base/error.h"
#include "tests/harness/geometry/meshes.h"
#include "tests/harness/proxies/bodies.h"

namespace touchstone {
namespace {

struct NamedMesh {
  std::string name;
  geometry::Mesh mesh;
};

std::vector<NamedMesh> meshes() {
  std::vector<NamedMesh> all = {{"torus", torus(1, 0.3, 16, 10)}, {"angle", angle_bracket()}};
  for (bool inside_out : {false, true}) all.push_back({"hollow cube", hollow_cube(inside_out)});
  base::Random random(3);
  const Mat3d turn = random.rotation();
  for (std::size_t i : {0, 1}) {
    NamedMesh turned = all[i];
    turned.name += " turned, far off";
    for (Vec3d& v : turned.mesh.vertices) v = Vec3d(turn * v * 0.1 + Vec3d(1e5, 3, -2e4));
    all.push_back(turned);
  }
  return all;
}

// Samples points of the mesh's box: returns those around which it winds, and the others in
// `outside`.
std::vector<Vec3d> sample(const geometry::Mesh& mesh, std::vector<Vec3d>& outside) {
  Vec3d low = mesh.vertices.front(), high = low;
  for (const Vec3d& v : mesh.vertices) {
    low = low.cwiseMin(v);
    high = high.cwiseMax(v);
  }
  base::Random random(5);
  std::vector<Vec3d> inside;
  const std::vector<geometry::Triangle> surface = geometry::triangles_of(mesh);
  for (int i = 0; i < 400; ++i) {
    const Vec3d u(random.unit(), random.unit(), random.unit());
    const Vec3d x = low + u.cwiseProduct(high - low);
    (std::abs(geometry::winding_number(surface, x)) > 0.5 ? inside : outside).push_back(x);
  }
  return inside;
}

TEST(Meshes, OuterOnesHoldTheSolid) {
  Exact exact;
  for (const NamedMesh& m : meshes()) {
    std::vector<Vec3d> outside;
    std::vector<Vec3d> points = sample(m.mesh, outside);
    ASSERT_GT(points.size(), 40u);
    ASSERT_GT(outside.size(), 40u);
    for (std::size_t i = 0; i < m.mesh.vertices.size(); i += 5) {
      points.push_back(m.mesh.vertices[i]);
    }
    for (const char* form : {"sphere", "box", "oriented-box", "dop-26", "capsule", "hull-12",
                             "hull", "parts", "parts-2", "parts-5", "icosphere-1"}) {
      SCOPED_TRACE(m.name + ", " + form);
      const auto parts =
          proxies::represent(hull_of(m.mesh), &m.mesh, proxies::parse_representation(form));
      for (const Vec3d& p : points) {
        EXPECT_TRUE(std::any_of(parts.begin(), parts.end(),
                                [&](const proxies::Part& part) { return exact.holds(part, p); }));
      }
    }
  }
}

TEST(Meshes, InnerOnesTouchNoTriangleAndAreInside) {
  oracle::Oracle exact;
  for (const NamedMesh& m : meshes()) {
    const std::vector<geometry::Triangle> surface = geometry::triangles_of(m.mesh);
    for (const char* form : {"sphere inner", "box inner", "oriented-box inner", "dop-14 inner",
                             "capsule inner", "hull-12 inner", "hull inner", "parts inner"}) {
      SCOPED_TRACE(m.name + ", " + form);
      for (const proxies::Part& part :
           proxies::represent(hull_of(m.mesh), &m.mesh, proxies::parse_representation(form))) {
        const oracle::Solid solid(part.shape);
        Vec3d middle = part.pose.translation;
        if (part.shape.hull != nullptr) {
          for (const Vec3d& v : part.shape.hull->vertices) {
            middle += v / static_cast<double>(part.shape.hull->vertices.size());
          }
        }
        EXPECT_GT(std::abs(geometry::winding_number(surface, middle)), 0.9);
        for (const geometry::Triangle& t : surface) {
          const oracle::Solid flat(hull_shape({t.a, t.b, t.c}));
          ASSERT_NE(exact.verdict({solid, part.pose}, {flat, Pose{}}), Answer::overlapping);
        }
      }
    }
  }
}

TEST(Meshes, PartsComeNearTheSolid) {
  const geometry::Mesh mesh = angle_bracket();
  const auto parts =
      proxies::represent(hull_of(mesh), &mesh, {proxies::Form::parts, proxies::Side::outer, 0});
  EXPECT_EQ(parts.size(), 2u);
  const proxies::RepresentationError error =
      proxies::representation_error(hull_of(mesh), &mesh, parts);
  EXPECT_NEAR(error.added, 0, 1e-4);
  EXPECT_NEAR(error.lost, 0, 1e-4);
  EXPECT_NEAR(error.hausdorff, 0, error.hausdorff_deviation);
  const proxies::RepresentationError hull = proxies::representation_error(
      hull_of(mesh), &mesh, proxies::represent(hull_of(mesh), &mesh, {proxies::Form::hull}));
  EXPECT_NEAR(hull.added, 0.5 / 3, 1e-9);
  EXPECT_NEAR(hull.lost, 0, 1e-9);
  EXPECT_NEAR(hull.hausdorff, 0.5, hull.hausdorff_deviation);
  EXPECT_EQ(hull.volume_deviation, 0);
}

TEST(Meshes, ACavityIsNoPartOfThem) {
  for (bool inside_out : {false, true}) {
    const geometry::Mesh mesh = hollow_cube(inside_out);
    const Shape hull = hull_of(mesh);
    const auto error_of = [&](const char* form) {
      return proxies::representation_error(
          hull, &mesh, proxies::represent(hull, &mesh, proxies::parse_representation(form)));
    };
    for (const char* form : {"box", "hull"}) {
      const proxies::RepresentationError e = error_of(form);
      EXPECT_NEAR(e.added, 64.0 / 56 - 1, 1e-9) << form;
      EXPECT_EQ(e.lost, 0) << form;
      EXPECT_EQ(e.volume_deviation, 0) << form;
    }
    EXPECT_LT(error_of("parts").added, 64.0 / 56 - 1 + 1e-9);
    for (const char* form : {"box inner", "sphere inner", "parts inner"}) {
      EXPECT_EQ(error_of(form).added, 0) << form;
      EXPECT_LT(error_of(form).lost, 1) << form;
    }
    EXPECT_NEAR(error_of("box nearest").added, error_of("box nearest").lost, 1e-9);
  }
  // Two solids, one in the other, are no cavity.
  geometry::Mesh nested = hollow_cube(false);
  for (std::size_t t = 12; t < 24; ++t) std::swap(nested.triangles[t][1], nested.triangles[t][2]);
  const proxies::RepresentationError e = proxies::representation_error(
      hull_of(nested), &nested, proxies::represent(hull_of(nested), &nested, {proxies::Form::box}));
  EXPECT_NEAR(e.added, 0, 1e-9);
}

// Cuts beside vertices leave points that almost coincide, in which Qhull finds no faces.
TEST(Meshes, ARingIsCutIntoSectors) {
  const geometry::Mesh ring = torus(1, 0.2, 24, 12);
  double before = 10;
  for (const auto& [most, added] :
       {std::pair(1, 2.5), std::pair(8, 0.25), std::pair(0, 0.08), std::pair(16, 0.05)}) {
    const auto parts = proxies::represent(hull_of(ring), &ring,
                                          {proxies::Form::parts, proxies::Side::outer, most});
    if (most > 0) {
      EXPECT_LE(parts.size(), static_cast<std::size_t>(most));
    }
    const proxies::RepresentationError e =
        proxies::representation_error(hull_of(ring), &ring, parts);
    EXPECT_LT(e.added, added) << most;
    EXPECT_LT(e.added, before) << most;
    EXPECT_LT(e.lost, 1e-9);
    before = e.added;
  }
}

TEST(Meshes, AsTrianglesTheyAreTheSurface) {
  const geometry::Mesh mesh = angle_bracket();
  const auto parts =
      proxies::represent(hull_of(mesh), &mesh, proxies::parse_representation("mesh"));
  EXPECT_EQ(parts.size(), mesh.triangles.size());
  const proxies::RepresentationError error =
      proxies::representation_error(hull_of(mesh), &mesh, parts);
  EXPECT_EQ(error.added, 0);
  EXPECT_EQ(error.lost, 1);
  EXPECT_LT(error.hausdorff, 1e-12);
}

TEST(Meshes, PiecesThatShareAFaceStayTwoAndATriangleSoupIsOne) {
  geometry::Mesh two = angle_bracket();
  const geometry::Mesh one = two;  // another, on top
  for (const Vec3d& v : one.vertices) two.vertices.push_back(v + Vec3d::UnitZ());
  for (const auto& [a, b, c] : one.triangles) two.triangles.push_back({a + 12, b + 12, c + 12});
  EXPECT_EQ(geometry::pieces_of(two).size(), 2u);
  geometry::Mesh soup;
  for (const geometry::Triangle& t : geometry::triangles_of(angle_bracket())) {
    const auto first = static_cast<std::uint32_t>(soup.vertices.size());
    soup.vertices.insert(soup.vertices.end(), {t.a, t.b, t.c});
    soup.triangles.push_back({first, first + 1, first + 2});
  }
  ASSERT_EQ(geometry::pieces_of(soup).size(), 1u);
  EXPECT_TRUE(geometry::pieces_of(soup)[0].closed);
}

TEST(Meshes, OpenOnesHaveNothingInside) {
  geometry::Mesh mesh = angle_bracket();
  mesh.triangles.pop_back();
  EXPECT_THROW(
      proxies::represent(hull_of(mesh), &mesh, proxies::parse_representation("sphere inner")),
      base::InputError);
  EXPECT_EQ(proxies::represent(hull_of(mesh), &mesh, proxies::parse_representation("parts")).size(),
            1u);
}

}  // namespace
}  // namespace touchstone
