// Certificates of rays at scenes, and of rays and points at meshes, as JSON, one object a line.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "algorithms/core/mesh/concave_body.h"
#include "algorithms/core/mesh/triangle_mesh.h"
#include "algorithms/core/pose.h"
#include "algorithms/oracle/certificates/parts/mesh_certificates.h"
#include "algorithms/oracle/certificates/parts/scene_ray_certificate.h"
#include "harness/files/json_line.h"

namespace touchstone::files {

// Certificates of rays at scenes as JSON. The bodies, as in cases (concave_cases.h), come before the rays at them:
//   {"bodies":[BODY, ...]}
//   {"ray":0, "task":"closest", "origin":[x,y,z], "direction":[x,y,z], "t_max":"inf", "ordered":true,
//    "answer":"hit", "lower":["1","3"], "upper":["1","2"], "body":1, "part":5, "generators":[0, ...],
//    "surface":{"points":[[0,0], ...], "triangles":[[0,1,2], ...]},
//    "cover":{"order":[1,0], "steps":["halve", ["1","0","0"], "body"]},
//    "of_bodies":[{"order":[0, ...], "steps":["halve", ["1","0","0"], "own", "triangle"]}]}
// "ordered" is false for a first hit of which nothing shows that no other part is hit before it, in the bracket. A step
// that is three integers is a plane. The other forms are those of certificates.h.

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

// Certificates of rays and points at a mesh as JSON, one object a line. A mesh comes before the rays or the points at
// it, and there may be several:
//   {"mesh":{"type":"mesh", "vertices":[[x,y,z], ...], "triangles":[[i,j,k], ...], "solid":false}}
//   {"ray":0, "task":"closest", "origin":[x,y,z], "direction":[x,y,z], "t_max":"inf", "hit":true,
//    "triangle":5, "t":["1","2"]}
//   {"point":0, "at":[x,y,z], "claim":"nearest", "triangle":5, "square":["1","4"]}
//   {"point":1, "at":[x,y,z], "claim":"inside", "winding":1}
//   {"point":2, "at":[x,y,z], "claim":"surface"}
// A miss has neither triangle nor t, and the nearest of an empty mesh neither triangle nor square. t and the
// squared distance are fractions of two integers; t_max is a number or "inf".

struct StoredRayCertificate {
  std::uint64_t ray = 0;  // its number in the file of rays
  oracle::RayCertificate certificate;
};
struct StoredPointCertificate {
  std::uint64_t point = 0;
  oracle::PointCertificate certificate;
};

// One line each, without the line break, that the functions below turn into the same bits. Numbers must be
// finite, but for t_max.
std::string mesh_line(const TriangleMesh& mesh);
std::string to_json(const StoredRayCertificate& certificate);
std::string to_json(const StoredPointCertificate& certificate);

// What is done with each mesh and scene in a file, and with each certificate of a ray at the one before it.
struct RayTargets {
  std::function<void(const TriangleMesh&)> mesh;
  std::function<void(const StoredRayCertificate&, std::int64_t line)> at_mesh;
  std::function<void(std::vector<PlacedConcave>)> scene;
  std::function<void(const StoredSceneRayCertificate&, std::int64_t line)> at_scene;
};

// Call these, in order. Throw InputError with file, line, key and the expected value for what is malformed, and for a
// certificate before any mesh or scene; certificates before that were valid. They do not check whether a certificate
// proves anything.
void read_ray_certificates(const std::filesystem::path& file, const RayTargets& targets);
void read_point_certificates(
    const std::filesystem::path& file, const std::function<void(const TriangleMesh&)>& mesh,
    const std::function<void(const StoredPointCertificate&, std::int64_t line)>& each);

}  // namespace touchstone::files
