// Certificates of two bodies of many parts as JSON, one object a line, each with its two bodies as in cases
// (concave_cases.h):
//   {"id":"x", "a":BODY, "b":BODY, "claim":"intersect", "answer":"overlapping", "bounds":[0.25,0.5], "undecided":0,
//    "order_a":[0,1], "order_b":[0], "cover":["a", ["1","0","0"], "own", "meet", "open"],
//    "met":[{"parts":[0,0], "generators_a":[GENERATOR, ...], "generators_b":[...], "closest":[[0,0,"1"]],
//            "surface":{"points":[], "triangles":[]}}],
//    "inside":{"body":"a", "part":0, "surface":0}}
// A step of the cover is "a" or "b", whose node is halved, the direction of a plane, "own" for that of the
// half-space, "meet" or "open". "bounds" and "inside" are null where there are none. The other forms are those
// of certificates.h.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "algorithms/oracle/certificates/parts/parts_certificate.h"
#include "harness/files/concave_cases.h"

namespace touchstone::files {

struct StoredPartsCertificate {
  ConcaveCase of;
  oracle::PartsCertificate certificate;
};

// One line, without the line break, that read_parts_certificates turns into the same bits. Numbers must be finite.
std::string to_json(const StoredPartsCertificate& certificate);

// Calls `each` for each certificate with its line, in order. Throws InputError with file, line, key and the
// expected value for all that read_concave_cases rejects and for what is malformed; certificates before that
// were valid. Does not check whether a certificate proves anything.
void read_parts_certificates(
    const std::filesystem::path& file,
    const std::function<void(const StoredPartsCertificate& certificate, std::int64_t line)>& each);

}  // namespace touchstone::files
