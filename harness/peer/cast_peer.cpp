// A cast of moving bodies that asks a peer.
#include "algorithms/registry.h"
#include "harness/files/case_json.h"
#include "harness/peer/offers.h"

namespace touchstone::peer {
namespace {

CastOutcome cast_outcome_of(const files::JsonNode& answer) {
  CastOutcome outcome;
  outcome.status = known_status(answer);
  outcome.toi = known_number(answer, "toi");
  outcome.answer = known_impact<CastAnswer>(answer, outcome.toi);
  outcome.lower = known_number(answer, "lower");
  outcome.upper = known_number(answer, "upper");
  outcome.normal = known_vector(answer, "normal");
  outcome.point = known_vector(answer, "point");
  outcome.iterations = known_count(answer, "iterations");
  return outcome;
}

class CastPeer final : public Cast {
 public:
  CastPeer(std::shared_ptr<Link> link, std::vector<ShapeKind> shapes, const CastSettings& settings)
      : link_(std::move(link)), offered_(std::move(shapes)), settings_(settings) {}

  void bind(std::span<const Shape> shapes) override { shapes_ = shapes; }

  void solve(const CastBatch& batch, std::span<CastOutcome> outcomes) override {
    const auto takes = [&](ShapeKind kind) {
      return std::ranges::find(offered_, kind) != offered_.end();
    };
    if (!takes(batch.kind_a) || !takes(batch.kind_b)) {
      for (CastOutcome& outcome : outcomes) outcome = CastOutcome{};
      return;
    }
    ask(
        *link_, "", batch.size(), [&](std::size_t i) { return question(batch, i); },
        [&](std::size_t i, const files::JsonNode& answer) {
          outcomes[i] = cast_outcome_of(answer);
        });
  }

 private:
  files::OrderedJson question(const CastBatch& batch, std::size_t i) const {
    const std::uint32_t a = batch.pairs.first[i], b = batch.pairs.second[i];
    files::CastCase c;
    c.shape_a = shapes_[batch.pairs.shape_of[a]];
    c.shape_b = shapes_[batch.pairs.shape_of[b]];
    c.pose_a = batch.pairs.poses[a];
    c.pose_b = batch.pairs.poses[b];
    c.motion_a = batch.motions[a];
    c.motion_b = batch.motions[b];
    files::OrderedJson question = {
        {"kind", "cast"},
        {"task", settings_.start == StartContact::approach ? "approach" : "counts"},
        {"scalar", to_string(settings_.scalar)}};
    if (settings_.tolerance) question["tolerance"] = *settings_.tolerance;
    if (settings_.max_iterations) question["max_iterations"] = *settings_.max_iterations;
    const files::OrderedJson bodies = files::to_ordered_json(c);
    question["a"] = bodies["a"];
    question["b"] = bodies["b"];
    return question;
  }

  std::shared_ptr<Link> link_;
  std::vector<ShapeKind> offered_;
  CastSettings settings_;
  std::span<const Shape> shapes_;
};

}  // namespace

void add_cast(const AlgorithmInfo& info, const files::JsonNode& offer,
              const std::shared_ptr<Link>& link) {
  const std::vector<ShapeKind> shapes = offered_shapes(offer);
  registry::add(CastEntry{.info = info,
                          .scalars = offered_scalars(offer),
                          .rotation = offered_flag(offer, "rotation"),
                          .approach = offered_flag(offer, "approach"),
                          .make =
                              [link, shapes](const CastSettings& settings) {
                                return std::make_unique<CastPeer>(link, shapes, settings);
                              }},
                registry::Timed::no);
}

}  // namespace touchstone::peer
