// Reads the published results of a campaign file.
#include "harness/stats/published.h"

#include <utility>

#include "harness/files/toml_table.h"

namespace touchstone::stats {
namespace {

void read_claims(files::TomlTable& published, std::string_view key, PublishedClaim::Kind kind,
                 std::vector<PublishedClaim>& claims) {
  if (!published.has(key)) return;
  for (files::TomlTable& table : published.tables(key)) {
    PublishedClaim claim;
    claim.kind = kind;
    claim.algorithm = table.text("algorithm");
    claim.scene = table.text("scene", "");
    claim.pair_kind = table.text("pair_kind", "");
    if (kind == PublishedClaim::Kind::faster) claim.than = table.text("than");
    if (kind == PublishedClaim::Kind::iterations) {
      claim.mean = table.number("mean", files::positive);
      claim.deviation = table.number("deviation", files::not_negative);
      claim.uncounted = table.integer("uncounted", 0, 1000, 0);
    }
    table.finish();
    claims.push_back(std::move(claim));
  }
}

}  // namespace

Published read_published(files::TomlTable& campaign) {
  Published published;
  if (!campaign.has("published")) return published;
  files::TomlTable table = campaign.inside("published", "published");
  published.source = table.text("source");
  published.note = table.text("note", "");
  read_claims(table, "iterations", PublishedClaim::Kind::iterations, published.claims);
  read_claims(table, "faster", PublishedClaim::Kind::faster, published.claims);
  read_claims(table, "suffices", PublishedClaim::Kind::suffices, published.claims);
  table.finish();
  return published;
}

}  // namespace touchstone::stats
