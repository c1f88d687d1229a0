#include "io/stage_command.h"

#include <algorithm>
#include <array>

#include "base/error.h"
#include "io/artifact.h"
#include "io/scene.h"

namespace whine {
namespace {

enum class Kind { pair, train };
constexpr const char* kOfKind[] = {"a pair", "a train"};

// Options that scenes of one kind alone have, and what those of the other kind have in their place.
struct KindOption {
  const char* name;
  Kind of;
  bool needed;
  const char* instead;
};
constexpr const char *kInDrives = "its torques are those of its drives",
                     *kNoRest = "its motion needs bodies alone", *kNotYet = "trains do not have it so far",
                     *kModes = "its one mode is found by a step of the torque";
constexpr std::array kOptions{
    KindOption{"--torque", Kind::pair, true, kInDrives},
    KindOption{"--static", Kind::pair, true, kNoRest},
    KindOption{"--reference-static", Kind::pair, true, kNoRest},
    KindOption{"--static-params", Kind::pair, true, "its --params say how it is at rest"},
    KindOption{"--next-level", Kind::pair, false, kNotYet},
    KindOption{"--torque-step", Kind::pair, false, "its modes decay after an --impulse"},
    KindOption{"--calibrate", Kind::pair, false, kNotYet},
    KindOption{"--contact-state", Kind::pair, false, "its ring-down is at --phases"},
    KindOption{"--modes", Kind::train, false, kModes},
    KindOption{"--phases", Kind::train, false, kModes},
    KindOption{"--impulse", Kind::train, false, kModes}};

const KindOption* kind_option(const std::string& name) {
  const auto* const found =
      std::find_if(kOptions.begin(), kOptions.end(), [&](const KindOption& own) { return name == own.name; });
  return found == kOptions.end() ? nullptr : &*found;
}

}  // namespace

StageCommand::StageCommand(Options& options, const std::string& params, Reads reads) : options_(options) {
  options.add("--params", params_, "stage parameters of the scene: out/<scene>/params/" + params).required();
  options.add("--body", bodies_, "body.h5 of a gear as <gear>=<path>, once for each").required();
  if (reads == Reads::bodies_and_rest) {
    add("--static", statics_, "static.h5 of the torque");
    add("--reference-static", reference_, "static.h5 whose mean stiffness sets the bearing dampers");
  }
  if (reads == Reads::bodies_and_parameters)
    add("--static-params", static_params_, "stage parameters of the scene: out/<scene>/params/static.toml");
}

std::string StageCommand::with_kind(const std::string& name, const std::string& help) {
  const KindOption* const own = kind_option(name);
  return !own ? help
              : text("of ", kOfKind[static_cast<int>(own->of)], own->needed ? ", REQUIRED: " : ": ", help);
}

Option StageCommand::noted(const std::string& name, Option option) {
  if (kind_option(name)) own_.emplace_back(name, option);
  return option;
}

Option StageCommand::flag(const std::string& name, bool& target, const std::string& help) {
  return noted(name, options_.flag(name, target, with_kind(name, help)));
}

bool StageCommand::of_train() const {
  const Kind kind = is_system_scene(params_) ? Kind::train : Kind::pair;
  const char* const scene = kOfKind[static_cast<int>(kind)];
  for (const auto& [name, option] : own_) {
    const KindOption& own = *kind_option(name);
    if (own.of != kind && option.given())
      fail(Failure::usage, name, ": ", params_, " is of ", scene, ", ", own.instead, "; leave it out");
    if (own.of == kind && own.needed && !option.given())
      fail(Failure::usage, name, " is needed: ", params_, " is of ", scene, "; see --help");
  }
  return kind == Kind::train;
}

Provenance StageCommand::made_by(int argc, char** argv) const {
  std::vector<std::string> inputs{"params=" + params_};
  if (!static_params_.empty()) inputs.push_back("static_params=" + static_params_);
  if (!statics_.empty()) inputs.push_back("static=" + statics_);
  if (!reference_.empty()) inputs.push_back("reference_static=" + reference_);
  return whine::made_by(argc, argv, bodies().and_inputs(std::move(inputs)));
}

}  // namespace whine
