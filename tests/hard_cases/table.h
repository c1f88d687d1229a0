// The table of `make hard-cases`: a row per quantity, what is expected, what is found, what difference is allowed.
#pragma once
#include <cmath>
#include <cstdio>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"

namespace whine {

class Table {
 public:
  explicit Table(std::string id) : id_(std::move(id)) {}

  void relative(const std::string& what, double expected, double found, double allowed) {
    row(what, number(expected), number(found), number(allowed) + " rel.",
        std::abs(found - expected) <= allowed * std::abs(expected));
  }
  void absolute(const std::string& what, double expected, double found, double allowed) {
    row(what, number(expected), number(found), number(allowed) + " abs.",
        std::abs(found - expected) <= allowed);
  }
  void at_most(const std::string& what, double bound, double found) {
    row(what, "<= " + number(bound), number(found), "", found <= bound);
  }
  void at_least(const std::string& what, double bound, double found) {
    row(what, ">= " + number(bound), number(found), "", found >= bound);
  }
  // `pattern`: part of the message of Error.
  void rejected(const std::string& what, const std::string& pattern, const std::function<void()>& run) {
    std::string message = "accepted";
    try {
      run();
    } catch (const Error& e) {
      message = e.what();
    }
    const bool rejection = message.find(pattern) != std::string::npos;
    row(what, "refused", rejection ? "refused" : message, "", rejection);
  }
  void broken(const std::string& message) { row("the case came to its end", "yes", message, "", false); }

  static void head() {
    std::printf("%-5s %-8s %-88s %14s %14s  %s\n", "", "case", "what", "expected", "found",
                "allowed difference");
  }
  static int passed, failed;

 private:
  static std::string number(double x) {
    char buffer[32];
    std::snprintf(buffer, sizeof buffer, "%.9g", x);
    return buffer;
  }
  void row(const std::string& what, const std::string& expected, const std::string& found,
           const std::string& allowed, bool pass) {
    std::printf("%-5s %-8s %-88s %14s %14s  %s\n", pass ? "pass" : "FAIL", id_.c_str(), what.c_str(),
                expected.c_str(), found.c_str(), allowed.c_str());
    std::fflush(stdout);
    ++(pass ? passed : failed);
  }
  std::string id_;
};
inline int Table::passed = 0, Table::failed = 0;

struct HardCase {
  const char* id;
  void (*run)(Table& table);
};
std::vector<HardCase> known_answers();
std::vector<HardCase> numerical_stability();

}  // namespace whine
