// The options of a program. CLI11 is included in options.cpp only: its header takes a compiler as long as the rest of a
// program.
//
//   whine::Options options{"What the program does", "gear-x"};
//   options.add("--input", input, "sweep.h5").required();
//   options.footer("Example:\n  gear-x --input ...");
//   options.parse(argc, argv);
#pragma once
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace whine {

// Leaves Options::parse when --help or --version has been answered; run_tool ends with status 0.
struct Answered {};

// One option, as `add` gives it; each call returns the option itself.
class Option {
 public:
  explicit Option(CLI::Option* option) : option_(option) {}
  Option& required();
  // --help says the value that the target holds now.
  Option& show_default();
  // Any other word is an error, which names these.
  Option& one_of(const std::vector<std::string>& words);
  // Of an int: any other number is an error, which names these.
  Option& within(int from, int to);
  // Several values in one word, as in --speeds 1200,1350.
  Option& separated_by(char delimiter);
  // The other option must be given, or must not be given.
  Option& needs(const Option& other);
  Option& excludes(const Option& other);
  bool given() const;  // after parse()

 private:
  CLI::Option* option_;
};

class Options {
 public:
  Options(const std::string& about, const std::string& program);
  ~Options();
  Options(const Options&) = delete;
  Options& operator=(const Options&) = delete;

  // An option "--name" or a positional "name" that sets target, which must outlive parse(). Target is a std::string, double,
  // std::optional<double>, int or a vector of strings or doubles; a word that does not convert is an error of parse(). Doubles are
  // decimal and finite (number_option() of base/tool.h). A positional vector takes all words
  // that are left, a "--name" one word each time that it is given.
  template <class Target>
  Option add(const std::string& name, Target& target, const std::string& help);
  Option flag(const std::string& name, bool& target, const std::string& help);
  // Below the options in --help: an example that runs.
  void footer(const std::string& text);

  // Reads the command line (adds --help and --version, which are printed on standard output and leave as Answered; whatever
  // is wrong is an Error(usage), also an --output that another option names as an input, by whatever path).
  void parse(int argc, char** argv);

 private:
  std::unique_ptr<CLI::App> app_;
};

}  // namespace whine
