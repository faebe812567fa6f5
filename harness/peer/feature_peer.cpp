// Continuous collision of features that asks a peer.
#include "algorithms/registry.h"
#include "harness/peer/offers.h"

namespace touchstone::peer {
namespace {

files::OrderedJson places(const std::array<Vec3d, 4>& vertices) {
  files::OrderedJson list = files::OrderedJson::array();
  for (const Vec3d& v : vertices) list.push_back({v.x(), v.y(), v.z()});
  return list;
}

CcdOutcome ccd_outcome_of(const files::JsonNode& answer) {
  CcdOutcome outcome;
  outcome.status = known_status(answer);
  outcome.toi = known_number(answer, "toi");
  outcome.answer = known_impact<CcdAnswer>(answer, outcome.toi);
  outcome.free_before = known_number(answer, "lower");
  outcome.contact_by = known_number(answer, "upper");
  outcome.iterations = known_count(answer, "iterations");
  return outcome;
}

class FeaturePeer final : public Ccd {
 public:
  FeaturePeer(std::shared_ptr<Link> link, std::vector<FeaturePair> pairs,
              const CcdSettings& settings)
      : link_(std::move(link)), offered_(std::move(pairs)), settings_(settings) {}

  void solve(FeaturePair pair, std::span<const CcdQuery> queries,
             std::span<CcdOutcome> outcomes) override {
    if (std::ranges::find(offered_, pair) == offered_.end()) {
      std::ranges::fill(outcomes, CcdOutcome{});
      return;
    }
    ask(
        *link_, "", queries.size(),
        [&](std::size_t i) {
          files::OrderedJson question = {
              {"kind", "feature"}, {"task", to_string(pair)}, {"tolerance", settings_.tolerance}};
          if (settings_.separation > 0) question["separation"] = settings_.separation;
          if (settings_.max_iterations) question["max_iterations"] = *settings_.max_iterations;
          question["start"] = places(queries[i].start);
          question["end"] = places(queries[i].end);
          return question;
        },
        [&](std::size_t i, const files::JsonNode& answer) {
          outcomes[i] = ccd_outcome_of(answer);
        });
  }

 private:
  std::shared_ptr<Link> link_;
  std::vector<FeaturePair> offered_;
  CcdSettings settings_;
};

}  // namespace

void add_feature(const AlgorithmInfo& info, const files::JsonNode& offer,
                 const std::shared_ptr<Link>& link) {
  const auto pairs = offered<FeaturePair>(offer, "tasks", all_feature_pairs);
  registry::add(CcdEntry{.info = info,
                         .separations = offered_flag(offer, "separations"),
                         .make =
                             [link, pairs](const CcdSettings& settings) {
                               return std::make_unique<FeaturePeer>(link, pairs, settings);
                             }},
                registry::Timed::no);
}

}  // namespace touchstone::peer
