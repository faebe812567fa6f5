// Certificates of the oracle as JSON, one object per line, each with its two bodies:
//   {"id":"x", "encoding":"matrix64", "a":BODY, "b":BODY, "answer":"separated", "lower":ROOT,
//    "upper":ROOT, "direction":["1","0","0"], "generators_a":[GENERATOR, ...],
//    "generators_b":[...], "closest":[[0,0,"1"], ...],
//    "surface":{"points":[[0,0], ...], "triangles":[[0,1,2], ...]}}
// A body is written as in cases: with a rotation matrix that is taken literally, or with
// "quaternion_exact":[w,x,y,z], which means its rotation matrix divided by its square, exactly. A
// root is {"sign":1, "numerator":"1", "denominator":"4"}. A generator is the index of a vertex or a
// point ["0x1p+0","0x0p+0","0x0p+0"]. Integers are decimal, in strings if they may be large.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "algorithms/core/pose.h"
#include "algorithms/core/shape.h"
#include "algorithms/oracle/certificates/cast_certificate.h"
#include "algorithms/oracle/certificates/certificate.h"
#include "harness/files/cases.h"

namespace touchstone::files {

struct StoredCertificate {
  std::string id;
  std::string encoding;  // of the numbers from which the bodies were made; informative
  Shape shape_a, shape_b;
  Pose pose_a, pose_b;
  // If a quaternion is set, the rotation of the pose is unused and not stored.
  std::optional<std::array<double, 4>> quaternion_a, quaternion_b;
  oracle::Certificate certificate;
};

// One line, without the line break, that read_certificates turns into the same bits. Numbers must
// be finite.
std::string to_json(const StoredCertificate& certificate);

// Calls `each` for each certificate with its line, in order, so that a file may have any size.
// Throws InputError with file, line, key and the expected value for all that read_cases rejects,
// and for a malformed index, integer or point; certificates before that were valid. Does not check
// whether a certificate proves anything.
void read_certificates(
    const std::filesystem::path& file,
    const std::function<void(const StoredCertificate& certificate, std::int64_t line)>& each);

// Certificates of casts as JSON, one object per line, each with its two bodies as in cases for `cast`:
//   {"id":"x", "a":BODY, "b":BODY, "answer":"hit", "lower":TIME, "upper":TIME,
//    "planes":[{"until":TIME, "direction":["1","0","0"]}, ...], "generators_a":[GENERATOR, ...],
//    "generators_b":[...], "closest":[[0,0,"1"], ...], "surface":{"points":[], "triangles":[]},
//    "feature":[[0,0], ...], "polynomial":["1","0","-4"]}
// TIME is a fraction of two integers, ["1","2"]; the other forms are those of certificates.h.

struct StoredCastCertificate {
  CastCase of;
  oracle::CastCertificate certificate;
};

// One line, without the line break, that read_cast_certificates turns into the same bits. Numbers must be
// finite.
std::string to_json(const StoredCastCertificate& certificate);

// Calls `each` for each certificate with its line, in order. Throws InputError with file, line, key and the
// expected value for all that read_cast_cases rejects and for what is malformed; certificates before
// that were valid. Does not check whether a certificate proves anything.
void read_cast_certificates(
    const std::filesystem::path& file,
    const std::function<void(const StoredCastCertificate& certificate, std::int64_t line)>& each);

}  // namespace touchstone::files
