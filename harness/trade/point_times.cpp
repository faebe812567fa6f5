#include "harness/trade/point_times.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <numeric>

#include "harness/base/clock.h"
#include "harness/base/random.h"
#include "harness/measure/latin_square.h"
#include "harness/measure/noise.h"
#include "harness/measure/worker.h"
#include "harness/stats/statistics.h"
#include "harness/trade/point_sampler.h"

namespace touchstone {
namespace {

constexpr std::size_t others_a_group = 7;
constexpr std::size_t most_rounds = 6;  // of a square, in one process
constexpr double overhead = 2e-3;       // seconds a sample, about: a message there and back
constexpr double least_sample = 1e-3;   // seconds that a sample should take, for the clock
constexpr double seconds_to_start = 300;

double sum(const StageSeconds& stages) {
  return std::accumulate(stages.begin(), stages.end(), 0.0);
}

// Members of a group: points; the first is the baseline, the second its twin.
struct Group {
  std::vector<std::size_t> members;
  std::uint32_t window = 1;  // frames a sample
  std::size_t rounds = 1;    // of each square that are taken
  double cost = 0;           // seconds a process, about
  std::uint32_t next = 0;    // frame
};

class Timing {
 public:
  Timing(const SceneFrames& frames, std::span<const TradePoint> points,
         std::span<const double> rough, Task task, const TimingPlan& plan,
         const std::function<void(const PointSample&)>& keep)
      : frames_(frames),
        points_(points),
        rough_(rough),
        task_(task),
        plan_(plan),
        keep_(keep),
        random_(plan.seed),
        first_frame_(frames.is_static() ? 0 : 1),
        times_{std::vector<TimedPoint>(points.size())},
        ratios_(points.size()),
        noisy_ratios_(points.size()),
        stages_(points.size()) {}

  PointTimes run() {
    std::vector<Group> groups = make_groups();
    const Stopwatch watch;
    for (int process = 0; process < plan_.processes; ++process) {
      for (Group& group : groups) {
        // Every point is to have one; further ones as long as there is time.
        if (process > 0 && watch.seconds() + group.cost > plan_.seconds) continue;
        run_group(group, process);
      }
    }
    return summary();
  }

 private:
  std::vector<Group> make_groups() {
    std::vector<std::size_t> order(points_.size() - 1);
    std::iota(order.begin(), order.end(), std::size_t{1});
    std::ranges::stable_sort(order, {}, [&](std::size_t i) { return rough_[i]; });
    std::vector<Group> groups;
    for (std::size_t at = 0; at < order.size() || groups.empty(); at += others_a_group) {
      Group& group = groups.emplace_back();
      group.members = {0, 0};
      for (std::size_t i = at; i < std::min(order.size(), at + others_a_group); ++i) {
        group.members.push_back(order[i]);
      }
    }
    const double share =
        plan_.seconds / static_cast<double>(groups.size()) / static_cast<double>(plan_.processes);
    const auto most_window =
        static_cast<double>(frames_.is_static() ? 64 : frames_.frames.size() - 1);
    for (Group& group : groups) {
      group.next = first_frame_;
      double a_frame = 0, least = std::numeric_limits<double>::max();
      for (const std::size_t member : group.members) {
        a_frame += rough_[member];
        least = std::min(least, rough_[member]);
      }
      const double samples = static_cast<double>(group.members.size());
      // Rounds first, as they make the statistics, then longer windows; one warm window on top.
      const double shortest = std::clamp(std::ceil(least_sample / least), 1.0, most_window);
      const double round = a_frame * shortest + samples * overhead;
      group.rounds = static_cast<std::size_t>(
          std::clamp(share / round - 1, 1.0,
                     static_cast<double>(std::min(most_rounds, group.members.size()))));
      const double rounds = static_cast<double>(group.rounds) + 1;
      const double window = (share / rounds - samples * overhead) / a_frame;
      group.window = static_cast<std::uint32_t>(std::clamp(window, shortest, most_window));
      group.cost = rounds * (a_frame * group.window + samples * overhead);
    }
    return groups;
  }

  std::uint32_t next_frame(Group& group) const {
    const std::uint32_t frame = group.next;
    const auto count = static_cast<std::uint32_t>(frames_.frames.size()) - first_frame_;
    group.next = first_frame_ + (group.next - first_frame_ + group.window) % count;
    return frame;
  }

  double deadline(std::size_t point, std::uint32_t frames) const {
    // What leads up to a window is played too.
    const double all = static_cast<double>(frames + frames_.frames.size());
    return std::max(60.0, all * std::max(plan_.time_limit, 20 * rough_[point]));
  }

  void lose(std::size_t point, const IsolationFailure& failure) {
    TimedPoint& timed = times_.points[point];
    timed.status = to_string(failure.state);
    timed.words = failure.reason();
  }

  void run_group(Group& group, int process) {
    const std::size_t size = group.members.size();
    std::vector<std::unique_ptr<Worker>> workers(size);
    const std::uint32_t warm = next_frame(group);
    for (std::size_t i = 0; i < size; ++i) {
      const std::size_t point = group.members[i];
      if (times_.points[point].status != "ok") continue;
      workers[i] = std::make_unique<Worker>(
          [this, point]() -> std::unique_ptr<Sampler> {
            return std::make_unique<PointSampler>(frames_, points_[point], task_, plan_.threads);
          },
          WorkerSettings{plan_.memory, random_.next()});
      const auto failure = workers[i]->wait_until_made(seconds_to_start);
      const bool made = !failure && workers[i]->ask({.frame = warm, .frames = group.window},
                                                    deadline(point, group.window));
      if (made) continue;
      lose(point, workers[i]->failure());
      workers[i].reset();
    }
    const LatinSquare square = latin_square(size, random_);
    for (std::size_t round = 0; round < std::min(group.rounds, size); ++round) {
      run_round(group, workers, square[round], process, round);
    }
    ++squares_;
  }

