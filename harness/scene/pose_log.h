// Logs of a simulator: where bodies are in each frame, as CSV.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>

#include "harness/files/csv.h"
#include "harness/scene/scene.h"

namespace touchstone::scene {

// Reads a CSV file with the columns frame, body (a number, or a name that one body has), and x, y, z (metres), qw, qx, qy,
// qz (of any length but 0), or m00, m01 ... m23, the rows of a 3 x 4 matrix. Frames rise from 0 by one. The bodies that
// the file has get tracks, and count as moving; the scene has as many frames as the file. Throws InputError with
// file and line.
void read_pose_log(const std::filesystem::path& file, Scene& scene);

// Writes such a file as matrices, row by row: frames from 0, each with numbers of bodies; metres. Throws InputError where
// it cannot be written.
class PoseMatrixWriter {
 public:
  explicit PoseMatrixWriter(const std::filesystem::path& file);
  void add(std::size_t frame, std::size_t body, const Pose& pose);
  void close() { csv_.close(); }

 private:
  files::CsvWriter csv_;
};

// Writes such a file, as matrices, of all frames of the scene and the bodies that may move. Returns the number of frames.
int write_pose_log(const Scene& scene, const std::filesystem::path& file);

// A row of a log as a simulator has it.
struct LoggedPose {
  std::uint32_t body = 0;
  std::array<float, 3> translation = {};  // metres
  std::array<float, 4> quaternion_wxyz = {};

  bool operator==(const LoggedPose&) const = default;
};

// Writes such a file frame by frame, with quaternions. Frame 0 has every body that moves, a later one those that moved.
class PoseLogWriter {
 public:
  explicit PoseLogWriter(const std::filesystem::path& file);
  void add(int frame, std::span<const LoggedPose> poses);
  void close() { csv_.close(); }

 private:
  files::CsvWriter csv_;
};

}  // namespace touchstone::scene
