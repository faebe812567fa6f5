// Draws a frame of a scene as a picture of triangles in space. Used by the command `scene draw`.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "algorithms/core/pose.h"
#include "algorithms/core/vec.h"
#include "harness/scene/scene.h"

namespace touchstone::draw {

struct Colour {
  std::uint8_t red, green, blue;
};

// An orthographic view along `direction` (towards the scene); the world's z axis points up in the
// picture.
struct View {
  Vec3d right, up, towards;  // orthonormal; `towards` points from the scene to the eye
  explicit View(const Vec3d& direction);
};

// A depth-buffered picture with four samples per pixel. `fit` must be called first; it fits world
// coordinates in metres into the picture.
class Canvas {
 public:
  Canvas(int width, int height, const View& view);

  // Scales and shifts so that all these points are inside, with a margin.
  void fit(std::span<const Vec3d> points);
  // Starts another body. Outlines are drawn where two bodies are adjacent in the picture.
  void next_body() { ++body_; }
  // A flat convex polygon in world coordinates, with corners anticlockwise seen from outside.
  void polygon(std::span<const Vec3d> corners, Colour colour);
  // A ball of a few pixels, for bodies without visible faces.
  void dot(const Vec3d& point, Colour colour);

  // Writes a PNG, whole or not at all. Throws InputError if it cannot be written.
  void write_png(const std::filesystem::path& file) const;

 private:
  Vec3d project(const Vec3d& point) const;  // x, y in samples; greater z is nearer
  void triangle(const Vec3d& a, const Vec3d& b, const Vec3d& c, Colour colour);
  void sample(int x, int y, float depth, Colour colour);
  bool is_outline(int x, int y) const;

  int width_, height_;  // pixels
  View view_;
  double scale_ = 1;
  Vec3d centre_ = Vec3d::Zero();
  std::vector<float> depth_;
  std::vector<Colour> colour_;
  std::vector<std::uint32_t> owner_;  // the body that each sample shows; 0: none
  std::uint32_t body_ = 0;
};

// The state of a body after both phases.
enum class BodyState : std::uint8_t {
  apart,        // its box overlaps no other: certainly apart
  possible,     // the broad phase reports it in a pair; the narrow phase finds it apart from all
  overlapping,  // the narrow phase finds it in contact
};

// Colours bodies by their state, as the page does: apart grey, possible amber, overlapping red.
// Curved shapes are drawn as polytopes, a half-space as its face near the other bodies. A recording
// has no bodies: `poses` is empty and the boxes are drawn.
void draw_scene(Canvas& canvas, const scene::Scene& scene, std::span<const Pose> poses,
                std::span<const Aabb> boxes, std::span<const BodyState> states);

}  // namespace touchstone::draw
