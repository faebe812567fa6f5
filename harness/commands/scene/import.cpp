// touchstone scene import: makes a folder of a scene and of all files that it needs.
#include <fmt/core.h>
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <memory>
#include <regex>
#include <set>
#include <span>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "harness/base/error.h"
#include "harness/base/input_file.h"
#include "harness/base/table.h"
#include "harness/commands/arguments.h"
#include "harness/commands/commands.h"
#include "harness/files/text_file.h"
#include "harness/files/toml_table.h"
#include "harness/geometry/mesh.h"
#include "harness/models/model.h"
#include "harness/scene/model_scene.h"
#include "harness/scene/robot/planning_scene.h"
#include "harness/scene/robot/xml_element.h"
#include "harness/scene/scene.h"

namespace touchstone::commands {
namespace {

namespace fs = std::filesystem;

struct ImportOptions {
  std::vector<std::string> files;
  std::string out;
};

fs::path whole_path(const fs::path& file) { return fs::absolute(file).lexically_normal(); }

// Whether a path, relative to a folder, leads out of it.
bool is_outside(const fs::path& relative) { return relative.empty() || *relative.begin() == ".."; }

std::string ending_of(const fs::path& file) {
  std::string ending = file.extension().string();
  std::ranges::transform(ending, ending.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending;
}

std::string opening_of(const fs::path& file) {
  std::string opening(4096, '\0');
  base::InputFile input(file);
  std::size_t size = 0;
  while (const std::size_t got =
             size < opening.size() ? input.read(std::span(opening).subspan(size)) : 0) {
    size += got;
  }
  opening.resize(size);
  return opening;
}

// The key of a scene that takes a file.
std::string key_of(const fs::path& file) {
  const std::string ending = ending_of(file);
  if (ending == ".toml" || ending == ".json" || ending == ".urdf" || ending == ".aabbs") {
    return "import";
  }
  if (models::is_model_file(file)) return "import";
  if (ending == ".srdf") return "srdf";
  if (scene::is_yaml(file)) {
    const bool is_request = files::read_text(file).find("goal_constraints") != std::string::npos;
    return is_request ? "configurations" : "obstacles";
  }
  if (ending == ".csv") {
    const std::string opening = opening_of(file);
    const std::string header = "," + opening.substr(0, opening.find_first_of("\r\n")) + ",";
    const bool is_log =
        header.find(",frame,") != std::string::npos && header.find(",body,") != std::string::npos;
    return is_log ? "poses" : "configurations";
  }
  if (geometry::is_mesh_file(file)) return "mesh";
  if (ending == ".xacro") return "import";  // where it is said how to expand it
  throw base::InputError(file.string(), 0,
                         "unknown kind of file; expected .toml, .json, .urdf, .srdf, .aabbs, "
                         ".yaml, .csv, a mesh (.obj, .off, .stl, .ply) or a model (.glb, .gltf, "
                         ".dae, .fbx, .3ds)");
}

// What a file that was read is.
std::string kind_of(const fs::path& file) {
  static const std::map<std::string, std::string> by_ending = {{".toml", "scene"},
                                                               {".json", "rigid-ipc scene"},
                                                               {".urdf", "robot"},
                                                               {".srdf", "SRDF"},
                                                               {".aabbs", "recording of boxes"}};
  const auto known = by_ending.find(ending_of(file));
  if (known != by_ending.end()) return known->second;
  if (geometry::is_mesh_file(file)) return "mesh";
  const bool is_csv = ending_of(file) == ".csv";
  const std::string opening = opening_of(file);
  const bool has_header = opening.find_first_of("0123456789+-.") != 0;
  if (!scene::is_yaml(file) && !(is_csv && has_header)) return "heights";
  const std::string key = key_of(file);
  return key == "obstacles" ? "planning scene" : key == "poses" ? "log of poses" : key;
}

// A scene that names all of the files.
std::string scene_text(const std::vector<fs::path>& given) {
  toml::table keys;
  toml::array imports, bodies;
  for (const fs::path& file : given) {
    const std::string key = key_of(file);
    if (key == "import") {
      imports.push_back(file.string());
    } else if (key == "mesh") {
      bodies.push_back(toml::table{{"mesh", file.string()}});
    } else if (!keys.insert(key, file.string()).second) {
      throw base::InputError(file.string(), 0,
                             "a second file for the key `" + key + "`; expected one");
    }
  }
  if (!imports.empty()) keys.insert("import", std::move(imports));
  if (!bodies.empty()) keys.insert("body", std::move(bodies));
  std::ostringstream text;
  text << keys << "\n";
  return text.str();
}

// The innermost folder that holds them all, and the packages that they name.
fs::path folder_of(const std::set<fs::path>& read) {
  fs::path folder = read.begin()->parent_path();
  std::set<std::string> packages;
  for (const fs::path& file : read) {
    while (is_outside(file.lexically_relative(folder))) folder = folder.parent_path();
    if (ending_of(file) != ".urdf") continue;
    const std::string text = files::read_text(file);
    constexpr std::string_view mark = "://";
    for (auto at = text.find(mark); at != std::string::npos; at = text.find(mark, at + 1)) {
      const std::size_t name = at + mark.size(), end = text.find_first_of("/\"", name);
      if (end != std::string::npos && text[end] == '/')
        packages.insert(text.substr(name, end - name));
    }
  }
  fs::path outer = folder;
  for (fs::path at = folder; at.has_relative_path(); at = at.parent_path()) {
    if (packages.contains(at.filename().string())) outer = at;
  }
  return outer;
}

// What is written of a model: a scene where it is imported, and a mesh where it is one.
constexpr std::string_view model_scene_ending = ".toml", model_mesh_ending = ".off";

class Copies {
 public:
  // `read` are whole paths.
  Copies(const fs::path& out, const std::set<fs::path>& read) : out_(whole_path(out)) {
    if (read.empty()) return;
    from_ = folder_of(read);
    const fs::path name = from_.filename();
    to_ = out_ / (name.empty() ? fs::path("files") : name);
    for (const fs::path& file : read) targets_[file] = to_ / file.lexically_relative(from_);
  }

  const std::map<fs::path, fs::path>& targets() const { return targets_; }

  // The files that are to be written of models, each by the model.
  const std::set<std::pair<fs::path, std::string_view>>& of_models() const { return of_models_; }

  // A file that was read, or a folder that holds some, as the copy in `folder` names it; else empty. `key` is the one that
  // names it.
  std::string renamed(const fs::path& path, const fs::path& folder, std::string_view key) {
    const auto target = targets_.find(path);
    if (target != targets_.end()) {
      const std::string name = target->second.lexically_relative(folder).generic_string();
      if (!models::is_model_file(path)) return name;
      const auto ending = key == "import" ? model_scene_ending : model_mesh_ending;
      of_models_.insert({path, ending});
      return name + std::string(ending);
    }
    const fs::path inside = path.lexically_relative(from_);
    const bool holds = std::ranges::any_of(targets_, [&](const auto& copy) {
      return !is_outside(copy.first.lexically_relative(path));
    });
    if (!holds || is_outside(inside)) return "";
    return (to_ / inside).lexically_normal().lexically_relative(folder).generic_string();
  }

  // The text of a TOML file with the names of the copies. It was in one folder, and will be in another.
  std::string with_names(std::string text, const fs::path& was_in, const fs::path& is_in) {
    std::map<std::string, std::string> names;
    collect(toml::parse(text), "", was_in, is_in, names);
    // In one pass, so that a new name is not taken for an old one.
    for (std::size_t at = 0; at < text.size(); ++at) {
      const char quote = text[at];
      if (quote != '"' && quote != '\'') continue;
      for (const auto& [old_name, new_name] : names) {
        if (text.compare(at, old_name.size() + 2, quote + old_name + quote) != 0) continue;
        std::ostringstream word;
        word << toml::value<std::string>(new_name);  // with what TOML escapes
        text.replace(at, old_name.size() + 2, word.str());
        at += word.str().size() - 1;
        break;
      }
    }
    return text;
  }

  // The text of a robot or of a rigid-ipc scene, in which models that were read are meshes.
  std::string with_meshes(std::string text) {
    std::set<std::string> done;
    for (const auto& [path, target] : targets_) {
      if (!models::is_model_file(path)) continue;
      const std::string name = path.filename().string();
      for (std::size_t at = text.find(name); at != std::string::npos;
           at = text.find(name, at + 1)) {
        const std::size_t end = at + name.size();
        const bool is_whole = at > 0 && end < text.size() &&
                              std::string_view("/\"'").find(text[at - 1]) != std::string::npos &&
                              std::string_view("\"'").find(text[end]) != std::string::npos;
        if (!is_whole) continue;
        of_models_.insert({path, model_mesh_ending});
        if (!done.contains(name)) text.insert(end, model_mesh_ending);
      }
      done.insert(name);
    }
    return text;
  }

 private:
  void collect(const toml::node& node, std::string_view key, const fs::path& was_in,
               const fs::path& is_in, std::map<std::string, std::string>& names) {
    if (const toml::table* table = node.as_table()) {
      for (const auto& [inner, value] : *table) collect(value, inner.str(), was_in, is_in, names);
    } else if (const toml::array* array = node.as_array()) {
      for (const toml::node& value : *array) collect(value, key, was_in, is_in, names);
    } else if (const auto* text = node.as_string()) {
      if ((*text)->empty()) return;
      const std::string name = renamed((was_in / **text).lexically_normal(), is_in, key);
      if (name.empty() || name == **text) return;
      const auto [known, is_new] = names.try_emplace(**text, name);
      if (is_new || known->second == name) return;
      throw base::InputError(**text, 0,
                             "one file names this model as a mesh and imports it; expected a copy "
                             "of it for one of the two");
    }
  }

  fs::path out_, from_, to_;
  std::map<fs::path, fs::path> targets_;
  std::set<std::pair<fs::path, std::string_view>> of_models_;
};

// How many elements of each name the readers of robots leave out.
void count_left_out(const scene::XmlElement& element, const std::set<std::string>& known,
                    std::map<std::string, int>& left_out) {
  for (const scene::XmlElement& inner : element.children()) {
    if (known.contains(inner.name())) {
      count_left_out(inner, known, left_out);
    } else {
      ++left_out[inner.name()];
    }
  }
}

std::string left_out_of(const fs::path& file) {
  static const std::map<std::string, std::set<std::string>> known = {
      {".urdf",
       {"link", "joint", "collision", "geometry", "box", "cylinder", "sphere", "capsule", "mesh",
        "origin", "parent", "child", "axis", "limit", "mimic"}},
      {".srdf",
       {"group_state", "joint", "disable_collisions", "enable_collisions",
        "disable_default_collisions"}}};
  const auto at = known.find(ending_of(file));
  if (at == known.end()) return "";
  const scene::XmlFile xml(file, "robot");
  std::map<std::string, int> left_out;
  count_left_out(xml.root(), at->second, left_out);
  std::vector<std::string> words;
  for (const auto& [name, count] : left_out) words.push_back(fmt::format("{} {}", count, name));
  return fmt::format("{}", fmt::join(words, ", "));
}

// A licence file in the folder, or in one of the three above it.
fs::path licence_file(fs::path folder) {
  for (int i = 0; i < 4; ++i, folder = folder.parent_path()) {
    for (const char* name : {"LICENSE", "LICENSE.txt", "LICENSE.md", "LICENCE", "LICENCE.txt",
                             "LICENCE.md", "COPYING", "COPYING.txt"}) {
      std::error_code error;
      if (fs::is_regular_file(folder / name, error)) return folder / name;
    }
  }
  return {};
}

// The first words of a licence.
std::string title_of(const fs::path& file) {
  std::istringstream lines(opening_of(file));
  for (std::string line; std::getline(lines, line);) {
    const auto begin = line.find_first_not_of(" \t\r#*");
    if (begin != std::string::npos) {
      return std::string(
          base::shortened(line.substr(begin, line.find_last_not_of(" \t\r") + 1 - begin)));
    }
  }
  return "without text";
}

std::string own_licence(const fs::path& file) {
  static const std::regex tag("SPDX-License-Identifier: *([A-Za-z0-9.+ ()-]+)");
  const std::string text = opening_of(file);
  std::smatch match;
  return std::regex_search(text, match, tag) ? match[1].str() : "";
}

// Removes what it made, unless all went well.
class NewFolder {
 public:
  explicit NewFolder(fs::path folder) : folder_(std::move(folder)) {
    std::error_code error;
    if (fs::exists(folder_, error)) {
      throw base::InputError("--out: " + folder_.string() + " is there; expected a new folder");
    }
    if (!fs::create_directories(folder_, error)) {
      throw base::InputError("--out: " + folder_.string() + " cannot be made: " + error.message());
    }
  }
  ~NewFolder() {
    std::error_code ignored;
    if (!is_kept_) fs::remove_all(folder_, ignored);
  }
  NewFolder(const NewFolder&) = delete;
  NewFolder& operator=(const NewFolder&) = delete;
  void keep() { is_kept_ = true; }

 private:
  fs::path folder_;
  bool is_kept_ = false;
};

void write_copy(const fs::path& to, const std::string& text) {
  std::error_code error;
  fs::create_directories(to.parent_path(), error);
  files::write_text(to, text);
}

struct OfModel {
  std::string words, left_out;
};

// Writes what our own readers take, so that the folder needs no Assimp.
OfModel write_model(const fs::path& from, const fs::path& to) {
  std::error_code error;
  fs::create_directories(to.parent_path(), error);
  if (to.extension() == model_scene_ending) {
    const scene::PlacedModel model = scene::place_model(from);
    scene::write_model(model, to);
    return {model.words, model.left_out};
  }
  const models::Model model = models::read_model(from);
  models::ModelMesh whole = models::whole_mesh(from.string(), model);
  scene::write_off(to, {std::move(whole.vertices), std::move(whole.triangles)});
  return {fmt::format("mesh of a model; {}, {} up",
                      model.metres == 1 ? "metres" : fmt::format("unit {} m", model.metres),
                      model.up()),
          model.left_out.words()};
}

void import_scene(const ImportOptions& options) {
  std::vector<fs::path> given;
  for (const std::string& file : options.files) {
    base::check_kind(file, "a file of a scene");
    given.push_back(whole_path(file));
  }
  const fs::path out = whole_path(options.out), scene_file = out / "scene.toml";
  // A scene by itself stays as it is; others become one that names them.
  const bool is_scene = given.size() == 1 && ending_of(given[0]) == ".toml";
  const fs::path was_in = is_scene ? given[0].parent_path() : out;
  const std::string text = is_scene ? files::read_text(given[0]) : scene_text(given);
  const scene::Scene scene =
      is_scene ? scene::load_scene(given[0]) : scene::scene_of_text(text, scene_file);
  std::set<fs::path> read;
  for (const fs::path& file : scene.files) read.insert(whole_path(file));
  if (is_scene) read.erase(given[0]);
  Copies copies(out, read);

  NewFolder folder(out);
  base::Table table({"file", "read as", "left out", "licence"});
  std::set<fs::path> licences;
  const auto licence_of = [&](const fs::path& file) {
    const std::string own = own_licence(file);
    if (!own.empty()) return own;
    const fs::path beside = licence_file(file.parent_path());
    if (beside.empty()) return std::string("-");
    licences.insert(beside);
    return title_of(beside);
  };
  const auto add = [&](const fs::path& from, const fs::path& to) {
    const std::string left_out = left_out_of(from);
    table.add({to.lexically_relative(out).generic_string(), kind_of(from),
               left_out.empty() ? "-" : left_out, licence_of(from)});
  };
  if (is_scene) add(given[0], scene_file);
  const std::string own_text = copies.with_names(text, was_in, out);
  for (const auto& [from, to] : copies.targets()) {
    if (models::is_model_file(from)) continue;
    const std::string content = files::read_text(from), ending = ending_of(from);
    write_copy(to, ending == ".toml"
                       ? copies.with_names(content, from.parent_path(), to.parent_path())
                   : ending == ".urdf" || ending == ".json" ? copies.with_meshes(content)
                                                            : content);
    add(from, to);
  }
  for (const auto& [from, ending] : copies.of_models()) {
    const fs::path to = copies.targets().at(from).string() + std::string(ending);
    const auto [words, left_out] = write_model(from, to);
    table.add({to.lexically_relative(out).generic_string(), words,
               left_out.empty() ? "-" : left_out, licence_of(from)});
  }
  int number = 0;
  for (const fs::path& licence : licences) {
    const std::string name = number++ == 0 ? "LICENSE" : fmt::format("LICENSE-{}", number);
    write_copy(out / name, files::read_text(licence));
  }
  write_copy(scene_file, own_text);
  const scene::Scene again = scene::load_scene(scene_file);
  for (const fs::path& file : again.files) {
    if (!is_outside(whole_path(file).lexically_relative(out))) continue;
    throw base::InputError(options.files[0], 0,
                           fmt::format("names {} by a whole path; expected one that begins at the "
                                       "file which names it",
                                       file.string()));
  }
  const std::string hash = scene::scene_hash(scene), copied = scene::scene_hash(again);
  if (hash != copied) {
    throw base::InputError(options.files[0], 0,
                           fmt::format("the folder has another scene ({}, and not {}); expected "
                                       "names of files that are whole words in quotes",
                                       copied, hash));
  }
  folder.keep();
  fmt::print("{}\n{}: {} bodies, {} frame{} ({})\n", table.text(base::page_width()),
             scene_file.string(), scene.size(), scene.frames, scene.frames == 1 ? "" : "s", hash);
}

}  // namespace

void add_scene_import(Arguments command) {
  const auto options = std::make_shared<ImportOptions>();
  command
      .texts("FILE", options->files,
             "A scene (.toml, .json of rigid-ipc, .urdf, .aabbs, a model such as .glb or .dae), or "
             "parts of one: a log of poses or configurations (.csv), an SRDF file, a planning "
             "scene or request (.yaml), meshes")
      .required()
      .is_read();
  command.text("--out", options->out, "The folder to make").required();
  command.footer(
      "The folder holds all that its scene.toml needs. A licence is what a file names, or the "
      "first line of a "
      "LICENSE file beside or above it, which is copied too.");
  command.job([options] {
    import_scene(*options);
    return exit_done;
  });
}

}  // namespace touchstone::commands
