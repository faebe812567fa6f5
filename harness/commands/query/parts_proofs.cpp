// Saves and verifies certificates of pairs of bodies.
#include "harness/commands/query/parts_proofs.h"

#include <fmt/format.h>

#include "algorithms/oracle/certificates/parts/parts_certificate_check.h"
#include "algorithms/oracle/concave/exact_parts_proofs.h"
#include "harness/commands/query/proofs.h"
#include "harness/files/proofs/parts_certificates.h"

namespace touchstone::commands {
namespace {

using oracle::PartsCertificate;

PartsCertificate::Claim claim_of(ConcaveTask task) {
  switch (task) {
    case ConcaveTask::distance: return PartsCertificate::Claim::distance;
    case ConcaveTask::contacts: return PartsCertificate::Claim::contacts;
    default: return PartsCertificate::Claim::intersect;
  }
}

}  // namespace

void save_parts_proofs(const std::string& file, ConcaveTask task,
                       const std::vector<files::ConcaveCase>& cases, double seconds) {
  SavedCertificates saved(file);
  const auto prove = [&](std::size_t item) {
    const files::ConcaveCase& c = cases[item];
    return files::to_json(files::StoredPartsCertificate{
        c, oracle::prove_parts(claim_of(task), c.a, c.pose_a, c.b, c.pose_b)});
  };
  saved.add_each(
      cases.size(), seconds, [&] { return prove; },
      [&](std::size_t item) { return fmt::format("case '{}'", cases[item].id); });
  saved.close();
}

int verify_parts_proofs(const std::string& file, const std::string& cases) {
  AskedCases asked;
  if (!cases.empty()) {
    for (const files::ConcaveCase& c : files::read_concave_cases(cases)) asked.add(to_json(c));
  }
  Verdicts verdicts(file);
  return verdicts.of([&] {
    files::read_parts_certificates(
        file, [&](const files::StoredPartsCertificate& stored, std::int64_t line) {
          const files::ConcaveCase& of = stored.of;
          std::string why = asked.fault(to_json(of));
          if (why.empty()) {
            why = oracle::fault(stored.certificate, {of.a, of.pose_a}, {of.b, of.pose_b});
          }
          verdicts.add(line, of.id, why);
        });
  });
}

}  // namespace touchstone::commands
