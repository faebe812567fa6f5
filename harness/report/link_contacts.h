// Which links of a robot touch each other and the world, over many configurations.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "harness/scene/robot/robot.h"
#include "harness/scene/scene.h"

namespace touchstone::report {

struct LinkPair {
  std::string first,
      second;  // a link, and a link or an obstacle; a body without a name is "body N"
  bool is_of_links = false;
  std::size_t touching = 0, unknown = 0;  // configurations
  bool is_disabled = false;               // by SRDF
};

struct LinkContacts {
  std::size_t configurations = 0;
  // Configurations in which no pair touches but disabled ones, and those of which it is not known.
  std::size_t free = 0, unknown = 0;
  std::vector<LinkPair> pairs;  // all that are asked, and disabled ones; sorted by their bodies
};

// Asks `certified` about convex bodies and `fused` about others, in a child process: a frame that crashes or takes longer
// than the limit (seconds) is unknown. The first bodies of `scene` are the shapes of this robot's links, as import_robot
// makes them.
LinkContacts link_contacts(const scene::Scene& scene, const scene::Robot& robot, double time_limit);

}  // namespace touchstone::report
