// The comparisons of `compare`, beside that of times: each as text and as Markdown, with its exit status.
#pragma once

#include <filesystem>
#include <string>

namespace touchstone::commands {

struct Judgement {
  std::string text;      // for the terminal
  std::string markdown;  // for a comment or a summary of CI
  int status = 0;
};

struct CompareRequest {
  std::filesystem::path a, b;
  std::filesystem::path csv;  // gets what changed; empty: nowhere
  bool all = false;           // names every change, not the first alone
};

// Says which answers of two checks changed. An answer is wrong beyond this part of the pair's scale.
Judgement compare_answers(const CompareRequest& request, double max_error);

// Says whether a count of B is greater than that of A by more than this part.
Judgement compare_instructions(const CompareRequest& request, double threshold);

}  // namespace touchstone::commands
