// Times a trade's points with the measuring loop: what a sample plays, and the medians and intervals of the rounds.
#include "harness/trade/point_times.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <numeric>
#include <vector>

#include "harness/base/clock.h"
#include "harness/base/hash.h"
#include "harness/measure/sampler.h"
#include "harness/stats/statistics.h"
#include "harness/trade/evaluation.h"

namespace touchstone::trade {
namespace {

constexpr std::size_t least_values = 6;  // the smallest number for an interval of 95 %

// Frames are played in order and again and again. They begin at frame 0, which belongs to no
// sample; if the scene has no other frame, each of its samples begins anew. The durations are the
// stages of the pipeline.
class PointSampler final : public measure::Sampler {
 public:
  // The frames outlive it.
  PointSampler(const SceneFrames& frames, const TradePoint& point, Task task, int threads,
               ExecutorKind executor);

  measure::SampleReply sample(const measure::SampleRequest& request) override;

 private:
  void play_up_to(std::size_t frame);

  const SceneFrames* frames_;
  TradePoint point_;
  Executor executor_;
  FramePipeline pipeline_;
  bool started_ = false;
};

PointSampler::PointSampler(const SceneFrames& frames, const TradePoint& point, Task task,
                           int threads, ExecutorKind executor)
    : frames_(&frames),
      point_(point),
      executor_(threads, Pinning::one_a_thread, executor),
      pipeline_(frames, *point_.stand_ins, point_.configuration, task, executor_) {}

void PointSampler::play_up_to(std::size_t frame) {
  if (!started_ || pipeline_.frame() > frame) pipeline_.start(0);
  started_ = true;
  while (pipeline_.frame() < frame) pipeline_.advance();
}

measure::SampleReply PointSampler::sample(const measure::SampleRequest& request) {
  measure::SampleReply reply;
  reply.contacts = 0;
  std::size_t frame = request.frame;
  for (std::uint32_t i = 0; i < request.frames; ++i) {
    if (frame == frames_->frames.size()) frame = frames_->is_static() ? 0 : 1;
    if (frames_->is_static()) {
      pipeline_.start(0);
    } else {
      play_up_to(frame - 1);
      pipeline_.advance();
    }
    ++frame;
    for (std::size_t k = 0; k < stage_names.size(); ++k) {
      reply.durations.add(stage_names[k], pipeline_.seconds()[k]);
    }
    reply.pairs += static_cast<std::int64_t>(pipeline_.pairs().size());
    reply.pair_hash += base::pair_hash(pipeline_.pairs());
    reply.contacts += std::ranges::count_if(pipeline_.answers(), [](const PairAnswer& answer) {
      return grade::is_contact(answer.answer);
    });
  }
  return reply;
}

// Contestant i of the plan is point i; point 0 is the baseline, and the last contestant is its
// control.
class PointStatistics {
 public:
  explicit PointStatistics(std::size_t points) : ratios_(points + 1), stages_(points) {}

  void add(const measure::Round& round);
  // Fills in the times of points that were not lost.
  void summarise(PointTimes& times) const;

 private:
  // Values of quiet rounds, and of rounds that other work disturbed.
  struct Values {
    std::vector<double> quiet, noisy;
    std::vector<double> chosen() const;
  };

