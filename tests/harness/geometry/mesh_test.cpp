#include "harness/geometry/mesh.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cstring>
#include <random>
#include <string>

#include "harness/base/error.h"
#include "harness/geometry/mesh_format.h"
#include "tests/harness/input_fault.h"
#include "tests/harness/temporary_folder.h"

namespace touchstone {
namespace {

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

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

const std::vector<Vec3d> tetrahedron = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
const Triangles sides = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};

template <class T>
std::string bytes(T value, bool big = false) {
  std::string s(sizeof value, '\0');
  std::memcpy(s.data(), &value, sizeof value);
  if (big != (std::endian::native == std::endian::big)) std::reverse(s.begin(), s.end());
  return s;
}

std::string binary_stl(const std::string& title) {
  std::string s = title + std::string(80 - title.size(), ' ') + bytes<std::uint32_t>(4);
  for (const auto& side : sides) {
    for (int k = 0; k < 3; ++k) s += bytes<float>(0);
    for (std::uint32_t v : side) {
      for (double c : tetrahedron[v]) s += bytes(static_cast<float>(c));
    }
    s += bytes<std::uint16_t>(0);
  }
  return s;
}

std::string binary_ply(bool big) {
  std::string s =
      std::string("ply\nformat binary_") + (big ? "big" : "little") +
      "_endian 1.0\ncomment made up\nelement camera 2\nproperty list uchar short numbers\n"
      "property double angle\nelement vertex 4\nproperty uchar red\nproperty double z\n"
      "property float x\nproperty short y\nproperty list uint float weights\n"
      "element face 4\nproperty list uchar int vertex_indices\nproperty ushort flags\n"
      "end_header\n";
  for (int i = 0; i < 2; ++i) {
    s += bytes<std::uint8_t>(2) + bytes<std::int16_t>(-1, big) + bytes<std::int16_t>(7, big);
    s += bytes<double>(0.5, big);
  }
  for (const Vec3d& v : tetrahedron) {
    s += bytes<std::uint8_t>(255) + bytes<double>(v.z(), big) +
         bytes(static_cast<float>(v.x()), big);
    s += bytes(static_cast<std::int16_t>(v.y()), big) + bytes<std::uint32_t>(1, big) +
         bytes<float>(0.25f, big);
  }
  for (const auto& side : sides) {
    s += bytes<std::uint8_t>(3);
    for (std::uint32_t v : side) s += bytes(static_cast<std::int32_t>(v), big);
    s += bytes<std::uint16_t>(9, big);
  }
  return s;
}

const char* const obj = R"(# a tetrahedron
mtllib none.mtl
o body
v 0 0 0
v 1.0 0 0 1
v 0 1e0 0 0.5 0.5 0.5
v +0 -0.0 1 # last
vt 0 0
vn 0 0 1
usemtl none
s off
f 1 3 2
f 1/1 2/1 4/1
f 2//1 3//1 4//1
f -2/1/1 -4/1/1 -1/1/1
)";

const char* const off = R"(OFF
# a tetrahedron
4 4 6

0 0 0
1 0 0  # second
0 1 0
0 0 1
3 0 2 1
3 0 1 3  255 0 0
3 1 2 3 0.5 0.5 0.5
3 2 0 3
)";

const char* const stl = R"(solid a b c
 facet normal 0 0 -1
  outer loop
   vertex 0 0 0
   vertex 0 1 0
   vertex 1 0 0
  endloop
 endfacet
 FACET NORMAL 0 -1 0
  OUTER LOOP
   VERTEX 0 0 0
   VERTEX 1 0 0
   VERTEX 0 0 1e0
  ENDLOOP
 ENDFACET
endsolid a b c
)";

const char* const ply = R"(ply
format ascii 1.0
comment a tetrahedron
obj_info none
element vertex 4
property float nx
property float y
property float x
property float32 z
element face 4
property uchar red
property list uchar uint vertex_index
end_header
0 0 0 0
0 0 1 0
0 1 0 0
0 0 0 1
1 3 0 2 1
1 3 0 1 3
1 3 1 2 3
1 3 2 0 3
)";

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
