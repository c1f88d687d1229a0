#include "report/figure_words.h"

#include <algorithm>

#include "base/error.h"
#include "gear/drawing_quantities.h"
#include "report/text_width.h"

namespace whine {

std::string quoted_labels(const std::vector<std::string>& names) {
  std::string out;
  for (const std::string& name : names) out += "'" + name + "' ";
  return out;
}

namespace {

double name_width(const std::string& name) {
  return text_width(without_markup(name));
}

std::string shortened(const std::string& name, double most) {
  if (name_width(name) <= most) return name;
  constexpr double kDots = 1;
  const double first = 0.59 * (most - kDots);
  size_t head = name.size(), tail = name.size();
  while (head > 0 && name_width(name.substr(0, head)) > first) --head;
  while (tail > 0 && name_width(name.substr(tail - 1)) <= most - kDots - first) --tail;
  // Between characters of UTF-8.
  const auto within = [&](size_t i) {
    return i < name.size() && (static_cast<unsigned char>(name[i]) & 0xc0) == 0x80;
  };
  while (within(head)) --head;
  while (within(tail)) ++tail;
  return name.substr(0, head) + "…" + name.substr(tail);
}

}  // namespace

std::string short_name(const std::string& name) {
  constexpr double kMost = 11.2;  // 194 pixels of letters of a legend
  const size_t between = name.find('-');
  if (name_width(name) <= kMost || between == std::string::npos) return shortened(name, kMost);
  const std::string left = name.substr(0, between), right = name.substr(between + 1);
  const double both = kMost - text_width("-"), half = both / 2;
  return shortened(left, std::max(half, both - name_width(right))) + "-" +
         shortened(right, std::max(half, both - name_width(left)));
}

std::vector<std::string> in_lines(const std::string& words) {
  return broken_lines(words, kNoteWidth, name_width);
}

ShownUnit shown_units(const std::string& units) {
  if (units == "m") return {"µm", 1e6};
  if (units == "N m-1") return {"N/µm", 1e-6};
  if (units == "N") return {"kN", 1e-3};
  return {units == "1" ? "" : "Hz", 1};
}

std::string rest_force_name(const GearDesign& driver) {
  return !driver.helical() ? "T / r_b" : "T / (r_b cos β_b)";
}

PanelRule rest_rule(const GearDesign& driver, double torque) {
  const double force = normal_force(driver, torque);
  return {'y', force, text(rest_force_name(driver), " = ", fixed(force, 0), " N"), kGreen, 2, true};
}

void plain_captions(size_t plain, Figure& figure) {
  for (size_t i = 0; i < figure.notes.size(); ++i)
    figure.captions.push_back(i < plain ? without_markup(figure.notes[i]) : figure.notes[i]);
}

int mark_stride(Eigen::Index points) {
  const int stride = static_cast<int>((points + 59) / 60);
  return stride < 2 && points > 30 ? 2 : stride;
}

void add_lines(size_t plain, Figure& figure) {
  for (size_t i = 0; i < figure.notes.size(); ++i)
    figure.words.emplace_back(text("line", i + 1),
                              i < plain ? without_markup(figure.notes[i]) : figure.notes[i]);
}

}  // namespace whine