  void run_round(Group& group, std::vector<std::unique_ptr<Worker>>& workers,
                 const std::vector<std::size_t>& order, int process, std::size_t round) {
    std::vector<PointSample> samples;
    std::vector<double> seconds(order.size(), Outcome::none);
    const std::uint32_t frame = next_frame(group);
    const NoiseReading before = NoiseReading::now();
    const Stopwatch watch;
    double waited = 0;
    for (std::size_t position = 0; position < order.size(); ++position) {
      const std::size_t member = order[position], point = group.members[member];
      if (workers[member] == nullptr) continue;
      PointSample& sample = samples.emplace_back();
      sample.point = point;
      sample.twin = member == 1;
      sample.process = process;
      sample.square = squares_;
      sample.round = static_cast<std::int64_t>(round);
      sample.position = static_cast<std::int64_t>(position);
      sample.frame = frame;
      sample.frames = group.window;
      const auto reply = workers[member]->ask({.frame = frame, .frames = group.window},
                                              deadline(point, group.window));
      if (!reply) {
        lose(point, workers[member]->failure());
        sample.status = times_.points[point].status;
        workers[member].reset();
        continue;
      }
      sample.reply = *reply;
      if (std::isfinite(reply->waited)) waited += reply->waited;
      seconds[member] = sum(reply->stages) / group.window;
    }
    const std::string noise = noise_judge()(before, NoiseReading::now(), watch.seconds(), waited);
    for (PointSample& sample : samples) {
      sample.noise = noise;
      keep_(sample);
    }
    take(group, seconds, samples, noise.empty());
  }

  void take(const Group& group, std::span<const double> seconds,
            std::span<const PointSample> samples, bool quiet) {
    if (!std::isfinite(seconds[0])) return;
    (quiet ? baseline_ : noisy_baseline_).push_back(seconds[0]);
    if (std::isfinite(seconds[1])) {
      (quiet ? twin_ : noisy_twin_).push_back(std::log(seconds[1] / seconds[0]));
    }
    for (std::size_t i = 2; i < seconds.size(); ++i) {
      if (!std::isfinite(seconds[i])) continue;
      (quiet ? ratios_ : noisy_ratios_)[group.members[i]].push_back(
          std::log(seconds[i] / seconds[0]));
    }
    for (const PointSample& sample : samples) {
      if (sample.status != "ok" || sample.twin) continue;
      for (std::size_t k = 0; k < stage_names.size(); ++k) {
        stages_[sample.point][k].push_back(sample.reply.stages[k] / sample.frames);
      }
    }
  }

  // Of rounds that the machine left alone, where there are enough for an interval; else of all.
  static std::vector<double> chosen(std::vector<double> quiet, const std::vector<double>& noisy) {
    if (quiet.size() < 6) quiet.insert(quiet.end(), noisy.begin(), noisy.end());
    return quiet;
  }

  PointTimes summary() {
    const std::vector<double> baseline = chosen(baseline_, noisy_baseline_);
    const double unit = stats::median(baseline);
    for (std::size_t i = 0; i < points_.size(); ++i) {
      TimedPoint& point = times_.points[i];
      for (std::size_t k = 0; k < stage_names.size(); ++k) {
        if (!stages_[i][k].empty()) point.stages[k] = stats::median(stages_[i][k]);
      }
      if (i == 0) {
        const stats::MedianInterval interval = stats::median_interval(baseline, 0.95);
        point.rounds = static_cast<std::int64_t>(baseline.size());
        point.seconds = interval.median;
        point.low = interval.low;
        point.high = interval.high;
        continue;
      }
      const std::vector<double> ratios = chosen(ratios_[i], noisy_ratios_[i]);
      point.rounds = static_cast<std::int64_t>(ratios.size());
      if (ratios.empty() || point.status != "ok") continue;
      const stats::MedianInterval interval =
          stats::exponential(stats::median_interval(ratios, 0.95));
      point.seconds = unit * interval.median;
      point.low = unit * interval.low;
      point.high = unit * interval.high;
    }
    const std::vector<double> twin = chosen(twin_, noisy_twin_);
    if (!twin.empty()) times_.twin = std::exp(stats::median(twin));
    return std::move(times_);
  }

  const SceneFrames& frames_;
  std::span<const TradePoint> points_;
  std::span<const double> rough_;
  Task task_;
  const TimingPlan& plan_;
  const std::function<void(const PointSample&)>& keep_;
  Random random_;
  std::uint32_t first_frame_;
  std::int64_t squares_ = 0;
  PointTimes times_;
  // Seconds a frame of the baseline; logarithms of ratios to it, of one round each.
  std::vector<double> baseline_, noisy_baseline_, twin_, noisy_twin_;
  std::vector<std::vector<double>> ratios_, noisy_ratios_;
  std::vector<std::array<std::vector<double>, stage_names.size()>> stages_;
};

}  // namespace

PointTimes time_points(const SceneFrames& frames, std::span<const TradePoint> points,
                       std::span<const double> rough, Task task, const TimingPlan& plan,
                       const std::function<void(const PointSample&)>& keep) {
  if (points.empty()) return {};
  return Timing(frames, points, rough, task, plan, keep).run();
}

}  // namespace touchstone
