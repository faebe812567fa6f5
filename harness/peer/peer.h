// Peers: programs that answer questions behind a pipe, and files of what they answered. Each becomes entries of the
// registry. results/peer_protocol.md has the lines that go to and fro.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "harness/peer/use.h"

namespace touchstone::peer {

inline constexpr int protocol_version = 1;

// The first line of this program to a peer, with the line break.
std::string greeting();

// A row for each program that was added.
std::vector<PeerRow> peer_rows();

// Starts what is named, which is an adapter, NAME or NAME@VERSION, or its folder, or a command for the shell; reads its
// first line, ends it, and adds it to the registry for each kind that it offers. Returns the name of its entries. Each
// child process that asks it starts it anew. If `repeat` is not 0, each question but those of boxes asks for so many
// repeats. Throws base::InputError where it cannot be asked.
std::string add(const std::string& named, std::int64_t repeat = 0);

// Adds the peer that wrote this file of answers. A question that is not in it is `unsupported`. Throws base::InputError
// with the line.
std::string add_answers(const std::filesystem::path& file);

// An entry of every kind that is asked by lines of text, which keeps the questions that it is asked and calls them unsupported.
class QuestionWriter {
 public:
  QuestionWriter();  // adds it to the registry; throws std::system_error if there is no temporary file
  const std::string& name() const { return name_; }
  // Writes the greeting and all questions to the file. Returns the number of lines behind the greeting, those of meshes
  // too. Throws base::InputError if it cannot be written.
  std::int64_t save(const std::filesystem::path& file) const;

 private:
  class Kept;
  std::shared_ptr<Kept> kept_;
  std::string name_;
};

}  // namespace touchstone::peer
