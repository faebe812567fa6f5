// A concave phase that asks a peer. Both bodies are in each question, as in a case.
#include "algorithms/registry.h"
#include "harness/base/input_file.h"
#include "harness/files/concave_cases.h"
#include "harness/peer/offers.h"

namespace touchstone::peer {
namespace {

// Throws base::InputError for what is no pair of parts of the bodies.
std::vector<IndexPair> known_parts(const files::JsonNode& answer, const ConcaveBody& a,
                                   const ConcaveBody& b) {
  std::vector<IndexPair> pairs;
  if (!answer.has("parts")) return pairs;
  const files::JsonNode list = answer.at("parts", "");
  list.as_array("an array of pairs of parts");
  for (std::size_t i = 0; i < list.size(); ++i) {
    const files::JsonNode pair = list[i];
    const auto part = [&](std::size_t place, std::uint32_t count) {
      const files::Json& number = pair.value()[place];
      if (!number.is_number_unsigned() || number.get<std::uint64_t>() >= count) {
        pair.fail(fmt::format("found the part {}; expected one of {}",
                              base::shortened(number.dump(), 40), count));
      }
      return number.get<std::uint32_t>();
    };
    if (!pair.value().is_array() || pair.size() != 2) {
      pair.fail(fmt::format("found {}; expected the numbers of two parts", pair.found()));
    }
    pairs.push_back({part(0, a.part_count()), part(1, b.part_count())});
  }
  return pairs;
}

class ConcavePeer final : public ConcavePhase {
 public:
  ConcavePeer(std::shared_ptr<Link> link, const ConcaveSettings& settings)
      : link_(std::move(link)), scalar_(settings.scalar), tolerance_(settings.tolerance) {}

  void bind(std::span<const ConcaveBody> bodies) override { bodies_ = bodies; }

  void solve(ConcaveTask task, const PlacedConcave& a, const PlacedConcave& b, Outcome& outcome,
             std::vector<IndexPair>& pairs) override {
    const auto body = [&](const PlacedConcave& one) {
      return files::concave_body_to_json(bodies_[one.body], one.pose);
    };
    ask(
        *link_, "", 1,
        [&](std::size_t) {
          files::OrderedJson question = {
              {"kind", "mesh"}, {"task", to_string(task)}, {"scalar", to_string(scalar_)}};
          if (tolerance_) question["tolerance"] = *tolerance_;
          question["a"] = body(a);
          question["b"] = body(b);
          return question;
        },
        [&](std::size_t, const files::JsonNode& answer) {
          outcome = known_outcome(answer);
          pairs = known_parts(answer, bodies_[a.body], bodies_[b.body]);
          if (!pairs.empty() && !answer.has("answer")) outcome.answer = Answer::overlapping;
          if (outcome.answer == Answer::touching) outcome.answer = Answer::overlapping;
        });
  }

 private:
  std::shared_ptr<Link> link_;
  Precision scalar_;
  std::optional<double> tolerance_;
  std::span<const ConcaveBody> bodies_;
};

}  // namespace

void add_mesh(const AlgorithmInfo& info, const files::JsonNode& offer,
              const std::shared_ptr<Link>& link) {
  registry::add(ConcaveEntry{.info = info,
                             .tasks = offered<ConcaveTask>(offer, "tasks", all_concave_tasks),
                             .scalars = offered_scalars(offer),
                             .approximate = offered_flag(offer, "approximate"),
                             .make =
                                 [link](const ConcaveSettings& settings) {
                                   return std::make_unique<ConcavePeer>(link, settings);
                                 }},
                registry::Timed::no);
}

}  // namespace touchstone::peer
