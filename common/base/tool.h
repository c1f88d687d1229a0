// What every program shares: one try/catch, one line per error, one exit status per kind of failure.
//
//   void body(int argc, char** argv) {
//     whine::Options options{"What the program does", "gear-x"};
//     options.add(...);
//     options.parse(argc, argv);  // --help and --version end here; wrong options are Failure::usage
//     ...
//   }
//   int main(int argc, char** argv) { return whine::run_tool(argc, argv, body); }
#pragma once
#include <functional>
#include <sstream>
#include <string>
#include <type_traits>

#include "base/options.h"

namespace whine {

inline constexpr const char* kVersion = "0.1.0";

// The value of an option as a number: decimal, finite, nothing before or after it. Error(usage) names option
// and value.
double number_option(const std::string& name, const std::string& word);

// Name of the program without folders: "build/bin/gear-mesh" -> "gear-mesh".
std::string program_name(const char* argv0);

// A path as artifacts record it: relative to the working folder if it lies below it, as typed if it was typed
// relative, otherwise ".../<file name>", so that no file holds a path of the machine that made it.
std::string recorded_path(const std::string& path);

// The command for provenance: program name and arguments, paths (also in --option=path) as recorded_path
// says, arguments with blanks or shell characters quoted.
std::string command_line(int argc, char** argv);

// The BLAS that this program has loaded, for provenance: bits may differ between libraries and processor
// types.
std::string blas_name();

// Text that came from a file, as a terminal may show it and a comment may hold it: one line of visible() (base/visible.h). What is
// longer than `most` bytes loses its middle, whole characters.
std::string printable(const std::string& text, size_t most = 2000);

// A line on standard error, printable.
void write_log(const std::string& line);

// A line for people on standard error, in one write so that programs side by side do not mix theirs; numbers with 6
// digits, files hold the rest.
template <class... Parts>
void log_line(const Parts&... parts) {
  std::ostringstream out;
  (out << ... << parts) << '\n';
  write_log(out.str());
}

// Runs body, which returns void or the exit status. An Error prints "<program>: error: <message>" as one line
// on standard error and returns its Failure code; anything else thrown returns 1. What body has printed on standard output is
// flushed: if it cannot be written the status is that of Failure::io.
// BLAS is set to one thread first, because results are to be the same on any number of cores.
int run_tool_status(int argc, char** argv, const std::function<int(int, char**)>& body);

template <class Body>
int run_tool(int argc, char** argv, Body body) {
  if constexpr (std::is_void_v<std::invoke_result_t<Body, int, char**>>) {
    return run_tool_status(argc, argv, [&](int count, char** words) {
      body(count, words);
      return 0;
    });
  } else {
    return run_tool_status(argc, argv, body);
  }
}

}  // namespace whine
