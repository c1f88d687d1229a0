#include <algorithm>
#include <cctype>
#include <cstdio>
#include <filesystem>
#include <sstream>

#include "base/error.h"
#include "io/make_request.h"
#include "io/publish.h"

namespace whine {
namespace {
namespace fs = std::filesystem;
using Words = std::vector<std::string>;

bool plain_file(const std::string& path) {
  std::error_code ignored;
  return fs::is_regular_file(path, ignored);
}

bool same_file(const std::string& one, const std::string& other) {
  std::error_code ignored;
  return fs::equivalent(one, other, ignored);
}

std::string base_of(const std::string& path) {
  const std::string file = fs::path(path).filename().string();
  return file.ends_with(".toml") ? file.substr(0, file.size() - 5) : file;
}

// What make and its recipes read to the end: a pipe, a device or a folder has none.
void check_file(const std::string& variable, const std::string& path) {
  if (path.starts_with('-'))
    refuse(variable, path, "programs take a name that begins with - for an option; write ./", path);
  if ((variable != "STUDY" || path.ends_with(".toml")) && present(path) && !plain_file(path))
    refuse(variable, path, "it is no regular file; give the path of a file");
}

// Its file's name becomes a folder, a part of variables and a target.
void check_stem(const std::string& variable, const std::string& path) {
  const std::string stem = base_of(path);
  if (stem.empty()) refuse(variable, path, "the file has no name before .toml; rename the file");
  if (stem.find_first_of(".+@,") != std::string::npos)
    refuse(variable, path, "the name '", stem,
           "' becomes a folder and a target, so it may hold letters, digits, _ and - only; rename the file");
}

// Scenes of one name share out/<name>, and one's own must not take the place of the project's.
void check_of_project(const std::string& variable, const std::string& path, const std::string& folder,
                      const std::string& results) {
  const std::string own = folder + "/" + base_of(path) + ".toml";
  if (present(own) && present(path) && read_bytes(own) != read_bytes(path))
    refuse(variable, path, results, "/", base_of(path), " is of ", own,
           ", which says otherwise; rename the file");
}

void check_scene_file(const std::string& variable, const std::string& path) {
  if (!present(path)) {
    std::string there;
    for (const std::string& other : {path + ".toml", "data/scenes/" + path, "data/scenes/" + path + ".toml"})
      if (there.empty() && present(other)) there = "; there is " + other;
    refuse(variable, path, "there is no such file", there);
  }
  if (!path.ends_with(".toml")) refuse(variable, path, "a scene is a .toml file");
  check_stem(variable, path);
  const std::string stem = base_of(path);
  if (listed_in({"figures", "bodies", "studies", "compare", "reading"}, stem))
    refuse(variable, path, "out/", stem, " has another use; rename the file");
  check_of_project(variable, path, "data/scenes", "out");
}

Words studies_of_project() {
  Words out;
  std::error_code none;
  for (const auto& entry : fs::directory_iterator("data/studies", none))
    if (entry.path().extension() == ".toml") out.push_back(entry.path().stem().string());
  std::sort(out.begin(), out.end());
  return out;
}

void check_study(const MakeRequest& request) {
  const std::string& study = request.value("STUDY");
  const bool own = study.ends_with(".toml");
  if (!study.empty()) {
    if (!own && study.find('/') != std::string::npos) refuse("STUDY", study, "a study is a .toml file");
    check_stem("STUDY", study);
    if (own) check_of_project("STUDY", study, "data/studies", "out/studies");
  }
  Words wanted;
  for (const char* goal : {"study", "study-bodies"}) {
    if (!request.asks(goal)) continue;
    if (study.empty())
      fail(Failure::input, goal, ": which study? make ", goal,
           " STUDY=<name>; there are: ", joined_by(" ", studies_of_project()), ", or a path to one of yours");
    wanted.push_back(base_of(study));
  }
  for (const std::string& goal : request.goals)
    if (goal.starts_with("out/studies/")) wanted.push_back(goal.substr(12, goal.find('/', 12) - 12));
  for (const std::string& name : wanted) {
    const std::string file = own && name == base_of(study) ? study : "data/studies/" + name + ".toml";
    if (!present(file))
      fail(Failure::input, "STUDY=", name, ": there is no ", file,
           "; there are: ", joined_by(" ", studies_of_project()),
           "; for a study elsewhere say STUDY=path/to/<name>.toml");
  }
  const std::string& share = request.value("SHARE");
  long part = 0, parts = 0;
  char more = 0;
  if (request.asks("study") && !share.empty() &&
      (share.size() > 19 || std::sscanf(share.c_str(), "%9ld/%9ld%c", &part, &parts, &more) != 2 ||
       !std::isdigit(static_cast<unsigned char>(share[0])) || part < 1 || part > parts))
    refuse("SHARE", share, "it is i/n, the i-th of n shares, such as 3/10, with 999999999 shares at most");
}

void check_compared(const MakeRequest& request) {
  const std::string &scene = request.value("SCENE"), &study = request.value("STUDY");
  for (const std::string& goal : request.goals)
    if (goal.starts_with("out/compare/"))
      fail(Failure::input, "out/compare: say make compare SCENES='a.toml b.toml'");
  if (!request.asks("compare")) return;
  Words files = request.words("SCENES"), stems;
  for (const std::string& file : files) {
    check_scene_file("SCENES", file);
    if (listed_in(stems, base_of(file)))
      fail(Failure::input, "SCENES: two files are called ", base_of(file), ".toml, which would share out/",
           base_of(file), "; rename one");
    stems.push_back(base_of(file));
  }
  if (files.empty() && !study.empty())
    for (const char* which : {"-first", "-second"}) stems.push_back(base_of(study) + which);
  if (stems.size() < 2 || stems.size() > 6)
    fail(
        Failure::input,
        "compare: which scenes? two to six of them: make compare SCENES='a.toml b.toml'; or STUDY=<name>, a study that marks two variants");
  if (scene.empty()) return;
  for (size_t i = 0; i < stems.size(); ++i)
    if (stems[i] == base_of(scene) && (files.empty() || !same_file(scene, files[i])))
      refuse("SCENE", scene, "out/", stems[i], " is of ", files.empty() ? stems[i] : files[i],
             ", which is compared; rename the file");
}

void check_models(const MakeRequest& request) {
  const std::string &transfer = request.value("TRANSFER"), &model = request.value("MODEL");
  if (request.asks("sound") && !transfer.empty() && !present(transfer))
    refuse("TRANSFER", transfer, "there is no such file");
  if (!request.asks("export")) return;
  if (model.empty())
    fail(
        Failure::input,
        "export: which model? make export SCENE=my-pair.toml MODEL=stage.rexs, the REXS model that the scene was imported from");
  if (!present(model)) refuse("MODEL", model, "there is no such file");
}

}  // namespace

void check_files(const MakeRequest& request) {
  for (const char* variable : {"SCENE", "STUDY", "TRANSFER", "MODEL", "SCENES"})
    for (const std::string& file : request.words(variable)) check_file(variable, file);
  if (const std::string& scene = request.value("SCENE"); !scene.empty()) check_scene_file("SCENE", scene);
  check_study(request);
  check_compared(request);
  check_models(request);
}

}  // namespace whine
