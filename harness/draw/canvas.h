// A picture of triangles in space.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "algorithms/core/vec.h"

namespace touchstone {

struct Colour {
  std::uint8_t red, green, blue;
};

// An orthographic view along `direction` (towards the scene) with the world's z upward in the
// picture.
struct View {
  Vec3d right, up, towards;  // orthonormal; `towards` points from the scene to the eye
  explicit View(const Vec3d& direction);
};

// Depth-buffered, with four samples a pixel. World coordinates in metres are fitted into the
// picture by `fit`, which comes first.
class Canvas {
 public:
  Canvas(int width, int height, const View& view);

  // Scales and shifts so that all these points are inside, with a margin.
  void fit(std::span<const Vec3d> points);
  // What is drawn from here on belongs to another body: an outline is drawn where bodies meet in
  // the picture.
  void next_body() { ++body_; }
  // A flat convex polygon in world coordinates, its corners anticlockwise seen from outside.
  void polygon(std::span<const Vec3d> corners, Colour colour);
  // A ball of a few pixels, for what has no face that could be seen.
  void dot(const Vec3d& point, Colour colour);

  // Writes a PNG, whole or not at all. InputError where it cannot be written.
  void write_png(const std::filesystem::path& file) const;

 private:
  Vec3d project(const Vec3d& point) const;  // x, y in samples; z greater is nearer
  void triangle(const Vec3d& a, const Vec3d& b, const Vec3d& c, Colour colour);
  void sample(int x, int y, float depth, Colour colour);
  bool is_outline(int x, int y) const;

  int width_, height_;  // in pixels
  View view_;
  double scale_ = 1;
  Vec3d centre_ = Vec3d::Zero();
  std::vector<float> depth_;
  std::vector<Colour> colour_;
  std::vector<std::uint32_t> owner_;  // the body that each sample shows; 0: none
  std::uint32_t body_ = 0;
};

}  // namespace touchstone
