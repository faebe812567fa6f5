// Certificates of casts as JSON, one object per line, each with its two bodies as in cases for `cast`:
//   {"id":"x", "a":BODY, "b":BODY, "answer":"hit", "lower":TIME, "upper":TIME,
//    "planes":[{"until":TIME, "direction":["1","0","0"]}, ...], "generators_a":[GENERATOR, ...],
//    "generators_b":[...], "closest":[[0,0,"1"], ...], "surface":{"points":[], "triangles":[]},
//    "feature":[[0,0], ...], "polynomial":["1","0","-4"]}
// TIME is a fraction of two integers, ["1","2"]; the other forms are those of certificates.h.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "algorithms/oracle/certificates/cast_certificate.h"
#include "harness/files/cases.h"

namespace touchstone::files {

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
