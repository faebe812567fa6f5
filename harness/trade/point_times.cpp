// Times a trade's points with the measuring loop.
#include "harness/trade/point_times.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "harness/base/clock.h"
#include "harness/trade/point_sampler.h"
#include "harness/trade/point_statistics.h"

namespace touchstone::trade {
namespace {

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
