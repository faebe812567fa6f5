// A broad phase that asks a peer. Boxes go and pairs come packed, since text would be the cost.
#include <array>
#include <bit>
#include <cmath>
#include <cstring>

#include "algorithms/registry.h"
#include "harness/peer/offers.h"
#include "harness/process/child_process.h"

namespace touchstone::peer {
namespace {

static_assert(std::endian::native == std::endian::little, "packed numbers are little-endian");
static_assert(sizeof(Aabb) == 24 && sizeof(IndexPair) == 8, "six floats, and two integers");

// More bytes of pairs than this are a fault of the program.
constexpr std::size_t most_bytes = std::size_t{1} << 30;

class BoxPeer final : public BroadPhase {
 public:
  explicit BoxPeer(std::shared_ptr<Link> link) : link_(std::move(link)) {}

  void build(std::span<const Aabb> boxes) override { boxes_ = boxes; }
  void update(const FrameChange& change) override { boxes_ = change.boxes; }

  Status find_pairs(PairSink& sink) override {
    sink.start(1);
    std::string bytes(boxes_.size_bytes(), '\0');
    if (!bytes.empty()) std::memcpy(bytes.data(), boxes_.data(), bytes.size());
    const files::OrderedJson question = {
        {"kind", "box"}, {"task", "pairs"}, {"boxes", boxes_.size()}, {"bytes", bytes.size()}};
    const std::string text = question.dump();
    const std::string id = id_of(text + bytes);
    Status status = Status::not_reported;
    std::size_t count = 0;
    const auto [line, packed] =
        link_->packed_answer({id, "{\"id\":\"" + id + "\"," + text.substr(1) + "\n"}, bytes,
                             [&](const std::string& answer) {
                               std::tie(status, count) = read(answer, id);
                               return count * sizeof(IndexPair);
                             });
    PairBuffer& pairs = sink.chunk(0);
    pairs.reserve(count);
    if (count > 0) std::memcpy(pairs.end(), packed.data(), packed.size());
    pairs.advance(count);
    for (const IndexPair& pair : pairs.pairs()) {
      if (pair.a < pair.b && pair.b < boxes_.size()) continue;
      throw process::Garbage(
          fmt::format("found the pair {}, {}; expected two of {} boxes, the smaller first", pair.a,
                      pair.b, boxes_.size()));
    }
    // The contract knows no other: without a status, an answer is meant.
    return status == Status::not_reported ? Status::ok : status;
  }

 private:
  // The status of an answer, and how many pairs come behind it.
  std::pair<Status, std::size_t> read(const std::string& line, const std::string& id) const {
    static const std::string name = "answer";
    const files::Json answer = answer_with_id(line, id);
    try {
      const files::JsonNode node(name, 0, answer);
      const double count = known_number(node, "pairs");
      if (std::isnan(count)) {
        const Status status = known_status(node);
        return {status == Status::not_reported ? Status::unsupported : status, 0};
      }
      const double n = static_cast<double>(boxes_.size());
      const double most =
          std::min(n * (n - 1) / 2, static_cast<double>(most_bytes / sizeof(IndexPair)));
      if (!(count >= 0) || count != std::floor(count) || count > most) {
        node.fail(fmt::format("pairs: found {}; expected an integer from 0 to {}", count, most));
      }
      return {known_status(node), static_cast<std::size_t>(count)};
    } catch (const base::InputError& error) {
      throw process::Garbage(error.what());
    }
  }

  std::shared_ptr<Link> link_;
  std::span<const Aabb> boxes_;
};

}  // namespace

void add_box(const AlgorithmInfo& info, const files::JsonNode& offer,
             const std::shared_ptr<Link>& link) {
  if (!link->takes_packed()) return;
  const files::JsonNode tasks = offer.at("tasks", "an array of names");
  if (tasks.value() != files::Json::array({"pairs"})) {
    tasks.fail(fmt::format("found {}; expected [\"pairs\"]", tasks.found()));
  }
  registry::add(
      BroadPhaseEntry{.info = info,
                      .make = [link](Executor&) { return std::make_unique<BoxPeer>(link); }},
      registry::Timed::no);
}

}  // namespace touchstone::peer
