// Artifacts of any kind, filled through describe(): every dataset that a kind has gets numbers of its own within its range, along
// axes that differ in length.
//
// What a codec asks of a file beyond ranges is found by trial: a dataset that is rejected gets other values, a word one of those
// that the rejection lists. Values that no trial finds stand in given_values().
#pragma once
#include <doctest/doctest.h>

#include <cmath>
#include <map>
#include <sstream>
#include <string>
#include <variant>
#include <vector>

#include "base/error.h"
#include "io/artifact_kinds.h"
#include "io/artifacts.h"
#include "io/codec.h"

// Whether a file has what a codec calls optional; pair: all but what makes it one of a train; usual: nor what else excludes other
// parts, which are lumped models, rims and variants outside the model's range.
enum class Optional { none, all, pair, usual };
inline constexpr Optional kOptionals[] = {Optional::none, Optional::all, Optional::pair, Optional::usual};

using AnyBlock = std::variant<whine::Block<double>, whine::Block<int>, whine::Block<std::string>>;

inline const std::map<std::string, AnyBlock>& given_values() {
  using whine::Block;
  const double h = std::sqrt(3.0);
  const Block<double> node{{1, h, -1, h, 2, 2 * h, -2, 2 * h, 3, 3 * h, -3, 3 * h}, {6, 2}};
  const Block<int> element{{1, 0, 2, 3, 3, 2, 4, 5}, {2, 4}}, side{{0, 1, 2, 3, 4, 5}, {3, 2}};
  static const std::map<std::string, AnyBlock> given{
      {"/parameters/study/key",
       Block<std::string>{{"damping.rayleigh_stiffness_s", "fidelity.contact"}, {2}}},
      {"/parameters/study/plan", Block<std::string>{{"sample"}, {}}},
      {"/natural_frequency", Block<double>{{1000.0 / 3, 2000.0 / 3, 1000}, {3}}},
      {"/mode_type", Block<std::string>{{"mixed train planet"}, {}}},
      {"/reading/steps_per_period", Block<double>{{64, 128, 256}, {3}}},
      {"contact_plane", Block<std::string>{{"stress"}, {}}},
      // Lists of numbers are text; their names are those of keys.
      {"single_pitch", Block<std::string>{{"[1e-06, -2e-06]"}, {}}},
      {"cumulative_pitch", Block<std::string>{{"[2e-06, -3e-06]"}, {}}},
      {"profile_slope", Block<std::string>{{"[3e-06, -4e-06]"}, {}}},
      {"profile_form", Block<std::string>{{"[4e-06, 5e-06]"}, {}}},
      {"points", Block<std::string>{{"[[0.125, 1e-06], [0.25, 2e-06]]"}, {}}},
      {"/hunting_periods", Block<int>{{3}, {}}},
      {"/mesh_phase", Block<double>{{1.0 / 7, 1.0 / 3, 2.0 / 3}, {3}}},
      {"/body/is_carrier", Block<int>{{0}, {1}}},
      {"/layout/body/is_carrier", Block<int>{{0}, {1}}},
      // Sectors of two elements whose edges meet their images.
      {"/parameters/gear/teeth", Block<int>{{6}, {}}},
      {"/sector/node_position", node},
      {"/sector/element_node", element},
      {"/sector/side_node", side},
      {"/cracked_tooth/node_position", node},
      {"/cracked_tooth/element_node", element},
      {"/cracked_tooth/side_node", side}};
  return given;
}

class Filling : public whine::ArtifactReader {
 public:
  // turn: how often a dataset was rejected; words: those that it may hold.
  using Turns = std::map<std::string, int>;
  using Words = std::map<std::string, std::vector<std::string>>;
  Filling(Optional optional, Turns& turn, Words& words) : optional_(optional), turn_(turn), words_(words) {}

  bool has(const std::string& name) const override {
    // A train has sections of gears that its meshes name, which these words do not.
    const bool train = given_.contains("/body/is_carrier") || given_.contains("/layout/body/is_carrier");
    for (const char* pair :
         {"/parameters/driver_", "/parameters/driven_", "/parameters/modification_", "/parameters/lead_"})
      if (train && name.starts_with(pair)) return false;
    if (name == "/parameters/operation/torque")
      return optional_ != Optional::all;  // what makes it one of a pair
    if (optional_ == Optional::none) return false;
    if (optional_ != Optional::all && name == "/layout/body/name") return false;
    const bool excludes = name == "/parameters/fidelity/model" || name.find("_rim/") != std::string::npos;
    return optional_ != Optional::usual || !excludes;
  }

