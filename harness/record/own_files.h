// The files below a folder of results that this program wrote and may remove.
//
// FOLDER/files.txt lists them, a path in the folder a line. Whatever else is in the folder is
// somebody else's: it is neither removed nor overwritten. The files of rows, machine.csv and others
// with fixed names are not in the list; ResultFolder knows them.
#pragma once

#include <filesystem>
#include <functional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace touchstone::record {

class OwnFiles {
 public:
  static constexpr const char* list_name = "files.txt";

  // Throws InputError if the list is no regular file, or names a path outside the folder.
  explicit OwnFiles(std::filesystem::path folder);

  bool has(const std::string& name) const { return names_.contains(name); }

  // Returns FOLDER/SUBFOLDER/NAME, where the name is that of base::safe_file_name, followed by "-2",
  // "-3", ... if a file there already has it with any ending. Makes the subfolder; "" is the folder
  // itself. Throws InputError if a symbolic link is on the way, or the subfolder cannot be made.
  std::filesystem::path free_stem(const std::filesystem::path& subfolder,
                                  std::string_view text) const;
  // Adds files of the folder to the list. Throws InputError if the list cannot be written.
  void note(const std::vector<std::filesystem::path>& files);
  // Adds the files that are there and are called the stem and an ending.
  void note_stem(const std::filesystem::path& stem);
  // Removes the listed files of which `is_meant` is true for the path in the folder, and the
  // subfolders that are empty then. A file behind a symbolic link stays. Throws InputError if one
  // cannot be removed.
  void remove(const std::function<bool(const std::string&)>& is_meant);

 private:
  std::filesystem::path list() const { return folder_ / list_name; }
  void write() const;
  // Returns true if a folder between this one and the file is a symbolic link.
  bool is_behind_link(const std::filesystem::path& name) const;

  std::filesystem::path folder_;
  std::set<std::string> names_;
};

}  // namespace touchstone::record
