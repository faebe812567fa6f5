// Plays configurations in child processes and grades their answers.
#include "harness/trade/evaluation.h"

#include <numeric>
namespace touchstone::trade {
namespace {

struct Found {  // the result that the child sends
  PointErrors errors;
  PipelineCounters counters;
  StageSeconds rough{};
};

void play(const SceneFrames& frames, const TradePoint& point, std::span<const FrameTruth> truth,
          Task task, Found& found) {
  Executor executor(1);
  FramePipeline pipeline(frames, *point.stand_ins, point.configuration, task, executor);
  pipeline.count_witnesses();
  ErrorCount count(task);
  double timed = 0;
  for (const FrameTruth& frame : truth) {
    if (frame.frame == 0) {
      pipeline.start(0);
    } else {
      // The frame is an update, as in the timed scene.
      pipeline.pass(frame.frame - 1);
      pipeline.advance();
    }
    count.add(frame, pipeline.answers());
    // The scene has more frames, which come later.
    if (frame.frame == 0 && truth.size() > 1) continue;
    ++timed;
    for (std::size_t i = 0; i < found.rough.size(); ++i) found.rough[i] += pipeline.seconds()[i];
  }
  for (double& seconds : found.rough) seconds /= timed;
  found.errors = count.errors();
  found.counters = pipeline.counters();
}

}  // namespace

double Evaluation::rough_seconds() const {
  return std::accumulate(rough.begin(), rough.end(), 0.0);
}

std::vector<Evaluation> evaluate(const SceneFrames& frames, std::span<const TradePoint> points,
                                 std::span<const FrameTruth> truth, Task task,
                                 const EvaluationLimits& limits) {
  process::SharedArray<Found> found(points.size());
  process::IsolationLimits isolation;
  isolation.item_seconds = limits.seconds;
  isolation.memory = limits.memory;
  const process::IsolationReport report =
      process::isolate(points.size(), isolation, [&]() -> process::ItemWork {
        return [&](std::size_t i) { play(frames, points[i], truth, task, found[i]); };
      });
  std::vector<Evaluation> evaluations(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    Evaluation& evaluation = evaluations[i];
    evaluation.state = report.states[i];
    if (report.states[i] == process::ItemState::done) {
      evaluation.errors = found[i].errors;
      evaluation.counters = found[i].counters;
      evaluation.rough = found[i].rough;
    }
  }
  for (const process::IsolationFailure& failure : report.failures) {
    evaluations[failure.item].words = failure.reason();
  }
  return evaluations;
}

}  // namespace touchstone::trade
