#include "io/stage_parameters_text.h"

#include <cmath>

namespace whine {
namespace {

std::string quoted_text(const std::string& word) {
  std::string out = "\"";
  for (char c : word) {
    if (c == '"' || c == '\\') out += '\\';
    out += c;
  }
  return out + "\"";
}

std::string value_of(const Key& key, const Slot& slot) {
  if (const auto* number = std::get_if<double*>(&slot)) return exact_text(**number);
  if (const auto* whole = std::get_if<int*>(&slot)) return std::to_string(**whole);
  if (const auto* flag = std::get_if<bool*>(&slot)) return **flag ? "true" : "false";
  if (const auto* word = std::get_if<std::string*>(&slot)) return quoted_text(**word);
  if (const auto* choice = std::get_if<ChoiceSlot>(&slot)) return quoted_text(key.word_in(*choice));
  if (const auto* plane = std::get_if<PlaneSlot>(&slot)) return *plane->stress ? "\"stress\"" : "\"strain\"";
  if (const auto* corner = std::get_if<CornerRule*>(&slot)) {
    if (!(*corner)->enabled) return "false";
    return std::isfinite((*corner)->largest_angle) ? exact_text((*corner)->largest_angle) : "true";
  }
  if (const auto* list = std::get_if<std::vector<double>*>(&slot)) return exact_text(**list);
  if (const auto* points = std::get_if<Points*>(&slot)) return exact_text(**points);
  if (const auto* teeth = std::get_if<ToothList>(&slot)) return exact_text(*teeth->values);
  const auto& range = std::get<RangeSlot>(slot);
  return "{ from = " + exact_text(*range.from) + ", to = " + exact_text(*range.to) +
         ", step = " + exact_text(*range.step) + " }";
}

}  // namespace

StageParametersText::StageParametersText(const std::string& stage) {
  out_ << kStageParametersStart << stage << kStageParametersEnd << "\n";
}

void StageParametersText::begin(const std::string& label) {
  if (label != last_) out_ << "\n[" << label << "]\n";
  last_ = label;
}

void StageParametersText::add(const std::string& section, const std::string& label,
                              const SceneParameters& values, const std::set<KeyGroup>& parts) {
  SceneParameters copy = values;
  for (const Key& key : scene_keys()) {
    if (key.section != section || !parts.count(key.part)) continue;
    begin(label);
    const std::string value = value_of(key, key.slot(copy));
    out_ << key.si_name() << " = " << value;
    if (std::string(key.unit.si) != "1" && value != "true" && value != "false") out_ << "  # " << key.unit.si;
    out_ << "\n";
  }
}

void StageParametersText::add_line(const std::string& label, const std::string& name,
                                   const std::string& word) {
  begin(label);
  out_ << name << " = " << quoted_text(word) << "\n";
}

}  // namespace whine
