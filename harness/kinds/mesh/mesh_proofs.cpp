// Makes and verifies certificates of pairs of bodies.
#include "harness/kinds/mesh/mesh_kind.h"

#include <fmt/format.h>

#include <memory>
#include <utility>

#include "algorithms/oracle/certificates/parts/parts_certificate_check.h"
#include "algorithms/oracle/concave/exact_parts_proofs.h"
#include "harness/files/parts_certificates.h"
#include "harness/kinds/proofs.h"

namespace touchstone::kinds {
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

Proving parts_proving(ConcaveTask task, std::vector<files::ConcaveCase> cases) {
  const auto all = std::make_shared<const std::vector<files::ConcaveCase>>(std::move(cases));
  const auto prove = [task, all](std::size_t item) {
    const files::ConcaveCase& c = (*all)[item];
    return files::to_json(files::StoredPartsCertificate{
        c, oracle::prove_parts(claim_of(task), c.a, c.pose_a, c.b, c.pose_b)});
  };
  return {{},
          all->size(),
          [prove] { return prove; },
          [all](std::size_t item) { return fmt::format("case '{}'", (*all)[item].id); }};
}

bool verify_mesh_proofs(const std::string& proofs, const std::filesystem::path& file) {
  AskedCases asked;
  if (!file.empty()) {
    for (const files::ConcaveCase& c : files::read_concave_cases(file)) asked.add(to_json(c));
  }
  Verdicts verdicts(proofs);
  return verdicts.of([&] {
    files::read_parts_certificates(
        proofs, [&](const files::StoredPartsCertificate& stored, std::int64_t line) {
          const files::ConcaveCase& of = stored.of;
          std::string why = asked.fault(to_json(of));
          if (why.empty()) {
            why = oracle::fault(stored.certificate, {of.a, of.pose_a}, {of.b, of.pose_b});
          }
          verdicts.add(line, of.id, why);
        });
  });
}

}  // namespace touchstone::kinds
