#include "base/tool.h"

#include <dlfcn.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <new>

#include "base/error.h"

namespace whine {
namespace {

std::string one_line(std::string message) {
  std::replace(message.begin(), message.end(), '\n', ' ');
  std::replace(message.begin(), message.end(), '\r', ' ');
  while (!message.empty() && message.back() == ' ') message.pop_back();
  return message;
}

std::string shell_quoted(const std::string& word) {
  static const std::string plain = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_-+=/.,:@%";
  if (!word.empty() && word.find_first_not_of(plain) == std::string::npos) return word;
  std::string out = "'";
  for (char c : word) {
    if (c == '\'') {
      out += "'\\''";
    } else {
      out += c;
    }
  }
  return out + "'";
}

// OpenBLAS reads its environment when it is loaded, before main, so it must be told by a call; it is looked
// up by name because most programs do not link a BLAS at all.
void one_blas_thread() {
  setenv("OPENBLAS_NUM_THREADS", "1", 1);  // for programs started by this one
  setenv("OMP_NUM_THREADS", "1", 1);
  if (void* found = dlsym(RTLD_DEFAULT, "openblas_set_num_threads"))
    reinterpret_cast<void (*)(int)>(found)(1);
}

}  // namespace

double number_option(const std::string& name, const std::string& word) {
  double value = 0;
  const char* end = word.data() + word.size();
  const auto [rest, code] = std::from_chars(word.data(), end, value);
  if (code != std::errc() || rest != end || !std::isfinite(value)) {
    fail(Failure::usage, name, " = '", word, "': must be a finite decimal number, such as 150 or 62.5");
  }
  return value;
}

std::string program_name(const char* argv0) {
  return argv0 ? std::filesystem::path(argv0).filename().string() : "whine";
}

std::string recorded_path(const std::string& path) {
  const std::filesystem::path given(path);
  if (!given.is_absolute()) return path;
  std::error_code ignored;
  const auto here = std::filesystem::current_path(ignored);
  std::string below = given.lexically_normal().lexically_relative(here).generic_string();
  if (!below.empty() && below != ".." && below.rfind("../", 0) != 0) return below;
  return ".../" + given.filename().string();
}

std::string command_line(int argc, char** argv) {
  std::string out = program_name(argc > 0 ? argv[0] : nullptr);
  for (int i = 1; i < argc; ++i) {
    std::string word = argv[i];
    const auto equals = word.find('=');
    if (word.rfind("--", 0) == 0 && equals != std::string::npos) {
      word = word.substr(0, equals + 1) + recorded_path(word.substr(equals + 1));
    } else {
      word = recorded_path(word);
    }
    out += ' ' + shell_quoted(word);
  }
  return out;
}

std::string blas_name() {
  void* found = dlsym(RTLD_DEFAULT, "openblas_get_config");
  if (!found) return "none or not OpenBLAS";
  std::string name = reinterpret_cast<char* (*)()>(found)();
  while (!name.empty() && name.back() == ' ') name.pop_back();
  return name + ", 1 thread";
}

void tell_line(const std::string& line) {
  std::fputs(line.c_str(), stderr);
  std::fflush(stderr);
}

int run_tool_status(int argc, char** argv, const std::function<int(int, char**)>& body) {
  const std::string program = program_name(argc > 0 ? argv[0] : nullptr);
  const auto say = [&](const std::string& message) {
    tell_line(program + ": error: " + one_line(message) + "\n");
  };
  // A file-size limit must come back from write() as an error, not end the program without a word.
  std::signal(SIGXFSZ, SIG_IGN);
  one_blas_thread();
  try {
    return body(argc, argv);
  } catch (const Answered&) {
    return 0;
  } catch (const Error& error) {
    say(error.what());
    return static_cast<int>(error.kind());
  } catch (const std::bad_alloc&) {
    say("out of memory; a coarser [discretisation] needs less");
  } catch (const std::exception& error) {
    say(error.what());
  } catch (...) {
    say("unknown exception");
  }
  return 1;
}

}  // namespace whine
