// Writes questions and reads the values of answers.
#include "harness/peer/link.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <stdexcept>

#include "algorithms/core/outcome.h"
#include "harness/base/hash.h"
#include "harness/base/input_file.h"
#include "harness/process/child_process.h"

namespace touchstone::peer {
namespace {

constexpr std::size_t questions_at_once = 256;

bool is_known(const files::JsonNode& answer, const char* key) {
  const auto at = answer.value().find(key);
  return at != answer.value().end() && !at->is_null();
}

double number_of(const files::JsonNode& node) {
  if (node.value() == "inf") return std::numeric_limits<double>::infinity();
  if (node.value() == "-inf") return -std::numeric_limits<double>::infinity();
  return node.number();
}

constexpr std::array all_pair_answers = {Answer::separated, Answer::touching, Answer::overlapping,
                                         Answer::unknown};

// The answer that a number alone gives.
Answer answer_of(double distance) {
  if (std::isnan(distance)) return Answer::unknown;
  if (distance == 0) return Answer::touching;
  return distance > 0 ? Answer::separated : Answer::overlapping;
}

}  // namespace

std::string id_of(std::string_view text) {
  base::ByteHash hash;
  hash.add(text);
  return base::to_hex(hash.value());
}

std::pair<std::string, std::string> Link::packed_answer(
    const Question&, std::string_view, const std::function<std::size_t(const std::string&)>&) {
  throw std::logic_error("a link without packed bytes");
}

files::Json answer_with_id(const std::string& line, const std::string& id) {
  files::Json answer = files::Json::parse(line, nullptr, false);
  if (!answer.is_object()) {
    throw process::Garbage(
        fmt::format("found '{}'; expected a JSON object", base::shortened(line, 200)));
  }
  const auto found = answer.find("id");
  if (found == answer.end() || *found != id) {
    throw process::Garbage(
        fmt::format("found the id {}; expected \"{}\", as answers come in the order of questions",
                    found == answer.end() ? "of nothing" : base::shortened(found->dump(), 40), id));
  }
  return answer;
}

void ask(Link& link, std::string_view before, std::size_t count,
         const std::function<files::OrderedJson(std::size_t)>& question,
         const std::function<void(std::size_t, const files::JsonNode&)>& take) {
  for (std::size_t first = 0; first < count; first += questions_at_once) {
    std::vector<Question> questions;
    for (std::size_t i = first; i < std::min(first + questions_at_once, count); ++i) {
      const std::string text = question(i).dump();
      Question& one = questions.emplace_back(id_of(text));
      one.line = "{\"id\":\"" + one.id + "\"," + text.substr(1) + "\n";
    }
    const std::vector<std::string> lines = link.answers(first == 0 ? before : "", questions);
    for (std::size_t i = 0; i < lines.size(); ++i) {
      const files::Json answer = answer_with_id(lines[i], questions[i].id);
      static const std::string name = "answer";
      try {
        take(first + i, files::JsonNode(name, 0, answer));
      } catch (const base::InputError& error) {
        throw process::Garbage(error.what());
      }
    }
  }
}

double known_number(const files::JsonNode& answer, const char* key) {
  return is_known(answer, key) ? number_of(answer.at(key, "")) : Outcome::none;
}

Vec3d known_vector(const files::JsonNode& answer, const char* key) {
  Vec3d vector = Vec3d::Constant(Outcome::none);
  if (!is_known(answer, key)) return vector;
  const files::JsonNode node = answer.at(key, "");
  if (!node.value().is_array() || node.size() != 3) {
    node.fail(fmt::format("found {}; expected an array of 3 numbers", node.found()));
  }
  for (int i = 0; i < 3; ++i) {
    const files::JsonNode part = node[static_cast<std::size_t>(i)];
    if (!part.value().is_null()) vector[i] = part.number();
  }
  return vector;
}

std::int32_t known_count(const files::JsonNode& answer, const char* key) {
  if (!is_known(answer, key)) return -1;
  const files::JsonNode node = answer.at(key, "");
  const double count = node.number();
  if (!(count >= 0) || count != std::floor(count) || count > 1e9) {
    node.fail(fmt::format("found {}; expected an integer from 0 to 1000000000", node.found()));
  }
  return static_cast<std::int32_t>(count);
}

Status known_status(const files::JsonNode& answer) {
  constexpr std::array statuses = {Status::ok,       Status::not_converged, Status::degenerate,
                                   Status::capacity, Status::unsupported,   Status::not_reported};
  return known_name<Status>(answer, "status", statuses).value_or(Status::not_reported);
}

Outcome known_outcome(const files::JsonNode& answer) {
  Outcome outcome;
  outcome.status = known_status(answer);
  outcome.distance = known_number(answer, "distance");
  outcome.answer =
      known_name<Answer>(answer, "answer", all_pair_answers).value_or(answer_of(outcome.distance));
  outcome.lower = known_number(answer, "lower");
  outcome.upper = known_number(answer, "upper");
  outcome.normal = known_vector(answer, "normal");
  outcome.witness_a = known_vector(answer, "a");
  outcome.witness_b = known_vector(answer, "b");
  outcome.iterations = known_count(answer, "iterations");
  outcome.support_calls = known_count(answer, "support_calls");
  return outcome;
}

}  // namespace touchstone::peer
