// The library's certificates are lines that the harness would write: it reads each, and writes the same.
#include "harness/files/certificates.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <touchstone/touchstone.hpp>
#include <vector>

#include "algorithms/core/outcome.h"
#include "tests/algorithms/api/api.h"
#include "tests/algorithms/narrow_phase/any_pairs.h"
#include "tests/harness/temporary_folder.h"

namespace touchstone::api_test {
namespace {

using Json = nlohmann::ordered_json;

TEST(InterfaceCertificates, AreWrittenAsInTheHarness) {
  std::vector<std::string> written;
  std::string content;
  for (const test::AnyPair& pair : test::any_pairs()) {
    written.push_back(
        v1::certificate({outer(pair.a), outer(pair.pose_a)}, {outer(pair.b), outer(pair.pose_b)}));
    content += written.back() + '\n';
  }
  std::set<Answer> answers;
  std::size_t read = 0, surfaces = 0, curved = 0;
  const TemporaryFolder folder;
  const auto compare = [&](const files::StoredCertificate& stored, std::int64_t line) {
    // The harness may write another text of the same double. Keys and their order are compared too.
    const std::string& ours = written[static_cast<std::size_t>(line) - 1];
    EXPECT_TRUE(Json::parse(files::to_json(stored)) == Json::parse(ours)) << ours;
    const oracle::Certificate& proof = stored.certificate;
    ++read;
    answers.insert(proof.answer);
    surfaces += proof.surface.triangles.empty() ? 0 : 1;
    for (const oracle::Generator& generator : proof.a) curved += generator.vertex < 0 ? 1 : 0;
  };
  files::read_certificates(folder.write("proofs.jsonl", content), compare);
  EXPECT_EQ(read, written.size());
  EXPECT_TRUE(answers.contains(Answer::separated));
  EXPECT_TRUE(answers.contains(Answer::overlapping));
  EXPECT_GT(surfaces, 10u);
  EXPECT_GT(curved, 10u);
}

}  // namespace
}  // namespace touchstone::api_test
