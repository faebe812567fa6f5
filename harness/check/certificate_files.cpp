// Writes and verifies files of certificates.
#include "harness/check/certificate_files.h"

#include <fmt/format.h>

#include <memory>
#include <optional>

#include "algorithms/oracle/certificates/certificate_check.h"
#include "algorithms/oracle/oracle.h"
#include "harness/files/certificates.h"
#include "harness/files/output_file.h"
#include "harness/process/worker_pool.h"

namespace touchstone::check {
namespace {

constexpr std::size_t most_told = 1000;

files::StoredCertificate prove(const files::Case& c, oracle::Oracle& oracle) {
  files::StoredCertificate stored;
  stored.id = c.id;
  stored.encoding = to_string(Encoding::as_given);
  stored.shape_a = c.shape_a;
  stored.shape_b = c.shape_b;
  stored.pose_a = c.pose_a;
  stored.pose_b = c.pose_b;
  const oracle::Solid a(c.shape_a), b(c.shape_b);
  oracle.prove({a, c.pose_a}, {b, c.pose_b}, stored.certificate);
  return stored;
}

oracle::Body body_of(const oracle::Solid& solid, const Pose& pose,
                     const std::optional<std::array<double, 4>>& quaternion) {
  return quaternion ? oracle::Body(solid, *quaternion, pose.translation)
                    : oracle::Body(solid, pose);
}

}  // namespace

std::int64_t save_certificates(const CheckRequest& request, const std::filesystem::path& file) {
  files::OutputFile output(file);
  std::int64_t saved = 0;
  process::run_jobs<std::string>(
      0, request.regimes.size(), request.workers,
      [&] {
        const auto oracle = std::make_shared<oracle::Oracle>();
        return [&request, oracle](std::size_t job) {
          std::string lines;
          for (int index = 0; index < request.cases; ++index) {
            const files::Case c =
                make(*request.regimes[job], request.seed, static_cast<std::uint64_t>(index));
            lines += files::to_json(prove(c, *oracle)) + '\n';
          }
          return lines;
        };
      },
      [&](std::size_t, const std::string& lines) {
        output.write(lines);
        saved += request.cases;
        return true;
      });
  output.close();
  return saved;
}

void verify_certificates(const std::filesystem::path& file, CertificateVerdicts& verdicts) {
  files::read_certificates(file, [&](const files::StoredCertificate& stored, std::int64_t line) {
    const oracle::Solid a(stored.shape_a), b(stored.shape_b);
    const std::string why =
        oracle::fault(stored.certificate, body_of(a, stored.pose_a, stored.quaternion_a),
                      body_of(b, stored.pose_b, stored.quaternion_b));
    if (why.empty()) {
      ++verdicts.verified;
      return;
    }
    ++verdicts.refused_count;
    if (verdicts.refused.size() < most_told) {
      verdicts.refused.push_back(fmt::format("{}:{}: {}: {}", file.string(), line, stored.id, why));
    }
  });
}

}  // namespace touchstone::check