  Values baseline_;             // seconds a frame
  std::vector<Values> ratios_;  // for each contestant: logarithms of its ratios to the baseline
  std::vector<std::array<std::vector<double>, stage_names.size()>> stages_;
};

// Returns the values of quiet rounds if they are enough for an interval, else those of all rounds.
std::vector<double> PointStatistics::Values::chosen() const {
  std::vector<double> values = quiet;
  if (quiet.size() < least_values) values.insert(values.end(), noisy.begin(), noisy.end());
  return values;
}

void PointStatistics::add(const measure::Round& round) {
  const auto is_baseline = [](const measure::Sample& sample) {
    return sample.contestant == 0 && !sample.loss;
  };
  const auto baseline = std::ranges::find_if(round.samples, is_baseline);
  if (baseline == round.samples.end()) return;
  const auto add = [&](Values& values, double value) {
    (round.noise.empty() ? values.quiet : values.noisy).push_back(value);
  };
  const double frames = round.request.frames;
  const double unit = baseline->reply.durations.sum() / frames;
  for (const measure::Sample& sample : round.samples) {
    if (sample.loss) continue;
    const double seconds = sample.reply.durations.sum() / frames;
    if (sample.contestant == 0) {
      add(baseline_, seconds);
    } else {
      add(ratios_[sample.contestant], std::log(seconds / unit));
    }
    if (sample.contestant == stages_.size()) continue;  // it is the control
    for (std::size_t k = 0; k < stage_names.size(); ++k) {
      stages_[sample.contestant][k].push_back(sample.reply.durations.of(stage_names[k]) / frames);
    }
  }
}

void PointStatistics::summarise(PointTimes& times) const {
  const std::vector<double> baseline = baseline_.chosen();
  const double unit = stats::median(baseline);
  for (std::size_t i = 0; i < times.points.size(); ++i) {
    TimedPoint& point = times.points[i];
    for (std::size_t k = 0; k < stage_names.size(); ++k) {
      if (!stages_[i][k].empty()) point.stages[k] = stats::median(stages_[i][k]);
    }
    if (i == 0) {
      const stats::MedianInterval interval =
          stats::median_interval(baseline, stats::usual_confidence);
      point.rounds = static_cast<std::int64_t>(baseline.size());
      point.seconds = interval.median;
      point.low = interval.low;
      point.high = interval.high;
      continue;
    }
    const std::vector<double> ratios = ratios_[i].chosen();
    point.rounds = static_cast<std::int64_t>(ratios.size());
    if (ratios.empty() || !point.ok()) continue;
    const stats::MedianInterval interval =
        stats::exponential(stats::median_interval(ratios, stats::usual_confidence));
    point.seconds = unit * interval.median;
    point.low = unit * interval.low;
    point.high = unit * interval.high;
  }
  const std::vector<double> control = ratios_.back().chosen();
  if (!control.empty()) times.control = std::exp(stats::median(control));
}

constexpr std::size_t others_a_set = 7;
constexpr std::size_t most_rounds = 6;  // rounds of a square in one process
constexpr double overhead = 2e-3;  // seconds a sample, approximately: one message in each direction
constexpr double least_sample = 1e-3;  // the shortest sample that the clock resolves well, seconds
constexpr double seconds_to_start = 300;
constexpr double most_window_at_rest = 64;  // frames

// The points as contestants; the last one is the baseline's control. A set holds points of similar
// speed, and each of its processes runs one square.
class PointTiming final : private measure::MeasuringJob {
 public:
  PointTiming(const SceneFrames& frames, std::span<const TradePoint> points,
              std::span<const double> rough, Task task, const TimingPlan& timing,
              const std::function<void(const PointSample&)>& keep)
      : frames_(frames),
        points_(points),
        rough_(rough),
        task_(task),
        timing_(timing),
        keep_(keep),
        times_{std::vector<TimedPoint>(points.size())},
        statistics_(points.size()) {}

  PointTimes run() {
    plan_.shares_workers = false;
    plan_.memory = timing_.memory;
    plan_.setup_seconds = seconds_to_start;
    plan_.seed = timing_.seed;
    for (std::size_t i = 0; i <= points_.size(); ++i) {
      const TradePoint& point = points_[point_of(i)];
      plan_.contestants.push_back({point.configuration.name(), is_control(i), [this, &point] {
                                     return std::make_unique<PointSampler>(
                                         frames_, point, task_, timing_.threads, timing_.executor);
                                   }});
    }
    for (int process = 0; process < timing_.processes; ++process) {
      plan_.periods.push_back({{process, process, process + 1}});
    }
    make_sets();
    watch_.restart();
    measure::MeasuringLoop(plan_, *this).run();
    statistics_.summarise(times_);
    return std::move(times_);
  }

 private:
  bool is_control(std::size_t contestant) const { return contestant == points_.size(); }
  std::size_t point_of(std::size_t contestant) const {
    return is_control(contestant) ? 0 : contestant;
  }

  void make_sets() {
    std::vector<std::size_t> order(points_.size() - 1);
    std::iota(order.begin(), order.end(), std::size_t{1});
    std::ranges::stable_sort(order, {}, [&](std::size_t i) { return rough_[i]; });
    for (std::size_t at = 0; at < order.size() || plan_.sets.empty(); at += others_a_set) {
      measure::MeasuredSet& set = plan_.sets.emplace_back();
      set.members = {0, points_.size()};
      for (std::size_t i = at; i < std::min(order.size(), at + others_a_set); ++i) {
        set.members.push_back(order[i]);
      }
      set.groups = {set.members};
      set.frames = frames_.frames.size();
      set.starts.resize(frames_.is_static() ? 1 : set.frames - 1);
      std::iota(set.starts.begin(), set.starts.end(), std::size_t{frames_.is_static() ? 0U : 1U});
      set.warm_up_windows = 1;
    }
    const double share = timing_.seconds / static_cast<double>(plan_.sets.size()) /
                         static_cast<double>(timing_.processes);
    for (measure::MeasuredSet& set : plan_.sets) share_time(set, share);
  }

