// Every reader reads what is kept in inputs/, or says which file is at fault: to begin with, and mutated.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "harness/base/random.h"
#include "harness/files/text_file.h"
#include "tests/fuzz/readers.h"
#include "tests/harness/temporary_folder.h"
#include "tests/project_folder.h"

namespace touchstone::fuzz {
namespace {

struct Inputs {
  std::vector<std::string> names, texts;
};

Inputs inputs_of(const Reader& reader) {
  Inputs inputs;
  const std::filesystem::path folder =
      std::filesystem::path(project_folder) / "tests/fuzz/inputs" / reader.name;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    inputs.names.push_back(entry.path().string());
  }
  std::ranges::sort(inputs.names);
  for (const std::string& name : inputs.names) inputs.texts.push_back(files::read_text(name));
  return inputs;
}

std::string mutated(std::string text, base::Random& random) {
  static const std::string letters = "<>/\"'=:{}[],-.# \n\t&*!|%09aex\x80\xff";
  for (std::uint64_t k = 0, count = 1 + random.below(3); k < count && !text.empty(); ++k) {
    const std::size_t at = random.below(text.size());
    const char letter = letters[random.below(letters.size())];
    switch (random.below(4)) {
      case 0: text[at] = letter; break;
      case 1: text.insert(at, 1, letter); break;
      case 2: text.erase(at, 1 + random.below(8)); break;
      default: text.insert(at, text.substr(random.below(text.size()), 20)); break;
    }
  }
  return text;
}

class KeptInputs : public testing::TestWithParam<Reader> {};

TEST_P(KeptInputs, AreReadOrRefused) {
  const TemporaryFolder folder;
  const Trial trial(GetParam(), folder.path());
  const Inputs inputs = inputs_of(GetParam());
  ASSERT_FALSE(inputs.names.empty());
  int read = 0, refused = 0;
  for (std::size_t i = 0; i < inputs.names.size(); ++i) {
    SCOPED_TRACE(inputs.names[i]);
    // What begins with "good" is valid, and the rest was found by the fuzzer.
    const std::string fault = trial.fault(inputs.texts[i]);
    if (std::filesystem::path(inputs.names[i]).filename().string().starts_with("good")) {
      EXPECT_EQ(fault, "");
      ++read;
    }
  }
  EXPECT_GT(read, 0);
  base::Random random(7);
  for (int round = 0; round < 200; ++round) {
    const std::string text = mutated(inputs.texts[random.below(inputs.texts.size())], random);
    SCOPED_TRACE(text);
    refused += trial.fault(text).empty() ? 0 : 1;
  }
  EXPECT_GT(refused, 10);
}

INSTANTIATE_TEST_SUITE_P(Readers, KeptInputs, testing::ValuesIn(readers().begin(), readers().end()),
                         [](const testing::TestParamInfo<Reader>& one) {
                           std::string name(one.param.name);
                           std::ranges::replace(name, '-', '_');
                           return name;
                         });

}  // namespace
}  // namespace touchstone::fuzz
