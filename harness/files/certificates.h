// Certificates of the oracle as JSON, one object a line, each with its two bodies:
//   {"id":"x", "encoding":"matrix64", "a":BODY, "b":BODY, "answer":"separated", "lower":ROOT,
//    "upper":ROOT, "direction":["1","0","0"], "generators_a":[GENERATOR, ...],
//    "generators_b":[...], "closest":[[0,0,"1"], ...],
//    "surface":{"points":[[0,0], ...], "triangles":[[0,1,2], ...]}}
// A body is written as in cases, so with a rotation matrix that is used as it stands, or with
// "quaternion_exact":[w,x,y,z], whose rotation matrix over its square is meant exactly. A root is
// {"sign":1, "numerator":"1", "denominator":"4"}. A generator is the number of a vertex or a point
// ["0x1p+0","0x0p+0","0x0p+0"]. Integers are decimal, in strings where they may be great.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "algorithms/core/pose.h"
#include "algorithms/core/shape.h"
#include "algorithms/oracle/certificates/certificate.h"

namespace touchstone {

struct StoredCertificate {
  std::string id;
  std::string encoding;  // of the numbers that the bodies were made of; for the reader of the file
  Shape shape_a, shape_b;
  Pose pose_a, pose_b;
  // Where one is there the rotation of the pose means nothing, and is not kept.
  std::optional<std::array<double, 4>> quaternion_a, quaternion_b;
  oracle::Certificate certificate;
};

// One line, without the line break, that read_certificates turns into the same bits. Numbers are
// finite.
std::string to_json(const StoredCertificate& certificate);

// Hands out each certificate, with its line, in order, so that a file may be of any size. Throws
// InputError naming file, line, key and what was expected, for all that read_cases refuses and for
// a number that is no index, integer or point; what was handed out until then was good. Whether a
// certificate proves anything is not looked at.
void read_certificates(
    const std::filesystem::path& file,
    const std::function<void(const StoredCertificate& certificate, std::int64_t line)>& each);

}  // namespace touchstone
