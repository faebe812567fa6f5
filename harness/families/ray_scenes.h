// Scenes of bodies of all kinds, and rays at them.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "algorithms/scene_ray_cast.h"
#include "harness/families/draws.h"

namespace touchstone::families {

enum class RayScene : std::uint8_t {
  mixed,  // all convex kinds, meshes, compounds and a half-space, turned; rays from around at points of them
  inside,      // rays that begin in bodies
  short_rays,  // rays that end near the bodies
  axis,        // rays along an axis, with zeros of either sign
  far,         // rays from a hundred kilometres
  on_a_grid,   // bodies on a grid, turned by quarters, and rays along its lines and diagonals
  crowd,       // many small bodies
  coincident,  // each body several times in one place
};
inline constexpr std::array all_ray_scenes = {
    RayScene::mixed, RayScene::inside,    RayScene::short_rays, RayScene::axis,
    RayScene::far,   RayScene::on_a_grid, RayScene::crowd,      RayScene::coincident};

std::string_view to_string(RayScene scene);

// The bodies, each with a part. Translations are multiples of 2^-10.
std::vector<SceneBody> bodies_of(RayScene scene, Draws& draws);

// A ray at them, whose origin and target are multiples of 2^-10 as well. The direction is not zero.
Ray ray_at(RayScene scene, std::span<const SceneBody> bodies, Draws& draws);

// A ray at such a target from so far away (metres).
Ray ray_from(double distance, std::span<const SceneBody> bodies, Draws& draws);

}  // namespace touchstone::families
