// Writes and verifies files of certificates.
#include "harness/check/certificate_files.h"

#include <algorithm>
#include <optional>

#include "algorithms/oracle/certificates/certificate_check.h"
#include "harness/check/check_report.h"
#include "harness/files/certificates.h"
#include "harness/files/output_file.h"
#include "harness/process/worker_pool.h"

namespace touchstone::check {
namespace {

oracle::Body body_of(const oracle::Solid& solid, const Pose& pose,
                     const std::optional<std::array<double, 4>>& quaternion) {
  return quaternion ? oracle::Body(solid, *quaternion, pose.translation)
                    : oracle::Body(solid, pose);
}

}  // namespace

std::int64_t save_certificates(const CheckRequest& request, const std::filesystem::path& file) {
  const CheckReport report(request);
  files::OutputFile output(file);
  std::int64_t saved = 0;
  process::run_jobs(
      0, request.period(), request.workers,
      [&] { return [&](std::size_t family) { return report.certificates(family); }; },
      [&](std::size_t, const std::string& lines) {
        output.write(lines);
        saved += std::ranges::count(lines, '\n');
        return true;
      });
  output.close();
  return saved;
}

void verify_certificates(const std::filesystem::path& file, kinds::Verdicts& verdicts) {
  files::read_certificates(file, [&](const files::StoredCertificate& stored, std::int64_t line) {
    const oracle::Solid a(stored.shape_a), b(stored.shape_b);
    verdicts.add(line, stored.id,
                 oracle::fault(stored.certificate, body_of(a, stored.pose_a, stored.quaternion_a),
                               body_of(b, stored.pose_b, stored.quaternion_b)));
  });
}

}  // namespace touchstone::check
