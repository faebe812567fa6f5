// Reads and writes facts.
#include "harness/record/facts.h"

#include <algorithm>

namespace touchstone::record {

Facts read_facts(const std::filesystem::path& file) {
  Facts facts;
  files::CsvReader(file, {"name", "value"}).read([&](const files::CsvReader::Row& row) {
    facts.emplace_back(row.text(0), row.text(1));
  });
  return facts;
}

void write_facts(const std::filesystem::path& file, const Facts& facts,
                 files::CsvWriter::Durable durable) {
  files::CsvWriter csv(file, {"name", "value"});
  for (const auto& [name, value] : facts) csv.field(name).field(value).end_row();
  csv.close(durable);
}

std::string value_of(const Facts& facts, std::string_view name) {
  const auto at = std::ranges::find(facts, name, &Facts::value_type::first);
  return at == facts.end() ? "" : at->second;
}

}  // namespace touchstone::record
