// Certificates of rays at scenes as JSON. The bodies, as in cases (concave_json.h), come before the rays at them:
//   {"bodies":[BODY, ...]}
//   {"ray":0, "task":"closest", "origin":[x,y,z], "direction":[x,y,z], "t_max":"inf", "ordered":true,
//    "answer":"hit", "lower":["1","3"], "upper":["1","2"], "body":1, "part":5, "generators":[0, ...],
//    "surface":{"points":[[0,0], ...], "triangles":[[0,1,2], ...]},
//    "cover":{"order":[1,0], "steps":["halve", ["1","0","0"], "body"]},
//    "of_bodies":[{"order":[0, ...], "steps":["halve", ["1","0","0"], "own", "triangle"]}]}
// "ordered" is false for a first hit of which nothing shows that no other part is hit before it, in the bracket. A step
// that is three integers is a plane. The other forms are those of certificates.h.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "algorithms/core/mesh/concave_body.h"
#include "algorithms/core/pose.h"
#include "algorithms/oracle/certificates/parts/scene_ray_certificate.h"
#include "harness/files/json_line.h"

namespace touchstone::files {

// A body of a scene at its place.
struct PlacedConcave {
  ConcaveBody body;
  Pose pose;
};

struct StoredSceneRayCertificate {
  std::uint64_t ray = 0;  // its number in the file of rays
  oracle::SceneRayCertificate certificate;
};

// One line each, without the line break, that read_ray_certificates turns into the same bits. Numbers must be
// finite, but for t_max.
std::string scene_line(std::span<const PlacedConcave> bodies);
std::string to_json(const StoredSceneRayCertificate& certificate);

// Throws InputError with the place of what is malformed.
std::vector<PlacedConcave> read_scene_line(const JsonNode& line);
StoredSceneRayCertificate read_scene_ray(const JsonNode& line);

}  // namespace touchstone::files
