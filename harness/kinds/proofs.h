// What kinds share that verify proofs of their answers.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <utility>

namespace touchstone::kinds {

// Counts the certificates of a file, and prints where one is refused and why.
class Verdicts {
 public:
  explicit Verdicts(const std::string& file) : file_(file) {}

  // `why` is empty if the certificate is verified.
  void add(std::int64_t line, const std::string& name, const std::string& why);
  // What was added last is verified, and claims no order of what a ray hits.
  void add_without_order() { ++without_order_; }
  // Calls `read`, which adds all certificates, and prints the numbers; also where the file is found to be malformed,
  // before that is thrown on. Returns true if none is refused.
  bool of(const std::function<void()>& read);

  std::int64_t verified() const { return verified_; }
  std::int64_t refused() const { return refused_; }

 private:
  void print(const std::string& until) const;

  std::string file_;
  std::int64_t verified_ = 0, refused_ = 0, without_order_ = 0;
};

// The numbers of the questions at one target, by which what they are is looked up in the user's own file.
class QuestionNumbers {
 public:
  void begin() { last_.reset(); }
  // Returns why the number is wrong, or an empty string: it has to be above the one before, so that no question is
  // there twice.
  std::string fault(std::uint64_t number);

 private:
  std::optional<std::uint64_t> last_;
};

// The cases of a user's file, by their text in the form of a certificate, without what is proven of them.
class AskedCases {
 public:
  void add(std::string case_line) { lines_.insert(std::move(case_line)); }
  // Returns why the case is none of them, or an empty string; also where no file was given.
  std::string fault(const std::string& case_line) const;

 private:
  std::set<std::string> lines_;
};

}  // namespace touchstone::kinds
