// The axes of stress of rays, points and continuous collision.
#pragma once

#include <string>
#include <vector>

#include "harness/families/ccd_families.h"

namespace touchstone::check {

// A value of an axis, and what it stands for: a distance in metres, or a family.
template <class Of>
struct AxisPlace {
  std::string axis, value;
  Of of;
};

std::vector<AxisPlace<double>> ray_axis();        // from how far rays are cast
std::vector<AxisPlace<double>> scene_ray_axis();  // from how far they are cast at scenes
std::vector<AxisPlace<double>> point_axis();      // how far points are from the surface
std::vector<AxisPlace<families::CcdFamily>> ccd_axes();

}  // namespace touchstone::check
