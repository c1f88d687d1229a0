// The command line of the stages that take a scene of either kind, a pair or a train: what they read, and which options one kind
// alone has.
#pragma once
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "base/options.h"
#include "base/progress.h"
#include "io/named_files.h"
#include "io/provenance.h"

namespace whine {

class StageCommand {
 public:
  // Adds --params and --body; bodies_and_rest: of pairs also their results at rest, --static and --reference-static, or of
  // bodies_and_parameters what these depend on, --static-params. params: "sweep.toml".
  enum class Reads { bodies, bodies_and_rest, bodies_and_parameters };
  StageCommand(Options& options, const std::string& params, Reads reads);
  StageCommand(const StageCommand&) = delete;

  // As those of Options; of an option that one kind alone has, --help says so.
  template <class Target>
  Option add(const std::string& name, Target& target, const std::string& help) {
    return noted(name, options_.add(name, target, with_kind(name, help)));
  }
  Option flag(const std::string& name, bool& target, const std::string& help);
  Option add_output(const std::string& file) { return options_.add("--output", output_, file + " to write"); }

  // Behind parse(): whether --params is of a train. Throws Error(usage) for an option that scenes of its kind do not have, and for one
  // that they need.
  bool of_train() const;

  const std::string& params() const { return params_; }
  const std::string& statics() const { return statics_; }
  const std::string& reference() const { return reference_; }
  const std::string& static_params() const { return static_params_; }
  const std::string& output() const { return output_; }
  NamedFiles bodies() const { return {"--body", bodies_}; }  // throws as NamedFiles
  Provenance made_by(int argc, char** argv) const;           // with all that was read

 private:
  static std::string with_kind(const std::string& name, const std::string& help);
  Option noted(const std::string& name, Option option);

  Options& options_;
  std::vector<std::pair<std::string, Option>> own_;  // those of one kind alone
  std::string params_, static_params_, statics_, reference_, output_;
  std::vector<std::string> bodies_;
};

}  // namespace whine
