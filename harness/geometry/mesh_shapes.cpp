// Grids of quadrilaterals, bent to tori, knots, ellipsoids and hills.
#include "harness/geometry/mesh_shapes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <functional>
#include <optional>
#include <string_view>

#include "algorithms/core/nearest_float.h"
#include "harness/base/error.h"
#include "harness/base/random.h"
#include "harness/base/reproducible_math.h"

namespace touchstone::geometry {
namespace {

using Index = std::uint32_t;

double part(std::size_t i, std::size_t n) {
  return static_cast<double>(i) / static_cast<double>(n);
}

// Splits the quadrilateral of four vertices, anticlockwise, into two triangles.
void add_quadrilateral(Mesh& mesh, std::size_t a, std::size_t b, std::size_t c, std::size_t d) {
  const auto at = [](std::size_t i) { return static_cast<Index>(i); };
  mesh.triangles.push_back({at(a), at(b), at(c)});
  mesh.triangles.push_back({at(a), at(c), at(d)});
}

// Splits the cells of a grid of vertices, in rows from the least y up, each from the least x up.
void add_cells(Mesh& mesh, std::size_t rows, std::size_t columns) {
  for (std::size_t row = 0; row + 1 < rows; ++row) {
    for (std::size_t column = 0; column + 1 < columns; ++column) {
      const std::size_t a = row * columns + column, d = a + columns;
      add_quadrilateral(mesh, a, a + 1, d + 1, d);
    }
  }
}

// A grid that closes on itself both ways. `point` takes two numbers of turns.
Mesh closed_grid(std::size_t along, std::size_t across,
                 const std::function<Vec3d(double, double)>& point) {
  Mesh mesh;
  for (std::size_t i = 0; i < along; ++i) {
    for (std::size_t k = 0; k < across; ++k)
      mesh.vertices.push_back(nearest_float(point(part(i, along), part(k, across))));
  }
  for (std::size_t i = 0; i < along; ++i) {
    const std::size_t next = (i + 1) % along;
    for (std::size_t k = 0; k < across; ++k) {
      const std::size_t above = (k + 1) % across;
      add_quadrilateral(mesh, i * across + k, next * across + k, next * across + above,
                        i * across + above);
    }
  }
  return mesh;
}

// A point of the trefoil knot.
Vec3d on_trefoil(double turns) {
  const auto one = base::sin_cos_turns(turns), two = base::sin_cos_turns(2 * turns),
             three = base::sin_cos_turns(3 * turns);
  return {0.5 * (one.sin + 2 * two.sin), 0.5 * (one.cos - 2 * two.cos), -0.5 * three.sin};
}

}  // namespace

Mesh torus(std::size_t around, std::size_t across, double tube_radius) {
  return closed_grid(around, across, [&](double u, double v) {
    const auto ring = base::sin_cos_turns(u), tube = base::sin_cos_turns(v);
    const double radius = 1 + tube_radius * tube.cos;
    return Vec3d(radius * ring.cos, radius * ring.sin, tube_radius * tube.sin);
  });
}

Mesh trefoil(std::size_t along, std::size_t across, double tube_radius) {
  return closed_grid(along, across, [&](double u, double v) {
    // The tube's rings stand across the knot; any direction that turns smoothly with it fixes their start.
    constexpr double step = 1e-4;
    const Vec3d centre = on_trefoil(u);
    const Vec3d tangent = base::unit(on_trefoil(u + step) - on_trefoil(u - step));
    const Vec3d right = base::beside(tangent, centre), up = base::outer(right, tangent);
    const auto tube = base::sin_cos_turns(v);
    return Vec3d(centre + tube_radius * (tube.cos * right + tube.sin * up));
  });
}

Mesh ellipsoid_with_poles(const Vec3d& radii, std::size_t stacks, std::size_t slices) {
  Mesh mesh;
  for (std::size_t i = 1; i < stacks; ++i) {
    const auto height = base::sin_cos_turns(0.5 * part(i, stacks));
    for (std::size_t k = 0; k < slices; ++k) {
      const auto ring = base::sin_cos_turns(part(k, slices));
      mesh.vertices.push_back(nearest_float(
          radii.cwiseProduct(Vec3d(height.sin * ring.cos, height.sin * ring.sin, -height.cos))));
    }
  }
  const std::size_t bottom = mesh.vertices.size(), top = bottom + 1, last = (stacks - 2) * slices;
  mesh.vertices.push_back(nearest_float({0, 0, -radii.z()}));
  mesh.vertices.push_back(nearest_float({0, 0, radii.z()}));
  const auto at = [](std::size_t i) { return static_cast<Index>(i); };
  for (std::size_t k = 0; k < slices; ++k) {
    const std::size_t next = (k + 1) % slices;
    mesh.triangles.push_back({at(bottom), at(next), at(k)});
    for (std::size_t i = 0; i + 2 < stacks; ++i) {
      add_quadrilateral(mesh, i * slices + k, i * slices + next, (i + 1) * slices + next,
                        (i + 1) * slices + k);
    }
    mesh.triangles.push_back({at(last + k), at(last + next), at(top)});
  }
  return mesh;
}

Mesh gear(std::size_t teeth, double root_radius, double hole_radius, double thickness) {
  // Of each tooth: the root's two ends and the tip's two ends, in parts of its share of the turn.
  constexpr std::array<double, 4> places = {0, 0.3, 0.42, 0.88};
  Mesh mesh;
  for (std::size_t i = 0; i < 4 * teeth; ++i) {
    const auto place = static_cast<double>(i / 4) + places[i % 4];
    const auto turn = base::sin_cos_turns(place / static_cast<double>(teeth));
    for (const double radius : {i % 4 < 2 ? root_radius : 1.0, hole_radius}) {
      for (const double z : {thickness / 2, -thickness / 2}) {
        mesh.vertices.push_back(nearest_float({radius * turn.cos, radius * turn.sin, z}));
      }
    }
  }
  // The four vertices at each place: outside above and below, inside above and below.
  for (std::size_t i = 0; i < 4 * teeth; ++i) {
    const std::size_t here = 4 * i, next = 4 * ((i + 1) % (4 * teeth));
    add_quadrilateral(mesh, here + 2, here, next, next + 2);
    add_quadrilateral(mesh, here + 1, here + 3, next + 3, next + 1);
    add_quadrilateral(mesh, here, here + 1, next + 1, next);
    add_quadrilateral(mesh, here + 3, here + 2, next + 2, next + 3);
  }
  return mesh;
}

Mesh terrain(std::size_t cells, double height, std::uint64_t seed) {
  // Value noise of octaves: each has half the height and twice the points of the one before.
  Mesh mesh;
  const auto noise = [&](int octave, double x, double y) {
    const double scale = std::ldexp(1.0, octave);
    const double u = (x + 1) * scale, v = (y + 1) * scale;
    const double i = std::floor(u), k = std::floor(v), s = u - i, t = v - k;
    const auto at = [&](double column, double row) {
      const auto number =
          static_cast<std::uint64_t>(column) << 24 | static_cast<std::uint64_t>(row);
      return base::Random(seed, number << 6 | static_cast<std::uint64_t>(octave)).uniform(-1, 1);
    };
    const double low = at(i, k) * (1 - s) + at(i + 1, k) * s;
    const double high = at(i, k + 1) * (1 - s) + at(i + 1, k + 1) * s;
    return (low * (1 - t) + high * t) / scale;
  };
  for (std::size_t row = 0; row <= cells; ++row) {
    for (std::size_t column = 0; column <= cells; ++column) {
      const double x = 2 * part(column, cells) - 1, y = 2 * part(row, cells) - 1;
      double z = 0;
      for (int octave = 1; octave <= 6; ++octave) z += height * noise(octave, x, y);
      mesh.vertices.push_back(nearest_float({x, y, z}));
    }
  }
  add_cells(mesh, cells + 1, cells + 1);
  return mesh;
}

Mesh height_field(std::size_t rows, std::size_t columns, std::span<const double> heights, double x,
                  double y) {
  Mesh mesh;
  mesh.vertices.reserve(rows * columns);
  const auto along = [](std::size_t i, std::size_t count, double size) {
    return (static_cast<double>(i) - static_cast<double>(count - 1) / 2) * size;
  };
  for (std::size_t row = 0; row < rows; ++row) {
    for (std::size_t column = 0; column < columns; ++column) {
      const double height = heights[(rows - 1 - row) * columns + column];
      mesh.vertices.emplace_back(along(column, columns, x), along(row, rows, y), height);
    }
  }
  add_cells(mesh, rows, columns);
  return mesh;
}

namespace {

constexpr std::array<std::string_view, 4> shapes = {"torus", "trefoil", "ellipsoid", "terrain"};

// The number behind the name of a shape and a dash; empty if the name is not of that form.
std::optional<double> count_of(std::string_view name, std::string_view shape) {
  if (!name.starts_with(shape) || !name.substr(shape.size()).starts_with('-')) return {};
  const std::string_view digits = name.substr(shape.size() + 1);
  std::int64_t count = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), count);
  if (error != std::errc() || end != digits.data() + digits.size()) return {};
  if (count < 32 || count > 10'000'000) {
    throw base::InputError(
        fmt::format("{}: found {} triangles; expected 32 to 10000000", name, count));
  }
  return static_cast<double>(count);
}

}  // namespace

Mesh named_mesh(const std::string& name, const std::filesystem::path& home) {
  for (const std::string_view shape : shapes) {
    const std::optional<double> count = count_of(name, shape);
    if (!count) continue;
    const auto side = [&](double triangles_of_one) {
      return std::max<std::size_t>(
          3, static_cast<std::size_t>(std::lround(std::sqrt(*count / triangles_of_one))));
    };
    if (shape == "torus") return torus(4 * side(8), side(8), 0.25);
    if (shape == "trefoil") return trefoil(20 * side(40), side(40), 0.25);
    if (shape == "ellipsoid") return ellipsoid_with_poles({1, 0.8, 0.6}, side(4), 2 * side(4));
    return terrain(side(2), 0.3, 1);
  }
  return read_surface(home / name);
}

}  // namespace touchstone::geometry
