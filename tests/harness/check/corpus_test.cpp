// Tests that the frozen corpus is whole, that its answers are those of the oracle, and that each is proven.
#include <gtest/gtest.h>

#include <iostream>
#include <set>

#include "algorithms/oracle/certificates/certificate_check.h"
#include "algorithms/oracle/oracle.h"
#include "harness/files/cases.h"
#include "harness/files/certificates.h"
#include "harness/files/json_line.h"
#include "tests/algorithms/one_in.h"
#include "tests/harness/run_shell.h"
#include "tests/harness/temporary_folder.h"
#include "tests/project_folder.h"

namespace touchstone {
namespace {

const std::filesystem::path corpus =
    std::filesystem::path(project_folder) / "datasets" / "corpus" / "2026";

// What a line of cases.jsonl.zst has beside the pair.
struct Stated {
  std::string answer;
  double lower, upper;
};

double number(const files::Json& value) {
  return value.is_string() ? std::stod(value.get<std::string>()) : value.get<double>();
}

TEST(Corpus, HasIdsInOrderAndEveryKey) {
  const auto cases = files::read_cases(corpus / "cases.jsonl.zst");
  ASSERT_FALSE(cases.empty());
  ASSERT_LE(cases.size(), 2000u);
  std::size_t place = 0;
  std::set<std::string> families, answers;
  std::set<std::pair<int, int>> difficulties;
  files::for_each_json_line(corpus / "cases.jsonl.zst", "case", [&](const files::JsonNode& line) {
    const files::Json& c = line.value();
    EXPECT_EQ(cases[place++].id, c["id"]);
    EXPECT_EQ(c["id"], fmt::format("TS26-{:04}", place));
    EXPECT_EQ(c["kind"], "pair");
    families.insert(c["family"].get<std::string>());
    answers.insert(c["expect"]["answer"].get<std::string>());
    EXPECT_LE(number(c["expect"]["lower"]), number(c["expect"]["upper"])) << c["id"];
    const files::Json& difficulty = c["difficulty"];
    const int wrong = difficulty["wrong"], failed = difficulty["failed"];
    EXPECT_TRUE(0 <= wrong && wrong <= failed && 0 < failed && failed <= difficulty["asked"])
        << c["id"];
    difficulties.insert({failed, difficulty["asked"]});
    EXPECT_FALSE(c["source"]["command"].get<std::string>().empty());
    EXPECT_FALSE(c["source"]["id"].get<std::string>().empty());
  });
  EXPECT_EQ(place, cases.size());
  EXPECT_EQ(answers, (std::set<std::string>{"overlapping", "separated", "touching"}));
  EXPECT_GT(families.size(), 50u);
  EXPECT_GT(difficulties.size(), 20u);
}

TEST(Corpus, AnswersAreThoseOfTheOracleAndProven) {
  const auto cases = files::read_cases(corpus / "cases.jsonl.zst");
  std::vector<Stated> stated;
  files::for_each_json_line(corpus / "cases.jsonl.zst", "case", [&](const files::JsonNode& line) {
    const files::Json& expect = line.value()["expect"];
    stated.push_back({expect["answer"], number(expect["lower"]), number(expect["upper"])});
  });
  ASSERT_EQ(stated.size(), cases.size());
  oracle::Oracle exact;
  std::size_t place = 0;
  files::read_certificates(corpus / "proofs.jsonl.zst", [&](const files::StoredCertificate& proof,
                                                            std::int64_t) {
    ASSERT_LT(place, cases.size());
    const files::Case& c = cases[place];
    const Stated& said = stated[place];
    ++place;
    if (place % one_in != 0) return;
    // The bodies are the same to the last bit.
    EXPECT_EQ(files::to_json(c), files::to_json(files::Case{proof.id, proof.shape_a, proof.shape_b,
                                                            proof.pose_a, proof.pose_b}));
    const oracle::Solid a(c.shape_a), b(c.shape_b);
    const oracle::Body at_a(a, c.pose_a), at_b(b, c.pose_b);
    EXPECT_EQ(oracle::fault(proof.certificate, at_a, at_b), "") << c.id;
    EXPECT_EQ(to_string(proof.certificate.answer), said.answer) << c.id;
    const oracle::Measure measure = exact.measure(at_a, at_b);
    EXPECT_EQ(to_string(measure.answer), said.answer) << c.id;
    EXPECT_EQ(measure.lower, said.lower) << c.id;
    EXPECT_EQ(measure.upper, said.upper) << c.id;
  });
  EXPECT_EQ(place, cases.size());
}

TEST(Corpus, IsVerifiedInPython) {
  if (run_shell("python3 --version && zstd --version").status != 0) {
    GTEST_SKIP() << "python3 or zstd is not there";
  }
  const auto cases = files::read_cases(corpus / "cases.jsonl.zst");
  const std::string verifier = std::string(project_folder) + "/datasets/certificates/verify.py";
  const Ran ran = run_shell("zstd -dcq '" + (corpus / "proofs.jsonl.zst").string() +
                            "' | python3 '" + verifier + "' -");
  EXPECT_EQ(ran.status, 0);
  EXPECT_EQ(ran.text, fmt::format("{} proven, 0 refused, 0 malformed\n", cases.size()));
}

// The examples of the choice are in its own text.
TEST(Corpus, IsChosenAsTheExamplesSay) {
  if (run_shell("python3 --version").status != 0) GTEST_SKIP() << "python3 is not there";
  const Ran ran = run_shell("python3 -B -m doctest '" + std::string(project_folder) +
                            "/datasets/corpus/make_corpus.py'");
  EXPECT_EQ(ran.status, 0) << ran.text;
}

// It is frozen: what is there is not written again.
TEST(Corpus, IsNotOverwritten) {
  if (run_shell("python3 --version").status != 0) GTEST_SKIP() << "python3 is not there";
  const Ran ran = run_shell("python3 -B '" + std::string(project_folder) +
                            "/datasets/corpus/make_corpus.py' '" + corpus.string() + "'");
  EXPECT_EQ(ran.status, 2) << ran.text;
  EXPECT_NE(ran.text.find("never changes"), std::string::npos) << ran.text;
}

}  // namespace
}  // namespace touchstone
