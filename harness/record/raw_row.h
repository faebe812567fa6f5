// A row of raw.csv: one measurement.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "algorithms/algorithm_info.h"
#include "algorithms/broad_phase_work.h"
#include "algorithms/core/executor/executor.h"
#include "algorithms/core/isa.h"
#include "algorithms/core/outcome.h"
#include "harness/record/query_task.h"
#include "harness/record/row.h"
#include "harness/scene/scene.h"

namespace touchstone::record {

// `convert` is the part of a peer's build or update that converts boxes to its own types, run once
// more. `answer` are all queries of a timed set (harness/kinds/timed_set.h).
enum class Phase : std::uint8_t { build, update, find_pairs, narrow, convert, answer };
std::string_view to_string(Phase phase);

enum class RowKind : std::uint8_t {
  check,   // one frame, verified; its time is not used as a sample
  sample,  // a timed sample of a window of frames
};
std::string_view to_string(RowKind kind);

// The values of Status, and `wrong`, which only a row has: the answers of a sample, or the pairs
// found, are wrong.
enum class RowStatus : std::uint8_t {
  ok,
  not_converged,
  degenerate,
  capacity,
  unsupported,
  not_reported,
  crashed,
  timed_out,
  garbage,
  wrong,
};
std::string_view to_string(RowStatus status);
constexpr RowStatus row_status(Status status) { return static_cast<RowStatus>(status); }

// The values of Origin, and `limit`: the lower bound of a broad phase (algorithms/limit.h).
enum class RowOrigin : std::uint8_t { ours, peer, oracle, module, limit };
std::string_view to_string(RowOrigin origin);
constexpr RowOrigin row_origin(Origin origin) { return static_cast<RowOrigin>(origin); }
// As of an Origin (algorithm_info.h).
constexpr bool is_answerable(std::optional<RowOrigin> origin) {
  return origin == RowOrigin::ours || origin == RowOrigin::module;
}

// Counts of -1, empty optionals and texts, and NaN are empty fields.
struct RawRow {
  std::string campaign;
  RowKind kind = RowKind::check;
  std::int64_t block = 0;
  std::string scene, scene_hash;
  std::int64_t seed = -1;
  std::int64_t bodies = 0;
  std::optional<scene::BoxKind> boxes = scene::BoxKind::tight;  // empty in rows with a query kind
  std::int64_t frame = 0;
  std::int64_t frames = -1;
  std::string broad, narrow;
  std::optional<RowOrigin> origin;
  std::optional<Precision> scalar;
  std::optional<QueryTask> task;
  double tolerance = Outcome::none, duality_gap = Outcome::none;
  std::optional<bool> twin;
  std::int64_t threads = 0;
  std::optional<ExecutorKind> executor;  // empty: one thread, or it is not known
  std::optional<Isa> isa;
  std::optional<Isa> isa_limit;  // empty: the campaign sets no limit
  std::optional<bool> rebuild;   // true if the campaign builds every frame anew
  std::string pair_kind;
  std::int64_t process = -1, square = -1, round = -1, position = -1;
  Phase phase = Phase::build;
  double seconds = Outcome::none;
  std::int64_t pair_count = -1;
  std::string pair_hash;
  std::int64_t contact_count = -1;
  std::string outcome_hash;
  std::int64_t compared = -1;
  std::int64_t disagreements = -1;
  double worst_disagreement = Outcome::none;
  double worst_error = Outcome::none;
  std::int64_t failures = -1;
  std::int64_t iterations = -1, iterations_squared = -1, support_calls = -1;
  std::int64_t box_tests = -1, node_visits = -1, candidates = -1, bytes = -1;
  std::int64_t allocations = -1, allocated_bytes = -1;
  std::int64_t peak_kb = -1, minor_faults = -1;
  std::int64_t voluntary_switches = -1, involuntary_switches = -1;
  double waited = Outcome::none;  // seconds
  std::int64_t cycles = -1, instructions = -1, branch_misses = -1, cache_misses = -1;
  std::optional<RowStatus> status;
  std::string noise, words, stop;
  // True if the narrow phase started from the memory that the frames before left.
  std::optional<bool> warm;
  std::int64_t batch = -1;  // pairs of a call, if that is not the usual number
  // True if the narrow phase's depth is that of some translation that separates, by design.
  std::optional<bool> depth_bound;
  std::int64_t part_pairs = -1;
  double worst_frame = Outcome::none;  // seconds
  // Of a timed set alone: its kind, group and name, the algorithm, and how often a sample asked all queries.
  std::string query_kind, input, family, algorithm;
  std::int64_t repeats = -1;

