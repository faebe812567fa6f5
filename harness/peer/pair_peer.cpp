// A narrow phase that asks a peer.
#include "algorithms/registry.h"
#include "harness/files/case_json.h"
#include "harness/peer/offers.h"

namespace touchstone::peer {
namespace {

class PairPeer final : public NarrowPhase {
 public:
  PairPeer(std::shared_ptr<Link> link, std::vector<ShapeKind> shapes,
           const NarrowPhaseSettings& settings)
      : link_(std::move(link)), offered_(std::move(shapes)), settings_(settings) {}

  void bind(std::span<const Shape> shapes) override { shapes_ = shapes; }

  void solve(Task task, const PairBatch& batch, std::span<Outcome> outcomes) override {
    const auto takes = [&](ShapeKind kind) {
      return std::ranges::find(offered_, kind) != offered_.end();
    };
    if (!takes(batch.kind_a) || !takes(batch.kind_b)) {
      for (Outcome& outcome : outcomes) outcome = Outcome{};
      return;
    }
    const auto body = [&](std::uint32_t number) {
      return files::body_to_json(shapes_[batch.pairs.shape_of[number]], batch.pairs.poses[number]);
    };
    ask(
        *link_, "", batch.size(),
        [&](std::size_t i) {
          files::OrderedJson question = {
              {"kind", "pair"}, {"task", to_string(task)}, {"scalar", to_string(settings_.scalar)}};
          if (settings_.tolerance) question["tolerance"] = *settings_.tolerance;
          if (settings_.max_iterations) question["max_iterations"] = *settings_.max_iterations;
          if (settings_.margin) question["margin"] = *settings_.margin;
          question["a"] = body(batch.pairs.first[i]);
          question["b"] = body(batch.pairs.second[i]);
          return question;
        },
        [&](std::size_t i, const files::JsonNode& answer) { outcomes[i] = known_outcome(answer); });
  }

 private:
  std::shared_ptr<Link> link_;
  std::vector<ShapeKind> offered_;
  NarrowPhaseSettings settings_;
  std::span<const Shape> shapes_;
};

template <std::size_t place>
Encoding always(ShapeKind, ShapeKind, Task, Precision) {
  return all_encodings[place];
}

// An entry has a plain function, which cannot hold what a peer said.
auto encoding_function(Encoding encoding) {
  constexpr auto functions = []<std::size_t... place>(std::index_sequence<place...>) {
    return std::array{&always<place>...};
  }
  (std::make_index_sequence<all_encodings.size()>());
  return functions[static_cast<std::size_t>(encoding)];
}

}  // namespace

void add_pair(const AlgorithmInfo& info, const files::JsonNode& offer,
              const std::shared_ptr<Link>& link) {
  const std::vector<ShapeKind> shapes = offered_shapes(offer);
  const auto encoding = known_name<Encoding>(offer, "encoding", all_encodings);
  registry::add(
      NarrowPhaseEntry{.info = info,
                       .tasks = offered<Task>(offer, "tasks", all_tasks),
                       .scalars = offered_scalars(offer),
                       .traits = {.approximate = offered_flag(offer, "approximate"),
                                  .depth_is_bound = offered_flag(offer, "depth_is_bound")},
                       .encoding = encoding_function(encoding.value_or(Encoding::as_given)),
                       .make =
                           [link, shapes](const NarrowPhaseSettings& settings) {
                             return std::make_unique<PairPeer>(link, shapes, settings);
                           }},
      registry::Timed::no);
}

}  // namespace touchstone::peer
