// Options of the stages that take a pair or a train: which of them the stage parameters allow, and what is read.
#include "io/stage_command.h"

#include <doctest/doctest.h>

#include "base/tool.h"
#include "io/publish.h"
#include "own_folder.h"
#include "refusal.h"

using namespace whine;

namespace {

// A command with an option of each kind and one of both; whether it is of a train, and how its inputs are recorded.
struct ReadByStage {
  bool train = false;
  std::string torque, impulse;
  std::vector<std::string> inputs;
};
ReadByStage read_by_stage(std::vector<std::string> words, StageCommand::Reads reads) {
  Options options{"A stage", "gear-stage"};
  StageCommand stage(options, "static.toml", reads);
  ReadByStage out;
  stage.add("--torque", out.torque, "torque in N m");
  stage.add("--impulse", out.impulse, "size of the vibration");
  stage.add_output("stage.h5").required();
  words.insert(words.begin(), "gear-stage");
  std::vector<char*> arguments;
  arguments.reserve(words.size());
  for (std::string& word : words) arguments.push_back(word.data());
  options.parse(static_cast<int>(arguments.size()), arguments.data());
  out.train = stage.of_train();
  out.inputs = stage.made_by(static_cast<int>(arguments.size()), arguments.data()).inputs;
  return out;
}

}  // namespace

TEST_CASE(
    "a stage of a pair and of a train: options that one of them alone has, and inputs in a fixed order") {
  OwnFolder folder;
  publish("pair.toml", "[mesh]\ndriver = 'a'\n");
  publish("train.toml", "[[drive]]\nkind = 'torque'\n");
  for (const char* name : {"a.h5", "b.h5", "rest.h5", "first.h5"}) publish(name, name);
  const auto with = [](const std::string& params, std::vector<std::string> more) {
    std::vector<std::string> words{"--params", params,   "--body",   "a=a.h5",
                                   "--body",   "b=b.h5", "--output", "o.h5"};
    words.insert(words.end(), more.begin(), more.end());
    return words;
  };
  constexpr auto kBodies = StageCommand::Reads::bodies, kRest = StageCommand::Reads::bodies_and_rest;
  const std::vector<std::string> rest{"--static", "rest.h5",  "--reference-static",
                                      "first.h5", "--torque", "60"};

  CHECK(!read_by_stage(with("pair.toml", {"--torque", "60"}), kBodies).train);
  CHECK(read_by_stage(with("pair.toml", rest), kRest).inputs ==
        std::vector<std::string>{"params=pair.toml", "static=rest.h5", "reference_static=first.h5",
                                 "body a=a.h5", "body b=b.h5"});
  const ReadByStage train = read_by_stage(with("train.toml", {"--impulse", "1e-3"}), kRest);
  CHECK(train.train);
  CHECK(train.inputs == std::vector<std::string>{"params=train.toml", "body a=a.h5", "body b=b.h5"});

  const auto rejected = [&](const std::vector<std::string>& words, StageCommand::Reads reads,
                            const std::vector<Field>& fields) {
    CHECK(refused([&] { read_by_stage(words, reads); }, Failure::usage, fields));
  };
  rejected(with("pair.toml", {}), kBodies, {"--torque", "needed", "pair.toml", "a pair"});
  rejected(with("pair.toml", {"--torque", "60"}), kRest, {"--static", "needed", "pair.toml"});
  rejected(with("pair.toml", {"--torque", "60", "--impulse", "1"}), kBodies,
           {"--impulse", "pair.toml", "a pair"});
  rejected(with("train.toml", {"--torque", "60"}), kBodies, {"--torque", "train.toml", "a train", "drives"});
  rejected(with("train.toml", {"--static", "rest.h5"}), kRest, {"--static", "train.toml", "a train"});
}
