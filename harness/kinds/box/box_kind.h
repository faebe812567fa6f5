// What the files about boxes share.
#pragma once

#include <sys/types.h>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "algorithms/registry.h"
#include "harness/kinds/questions.h"
#include "harness/process/isolate.h"
#include "harness/scene/box_frames.h"

namespace touchstone::kinds {

// A broad phase that goes through the frames of a file in a child process.

struct BoxOptions {
  std::string pairs, changes, moved, resting;  // files; none if empty
  int threads = 2;
  ExecutorKind executor = usual_executor;
  bool rebuild = false;
  double time_limit = std::numeric_limits<double>::infinity();  // seconds a frame
};

// An algorithm's result of a frame.
struct FrameResult {
  Status status = Status::crashed;
  bool known = false;  // the members below are known
  std::size_t pairs = 0;
  std::uint64_t hash = 0;
  double seconds = 0;
  std::size_t began = 0, ended = 0, moved = 0;
  std::size_t missing = 0;  // of the frame's known pairs, and the first of these
  IndexPair first_missing = {};
  // The place in the temporary file of the pairs, of those that began, of those that ended and of
  // those of the bodies that moved or came.
  off_t kept_at = 0;
  int error = 0;  // errno of a failure to keep the pairs
};

// One algorithm, which goes through the frames in a child process.
class BoxContender {
 public:
  // The arguments outlive it. `is_resting` is indexed by id.
  BoxContender(const BroadPhaseEntry& entry, const std::vector<scene::BoxFrame>& frames,
               const BoxOptions& options, const std::vector<char>& is_resting);

  const AlgorithmInfo& info() const { return entry_.info; }
  const FrameResult& result(std::size_t frame) const { return results_[frame]; }

  // A frame that crashes the algorithm or takes too long is lost; the next one is built anew.
  // Returns which were lost. Throws InputError if the pairs cannot be kept, as the members below do.
  std::vector<AskFailure> run();

  // Returns the sorted pairs of the frame.
  std::vector<IndexPair> kept_pairs(std::size_t frame) const;
  // Returns the sorted pairs of the bodies that moved or came in the frame.
  std::vector<IndexPair> kept_moved_pairs(std::size_t frame) const;
  // Returns the pairs that began in the frame, or those that ended, ascending.
  std::vector<IndexPair> kept_changes(std::size_t frame, bool have_begun) const;

 private:
  struct CloseFile {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  struct Worker;

  void find_pairs(Worker& worker, const scene::BoxFrame& frame, FrameResult& result);
  void list_awake(std::size_t slots, std::vector<std::uint32_t>& awake) const;
  void keep(const Worker& worker, FrameResult& result);
  std::vector<IndexPair> kept(std::size_t frame, std::size_t first, std::size_t count) const;

  const BroadPhaseEntry& entry_;
  const std::vector<scene::BoxFrame>& frames_;
  const BoxOptions& options_;
  const std::vector<char>& is_resting_;
  process::SharedArray<FrameResult> results_;
  std::unique_ptr<std::FILE, CloseFile> kept_;  // the pairs of all frames that are done
};

// Frames of boxes, of a CSV file or a recording.

std::vector<QueryOption> box_options();
// Throws InputError for what is wrong in the files or the options.
std::unique_ptr<Questions> read_box_questions(const QuestionInput& input);

}  // namespace touchstone::kinds
