#include "harness/geometry/mesh.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>
#include <string>

#include "harness/base/error.h"
#include "harness/geometry/mesh_format.h"
#include "tests/harness/geometry/mesh_texts.h"
#include "tests/harness/input_fault.h"
#include "tests/harness/temporary_folder.h"

namespace touchstone {
namespace {

using namespace mesh_texts;

class MeshTest : public testing::Test {
 protected:
  geometry::Mesh read(const std::string& name, const std::string& content) {
    return geometry::read_mesh(folder_.write(name, content));
  }
  std::string error(const std::string& name, const std::string& content) {
    return input_fault([&] { read(name, content); });
  }

  TemporaryFolder folder_;
};

void expect_tetrahedron(const geometry::Mesh& mesh) {
  EXPECT_EQ(mesh.vertices, tetrahedron);
  EXPECT_EQ(mesh.triangles, sides);
}

std::string with_ends(const std::string& text, const std::string& end) {
  std::string result;
  for (char c : text) result += c == '\n' ? end : std::string(1, c);
  return result;
}

TEST_F(MeshTest, ReadsEachFormat) {
  expect_tetrahedron(read("a.obj", obj));
  expect_tetrahedron(read("a.OFF", off));
  expect_tetrahedron(read("a.ply", ply));
  expect_tetrahedron(read("b.ply", binary_ply(false)));
  expect_tetrahedron(read("c.ply", binary_ply(true)));
  const geometry::Mesh text = read("a.stl", stl);
  EXPECT_EQ(text.vertices.size(), 4u);
  EXPECT_EQ(text.triangles, (Triangles{{0, 1, 2}, {0, 2, 3}}));
  for (const char* title : {"made up", "solid that is none"}) {
    const geometry::Mesh mesh = read("b.stl", binary_stl(title));
    EXPECT_THAT(mesh.vertices, testing::UnorderedElementsAreArray(tetrahedron));
    EXPECT_EQ(mesh.triangles.size(), 4u);
  }
}

TEST_F(MeshTest, ReadsEveryEndOfLine) {
  for (const std::string end : {"\r\n", "\r", "\n\n", "\r\r\n"}) {
    expect_tetrahedron(read("a.obj", with_ends(obj, end)));
    expect_tetrahedron(read("a.off", with_ends(off, end)));
    expect_tetrahedron(read("a.ply", with_ends(ply, end)));
    EXPECT_EQ(read("a.stl", with_ends(stl, end)).triangles.size(), 2u);
  }
  EXPECT_THAT(error("a.obj", "v 0 0 0\rv 1 0 0\r\nf 1 2 x\r"), testing::HasSubstr("a.obj:3:"));
}

TEST_F(MeshTest, LeavesOutAByteOrderMark) {
  const std::string mark = "\xef\xbb\xbf";
  expect_tetrahedron(
      read("a.obj", mark + std::string(obj).substr(std::string(obj).find("v 0 0 0"))));
  expect_tetrahedron(read("a.off", mark + off));
  expect_tetrahedron(read("a.ply", mark + ply));
  expect_tetrahedron(read("b.ply", mark + binary_ply(false)));
  EXPECT_EQ(read("a.stl", mark + stl).triangles.size(), 2u);
  EXPECT_EQ(read("b.stl", binary_stl(mark)).triangles.size(), 4u);  // part of the title
}

TEST_F(MeshTest, TextInUtf16IsNamed) {
  using namespace std::string_literals;
  const std::string wide =
      "v\0 \0"
      "0\0 \0"
      "0\0 \0"
      "0\0\n\0"s;
  for (const std::string& mark : {"\xff\xfe"s, "\xfe\xff"s}) {
    EXPECT_THAT(error("a.obj", mark + wide), testing::HasSubstr("a.obj:1: text in UTF-16"));
  }
}

TEST_F(MeshTest, ASurfaceHasFaces) {
  const auto read_surface = [&](const std::string& content) {
    return geometry::read_surface(folder_.write("a.obj", content));
  };
  expect_tetrahedron(read_surface(obj));
  const std::string points = "v 0 0 0\nv 1 0 0\n";
  EXPECT_EQ(read("a.obj", points).vertices.size(), 2u);
  EXPECT_THAT(input_fault([&] { read_surface(points); }), testing::HasSubstr("has no faces"));
}

TEST_F(MeshTest, CutsPolygonsIntoFans) {
  EXPECT_EQ(read("a.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 \\\n3 4\n").triangles,
            (Triangles{{0, 1, 2}, {0, 2, 3}}));
  for (const char* face : {"f 1 2\\\n3 4\n", "f \\\n\n1 2 3 \\ \n4\n", "f 1 2 3 \\\n\\\n4"}) {
    EXPECT_EQ(read("a.obj", std::string("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n") + face).triangles,
              (Triangles{{0, 1, 2}, {0, 2, 3}}))
        << face;
  }
  EXPECT_EQ(read("a.off", "OFF 4 1 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 3 2 1 0\n").triangles,
            (Triangles{{3, 2, 1}, {3, 1, 0}}));
}

TEST_F(MeshTest, PassesWhatNobodyNeedsEvenIfItIsNotFinite) {
  const std::string head =
      "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
      "property float z\nproperty float nx\nend_header\n";
  EXPECT_EQ(read("a.ply", head + "1 2 3 nan\n").vertices, std::vector<Vec3d>{Vec3d(1, 2, 3)});
  EXPECT_EQ(read("a.ply", head + "1 2 3 -inf\n").vertices.size(), 1u);
  EXPECT_THAT(input_fault([&] { read("a.ply", head + "1 2 3 up\n"); }),
              testing::HasSubstr("expected a number"));
}

TEST_F(MeshTest, ReadsOffVariants) {
  for (const char* head :
       {"COFF\n1 0 0\n1 2 3 255 0 0 1\n", "NOFF 1 0 0\n1 2 3 0 0 1\n",
        "STOFF\n# c\n1 0\n1 2 3 0.5 0.5\n", "CNOFF\n1 0 0\n1 2 3 0 0 1 1 1 1 1\n",
        "STCNOFF # c\n\n1 0 0 # d\n\n1 2 3 # e"}) {
    EXPECT_EQ(read("a.off", head).vertices, std::vector<Vec3d>{Vec3d(1, 2, 3)}) << head;
  }
}

TEST_F(MeshTest, ReadsExactNumbers) {
  EXPECT_EQ(read("a.obj", "v 0.1 1e-400 4.9406564584124654e-324").vertices[0],
            Vec3d(0.1, 0, 4.9406564584124654e-324));
}

TEST_F(MeshTest, ErrorsNameFileAndLine) {
  const auto expect = [&](const char* name, const std::string& content, const std::string& place,
                          const std::string& what) {
    const std::string message = error(name, content);
    EXPECT_THAT(message, testing::HasSubstr(std::string(name) + ":" + place)) << content;
    EXPECT_THAT(message, testing::HasSubstr(what)) << content;
  };
  expect("a.obj", "v 0 0 0\nv 0 0\n", "2:", "expected a finite number");
  expect("a.obj", "v 0 0 0\nv 0 0 nan\n", "2:", "'nan'");
  expect("a.obj", "v 0 0 inf\n", "1:", "'inf'");
  expect("a.obj", "v 0 0 1e999\n", "1:", "'1e999'");
  expect("a.obj", "v 0 0 1x\n", "1:", "'1x'");
  expect("a.obj", "v 0 0 0\nf 1 1 2\n", "2:", "index 2 out of range");
  expect("a.obj", "v 0 0 0\nf 1 1 0\n", "2:", "out of range");
  expect("a.obj", "v 0 0 0\nf 1 1 -2\n", "2:", "out of range");
  expect("a.obj", "v 0 0 0\nf 1 1 99999999999999999999\n", "2:", "integer");
  expect("a.obj", "v 0 0 0\nf 1 1\n", "2:", "three corners");
  expect("a.obj", "v 0 0 0\nf 1 1\\ 1\n", "2:", "behind the backslash");
  expect("a.obj", "v 0 0 0\nf 1 1 1\\\n", "2:", "ends early");
  expect("a.obj", "v 0 0 " + std::string(2000000, '1') + "x\n",
         "1:", std::string(80, '1') + "...'");
  expect("a.obj", "# nothing\n", "", "no vertices");
  expect("a.off", "", "", "ends early");
  expect("a.off", "PFF\n", "1:", "expected OFF");
  expect("a.off", "4OFF\n1 0 0\n", "1:", "expected OFF");
  expect("a.off", "OFF\n1 1 0\n0 0 0\n3 0 0 1\n", "4:", "index 1 out of range");
  expect("a.off", "OFF\n1 1 0\n0 0 0\n3 0 0 -1\n", "4:", "out of range");
  expect("a.off", "OFF\n1 1 0\n0 0 0\n3 0 0\n", "4:", "integer");
  expect("a.off", "OFF\n2 0 0\n0 0 0\n", "3:", "ends early");
  expect("a.off", "OFF\n4000000000 4000000000 0\n0 0 0\n", "3:", "ends early");
  expect("a.off", "OFF\n0 0 0\n", "", "no vertices");
  expect("a.off", "OFF\n-1 0 0\n", "2:", "counts");
  expect("a.stl", "solid a\nfacet\nouter loop\nvertex 0 0\n", "4:", "finite number");
  expect("a.stl", "solid a\nfacet\nouter loop\nvertex 0 0 0\nendloop\n", "5:", "three");
  expect("a.stl", "solid a\nfacet\n", "2:", "ends early");
  const std::string loop = "outer loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n";
  expect("a.stl", "solid a\nfacet\n" + loop + "endfacet\nendsolid\n", "7:", "endloop");
  expect("a.stl", "solid a\nfacet\n" + loop + "endsolid\n", "7:", "endloop");
  expect("a.stl", "solid a\nfacet\n" + loop + loop + "endloop\n", "7:", "endloop");
  expect("a.stl", "solid a\nfacet\nendfacet\nendsolid\n", "3:", "outer loop");
  expect("a.stl", "solid a\nfacet\nvertex 0 0 0\n", "3:", "outer loop");
  expect("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n3 0 2 1\n", "7:", "after 1 faces");
  expect("a.stl", "solid a\nendsolid\n", "", "no vertices");
  expect("a.stl", "junk", "", "ends early at byte 4");
  expect("a.stl", binary_stl("x").substr(0, 200), "", "ends early at byte 200");
  std::string infinite = binary_stl("x");
  infinite.replace(96, 4, bytes(std::numeric_limits<float>::infinity()));
  expect("a.stl", infinite, "", "byte 96");
  expect("a.ply", "plx\n", "1:", "expected 'ply'");
  expect("a.ply", "ply\nelement vertex 1\n", "2:", "end_header");
  expect("a.ply", "ply\nelement vertex 1\nproperty float x\nend_header\n", "4:", "format");
  expect("a.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty real x\n", "4:", "PLY type");
  expect("a.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nend_header\n1\n", "",
         "x, y and z");
  expect("a.ply", std::string(ply).replace(std::string(ply).rfind("3 2 0 3"), 7, "3 2 0 4"), "",
         "index 4 out of range");
  expect("a.ply", std::string(ply).substr(0, std::string(ply).size() - 4), "", "ends early");
  const std::string binary = binary_ply(false);
  expect("a.ply", binary.substr(0, binary.size() - 1), "",
         "byte " + std::to_string(binary.size() - 2));
  expect("a.xyz", "0 0 0\n", "", "unknown mesh format");
  EXPECT_THROW(geometry::read_mesh(folder_.path() / "absent.obj"), base::InputError);
  EXPECT_THROW(geometry::read_mesh(folder_.path()), base::InputError);
}

// Whatever is done to a file, it is read, with finite vertices and indices in range, or refused.
TEST(MeshFormat, BrokenFilesAreReadOrRefused) {
  const std::pair<decltype(&geometry::read_obj), std::string> files[] = {
      {geometry::read_obj, obj},
      {geometry::read_off, off},
      {geometry::read_stl, stl},
      {geometry::read_ply, ply},
      {geometry::read_ply, binary_ply(false)},
      {geometry::read_ply, binary_ply(true)},
      {geometry::read_stl, binary_stl("solid")}};
  std::mt19937_64 random(1);
  int read_count = 0, refused = 0;
  for (int i = 0; i < 14000; ++i) {
    const auto& [reader, content] = files[static_cast<std::size_t>(i) % std::size(files)];
    std::string broken = content;
    if (i % 3 != 0) broken.resize(random() % broken.size());
    for (std::uint64_t k = i % 3 == 1 ? 0 : 1 + random() % 4; k-- > 0 && !broken.empty();) {
      const char* const likely = "0123456789-+.eE/ \n#\\";
      broken[random() % broken.size()] =
          random() % 2 ? likely[random() % 20] : static_cast<char>(random() % 256);
    }
    try {
      const geometry::Mesh mesh = reader("file", broken);
      for (const Vec3d& v : mesh.vertices) ASSERT_TRUE(v.allFinite());
      for (const auto& t : mesh.triangles) {
        for (std::uint32_t v : t) ASSERT_LT(v, mesh.vertices.size());
      }
      ++read_count;
    } catch (const base::InputError& e) {
      EXPECT_NE(std::string(e.what()), "");
      ++refused;
    }
  }
  EXPECT_GT(read_count, 1400);
  EXPECT_GT(refused, 1400);
}

}  // namespace
}  // namespace touchstone
