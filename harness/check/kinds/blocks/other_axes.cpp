// Lists the values of axes.
#include "harness/check/kinds/blocks/other_axes.h"

#include "harness/check/kinds/blocks/drawn_cases.h"

namespace touchstone::check {

std::vector<AxisPlace<double>> ray_axis() {
  std::vector<AxisPlace<double>> places;
  for (const AxisValue& at : decades(0, 15)) places.push_back({"ray-distance", at.name, at.value});
  return places;
}

std::vector<AxisPlace<double>> scene_ray_axis() {
  std::vector<AxisPlace<double>> places;
  for (const AxisValue& at : decades(0, 15)) {
    places.push_back({"scene-ray-distance", at.name, at.value});
  }
  return places;
}

std::vector<AxisPlace<double>> point_axis() {
  std::vector<AxisPlace<double>> places;
  for (const AxisValue& at : decades(0, -17)) places.push_back({"point-gap", at.name, at.value});
  return places;
}

std::vector<AxisPlace<families::CcdFamily>> ccd_axes() {
  std::vector<AxisPlace<families::CcdFamily>> places;
  for (const FeaturePair pair : {FeaturePair::vertex_face, FeaturePair::edge_edge}) {
    const auto add = [&](const char* axis, int first, int last, const auto& make) {
      for (const AxisValue& at : decades(first, last)) {
        const std::string name = std::string(to_string(pair)) + "-" + axis;
        places.push_back({name, at.name, {name + "-" + at.name, pair, make(at.value)}});
      }
    };
    const auto motion = [pair](double reach) {
      return [=](families::Draws& draws) { return families::motion_query(pair, reach, draws); };
    };
    add("speed", 0, 12, motion);
    add("slowness", 0, -15, motion);
    add("distance", 0, 15, [pair](double distance) {
      return [=](families::Draws& draws) {
        return families::changed(families::contact_query(pair, draws), 1, distance);
      };
    });
  }
  return places;
}

}  // namespace touchstone::check
