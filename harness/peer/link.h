// Questions to a peer and its answers, each a JSON object in a line.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "algorithms/core/outcome.h"
#include "harness/files/json_line.h"

namespace touchstone::peer {

// A question as it is sent. The id is a hash of all else in the line.
struct Question {
  std::string id;
  std::string line;  // with the line break
};

// Where answers come from.
class Link {
 public:
  virtual ~Link() = default;
  // Returns one line for each question, in their order. `before` are lines that come first and have no answer, such as
  // the mesh that the questions are about.
  virtual std::vector<std::string> answers(std::string_view before,
                                           std::span<const Question> questions) = 0;

  // Whether questions may have packed bytes behind their line, and answers too.
  virtual bool takes_packed() const { return false; }
  // Sends a question and its bytes. Returns the line of the answer, and the bytes behind it, whose number `size_of` gives
  // for the line.
  virtual std::pair<std::string, std::string> packed_answer(
      const Question& question, std::string_view bytes,
      const std::function<std::size_t(const std::string& line)>& size_of);
};

// The id of a text: 16 hexadecimal digits.
std::string id_of(std::string_view text);

// Asks questions 0 to count - 1, a part at a time, and hands on their answers. Throws process::Garbage for a line that
// is no answer to its question, or where `take` throws base::InputError.
void ask(Link& link, std::string_view before, std::size_t count,
         const std::function<files::OrderedJson(std::size_t)>& question,
         const std::function<void(std::size_t, const files::JsonNode&)>& take);

// Throws process::Garbage for a line that is no object with this id.
files::Json answer_with_id(const std::string& line, const std::string& id);

// --- values of answers; what is missing or null is not known, as may be parts of a vector, since JavaScript writes NaN
// as null. All throw base::InputError. ---

// NaN if it is not known. "inf" and "-inf" are numbers.
double known_number(const files::JsonNode& answer, const char* key);
Vec3d known_vector(const files::JsonNode& answer, const char* key);
std::int32_t known_count(const files::JsonNode& answer, const char* key);  // -1 if it is not known
// One of those that an algorithm may have; not_reported if it is not known.
Status known_status(const files::JsonNode& answer);

// Of a pair of bodies. Without `answer` the sign of `distance` decides.
Outcome known_outcome(const files::JsonNode& answer);

// The value with this name; nothing if the key is missing or null.
template <class Value>
std::optional<Value> known_name(const files::JsonNode& answer, const char* key,
                                std::span<const Value> values) {
  if (!answer.has(key) || answer.value().at(key).is_null()) return std::nullopt;
  const files::JsonNode node = answer.at(key, "");
  std::string names;
  for (const Value value : values) {
    if (node.value() == std::string(to_string(value))) return value;
    names += fmt::format("{}{}", names.empty() ? "" : ", ", to_string(value));
  }
  node.fail(fmt::format("found {}; expected one of {}", node.found(), names));
}

// The answer about a time of impact: by its name, or a hit if there is a time, or unknown.
template <class Answer>
Answer known_impact(const files::JsonNode& answer, double toi) {
  constexpr std::array all = {Answer::hit, Answer::miss, Answer::unknown};
  const auto named = known_name<Answer>(answer, "answer", all);
  return named.value_or(std::isnan(toi) ? Answer::unknown : Answer::hit);
}

}  // namespace touchstone::peer
