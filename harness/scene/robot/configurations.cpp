// Draws configurations, and reads them from CSV.
#include "harness/scene/robot/configurations.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "harness/base/error.h"
#include "harness/base/input_file.h"
#include "harness/base/random.h"
#include "harness/base/warning.h"
#include "harness/files/csv.h"

namespace touchstone::scene {

namespace {

constexpr double most_value = 1e9;  // radians or metres
constexpr double rounding = 1e-6;   // the same: how far planners go beyond limits

void set_values(const Robot& robot, const std::map<std::string, double>& values,
                UsualConfiguration& configuration) {
  for (const auto& [name, value] : values) {
    const std::uint32_t joint = robot.find_joint(name).value_or(UINT32_MAX);
    configuration.values.at(joint) = value;
    configuration.given[joint] = 1;
  }
  follow_mimics(robot, configuration.values, configuration.given);
}

bool is_beyond(const Joint& joint, double value) {
  return joint.is_free() && joint.kind != JointKind::continuous &&
         (value < joint.lower - rounding || value > joint.upper + rounding);
}

}  // namespace

UsualConfiguration usual_configuration(const Robot& robot,
                                       const std::map<std::string, double>& values) {
  UsualConfiguration usual = {usual_values(robot), std::vector<char>(robot.joints.size(), 0)};
  set_values(robot, values, usual);
  return usual;
}

Configuration with_values(const Robot& robot, const UsualConfiguration& usual,
                          const std::map<std::string, double>& values) {
  UsualConfiguration changed = usual;
  set_values(robot, values, changed);
  return changed.values;
}

TimedConfigurations read_configurations(const std::filesystem::path& file, const Robot& robot,
                                        const UsualConfiguration& usual) {
  std::vector<std::string> columns = {"time"};
  std::vector<std::size_t> joints;  // of the columns behind it
  for (std::size_t i = 0; i < robot.joints.size(); ++i) {
    if (!robot.joints[i].moves()) continue;
    if (robot.joints[i].name == "time") {
      throw base::InputError(file.string(), 0,
                             "the robot has a joint \"time\", which is the name of another column; "
                             "expected another name");
    }
    columns.push_back(robot.joints[i].name);
    joints.push_back(i);
  }
  const files::CsvReader reader(file, {}, columns, files::CsvReader::Others::refused);
  TimedConfigurations read;
  std::string first_beyond;  // what is said of the first row that is beyond limits
  std::int64_t line_beyond = 0;
  std::size_t rows_beyond = 0;
  std::vector<char> given = usual.given;
  double first = 0, last = 0;
  const auto finite = [](const files::CsvReader::Row& row, std::size_t column) {
    const double value = row.number(column);
    if (!(std::abs(value) <= most_value)) {
      row.fail(fmt::format("{}: found {}; expected a number from {:g} to {:g}", row.name(column),
                           value, -most_value, most_value));
    }
    return value;
  };
  reader.read([&](const files::CsvReader::Row& row) {
    if (!row.is_absent(0)) {
      const double time = finite(row, 0);
      if (!read.frames.empty() && !(time > last)) {
        row.fail(fmt::format("time {} after {}; expected rising times", time, last));
      }
      if (read.frames.empty()) first = time;
      last = time;
    }
    Configuration& values = read.frames.emplace_back(usual.values);
    bool any = false;
    std::optional<std::size_t> beyond;
    for (std::size_t i = 0; i < joints.size(); ++i) {
      if (row.is_absent(i + 1)) continue;
      any = true;
      given[joints[i]] = 1;
      values[joints[i]] = finite(row, i + 1);
      if (!beyond && is_beyond(robot.joints[joints[i]], values[joints[i]])) beyond = joints[i];
    }
    if (beyond && rows_beyond++ == 0) {
      const Joint& joint = robot.joints[*beyond];
      line_beyond = row.line();
      first_beyond =
          fmt::format("{}: {} is outside of the joint's limits, {} to {}",
                      base::shortened(joint.name), values[*beyond], joint.lower, joint.upper);
    }
    if (!any) row.fail("no column of a joint; expected one at least, named as a joint that moves");
    follow_mimics(robot, values, given);
  });
  if (read.frames.empty()) {
    throw base::InputError(file.string(), 1, "no row behind the header; expected at least one");
  }
  if (rows_beyond > 0) {
    base::warn(file.string(), line_beyond,
               fmt::format("{}; rows with such values: {} of {}", first_beyond, rows_beyond,
                           read.frames.size()));
  }
  if (read.frames.size() > 1) {
    read.time_step = (last - first) / static_cast<double>(read.frames.size() - 1);
    if (read.time_step > 0 && !(read.time_step >= 1e-9 && read.time_step <= 1e6)) {
      throw base::InputError(
          file.string(), 0,
          fmt::format("a step of {} s from row to row; expected 1e-9 to 1e6", read.time_step));
    }
  }
  return read;
}

namespace {

constexpr double whole_turn = 6.283185307179586476925;

}  // namespace

std::vector<Configuration> straight_path(const Robot& robot, const Configuration& from,
                                         const Configuration& to, std::size_t steps) {
  std::vector<Configuration> path;
  for (std::size_t step = 0; step <= steps; ++step) {
    const double t =
        static_cast<double>(step) / static_cast<double>(std::max<std::size_t>(steps, 1));
    Configuration& at = path.emplace_back(from);
    for (std::size_t i = 0; i < at.size(); ++i) {
      const bool turns_round = robot.joints[i].kind == JointKind::continuous;
      const double end =
          turns_round ? from[i] + std::remainder(to[i] - from[i], whole_turn) : to[i];
      at[i] = (1 - t) * from[i] + t * end;
    }
  }
  return path;
}

std::vector<Configuration> random_configurations(const Robot& robot,
                                                 const UsualConfiguration& usual,
                                                 const RandomConfigurations& request) {
  std::vector<Configuration> drawn;
  base::Random random(request.seed);
  for (std::size_t k = 0; k < request.count; ++k) {
    const bool walks = request.step > 0;
    Configuration values = walks && k > 0 ? drawn.back() : usual.values;
    for (std::size_t i = 0; i < values.size() && !(walks && k == 0); ++i) {
      if (request.moves[i] == 0) continue;
      const auto& [low, high] = std::pair(robot.joints[i].lower, robot.joints[i].upper);
      if (!walks) {
        values[i] = random.uniform(low, high);
        continue;
      }
      values[i] += request.step * (high - low) * random.uniform(-1, 1);
      if (robot.joints[i].kind == JointKind::continuous) {
        values[i] = std::remainder(values[i], whole_turn);
        continue;
      }
      if (values[i] < low) values[i] = 2 * low - values[i];
      if (values[i] > high) values[i] = 2 * high - values[i];
      values[i] = std::clamp(values[i], low, high);
    }
    follow_mimics(robot, values, usual.given);
    drawn.push_back(std::move(values));
  }
  return drawn;
}

}  // namespace touchstone::scene
