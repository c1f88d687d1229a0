#include "io/transfer_function.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <numbers>
#include <sstream>
#include <vector>

#include "base/error.h"
#include "base/tool.h"
#include "io/publish.h"

namespace whine {
namespace {

// Also the empty one behind a comma that ends the line.
std::vector<std::string> fields_of(const std::string& line) {
  std::vector<std::string> out;
  std::istringstream rest(line + ',');
  for (std::string field; std::getline(rest, field, ',');) {
    const auto first = field.find_first_not_of(" \t"), last = field.find_last_not_of(" \t");
    out.push_back(first == std::string::npos ? "" : field.substr(first, last - first + 1));
  }
  return out;
}

// What a column may hold: products of such numbers with forces and with each other are finite.
struct Column {
  const char* name;
  double least, most;
};
constexpr std::array<Column, 3> kColumns = {
    {{"frequency_Hz", 0, 1e9}, {"magnitude", 0, 1e30}, {"phase_deg", -1e9, 1e9}}};

// Not finite: it is no number. from_chars knows no '+' in front.
double number_of(const std::string& word) {
  const bool plus = word.size() > 1 && word[0] == '+' && word[1] != '-';
  const char *begin = word.data() + (plus ? 1 : 0), *end = word.data() + word.size();
  double value = 0;
  const auto [rest, error] = std::from_chars(begin, end, value);
  return error == std::errc() && rest == end ? value : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

TransferFunction read_transfer_function(const std::string& path) {
  std::array<size_t, 3> column{};
  std::array<std::vector<double>, 3> values;
  bool named = false;
  int number = 0;
  const auto reject = [&](const std::string& why) {
    fail(Failure::input, path, ":", number, ": ", printable(why, 200),
         "; the first line names frequency_Hz, magnitude, phase_deg, each further one holds their numbers");
  };
  std::string bytes = read_bytes(path);
  if (bytes.starts_with("\xef\xbb\xbf")) bytes.erase(0, 3);  // byte order mark, which spreadsheets write
  std::istringstream lines(bytes);
  for (std::string line; std::getline(lines, line);) {
    ++number;
    if (!line.empty() && line.back() == '\r') line.pop_back();
    if (line.find_first_not_of(" \t") == std::string::npos || line[0] == '#') continue;
    const std::vector<std::string> fields = fields_of(line);
    if (fields.size() != kColumns.size()) reject(text("holds ", fields.size(), " words instead of 3"));
    for (size_t c = 0; c < kColumns.size(); ++c) {
      if (!named) {
        const auto found = std::find(fields.begin(), fields.end(), kColumns[c].name);
        if (found == fields.end()) reject(std::string("names no column ") + kColumns[c].name);
        column[c] = static_cast<size_t>(found - fields.begin());
        continue;
      }
      const std::string& word = fields[column[c]];
      const double value = number_of(word);
      if (!std::isfinite(value)) reject("'" + word + "' is no number");
      if (value < kColumns[c].least || value > kColumns[c].most)
        reject(text(kColumns[c].name, " = ", value, ": must be from ", kColumns[c].least, " to ",
                    kColumns[c].most));
      values[c].push_back(value);
    }
    if (named && values[0].size() > 1 && !(values[0].back() > values[0][values[0].size() - 2]))
      reject(text("frequency_Hz = ", values[0].back(), " does not ascend"));
    named = true;
  }
  if (values[0].size() < 2) reject(text("holds ", values[0].size(), " rows; 2 are the least"));
  const auto vector = [](const std::vector<double>& v) {
    return Eigen::VectorXd(Eigen::VectorXd::Map(v.data(), static_cast<Eigen::Index>(v.size())));
  };
  return {vector(values[0]), vector(values[1]), vector(values[2]) * (std::numbers::pi / 180)};
}

}  // namespace whine
