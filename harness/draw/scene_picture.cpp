// Draws bodies as polytopes or by their triangles, half-spaces as squares, on a depth-buffered
// canvas with four samples per pixel, written as PNG.
#include "harness/draw/scene_picture.h"

#include <png.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <limits>
#include <memory>

#include "harness/base/error.h"
#include "harness/files/output_file.h"
#include "harness/geometry/tessellation.h"

namespace touchstone::draw {
namespace {

constexpr int samples = 2;  // per pixel and direction
constexpr double margin = 0.04;
constexpr double outline_light = 0.45;
constexpr Colour background{250, 250, 248};

Colour lit(Colour colour, double light) {
  const auto channel = [&](std::uint8_t value) {
    return static_cast<std::uint8_t>(std::clamp(value * light, 0.0, 255.0));
  };
  return {channel(colour.red), channel(colour.green), channel(colour.blue)};
}

}  // namespace

View::View(const Vec3d& direction) : towards(-direction.normalized()) {
  const Vec3d sky = std::abs(towards.z()) < 0.999 ? Vec3d::UnitZ().eval() : Vec3d::UnitY().eval();
  right = sky.cross(towards).normalized();
  up = towards.cross(right);
}

Canvas::Canvas(int width, int height, const View& view)
    : width_(width),
      height_(height),
      view_(view),
      depth_(static_cast<std::size_t>(width) * height * samples * samples,
             -std::numeric_limits<float>::infinity()),
      colour_(depth_.size(), background),
      owner_(depth_.size(), 0) {}

void Canvas::fit(std::span<const Vec3d> points) {
  Vec3d low = Vec3d::Constant(std::numeric_limits<double>::infinity());
  Vec3d high = -low;
  for (const Vec3d& point : points) {
    const Vec3d seen(view_.right.dot(point), view_.up.dot(point), view_.towards.dot(point));
    low = low.cwiseMin(seen);
    high = high.cwiseMax(seen);
  }
  if (points.empty()) low = high = Vec3d::Zero();
  centre_ = (low + high) / 2;
  const double wide = std::max(high.x() - low.x(), 1e-300);
  const double tall = std::max(high.y() - low.y(), 1e-300);
  scale_ = (1 - 2 * margin) * samples * std::min(width_ / wide, height_ / tall);
}

Vec3d Canvas::project(const Vec3d& point) const {
  return {samples * width_ / 2.0 + scale_ * (view_.right.dot(point) - centre_.x()),
          samples * height_ / 2.0 - scale_ * (view_.up.dot(point) - centre_.y()),
          scale_ * (view_.towards.dot(point) - centre_.z())};
}

void Canvas::polygon(std::span<const Vec3d> corners, Colour colour) {
  if (corners.size() < 3) return;
  Vec3d normal = Vec3d::Zero();
  for (std::size_t i = 2; i < corners.size(); ++i) {
    normal += (corners[i - 1] - corners[0]).cross(corners[i] - corners[0]);
  }
  const double length = normal.stableNorm();
  if (!(length > 0)) return;
  // The sun is above the viewer, to the left; surfaces that it does not reach have the sky's light.
  const Vec3d sun = (-0.5 * view_.right + 0.9 * Vec3d::UnitZ() + 0.7 * view_.towards).normalized();
  const double light = 0.55 + 0.55 * std::max(0.0, normal.dot(sun) / length);
  const Vec3d first = project(corners[0]);
  for (std::size_t i = 2; i < corners.size(); ++i) {
    triangle(first, project(corners[i - 1]), project(corners[i]), lit(colour, light));
  }
}

void Canvas::triangle(const Vec3d& a, const Vec3d& b, const Vec3d& c, Colour colour) {
  const double area = (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
  if (!(std::abs(area) > 1e-12)) return;
  const auto clamp = [](double value, int last) {
    return static_cast<int>(std::clamp(value, 0.0, static_cast<double>(last)));
  };
  const int left = clamp(std::floor(std::min({a.x(), b.x(), c.x()})), samples * width_ - 1);
  const int right = clamp(std::ceil(std::max({a.x(), b.x(), c.x()})), samples * width_ - 1);
  const int top = clamp(std::floor(std::min({a.y(), b.y(), c.y()})), samples * height_ - 1);
  const int bottom = clamp(std::ceil(std::max({a.y(), b.y(), c.y()})), samples * height_ - 1);
  for (int y = top; y <= bottom; ++y) {
    for (int x = left; x <= right; ++x) {
      const double px = x + 0.5;
      const double py = y + 0.5;
      const double u = ((px - a.x()) * (c.y() - a.y()) - (py - a.y()) * (c.x() - a.x())) / area;
      const double v = ((b.x() - a.x()) * (py - a.y()) - (b.y() - a.y()) * (px - a.x())) / area;
      if (u < 0 || v < 0 || u + v > 1) continue;
      sample(x, y, static_cast<float>(a.z() + u * (b.z() - a.z()) + v * (c.z() - a.z())), colour);
    }
  }
}

void Canvas::dot(const Vec3d& point, Colour colour) {
  constexpr int radius = 2 * samples;
  const Vec3d centre = project(point);
  for (int dy = -radius; dy <= radius; ++dy) {
    for (int dx = -radius; dx <= radius; ++dx) {
      const int x = static_cast<int>(centre.x()) + dx;
      const int y = static_cast<int>(centre.y()) + dy;
      if (dx * dx + dy * dy > radius * radius || x < 0 || y < 0 || x >= samples * width_ ||
          y >= samples * height_) {
        continue;
      }
      sample(x, y, static_cast<float>(centre.z()), colour);
    }
  }
}

void Canvas::sample(int x, int y, float depth, Colour colour) {
  const std::size_t at = static_cast<std::size_t>(y) * samples * width_ + x;
  if (depth <= depth_[at]) return;
  depth_[at] = depth;
  colour_[at] = colour;
  owner_[at] = body_;
}

bool Canvas::is_outline(int x, int y) const {
  const std::size_t row = static_cast<std::size_t>(samples) * width_;
  const std::size_t at = static_cast<std::size_t>(y) * row + x;
  const bool right = x + 1 < samples * width_ && owner_[at] != owner_[at + 1];
  const bool below = y + 1 < samples * height_ && owner_[at] != owner_[at + row];
  return right || below;
}

void Canvas::write_png(const std::filesystem::path& file) const {
  std::vector<std::uint8_t> pixels;
  pixels.reserve(static_cast<std::size_t>(width_) * height_ * 3);
  for (int y = 0; y < height_; ++y) {
    for (int x = 0; x < width_; ++x) {
      std::array<int, 3> sum{};
      for (int s = 0; s < samples * samples; ++s) {
        const int at_x = x * samples + s % samples;
        const int at_y = y * samples + s / samples;
        const Colour& own = colour_[static_cast<std::size_t>(at_y) * samples * width_ + at_x];
        const Colour c = is_outline(at_x, at_y) ? lit(own, outline_light) : own;
        sum[0] += c.red;
        sum[1] += c.green;
        sum[2] += c.blue;
      }
      for (const int value : sum) {
        pixels.push_back(static_cast<std::uint8_t>(value / (samples * samples)));
      }
    }
  }
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(width_);
  image.height = static_cast<png_uint_32>(height_);
  image.format = PNG_FORMAT_RGB;
  const auto expect = [&](int done) {
    if (done != 0) return;
    throw base::InputError(file.string(), 0, std::string("cannot be written: ") + image.message);
  };
  png_alloc_size_t size = 0;
  expect(png_image_write_to_memory(&image, nullptr, &size, 0, pixels.data(), 0, nullptr));
  std::vector<char> bytes(size);
  expect(png_image_write_to_memory(&image, bytes.data(), &size, 0, pixels.data(), 0, nullptr));
  files::OutputFile output(file);
  output.write({bytes.data(), size});
  output.close();
}

namespace {

constexpr int polytope_level = 2;

Colour colour_of(BodyState state) {
  switch (state) {
    case BodyState::apart: return {0x9a, 0xa0, 0xa6};
    case BodyState::possible: return {0xe8, 0xb0, 0x4a};
    case BodyState::overlapping: return {0xd2, 0x3c, 0x32};
  }
  return {128, 128, 128};
}

std::array<Vec3d, 8> corners(const Aabb& box) {
  std::array<Vec3d, 8> points;
  for (std::size_t i = 0; i < 8; ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      points[i][static_cast<int>(axis)] = (i >> axis & 1) == 0 ? box.min[axis] : box.max[axis];
    }
  }
  return points;
}

void draw_box(Canvas& canvas, const Aabb& box, Colour colour) {
  const std::array<Vec3d, 8> p = corners(box);
  constexpr std::size_t faces[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                       {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
  for (const auto& face : faces) {
    canvas.polygon(std::array{p[face[0]], p[face[1]], p[face[2]], p[face[3]]}, colour);
  }
}

void draw_hull(Canvas& canvas, const Hull& hull, const Pose& pose, Colour colour) {
  std::vector<Vec3d> loop;
  for (const Hull::Face& face : hull.faces) {
    loop.clear();
    for (const std::uint32_t vertex : face.loop) loop.push_back(pose(hull.vertices[vertex]));
    canvas.polygon(loop, colour);
  }
  if (!hull.faces.empty()) return;
  // Flat hulls have no faces, so every triangle of their few points is drawn.
  loop.clear();
  for (const Vec3d& vertex : hull.vertices) loop.push_back(pose(vertex));
  for (const Vec3d& point : loop) canvas.dot(point, colour);
  for (std::size_t i = 1; i + 1 < std::min<std::size_t>(loop.size(), 32); ++i) {
    for (std::size_t j = i + 1; j < std::min<std::size_t>(loop.size(), 32); ++j) {
      canvas.polygon(std::array{loop[0], loop[i], loop[j]}, colour);
    }
  }
}

void draw_mesh(Canvas& canvas, const geometry::Mesh& mesh, const Pose& pose, Colour colour) {
  for (const auto& [a, b, c] : mesh.triangles) {
    canvas.polygon(
        std::array{pose(mesh.vertices[a]), pose(mesh.vertices[b]), pose(mesh.vertices[c])}, colour);
  }
}

// Draws the part of a half-space's face around the other bodies.
void draw_halfspace(Canvas& canvas, const Shape& shape, const Pose& pose, const Vec3d& centre,
                    double reach, Colour colour) {
  const double length = shape.normal.stableNorm();
  const Vec3d normal = pose.rotation * shape.normal / length;
  const Vec3d on_face = pose.translation + normal * (shape.offset / length);
  const Vec3d middle = centre - normal * normal.dot(centre - on_face);
  const Vec3d u = normal.unitOrthogonal() * reach;
  const Vec3d v = normal.cross(u);
  canvas.polygon(
      std::array<Vec3d, 4>{middle - u - v, middle + u - v, middle + u + v, middle - u + v}, colour);
}

}  // namespace

void draw_scene(Canvas& canvas, const scene::Scene& scene, std::span<const Pose> poses,
                std::span<const Aabb> boxes, std::span<const BodyState> states) {
  const auto bounded = [&](std::size_t i) {
    return poses.empty() || scene.shapes[scene.bodies[i].shape].kind != ShapeKind::halfspace;
  };
  std::vector<Vec3d> points;
  Vec3d low = Vec3d::Constant(1e300);
  Vec3d high = -low;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    if (!bounded(i) || boxes[i].is_empty()) continue;
    for (const Vec3d& corner : corners(boxes[i])) {
      points.push_back(corner);
      low = low.cwiseMin(corner);
      high = high.cwiseMax(corner);
    }
  }
  if (points.empty()) low = high = Vec3d::Zero();
  canvas.fit(points);

  std::vector<Shape> drawn = scene.shapes;
  for (Shape& shape : drawn) {
    if (shape.kind != ShapeKind::halfspace) shape = geometry::as_polytope(shape, polytope_level);
  }
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const Colour colour = colour_of(states[i]);
    canvas.next_body();
    if (poses.empty()) {
      if (!boxes[i].is_empty()) draw_box(canvas, boxes[i], colour);
      continue;
    }
    const Shape& shape = drawn[scene.bodies[i].shape];
    if (shape.kind == ShapeKind::halfspace) {
      draw_halfspace(canvas, shape, poses[i], (low + high) / 2, (high - low).norm() / 2 + 1e-9,
                     colour);
    } else if (scene.concave_of(scene.bodies[i].shape) != nullptr) {
      draw_mesh(canvas, *scene.mesh_of(scene.bodies[i].shape), poses[i], colour);
    } else {
      draw_hull(canvas, *shape.hull, poses[i], colour);
    }
  }
}

}  // namespace touchstone::draw