  void rejected(const std::string& what) const override {
    std::istringstream in(what);
    std::string word, name = last_;
    if (in >> word; word == "dataset") in >> name;
    if (const auto list = what.find("of: "); list != std::string::npos) {
      std::istringstream allowed(what.substr(list + 4));
      std::vector<std::string>& words = words_[name];
      for (words.clear(); allowed >> word;) words.push_back(word);
    }
    ++turn_[name];
  }

  whine::Block<double> doubles(const std::string& name, const whine::Range& range,
                               const std::vector<Eigen::Index>& shape) const override {
    return filled<double>(name, shape, [&](std::size_t i) {
      const double own = 1 + 1e-3 * count_ + 1e-6 * static_cast<double>(i) / 3;  // differs from all others
      if (std::isinf(range.most)) {
        constexpr double kTrials[] = {0.3, 3, 20, 1e-3, 1e-5, 1e3, 1e10, 1e6, 1e-9};
        return own * kTrials[static_cast<std::size_t>(turn(name)) % std::size(kTrials)];
      }
      const double most = std::min(range.most, 1e3 * std::pow(0.1, turn(name)));
      return std::max(range.least, 0.0) + (most - std::max(range.least, 0.0)) * (own - 0.9) / 10;
    });
  }
  whine::Block<int> ints(const std::string& name, const whine::Range& range,
                         const std::vector<Eigen::Index>& shape) const override {
    return filled<int>(name, shape, [&](std::size_t i) {
      if (optional_ == Optional::usual && name == "/outside_model") return 0;
      const int trials[] = {1 + static_cast<int>(i % 2), static_cast<int>(i % 2), 1, 0, -1, 4, 17, 128};
      const int value = trials[static_cast<std::size_t>(turn(name)) % std::size(trials)];
      return static_cast<int>(std::clamp<double>(value, range.least, range.most));
    });
  }
  whine::Block<std::string> words(const std::string& name,
                                  const std::vector<Eigen::Index>& shape) const override {
    return filled<std::string>(name, shape, [&](std::size_t i) {
      if (optional_ == Optional::usual && name == "/outside_model_reason") return std::string();
      const auto found = words_.find(name);
      if (found == words_.end())
        return "any_word_" + std::to_string(shape.empty() ? count_ : static_cast<int>(i));
      return found->second[found->second.size() - 1 - i % found->second.size()];  // the last: no default
    });
  }

  // What each dataset was given.
  const std::map<std::string, AnyBlock>& given() const { return given_; }

 private:
  int turn(const std::string& name) const {
    const auto found = turn_.find(name);
    return found == turn_.end() ? 0 : found->second;
  }

  template <class Value, class Make>
  whine::Block<Value> filled(const std::string& name, const std::vector<Eigen::Index>& shape,
                             const Make& make) const {
    last_ = name;
    ++count_;
    auto found = given_values().find(name);
    if (found == given_values().end()) found = given_values().find(name.substr(name.rfind('/') + 1));
    const auto* own =
        found == given_values().end() ? nullptr : std::get_if<whine::Block<Value>>(&found->second);
    whine::Block<Value> block;
    std::size_t size = 1;
    for (std::size_t d = 0; d < shape.size(); ++d) {
      const std::size_t any =
          own && d < own->shape.size() ? own->shape[d] : 3 + static_cast<std::size_t>(axes_++ % 5);
      block.shape.push_back(shape[d] < 0 ? any : static_cast<std::size_t>(shape[d]));
      size *= block.shape.back();
    }
    for (std::size_t i = 0; i < size; ++i)
      block.values.push_back(own ? own->values[i % own->values.size()] : make(i));
    given_.insert_or_assign(name, block);
    return block;
  }

  Optional optional_;
  Turns& turn_;
  Words& words_;
  mutable std::map<std::string, AnyBlock> given_;
  mutable std::string last_;
  mutable int count_ = 0, axes_ = 0;
};

// Fills an artifact as it was made, {}.
template <class Artifact>
std::map<std::string, AnyBlock> fill(Artifact& artifact, Optional optional = Optional::all) {
  Filling::Turns turn;
  Filling::Words words;
  std::string why;
  for (int trial = 0; trial < 400; ++trial) try {
      Artifact any;
      const Filling trials(optional, turn, words);
      whine::Codec tried(trials);
      whine::ArtifactFile<Artifact>::walk(tried, any);
      const Filling values(optional, turn, words);
      whine::Codec codec(values);
      whine::ArtifactFile<Artifact>::walk(codec, artifact);
      return values.given();
    } catch (const whine::Error& error) {
      why = error.what();
    }
  FAIL("no values found: " << why);
  return {};
}

// Filled as it was made, {}; of a pair what may also be of a train.
template <class Artifact>
Artifact any() {
  Artifact a;
  fill(a, Optional::pair);
  return a;
}

inline const whine::Provenance kMade{"gear-test", "gear-test --output x.h5", {}};
