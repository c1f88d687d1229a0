#include "io/artifact_place.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <sstream>
#include <vector>

#include "base/error.h"
#include "base/tool.h"
#include "io/artifact_kinds.h"
#include "io/make_request.h"

namespace whine {
namespace {

namespace fs = std::filesystem;

using PathParts = std::vector<std::string>;

PathParts parts_of(const std::string& path) {
  PathParts parts;
  for (const fs::path& part : fs::path(path)) parts.push_back(part.string());
  return parts;
}

bool below_out(const PathParts& parts) {
  return parts.size() > 2 && parts[0] == "out";
}

// out/<scene>/<gear>/body.h5 lies where the link of the gear leads.
std::string without_link(const fs::path& path) {
  std::error_code code;
  const fs::path folder = path.parent_path(), target = fs::read_symlink(folder, code);
  if (code || target.is_absolute()) return path.generic_string();
  return (folder.parent_path() / target / path.filename()).lexically_normal().generic_string();
}

// "" for a path that does not lead below the working folder.
std::string place_below_out(const std::string& path) {
  const std::string place = fs::path(recorded_path(path)).lexically_normal().generic_string();
  return below_out(parts_of(place)) ? without_link(place) : "";
}

// The word behind --output of a recorded command.
std::string output_of(const std::string& command) {
  const std::string option = " --output";
  const auto at = command.find(option);
  if (at == std::string::npos || at + option.size() + 1 >= command.size()) return "";
  std::string rest = command.substr(at + option.size() + 1);
  const char end = rest[0] == '\'' ? '\'' : ' ';
  if (end == '\'') rest.erase(0, 1);
  return rest.substr(0, rest.find(end));
}

// Schemas that a file of this name may have, none of other names.
std::vector<std::string> schemas_named(const PathParts& place) {
  const std::string& name = place.back();
  const std::string stem = name.substr(0, name.rfind('.'));
  if (place[1] == "studies") return {stem == "study" ? "whine/study" : "whine/variant"};
  std::vector<std::string> schemas;
  for_each_kind([&](const auto& kind) {
    std::istringstream stems(kind.stems);
    for (std::string own; stems >> own;)
      if (own.back() == '*' ? stem.starts_with(own.substr(0, own.size() - 1)) : stem == own)
        schemas.push_back(kind.schema());
  });
  return schemas;
}

// A torque as the name of its folder has it.
std::string short_torque(double torque) {
  char word[32];
  std::snprintf(word, sizeof word, "%g", torque);
  return word;
}

// Of what lies in out/<scene>/T<torque>/...
std::string wrong_operation(const PathParts& place, const Origin& origin) {
  if (place.size() < 4) return "";
  const bool of_torque = place[2].size() > 1 && place[2][0] == 'T';
  const std::string torque = short_torque(origin.torque);
  if (of_torque && origin.has_torque && place[2] != "T" + torque)
    return text("is at ", torque, " N m, but lies in ", place[2]);
  const std::string& folder = place[place.size() - 2];
  if (!origin.direction.empty() && (folder == "up" || folder == "down") && folder != origin.direction)
    return text("is of the sweep ", origin.direction, ", but lies in ", folder);
  if (!of_torque || place.size() == 4 || origin.direction.empty()) return "";
  // What follows a dash in the folder's name is a variant of the model.
  const std::string model = place.size() == 6 ? place[3] : "";
  const bool same = model == origin.model || (!origin.model.empty() && model.starts_with(origin.model + "-"));
  if (same) return "";
  return text("is of ", origin.model.empty() ? "the elastic pair" : "the lumped model " + origin.model,
              ", but lies in ", place[2], model.empty() ? "" : "/" + model);
}

}  // namespace

std::string misplaced(const std::string& path, const Origin& origin) {
  const std::string place = place_below_out(path);
  if (place.empty()) return "";
  const PathParts parts = parts_of(place);
  if (const auto schemas = schemas_named(parts);
      !schemas.empty() && std::find(schemas.begin(), schemas.end(), origin.schema) == schemas.end())
    return text("is '", origin.schema, "', but its name is that of '", joined_by("' or '", schemas), "'");
  if (const std::string wrong = wrong_operation(parts, origin); !wrong.empty()) return wrong;

  // Bodies and variants are called by their stage parameters.
  const bool body = parts[1] == "bodies";
  const std::string stem = parts.back().substr(0, parts.back().rfind('.'));
  const std::string hash = body ? parts[2] : origin.schema == "whine/variant" ? stem : "";
  for (const InputRecord& input : origin.inputs) {
    if (!hash.empty() && input.role == "params" && input.sha256.compare(0, hash.size(), hash) != 0)
      return text("is of the stage parameters ", input.sha256.substr(0, hash.size()), ", but lies at ",
                  place);
    const PathParts from = parts_of(fs::path(input.path).lexically_normal().generic_string());
    if (below_out(from) && !body && from[1] != "bodies" && parts[1] != "studies" && from[1] != parts[1])
      return text("was made from ", input.path, ", but lies in out/", parts[1]);
  }
  const std::string written = place_below_out(output_of(origin.command));
  if (!written.empty() && !body && written != place)
    return text("was written to ", written, ", but lies at ", place);
  return "";
}

}  // namespace whine