  void take(const BroadPhaseWork& work);

  bool is_twin() const { return twin.value_or(false); }
  bool is_rebuilt() const { return rebuild.value_or(false); }
  bool is_warm() const { return warm.value_or(false); }
  bool is_narrow() const { return !narrow.empty(); }
  bool is_of_set() const { return !query_kind.empty(); }
  // What the seconds of a sample are divided by: frames of a broad phase, else queries.
  std::int64_t units() const { return is_narrow() || is_of_set() ? pair_count : frames; }
  // Returns true if the algorithm crashed, was stopped or cannot be read, so that it has no further answers.
  bool lost() const {
    return status == RowStatus::crashed || status == RowStatus::timed_out ||
           status == RowStatus::garbage;
  }
  bool wrong() const { return status == RowStatus::wrong; }
};

template <row_of<RawRow> Row, class Visit>
void columns(Row& row, Visit visit) {
  visit("campaign", row.campaign, "The campaign's name.");
  visit("kind", row.kind,
        "`check`: one frame, verified at one thread in a process of its own; its time is one "
        "reading and no sample. `sample`: a timed sample of a window of frames.");
  visit("block", row.block,
        "Number of the block, from 0 in the campaign's order. A block is a scene with its count, "
        "seed, boxes, threads and instructions; or a set of queries, with those that share its "
        "rounds.");
  visit("scene", row.scene, "The scene's name.");
  visit("scene_hash", row.scene_hash,
        "16 hexadecimal digits over everything that the scene gives to the algorithms.");
  visit("seed", newer(row.seed), "The scene's seed, where the campaign sets one.");
  visit("bodies", row.bodies, "Number of bodies.");
  visit("boxes", row.boxes,
        "`loose` boxes have a size that does not depend on the body's rotation.");
  visit("frame", row.frame, "Frame number from 0; in a sample the first one of the window.");
  visit("frames", row.frames,
        "Number of frames in a sample's window, which goes round. Frame 0 belongs to no window "
        "where frames are updates, or where a narrow phase of the set starts warm.");
  visit("broad", row.broad,
        "The broad phase. In a row of a narrow phase: the broad phase that found its pairs; empty "
        "for the true pairs of the frame.");
  visit("narrow", row.narrow,
        "The narrow phase or concave phase; empty in a row of a broad phase. A concave phase that "
        "takes any mid-phase has its name behind: `part-pairs wide-bvh`.");
  visit("origin", newer(row.origin),
        "Origin of the algorithm that is measured. `limit` is the lower bound of a broad phase: "
        "radix sort, gather and writing of the pairs.");
  visit("scalar", row.scalar, "The narrow phase's scalar type.");
  visit("task", row.task,
        "The narrow phase's task. `contacts`, of concave phases: all pairs of parts that share a "
        "point.");
  visit("tolerance", row.tolerance,
        "Tolerance of the narrow phase, a part of the size; empty: the algorithm's own.");
  visit("duality_gap", newer(row.duality_gap),
        "Duality gap at which the narrow phase stops; empty: the algorithm's own.");
  visit("twin", row.twin,
        "1 for the second registration of the set's baseline (A/A control). Its ratio shows the "
        "error of the measurement itself.");
  visit("threads", row.threads,
        "Width of the executor. Threads are pinned where there are more than one. Peers' broad "
        "phases use one thread, except Embree's.");
  visit("executor", newer(row.executor),
        "Samples on several threads: whose threads they are, those of our `crew` or of `onetbb`. "
        "Empty in check rows, which have one thread, and in older files, whose threads are the "
        "crew's.");
  visit("isa", row.isa, "Vector instructions that our kernels used.");
  visit("isa_limit", newer(row.isa_limit),
        "The most vector instructions that the campaign allows; empty: no limit.");
  visit("rebuild", newer(row.rebuild), "Broad phases: 1 where every frame is built anew.");
  visit("pair_kind", row.pair_kind,
        "The kinds of the two shapes. Each pair of kinds is timed separately. In pairs for concave "
        "phases `mesh` is a surface, `solid` one whose inside counts, `compound` a body of parts.");
  visit("process", row.process,
        "Process number from 0. In a check row it says that a worker failed its first, untimed "
        "pass.");
  visit("square", row.square,
        "Number of the Latin square in the set, from 0. Contestants are paired within a square.");
  visit("round", row.round, "Round (row) of the square, from 0.");
  visit("position", row.position, "Place within the round, from 0.");
  visit("phase", row.phase,
        "`convert` stands in check rows of peers: the conversion to the library's own types in "
        "that build or update, done again (least of three times) and timed alone.");
  visit("seconds", row.seconds,
        "Wall-clock seconds, summed over the window. Conversion to a peer's types is included.");
  visit(
      "pair_count", row.pair_count,
      "Number of pairs found (`find_pairs`) or asked about (`narrow`), summed over the window; of "
      "queries (`answer`), summed over the repeats.");
  visit("pair_hash", row.pair_hash,
        "Hash of these pairs, independent of their order, summed over the window.");
  visit("contact_count", row.contact_count, "Number of queries answered touching or overlapping.");
  visit("outcome_hash", row.outcome_hash,
        "Hash of all answers, statuses and distances of the row.");
  visit("compared", newer(row.compared),
        "Number of queries that both the algorithm and the oracle answered.");
  visit("disagreements", row.disagreements,
        "Number of compared queries on the wrong side of contact by more than 1e-4 (float) or 1e-6 "
        "(double) of the size.");
  visit("worst_disagreement", newer(row.worst_disagreement),
        "Greatest exact distance or depth among the disagreements, metres.");
  visit("worst_error", newer(row.worst_error),
        "Greatest error of a distance or depth, as a part of the pair's size.");
  visit("failures", row.failures,
        "Number of queries that the algorithm said it could not answer, or that were lost.");
  visit("iterations", newer(row.iterations),
        "Iterations, summed over the queries that count them.");
  visit("iterations_squared", newer(row.iterations_squared),
        "Check rows: squares of the iterations of a query, summed; gives their deviation.");
  visit("support_calls", newer(row.support_calls),
        "Calls of the support function, summed over the queries that count them.");
  visit("box_tests", newer(row.box_tests),
        "Check rows of `find_pairs`: pairs of boxes compared on at least one axis.");
  visit("node_visits", newer(row.node_visits),
        "Check rows of `find_pairs`: cells, buckets and nodes looked up or entered.");
  visit("candidates", newer(row.candidates),
        "Check rows of `find_pairs`: pairs whose own boxes had to be compared.");
  visit("bytes", newer(row.bytes),
        "Check rows of `find_pairs`: memory held between the calls, bytes.");
  visit("allocations", newer(row.allocations),
        "Check rows: allocations of the phase once it is warm.");
  visit("allocated_bytes", newer(row.allocated_bytes), "Check rows: bytes of these allocations.");
  visit("peak_kb", newer(row.peak_kb),
        "Greatest memory of the contestant in the sample beyond that of the harness, kilobytes; in "
        "the sample's last row.");
  visit("minor_faults", newer(row.minor_faults),
        "Minor page faults of the worker over the sample; in its last row.");
  visit("voluntary_switches", newer(row.voluntary_switches),
        "Voluntary context switches of the worker over the sample; in its last row.");
  visit("involuntary_switches", newer(row.involuntary_switches),
        "Involuntary context switches of the worker over the sample; in its last row.");
  visit("waited", newer(row.waited),
        "Seconds in which a thread of the worker was ready and had no processor, summed over the "
        "threads; in the sample's last row.");
  visit("cycles", newer(row.cycles),
        "Processor cycles in user space, all threads of the worker over the sample; in its last "
        "row. Empty where the kernel refuses hardware counters.");
  visit("instructions", newer(row.instructions), "Instructions, counted like `cycles`.");
  visit("branch_misses", newer(row.branch_misses), "Branch misses, counted like `cycles`.");
  visit("cache_misses", newer(row.cache_misses), "Cache misses, counted like `cycles`.");
  visit("status", row.status,
        "`not_reported`: the library cannot say whether it failed. `not_converged`: at least one "
        "query gave up. `wrong`: other pairs than there are, or another answer than in the check. "
        "After `wrong`, `timed_out` and `crashed` the algorithm is not timed.");
  visit("noise", row.noise,
        "Disturbances of the round, joined by `+`: `pressure` (tasks waited for a processor), "
        "`steal` (by the hypervisor), `preempted`. `canary` in a set's last row: the baseline "
        "differed from its twin by more than the campaign's `width`. Empty: quiet, or unknown.");
  visit("words", newer(row.words),
        "Last output of what crashed, what was wrong, or why it was not tried.");
  visit("stop", newer(row.stop),
        "Last row of a set: why repetition ended. `width`: every interval is narrow enough; "
        "`budget`: of seconds; `rounds`: the greatest number; `crashed`.");
  visit("warm", newer(row.warm),
        "1 for a narrow phase that starts from what it kept of each pair; its label ends in "
        "` warm`.");
  visit(
      "batch", newer(row.batch),
      "The greatest number of pairs of one call of the narrow phase, if the campaign sets one; its "
      "label ends in ` by 1`. Empty: 256.");
  visit("depth_bound", newer(row.depth_bound),
        "1 for a narrow phase whose depth is an upper bound by design: that of some translation "
        "that separates the bodies, in general not the least.");
  visit("part_pairs", newer(row.part_pairs),
        "Task `contacts`: pairs of triangles or convex parts that share a point, summed over the "
        "queries.");
  visit("worst_frame", newer(row.worst_frame),
        "Samples of a broad phase: seconds of the window's longest frame, its build or update and "
        "find_pairs together; in the sample's last row.");
  visit("query_kind", newer(row.query_kind),
        "The kind of query, such as `ray`, in rows of a group of a kind; empty in those of "
        "scenes. Such rows have no scene, bodies, boxes, frame, broad and narrow.");
  visit("input", newer(row.input),
        "What the queries are about, such as a mesh: `group` in set_times.csv.");
  visit("family", newer(row.family), "The set of queries: `cell` in set_times.csv.");
  visit("algorithm", newer(row.algorithm),
        "Rows with `query_kind`: the algorithm, with the scalar where it has several.");
  visit("repeats", newer(row.repeats),
        "Rows with `query_kind`: how often all queries of the set were answered in the sample.");
}

// Returns a narrow phase with its settings, as the tables name it: "gjk double", "gjk double
// 1e-06", "gjk double gap 1e-08", "gjk double warm", "gjk double by 1". NaN for both is the algorithm's own
// tolerance, -1 the usual batch.
std::string narrow_label(std::string_view name, std::string_view scalar, double tolerance,
                         double duality_gap, bool warm, std::int64_t batch);
// Returns the label of the row's algorithm: a broad phase's name, or a narrow phase's label.
std::string algorithm_label(const RawRow& row);
// Returns this label with the executor behind it where that is not the usual one: "auto onetbb".
std::string label_on(std::string algorithm, std::optional<ExecutorKind> executor);
// Returns the label of the row's contestant, the algorithm on its executor.
std::string label_of(const RawRow& row);

}  // namespace touchstone::record