  // Chooses rounds and window for so many seconds a process: rounds first, because they make the
  // statistics, then longer windows. The untimed window costs as much as a round.
  void share_time(measure::MeasuredSet& set, double seconds) {
    double a_frame = 0, least = std::numeric_limits<double>::max();
    for (const std::size_t member : set.members) {
      a_frame += rough_[point_of(member)];
      least = std::min(least, rough_[point_of(member)]);
    }
    const double members = static_cast<double>(set.members.size());
    const double most_window =
        frames_.is_static() ? most_window_at_rest : static_cast<double>(set.frames - 1);
    const double shortest = std::clamp(std::ceil(least_sample / least), 1.0, most_window);
    const double round = a_frame * shortest + members * overhead;
    set.most_rounds = static_cast<std::size_t>(std::clamp(
        seconds / round - 1, 1.0, static_cast<double>(std::min(most_rounds, set.members.size()))));
    const double rounds = static_cast<double>(set.most_rounds) + 1;
    const double window = (seconds / rounds - members * overhead) / a_frame;
    set.window = static_cast<std::uint32_t>(std::clamp(window, shortest, most_window));
    costs_.push_back(rounds * (a_frame * set.window + members * overhead));
  }

  std::vector<Untimed> warm_up(std::size_t, std::span<const std::size_t> sets,
                               const measure::ProcessLaps& process) override {
    std::vector<Untimed> all;
    for (const std::size_t set : sets) {
      all.push_back({set, plan_.sets[set].warm_up_request(process.first, 0, 0)});
    }
    return all;
  }

  double deadline(std::size_t contestant, std::size_t, std::uint32_t frames) const override {
    // The frames before a window are played first.
    const double all = static_cast<double>(frames + frames_.frames.size());
    return std::max(60.0, all * std::max(timing_.time_limit, 20 * rough_[point_of(contestant)]));
  }

  // The other axis of a trade shows the errors of the answers, so every answer is accepted.
  bool is_right(std::size_t, std::size_t, const measure::SampleRequest&,
                const measure::SampleReply&) const override {
    return true;
  }

  // Every point gets one process, and further ones as long as there is time.
  bool has_time(std::size_t set, const measure::ProcessLaps& process) const override {
    return process.process == 0 || watch_.seconds() + costs_[set] <= timing_.seconds;
  }

  void lose(std::size_t contestant, std::size_t, int, std::uint32_t,
            const measure::Loss& loss) override {
    if (is_control(contestant)) return;
    TimedPoint& point = times_.points[contestant];
    point.state = loss.failure.state;
    point.words = loss.failure.reason();
  }

  void take(measure::Round& round) override {
    const std::int64_t square = round.square * static_cast<std::int64_t>(plan_.sets.size()) +
                                static_cast<std::int64_t>(round.set);
    for (const measure::Sample& sample : round.samples) {
      if (sample.loss) lose(sample.contestant, round.set, round.process, 0, *sample.loss);
      keep_({point_of(sample.contestant), is_control(sample.contestant), square, round, sample});
    }
    statistics_.add(round);
  }

  bool goes_on() override { return true; }

  const SceneFrames& frames_;
  std::span<const TradePoint> points_;
  std::span<const double> rough_;
  Task task_;
  const TimingPlan& timing_;
  const std::function<void(const PointSample&)>& keep_;
  measure::MeasurePlan plan_;
  std::vector<double> costs_;  // for each set: seconds a process, approximately
  base::Stopwatch watch_;
  PointTimes times_;
  PointStatistics statistics_;
};

}  // namespace

PointTimes time_points(const SceneFrames& frames, std::span<const TradePoint> points,
                       std::span<const double> rough, Task task, const TimingPlan& plan,
                       const std::function<void(const PointSample&)>& keep) {
  if (points.empty()) return {};
  return PointTiming(frames, points, rough, task, plan, keep).run();
}

}  // namespace touchstone::trade
