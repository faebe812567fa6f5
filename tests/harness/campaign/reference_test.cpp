// Compares the committed reference with the answers of this program, without a clock.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <map>
#include <utility>

#include "harness/campaign/runner.h"
#include "harness/stats/comparison.h"
#include "tests/harness/temporary_folder.h"
#include "tests/project_folder.h"

namespace touchstone {
namespace {

// TOUCHSTONE_REFERENCE names another folder of results.
std::filesystem::path reference_folder() {
  const char* const other = std::getenv("TOUCHSTONE_REFERENCE");
  return other != nullptr ? std::filesystem::path(other)
                          : std::filesystem::path(project_folder) / "results" / "reference";
}

stats::Results answers_now(const campaign::Campaign& campaign, const std::filesystem::path& file) {
  files::CsvWriter csv(file, record::header_of<record::RawRow>());
  const record::Findings findings = campaign::check_campaign(campaign);
  for (const record::RawRow& row : findings.rows()) record::write_row(csv, row);
  csv.close();
  return stats::read_results(file);
}

// Returns frames of algorithms of ours whose outcomes have another hash.
std::vector<std::string> changed_outcomes(const stats::Results& stated,
                                          const stats::Results& here) {
  std::vector<std::string> changed;
  for (const stats::SampleSet& set : here.sets) {
    const stats::SampleSet* const there = stated.find(set.key);
    if (there == nullptr) continue;
    for (const stats::Contestant& contestant : set.contestants) {
      const stats::Contestant* const before = there->find(contestant.label);
      if (before == nullptr || !contestant.is_ours()) continue;
      std::map<std::pair<std::int64_t, record::Phase>, std::string> hashes;
      for (const stats::Check& check : before->checks) {
        hashes[{check.frame, check.phase}] = check.outcome_hash;
      }
      for (const stats::Check& check : contestant.checks) {
        if (hashes[{check.frame, check.phase}] == check.outcome_hash) continue;
        changed.push_back(fmt::format("{} in {}, frame {}: outcome hash", contestant.label,
                                      set.key.words(), check.frame));
        break;
      }
    }
  }
  return changed;
}

// The committed reference is measured again whenever this fails for a change that is meant.
TEST(Reference, HasTheAnswersOfThisProgram) {
  const stats::Results stated = stats::read_results(reference_folder());
  const campaign::Campaign campaign =
      campaign::read_campaign(std::filesystem::path(project_folder) / "datasets" / "campaigns" /
                              (stated.campaign + ".toml"));
  const TemporaryFolder folder;
  const stats::Results here = answers_now(campaign, folder.path() / "raw.csv");
  const stats::ResultNames names = {"the reference", "this program"};
  EXPECT_THAT(stats::missing(stated, here, names).scenes, testing::IsEmpty());
  EXPECT_THAT(stats::missing(here, stated, {"this program", "the reference"}).cells,
              testing::IsEmpty())
      << "the reference lacks what its campaign has today";
  EXPECT_THAT(stats::changed_answers(stated, here, stats::Compared::answers_and_work, names),
              testing::IsEmpty());
  EXPECT_THAT(changed_outcomes(stated, here), testing::IsEmpty());
}

}  // namespace
}  // namespace touchstone
