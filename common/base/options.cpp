#include "base/options.h"

#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>
#include <optional>
#include <type_traits>

#include "base/error.h"
#include "base/tool.h"

namespace whine {
namespace {

// Before the examples, which end the help.
constexpr const char* kExitStatuses =
    "Exit status: 0 done; 1 a computation failed; 2 wrong options; 3 a scene or an artifact is wrong or stale;\n"
    "  4 a file could not be read or written\n\n";

// An empty word would name a file by its extension alone, or a folder at the root.
void require_words(const CLI::App& app) {
  for (const CLI::Option* option : app.get_options())
    for (const std::string& word : option->results())
      if (word.empty())
        fail(Failure::usage, option->get_name(), " is empty; give a value, or leave the option out");
}

// A stage that wrote over what it reads would leave nothing to make it from again.
void require_output_apart(const CLI::App& app) {
  const CLI::Option* output = app.get_option_no_throw("--output");
  if (!output || output->count() == 0) return;
  const std::string place = output->results().back();
  for (const CLI::Option* option : app.get_options()) {
    if (option == output) continue;
    for (std::string word : option->results()) {
      std::error_code ignored;
      // Also of a word that names the gear first: pinion=<path>.
      if (const auto equals = word.find('=');
          equals != std::string::npos && !std::filesystem::exists(word, ignored))
        word = word.substr(equals + 1);
      if (std::filesystem::is_regular_file(word, ignored) &&
          std::filesystem::equivalent(word, place, ignored))
        fail(Failure::usage, "--output ", place, " is the same file as the input ", option->get_name(), " ",
             word, ", which would be lost; name another file to write");
    }
  }
}

// CLI11 itself reads "nan", "inf" and hexadecimal digits, and rounds twice, by way of long double.
void set(double& target, const std::string& name, const CLI::results_t& words) {
  target = number_option(name, words.back());
}

void set(std::optional<double>& target, const std::string& name, const CLI::results_t& words) {
  target = number_option(name, words.back());
}

void set(std::vector<double>& target, const std::string& name, const CLI::results_t& words) {
  target.clear();
  target.reserve(words.size());
  for (const std::string& word : words) target.push_back(number_option(name, word));
}

std::string in_words(double value) {
  return text(value);
}

std::string in_words(const std::optional<double>& value) {
  return value ? text(*value) : "";
}

std::string in_words(const std::vector<double>& values) {
  std::string words;
  for (const double value : values) words += text(words.empty() ? "" : ",", value);
  return words;
}

template <class Target>
CLI::Option* add_numbers(CLI::App& app, const std::string& name, Target& target, const std::string& help) {
  return app
      .add_option(
          name,
          [&target, name](const CLI::results_t& words) {
            set(target, name, words);
            return true;
          },
          help, false, [&target] { return in_words(target); })
      ->type_name("FLOAT")
      ->expected(1, std::is_same_v<Target, std::vector<double>> ? CLI::detail::expected_max_vector_size : 1);
}

}  // namespace

Option& Option::required() {
  option_->required();
  return *this;
}

Option& Option::show_default() {
  option_->capture_default_str();
  return *this;
}

Option& Option::one_of(const std::vector<std::string>& words) {
  option_->check(CLI::IsMember(words));
  return *this;
}

Option& Option::within(int from, int to) {
  option_->check(CLI::Range(from, to));
  return *this;
}

Option& Option::separated_by(char delimiter) {
  option_->delimiter(delimiter);
  return *this;
}

Option& Option::needs(const Option& other) {
  option_->needs(other.option_);
  return *this;
}

Option& Option::excludes(const Option& other) {
  option_->excludes(other.option_);
  return *this;
}

bool Option::given() const {
  return option_->count() > 0;
}

Options::Options(const std::string& about, const std::string& program)
    : app_(std::make_unique<CLI::App>(about, program)) {}

Options::~Options() = default;

template <class Target>
Option Options::add(const std::string& name, Target& target, const std::string& help) {
  CLI::Option* option = [&] {
    if constexpr (std::is_same_v<Target, double> || std::is_same_v<Target, std::optional<double>> ||
                  std::is_same_v<Target, std::vector<double>>)
      return add_numbers(*app_, name, target, help);
    else
      return app_->add_option(name, target, help);
  }();
  // Of a list, too: a second word would be taken from the list of inputs behind it.
  if (!option->get_positional()) option->allow_extra_args(false);
  return Option(option);
}

template Option Options::add(const std::string&, std::string&, const std::string&);
template Option Options::add(const std::string&, double&, const std::string&);
template Option Options::add(const std::string&, std::optional<double>&, const std::string&);
template Option Options::add(const std::string&, int&, const std::string&);
template Option Options::add(const std::string&, std::vector<std::string>&, const std::string&);
template Option Options::add(const std::string&, std::vector<double>&, const std::string&);

Option Options::flag(const std::string& name, bool& target, const std::string& help) {
  return Option(app_->add_flag(name, target, help));
}

void Options::footer(const std::string& text) {
  app_->footer(std::string(kExitStatuses) + text);
}

void Options::parse(int argc, char** argv) {
  app_->set_version_flag("--version", std::string(kVersion));
  try {
    app_->parse(argc, argv);
  } catch (const CLI::Success& asked) {  // help, version
    app_->exit(asked, std::cout, std::cerr);
    throw Answered{};
  } catch (const CLI::ParseError& error) {
    fail(Failure::usage, error.what(), " (see ", app_->get_name(), " --help)");
  }
  require_words(*app_);
  require_output_apart(*app_);
}

}  // namespace whine
