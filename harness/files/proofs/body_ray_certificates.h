// Certificates of rays at a body of many parts as JSON. The body, as in cases (concave_json.h), comes before
// the rays at it:
//   {"body":BODY}
//   {"ray":0, "task":"closest", "origin":[x,y,z], "direction":[x,y,z], "t_max":"inf", "answer":"hit",
//    "lower":["1","3"], "upper":["1","2"], "part":5, "generators":[0, ...],
//    "surface":{"points":[[0,0], ...], "triangles":[[0,1,2], ...]}, "order":[0, ...],
//    "cover":["halve", ["1","0","0"], "own", "triangle"]}
// A step of the cover that is three integers is a plane. The other forms are those of certificates.h.
#pragma once

#include <cstdint>
#include <string>

#include "algorithms/core/mesh/concave_body.h"
#include "algorithms/core/pose.h"
#include "algorithms/oracle/certificates/parts/body_ray_certificate.h"
#include "harness/files/json_line.h"

namespace touchstone::files {

struct StoredBodyRayCertificate {
  std::uint64_t ray = 0;  // its number in the file of rays
  oracle::BodyRayCertificate certificate;
};

// One line each, without the line break, that read_ray_certificates turns into the same bits. Numbers must be
// finite, but for t_max.
std::string body_line(const ConcaveBody& body, const Pose& pose);
std::string to_json(const StoredBodyRayCertificate& certificate);

// Throws InputError with the place of what is malformed.
StoredBodyRayCertificate read_body_ray(const JsonNode& line);

}  // namespace touchstone::files
