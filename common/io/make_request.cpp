#include "io/make_request.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "base/error.h"
#include "base/tool.h"
#include "io/suggestion.h"

namespace whine {
namespace {
namespace fs = std::filesystem;

enum class GivenAs { word, list, options };
struct Variable {
  std::string name;
  GivenAs as = GivenAs::word;
  bool slash = false;  // it may hold /
};
struct Group {
  GivenAs as;
  bool slash;
  const char* names;
};
// What makefiles read of a user. Numbers and words become parts of paths, so a / in them would lead out of their folder.
constexpr Group kGroups[] = {
    {GivenAs::word, true, "SCENE STUDY TRANSFER MODEL SHARE"},
    {GivenAs::list, true, "SCENES STAGE"},
    {GivenAs::options, true, "VARIANTS HARRIS_OPTIONS"},
    {GivenAs::options, false, "AXIS"},
    {GivenAs::list, false,
     "BESIDE JUMP_MAP_TORQUES JUMP_MAP_CORNERS JUMP_MAP_MODELS JUMP_MAP_RATIOS FOLD_RATIOS FOLD_TORQUES FOLD_RELIEFS FOLD_STIFFNESSES FOLD_CURVE_TORQUES"},
    {GivenAs::word, false,
     "TORQUE MESH PHASE DAMPING STATE AT DB RATE FROM TO WAY BRANCHES ERRORS JUMP_MAP JUMP_MAP_STEP JUMP_MAP_LOADS_AT JUMP_MAP_CELLS SENSITIVITY SENSITIVITY_FACTOR SENSITIVITY_RATIO SENSITIVITY_STEP HARRIS_DYNAMIC FOLDS_OVER FOLD_FIRST READING_PARTS FAULT_KILLS STRESS_PROBLEMS STRESS_SCENES STRESS_SEED FUZZ_SECONDS LAUNCH_WAIT FREEZE SANITIZE"}};
// Commands themselves, which nobody judges.
const std::vector<std::string> kCommands{"LAUNCH", "B", "CXX", "ARCH", "CXXFLAGS", "LDFLAGS"};
const Variable kTarget{"target", GivenAs::list, true};

using Words = std::vector<std::string>;

Words split_words(const std::string& line) {
  std::istringstream in(line);
  Words out;
  for (std::string word; in >> word;) out.push_back(word);
  return out;
}

std::vector<Variable> known_variables() {
  std::vector<Variable> out;
  for (const Group& group : kGroups)
    for (const std::string& name : split_words(group.names)) out.push_back({name, group.as, group.slash});
  return out;
}

// --- characters

std::string remedy_of(const Variable& variable) {
  const std::string& name = variable.name;
  return text(", and may hold letters, digits", variable.as == GivenAs::word ? "" : ", blanks",
              " and . _ - + , @", variable.slash ? " /" : "", variable.as == GivenAs::options ? " : =" : "",
              " only",
              name == "SCENE" || name == "SCENES" || name == "STUDY" ? "; rename the file or its folder"
              : name == "DAMPING" ? "; it is a share of critical damping: 0.05 for 5 %"
                                  : "");
}

// Letters of any alphabet are allowed: bytes beyond ASCII.
void check_characters(const Variable& variable, const std::string& value) {
  const std::string remedy = remedy_of(variable);
  const std::string& name = variable.name;
  // As make gives it on the command line, or as it stands in the environment.
  if (value.find("\\n") != std::string::npos || value.find('\n') != std::string::npos)
    fail(Failure::input, name, ": it holds a line break", remedy);
  for (const unsigned char c : value)
    if (c != '\t' && (c < 32 || c == 127))
      fail(Failure::input, name, ": it holds a control character", remedy);
  const std::string allowed =
      std::string("._-+,@ \t") + (variable.slash ? "/" : "") + (variable.as == GivenAs::options ? ":=" : "");
  Words found;
  for (const unsigned char c : value)
    if (c < 128 && !std::isalnum(c) && allowed.find(static_cast<char>(c)) == std::string::npos)
      if (const std::string word(1, static_cast<char>(c)); !listed_in(found, word)) found.push_back(word);
  if (!found.empty())
    fail(Failure::input, name, name == kTarget.name ? " " : "=", value, ": it holds ", joined_by(" ", found),
         remedy);
  if (variable.as == GivenAs::word && value.find_first_of(" \t") != std::string::npos)
    refuse(name, value, "it holds blanks", remedy);
}

// --- targets and variables that exist

// What `make help` lists: "target: ... ## what it makes" of makefiles, figures as "  fig12: what it shows" of help.txt.
Words documented_targets() {
  std::vector<fs::path> files{"Makefile", "pipelines/help.txt"};
  std::error_code none;
  for (const char* folder : {"pipelines", "tests"})
    for (const auto& entry : fs::directory_iterator(folder, none))
      if (entry.path().extension() == ".mk") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  Words out;
  for (const fs::path& file : files) {
    const std::string indent = file.extension() == ".txt" ? "  " : "", mark = indent.empty() ? "## " : ": ";
    std::ifstream in(file);
    for (std::string line; std::getline(in, line);) {
      if (!line.starts_with(indent)) continue;
      const size_t begin = indent.size(),
                   end = line.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789-", begin);
      if (end != begin && end != std::string::npos && line[end] == ':' &&
          line.find(mark, end) != std::string::npos)
        out.push_back(line.substr(begin, end - begin));
    }
  }
  return out;
}

std::string meant(const std::string& word, const Words& known) {
  const std::string near = nearest(word, known);
  return near.empty() || near.front() != word.front() ? "" : " did you mean " + near + "?";
}

// Targets that trains once had of their own.
constexpr std::pair<const char*, const char*> kRenamed[] = {{"system-static", "static"},
                                                            {"system-sweep", "sweep"},
                                                            {"system-ringdown", "impact"},
                                                            {"system-branch", "branches"}};

void check_target(const std::string& goal, const Words& known) {
  for (const auto& [before, now] : kRenamed)
    if (goal == before)
      fail(Failure::input, goal, ": it is called ", now, " for every scene: make SCENE=path/to/train.toml ",
           now);
  const bool scene = goal.ends_with(".toml");
  if (goal.find('/') != std::string::npos || goal == "FORCE" || listed_in(known, goal) ||
      (present(goal) && !scene))
    return;
  if (scene)
    fail(Failure::input, goal, ": a scene is given by SCENE in front of a target: make SCENE=", goal,
         " report");
  if (!goal.starts_with("fig") || goal.size() < 4 || !std::isdigit(static_cast<unsigned char>(goal[3])))
    fail(Failure::input, goal, ": there is no such target;", meant(goal, known), " `make help` lists them");
  Words figures;
  for (const std::string& target : known)
    if (target.starts_with("fig") && target != "figures") figures.push_back(target);
  std::sort(figures.begin(), figures.end());
  fail(Failure::input, goal, ": there is no such figure; there are ", joined_by(" ", figures),
       " and table1 (Figures 2, 4 and 6 of P2000 are a sketch and measurements)");
}

// A variable that nothing reads is a slip of the pen, which would otherwise be ignored without a word.
void check_variable(const std::string& name) {
  if (name == "SHELL" || name.starts_with("MAKE") || name.starts_with("LAUNCH_")) return;
  Words known = kCommands;
  for (const Variable& variable : known_variables()) known.push_back(variable.name);
  if (!listed_in(known, name))
    fail(Failure::input, name, ": there is no such variable;", meant(name, known),
         " pipelines/README.md lists them");
}

// --- values

// Of [least, limit), decimal, nothing before or after it.
bool within(const std::string& value, double least, double limit) {
  char* end = nullptr;
  const double x = std::strtod(value.c_str(), &end);
  return !value.empty() && *end == '\0' && value.find_first_not_of("0123456789.eE+-") == std::string::npos &&
         (std::isdigit(static_cast<unsigned char>(value[0])) || value[0] == '.') && x >= least && x < limit;
}

bool positive(const std::string& value) {
  return within(value, 1e-9, 1e9);
}

void check_choices(const MakeRequest& request) {
  static const std::pair<const char*, std::pair<Words, const char*>> kChoices[] = {
      {"BRANCHES", {{"yes", "no"}, "it is yes or no"}},
      {"ERRORS", {{"yes", "no"}, "it is yes or no"}},
      {"WAY", {{"up", "down"}, "it is up or down"}},
      {"JUMP_MAP", {{"coarse", "fine"}, "it is coarse or fine"}},
      {"SENSITIVITY", {{"coarse", "fine"}, "it is coarse or fine"}},
      {"FOLDS_OVER",
       {{"damping", "torque", "bearing_stiffness", "tip_relief"},
        "it is damping, torque, bearing_stiffness or tip_relief"}}};
  for (const auto& [name, choice] : kChoices)
    if (const std::string& value = request.value(name); !value.empty() && !listed_in(choice.first, value))
      refuse(name, value, choice.second);
  const std::string& axis = request.value("AXIS");
  if (!axis.empty() && (!axis.starts_with("rpm:") || axis.size() < 5 || split_words(axis).size() != 1))
    refuse("AXIS", axis,
           "it is rpm:<gear>, such as rpm:pinion or rpm:driver, of a train rpm:<gear or carrier>");
  if (const std::string& db = request.value("DB"); !db.empty() && !within(db, 1e-300, 1e300))
    refuse("DB", db, "it is the length in m that is 0 dB, such as 1e-6");
  for (const std::string& variant : split_words(request.value("VARIANTS"))) {
    const size_t colon = variant.find(':');
    if (colon == std::string::npos || variant.find('=') == std::string::npos)
      fail(Failure::input, "VARIANTS: ", variant, ": write name:key=value, as in bore35:bore_radius_mm=35");
    if (const std::string name = variant.substr(0, colon); name.find_first_of("/.+@,=") != std::string::npos)
      fail(Failure::input, "VARIANTS: ", variant, ": the name '", name,
           "' becomes a folder, so it may hold letters, digits, _ and - only");
  }
}

void check_motions(const MakeRequest& request) {
  const std::string &at = request.value("AT"), &rate = request.value("RATE"), &from = request.value("FROM"),
                    &to = request.value("TO"), &damping = request.value("DAMPING"),
                    &phase = request.value("PHASE");
  const bool runup = request.asks("runup"), sound = request.asks("sound");
  if (request.asks("calibrate") && !damping.empty() && !within(damping, 1e-12, 1))
    refuse("DAMPING", damping, "it is a share of critical damping, above 0 and below 1: 0.05 for 5 %");
  if (request.asks("histories") && !positive(at))
    fail(Failure::input, "histories: AT=", at,
         ": say the mesh frequency in Hz, one of the sweep: make histories AT=1300");
  if (sound && !runup && !at.empty() && !rate.empty())
    fail(Failure::input, "sound: AT=", at, " and RATE=", rate,
         ": a sound is of one speed (AT) or of a run-up (RATE); leave one of them out");
  const bool of_runup = sound && at.empty() && !rate.empty();
  if (sound && !of_runup && !positive(at))
    fail(
        Failure::input, "sound: AT=", at,
        ": say the mesh frequency in Hz, one of the sweep: make sound AT=2400, or the rate of a run-up in rpm/s: make sound RATE=100");
  if (runup || of_runup) {
    if (!rate.empty() && !positive(rate))
      refuse("RATE", rate,
             "it is the change of the driver's speed in rpm/s, above 0; WAY=down is a run-down");
    if ((!from.empty() || !to.empty()) && (!positive(from) || !positive(to)))
      fail(Failure::input, "FROM=", from, " TO=", to,
           ": give both or none: mesh frequencies in Hz at the start and the end of the ramp");
    if (rate.empty())
      fail(
          Failure::input,
          "runup: RATE=: say the rate in rpm/s of the driving gear: make runup RATE=1000; a tenth of it takes ten times as long");
  }
  if (request.asks("loaded") && !phase.empty() && !within(phase, 0, 1))
    refuse("PHASE", phase, "it is a share of the mesh period, 0 up to, not including, 1");
}

// The torque of a path is that of the artifact, which is looked for by its digits.
void check_torque(const std::string& scene, const std::string& torque) {
  char* end = nullptr;
  char printed[40];
  std::snprintf(printed, sizeof printed, "%g", std::strtod(torque.c_str(), &end));
  if (torque.empty() || *end != '\0' || torque != printed)
    fail(Failure::input, "out/", scene, "/T", torque,
         ": the torque in a path is a number in N m as printed by %g, such as T150 or T62.5");
}

void check_torques(const MakeRequest& request) {
  for (const std::string& goal : request.goals) {
    if (!goal.starts_with("out/")) continue;
    const size_t folder = goal.find('/', 4);
    if (folder == std::string::npos || goal.compare(folder, 2, "/T") != 0) continue;
    check_torque(goal.substr(4, folder - 4),
                 goal.substr(folder + 2, goal.find('/', folder + 1) - folder - 2));
  }
  if (const std::string& torque = request.value("TORQUE"); !torque.empty())
    for (const char* goal : {"calibrate", "loaded", "histories", "sound", "runup"})
      if (request.asks(goal)) {
        const std::string& scene = request.value("SCENE");
        check_torque(scene.empty() ? "parker2000" : fs::path(scene).stem().string(), torque);
      }
}

}  // namespace

std::string joined_by(const char* between, const Words& words) {
  std::string out;
  for (const std::string& word : words) out += (out.empty() ? "" : between) + word;
  return out;
}

bool present(const std::string& path) {
  std::error_code ignored;
  return fs::exists(path, ignored);
}

bool listed_in(const std::vector<std::string>& list, const std::string& word) {
  return std::find(list.begin(), list.end(), word) != list.end();
}

bool MakeRequest::asks(const std::string& goal) const {
  return listed_in(goals, goal);
}

const std::string& MakeRequest::value(const std::string& variable) const {
  static const std::string nothing;
  const auto found = variables.find(variable);
  return found == variables.end() ? nothing : found->second;
}

Words MakeRequest::words(const std::string& variable) const {
  return split_words(value(variable));
}

MakeRequest make_request(const std::string& goals, const std::vector<std::string>& variables) {
  MakeRequest out;
  check_characters(kTarget, goals);
  out.goals = split_words(goals);
  for (const std::string& given : variables) {
    const size_t equals = given.find('=');
    if (equals != std::string::npos) out.variables.emplace(given.substr(0, equals), given.substr(equals + 1));
  }
  for (const Variable& variable : known_variables())
    if (const char* value = std::getenv(variable.name.c_str())) out.variables.emplace(variable.name, value);
  return out;
}

void check_request(const MakeRequest& request) {
  for (const Variable& variable : known_variables()) {
    const std::string& value = request.value(variable.name);
    check_characters(variable, value);
  }
  const Words known = documented_targets();
  for (const std::string& goal : request.goals) check_target(goal, known);
  for (const auto& [name, value] : request.variables) check_variable(name);
  const std::string& scene = request.value("SCENE");
  for (const std::string& goal : request.goals)
    if (!scene.empty() && (goal == "scorecard" || goal.starts_with("out/figures/scorecard")))
      fail(
          Failure::input,
          "scorecard: it is what P2000 prints beside its own scenes, parker2000 parker2000-standard-tooth parker2000-calibrated; leave SCENE out");
  check_choices(request);
  check_motions(request);
  check_torques(request);
  check_files(request);
}

std::string wrong_with(const std::string& goals, const std::vector<std::string>& variables) {
  try {
    check_request(make_request(goals, variables));
  } catch (const Error& error) {
    return printable(error.what()) + "\n";
  }
  return "";
}

}  // namespace whine
