// Tests that saved certificates are verified, and damaged ones refused.
#include "harness/check/certificate_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>

#include "tests/harness/check/planted.h"
#include "tests/harness/input_fault.h"
#include "tests/harness/temporary_folder.h"

namespace touchstone {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::StartsWith;

kinds::Verdicts verified(const std::filesystem::path& file) {
  kinds::Verdicts verdicts(file.string());
  check::verify_certificates(file, verdicts);
  return verdicts;
}

TEST(CertificateFiles, WhatIsSavedIsVerified) {
  const TemporaryFolder folder;
  const kinds::Regime balls = balls_regime();
  check::CheckRequest request;
  draw(request, balls);
  for (const char* name : {"gap-1e-9", "depth-1e-3", "touching-grid", "degenerate-flat"}) {
    draw(request, *kinds::find_regime(name));
  }
  request.cases = 8;
  const auto file = folder.path() / "proofs.jsonl";
  EXPECT_EQ(check::save_certificates(request, file), 40);
  const kinds::Verdicts verdicts = verified(file);
  EXPECT_EQ(verdicts.verified(), 40);
  EXPECT_EQ(verdicts.refused(), 0);

  // One certificate claims the opposite, and one has a moved body.
  std::string text = folder.read("proofs.jsonl");
  const auto line = [&](int number) {
    std::size_t at = 0;
    for (int i = 1; i < number; ++i) at = text.find('\n', at) + 1;
    return at;
  };
  const auto replace = [&](int number, const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from, line(number));
    ASSERT_LT(at, line(number + 1));
    text.replace(at, from.size(), to);
  };
  replace(1, "\"separated\"", "\"overlapping\"");
  replace(2, "\"radius\":1.0", "\"radius\":0.5");
  folder.write("spoilt.jsonl", text);
  const auto spoilt = folder.path() / "spoilt.jsonl";
  testing::internal::CaptureStderr();
  const kinds::Verdicts found = verified(spoilt);
  const std::string told = testing::internal::GetCapturedStderr();
  EXPECT_EQ(found.verified(), 38);
  EXPECT_EQ(found.refused(), 2);
  EXPECT_THAT(told, StartsWith(spoilt.string() + ":1: balls/"));
  EXPECT_THAT(told, HasSubstr("\n" + spoilt.string() + ":2: balls/"));
}

// The disk is full after the first proofs: what was there before is whole.
TEST(CertificateFiles, AFullDiskLeavesTheOldFile) {
  const TemporaryFolder folder;
  const kinds::Regime balls = balls_regime();
  check::CheckRequest request;
  draw(request, balls);
  request.cases = 50;
  request.workers = 1;
  const auto file = folder.write("proofs.jsonl", "old\n");
  const pid_t child = fork();
  if (child == 0) {
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{1000, 1000};
    setrlimit(RLIMIT_FSIZE, &limit);
    _exit(input_fault([&] { check::save_certificates(request, file); }).empty() ? 0 : 2);
  }
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_EQ(WEXITSTATUS(status), 2);
  EXPECT_EQ(folder.read("proofs.jsonl"), "old\n");
  EXPECT_THAT(folder.names(), ElementsAre("proofs.jsonl"));
}

TEST(CertificateFiles, BadFiles) {
  const TemporaryFolder folder;
  const auto bad = folder.write("bad.jsonl", "{}\n");
  EXPECT_THAT(input_fault([&] { verified(bad); }), HasSubstr("bad.jsonl:1: "));
  EXPECT_THAT(input_fault([&] { verified(folder.path() / "none.jsonl"); }),
              HasSubstr("none.jsonl: "));
  check::CheckRequest request;
  const kinds::Regime balls = balls_regime();
  draw(request, balls);
  request.cases = 1;
  EXPECT_THAT(input_fault([&] { check::save_certificates(request, folder.path() / "no/x.jsonl"); }),
              HasSubstr("cannot be written"));
}

}  // namespace
}  // namespace touchstone
